"""How deep bodies lie in one another, or how far apart: of poses alone, whatever engine they are from.

Separating axes in double, with numpy; it shares nothing with the engine. Two polygons that overlap have the depth of
their least separating axis. Apart, the same axes give their distance where an edge faces the other, and less than it
where two corners do.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .oracle import model
from .scene import Scene

X, Y, ANGLE = range(3)
Outline = tuple[float, np.ndarray | None]  # a radius, or corners


class Surfaces:
    """The outlines of bodies as arrays. Poses are [body, value], the values x, y, angle and more if there are."""

    def __init__(self, outlines: Sequence[Outline], pairs: np.ndarray) -> None:
        """The pairs [pair, 2] are those that are looked at."""
        self.round = np.array([corners is None for _, corners in outlines])
        self.radius = np.array([radius for radius, _ in outlines])
        count = max((len(corners) for _, corners in outlines if corners is not None), default=1)
        # A corner more does no harm if it is one that is there already.
        self.corners = np.array([_padded(corners, count) for _, corners in outlines])
        self.a, self.b = pairs.T

    @staticmethod
    def of(scene: Scene) -> Surfaces:
        """Of a scene file, for poses of the shapes' origins: the pairs that push one another when they touch."""
        shapes = [scene.shape_of(body) for body in scene.bodies]
        pairs = np.array(model.pairs_that_meet(scene), dtype=int).reshape(-1, 2)
        return Surfaces([(s.radius, np.array(s.corners) if s.corners else None) for s in shapes], pairs)

    def penetration(self, poses: np.ndarray) -> float:
        """The deepest overlap of any two bodies, 0 where none overlap."""
        return float(self.depths(poses).max(initial=0.0))

    def depths(self, poses: np.ndarray) -> np.ndarray:
        """The overlaps of the pairs whose boxes overlap: positive is how far to move apart."""
        return -self.gaps(poses)[2]

    def gaps(self, poses: np.ndarray, within: float = 0.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The pairs whose boxes are within this distance: a, b and how far apart they are, negative if they overlap."""
        centre = poses[:, [X, Y]]
        outline, low, high = self._placed(poses, within / 2)
        near = ((low[self.a] <= high[self.b]) & (low[self.b] <= high[self.a])).all(axis=1)
        a, b = self.a[near], self.b[near]
        gap = np.empty(len(a))
        both = self.round[a] & self.round[b]
        between = np.hypot(*(centre[a[both]] - centre[b[both]]).T)
        gap[both] = between - self.radius[a[both]] - self.radius[b[both]]
        for i, j in ((a, b), (b, a)):
            mixed = self.round[i] & ~self.round[j]
            if mixed.any():
                gap[mixed] = distances(centre[i[mixed]], outline[j[mixed]]) - self.radius[i[mixed]]
        none = ~self.round[a] & ~self.round[b]
        if none.any():
            gap[none] = -overlaps(outline[a[none]], outline[b[none]])
        return a, b, gap

    def _placed(self, poses: np.ndarray, margin: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The corners in the world, and the boxes around the bodies, each side farther out by the margin."""
        centre = poses[:, [X, Y]]
        c, s = np.cos(poses[:, ANGLE])[:, None], np.sin(poses[:, ANGLE])[:, None]
        x, y = self.corners[:, :, 0], self.corners[:, :, 1]
        outline = np.stack([c * x - s * y, s * x + c * y], axis=2) + centre[:, None, :]
        round_, radius = self.round[:, None], self.radius[:, None]
        low = np.where(round_, centre - radius, outline.min(axis=1)) - margin
        high = np.where(round_, centre + radius, outline.max(axis=1)) + margin
        return outline, low, high


def _padded(corners: np.ndarray | None, count: int) -> np.ndarray:
    if corners is None:
        return np.zeros((count, 2))
    return np.vstack([corners, np.repeat(corners[-1:], count - len(corners), axis=0)])


def _normals(outline: np.ndarray) -> np.ndarray:
    """Outward unit normals [polygon, edge, 2]; the edges of no length of a padded outline repeat another's."""
    edge = np.roll(outline, -1, axis=1) - outline
    normal = np.stack([edge[:, :, 1], -edge[:, :, 0]], axis=2)
    length = np.hypot(normal[:, :, 0], normal[:, :, 1])
    flat = length < 1e-12
    normal = normal / np.where(flat, 1.0, length)[:, :, None]
    return np.where(flat[:, :, None], normal[:, :1], normal)


def overlaps(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """The least overlap of each pair of polygons over the normals of both: negative if they are apart."""
    least = np.full(len(p), np.inf)
    for first, second in ((p, q), (q, p)):
        axes = _normals(first)
        ahead = np.einsum("nek,nvk->nev", axes, first).max(axis=2)
        behind = np.einsum("nek,nvk->nev", axes, second).min(axis=2)
        least = np.minimum(least, (ahead - behind).min(axis=1))
    return least


def distances(points: np.ndarray, outline: np.ndarray) -> np.ndarray:
    """Signed distance of each point from its polygon, negative inside."""
    edge = np.roll(outline, -1, axis=1) - outline
    to = points[:, None, :] - outline
    length = (edge**2).sum(axis=2)
    along = np.clip((to * edge).sum(axis=2) / np.where(length > 0, length, 1.0), 0.0, 1.0)
    nearest = np.hypot(*np.moveaxis(to - along[:, :, None] * edge, 2, 0)).min(axis=1)
    inside = ((_normals(outline) * to).sum(axis=2)).max(axis=1)
    return np.where(inside < 0, inside, nearest)


def pairs_of_free(free: np.ndarray) -> np.ndarray:
    """All pairs [pair, 2] but those of two bodies that cannot move."""
    a, b = np.triu_indices(len(free), 1)
    wanted = free[a] | free[b]
    return np.stack([a[wanted], b[wanted]], axis=1)
