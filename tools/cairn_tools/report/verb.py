"""`tools/cairn report`: its arguments, and its last line."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from ..terminal import folder, share

WORKERS = min(2, os.cpu_count() or 1)


def report(
    out: Annotated[Path, typer.Option(metavar="DIR", help="For index.html, report.json and tables.md.")],
    quick: Annotated[bool, typer.Option("--quick", help="A few rows of each part, in seconds.")] = False,
    peers: Annotated[bool, typer.Option("--peers", help="Chipmunk and Box2D too; fetches their sources.")] = False,
    workers: Annotated[int, typer.Option("--jobs", min=1, max=64, help="Processes.")] = WORKERS,
) -> None:
    """Measure everything and write it on one page of HTML; exit code 1 if a part could not be measured."""
    # What it needs is slow to load: only who asks for it waits.
    from . import command
    from .model import Options

    place = folder(out)
    with share("report") as tell:
        written = command.write(place, Options(quick, peers), workers, tell)
    for line in written.broke:
        print(f"not measured: {line}")
    print(f"{written.page}, {written.record.name} and {written.tables.name} are written")
    if written.broke:
        raise typer.Exit(1)
