"""Plots of error against run time: a figure a scene, a column a core, a row a measure."""

from __future__ import annotations

import math
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import EngFormatter, LogLocator, NullFormatter

from .error_time import MEASURES, RATES, front, value
from .rows import Row
from .tables import groups

COLOURS = dict(zip(RATES, ("tab:cyan", "tab:blue", "tab:purple", "tab:pink"), strict=True))
PEERS = {"chipmunk": ("tab:orange", "s"), "box2d": ("tab:red", "D")}
SOLVERS = {"slides": "^", "small": "v"}  # beside the soft one
FLOOR = 1e-6  # metres: what is nearer to 0, below the resolution of the positions, is drawn here


def write(rows: list[Row], folder: Path) -> list[Path]:
    """One file a scene."""
    by_scene: dict[str, list[list[Row]]] = {}
    for group in groups(rows):
        by_scene.setdefault(group[0].scene, []).append(group)
    return [_figure(name, of_scene, folder / f"error-time-{name}.png") for name, of_scene in by_scene.items()]


def _figure(name: str, of_cores: list[list[Row]], file: Path) -> Path:
    rows = [row for group in of_cores for row in group]
    measures = [m for m in MEASURES if any(math.isfinite(value(row, m)) and value(row, m) > 0 for row in rows)]
    figure, grid = plt.subplots(len(measures), len(of_cores), squeeze=False, sharey="row", layout="constrained",
                                figsize=(5.2 * len(of_cores), 3.1 * len(measures) + 0.9))  # fmt: skip
    for i, measure in enumerate(measures):
        for axes, group in zip(grid[i], of_cores, strict=True):
            _points(axes, group, measure)
            axes.grid(alpha=0.3)
            if i == 0:
                axes.set_title(f"{name} on {group[0].core}")
            if i == len(measures) - 1:
                axes.set_xlabel("instructions a 1/60 s of simulated time")
        grid[i][0].set_ylabel(_label(measure, of_cores[0][0]), fontsize=9)
    figure.legend(handles=_legend(rows), loc="outside lower center", ncols=2 * len(of_cores), fontsize=8)
    figure.savefig(file, dpi=100)
    plt.close(figure)
    return file


def _label(measure: str, row: Row) -> str:
    text = MEASURES[measure]
    if measure == "rms_error":
        text = f"position error, RMS to {row.compared_seconds:.2g} s"
    return f"{text}, m"


def _points(axes: Axes, group: list[Row], measure: str) -> None:
    axes.set(xscale="log", yscale="log")
    axes.margins(x=0.1)
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.xaxis.set_major_formatter(EngFormatter(sep=""))
    axes.xaxis.set_minor_formatter(NullFormatter())
    known = [row for row in group if math.isfinite(value(row, measure))]
    own = [row for row in known if row.settings.engine == "cairn"]
    for row in own:
        colour = COLOURS.get(row.settings.steps_per_second, "0.5")
        marker = SOLVERS.get(row.settings.solver, "P" if row.settings.sleep else "o")
        faint = 0.45 if row.settings.solver in SOLVERS else 1.0
        axes.plot(*_place(row, measure), marker, color=colour, ms=5, alpha=faint, zorder=3)
    if any(value(row, measure) < FLOOR for row in known):
        axes.annotate("0", (0.0, FLOOR), xycoords=("axes fraction", "data"), xytext=(4, -3), textcoords="offset points")
    best = front(own, measure)
    axes.plot(*zip(*(_place(row, measure) for row in best), strict=True), "-", color="0.4", lw=1, zorder=2)
    for row in best:
        if row.settings.solver == "soft" and not row.settings.sleep:
            _note(axes, row, measure, str(row.settings.substeps))
    for row in own:
        if row.is_default:
            axes.plot(*_place(row, measure), "*", color="gold", mec="k", ms=15, zorder=4)
            axes.axvline(row.instructions_per_frame, color="gold", lw=0.8, zorder=1)
            axes.axhline(max(value(row, measure), FLOOR), color="gold", lw=0.8, zorder=1)
    for row in known:
        if row.settings.engine != "cairn":
            colour, marker = PEERS[row.settings.engine]
            axes.plot(*_place(row, measure), marker, color=colour, ms=6, zorder=3)
            _note(axes, row, measure, f"{row.settings.passes}{_at_rate(row)}")


def _note(axes: Axes, row: Row, measure: str, text: str) -> None:
    axes.annotate(text, _place(row, measure), xytext=(4, 3), textcoords="offset points", fontsize=7)


def _at_rate(row: Row) -> str:
    rate = row.settings.steps_per_second
    return "" if rate == 60 else f"@{rate}"


def _place(row: Row, measure: str) -> tuple[float, float]:
    return row.instructions_per_frame, max(value(row, measure), FLOOR)


def _legend(rows: list[Row]) -> list[Line2D]:
    def mark(marker: str, colour: str, label: str, **more: object) -> Line2D:
        return Line2D([], [], marker=marker, color=colour, label=label, **{"ls": "", **more})

    handles = [mark("*", "gold", "Cairn's default", mec="k", ms=12)]
    handles += [mark("", "0.4", "Pareto front of Cairn: sub-steps", ls="-")]
    handles += [mark("o", colour, f"Cairn, {rate} steps a second") for rate, colour in COLOURS.items()]
    handles += [mark("P", COLOURS[60], "with sleep")]
    names = {"slides": "the slides' solver", "small": "the small solver"}
    handles += [mark(SOLVERS[solver], COLOURS[60], name, alpha=0.45) for solver, name in names.items()]
    named = {row.settings.engine for row in rows}
    notes = {"chipmunk": "Chipmunk, iterations", "box2d": "Box2D, velocity iterations"}
    return handles + [mark(PEERS[name][1], PEERS[name][0], text) for name, text in notes.items() if name in named]
