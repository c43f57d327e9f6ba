"""The parts that say how wrong a scene is: three errors, error against run time."""

from __future__ import annotations

import math
from typing import Any

from .. import compare, compare_command, scene
from ..accuracy import error_time, rows, tables
from ..accuracy.command import PEERS_AS_RUN
from .model import BAD, GOOD, OPEN, Cell, Figure, Grid, Options, Part, Section, Task, grid_of
from .pictures import of_files


def _quiet(*_: Any) -> None:
    """Tasks run in other processes: the bar moves when they end."""


# ---- three errors ----

# Smooth scenes first, then what stands, then what falls apart into chaos; steps of each.
COMPARED = {"projectile": 120, "spring": 120, "rolling": 120, "bounce": 120, "stack10": 120, "pyramid10": 120,
            "tower": 120, "curtain150": 120, "mixed50": 60, "bridge": 60}  # fmt: skip


def _error_tasks(options: Options) -> list[Task]:
    names = ("bounce", "rolling") if options.quick else COMPARED
    return [Task(f"three errors of {name}", _comparison, (name, COMPARED[name]), 10) for name in names]


COMPARED_TO = (
    "Over what moves and over all steps to the one it is compared to: beyond, two runs that start a last bit apart "
    "have separated, chaos decides where a body is, and only energies, heights and depths are compared (tools/cairn "
    "compare SCENE)."
)


def _comparison(name: str, steps: int) -> compare.Comparison:
    return compare.compare(scene.load(scene.find(name)), steps, _quiet)


def _errors(found: list[compare.Comparison]) -> Section:
    kinds = [*compare.ERRORS, "total"]
    columns = ["scene", "reference", "compared to step", *kinds]
    right = [name not in ("scene", "reference") for name in columns]
    title = "Errors of position in metres: the largest (RMS)"
    grid = Grid(title, columns, right, [_error_row(one, kinds) for one in found], COMPARED_TO)
    rounded = [one.scene for one in found if _is_rounding(one)]
    but = f": not in {', '.join(rounded)}" if rounded else ""
    return Section(
        key="errors",
        title="Three errors, told apart",
        command="tools/cairn compare SCENE",
        finding=f"Rounding is at most a tenth of the total error, or the total is below 0.1 mm, in "
        f"{len(found) - len(rounded)} of {len(found)} scenes{but}.",
        meaning="Rounding: what fixed point does to the same algorithm in double; only a wider format would lower it. "
        "Solver: what the passes leave of the constraints; more sub-steps lower it. Time step: what remains with all "
        "constraints solved; more steps a second lower it. The reference is a closed form or an oracle that shares no "
        "code with the engine.",
        tone=OPEN if rounded else GOOD,
        grids=[grid],
        data=[compare_command.record(one) for one in found],
    )


def _is_rounding(one: compare.Comparison) -> bool:
    """Whether rounding is more than a tenth of a total that is above 0.1 mm."""
    total = one.overall.get("total")
    if total is None:
        return True
    return total.max_position > 1e-4 and one.overall["rounding"].max_position > 0.1 * total.max_position


def _error_row(one: compare.Comparison, kinds: list[str]) -> list[Cell]:
    step = f"{one.horizon.step}{', then chaos' if one.horizon.chaotic else ''}"
    sizes = (_largest(one.overall.get(kind)) for kind in kinds)
    return [Cell(text) for text in (one.scene, one.reference, step, *sizes)]


def _largest(error: compare.Difference | None) -> str:
    return f"{error.max_position:.1e} ({error.rms_position:.1e})" if error else "-"


# ---- error against run time ----

Drawn = tuple[list[rows.Row], list[Figure]]
QUICK = ("bounce", 0.5, ("m0",), (rows.Settings(), rows.Settings(substeps=8)))


def _time_tasks(options: Options) -> list[Task]:
    if options.quick:
        name, seconds, cores, chosen = QUICK
        return [Task("error against run time", _points_alone, (name, seconds, cores, chosen), 3)]
    weight = 60 if options.peers else 20
    return [Task(f"error against run time of {name}", _points, (name, seconds, options.peers), weight)
            for name, seconds in error_time.SCENES.items()]  # fmt: skip


def _points_alone(name: str, seconds: float, cores: tuple[str, ...], chosen: tuple[rows.Settings, ...]) -> Drawn:
    loaded = scene.load(scene.find(name))
    return _drawn([rows.measure(loaded, settings, core, seconds) for core in cores for settings in chosen])


def _points(name: str, seconds: float, peers: bool) -> Drawn:
    loaded = scene.load(scene.find(name))
    return _drawn(error_time.measure([(loaded, seconds)], list(error_time.CORES), peers, _quiet))


def _drawn(measured: list[rows.Row]) -> Drawn:
    from ..accuracy import plot

    names = dict.fromkeys(row.scene for row in measured)
    return measured, of_files(list(names), lambda folder: plot.write(measured, folder))


def _times(drawn: list[Drawn]) -> Section:
    measured = [row for own, _ in drawn for row in own]
    lines = tables.sentences(measured)
    short = [line for line in lines if "NOT" in line]
    told = [[Cell(line, BAD if line in short else GOOD)] for line in lines]
    summary = Grid("Cairn's default beside the peers", ["what"], [False], told, " ".join(PEERS_AS_RUN))
    return Section(
        key="error-time",
        title="Error against run time",
        command=f"tools/cairn accuracy{' --peers' if lines else ''} --plot DIR",
        finding=_finding(measured, lines, short),
        meaning="Each point is a run of two to four seconds: to the left is cheaper, below is nearer to right. The "
        "star is the default, 4 sub-steps at 60 steps a second; the line joins the settings that no other beats, with "
        "their sub-steps. Choose on that line: to the left until the error is as large as the game bears.",
        tone=OPEN if short else GOOD if lines else "",
        grids=[*([summary] if lines else []), *map(grid_of, tables.tables(measured))],
        figures=[figure for _, own in drawn for figure in own],
        data=tables.record(measured),
    )  # fmt: skip


def _finding(measured: list[rows.Row], lines: list[str], short: list[str]) -> str:
    if lines:
        held = len(lines) - len(short)
        return (f"By {held} of {len(lines)} measures of scenes and cores the default is cheaper and nearer to right "
                "than every point of Chipmunk and Box2D.")  # fmt: skip
    group = [row for row in measured if (row.scene, row.core) == (measured[0].scene, measured[0].core)]
    default = next(row for row in group if row.is_default)
    finer = next((row for row in group if _is_finer(row.settings, default.settings)), default)
    more = finer.instructions_per_frame / default.instructions_per_frame
    return (f"Twice the sub-steps cost {more:.2f} times the instructions in {default.scene}, and take the deepest "
            f"penetration from {_millimetres(default)} to {_millimetres(finer)}.")  # fmt: skip


def _is_finer(settings: rows.Settings, default: rows.Settings) -> bool:
    doubled = {**vars(default), "substeps": 2 * default.substeps}
    return vars(settings) == doubled


def _millimetres(row: rows.Row) -> str:
    depth = row.errors.penetration
    return "nothing" if math.isnan(depth) else f"{1000 * depth:.2g} mm"


ERRORS = Part("errors", "Three errors, told apart", "tools/cairn compare SCENE", _error_tasks, _errors)
ERROR_TIME = Part("error-time", "Error against run time", "tools/cairn accuracy", _time_tasks, _times)
