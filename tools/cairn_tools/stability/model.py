"""What a case is: a function that sets a world up, runs it and yields figures, each with the most it may be."""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from itertools import product
from typing import Any

from ..host import World
from ..scene import Scene

ENGINES = ("q16", "f64")


@dataclass(frozen=True)
class Figure:
    """A measured number and its limit. A stretch target is shown and does not decide."""

    what: str
    value: float
    limit: float
    unit: str = ""
    least: bool = False  # the limit is the least and not the most
    stretch: bool = False

    @property
    def ok(self) -> bool:
        # Not a number is never good.
        return self.value >= self.limit if self.least else self.value <= self.limit


def most(what: str, value: float, limit: float, unit: str = "") -> Figure:
    return Figure(what, float(value), limit, unit)


def least(what: str, value: float, limit: float, unit: str = "") -> Figure:
    return Figure(what, float(value), limit, unit, least=True)


def stretch(what: str, value: float, limit: float, unit: str = "") -> Figure:
    return Figure(what, float(value), limit, unit, stretch=True)


@dataclass(frozen=True)
class Bench:
    """Under which arithmetic and solver a case runs: it gives the worlds."""

    engine: str
    solver: str = "soft"
    passes: int = 10

    def world(self, gravity: tuple[float, float] = (0.0, -10.0), substeps: int = 4, **sizes: Any) -> World:
        """An empty world at the engine's default settings, but for the sub-steps."""
        world = World(self.engine, gravity, **sizes)
        world.set_substeps(substeps)
        self.choose_solver(world)
        return world

    def choose_solver(self, world: World) -> None:
        choices = {"slides": world.use_slides_solver, "small": world.use_small_solver}
        if self.solver in choices:
            choices[self.solver](self.passes)

    def scene(self, scene: Scene) -> World:
        """A scene file's world under this solver."""
        from ..host import build

        world, _ = build(scene, self.engine)
        self.choose_solver(world)
        return world


Check = Callable[..., Iterable[Figure]]


@dataclass(frozen=True)
class Case:
    name: str
    row: str  # of the table, or what it states
    check: Check
    arguments: dict[str, Any] = field(default_factory=dict)
    peers: str = ""  # the best published figure of other engines
    quick: bool = False
    engines: tuple[str, ...] = ENGINES
    baseline: bool = False  # shown under the other solvers too


@dataclass(frozen=True)
class Result:
    case: str
    engine: str
    solver: str
    figures: list[Figure]
    seconds: float
    error: str = ""

    @property
    def ok(self) -> bool:
        return not self.error and all(figure.ok or figure.stretch for figure in self.figures)

    @property
    def decides(self) -> bool:
        """The other solvers are there to compare with: they may fall."""
        return self.solver == "soft"


CASES: dict[str, Case] = {}


def case(
    row: str, name: str = "", peers: str = "", over: dict[str, Iterable[Any]] | None = None, **options: Any
) -> Any:
    """Makes the decorated function a case, named after it; `over` makes one case of each combination of arguments."""

    def register(check: Check) -> Check:
        keys, values = list(over or {}), product(*(over or {}).values())
        for combination in values:
            arguments = dict(zip(keys, combination, strict=True))
            base = name or check.__name__.replace("_", "-")
            full = "-".join([base, *(_word(value) for value in combination)])
            if full in CASES:
                raise ValueError(f"two cases are named {full}")
            CASES[full] = Case(full, row.format(**arguments), check, arguments, peers, **options)
        return check

    return register


def _word(value: Any) -> str:
    if value == float("inf"):
        return "limit"
    if isinstance(value, float):
        return f"{value:g}".replace("e+0", "e")
    return str(value)


def run(name: str, engine: str, solver: str = "soft") -> Result:
    """Runs one case. What breaks in it is its result."""
    entry = CASES[name]
    start = time.perf_counter()
    figures: list[Figure] = []
    error = ""
    try:
        for figure in entry.check(Bench(engine, solver), **entry.arguments):
            figures.append(figure)
    except Exception as problem:  # whatever it is, the other cases run on
        where = traceback.extract_tb(problem.__traceback__)[-1]
        error = f"{type(problem).__name__}: {problem} ({where.name}, line {where.lineno})"
    if not figures and not error:
        error = "the case measured nothing"
    return Result(name, engine, solver, figures, time.perf_counter() - start, error)
