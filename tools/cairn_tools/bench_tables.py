"""What `bench --cycles` prints."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from rich import box
from rich.table import Table

from . import cycles


def cycles_record(rows: list[cycles.Cycles], checks: list[cycles.Deviation]) -> dict[str, Any]:
    """For --json."""
    used = [timing for name, timing in cycles.TIMINGS.items() if any(row.core == timing.core for row in rows)]
    return {
        "results": [asdict(row) for row in rows],
        "checks": [asdict(check) | {"percent": check.percent, "percent_by_its_rules": check.percent_by_its_rules}
                   for check in checks],
        "weights": {timing.core: {"source": timing.source, "classes": {k: asdict(w) for k, w in timing.weights.items()}}
                    for timing in used},
        "not_counted": {chip.name: chip.memory for chip in cycles.CHIPS},
    }  # fmt: skip


def cycles_tables(rows: list[cycles.Cycles], checks: list[cycles.Deviation]) -> list[Table]:
    """The results, the check of the estimate, and the weights."""
    tables = [_results(rows)]
    if checks:
        tables.append(_checks(checks))
    return [*tables, _weights([t for t in cycles.TIMINGS.values() if any(row.core == t.core for row in rows)])]


def _results(rows: list[cycles.Cycles]) -> Table:
    named = [chip for chip in cycles.CHIPS if any(row.chip == chip.name for row in rows)]
    waits = "; ".join(f"{chip.name}: {chip.memory}" for chip in named)
    caption = (
        "thousands; mean of steps 121-240; worst of steps 1-240. Measured in rp2040js; else an estimate, with half the range of "
        f"its tables. {waits}. {cycles.NOT_ESTIMATED}"
    )
    grid = Table(title="Cycles per step, and microseconds at the chip's clock", caption=caption, box=box.SIMPLE)
    for column in ("scene", "chip"):
        grid.add_column(column)
    for column in ("MHz", "k instr.", "k cycles", "+-", "us", "worst us"):
        grid.add_column(column, justify="right")
    for row in rows:
        half = 50 * (row.cycles_high - row.cycles_low) / row.cycles
        spread = "measured" if row.how == "measured" else f"{half:.0f} %"
        thousands = (f"{number / 1000:,.1f}" for number in (row.instructions, row.cycles))
        times = (f"{number:,.0f}" for number in (row.microseconds, row.worst_microseconds))
        grid.add_row(row.scene, row.chip, str(row.mhz), *thousands, spread, *times)
    return grid


def _checks(checks: list[cycles.Deviation]) -> Table:
    caption = ("by its rules: the same counts with a cycle less where lr is pushed and where pc is popped, "
               "as rp2040js has it")  # fmt: skip
    grid = Table(title="Cortex-M0+: the estimate against the cycles of rp2040js", caption=caption)
    grid.add_column("scene")
    for column in ("rp2040js", "estimate", "off", "by its rules", "off"):
        grid.add_column(column, justify="right")
    for check in checks:
        grid.add_row(check.scene, f"{check.measured:,.0f}", f"{check.estimated:,.0f}", f"{check.percent:+.2f} %",
                     f"{check.by_its_rules:,.0f}", f"{check.percent_by_its_rules:+.3f} %")  # fmt: skip
    return grid


def _weights(timings: list[cycles.Timing]) -> Table:
    caption = "; ".join(f"{timing.core}: {timing.source}" for timing in timings)
    grid = Table(title="Weights of the estimates, in cycles; N registers", caption=caption)
    grid.add_column("class")
    for timing in timings:
        grid.add_column(timing.core, justify="right")
    for name in cycles.CLASSES:
        words = [weight_text(timing.weights[name]) if name in timing.weights else "-" for timing in timings]
        if any(word != "-" for word in words):
            grid.add_row(name, *words)
    return grid


def weight_text(weight: cycles.Weight) -> str:
    """As a manual writes it: "1-2", "3 + N", "1, taken 2"."""

    def span(low: float, high: float) -> str:
        return f"{low:g}" if low == high else f"{low:g}-{high:g}"

    text = span(weight.low, weight.high)
    if weight.register:
        text += " + N"
    if weight.jump != (0, 0):
        text += f", taken {span(weight.low + weight.jump[0], weight.high + weight.jump[1])}"
    return text
