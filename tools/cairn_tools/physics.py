"""Energy, momentum and rest of a run, from its states and the scene file: the same for every engine and the oracle.

States are those of a trajectory: x and y of the shape's origin, angle, velocity of the centre of mass.
"""

from __future__ import annotations

import math

import numpy as np

from .oracle import model
from .oracle.model import ANGLE, OMEGA, VX, VY, Array, Bodies
from .scene import Scene
from .trajectory import Trajectory

REST_SPEED = 0.01  # m/s, of the fastest point of a body: below it a body rests


class Physics:
    """Of one scene. Records are states [record, body, value]."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.bodies: Bodies = model.bodies_of(scene)
        free = np.array([not body.static for body in scene.bodies])
        self.moving = np.flatnonzero(free) if free.any() else np.arange(len(free))
        self._mass, self._inertia = (
            np.divide(1.0, inverse, out=np.zeros(len(inverse)), where=inverse > 0)
            for inverse in (self.bodies.inverse_mass, self.bodies.inverse_inertia)
        )
        corners = np.hypot(*np.moveaxis(self.bodies.corners, 2, 0)).max(axis=1)
        self._reach = np.maximum(self.bodies.radius, corners)
        self._springs = [(s, model.hooke(s, self.bodies)[0]) for s in scene.springs]
        size = math.hypot(*scene.gravity)
        self._up = -np.array(scene.gravity) / size if size else np.array([0.0, 1.0])

    def centres(self, states: Array) -> Array:
        """Centres of mass [record, body, 2]."""
        return states[:, :, :2] + _turned(self.bodies.centres, states[:, :, ANGLE])

    def energy(self, states: Array) -> Array:
        """Of motion, of the height above the first record, and of the springs; of each record."""
        kinetic = 0.5 * (self._mass * (states[:, :, VX] ** 2 + states[:, :, VY] ** 2)).sum(axis=1)
        kinetic += 0.5 * (self._inertia * states[:, :, OMEGA] ** 2).sum(axis=1)
        centres = self.centres(states)
        potential = -((centres - centres[:1]) @ np.array(self.scene.gravity) * self._mass).sum(axis=1)
        return kinetic + potential + self.spring_energy(states)

    def spring_energy(self, states: Array) -> Array:
        """By Hooke's law, of each record."""
        total = np.zeros(len(states))
        for spring, stiffness in self._springs:
            a, b = (
                states[:, i, :2] + _turned(np.array(anchor), states[:, i, ANGLE])
                for i, anchor in ((spring.a, spring.anchor_a), (spring.b, spring.anchor_b))
            )
            total += 0.5 * stiffness * (np.hypot(*(b - a).T) - spring.rest_length) ** 2
        return total

    def momentum(self, states: Array) -> Array:
        """Of all that moves [record, 2], without spin."""
        return np.einsum("b,tbk->tk", self._mass, states[:, :, [VX, VY]])

    def speeds(self, states: Array) -> Array:
        """Of the fastest point of each body that moves [record, moving body]."""
        fastest = np.hypot(states[:, :, VX], states[:, :, VY]) + np.abs(states[:, :, OMEGA]) * self._reach
        return fastest[:, self.moving]

    def strides(self, before: Array, after: Array) -> Array:
        """How far the farthest point of each body went, at most, between two poses [body, value]."""
        centres = self.centres(np.stack([before, after]))
        return np.hypot(*(centres[1] - centres[0]).T) + np.abs(after[:, ANGLE] - before[:, ANGLE]) * self._reach

    def heights(self, states: Array) -> Array:
        """Centres of mass against gravity [record, moving body]; along y where there is none."""
        return (self.centres(states) @ self._up)[:, self.moving]

    def time_to_rest(self, run: Trajectory) -> float:
        """Seconds until all bodies rest, and do to the end; not a number if they do not."""
        awake = np.flatnonzero((self.speeds(run.states) > REST_SPEED).any(axis=1))
        if len(awake) == 0:
            return 0.0
        if awake[-1] == len(run.steps) - 1:
            return math.nan
        return float(run.steps[awake[-1] + 1]) / self.scene.steps_per_second


def _turned(points: Array, angles: Array) -> Array:
    """Points [..., 2] turned by angles."""
    c, s = np.cos(angles), np.sin(angles)
    x, y = points[..., 0], points[..., 1]
    return np.stack([c * x - s * y, s * x + c * y], axis=-1)
