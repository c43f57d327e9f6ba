"""Two ways to integrate an oscillator: symplectic Euler, which the engine is built on, and Adams-Bashforth 2.

The slides' claim: a multi-step method is more accurate and no more stable. A body of 1 kg hangs on a spring without
damping and swings for two seconds in the oracle, at one evaluation of the force a step and ever finer steps; the
closed form says where it is. Symplectic Euler is of first order, stable while w dt < 2, and keeps the energy within
bounds. Adams-Bashforth is of second order; its amplitude grows by a share of (w dt)^4 / 4 in each step: it is stable
at no step, and near enough to it at fine ones.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from rich.table import Table

from .. import oracle
from ..oracle import closed_forms
from ..physics import Physics
from ..scene import Body, Scene, Shape, Spring

METHODS = {"symplectic": "symplectic Euler", "adams-bashforth": "Adams-Bashforth 2"}
STIFFNESS = 1000.0  # N/m: w = 31.6 /s, 5 Hz
RATES = (15, 16, 20, 30, 60, 120, 240, 480, 960, 1920, 3840)
SECONDS = 2


@dataclass(frozen=True)
class Point:
    """Of one method at one rate. What left all bounds is infinite."""

    method: str
    steps_per_second: int
    w_dt: float
    rms_error: float  # metres; the amplitude is 0.2
    energy_ratio: float  # the highest there was, over the start's


def scene_of(rate: int) -> Scene:
    """A ball 0.2 m from where its spring is at rest."""
    shapes = {"ball": Shape("circle", math.sqrt(1 / math.pi))}
    bodies = [Body("ball", (0, 0), type="static"), Body("ball", (2.2, 0))]
    spring = Spring(0, 1, rest_length=2.0, stiffness=STIFFNESS, collide=False)
    return Scene("oscillator", shapes, bodies, Path("oscillator.json"), [spring], gravity=(0, 0), steps_per_second=rate)


def measure(say: Callable[[str], None], rates: tuple[int, ...] = RATES) -> list[Point]:
    """All methods at all these rates."""
    points = []
    for method in METHODS:
        for rate in rates:
            say(f"{METHODS[method]} at {rate} steps a second")
            points.append(_point(method, rate))
    return points


def _point(method: str, rate: int) -> Point:
    scene = scene_of(rate)
    steps = SECONDS * rate
    exact = closed_forms.find(scene)
    assert exact is not None
    got = oracle.run(scene, steps, fineness=1, method=method).trajectory
    way = got.poses[:, 1, 0] - exact.trajectory(scene, steps).poses[:, 1, 0]
    energy = Physics(scene).energy(got.states)
    w_dt = math.sqrt(STIFFNESS) / rate
    values = (float(np.sqrt(np.mean(way**2))), float(energy.max() / energy[0]))
    return Point(method, rate, w_dt, *(value if value < 1e6 else math.inf for value in values))


def tables(points: list[Point]) -> list[Table]:
    """A line a rate."""
    grid = Table(title=f"An oscillator of 5 Hz, {SECONDS} s, amplitude 0.2 m", caption="RMS error, m; highest energy")
    grid.add_column("steps a second", justify="right")
    grid.add_column("w dt", justify="right")
    for name in METHODS.values():
        grid.add_column(name, justify="right")
        grid.add_column("energy", justify="right")
    for rate in dict.fromkeys(p.steps_per_second for p in points):
        of_rate = [next(p for p in points if p.method == m and p.steps_per_second == rate) for m in METHODS]
        cells = [cell for p in of_rate for cell in (_number(p.rms_error, ".1e"), _number(p.energy_ratio, ".3f"))]
        grid.add_row(str(rate), f"{of_rate[0].w_dt:.3f}", *cells)
    return [grid]


def _number(value: float, form: str) -> str:
    return "unstable" if math.isinf(value) else f"{value:{form}}"


def plot(points: list[Point], file: Path) -> Path:
    """Error and energy against w dt."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for method, name in METHODS.items():
        own = [p for p in points if p.method == method and math.isfinite(p.rms_error)]
        left.loglog([p.w_dt for p in own], [p.rms_error for p in own], "o-", label=name)
        right.loglog([p.w_dt for p in own], [p.energy_ratio for p in own], "o-", label=name)
    left.axhline(0.2, color="0.6", lw=0.8, ls="--")
    left.set(xlabel="w dt", ylabel="RMS error, m (dashed: the amplitude)", ylim=(1e-6, 10))
    right.axvline(2, color="0.6", lw=0.8, ls="--")
    right.set(xlabel="w dt (dashed: 2)", ylabel="highest energy over the start's", ylim=(0.9, 1e3))
    for axes in (left, right):
        axes.grid(alpha=0.3)
        axes.legend(fontsize=8)
    figure.savefig(file, dpi=100)
    plt.close(figure)
    return file
