"""The golden hashes: every scene must end in the same state on every target, and in the state that is on record.

tests/golden/hashes.json is the record. The newest line under "State hashes" in CHANGELOG.md names its digest, so that
no hash changes without a word to those who rely on them. docs/DETERMINISM.md tells more.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import subprocess
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import crossed, engine, scene
from .errors import UserError

GOLDEN = engine.ROOT / "tests" / "golden"
HASHES = GOLDEN / "hashes.json"
CHANGELOG = engine.ROOT / "CHANGELOG.md"
BUILDS = engine.ROOT / "build" / "golden"
STEPS = 600
RUN_SECONDS = 300

# Scenes that also run with a setting other than their file's.
VARIANTS: dict[tuple[str, Any], tuple[str, ...]] = {
    ("solver", "slides"): ("stack10", "pyramid10", "mixed50", "circles100", "bridge", "instability", "everything"),
    ("solver", "small"): ("stack10", "pyramid10", "mixed50", "circles100", "bridge", "instability", "everything"),
    ("broad_phase", "quadtree"): ("pyramid10", "mixed50", "circles100", "basic", "everything"),
    ("broad_phase", "pairs"): ("balls50",),
    ("sleep", True): ("stack10", "pyramid10", "mixed50", "tower", "everything"),
}
# The search for pairs is no part of the physics: a scene's hash may not depend on it.
WITHOUT_EFFECT = "broad_phase"

# The host's builds beside `host` itself, which is gcc -O2: the compiler and its flags.
COMPILERS = {
    f"{compiler}{level}": (compiler, level)
    for compiler in ("gcc", "clang")
    for level in ("-O0", "-O2", "-O3", "-Os", "-sanitize")
    if (compiler, level) != ("gcc", "-O2")
}
EVERY_TIME = ("host", *COMPILERS, "m0", "m3", "m4f")
ON_REQUEST = ("m7", "m33", "m55", "rp2040", *crossed.ARCHITECTURES)
TARGETS = (*EVERY_TIME, *ON_REQUEST)


@dataclass(frozen=True)
class Case:
    """A scene, perhaps with one setting changed; its name is the key in hashes.json."""

    name: str
    scene: scene.Scene


@dataclass(frozen=True)
class Result:
    """What a case gave on a target; `got` is a hash, or what went wrong."""

    target: str
    case: str
    expected: str | None
    got: str

    @property
    def passed(self) -> bool:
        return self.got == self.expected

    def __str__(self) -> str:
        return f"{self.case} on {self.target}: {self.got}, expected {self.expected or 'nothing: it is not on record'}"


def cases() -> list[Case]:
    """All scenes of examples/scenes and tests/golden/scenes, and their variants, whose files are in build/golden."""
    files = {path.stem: path for folder in (scene.SCENES_DIR, GOLDEN / "scenes") for path in folder.glob("*.json")}
    found = [Case(name, scene.load(path)) for name, path in files.items()]
    for (key, value), names in VARIANTS.items():
        for name in names:
            data = json.loads(files[name].read_text(encoding="utf-8")) | {key: value}
            shown = value if isinstance(value, str) else json.dumps(value)
            path = BUILDS / "scenes" / f"{name}-{key}-{shown}.json"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(json.dumps(data), encoding="utf-8")
            found.append(Case(f"{name} {key}={shown}", scene.load(path)))
    return sorted(found, key=lambda case: case.name)


def check(targets: list[str], say: Callable[[str], None], own: Sequence[Case] = ()) -> list[Result]:
    """Runs every case on the targets, as many at a time as there are processors; or a user's own, held to the host."""
    if own:
        say("host")
        run = _prepared("host")
        expected = {case.name: run(case) for case in own}
    else:
        expected = _read()["hashes"]
    jobs = [(target, case) for case in own or cases() for target in targets]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        say("building")
        runs = dict(zip(targets, pool.map(_prepared, targets), strict=True))

        def result(job: tuple[str, Case]) -> Result:
            target, case = job
            say(f"{case.name} on {target}")
            return Result(target, case.name, expected.get(case.name), _hash_or_trouble(runs[target], case))

        return list(pool.map(result, jobs))


def write(reason: str, say: Callable[[str], None]) -> bool:
    """Puts the host's hashes and the reason for them on record; false if they are there already."""
    run = _prepared("host")
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        say("host")
        found = cases()
        hashes = dict(zip([case.name for case in found], pool.map(run, found), strict=True))
    troubles = _broad_phase_troubles(hashes)
    if troubles:
        raise engine.EngineError(troubles[0])
    record = {"steps": STEPS, "hashes": hashes}
    if HASHES.is_file() and record == _read() and not record_troubles():
        return False
    if not reason.strip():
        raise UserError("--write needs the reason of the change, a line for CHANGELOG.md")
    HASHES.write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")
    text = CHANGELOG.read_text(encoding="utf-8")
    CHANGELOG.write_text(with_line(text, digest(record), " ".join(reason.split())), encoding="utf-8")
    return True


def record_troubles() -> list[str]:
    """What is wrong with the record itself, without a run."""
    record = _read()
    troubles = _broad_phase_troubles(record["hashes"])
    if record["steps"] != STEPS:
        troubles.append(f"{HASHES.name} is of {record['steps']} steps, not {STEPS}")
    names = {case.name for case in cases()}
    troubles += [f"{HASHES.name} has {name}, which is no case" for name in record["hashes"] if name not in names]
    newest = newest_digest(CHANGELOG.read_text(encoding="utf-8"))
    if newest != digest(record):
        troubles.append(f"CHANGELOG.md's newest state hashes are {newest}, {HASHES.name} gives {digest(record)}")
    return troubles


