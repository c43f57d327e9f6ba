"""The verb: chooses cases, runs them side by side, prints what they gave."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from fnmatch import fnmatch
from pathlib import Path

from .. import engine as engine_module
from .. import scene
from ..errors import UserError
from . import report
from .cases import CASES
from .model import Result, run

WORKERS = min(2, os.cpu_count() or 1)

Job = tuple[str, str, str]  # case, engine, solver


def jobs(part: str, names: list[str], engines: list[str], solvers: list[str]) -> list[Job]:
    """What to run. part: quick, long or all. Names may have * in them; given names are taken from all parts."""
    chosen = [entry for entry in CASES.values() if _is_chosen(entry.name, entry.quick, part, names)]
    for name in names:
        if not any(fnmatch(entry, name) for entry in CASES):
            raise UserError(f"--case {name}: no such case; known: {', '.join(CASES)}")
    listed = []
    for entry in chosen:
        # Without a wish, the others are shown where their fall is the point.
        wished = solvers or (scene.SOLVERS if entry.baseline else ["soft"])
        for solver in wished:
            usual = engines or (entry.engines if solver == "soft" else ("q16",))
            listed += [(entry.name, engine, solver) for engine in usual if engine in entry.engines]
    return listed


def _is_chosen(name: str, quick: bool, part: str, names: list[str]) -> bool:
    if names:
        return any(fnmatch(name, pattern) for pattern in names)
    return part == "all" or quick == (part == "quick")


def results(listed: list[Job], workers: int, say: Callable[[str], None]) -> Iterator[Result]:
    """Runs the jobs in processes, and gives their results in order."""
    for arithmetic in {engine for _, engine, _ in listed}:
        engine_module.host_library(engine_module.ARITHMETICS[arithmetic])
    if workers == 1:
        for job in listed:
            say(" ".join(job))
            yield run(*job)
        return
    with ProcessPoolExecutor(workers) as pool:
        waiting = [pool.submit(run, *job) for job in listed]
        for k, (job, future) in enumerate(zip(listed, waiting, strict=True)):
            say(f"{k + 1} of {len(listed)}: {' '.join(job)}")
            yield future.result()


def draw(folder: Path, workers: int) -> list[Path]:
    # Drawing is slow to load: only who asks for it waits.
    from . import plots

    return plots.write(folder, workers)


def as_json(got: list[Result]) -> str:
    return json.dumps([report.record(result) for result in got], indent=2)
