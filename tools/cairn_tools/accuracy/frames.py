"""How wrong a run is, from its poses at each frame: the same function for every engine."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from ..overlap import Surfaces
from ..physics import Physics
from ..scene import Scene
from .reference import FRAMES, Reference
from .rows import Errors

LAST = 5  # the last one in so many frames is looked at for rest
STILL = 0.001  # metres that no point of a body at rest goes in a frame: 3 cm/s
NEAR = 0.05  # metres: what is farther from everything rests on nothing


def errors(scene: Scene, poses: np.ndarray, reference: Reference) -> Errors:
    """Of poses [frame, body, 3], in which a body that was lost is not a number: then nothing is."""
    if not np.isfinite(poses).all():
        return Errors(*[math.inf] * 7)
    physics, surfaces = Physics(scene), Surfaces.of(scene)
    way = physics.centres(poses)[:, physics.moving]
    count = len(reference.poses)
    gap = np.hypot(*np.moveaxis(way[:count] - physics.centres(reference.poses)[:, physics.moving], 2, 0))
    deepest = [surfaces.penetration(frame) for frame in poses]
    last = len(poses) - 1 - (len(poses) - 1) // LAST
    moved = np.hypot(*np.moveaxis(way[last:] - way[last], 2, 0))
    return Errors(
        rms_error=float(np.sqrt(np.mean(gap**2))),
        largest_error=float(gap.max()),
        penetration=max(deepest),
        mean_penetration=float(np.mean(deepest)),
        contact_error=_contact_error(physics, surfaces, poses[last:]),
        drift=float(moved.max()),
        energy_gained=_energy_gained(physics, scene, poses),
    )


def _contact_error(physics: Physics, surfaces: Surfaces, poses: np.ndarray) -> float:
    """RMS over frames and bodies at rest; not a number if none rests on anything."""
    squares: list[float] = []
    for before, now in pairwise(poses):
        gap = _nearest(surfaces, now)
        own = physics.moving[(physics.strides(before, now) < STILL)[physics.moving]]
        squares += list(gap[own][np.isfinite(gap[own])] ** 2)
    return math.sqrt(sum(squares) / len(squares)) if squares else math.nan


def _nearest(surfaces: Surfaces, poses: np.ndarray) -> np.ndarray:
    """Distance of each body to what is nearest, negative inside it; infinite where nothing is near."""
    a, b, gap = surfaces.gaps(poses, NEAR)
    least = np.full(len(poses), math.inf)
    np.minimum.at(least, a, gap)
    np.minimum.at(least, b, gap)
    return np.where(least > NEAR, math.inf, least)


def _energy_gained(physics: Physics, scene: Scene, poses: np.ndarray) -> float:
    """Velocities are differences over two frames, exact in free flight; those of the start are the scene's."""
    states = np.zeros((len(poses), len(scene.bodies), 6))
    states[:, :, :3] = poses
    states[1:-1, :, 3:] = (poses[2:] - poses[:-2]) * (FRAMES / 2)
    states[0, :, 3:] = physics.bodies.states[:, 3:]
    energy = physics.energy(states[:-1])
    return float(max(energy.max() - energy[0], 0.0))
