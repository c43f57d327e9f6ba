"""The parts that other commands measure: stability, instructions, memory, pictures of scenes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import groupby
from typing import Any

from .. import bench, draw, engine, memory, scene
from .. import bench_tables as tables
from ..stability import command as stability
from ..stability import model as cases
from ..stability import report as stability_report
from .model import BAD, GOOD, OPEN, Cell, Figure, Grid, Options, Part, Section, Task, grid_of
from .pictures import data_uri

CORES = engine.COUNTED[:6]  # lm3s6965evb is the M3 once more
QUICK_CASES = ["scene-stack10", "heavy-100-0.0", "spring-1000"]

# ---- stability ----


def _stability_tasks(options: Options) -> list[Task]:
    names = [name for name in QUICK_CASES if name in cases.CASES] if options.quick else []
    jobs = stability.jobs("all", names, [], ["soft"])
    return [Task(" ".join(job[:2]), _case, job) for job in jobs]


def _case(name: str, arithmetic: str, solver: str) -> cases.Result:
    """Of this module, which knows all cases wherever it is loaded."""
    return cases.run(name, arithmetic, solver)


def _stability(results: list[cases.Result]) -> Section:
    held, deciding = stability_report.counts(results)
    grids = []
    for heading, lines in groupby(stability_report.lines(results), key=lambda line: line.heading):
        rows = [[Cell(line.case), _verdict(line.q16), _verdict(line.f64), Cell(line.figures), Cell(line.peers)]
                for line in lines]  # fmt: skip
        columns = ["case", "q16", "f64", "figures in q16 (f64) and limits", "other engines"]
        grids.append(Grid(heading, columns, [False] * 5, rows))
    data = [_without(stability_report.record(result), "seconds") for result in results]
    return Section(
        key="stability",
        title="Stability",
        command="tools/cairn stability",
        finding=f"{held} of {deciding} deciding rows hold, in fixed point and in double.",
        meaning="A row is a stiff or extreme case with limits that were set before it was measured. What stands in "
        "square brackets is a stretch target, which does not decide. q16 is fixed point; f64 is the same source in "
        "double: a row that falls short in both is the algorithm's, one that falls short in q16 alone the format's.",
        tone=GOOD if held == deciding else BAD,
        grids=grids,
        data=data,
    )


def _verdict(text: str) -> Cell:
    return Cell(text, {"holds": GOOD, "": "", "stretch: open": OPEN}.get(text, BAD))


def _without(record: dict[str, Any], name: str) -> dict[str, Any]:
    return {key: value for key, value in record.items() if key != name}


# ---- instructions ----


def _bench_tasks(options: Options) -> list[Task]:
    names = ("stack10",) if options.quick else bench.SCENES
    cores = ("m0", "m3") if options.quick else CORES
    return [Task(f"{name} on {core}", _cost, (name, core), 2) for name in names for core in cores]


def _cost(name: str, core: str) -> bench.Cost:
    return bench.measure(scene.load(scene.find(name)), core)


def _bench(costs: list[bench.Cost]) -> Section:
    cores = list(dict.fromkeys(cost.core for cost in costs))
    shown = next((cost.scene for cost in costs if cost.scene == "pyramid10"), costs[0].scene)
    own = [cost for cost in costs if cost.scene == shown]
    means = [f"{cost.mean_instructions / 1000:,.0f} on the {cost.core.upper()}" for cost in own]
    return Section(
        key="bench",
        title="What a step costs",
        command=f"tools/cairn bench --core {' '.join(cores)}",
        finding=f"Thousands of instructions that a step of {shown} takes: {', '.join(means)}.",
        meaning="Counted, not timed: QEMU counts each instruction, so the figures are the same on every machine. At "
        "60 steps a second an RP2040 at 125 MHz has about 1,600 thousand instructions for a step, a SAMD21 at 48 MHz "
        "about 600. The worst step is the one to budget for: docs/SPEED.md has cycles and microseconds of chips.",
        grids=[_counts("mean of steps 121-240", costs, lambda cost: cost.mean_instructions),
               _counts("worst of steps 1-240", costs, lambda cost: cost.worst_instructions_from_start)],
        data=costs,
    )  # fmt: skip


def _counts(what: str, costs: list[bench.Cost], count: Callable[[bench.Cost], float]) -> Grid:
    """A row a scene, a column a core."""
    by_place = {(cost.scene, cost.core): cost for cost in costs}
    cores = list(dict.fromkeys(cost.core for cost in costs))
    rows = []
    for name in dict.fromkeys(cost.scene for cost in costs):
        first = by_place[name, cores[0]]
        numbers = [f"{count(by_place[name, core]) / 1000:,.1f}" for core in cores]
        rows.append([Cell(text) for text in (name, str(first.bodies), str(first.points), *numbers)])
    columns = ["scene", "bodies", "contact points", *(core.upper() for core in cores)]
    return Grid(f"Thousands of instructions a step, {what}", columns, [False] + [True] * (len(columns) - 1), rows,
                "settings of the scenes, which are the defaults; no sleep")  # fmt: skip


# ---- memory ----


def _memory_tasks(options: Options) -> list[Task]:
    names = memory.SCENES[:1] if options.quick else memory.SCENES
    cores = memory.CORES[:1] if options.quick else memory.CORES
    return [Task(f"memory on {core}", _bytes, (core, names), 2 * len(names)) for core in cores]


def _bytes(core: str, names: Iterable[str]) -> list[memory.Row]:
    return memory.measure([core], names, lambda text: None)


def _memory(measured: list[list[memory.Row]]) -> Section:
    rows = [row for own in measured for row in own]
    over = [row for row in rows if row.goal is not None and row.bytes > row.goal]
    sizes = {row.name: row.bytes for row in rows if row.kind == "size"}
    deepest = max((row.bytes for row in rows if row.kind == "call"), default=0)
    return Section(
        key="memory",
        title="Memory",
        command="tools/cairn bench --memory",
        finding=f"A body takes {sizes['a body']} bytes, an arbiter {sizes['an arbiter']}, a spring "
        f"{sizes['a spring']}, and no call of the library more than {deepest:,} bytes of stack.",
        meaning="A world's RAM is the sum of its pools, fixed when it is compiled: bodies, arbiters (one for each pair "
        "that touches or nearly does), springs, and the tree where it is used. Nothing is allocated.",
        tone=BAD if over else GOOD,
        grids=[grid_of(table) for table in tables.memory_tables(rows)],
        data=tables.memory_record(rows),
    )


# ---- pictures ----

PICTURES = {"stack10": 240, "pyramid10": 240, "tower": 240, "heavy100": 240, "mixed50": 240, "circles100": 240,
            "balls50": 240, "curtain150": 240, "bridge": 400, "basic": 400, "rolling_demo": 240,
            "mass_proportions": 240}  # fmt: skip


def _picture_tasks(options: Options) -> list[Task]:
    names = ("stack10", "rolling_demo") if options.quick else PICTURES
    return [Task(f"picture of {name}", _picture, (name, PICTURES[name])) for name in names]


def _picture(name: str, steps: int) -> tuple[dict[str, Any], str]:
    loaded = scene.load(scene.find(name))
    got = engine.run(loaded, "q16", "host", steps, 4)
    about = {"scene": name, "steps": steps, "bodies": len(loaded.bodies), "springs": len(loaded.springs),
             "points": got.statistics["points"], "hash": got.hash}  # fmt: skip
    return about, draw.svg(loaded, got.trajectory.poses, got.contacts)


def _pictures(drawn: list[tuple[dict[str, Any], str]]) -> Section:
    figures = [Figure(about["scene"], data_uri(svg.encode(), "image/svg+xml"), caption=_caption(about))
               for about, svg in drawn]  # fmt: skip
    return Section(
        key="scenes",
        title="Scenes",
        command="tools/cairn run SCENE --steps N --svg FILE.svg",
        finding=f"{len(drawn)} scenes at their end, over where they came from.",
        meaning="Red: contact points and normals. Faint: earlier poses. The hash is that of the last state, equal on "
        "every compiler and core (tools/cairn golden).",
        figures=figures,
        data=[about for about, _ in drawn],
    )


def _caption(about: dict[str, Any]) -> str:
    springs = f", {about['springs']} springs" if about["springs"] else ""
    end = f"step {about['steps']}, {about['hash']}"
    return f"{about['bodies']} bodies{springs}, {about['points']} contact points; {end}"


STABILITY = Part("stability", "Stability", "tools/cairn stability", _stability_tasks, _stability)
BENCH = Part("bench", "What a step costs", "tools/cairn bench", _bench_tasks, _bench)
MEMORY = Part("memory", "Memory", "tools/cairn bench --memory", _memory_tasks, _memory)
SCENES = Part("scenes", "Scenes", "tools/cairn run SCENE --svg FILE.svg", _picture_tasks, _pictures)
