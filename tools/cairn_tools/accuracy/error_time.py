"""Error against run time: scenes under many settings of Cairn, and the peers under several of theirs."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from .. import engine
from ..errors import UserError
from ..scene import SOLVERS, Scene
from .reference import FRAMES, Reference
from .rig import Rig
from .rows import PEERS, Row, Settings

CORES = ("m0", "m3")
# And the simulated seconds of a run: a pyramid of the peers takes millions of instructions a step.
SCENES = {"pyramid10": 2.0, "mixed50": 4.0, "curtain150": 2.0, "tower": 2.0,
          "rolling": 2.0, "bounce": 2.0, "spring": 2.0}  # fmt: skip
SECONDS = 2.0  # of other scenes
SUBSTEPS = (1, 2, 4, 8, 16)
RATES = (30, 60, 120, 240)
PASSES = (5, 10, 20)
ITERATIONS = {"chipmunk": (5, 10, 20), "box2d": (4, 8, 16)}
PEER_DEFAULT = {"chipmunk": 10, "box2d": 8}
WORKERS = 2

# The measures that engines are held against one another by; less is better.
MEASURES = {
    "rms_error": "position error, RMS up to the horizon",
    "penetration": "deepest penetration",
    "contact_error": "contact error of bodies at rest, RMS",
}

Say = Callable[[int, int], None]


def of(scene: Scene) -> tuple[Scene, float]:
    """A scene and how long it is run."""
    if scene.steps_per_second % FRAMES:
        raise UserError(f"{scene.path}: steps_per_second: must be a multiple of {FRAMES} to have frames in common")
    return scene, SCENES.get(scene.name, SECONDS)


def settings_of_cairn(scene: Scene) -> list[Settings]:
    """Sub-steps by rates; passes of the other solvers by rates; sleep and the other broad phase at the default."""
    own = Settings.of(scene)
    plain = replace(own, solver="soft", sleep=False)
    every = [replace(plain, substeps=n, steps_per_second=rate) for n in SUBSTEPS for rate in RATES]
    for other in (replace(plain, solver=solver, substeps=4) for solver in SOLVERS if solver != "soft"):
        every += [replace(other, passes=n) for n in PASSES]
        every += [replace(other, steps_per_second=rate) for rate in RATES]
    every += [own, replace(own, sleep=not own.sleep), replace(own, quadtree=not own.quadtree)]
    return list(dict.fromkeys(every))


def settings_of_peers() -> list[Settings]:
    """Iterations at 60 steps a second; the default ones at 120."""
    at_60 = [Settings(name, passes=n) for name in PEERS for n in ITERATIONS[name]]
    return [*at_60, *(Settings(name, passes=PEER_DEFAULT[name], steps_per_second=120) for name in PEERS)]


def measure(scenes: list[tuple[Scene, float]], cores: list[str], with_peers: bool, say: Say) -> list[Row]:
    """In the order of scenes, cores, settings, whatever ends first. Two runs at a time."""
    with _folder() as folder:
        references = [Reference.of(scene, seconds) for scene, seconds in scenes]
        jobs: list[tuple[Rig, Reference, Settings]] = []
        for (scene, _), reference in zip(scenes, references, strict=True):
            for core in cores:
                rig = Rig.build(scene, core, folder, with_peers)
                wanted = settings_of_cairn(scene) + (settings_of_peers() if with_peers else [])
                jobs += [(rig, reference, settings) for settings in wanted]
        return list(_run(jobs, say))


@contextmanager
def _folder() -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="cairn-") as name:
        yield Path(name)


def _run(jobs: list[tuple[Rig, Reference, Settings]], say: Say) -> Iterator[Row]:
    engine.host_program(engine.ARITHMETICS["q16"], "cairn-runner")
    done = 0

    def one(rig: Rig, reference: Reference, settings: Settings) -> Row:
        return rig.measure(settings, reference)

    def count(_: Future[Row]) -> None:
        nonlocal done
        done += 1
        say(done, len(jobs))

    with ThreadPoolExecutor(WORKERS) as pool:
        # The dearest first, so that one processor does not end long before the other.
        order = sorted(range(len(jobs)), key=lambda i: jobs[i][2].engine == "cairn")
        waiting: dict[int, Future[Row]] = {}
        for i in order:
            waiting[i] = pool.submit(one, *jobs[i])
            waiting[i].add_done_callback(count)
        yield from (waiting[i].result() for i in range(len(jobs)))


# ---- what the rows come to ----


def front(rows: list[Row], measure: str) -> list[Row]:
    """The Pareto front: what nothing beats in both cost and the measure, cheapest first."""
    known = [row for row in rows if math.isfinite(value(row, measure))]
    best: list[Row] = []
    for row in sorted(known, key=lambda row: (row.instructions_per_frame, value(row, measure))):
        if not best or value(row, measure) < value(best[-1], measure):
            best.append(row)
    return best


def value(row: Row, measure: str) -> float:
    return float(getattr(row.errors, measure))


@dataclass(frozen=True)
class Verdict:
    """The default beside a point of a peer: is it cheaper, and is it nearer to right by this measure?"""

    scene: str
    core: str
    peer: Settings
    measure: str
    default_value: float
    peer_value: float
    times_cheaper: float

    @property
    def below_and_left(self) -> bool:
        return self.times_cheaper > 1 and not self.peer_value <= self.default_value


def verdicts(rows: list[Row]) -> list[Verdict]:
    """Of every point of a peer, by each measure that there is of the scene."""
    found = []
    for default in (row for row in rows if row.is_default):
        of_peers = [row for row in rows if (row.scene, row.core) == (default.scene, default.core)]
        for row in (row for row in of_peers if row.settings.engine != "cairn"):
            for measure in MEASURES:
                own, theirs = value(default, measure), value(row, measure)
                if (math.isnan(own) and math.isnan(theirs)) or own == theirs == 0:
                    continue  # nothing rests, or nothing touches
                times = row.instructions_per_frame / default.instructions_per_frame
                found.append(Verdict(row.scene, row.core, row.settings, measure, own, theirs, times))
    return found
