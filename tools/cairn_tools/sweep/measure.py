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

from .. import engine, geometry, host, scene
from ..errors import UserError
from ..host import ANGLE, X, Y
from ..stability import measure as physics
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
    speed_end: float | None = None  # m/s, of the fastest corner in the last record
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
    for file in [*files, Path(__file__), Path(__file__).with_name("settings.py")]:
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
    steps = max(1, round(seconds * settings.rate))
    every = math.ceil(steps / RECORDS)
    world, states = _run(loaded, settings.engine, steps, every)
    got = Measured(hash=world.hash, **_of_contacts(loaded, world, states), **_of_motion(loaded, world, states))
    if settings.engine == "q16":
        _compare(got, states, _run(loaded, "f64", steps, every)[1], world)
    if settings.core:
        _count(got, text, settings.core, steps)
    return got


def _run(loaded: scene.Scene, arithmetic: str, steps: int, every: int) -> tuple[host.World, np.ndarray]:
    """The quadtree is left out: it changes what a step costs and no bit of what it gives."""
    world, bodies = host.build(loaded, arithmetic)
    world.set_sleep(loaded.sleep)
    return world, world.record(steps, every, bodies)


def _of_contacts(loaded: scene.Scene, world: host.World, states: np.ndarray) -> dict[str, Any]:
    outlines = physics.Outlines(world)
    meets = np.array([_push(loaded, a, b) for a, b in zip(outlines.a, outlines.b, strict=True)], dtype=bool)
    outlines.a, outlines.b = outlines.a[meets], outlines.b[meets]
    depths = [outlines.penetration(record) for record in states]
    counts = world.statistics
    return {
        "points": counts["points"],
        "dropped": counts["dropped"],
        "saturations": counts["saturations"],
        "penetration_worst": max(depths),
        "penetration_mean": float(np.mean(depths)),
    }


def _push(loaded: scene.Scene, a: int, b: int) -> bool:
    """Whether two bodies may not be in one another: no sensor, each in a layer that the other meets."""
    one, other = loaded.bodies[a], loaded.bodies[b]
    apart = any(not spring.collide and {spring.a, spring.b} == {a, b} for spring in loaded.springs)
    return bool(not one.sensor and not other.sensor and one.layer & other.mask and other.layer & one.mask) and not apart


def _of_motion(loaded: scene.Scene, world: host.World, states: np.ndarray) -> dict[str, Any]:
    moving = _moving(world)
    if not moving:
        return {"bodies": len(loaded.bodies)}
    own = states[:, moving]
    energy = physics.kinetic_energy(world, own) + physics.potential_energy(world, own) + _of_springs(loaded, states)
    return {
        "bodies": len(loaded.bodies),
        "moved": physics.moved(own),
        "drift": physics.moved(own, len(own) // 2),
        "speed_end": physics.fastest(own[-1:], world),
        "energy_gained": float(energy.max() - energy[0]),
        "energy_lost": float(energy[0] - energy[-1]),
    }


def _moving(world: host.World) -> list[int]:
    return [place for place, kind in enumerate(world.types.values()) if kind == host.DYNAMIC]


def _of_springs(loaded: scene.Scene, states: np.ndarray) -> np.ndarray:
    """Energy of the springs' lengths, of each record."""
    total = np.zeros(len(states))
    for spring in loaded.springs:
        a = _anchor(loaded, states, spring.a, spring.anchor_a)
        b = _anchor(loaded, states, spring.b, spring.anchor_b)
        stretch = np.hypot(*(b - a).T) - spring.rest_length
        total += 0.5 * (spring.stiffness or 0.0) * stretch**2
    return total


def _anchor(loaded: scene.Scene, states: np.ndarray, body: int, anchor: geometry.Point) -> np.ndarray:
    """Where an anchor is in each record; states are of the centre of mass, an anchor's frame is the shape's."""
    x, y = np.subtract(anchor, loaded.shape_of(loaded.bodies[body]).centre)
    c, s = np.cos(states[:, body, ANGLE]), np.sin(states[:, body, ANGLE])
    return states[:, body, [X, Y]] + np.stack([c * x - s * y, s * x + c * y], axis=1)


def _compare(got: Measured, states: np.ndarray, double: np.ndarray, world: host.World) -> None:
    moving = _moving(world)
    if not moving:
        return
    gap = np.hypot(*np.moveaxis((states - double)[:, moving][:, :, [X, Y]], 2, 0))
    got.error_max, got.error_rms = float(gap.max()), float(np.sqrt(np.mean(gap**2)))
    got.error_end = float(gap[-1].max())


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
