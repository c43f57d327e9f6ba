"""How the cost of a step grows with the bodies: a packed pile and a sparse world, by the quadtree and along x."""

from __future__ import annotations

import json
import math
import random
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import bench, engine, scene

SIZES = (10, 25, 50, 100, 150, 200, 300, 400)
BROAD_PHASES = ("pairs", "quadtree")
FROM, TO = 50, 200  # the sizes that issue 4 holds the pile's growth between
FOLDER = engine.ROOT / "build" / "growth"
SEED = 7

Say = Callable[[str], None]


@dataclass(frozen=True)
class Point:
    """A world of one size."""

    kind: str
    broad_phase: str
    core: str
    bodies: int
    mean_instructions: float  # of steps 121 to 240
    worst_instructions: int  # of steps 1 to 240
    contact_points: int
    stack_bytes: int  # of the step
    hash: str

    @property
    def per_body(self) -> float:
        return self.mean_instructions / self.bodies

    @property
    def worst_per_body(self) -> float:
        return self.worst_instructions / self.bodies


def pile(count: int) -> dict[str, Any]:
    """Balls and boxes in turn that fall into a bin as wide as high, and lie packed in it."""
    columns = max(2, round(math.sqrt(count)))
    rows = math.ceil(count / columns)
    wide, high = 0.6 * columns + 0.3, 0.6 * rows + 2
    wall = [{"type": "static", "shape": "wall", "position": [side * (wide / 2 + 0.5), high / 2]} for side in (-1, 1)]
    fixed = [{"type": "static", "shape": "ground", "position": [0, -0.5]}, *wall]
    bodies = [
        {
            "shape": ("ball", "box")[(i % columns + i // columns) % 2],
            "position": [
                round(0.6 * (i % columns - (columns - 1) / 2) + 0.1 * (i // columns % 2), 3),
                round(0.4 + 0.6 * (i // columns), 3),
            ],
        }
        for i in range(count)
    ]
    shapes = {"ground": {"box": [wide + 4, 1]}, "wall": {"box": [1, high]}, "ball": {"circle": 0.25}}
    return {"shapes": {**shapes, "box": {"box": [0.5, 0.5]}}, "bodies": fixed + bodies}


def sparse(count: int) -> dict[str, Any]:
    """Balls and boxes of half a metre, 3 m from each other, that drift without gravity and meet now and then."""
    rng = random.Random(SEED)
    columns = math.ceil(math.sqrt(count))

    def near(place: float, by: float) -> float:
        return round(place + rng.uniform(-by, by), 3)

    bodies = [
        {
            "shape": ("ball", "box")[i % 2],
            "position": [near(3 * (i % columns), 0.5), near(3 * (i // columns), 0.5)],
            "velocity": [near(0, 1), near(0, 1)],
        }
        for i in range(count)
    ]
    return {"gravity": [0, 0], "shapes": {"ball": {"circle": 0.25}, "box": {"box": [0.5, 0.5]}}, "bodies": bodies}


KINDS: dict[str, Callable[[int], dict[str, Any]]] = {"pile": pile, "sparse": sparse}


def load(kind: str, count: int, broad_phase: str) -> scene.Scene:
    """A world as a scene; its file is in build/growth."""
    name = f"{kind}-{count}-{broad_phase}"
    FOLDER.mkdir(parents=True, exist_ok=True)
    path = FOLDER / f"{name}.json"
    data = {"cairn_scene": 1, "name": name, "broad_phase": broad_phase, **KINDS[kind](count)}
    path.write_text(json.dumps(data), encoding="utf-8")
    return scene.load(path)


def measure(cores: Iterable[str], sizes: Sequence[int], say: Say) -> list[Point]:
    """All worlds; the broad phase may not change what happens in them."""
    points = []
    for core in cores:
        for kind in KINDS:
            for count in sizes:
                both = []
                for broad_phase in BROAD_PHASES:
                    say(f"{kind} of {count} by {broad_phase} on {core}")
                    cost = bench.measure(load(kind, count, broad_phase), core)
                    both.append(Point(
                        kind, broad_phase, core, count, cost.mean_instructions, cost.worst_instructions_from_start,
                        cost.points, cost.step_stack_bytes, cost.hash))  # fmt: skip
                if len({point.hash for point in both}) > 1:
                    raise engine.EngineError(f"{kind} of {count} on {core}: the broad phase changes what happens")
                points += both
    return points


def select(points: Iterable[Point], core: str, kind: str, broad_phase: str) -> list[Point]:
    """A line of the plot."""
    return [p for p in points if (p.core, p.kind, p.broad_phase) == (core, kind, broad_phase)]


def crossover(sizes: Sequence[float], pairs: Sequence[float], quadtree: Sequence[float]) -> float | None:
    """From how many bodies on the quadtree costs less: between two sizes by a straight line; None if never."""
    gains = [a - b for a, b in zip(pairs, quadtree, strict=True)]
    if gains[-1] <= 0:
        return None
    last = max((i for i, gain in enumerate(gains) if gain <= 0), default=-1)
    if last < 0:
        return sizes[0]
    part = -gains[last] / (gains[last + 1] - gains[last])
    return sizes[last] + part * (sizes[last + 1] - sizes[last])


def summary(points: Sequence[Point]) -> list[dict[str, Any]]:
    """Per core and kind: the crossover, the growth per body, and what a body costs in a world of 200."""
    found = []
    for core in dict.fromkeys(point.core for point in points):
        for kind in dict.fromkeys(point.kind for point in points):
            lines = {broad: select(points, core, kind, broad) for broad in BROAD_PHASES}
            means = {broad: [point.mean_instructions for point in line] for broad, line in lines.items()}
            sizes = [point.bodies for point in lines["pairs"]]
            row: dict[str, Any] = {"core": core, "kind": kind, "crossover": crossover(sizes, **means)}
            for broad, line in lines.items():
                at = {point.bodies: point.per_body for point in line}
                growth = 100 * (at[TO] / at[FROM] - 1) if FROM in at and TO in at else None
                row[broad] = {"growth_percent": growth, "per_body": at.get(TO)}
            row["stack_bytes"] = max(point.stack_bytes for line in lines.values() for point in line)
            found.append(row)
    return found


def plot(points: Sequence[Point], core: str, file: Path) -> None:
    """Instructions a body over bodies: a panel a kind."""
    import matplotlib  # only where it is wanted: it takes a second to load

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, panels = plt.subplots(1, len(KINDS), figsize=(10, 4.2), layout="constrained")
    titles = {"pile": "packed pile", "sparse": "sparse world"}
    colours = {"pairs": "#c0504d", "quadtree": "#2f6db3"}
    names = {"pairs": "along x", "quadtree": "quadtree"}
    for panel, kind in zip(panels, KINDS, strict=True):
        for broad in BROAD_PHASES:
            line = select(points, core, kind, broad)
            sizes = [point.bodies for point in line]
            panel.plot(sizes, [point.per_body for point in line], "o-", ms=4, color=colours[broad],
                       label=f"{names[broad]}, mean")  # fmt: skip
            panel.plot(sizes, [point.worst_per_body for point in line], "--", lw=1, color=colours[broad],
                       label=f"{names[broad]}, worst step")  # fmt: skip
        rows = [row for row in summary(points) if row["core"] == core and row["kind"] == kind]
        if rows[0]["crossover"]:
            panel.axvline(rows[0]["crossover"], color="grey", lw=1, ls=":")
            panel.text(rows[0]["crossover"], 0, f" {rows[0]['crossover']:.0f} bodies", color="grey", va="bottom")
        panel.set(title=titles[kind], xlabel="bodies", ylabel=f"instructions a body and step, {core}")
        panel.set_ylim(bottom=0)
        panel.yaxis.set_major_formatter(lambda value, _: f"{value:,.0f}")
        panel.grid(alpha=0.3)
        panel.legend(fontsize=8)
    figure.savefig(file, dpi=110)
    plt.close(figure)
