"""The verb `compare`: three errors told apart, and the tables or JSON of it."""

from __future__ import annotations

import json
import math
from dataclasses import asdict
from typing import Annotated, Any

import typer
from rich.table import Table

from . import compare as measured
from .compare import Comparison, Difference
from .horizon import LSB, SEPARATED
from .terminal import (
    JsonOption,
    PassesOption,
    SceneArgument,
    SolverOption,
    SubstepsOption,
    load_scene,
    out,
    working,
)


def compare(
    scene_file: SceneArgument,
    steps: Annotated[int, typer.Option(min=1, max=1_000_000)] = 120,
    rounding: Annotated[bool, typer.Option("--rounding", help="Only q16 against f64, without the oracle.")] = False,
    solver: SolverOption = None,
    substeps: SubstepsOption = None,
    passes: PassesOption = None,
    as_json: JsonOption = False,
) -> None:
    """How wrong a run is, and why: rounding, solver, time step, until chaos parts the runs; and what is left then."""
    loaded = load_scene(scene_file, solver, substeps, passes)
    with working(loaded.name) as say:
        got = measured.compare(loaded, steps, say, with_oracle=not rounding)
    if as_json:
        print(json.dumps(record(got), indent=2))
        return
    for grid in tables(got):
        out.print(grid)
    print(horizon_text(got))
    if got.reference:
        print(f"The reference is a {got.reference}.")


def record(got: Comparison) -> dict[str, Any]:
    """For JSON: of the steps, about ten."""
    whole = asdict(got)
    whole["errors"] = {
        name: {"overall": asdict(got.overall[name]), "selected": [asdict(row) for row in measured.selected(rows)]}
        for name, rows in got.errors.items()
    }
    # As programs know it from when rounding was all that was compared.
    whole |= {"engines": ["q16", "f64"], **whole["errors"]["rounding"]}
    for entry in whole["outcomes"]:
        entry["seconds_to_rest"] = None if math.isnan(entry["seconds_to_rest"]) else entry["seconds_to_rest"]
    return whole


def tables(got: Comparison) -> list[Table]:
    """Metres, radians, and what stays comparable."""
    positions = _errors_table(got, "metres", lambda d: (d.rms_position, d.max_position))
    angles = _errors_table(got, "radians", lambda d: (d.rms_angle, d.max_angle))
    return [positions, angles, _outcomes_table(got)]


def _errors_table(got: Comparison, unit: str, values: Any) -> Table:
    grid = Table(title=f"{got.scene}: errors in {unit}, {got.steps} steps", padding=0)  # eighty columns hold it
    for column in ("step", *(f"{name}: {kind}" for name in got.errors for kind in ("rms", "largest"))):
        grid.add_column(column, justify="right")
    chosen = {name: measured.selected(rows) for name, rows in got.errors.items()}
    by_step: list[tuple[Difference, ...]] = list(zip(*chosen.values(), strict=True))
    for row in by_step:
        grid.add_row(str(row[0].step), *(f"{value:.1e}" for d in row for value in values(d)))
    grid.add_section()
    grid.add_row("all", *(f"{value:.1e}" for d in got.overall.values() for value in values(d)))
    return grid


def horizon_text(got: Comparison) -> str:
    twins = ", ".join(f"{pair.engine} {pair.largest:,.0f}" for pair in got.horizon.twins)
    if not got.horizon.chaotic:
        return f"Twins that start 1 LSB ({LSB:.1e} m) away stay together: at most {twins} LSB apart."
    return (
        f"Chaotic beyond step {got.horizon.step}: twins that start 1 LSB away are {1000 * SEPARATED:g} mm apart then, "
        f"and at most {twins} LSB later on."
    )


def _outcomes_table(got: Comparison) -> Table:
    grid = Table(title=f"{got.scene}: what stays comparable, after {got.steps} steps", padding=0)
    columns = ("run", "energy gained, J", "at its highest", "momentum, kg m/s", "deepest penetration, m")
    for column in (*columns, "mean height, m", "top, m", "rests after, s"):
        grid.add_column(column, justify="left" if column == "run" else "right")
    for it in got.outcomes:
        momentum = " ".join(f"{value:.3g}" for value in it.momentum)
        rest = "-" if math.isnan(it.seconds_to_rest) else f"{it.seconds_to_rest:.2f}"
        numbers = (f"{it.energy:.5g}", f"{it.highest_energy:.2g}", momentum, f"{it.deepest_penetration:.2e}")
        grid.add_row(it.run, *numbers, f"{it.mean_height:.5f}", f"{it.top_height:.5f}", rest)
    return grid
