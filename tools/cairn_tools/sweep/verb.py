"""`tools/cairn sweep`: its arguments, and what it prints."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from ..errors import UserError
from ..terminal import Core, JsonOption, bar
from ..terminal import out as terminal

PARAMETERS = "engine solver substeps passes rate sleep quadtree seed jitter gravity mass stiffness damping friction"


def sweep(
    scenes: Annotated[list[str], typer.Argument(metavar="SCENE...", help="Scene files, or names in examples/scenes.")],
    out: Annotated[Path, typer.Option(metavar="FILE", help="Results: .parquet or .csv. Rows in it are not run again.")],
    vary: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=VALUES", help=f"As substeps=2,4 seed=0..99. Names: {PARAMETERS}."),
    ] = None,
    seconds: Annotated[float, typer.Option(min=0.01, max=3600, help="Simulated time of a row.")] = 4.0,
    core: Annotated[list[Core] | None, typer.Option(help="Count instructions on these cores too.")] = None,
    scheduler: Annotated[str, typer.Option(metavar="ADDRESS", help="Of a Dask scheduler that runs already.")] = "",
    workers: Annotated[int, typer.Option("--jobs", min=0, max=512, help="Processes; 0: one a processor.")] = 0,
    as_json: JsonOption = False,
) -> None:
    """Run scenes under every combination of settings, on Dask; one row of results each."""
    # Dask and pandas are slow to load: only who sweeps waits for them.
    from . import cluster, command, settings

    if scheduler and workers:
        raise UserError("--jobs is of a cluster here, not of one at --scheduler")
    jobs = settings.jobs(scenes, vary or [], [value.value for value in core or ()])
    with bar("sweep") as tell:
        swept = command.sweep(jobs, out, seconds, scheduler, workers or cluster.default_workers(), tell)
    if as_json:
        record = asdict(swept)
        del record["records"]
        print(json.dumps(record, indent=2))
    else:
        # Into a file there is no width to keep to.
        (terminal if terminal.is_terminal else Console(width=180)).print(command.table(swept))
