"""The verb `footprint`: what feature sets take of flash, RAM and stack."""

from __future__ import annotations

import json
from dataclasses import asdict
from enum import Enum
from time import monotonic
from typing import Annotated

import typer
from rich.table import Table

from . import bench_tables, footprint, footprint_record
from .errors import UserError
from .footprint import Row, Say
from .terminal import JsonOption, hold_to_record, out, working

FootprintCore = Enum("FootprintCore", {name: name for name in footprint.CORES}, type=str)


def command(
    core: Annotated[list[FootprintCore] | None, typer.Option(help="Default: m0 m3 m4f; with --keep all.")] = None,
    check: Annotated[bool, typer.Option("--check", help="Hold sizes and contents to the record.")] = False,
    keep: Annotated[bool, typer.Option("--keep", help="Put them on record, and into the README.")] = False,
    readme: Annotated[bool, typer.Option("--readme", help="The README's tables, from the record.")] = False,
    markdown: Annotated[bool, typer.Option("--markdown", help="Print the tables as Markdown.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Flash, RAM and stack of tiny games of a feature set each, beyond the same image without Cairn; gcc -Os -flto."""
    if readme:
        if core or check or keep or markdown or as_json:
            raise UserError("--readme goes alone: it makes the README's tables from the record")
        footprint_record.write_readme(footprint_record.read())
        return
    cores = tuple(c.value for c in core or ()) or (footprint.CORES if keep else footprint.DEFAULT_CORES)
    if (keep or check) and footprint.CORES[0] not in cores:
        raise UserError(f"--keep and --check are about {footprint.CORES[0]} too: name it, or leave out --core")
    started = monotonic()
    record = footprint_record.read() if check and not keep else {}  # before the work: it may be missing
    with working("footprint") as say:
        rows = footprint.measure(cores, say)
        checks = _checks(rows, record, say) if check or keep else []
    if as_json:
        print(json.dumps([asdict(row) for row in rows], indent=2))
    else:
        for grid in tables(rows):
            (bench_tables.print_markdown if markdown else out.print)(grid)
    if check:
        hold_to_record([f"{what}: {wrong}" for what, wrong in checks if wrong], len(checks), started, as_json)


def _checks(rows: list[Row], record: footprint_record.Record, say: Say) -> list[footprint_record.Check]:
    """Of what was measured and of what is in the images, against a record that is made first where there is none."""
    say("what is in the images")
    images = footprint.build(footprint.CORES[0])
    found = {entry.name: footprint.functions(images[entry.name]) | footprint.tables(images[entry.name])
             for entry in footprint.SETS[1:]}  # fmt: skip
    types = footprint.type_sizes(footprint.CORES[0])
    if not record:
        footprint_record.write(rows, found, types)
        record = footprint_record.read()
        footprint_record.write_readme(record)
    return [
        *footprint_record.size_checks(rows, record),
        *footprint_record.name_checks(found, record),
        footprint_record.world_check(rows, types),
        footprint_record.readme_check(record),
    ]


def tables(rows: list[Row]) -> list[Table]:
    """The sets with their goals, then what each feature adds."""
    cores = list(dict.fromkeys(row.core for row in rows))
    by_name = {(row.core, row.name): row for row in rows}
    caption = f"bytes beyond the image without Cairn; goals are for the M0; constants, RAM, stack are {cores[0]}'s"
    sets = Table(title="Footprint", caption=caption)
    adds = Table(title="What a feature adds", caption="bytes of flash on top of balls, walls and boxes")
    for grid, columns in ((sets, ("feature set", "bodies, arbiters")), (adds, ("feature",))):
        for column in columns:
            grid.add_column(column)
    for core in cores:
        sets.add_column(f"flash {core}", justify="right")
        adds.add_column(core, justify="right")
    for column in ("goal", "constants", "RAM", "goal", "stack"):
        sets.add_column(column, justify="right")
    for entry in footprint.SETS[1:]:
        of = [by_name[core, entry.name] for core in cores]
        if of[0].added is None:
            sets.add_row(entry.what, f"{entry.bodies}, {entry.arbiters}", *(f"{row.flash:,}" for row in of),
                         _number(entry.flash_goal), f"{of[0].constants:,}", f"{of[0].ram:,}", _number(entry.ram_goal),
                         f"{of[0].stack:,}")  # fmt: skip
        else:
            adds.add_row(entry.what.removeprefix("+ "), *(f"{row.added:,}" for row in of))
    return [sets, adds]


def _number(value: int | None) -> str:
    return "-" if value is None else f"{value:,}"
