"""The error of every primitive of the arithmetic, in LSB, as tests/arith/errors.c measures it.

To take every argument takes minutes, so the results are kept in tests/arith/errors.json with those of a sample, which
takes a second: a table is shown only if Cairn's sample comes out as it did when the results were kept. libfixmath's
stands beside it for comparison and is not held to its own.
"""

from __future__ import annotations

import json
import math
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.table import Table

from ..engine import BUILDS, check_build, cmake, lock
from ..errors import UserError

ROOT = Path(__file__).resolve().parents[3]
KEPT = ROOT / "tests" / "arith" / "errors.json"
FETCH = ROOT / "tests" / "arith" / "fetch"
# Random arguments, and of which of all arguments each so manieth is taken.
FULL = (100_000_000, 1)
SAMPLE = (100_000, 4099)
OTHERS = "fix16_"  # how libfixmath's names begin
AGAIN = "`tools/cairn accuracy --arithmetic --exhaustive` makes it again"

# What issue 5 asks for, in units of the result's last place.
LIMITS = {
    "real_mul": 0.5, "real_divide": 1.0, "real_sqrt": 0.5, "sine and cosine of radians": 1.0,
    "angle_of, in radians": 1.0, "unit_along from 1 mm up": 1e-7,
}  # fmt: skip


@dataclass(frozen=True)
class Row:
    """Of one operation. Errors in units; where the arguments are too many for all, `results` of them were random."""

    operation: str
    unit: str
    every_argument: bool
    results: int
    largest: float
    rms: float
    bound: float | None  # that arith_fixed.h states; libfixmath states none
    worst: tuple[int, int]  # the arguments

    @property
    def ours(self) -> bool:
        return not self.operation.startswith(OTHERS)

    @property
    def passes(self) -> bool:
        """Of ours: within what the header states and what was asked for."""
        return self.bound is None or self.largest <= min(self.bound, LIMITS.get(self.operation, self.bound))

    def agrees_with(self, other: Row) -> bool:
        """The same errors, but for the last place of the reference: long double's functions differ by processor."""
        return self.results == other.results and all(
            math.isclose(one, two, rel_tol=1e-4) for one, two in ((self.largest, other.largest), (self.rms, other.rms))
        )


def measure(say: Callable[[str], None]) -> list[Row]:
    """The kept rows of all arguments, once a sample has shown that they are this arithmetic's."""
    kept = _kept()
    sample = {row.operation: row for row in kept["sample"] if row.ours}
    for row in run(SAMPLE, say):
        if row.ours and not (row.operation in sample and row.agrees_with(sample.pop(row.operation))):
            raise UserError(f"{KEPT}: {row.operation} comes out otherwise now; {AGAIN}")
    if sample:
        raise UserError(f"{KEPT}: {next(iter(sample))} is measured no more; {AGAIN}")
    return kept["full"]


def measure_anew(say: Callable[[str], None]) -> list[Row]:
    """All arguments, in minutes, libfixmath beside; the results are kept."""
    done = subprocess.run([str(FETCH)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise UserError(f"{FETCH.name}: {(done.stderr or done.stdout).strip().splitlines()[-1]}")
    keep(list(run(SAMPLE, say)), full := list(run(FULL, say)))
    return full


def keep(sample: list[Row], full: list[Row]) -> None:
    """Writes the file: a line a row."""
    parts = []
    for name, rows in (("sample", sample), ("full", full)):
        parts.append(f'"{name}": [\n' + ",\n".join(json.dumps(asdict(row)) for row in rows) + "\n]")
    KEPT.write_text("{" + ",\n".join(parts) + "}\n", encoding="utf-8")


def _kept() -> dict[str, list[Row]]:
    try:
        kept = json.loads(KEPT.read_text(encoding="utf-8"))
        return {name: [_row(entry) for entry in kept[name]] for name in ("sample", "full")}
    except (OSError, ValueError, TypeError, KeyError) as error:
        raise UserError(f"{KEPT}: cannot be read ({error}); {AGAIN}") from error


def _row(entry: dict[str, Any]) -> Row:
    return Row(**{**entry, "worst": tuple(entry["worst"])})


def run(size: tuple[int, int], say: Callable[[str], None]) -> Iterator[Row]:
    """The program's rows, as they come."""
    arguments = [str(_program()), "all", *map(str, size), "json"]
    with subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None and process.stderr is not None
        for line in process.stdout:
            row = _row(json.loads(line))
            say(row.operation)
            yield row
        complaint = process.stderr.read()
    if process.returncode not in (0, 1):  # 1: a bound does not hold, which the rows show
        raise UserError(f"arith_errors: {complaint.strip() or f'ended with {process.returncode}'}")


def _program() -> Path:
    """Built where it is not up to date, with libfixmath if that is installed."""
    place = BUILDS / "arith"
    with lock("arith"):
        check_build(cmake("--preset", "host", "-B", str(place)))
        check_build(cmake("--build", str(place), "--target", "arith_errors"))
    return place / "tests" / "arith" / "arith_errors"


def tables(rows: list[Row]) -> list[Table]:
    """A line an operation: Cairn's, then libfixmath's."""
    grids = []
    for title, ours in (("Cairn's arithmetic", True), ("libfixmath", False)):
        chosen = [row for row in rows if row.ours == ours]
        if chosen:
            grids.append(_table(title, chosen))
    return grids


def _table(title: str, rows: list[Row]) -> Table:
    grid = Table(title=f"{title}: error in units of the result's last place")
    for name in ("operation", "unit", "arguments"):
        grid.add_column(name)
    for name in ("largest", "RMS", "bound"):
        grid.add_column(name, justify="right")
    grid.add_column("worst at")
    for row in rows:
        every = "all" if row.ours else "every 61st"
        count = every if row.every_argument else f"{row.results:.1e}"
        bound = "" if row.bound is None else f"{row.bound:g}" + ("" if row.passes else " !")
        grid.add_row(row.operation, row.unit, count, f"{row.largest:.4g}", f"{row.rms:.3g}", bound,
                     ", ".join(map(str, row.worst)))  # fmt: skip
    return grid
