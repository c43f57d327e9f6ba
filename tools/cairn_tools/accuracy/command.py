"""The verb `accuracy`: which part was asked for, and its tables, plots or JSON."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Table

from .. import scene
from ..errors import UserError
from ..terminal import Core, JsonOption, bar, folder, out, working
from . import arithmetic as arithmetic_module
from . import error_time
from . import smooth as smooth_module
from . import tables as tables_module


def accuracy(
    arithmetic: Annotated[bool, typer.Option("--arithmetic", help="Only the primitives, in LSB.")] = False,
    smooth: Annotated[bool, typer.Option("--smooth", help="Only the smooth scenes, in metres.")] = False,
    scene_name: Annotated[list[str] | None, typer.Option("--scene", help="Names or files.")] = None,
    core: Annotated[list[Core] | None, typer.Option(help="Default: m0 m3.")] = None,
    peers: Annotated[bool, typer.Option("--peers", help="Chipmunk and Box2D too; fetches their sources.")] = False,
    plot: Annotated[Path | None, typer.Option(metavar="DIR", help="Draw it too.")] = None,
    as_json: JsonOption = False,
) -> None:
    """How wrong it is at what cost: error against run time; or the arithmetic in LSB, or smooth scenes in metres."""
    if arithmetic or smooth:
        if (arithmetic and smooth) or scene_name or core or peers or plot:
            raise UserError("--arithmetic and --smooth take --json only")
        part = arithmetic_module if arithmetic else smooth_module
        _print_part("arithmetic" if arithmetic else "smooth scenes", part.measure, part.tables, as_json)
        return
    place = folder(plot) if plot else None
    names = dict.fromkeys(scene_name or error_time.SCENES)
    scenes = [(scene.load(scene.find(name)), error_time.SCENES.get(name, error_time.SECONDS)) for name in names]
    with bar("error against run time") as say:
        rows = error_time.measure(scenes, [c.value for c in core or ()] or list(error_time.CORES), peers, say)
    if place:
        # Drawing is slow to load: only who asks for it waits.
        from .plot import write

        write(rows, place)
    if as_json:
        print(json.dumps(tables_module.record(rows), indent=2))
        return
    for grid in tables_module.tables(rows):
        out.print(grid)
    for line in tables_module.sentences(rows):
        print(line)


def _print_part(
    what: str, measure: Callable[[Any], list[Any]], tables: Callable[[list[Any]], list[Table]], as_json: bool
) -> None:
    with working(what) as say:
        rows = measure(say)
    if as_json:
        print(json.dumps([asdict(row) for row in rows], indent=2))
        return
    for grid in tables(rows):
        out.print(grid)
