"""What `bench --cycles`, `--copies`, `--growth`, `--memory`, `--peers` and `--host` print."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from rich import box
from rich.table import Table

from . import copies, cycles, growth, host_bench, memory, peers


def print_markdown(table: Table) -> None:
    """A table as Markdown, its caption behind it."""
    print(as_markdown(table) + "\n")


def as_markdown(table: Table) -> str:
    """A line a row; numbers to the right."""
    rows = [[str(column.header) for column in table.columns]]
    rows.append(["---:" if column.justify == "right" else "---" for column in table.columns])
    rows += map(list, zip(*(map(str, column.cells) for column in table.columns), strict=True))
    lines = [f"| {' | '.join(row)} |" for row in rows]
    return "\n".join([*lines, "", f"{table.title}: {table.caption}" if table.caption else f"{table.title}."])


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
        "mean of steps 121-240; worst of steps 1-240. Measured in rp2040js; else an estimate, with half the range of "
        f"its tables. {waits}. {cycles.NOT_ESTIMATED}"
    )
    title = "Thousands of instructions and cycles a step, and microseconds at the chip's clock"
    grid = Table(title=title, caption=caption, box=box.SIMPLE, pad_edge=False)
    for column in ("scene", "chip"):
        grid.add_column(column, no_wrap=True)
    for column in ("MHz", "instr.", "cycles", "+-", "us", "worst us"):
        grid.add_column(column, justify="right", no_wrap=True)
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


def copies_table(rows: list[copies.Spread]) -> Table:
    """A line a scene and core."""
    caption = (f"mean of steps 121-240, +- its standard error; worst of steps 1-240; each body moved by up to "
               f"{1000 * copies.MOST:g} mm along x and y")  # fmt: skip
    grid = Table(title="Instructions per step of copies of a scene", caption=caption)
    for column in ("scene", "core", "copies", "mean", "+-", "least", "most", "mean of the worst", "worst"):
        grid.add_column(column, justify="left" if column in ("scene", "core") else "right")
    for row in rows:
        error = "-" if row.standard_error is None else f"{row.standard_error:,.0f}"
        counts = (f"{count:,.0f}" for count in (row.least, row.most, row.mean_worst, row.most_worst))
        grid.add_row(row.scene, row.core, str(row.copies), f"{row.mean:,.0f}", error, *counts)
    return grid


def growth_record(points: list[growth.Point]) -> dict[str, Any]:
    """For --json."""
    rows = [asdict(p) | {"per_body": p.per_body, "worst_per_body": p.worst_per_body} for p in points]
    return {"points": rows, "summary": growth.summary(points)}


def growth_tables(points: list[growth.Point]) -> list[Table]:
    """A line a world, both broad phases in it; then what they come to."""
    caption = "mean of steps 121-240; worst of steps 1-240; the step's stack in bytes"
    grid = Table(title="Instructions a body and step", caption=caption, box=box.SIMPLE, pad_edge=False)
    for column in ("core", "world"):
        grid.add_column(column)
    for column in ("bodies", "points", "pairs", "worst", "quadtree", "worst", "stack"):
        grid.add_column(column, justify="right", no_wrap=True)
    for pairs, tree in zip(points[::2], points[1::2], strict=True):
        counts = (pairs.per_body, pairs.worst_per_body, tree.per_body, tree.worst_per_body)
        stack = max(pairs.stack_bytes, tree.stack_bytes)
        grid.add_row(pairs.core, pairs.kind, str(pairs.bodies), str(pairs.contact_points),
                     *(f"{count:,.0f}" for count in counts), f"{stack:,}")  # fmt: skip
    sums = Table(title=f"From {growth.FROM} to {growth.TO} bodies", box=box.SIMPLE, pad_edge=False)
    for column in ("core", "world"):
        sums.add_column(column)
    for column in ("crossover", "growth by pairs", "by quadtree", f"a body of {growth.TO} by quadtree", "stack"):
        sums.add_column(column, justify="right")
    for row in growth.summary(points):
        tree, pairs = row["quadtree"], row["pairs"]
        at = "-" if row["crossover"] is None else f"{row['crossover']:.0f}"
        rise = ("-" if part["growth_percent"] is None else f"{part['growth_percent']:+.0f} %" for part in (pairs, tree))
        body = "-" if tree["per_body"] is None else f"{tree['per_body']:,.0f}"
        sums.add_row(row["core"], row["kind"], at, *rise, body, f"{row['stack_bytes']:,}")
    return [grid, sums]


def memory_record(rows: list[memory.Row]) -> list[dict[str, Any]]:
    """For --json."""
    return [asdict(row) | {"verdict": row.verdict} for row in rows]


def memory_tables(rows: list[memory.Row]) -> list[Table]:
    """Sizes, then stacks; a column a core."""
    pools = f"the world with the pools that {memory.WORLD} needs in {2 * memory.STEPS} steps"
    titles = {"size": ("Bytes of RAM", pools),
              "stack": ("Bytes of stack of a step", f"the most of steps 1 to {memory.STEPS}"),
              "call": ("Bytes of stack of a call", "the most in any scene, by the compiler's call graph")}  # fmt: skip
    grids = []
    for kind, (title, caption) in titles.items():
        own = [row for row in rows if row.kind == kind]
        cores = list(dict.fromkeys(row.core for row in own))
        grid = Table(title=title, caption=caption, box=box.SIMPLE, pad_edge=False)
        grid.add_column({"size": "what", "stack": "scene", "call": "call"}[kind])
        for column in (*cores, "goal"):
            grid.add_column(column, justify="right", no_wrap=True)
        grid.add_column("verdict")
        for name in dict.fromkeys(row.name for row in own):
            of = [row for row in own if row.name == name]
            goal = "-" if of[0].goal is None else f"{of[0].goal:,}"
            grid.add_row(name, *(f"{row.bytes:,}" for row in of), goal, max(of, key=lambda row: row.bytes).verdict)
        if own:
            grids.append(grid)
    return grids


def peer_tables(rows: list[list[peers.Cost]]) -> list[Table]:
    """Instructions and how far bodies went, then memory; a row is a scene on a core by all engines."""
    order = ", ".join(peers.ENGINES)
    caption = f"mean of steps 121-240; times: of Cairn's; farthest move of a body from its start: {order}"
    speed = _of_scenes("Thousands of instructions a step", caption)
    caption = f"flash and RAM: what the engine adds to the same image, RAM without the stack; stack: of all. {order}"
    memory = _of_scenes("Memory", caption)
    first, *others = peers.ENGINES
    for column in (first, *(column for name in others for column in (name, "times")), "farthest, m"):
        speed.add_column(column, justify="right", no_wrap=True)
    for column in ("flash, KB", "RAM, KB", "stack, bytes"):
        memory.add_column(column, justify="right", no_wrap=True)
    for row in rows:
        counts = [f"{row[0].mean_instructions / 1000:,.0f}"]
        for cost in row[1:]:
            counts += [f"{cost.mean_instructions / 1000:,.0f}", f"{cost.times_cairn:.1f}"]
        moves = " ".join(f"{cost.farthest_move:.2f}{'' if cost.stands else ' FELL'}" for cost in row)
        speed.add_row(row[0].scene, row[0].core, *counts, moves)
        kilobytes = [" ".join(f"{size / 1024:.1f}" for size in sizes)
                     for sizes in ([c.flash_bytes for c in row], [c.ram_bytes for c in row])]  # fmt: skip
        memory.add_row(row[0].scene, row[0].core, *kilobytes, " ".join(str(cost.stack_bytes) for cost in row))
    return [speed, memory]


def host_table(times: list[host_bench.Time]) -> Table:
    """A row is an engine in a scene."""
    caption = (
        "steps 121-240, from the start 1-240, each step's median over the rounds; rounds: their means, and against "
        "Cairn's in the same one; farthest move of a body; overlap of two balls in their diameter"
    )
    grid = Table(title="Microseconds a step on the host", caption=caption, box=box.SIMPLE, pad_edge=False)
    for column in ("scene", "engine"):
        grid.add_column(column, no_wrap=True)
    for column in ("us", "rounds", "times", "rounds", "from the start", "times", "farthest, m", "overlap"):
        grid.add_column(column, justify="right", no_wrap=True)
    for time in times:
        spread = f"{time.fastest_round:,.0f}-{time.slowest_round:,.0f}"
        ratios = "-" if time.engine == "cairn" else f"{time.lowest_times:.2f}-{time.highest_times:.2f}"
        whole = (f"{time.from_start_microseconds:,.0f}", f"{time.from_start_times_cairn:.2f}")
        move = f"{time.farthest_move:.2f}{'' if time.stands else ' FELL'}"
        grid.add_row(time.scene, time.engine, f"{time.microseconds:,.0f}", spread, f"{time.times_cairn:.2f}", ratios,
                     *whole, move, f"{100 * time.overlap:.0f} %" if time.overlap else "-")  # fmt: skip
    return grid


def _of_scenes(title: str, caption: str) -> Table:
    grid = Table(title=title, caption=caption, box=box.SIMPLE, pad_edge=False)
    for column in ("scene", "core"):
        grid.add_column(column, no_wrap=True)
    return grid
