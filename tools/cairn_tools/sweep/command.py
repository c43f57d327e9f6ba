"""The verb: which rows are missing, runs them, and tells what came out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pandas import NA
from rich.table import Table

from . import cluster, settings
from .measure import KEY
from .table import Results

SHOWN = 24  # rows of the table; a larger sweep is for other programs
FIGURES = ("penetration_worst", "penetration_mean", "drift", "energy_gained", "error_max", "instructions_mean")

Tell = Callable[[int, int], None]  # rows done, and of how many


@dataclass(frozen=True)
class Swept:
    """What a sweep did."""

    file: str
    rows: int  # of the file
    asked: int
    ran: int
    refused: int  # of those asked for: the engine refuses the scene
    records: list[dict[str, Any]]  # those asked for


def sweep(jobs: list[settings.Job], file: Path, seconds: float, scheduler: str, workers: int, tell: Tell) -> Swept:
    """Runs what the file does not have yet."""
    with Results(file, jobs, seconds) as results:
        missing = [job for job in jobs if job.key not in results.rows]
        done = len(jobs) - len(missing)
        tell(done, len(jobs))
        if missing:
            with cluster.client(scheduler, workers) as connected:
                for row in cluster.rows(connected, missing, seconds):
                    results.add(row)
                    done += 1
                    tell(done, len(jobs))
        records = [results.rows[job.key] for job in jobs]
        refused = sum(bool(record["failure"]) for record in records)
        return Swept(str(file), len(results.rows), len(jobs), len(missing), refused, records)


def table(swept: Swept) -> Table:
    """What was varied, and the main figures: the first rows of a long one."""
    varied = [name for name in KEY if len({record[name] for record in swept.records}) > 1]
    grid = Table(title=f"{swept.asked} rows, {swept.ran} of them run now: {swept.file}",
                 caption="metres, joules, instructions a step; - where there is none")  # fmt: skip
    for name in (*varied, *FIGURES):
        grid.add_column(name.replace("_", " "), justify="left" if name in ("scene", "engine", "solver") else "right")
    for record in swept.records[:SHOWN]:
        grid.add_row(*(_shown(record[name]) for name in (*varied, *FIGURES)))
    if swept.asked > SHOWN:
        grid.add_row(*("..." for _ in (*varied, *FIGURES)))
    return grid


def _shown(value: Any) -> str:
    if isinstance(value, bool):
        return "on" if value else "off"
    if value is None or value is NA or value != value or value == "":
        return "-"
    if isinstance(value, float):
        return f"{value:,.0f}" if abs(value) >= 1000 else f"{value:.3g}"
    return str(value)