# ---- the record and the change log ----

HEADING = "### State hashes"
LINE = re.compile(r"- `([0-9a-f]{8})` (.*)")


def digest(record: dict[str, Any]) -> str:
    """Eight digits that stand for all hashes."""
    return hashlib.sha256(json.dumps(record, sort_keys=True).encode()).hexdigest()[:8]


def newest_digest(changelog: str) -> str | None:
    """That of the first line below the first heading of state hashes."""
    lines = changelog.splitlines()
    below = lines[lines.index(HEADING) :] if HEADING in lines else []
    return next((match[1] for match in map(LINE.fullmatch, below) if match), None)


def with_line(changelog: str, new_digest: str, reason: str) -> str:
    """The change log with one more line in front of the unreleased state hashes; the same reason twice is one line."""
    lines = changelog.splitlines()
    try:
        start = next(i for i, line in enumerate(lines) if line.startswith("## [Unreleased]"))
    except StopIteration:
        raise UserError("CHANGELOG.md has no section '## [Unreleased]'") from None
    end = next((i for i in range(start + 1, len(lines)) if lines[i].startswith(("## ", "["))), len(lines))
    line = f"- `{new_digest}` {reason}"
    if HEADING in lines[start:end]:
        place = lines.index(HEADING, start) + 2
        former = LINE.fullmatch(lines[place]) if place < len(lines) else None
        replaced = 1 if former and former[2] == reason else 0
        lines[place : place + replaced] = [line]
    else:
        while lines[end - 1] == "":
            end -= 1
        lines[end:end] = ["", HEADING, "", line]
    return "\n".join(lines) + "\n"


def _read() -> dict[str, Any]:
    if not HASHES.is_file():
        raise UserError(f"there is no {HASHES.relative_to(engine.ROOT)}: write it by tools/cairn golden --write REASON")
    return json.loads(HASHES.read_text(encoding="utf-8"))


def _broad_phase_troubles(hashes: dict[str, str]) -> list[str]:
    variants = [name for name in hashes if f" {WITHOUT_EFFECT}=" in name]
    pairs = [(name, name.partition(" ")[0]) for name in variants]
    return [f"{name} gives {hashes[name]}, not {hashes[own]}" for name, own in pairs if hashes[name] != hashes[own]]


# ---- targets ----

Runner = Callable[[Case], str]


def _prepared(target: str) -> Runner:
    """Builds what a target needs; gives what runs a case there."""
    if target in engine.CORES:
        return lambda case: engine.run(case.scene, "q16", target, STEPS, 0).hash
    if target in crossed.ARCHITECTURES:
        library = crossed.library(target, BUILDS / target)
        return lambda case: _hash_of(crossed.command(target, library, case.scene, case.name, STEPS), case)
    program = engine.host_program("host", "cairn-runner") if target == "host" else _compiled(target)
    return lambda case: _hash_of([str(program), str(case.scene.path), f"steps={STEPS}"], case)


def _compiled(target: str) -> Path:
    """The runner by another compiler, or with other flags."""
    compiler, level = COMPILERS[target]
    folder = BUILDS / target
    sanitized = level == "-sanitize"
    settings = {
        "CMAKE_C_COMPILER": compiler,
        "CMAKE_BUILD_TYPE": "RelWithDebInfo",
        "CMAKE_C_FLAGS_RELWITHDEBINFO": "-O1 -g" if sanitized else level,
        "CAIRN_SANITIZE": "ON" if sanitized else "OFF",
        "CAIRN_BUILD_TESTS": "OFF",
    }
    if not (folder / "build.ninja").is_file():
        given = [f"-D{key}={value}" for key, value in settings.items()]
        _call(["cmake", "-S", str(engine.ROOT), "-B", str(folder), "-G", "Ninja", *given])
    _call(["cmake", "--build", str(folder), "--target", "cairn-runner", "-j", "1"])
    return folder / "tools" / "runner" / "cairn-runner"


def _call(command: list[str]) -> None:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise engine.EngineError(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")


def _hash_of(command: list[str], case: Case) -> str:
    """The hash that a runner of the host's prints."""
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=RUN_SECONDS, check=False)
    match = re.search(r"^hash ([0-9a-f]{8})$", done.stdout, re.MULTILINE)
    if done.returncode == 0 and match and done.stdout.endswith("end\n"):
        return match[1]
    raise engine.EngineError(f"{case.name}: {_first_complaint(done)}")


def _first_complaint(done: subprocess.CompletedProcess[str]) -> str:
    lines = [line for line in (done.stderr + done.stdout).splitlines() if line.strip()]
    told = next((line for line in lines if re.search("error", line, re.IGNORECASE)), None)
    return told or (lines[-1] if lines else f"exit code {done.returncode}")


def _hash_or_trouble(run: Runner, case: Case) -> str:
    try:
        return run(case)
    except (engine.EngineError, UserError) as error:
        return str(error)
    except subprocess.TimeoutExpired:
        return f"did not end within {RUN_SECONDS} s"


def by_target(results: list[Result]) -> Iterator[tuple[str, list[Result]]]:
    """The results of each target, in the order of the first of each."""
    for target in dict.fromkeys(result.target for result in results):
        yield target, [result for result in results if result.target == target]
