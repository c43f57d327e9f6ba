"""The counts on record: tests/bench/counts.json says what a step costs, and tools/test holds the engine to it."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from . import bench, engine, profile, scene

FILE = engine.ROOT / "tests" / "bench" / "counts.json"
CORES = ("m0", "m3", "m4f")
SCENES = ("pyramid10", "stack10", "circles100", "mixed50", "curtain150")
RISE = 0.02  # more than this needs a new record
SHOWN = 5  # functions named where a count rose
WORKERS = 2

Say = Callable[[str], None]


def write(say: Say) -> None:
    """Measures and puts on record."""
    record: dict[str, Any] = {}
    for name, core, cost, profiled in _measured(say, with_profile=True):
        record.setdefault(name, {})[core] = {
            "mean": round(cost.mean_instructions),
            "worst": cost.worst_instructions_from_start,
            "stages": {stage: round(count) for stage, count in profiled.stages.items()},
            "functions": {function: round(count) for function, count in profiled.functions.items() if count >= 1},
        }
    FILE.parent.mkdir(exist_ok=True)
    FILE.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def troubles(say: Say) -> Iterator[str]:
    """What costs more than the record allows, with the functions to blame."""
    record = json.loads(FILE.read_text(encoding="utf-8"))
    for name, core, cost, _ in _measured(say, with_profile=False):
        kept = record.get(name, {}).get(core)
        if kept is None:
            yield f"{name} on {core}: not on record"
            continue
        for what, now in (("mean", cost.mean_instructions), ("worst", cost.worst_instructions_from_start)):
            if now > kept[what] * (1 + RISE):
                yield f"{name} on {core}: {what} {now:,.0f} instructions a step, on record {kept[what]:,}"
                if what == "mean":
                    yield from _blame(name, core, kept["functions"])


def _blame(name: str, core: str, kept: dict[str, int]) -> Iterator[str]:
    now = profile.measure(_scene(name), core, bench.FIRST_STEP, bench.LAST_STEP).functions
    rises = {function: now.get(function, 0) - kept.get(function, 0) for function in {*now, *kept}}
    for function in sorted(rises, key=rises.__getitem__, reverse=True)[:SHOWN]:
        yield f"    {function}: {kept.get(function, 0):,} to {now.get(function, 0):,.0f}"


def _measured(say: Say, with_profile: bool) -> Iterator[tuple[str, str, bench.Cost, profile.Profile]]:
    """Core by core, since one folder builds one image at a time."""

    def one(core: str) -> list[tuple[str, str, bench.Cost, profile.Profile]]:
        rows = []
        for name in SCENES:
            say(f"{name} on {core}")
            loaded = _scene(name)
            profiled = profile.Profile({}, {})
            if with_profile:
                profiled = profile.measure(loaded, core, bench.FIRST_STEP, bench.LAST_STEP)
            rows.append((name, core, bench.measure(loaded, core), profiled))
        return rows

    with ThreadPoolExecutor(WORKERS) as pool:
        for rows in pool.map(one, CORES):
            yield from rows


def _scene(name: str) -> scene.Scene:
    return scene.load(scene.find(name))
