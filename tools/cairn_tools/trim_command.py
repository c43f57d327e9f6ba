"""The verb `trim`: a build of Cairn that has what given scenes need, and no more."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from . import trim, trim_files
from .errors import UserError
from .terminal import JsonOption, SolverOption, out, working


def command(
    scene_files: Annotated[
        list[str], typer.Argument(metavar="SCENE.json...", help="Or names in examples/scenes; recorded runs, *.jsonl.")
    ],
    folder: Annotated[Path, typer.Option("--out", metavar="DIR", help="Where the files go.")],
    steps: Annotated[int, typer.Option(min=1, max=100_000, help="How long each scene is run.")] = 600,
    margin: Annotated[float, typer.Option(min=0, max=1000, help="Percent beyond the most that the runs needed.")] = 20,
    tolerance: Annotated[
        float | None, typer.Option(help="Metres: the fewest sub-steps within it of the double build at 16 sub-steps.")
    ] = None,
    solver: SolverOption = None,
    keep: Annotated[list[str] | None, typer.Option(help="Features that the game uses beside the scenes.")] = None,
    flash: Annotated[int | None, typer.Option(min=1, help="Bytes allowed.")] = None,
    ram: Annotated[int | None, typer.Option(min=1, help="Bytes allowed.")] = None,
    as_json: JsonOption = False,
) -> None:
    """Write config header, tables, pools and a CMake fragment for scenes; the M0 shows that the bits stay the same."""
    known = [name.lower() for name in trim.FEATURES]
    if unknown := next((name for name in keep or () if name not in known), None):
        raise UserError(f"--keep {unknown}: no such feature; known: {', '.join(known)}")
    if tolerance is not None and not 0 < tolerance < float("inf"):
        raise UserError(f"--tolerance {tolerance:g}: must be above zero")
    if folder.exists() and not folder.is_dir():
        raise UserError(f"{folder}: is no folder")
    scenes = [trim.load(name) for name in scene_files]
    wish = trim.Wish(steps, margin, tolerance, tuple(keep or ()), flash, ram, solver and solver.value)
    with working("trim") as say:
        needs, result = trim.trim(scenes, wish, folder, say)
    if as_json:
        print(json.dumps(trim_files.record(needs, result, wish), indent=2))
        return
    out.print(_sizes(result))
    out.print(_findings(needs))
    out.print(_choices(needs, result, margin))


def _sizes(result: list[trim.Trimmed]) -> Table:
    caption = "M0, gcc -Os -flto: bytes beyond the same image without Cairn, instructions a step.\n"
    caption += "All hashes of trimmed builds are those of all of Cairn with the same settings."
    if len(result) > 1:
        caption += "\nThe trimmed images have what any of the scenes needs, the others what theirs does."
    grid = Table(title="Trimmed", caption=caption)
    for column in ("scene", "build", "flash", "RAM", "step's stack", "mean", "worst", "hash"):
        grid.add_column(column, justify="left" if column in ("scene", "build", "hash") else "right")
    for row in result:
        for what, image in (("all of Cairn", row.before), ("trimmed", row.after)):
            sizes = (image.flash, image.ram, image.stack, image.mean, image.worst)
            grid.add_row(row.name if image is row.before else "", what, *(f"{size:,}" for size in sizes), image.hash)
        grid.add_row("", "saved", f"{row.flash_saved:.0%}", f"{row.ram_saved:.0%}", end_section=True)
    return grid


def _findings(needs: trim.Needs) -> Table:
    grid = Table(title="Found", caption="in all scenes, through all steps")
    for column in ("what", "found", "what comes of it"):
        grid.add_column(column)
    for finding in needs.found:
        grid.add_row(finding.what, finding.found, finding.use)
    return grid


def _choices(needs: trim.Needs, result: list[trim.Trimmed], margin: float) -> Table:
    grid = Table(title="How", caption="in cairn_trim.h and scene.c")
    for column in ("option", "value", "because"):
        grid.add_column(column, justify="right" if column == "value" else "left")
    for row in result:
        off = "as in the file" if row.error is None else f"{row.error:.2g} m off, within the tolerance"
        if row.solver == "soft":
            grid.add_row(f"sub-steps of {row.name}", str(row.substeps), off)
        else:
            grid.add_row(f"passes of {row.name}", str(row.passes), off)
    grid.add_row("pairs by", result[0].broad_phase, "fewest instructions; the quadtree if it saves 2 %")
    for name, value in needs.options.items():
        grid.add_row(name, str(value), needs.why[name])
    for name, count in needs.pools.items():
        fixed = name == "springs" or (name == "bodies" and not needs.comes_and_goes)
        why = "as many as there are" if fixed else f"the most that the runs needed, and {margin:g} %"
        grid.add_row(f"pool of {name}", str(count), why)
    return grid
