"""How far two runs of one scene are apart: positions in metres, angles in radians, over what can move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .scene import Scene
from .trajectory import Trajectory


@dataclass(frozen=True)
class Difference:
    """Root mean square and largest difference over the bodies at one step, or over all steps (step None)."""

    step: int | None
    rms_position: float
    max_position: float
    rms_angle: float
    max_angle: float
    worst_body: int


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
