"""Error against run time for people: a table a scene and core, and what the points of the peers come to."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any

from rich.table import Table

from .error_time import MEASURES, Verdict, front, verdicts
from .rows import Row, Settings

CAPTION = (
    "Instructions a 1/60 s of simulated time, mean from the first step on; lengths in metres. * the default; P on the "
    "Pareto front of Cairn's settings by position error, penetration, contact error"
)


def groups(rows: list[Row]) -> list[list[Row]]:
    """Those of one scene and core each, in order."""
    found: dict[tuple[str, str], list[Row]] = {}
    for row in rows:
        found.setdefault((row.scene, row.core), []).append(row)
    return list(found.values())


def tables(rows: list[Row]) -> list[Table]:
    """Of each scene and core what a reader chooses among: the fronts, the default and its variants, and the peers."""
    return [_table(group) for group in groups(rows)]


def _table(group: list[Row]) -> Table:
    first = group[0]
    grid = Table(title=f"{first.scene} on {first.core}, {first.seconds:g} s, {_horizon(first)}", caption=CAPTION)
    columns = ("settings", "instructions", "times default", "position error", "largest", "penetration")
    for column in (*columns, "contact error", "energy gained, J", ""):
        grid.add_column(column, justify="left" if column in ("settings", "") else "right")
    for row, marks in chosen(group):
        grid.add_row(*_cells(row, group), marks)
        if row is [r for r, _ in chosen(group) if r.settings.engine == "cairn"][-1]:
            grid.add_section()
    return grid


def chosen(group: list[Row]) -> list[tuple[Row, str]]:
    """The rows worth showing, with their marks: Cairn's by cost, then the peers'."""
    own = [row for row in group if row.settings.engine == "cairn"]
    fronts = {measure: front(own, measure) for measure in MEASURES}
    default = next((row.settings for row in own if row.is_default), None)
    shown = []
    for row in sorted(own, key=lambda row: row.instructions_per_frame):
        marks = "".join("P" if row in of_measure else "-" for of_measure in fronts.values())
        if "P" in marks or row.is_default or _is_near(row.settings, default):
            shown.append((row, ("* " if row.is_default else "  ") + marks))
    return shown + [(row, "") for row in group if row.settings.engine != "cairn"]


def _is_near(settings: Settings, default: Settings | None) -> bool:
    """Differs from the default in one thing that is not how fine it is: the solver, the tree, sleep."""
    if default is None or settings.steps_per_second != default.steps_per_second:
        return False
    return settings.solver != default.solver or settings.substeps == default.substeps


def _cells(row: Row, group: list[Row]) -> tuple[str, ...]:
    default = next((other for other in group if other.is_default), None)
    times = f"{row.instructions_per_frame / default.instructions_per_frame:.2f}" if default else ""
    errors = row.errors
    lengths = (errors.rms_error, errors.largest_error, errors.penetration, errors.contact_error, errors.energy_gained)
    return (row.settings.label, f"{row.instructions_per_frame:,.0f}", times, *map(number, lengths))


def number(value_: float) -> str:
    if math.isnan(value_):
        return "-"
    return "lost" if math.isinf(value_) else "0" if value_ == 0 else f"{value_:.1e}"


def _horizon(row: Row) -> str:
    if row.compared_seconds >= row.seconds:
        return f"against a {row.reference}"
    return f"positions against a {row.reference} until {row.compared_seconds:.2f} s (chaotic beyond)"


def sentences(rows: list[Row]) -> list[str]:
    """Whether Cairn's default lies below and to the left of the peers' points; where not, by how much."""
    lines = []
    all_verdicts = verdicts(rows)
    for group in groups(rows):
        own = [v for v in all_verdicts if (v.scene, v.core) == (group[0].scene, group[0].core)]
        for measure, text in MEASURES.items():
            of_measure = [v for v in own if v.measure == measure]
            if not of_measure:
                continue
            bad = [v for v in of_measure if not v.below_and_left]
            head = f"{group[0].scene} on {group[0].core}, {text}: the default is"
            if not bad:
                least = min(v.times_cheaper for v in of_measure)
                lines.append(f"{head} below and left of all {len(of_measure)} points; they take at least "
                             f"{least:.1f} times as much.")  # fmt: skip
            else:
                lines.append(f"{head} NOT below and left of {'; '.join(map(_exception, bad))}.")
    return lines


def _exception(it: Verdict) -> str:
    return (f"{it.peer.label} ({number(it.peer_value)} to {number(it.default_value)}, "
            f"{it.times_cheaper:.1f} times the instructions)")  # fmt: skip


def record(rows: list[Row]) -> list[dict[str, Any]]:
    """For JSON, which has no word for what is not a number."""
    return [finite({**asdict(row), "front": _fronts(row, rows)}) for row in rows]


def _fronts(row: Row, rows: list[Row]) -> list[str]:
    own = [r for r in rows if (r.scene, r.core) == (row.scene, row.core) and r.settings.engine == "cairn"]
    return [measure for measure in MEASURES if row in front(own, measure)]


def finite(value_: Any) -> Any:
    """With None in place of what is not a number or infinite."""
    if isinstance(value_, dict):
        return {key: finite(item) for key, item in value_.items()}
    return None if isinstance(value_, float) and not math.isfinite(value_) else value_
