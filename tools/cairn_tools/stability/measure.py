"""What is measured of states of a world, by code that shares nothing with the engine."""

from __future__ import annotations

import numpy as np

from ..host import ANGLE, OMEGA, STATIC, VX, VY, Shape, World, X, Y
from ..overlap import Surfaces, distances, overlaps, pairs_of_free


class Outlines(Surfaces):
    """The shapes of a world's bodies, to measure how deep they are in one another."""

    def __init__(self, world: World, bodies: list[int] | None = None) -> None:
        self.world = world
        self.bodies = list(world.shapes) if bodies is None else bodies
        shapes = [world.shapes[body] for body in self.bodies]
        outlines = [(shape.radius, shape.corners) for shape in shapes]
        super().__init__(outlines, pairs_of_free(np.array([world.types[body] != STATIC for body in self.bodies])))

    def penetration(self, states: np.ndarray | None = None) -> float:
        """The deepest overlap of any two bodies, 0 where none overlap. States [body, value] of `bodies`."""
        return super().penetration(self.world.states(self.bodies) if states is None else states)

    def depths(self, states: np.ndarray | None = None) -> np.ndarray:
        """The overlaps of the pairs whose boxes overlap: positive is how far to move apart."""
        return super().depths(self.world.states(self.bodies) if states is None else states)


def separations(shape: Shape, other: Shape, states: np.ndarray) -> np.ndarray:
    """How far a shape in each of these states is from a polygon at the origin; at corners less, negative inside it."""
    assert other.corners is not None
    fixed = np.broadcast_to(other.corners, (len(states), *other.corners.shape))
    if shape.corners is None:
        return distances(states[:, [X, Y]], fixed) - shape.radius
    c, s = np.cos(states[:, ANGLE])[:, None], np.sin(states[:, ANGLE])[:, None]
    x, y = shape.corners.T
    outline = np.stack([c * x - s * y, s * x + c * y], axis=2) + states[:, None, [X, Y]]
    return -overlaps(outline, fixed)


def moved(states: np.ndarray, since: int = 0, axes: tuple[int, ...] = (X, Y)) -> float:
    """The farthest any centre was from where it was at record `since`, then or later."""
    way = states[since:, :, list(axes)] - states[since, :, list(axes)].T
    return float(np.sqrt((way**2).sum(axis=2)).max())


def fastest(states: np.ndarray, world: World | None = None, bodies: list[int] | None = None) -> float:
    """The greatest speed of any body in these records; with a world, that of the fastest corner."""
    speed = np.hypot(states[:, :, VX], states[:, :, VY])
    if world is not None:
        names = world.moving if bodies is None else bodies
        reach = np.array([_reach(world.shapes[body]) for body in names])
        speed = speed + np.abs(states[:, :, OMEGA]) * reach
    return float(speed.max())


def _reach(shape: Shape) -> float:
    return shape.radius if shape.corners is None else float(np.hypot(*shape.corners.T).max())


def kinetic_energy(world: World, states: np.ndarray, bodies: list[int] | None = None) -> np.ndarray:
    """Of each record."""
    names = world.moving if bodies is None else bodies
    mass = np.array([world.mass(body) for body in names])
    inertia = np.array([world.inertia(body) for body in names])
    speed = states[:, :, VX] ** 2 + states[:, :, VY] ** 2
    return 0.5 * (mass * speed + inertia * states[:, :, OMEGA] ** 2).sum(axis=1)


def potential_energy(world: World, states: np.ndarray, bodies: list[int] | None = None) -> np.ndarray:
    """Of gravity, of each record."""
    names = world.moving if bodies is None else bodies
    mass = np.array([world.mass(body) for body in names])
    gx, gy = world.gravity
    return -(mass * (gx * states[:, :, X] + gy * states[:, :, Y])).sum(axis=1)
