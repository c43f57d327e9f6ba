"""The verb `footprint`: what feature sets take of flash and RAM."""

from __future__ import annotations

import json
from dataclasses import asdict
from time import monotonic
from typing import Annotated

import typer
from rich.table import Table

from . import bench_tables, footprint
from .errors import UserError
from .terminal import Core, JsonOption, hold_to_record, out, working


def command(
    core: Annotated[list[Core] | None, typer.Option(help="Default: m0 m3 m4f.")] = None,
    check: Annotated[bool, typer.Option("--check", help="Hold them to those on record.")] = False,
    keep: Annotated[bool, typer.Option("--keep", help="Put them on record.")] = False,
    markdown: Annotated[bool, typer.Option("--markdown", help="Print the tables as the README has them.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Flash and RAM of tiny games with one feature set each, beyond the same image without Cairn; gcc -Os -flto."""
    cores = tuple(c.value for c in core or ()) or footprint.CORES
    if unfit := [name for name in cores if name not in footprint.CORES]:
        raise UserError(f"footprint builds for {' '.join(footprint.CORES)}, not for {unfit[0]}")
    if core and (keep or check):
        raise UserError("--keep and --check take all cores: leave out --core")
    started = monotonic()
    with working("footprint") as say:
        rows = footprint.measure(cores, say)
    if as_json:
        print(json.dumps([asdict(row) for row in rows], indent=2))
    else:
        for grid in tables(rows):
            (bench_tables.print_markdown if markdown else out.print)(grid)
    if keep:
        footprint.write(rows)
    if check:
        hold_to_record(list(footprint.troubles(rows)), len(rows), started, as_json)


def tables(rows: list[footprint.Row]) -> list[Table]:
    """The sets with their goals, then what each feature adds."""
    cores = list(dict.fromkeys(row.core for row in rows))
    by_name = {(row.core, row.name): row for row in rows}
    sets = Table(title="Footprint", caption="bytes beyond the same image without Cairn; goals are for the M0")
    adds = Table(title="What a feature adds", caption="bytes of flash on top of balls, walls and boxes")
    for grid, columns in ((sets, ("feature set", "bodies, arbiters")), (adds, ("feature",))):
        for column in columns:
            grid.add_column(column)
    for core in cores:
        sets.add_column(f"flash {core}", justify="right")
        adds.add_column(core, justify="right")
    for column in ("flash goal", "RAM", "RAM goal"):
        sets.add_column(column, justify="right")
    for entry in footprint.SETS[1:]:
        of = [by_name[core, entry.name] for core in cores]
        if of[0].added is None:
            sets.add_row(entry.what, f"{entry.bodies}, {entry.arbiters}", *(f"{row.flash:,}" for row in of),
                         _number(entry.flash_goal), f"{of[0].ram:,}", _number(entry.ram_goal))  # fmt: skip
        else:
            adds.add_row(entry.what.removeprefix("+ "), *(f"{row.added:,}" for row in of))
    return [sets, adds]


def _number(value: int | None) -> str:
    return "-" if value is None else f"{value:,}"
