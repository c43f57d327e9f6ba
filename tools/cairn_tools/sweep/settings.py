"""The parameters of a sweep: what may be varied, within which limits, and how a scene changes by them."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, field, replace
from itertools import product, zip_longest
from pathlib import Path
from typing import Any

import numpy as np

from .. import scene
from ..errors import UserError

LARGEST_RANGE = 1_000_000
LARGEST_SWEEP = 10_000_000
JITTER = 0.001  # metres, where seeds are given and no jitter


@dataclass(frozen=True)
class Settings:
    """What one row is run with, but for its scene. 0 passes or sub-steps: the solver does not use them."""

    engine: str
    solver: str
    substeps: int
    passes: int
    rate: int
    sleep: bool
    quadtree: bool
    seed: int
    jitter: float
    gravity: float
    mass: float
    stiffness: float
    damping: float
    friction: float
    core: str  # empty: no instructions are counted


@dataclass(frozen=True)
class Parameter:
    """One that may be varied. None as default: the scene's own."""

    name: str
    help: str
    default: Any
    read: Callable[[str], Any]


@dataclass(frozen=True)
class Job:
    """A row to run."""

    scene: str  # name of the file, without its ending
    text: str = field(repr=False)  # of the file
    digest: str
    settings: Settings

    @property
    def key(self) -> tuple[Any, ...]:
        """What tells one row of a results file from another."""
        return (self.scene, *asdict(self.settings).values())


# ---- values ----


def _word(*allowed: str) -> Callable[[str], str]:
    def read(text: str) -> str:
        if text not in allowed:
            raise ValueError(f"is not one of {', '.join(allowed)}")
        return text

    return read


def _switch(text: str) -> bool:
    return _word("on", "off")(text) == "on"


