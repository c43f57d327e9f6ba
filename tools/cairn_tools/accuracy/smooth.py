"""Smooth scenes in metres: fixed point against double of the same settings, and both against closed forms.

A family passes if in none of its scenes rounding is above its limit, nor above a tenth of the total error where that is
more than 0.1 mm: then it is not rounding that limits accuracy.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from rich.table import Table

from .. import host
from ..oracle import closed_forms
from ..scene import Scene
from .smooth_scenes import FAMILIES, RATE, Family

VARIANTS = 50  # scenes of each family
SEED = 5
SHARE = 0.1
SMALL_TOTAL = 1e-4  # m


@dataclass(frozen=True)
class Run:
    """Of one scene: the largest distances in metres over all bodies and steps. The total needs a closed form."""

    scene: str
    rounding: float
    total: float

    @property
    def share(self) -> float:
        """Of the total that is rounding, where the total is not small."""
        return self.rounding / self.total if self.total > SMALL_TOTAL else 0.0


@dataclass(frozen=True)
class Row:
    """Of one family. Distances in metres; total errors and shares of those scenes that have a closed form."""

    family: str
    seconds: str  # of each scene
    scenes: int
    limit: float
    rounding: float  # the largest
    rounding_median: float
    worst: str  # which scene
    total_median: float
    total: float  # the largest
    total_limit: float
    share: float  # the largest of rounding in a total above 0.1 mm

    @property
    def passes(self) -> bool:
        return self.rounding <= self.limit and self.share <= SHARE and not self.total > self.total_limit


def measure(say: Callable[[str], None], scenes: int = VARIANTS, seed: int = SEED) -> list[Row]:
    """A row for each family, of so many scenes."""
    rows = []
    for number, family in enumerate(FAMILIES):
        say(family.name)
        rows.append(_row(family, [run(*family.scene(np.random.default_rng([seed, number, k]))) for k in range(scenes)]))
    return rows


def run(scene: Scene, seconds: float) -> Run:
    """Both engines' run of a scene."""
    steps = int(seconds * RATE)
    fixed, double = (_places(scene, arithmetic, steps) for arithmetic in ("q16", "f64"))
    form = closed_forms.find(scene)
    total = math.nan
    if form is not None and form.horizon >= steps / RATE:
        total = _largest(fixed - form.trajectory(scene, steps).poses[:, :, :2])
    return Run(scene.name, _largest(fixed - double), total)


def _places(scene: Scene, arithmetic: str, steps: int) -> np.ndarray:
    world, bodies = host.build(scene, arithmetic)
    return world.record(steps, 1, bodies)[:, :, :2]


def _largest(way: np.ndarray) -> float:
    return float(np.hypot(way[:, :, 0], way[:, :, 1]).max())


def _row(family: Family, runs: list[Run]) -> Row:
    worst = max(runs, key=lambda run: run.rounding)
    totals = [run.total for run in runs if not math.isnan(run.total)]
    return Row(family.name, family.seconds, len(runs), family.limit, worst.rounding,
               float(np.median([run.rounding for run in runs])), worst.scene,
               float(np.median(totals)) if totals else math.nan, max(totals, default=math.nan), family.total_limit,
               max(run.share for run in runs))  # fmt: skip


def tables(rows: list[Row]) -> list[Table]:
    """A line a family."""
    grid = Table(title=f"Smooth scenes: largest position error, um, {rows[0].scenes} scenes each",
                 caption=f"share: of rounding in a total above {SMALL_TOTAL * 1e6:g} um, at most")  # fmt: skip
    for name in ("family", "s"):
        grid.add_column(name)
    for name in ("rounding", "its median", "limit", "total", "its median", "share", "passes"):
        grid.add_column(name, justify="right")
    for row in rows:
        metres = (row.rounding, row.rounding_median, row.limit, row.total, row.total_median)
        passes = "yes" if row.passes else "NO"
        grid.add_row(row.family, row.seconds, *(f"{x * 1e6:.3g}" for x in metres), f"{row.share:.1%}", passes)
    return [grid]
