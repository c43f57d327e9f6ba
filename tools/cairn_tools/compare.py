"""How far runs of one scene are apart, and why: rounding, solver, time step, each by the run that is without it.

    rounding    fixed point (q16) against the same algorithm in double (f64)
    solver      f64 against the constraints solved to convergence at the same sub-step, integrated as the engine does
    time step   the latter against the reference: a closed form, or the oracle at dt/64
    total       q16 against the reference

Positions in metres, angles in radians, over what can move. The signed differences add up to the total; the sizes told
here need not.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from . import engine, horizon, reference
from .horizon import Horizon
from .overlap import Surfaces
from .physics import Physics
from .scene import Scene
from .trajectory import Trajectory

RUNS = ("q16", "f64", "converged", "reference")
ERRORS = ("rounding", "solver", "time step")


@dataclass(frozen=True)
class Difference:
    """Root mean square and largest difference over the bodies at one step, or over all steps (step None)."""

    step: int | None
    rms_position: float
    max_position: float
    rms_angle: float
    max_angle: float
    worst_body: int


@dataclass(frozen=True)
class Outcome:
    """What of a run can be compared when its bodies cannot. Energy is above the start's, in joules."""

    run: str
    energy: float
    highest_energy: float
    momentum: tuple[float, float]
    deepest_penetration: float
    mean_height: float
    top_height: float
    seconds_to_rest: float  # not a number: it does not come to rest


@dataclass(frozen=True)
class Comparison:
    """Differences step by step up to the horizon, and over all of these; outcomes at the end of the whole run."""

    scene: str
    steps: int
    reference: str
    horizon: Horizon
    errors: dict[str, list[Difference]]
    overall: dict[str, Difference]
    outcomes: list[Outcome]


Say = Callable[[str], None]


def compare(scene: Scene, steps: int, say: Say, with_oracle: bool = True) -> Comparison:
    """Runs the engine twice, their twins, and the oracle twice."""
    runs = {}
    for name in RUNS[:2]:
        say(f"{scene.name}: {name}")
        runs[name] = engine.run(scene, name, "host", steps, 1).trajectory
    say(f"{scene.name}: twins an LSB away")
    until = horizon.find(scene, runs)
    against = ""
    if with_oracle:
        say(f"{scene.name}: converged")
        runs["converged"] = reference.converged(scene, steps)
        say(f"{scene.name}: reference")
        against, runs["reference"] = reference.best(scene, steps)
    pairs = dict(zip(ERRORS, pairwise(runs), strict=False))
    if with_oracle:
        pairs["total"] = ("q16", "reference")
    cut = {name: _until(run, until.step) for name, run in runs.items()}
    return Comparison(
        scene=scene.name,
        steps=steps,
        reference=against,
        horizon=until,
        errors={name: differences(scene, cut[a], cut[b]) for name, (a, b) in pairs.items()},
        overall={name: overall(scene, cut[a], cut[b]) for name, (a, b) in pairs.items()},
        outcomes=[outcome(scene, name, run) for name, run in runs.items()],
    )


def outcome(scene: Scene, name: str, run: Trajectory) -> Outcome:
    """Of a run that recorded every step."""
    physics, surfaces = Physics(scene), Surfaces.of(scene)
    energy = physics.energy(run.states)
    heights = physics.heights(run.states[-1:])[0]
    return Outcome(
        run=name,
        energy=float(energy[-1] - energy[0]),
        highest_energy=float(energy.max() - energy[0]),
        momentum=tuple(map(float, physics.momentum(run.states[-1:])[0])),
        deepest_penetration=max(surfaces.penetration(poses) for poses in run.poses),
        mean_height=float(heights.mean()),
        top_height=float(heights.max()),
        seconds_to_rest=physics.time_to_rest(run),
    )


def differences(scene: Scene, a: Trajectory, b: Trajectory) -> list[Difference]:
    """One entry a recorded step, of two runs recorded at the same steps."""
    moving, distance, turn = _gaps(scene, a, b)
    return [_summed(int(step), moving, distance[k : k + 1], turn[k : k + 1]) for k, step in enumerate(a.steps)]


def overall(scene: Scene, a: Trajectory, b: Trajectory) -> Difference:
    """The same over all recorded steps together."""
    return _summed(None, *_gaps(scene, a, b))


def selected(entries: list[Difference], count: int = 10) -> list[Difference]:
    """About `count` of them, evenly spaced, the first and the last included."""
    if len(entries) <= count:
        return entries
    return [entries[round(k * (len(entries) - 1) / (count - 1))] for k in range(count)]


def _until(run: Trajectory, step: int) -> Trajectory:
    kept = run.steps <= step
    return Trajectory(run.steps[kept], run.states[kept])


def _gaps(scene: Scene, a: Trajectory, b: Trajectory) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Indices of the bodies that can move; distance and angle between the runs, by step and such body."""
    if not np.array_equal(a.steps, b.steps):
        raise ValueError("the two runs were recorded at different steps")
    moving = np.array([i for i, body in enumerate(scene.bodies) if not body.static], dtype=int)
    if len(moving) == 0:
        moving = np.arange(len(scene.bodies))
    gap = (a.poses - b.poses)[:, moving]
    return moving, np.hypot(gap[:, :, 0], gap[:, :, 1]), np.abs(gap[:, :, 2])


def _summed(step: int | None, moving: np.ndarray, distance: np.ndarray, turn: np.ndarray) -> Difference:
    return Difference(
        step=step,
        rms_position=float(np.sqrt(np.mean(distance**2))),
        max_position=float(distance.max()),
        rms_angle=float(np.sqrt(np.mean(turn**2))),
        max_angle=float(turn.max()),
        worst_body=int(moving[np.unravel_index(distance.argmax(), distance.shape)[1]]),
    )
