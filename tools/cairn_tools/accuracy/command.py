"""The verb `accuracy`: which part was asked for, and its tables, plots or JSON."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from types import ModuleType
from typing import Annotated, Any

import typer
from rich.table import Table

from .. import peers as peers_module
from .. import scene
from ..bench_tables import print_markdown
from ..errors import UserError
from ..terminal import Core, JsonOption, bar, folder, out, working
from . import arithmetic as arithmetic_module
from . import error_time
from . import integrators as integrators_module
from . import smooth as smooth_module
from . import tables as tables_module

PARTS = (arithmetic_module, smooth_module, integrators_module)

PEERS_AS_RUN = (
    "Chipmunk lets bodies overlap by its slop, set to 5 mm (by default 0.1 m, meant for pixels), and Box2D by 5 mm of "
    "slop, less the skins of 10 mm that its polygons have, so that its crates hover. Box2D makes 3 position iterations "
    "to 8 velocity iterations. What else they run with, `tools/cairn bench --peers` tells.",
)


def accuracy(
    arithmetic: Annotated[bool, typer.Option("--arithmetic", help="Only the primitives, in LSB.")] = False,
    exhaustive: Annotated[bool, typer.Option(help="With --arithmetic: all arguments anew, in minutes; kept.")] = False,
    smooth: Annotated[bool, typer.Option("--smooth", help="Only the smooth scenes, in metres.")] = False,
    integrators: Annotated[bool, typer.Option("--integrators", help="Only the two ways to integrate.")] = False,
    scene_name: Annotated[list[str] | None, typer.Option("--scene", help="Names or files.")] = None,
    core: Annotated[list[Core] | None, typer.Option(help="Default: m0 m3.")] = None,
    peers: Annotated[bool, typer.Option("--peers", help="Chipmunk and Box2D too; fetches their sources.")] = False,
    plot: Annotated[Path | None, typer.Option(metavar="DIR", help="Draw it too.")] = None,
    markdown: Annotated[bool, typer.Option("--markdown", help="Tables as docs/ACCURACY.md has them.")] = False,
    as_json: JsonOption = False,
) -> None:
    """How wrong it is at what cost: error against run time; or the arithmetic in LSB, or smooth scenes in metres."""
    chosen = [part for part, wished in zip(PARTS, (arithmetic, smooth, integrators), strict=True) if wished]
    show = print_markdown if markdown else out.print
    if exhaustive and not arithmetic:
        raise UserError("--exhaustive goes with --arithmetic")
    if chosen:
        if len(chosen) > 1 or scene_name or core or peers or (plot and not integrators):
            raise UserError("--arithmetic, --smooth and --integrators are alone, with --markdown or --json")
        rows = _print_part(chosen[0], exhaustive, as_json, show)
        if plot:
            integrators_module.plot(rows, folder(plot) / "integrators.png")
        return
    cores = [c.value for c in core or ()] or list(error_time.CORES)
    if peers and (unfit := [name for name in cores if name not in peers_module.CORES]):
        raise UserError(f"--peers runs on {' '.join(peers_module.CORES)}, not on {unfit[0]}")
    place = folder(plot) if plot else None
    scenes = [error_time.of(scene.load(scene.find(name))) for name in dict.fromkeys(scene_name or error_time.SCENES)]
    with bar("error against run time") as say:
        rows = error_time.measure(scenes, cores, peers, say)
    if place:
        # Drawing is slow to load: only who asks for it waits.
        from .plot import write

        write(rows, place)
    if as_json:
        print(json.dumps(tables_module.record(rows), indent=2))
        return
    for grid in tables_module.tables(rows):
        show(grid)
    for line in [*tables_module.sentences(rows), *(PEERS_AS_RUN if peers else ())]:
        print(f"- {line}")


def _print_part(part: ModuleType, anew: bool, as_json: bool, show: Callable[[Table], None]) -> list[Any]:
    with working(f"accuracy: {part.__name__.rpartition('.')[2]}") as say:
        rows = part.measure_anew(say) if anew else part.measure(say)
    if as_json:
        print(json.dumps([tables_module.finite(asdict(row)) for row in rows], indent=2))
        return rows
    for grid in part.tables(rows):
        show(grid)
    return rows
