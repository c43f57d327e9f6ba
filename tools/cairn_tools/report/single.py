"""The parts of `accuracy` that are one measurement and its tables: arithmetic, smooth scenes, integrators."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from types import ModuleType
from typing import Any

from ..accuracy import arithmetic, integrators, smooth
from .model import BAD, GOOD, Figure, Options, Part, Section, Task, grid_of
from .pictures import of_files


@dataclass(frozen=True)
class Single:
    """A module that has measure() and tables(), perhaps plot(), and what is told of it."""

    module: ModuleType
    title: str
    finding: Callable[[list[Any]], tuple[str, str]]  # and its tone
    meaning: str
    weight: float
    quick: dict[str, Any] = field(default_factory=dict)  # what measure() takes for a quick report


def _of_arithmetic(rows: list[Any]) -> tuple[str, str]:
    ours = [row for row in rows if row.bound is not None]  # libfixmath's have none
    return _passing(ours, "operations stay within the error that is stated and asked of them.")


def _of_smooth(rows: list[Any]) -> tuple[str, str]:
    return _passing(rows, "families of scenes stay within the rounding that is asked of them.")


def _passing(rows: list[Any], what: str) -> tuple[str, str]:
    held = sum(row.passes for row in rows)
    return f"{held} of {len(rows)} {what}", GOOD if held == len(rows) else BAD


def _of_integrators(points: list[integrators.Point]) -> tuple[str, str]:
    euler, other = ([p for p in points if p.method == method] for method in integrators.METHODS)
    pairs = [(a, b) for a, b in zip(euler, other, strict=True) if b.rms_error < a.rms_error]
    if not pairs:
        return "Adams-Bashforth 2 is nowhere nearer to right than symplectic Euler.", ""
    at = pairs[0][0].steps_per_second
    last = [next((p.steps_per_second for p in own if p.energy_ratio < 2), 0) for own in (euler, other)]
    return (f"Adams-Bashforth 2 is nearer to right from {at} steps a second on; it keeps its energy below twice the "
            f"start's from {last[1]} steps a second, symplectic Euler from {last[0]}.", "")  # fmt: skip


SINGLES = {
    "arithmetic": Single(
        arithmetic, "Arithmetic", _of_arithmetic,
        "The error of each primitive in units of its last bit, at its worst argument.", 60,
    ),
    "smooth": Single(
        smooth, "Smooth scenes", _of_smooth,
        "Motion without chaos, where fixed point can be compared with double, and both with a closed form.", 10,
        {"scenes": 2},
    ),
    "integrators": Single(
        integrators, "Two ways to integrate", _of_integrators,
        "Why the engine stays with symplectic Euler: it keeps the energy of what swings within bounds for ever, and "
        "that is what a game sees.", 3, {"rates": (60, 240, 960)},
    ),
}  # fmt: skip


def _measured(key: str, quick: bool) -> tuple[list[Any], list[Figure]]:
    single = SINGLES[key]
    rows = single.module.measure(lambda text: None, **(single.quick if quick else {}))
    draw = getattr(single.module, "plot", None)
    return rows, of_files([single.title], lambda folder: [draw(rows, folder / "plot.png")]) if draw else []


def _part(key: str) -> Part:
    single, command = SINGLES[key], f"tools/cairn accuracy --{key}"

    def section(results: list[tuple[list[Any], list[Figure]]]) -> Section:
        ((rows, figures),) = results
        finding, tone = single.finding(rows)
        grids = [grid_of(table) for table in single.module.tables(rows)]
        return Section(key, single.title, command, finding, single.meaning, tone, grids, figures, rows)

    def tasks(options: Options) -> list[Task]:
        return [Task(single.title.lower(), _measured, (key, options.quick), single.weight)]

    return Part(key, single.title, command, tasks, section)


PARTS = {key: _part(key) for key in SINGLES}
