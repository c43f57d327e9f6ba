"""What is measured of states, by code that shares nothing with the engine: separating axes in double, with numpy."""

from __future__ import annotations

import numpy as np

from ..host import ANGLE, OMEGA, STATIC, VX, VY, Shape, World, X, Y


class Outlines:
    """The shapes of a world's bodies as arrays, to measure how deep they are in one another."""

    def __init__(self, world: World, bodies: list[int] | None = None) -> None:
        self.world = world
        self.bodies = list(world.shapes) if bodies is None else bodies
        shapes = [world.shapes[body] for body in self.bodies]
        self.round = np.array([shape.corners is None for shape in shapes])
        self.radius = np.array([shape.radius for shape in shapes])
        count = max((len(s.corners) for s in shapes if s.corners is not None), default=1)
        # A corner more does no harm if it is one that is there already.
        self.corners = np.array([_padded(shape, count) for shape in shapes])
        self.reach = np.where(self.round, self.radius, np.hypot(*np.moveaxis(self.corners, 2, 0)).max(axis=1))
        free = np.array([world.types[body] != STATIC for body in self.bodies])
        a, b = np.triu_indices(len(self.bodies), 1)
        both = free[a] | free[b]
        self.a, self.b = a[both], b[both]

    def penetration(self, states: np.ndarray | None = None) -> float:
        """The deepest overlap of any two bodies, 0 where none overlap. States [body, value] of `bodies`."""
        depths = self.depths(states)
        return float(depths.max(initial=0.0))

    def depths(self, states: np.ndarray | None = None) -> np.ndarray:
        """The overlaps of the pairs whose circles overlap: positive is how far to move apart."""
        states = self.world.states(self.bodies) if states is None else states
        centre = states[:, [X, Y]]
        c, s = np.cos(states[:, ANGLE])[:, None], np.sin(states[:, ANGLE])[:, None]
        x, y = self.corners[:, :, 0], self.corners[:, :, 1]
        outline = np.stack([c * x - s * y, s * x + c * y], axis=2) + centre[:, None, :]
        low, high = outline.min(axis=1), outline.max(axis=1)
        low = np.where(self.round[:, None], centre - self.radius[:, None], low)
        high = np.where(self.round[:, None], centre + self.radius[:, None], high)
        near = ((low[self.a] <= high[self.b]) & (low[self.b] <= high[self.a])).all(axis=1)
        a, b = self.a[near], self.b[near]
        out = []
        both = self.round[a] & self.round[b]
        if both.any():
            i, j = a[both], b[both]
            gap = np.hypot(*(centre[i] - centre[j]).T)
            out.append(self.radius[i] + self.radius[j] - gap)
        for i, j in ((a, b), (b, a)):
            mixed = self.round[i] & ~self.round[j]
            if mixed.any():
                out.append(self.radius[i[mixed]] - _distances(centre[i[mixed]], outline[j[mixed]]))
        none = ~self.round[a] & ~self.round[b]
        if none.any():
            out.append(_overlaps(outline[a[none]], outline[b[none]]))
        return np.concatenate(out) if out else np.zeros(0)


def _padded(shape: Shape, count: int) -> np.ndarray:
    if shape.corners is None:
        return np.zeros((count, 2))
    return np.vstack([shape.corners, np.repeat(shape.corners[-1:], count - len(shape.corners), axis=0)])


def _normals(outline: np.ndarray) -> np.ndarray:
    """Outward unit normals [polygon, edge, 2]; the edges of no length of a padded outline repeat another's."""
    edge = np.roll(outline, -1, axis=1) - outline
    normal = np.stack([edge[:, :, 1], -edge[:, :, 0]], axis=2)
    length = np.hypot(normal[:, :, 0], normal[:, :, 1])
    flat = length < 1e-12
    normal = normal / np.where(flat, 1.0, length)[:, :, None]
    return np.where(flat[:, :, None], normal[:, :1], normal)


def _overlaps(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """The least overlap of each pair of polygons over the normals of both: negative if they are apart."""
    least = np.full(len(p), np.inf)
    for first, second in ((p, q), (q, p)):
        axes = _normals(first)
        ahead = np.einsum("nek,nvk->nev", axes, first).max(axis=2)
        behind = np.einsum("nek,nvk->nev", axes, second).min(axis=2)
        least = np.minimum(least, (ahead - behind).min(axis=1))
    return least


def _distances(points: np.ndarray, outline: np.ndarray) -> np.ndarray:
    """Signed distance of each point from its polygon, negative inside."""
    edge = np.roll(outline, -1, axis=1) - outline
    to = points[:, None, :] - outline
    length = (edge**2).sum(axis=2)
    along = np.clip((to * edge).sum(axis=2) / np.where(length > 0, length, 1.0), 0.0, 1.0)
    nearest = np.hypot(*np.moveaxis(to - along[:, :, None] * edge, 2, 0)).min(axis=1)
    inside = ((_normals(outline) * to).sum(axis=2)).max(axis=1)
    return np.where(inside < 0, inside, nearest)


def separations(shape: Shape, other: Shape, states: np.ndarray) -> np.ndarray:
    """How far a shape in each of these states is from a polygon at the origin; at corners less, negative inside it."""
    assert other.corners is not None
    fixed = np.broadcast_to(other.corners, (len(states), *other.corners.shape))
    if shape.corners is None:
        return _distances(states[:, [X, Y]], fixed) - shape.radius
    c, s = np.cos(states[:, ANGLE])[:, None], np.sin(states[:, ANGLE])[:, None]
    x, y = shape.corners.T
    outline = np.stack([c * x - s * y, s * x + c * y], axis=2) + states[:, None, [X, Y]]
    return -_overlaps(outline, fixed)


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