def _whole(low: int, high: int) -> Callable[[str], int]:
    def read(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            raise ValueError("is no whole number") from None
        if not low <= value <= high:
            raise ValueError(f"is not within {low} to {high}")
        return value

    return read


def _real(low: float, high: float) -> Callable[[str], float]:
    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            raise ValueError("is no number") from None
        if not low <= value <= high:  # also where it is not a number
            raise ValueError(f"is not within {low:g} to {high:g}")
        return value

    return read


_FACTOR = _real(1e-9, 1e9)

PARAMETERS = {
    parameter.name: parameter
    for parameter in (
        Parameter("engine", "q16, f64", "q16", _word("q16", "f64")),
        Parameter("solver", ", ".join(scene.SOLVERS), None, _word(*scene.SOLVERS)),
        Parameter("substeps", "1 to 16, of the soft solver", None, _whole(1, 16)),
        Parameter("passes", "1 to 100, of the slides' and the small solver", None, _whole(1, 100)),
        Parameter("rate", "steps a second, 10 to 2000", None, _whole(10, 2000)),
        Parameter("sleep", "on, off", None, _switch),
        Parameter("quadtree", "on, off", None, _switch),
        Parameter("seed", "places of the bodies: 0 as in the file, else moved by the jitter", 0, _whole(0, 2**31)),
        Parameter("jitter", f"metres at most on each axis, default {JITTER:g}", JITTER, _real(0.0, 100.0)),
        Parameter("gravity", "a factor", 1.0, _real(0.0, 1e6)),
        Parameter("mass", "a factor, of what moves", 1.0, _FACTOR),
        Parameter("stiffness", "a factor, of all springs", 1.0, _FACTOR),
        Parameter("damping", "a factor, of all springs", 1.0, _real(0.0, 1e9)),
        Parameter("friction", "a factor", 1.0, _real(0.0, 1e3)),
    )
}


def read_values(text: str) -> tuple[str, list[Any]]:
    """`substeps=1,2,4` or `seed=0..99`."""
    name, equals, listed = text.partition("=")
    if not equals or not listed:
        raise UserError(f"{text}: a parameter is given as NAME=VALUE,VALUE...")
    if name not in PARAMETERS:
        raise UserError(f"{name}: no such parameter; known: {', '.join(PARAMETERS)}")
    values: list[Any] = []
    for word in listed.split(","):
        first, dots, last = word.partition("..")
        try:
            ends = [PARAMETERS[name].read(end) for end in ([first, last] if dots else [first])]
            values += _between(*ends) if dots else ends
        except ValueError as problem:
            raise UserError(f"{name}={word}: {problem}") from None
    return name, list(dict.fromkeys(values))


def _between(first: Any, last: Any) -> range:
    if not all(isinstance(end, int) and not isinstance(end, bool) for end in (first, last)):
        raise ValueError("a range is of whole numbers")
    if not 0 <= last - first < LARGEST_RANGE:
        raise ValueError("is no range that rises, or too long a one")
    return range(first, last + 1)


# ---- jobs ----


def jobs(names: list[str], given: list[str], cores: list[str]) -> list[Job]:
    """Every combination of scenes and values once, in the order of the scenes and the parameters."""
    wished: dict[str, list[Any]] = {}
    for text in given:
        name, values = read_values(text)
        if name in wished:
            raise UserError(f"{name}: given twice")
        wished[name] = values
    wished["core"] = list(dict.fromkeys(cores)) or [""]
    files = [(name, scene.find(name)) for name in dict.fromkeys(names)]
    count = len(files) * math.prod(map(len, wished.values()))
    if count > LARGEST_SWEEP:
        raise UserError(f"{count:,} rows: at most {LARGEST_SWEEP:,}")
    found: dict[tuple[Any, ...], Job] = {}
    for _, path in files:
        for job in _of_scene(path, wished):
            if found.setdefault(job.key, job).digest != job.digest:
                raise UserError(f"{path}: a scene of another content has the same name")
    return list(found.values())


def _of_scene(path: Path, wished: dict[str, list[Any]]) -> Iterator[Job]:
    loaded = scene.load(path)
    if any(spring.stiffness is None for spring in loaded.springs):
        raise UserError(f"{path}: springs by frequency: a sweep takes those by stiffness only")
    text = path.read_text(encoding="utf-8-sig")
    digest = hashlib.sha256(text.encode()).hexdigest()[:8]
    own = {
        **{name: parameter.default for name, parameter in PARAMETERS.items()},
        **{"solver": loaded.solver, "substeps": loaded.substeps, "passes": loaded.passes},
        **{"rate": loaded.steps_per_second, "sleep": loaded.sleep, "quadtree": loaded.broad_phase == "quadtree"},
    }
    for combination in product(*wished.values()):
        settings = Settings(**own | dict(zip(wished, combination, strict=True)))
        yield Job(path.stem, text, digest, _told_apart(settings))


def _told_apart(settings: Settings) -> Settings:
    """Without what has no effect, so that one run is one row."""
    unused = {"passes": 0} if settings.solver == "soft" else {"substeps": 0}
    if settings.seed == 0:
        unused["jitter"] = 0.0
    # Only fixed point runs on a core.
    return replace(settings, **unused, core="" if settings.engine == "f64" else settings.core)


# ---- scenes ----


def changed(job: Job) -> str:
    """The scene file's text with the settings in it."""
    data, settings = json.loads(job.text), job.settings
    data["gravity"] = [settings.gravity * part for part in data.get("gravity", (0.0, -10.0))]
    data["steps_per_second"] = settings.rate
    data["solver"] = settings.solver
    data["sleep"] = settings.sleep
    data["broad_phase"] = "quadtree" if settings.quadtree else "pairs"
    if settings.solver == "soft":
        data["substeps"] = settings.substeps
    else:
        data["passes"] = settings.passes
    _scale_springs(data.get("springs", []), job)
    _scale_bodies(data["bodies"], settings)
    if settings.friction != 1.0:
        _scale_friction(data, settings.friction)
    return json.dumps(data)


def _scale_bodies(bodies: list[dict[str, Any]], settings: Settings) -> None:
    moving = [body for body in bodies if body.get("type") != "static"]
    moves = np.random.default_rng(settings.seed).uniform(-1.0, 1.0, (len(moving), 2)) * settings.jitter
    for body, move in zip(moving, moves, strict=True):
        if settings.mass != 1.0:
            body["density"] = settings.mass * body.get("density", 1.0)
        if settings.seed != 0:
            body["position"] = [float(at + by) for at, by in zip(body["position"], move, strict=True)]


def _scale_springs(springs: list[dict[str, Any]], job: Job) -> None:
    """Each keeps the rest length that it has as placed in the file."""
    own = scene.parse(job.text, Path(job.scene)).springs if job.settings.seed != 0 and springs else []
    for spring, placed in zip_longest(springs, own):
        spring["stiffness"] *= job.settings.stiffness
        spring["damping"] = job.settings.damping * spring.get("damping", 0.0)
        if placed:
            spring["rest_length"] = placed.rest_length


def _scale_friction(data: dict[str, Any], factor: float) -> None:
    """The presets become materials of the file, which may redefine them."""
    presets = {name: asdict(preset) for name, preset in scene.PRESETS.items()}
    data["materials"] = presets | data.get("materials", {})
    for material in data["materials"].values():
        for kind in ("static_friction", "kinetic_friction"):
            material[kind] *= factor
