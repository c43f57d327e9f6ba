"""Pictures: three sweeps of where things end, and what chosen cases look like at their end."""

from __future__ import annotations

import math
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from ..host import ANGLE, STATIC, World, X, Y
from . import springs
from .build import floor, stack
from .cases import CASES
from .heavy import column
from .measure import moved
from .model import Bench
from .report import OTHER_SOLVERS

SUBSTEPS = (1, 2, 3, 4, 6, 8, 12, 16)
RATIOS = tuple(10 ** (k / 2) for k in range(11))
STIFFNESSES = tuple(10 ** (2 + k / 2) for k in range(13))
TALLEST = 64
# One of each kind, for the sheet of pictures.
SHOWN = (
    *("stack20-offset", "pyramid-of-210", "tower", "card-house", "arch", "dominoes", "bridge", "heavy-100-0.3"),
    *("alternating-100", "slab-100-4", "drops", "curtain-100", "rope-1000", "square-1000", "gas-3", "one-point"),
)


def tallest(engine: str, solver: str, substeps: int, offset: bool) -> int:
    """The largest stack of unit boxes that stands a minute: no box half its size from its place sideways."""

    def stands(count: int) -> bool:
        world = Bench(engine, solver).world(substeps=substeps)
        floor(world)
        stack(world, count, offset=offset)
        return moved(world.record(3600, 20), axes=(X,)) < 0.5

    low, high = 1, 2
    while high <= TALLEST and stands(high):
        low, high = high, 2 * high
    high = min(high, TALLEST + 1)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if stands(middle) else (low, middle)
    return low


def penetration(engine: str, solver: str, substeps: int, ratio: float) -> float:
    """Of a box of this mass on one of 1; not a number where it falls off or in."""
    states, depth = column(Bench(engine, solver), [1.0, ratio], substeps=substeps)
    return depth if moved(states) < 0.5 else math.nan


def sag_error(engine: str, stiffness: float, zeta: float) -> float:
    """Of the curtain, relative to statics."""
    figures = springs.curtain_of(Bench(engine), stiffness, zeta)
    return next(figure.value for figure in figures if figure.what.startswith("sag"))


def write(folder: Path, workers: int) -> list[Path]:
    """Draws all of them into the folder."""
    with ProcessPoolExecutor(workers) as pool:
        files = [_draw(folder / "height.png", pool, _height), _draw(folder / "ratio.png", pool, _ratio)]
        files += [_draw(folder / "stiffness.png", pool, _stiffness)]
    files.append(_sheet(folder / "cases.png"))
    return files


def _draw(file: Path, pool: ProcessPoolExecutor, plot: Callable[[Axes, ProcessPoolExecutor], None]) -> Path:
    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    plot(axes, pool)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    figure.savefig(file, dpi=100)
    plt.close(figure)
    return file


def _height(axes: Axes, pool: ProcessPoolExecutor) -> None:
    for engine in ("q16", "f64"):
        for offset in (False, True):
            heights = list(pool.map(tallest, *zip(*((engine, "soft", n, offset) for n in SUBSTEPS), strict=True)))
            label = f"{engine}, {'offset 2 cm' if offset else 'aligned'}"
            axes.plot(SUBSTEPS, heights, "o" if engine == "q16" else "x", ls=":" if offset else "-", label=label)
    for (solver, name), style in zip(OTHER_SOLVERS.items(), ("-", "-."), strict=True):
        axes.axhline(tallest("q16", solver, 1, False), color="0.5", ls=style, label=f"{name}, 10 passes, aligned")
    axes.set(xlabel="sub-steps a step", ylabel=f"boxes that stand 60 s (of {TALLEST} at most)")


def _ratio(axes: Axes, pool: ProcessPoolExecutor) -> None:
    soft = [(engine, "soft", n) for engine, n in (("q16", 4), ("f64", 4), ("q16", 16))]
    for engine, solver, n in (*soft, *(("q16", other, 1) for other in OTHER_SOLVERS)):
        depths = list(pool.map(penetration, *zip(*((engine, solver, n, ratio) for ratio in RATIOS), strict=True)))
        label = f"{engine}, {n} sub-steps" if solver == "soft" else OTHER_SOLVERS[solver]
        axes.loglog(RATIOS, np.array(depths) * 1e3, "o-", label=label)
    axes.axhline(1, color="0.5", ls="--", label="target")
    axes.set(xlabel="mass of the upper box over the lower one's", ylabel="penetration, mm (no point: it falls)")


def _stiffness(axes: Axes, pool: ProcessPoolExecutor) -> None:
    for engine, zeta in (("q16", 0.0), ("q16", 1.0), ("f64", 1.0)):
        errors = list(pool.map(sag_error, *zip(*((engine, k, zeta) for k in STIFFNESSES), strict=True)))
        axes.loglog(STIFFNESSES, np.maximum(errors, 1e-7), "o-", label=f"{engine}, damping ratio {zeta:g}")
    axes.set(xlabel="stiffness of a curtain of 15 x 10 beads of 1 kg, N/m", ylabel="error of its sag against statics")


class _Keeping(Bench):
    """A bench that remembers the last world it gave."""

    def world(self, *arguments: object, **options: object) -> World:
        return self._keep(super().world(*arguments, **options))

    def scene(self, *arguments: object) -> World:
        return self._keep(super().scene(*arguments))

    def _keep(self, world: World) -> World:
        object.__setattr__(self, "last", world)
        return world


def _sheet(file: Path) -> Path:
    """One small picture of each kind of case, at its end."""
    figure, grid = plt.subplots(4, 4, figsize=(10, 9), layout="constrained")
    for axes, name in zip(grid.flat, SHOWN, strict=True):
        entry, bench = CASES[name], _Keeping("q16")
        for _ in entry.check(bench, **entry.arguments):
            pass
        _picture(axes, bench.last)
        axes.set_title(name, fontsize=8)
    figure.savefig(file, dpi=80)
    plt.close(figure)
    return file


def _picture(axes: Axes, world: World) -> None:
    bodies = list(world.shapes)
    states = world.states(bodies)
    moving = np.array([world.types[body] != STATIC for body in bodies])
    for body, state in zip(bodies, states, strict=True):
        shape = world.shapes[body]
        colour = "0.75" if world.types[body] == STATIC else "tab:blue"
        if shape.corners is None:
            axes.add_patch(plt.Circle((state[X], state[Y]), shape.radius, fc=colour, ec="k", lw=0.4))
            continue
        c, s = math.cos(state[ANGLE]), math.sin(state[ANGLE])
        corners = shape.corners @ np.array([[c, s], [-s, c]]) + state[[X, Y]]
        axes.add_patch(plt.Polygon(corners, fc=colour, ec="k", lw=0.4))
    low, high = states[moving][:, [X, Y]].min(axis=0), states[moving][:, [X, Y]].max(axis=0)
    reach = max(float((high - low).max()) / 2 + 1.0, 1.5)
    middle = (low + high) / 2
    axes.set(xlim=(middle[0] - reach, middle[0] + reach), ylim=(middle[1] - reach, middle[1] + reach), aspect="equal")
    axes.set_xticks([])
    axes.set_yticks([])
