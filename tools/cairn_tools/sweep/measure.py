"""One row of a sweep: a run on the host, its twin in double, and its instructions on a core where one is asked for."""

from __future__ import annotations

import hashlib
import math
import tempfile
from dataclasses import asdict, dataclass, field, fields, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from .. import engine, host, overlap, scene
from .. import physics as physics_of
from ..errors import UserError
from ..overlap import Surfaces, X, Y
from ..physics import Physics
from .settings import Job, Settings, changed

RECORDS = 120  # at most, of a run: what is measured at each costs more than a step


@dataclass
class Measured:
    """What a run gave; nothing where it broke."""

    bodies: int | None = None
    points: int | None = None  # contacts at the end
    dropped: int | None = None  # contacts that found no room
    saturations: int | None = None
    penetration_worst: float | None = None  # m, of any pair at any record
    penetration_mean: float | None = None  # m, over the records, of the deepest pair
    moved: float | None = None  # m, the farthest of any body from its start, over the records
    drift: float | None = None  # m, the same from the middle of the run
    speed_end: float | None = None  # m/s, of the fastest point of any body in the last record
    energy_gained: float | None = None  # J, the most above the start, over the records
    energy_lost: float | None = None  # J, from the start to the end
    error_max: float | None = None  # m, the farthest of any body from where double has it, over the records
    error_rms: float | None = None  # m, over bodies and records
    error_end: float | None = None  # m, the farthest at the end
    hash: str = ""
    instructions_mean: float | None = None  # a step, over the second half of the run
    instructions_worst: float | None = None  # of all steps
    stack: int | None = None  # bytes, of the whole image
    failure: str = ""  # what the engine says where it refuses the scene


@dataclass(frozen=True)
class Row:
    """A line of the results: what it was run with, what came out."""

    scene: str
    digest: str  # of the scene file
    build: str  # of the engine and of what measures
    seconds: float
    settings: Settings
    measured: Measured = field(default_factory=Measured)

    def flat(self) -> dict[str, Any]:
        own = {"scene": self.scene, "digest": self.digest, "build": self.build, "seconds": self.seconds}
        return own | asdict(self.settings) | asdict(self.measured)


KEY = ("scene", *(part.name for part in fields(Settings)))
COLUMNS = tuple(Row("", "", "", 0.0, Settings(*([""] * len(fields(Settings))))).flat())


@cache
def build() -> str:
    """A digest of the engine's sources and of this file's: rows of two builds do not belong together."""
    digest = hashlib.sha256()
    folders = [engine.ROOT / name for name in ("include", "src", "tools/host")]
    files = sorted(file for folder in folders for file in folder.rglob("*.[ch]"))
    measuring = [Path(__file__).with_name("settings.py"), *(Path(module.__file__) for module in (overlap, physics_of))]
    for file in [*files, Path(__file__), *measuring]:
        digest.update(file.relative_to(engine.ROOT).as_posix().encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()[:8]


def prepare() -> str:
    """Builds the libraries, so that rows do not wait for that; gives build()."""
    for preset in engine.ARITHMETICS.values():
        engine.host_library(preset)
    return build()


def row(job: Job, seconds: float) -> Row:
    """Runs a job. A scene that the engine refuses is a row too."""
    got = Row(job.scene, job.digest, build(), seconds, job.settings)
    try:
        return replace(got, measured=_measured(job, seconds))
    except (engine.EngineError, scene.FieldError, UserError) as problem:
        return replace(got, measured=Measured(failure=" ".join(str(problem).split())))


def _measured(job: Job, seconds: float) -> Measured:
    text, settings = changed(job), job.settings
    loaded = scene.parse(text, Path(f"{job.scene}.json"))
    physics = Physics(loaded)
    steps = max(1, round(seconds * settings.rate))
    every = math.ceil(steps / RECORDS)
    world, states = _run(physics, settings.engine, steps, every)
    got = Measured(bodies=len(loaded.bodies), hash=world.hash)
    _contacts(got, world, loaded, states)
    _motion(got, physics, states)
    if settings.engine == "q16":
        gap = _ways(physics, states - _run(physics, "f64", steps, every)[1])
        got.error_max, got.error_rms, got.error_end = gap.max(), np.sqrt(np.mean(gap**2)), gap[-1].max()
    if settings.core:
        _count(got, text, settings.core, steps)
    return _of_python(got)


def _of_python(got: Measured) -> Measured:
    """Without numpy's kinds of numbers, which JSON does not know."""
    values = {name: value.item() if isinstance(value, np.generic) else value for name, value in vars(got).items()}
    return Measured(**values)


def _run(physics: Physics, arithmetic: str, steps: int, every: int) -> tuple[host.World, np.ndarray]:
    """The states are those of the shapes' origins. The quadtree is left out: it changes no bit of what a run gives."""
    world, bodies = host.build(physics.scene, arithmetic)
    world.set_sleep(physics.scene.sleep)
    return world, physics.bodies.placed(world.record(steps, every, bodies))


def _contacts(got: Measured, world: host.World, loaded: scene.Scene, states: np.ndarray) -> None:
    counts, surfaces = world.statistics, Surfaces.of(loaded)
    got.points, got.dropped, got.saturations = (counts[name] for name in ("points", "dropped", "saturations"))
    depths = [surfaces.penetration(record) for record in states]
    got.penetration_worst, got.penetration_mean = max(depths), np.mean(depths)


def _motion(got: Measured, physics: Physics, states: np.ndarray) -> None:
    energy, middle = physics.energy(states), len(states) // 2
    got.energy_gained, got.energy_lost = energy.max() - energy[0], energy[0] - energy[-1]
    got.moved = _ways(physics, states - states[:1]).max()
    got.drift = _ways(physics, states[middle:] - states[middle]).max()
    got.speed_end = physics.speeds(states[-1:]).max()


def _ways(physics: Physics, gap: np.ndarray) -> np.ndarray:
    """Lengths of differences of places [record, moving body]."""
    return np.hypot(gap[:, physics.moving, X], gap[:, physics.moving, Y])


def _count(got: Measured, text: str, core: str, steps: int) -> None:
    """Instructions in QEMU, where the run must end in the state that the host ends in."""
    with tempfile.TemporaryDirectory(prefix="cairn-") as folder:
        file = Path(folder) / "scene.json"
        file.write_text(text, encoding="utf-8")
        ran = engine.run(scene.load(file), "q16", core, steps, 0)
    if ran.hash != got.hash:
        raise engine.EngineError(f"{core} ends in the state {ran.hash}, the host in {got.hash}")
    settled = ran.costs[len(ran.costs) // 2 :]
    got.instructions_mean, got.instructions_worst = sum(settled) / len(settled), max(ran.costs)
    got.stack = ran.stack
