"""Plane geometry of scene shapes: hulls, areas, centroids. In double; the engine has its own in fixed point."""

from __future__ import annotations

import math

Point = tuple[float, float]


def cross(o: Point, a: Point, b: Point) -> float:
    """Twice the signed area of the triangle o, a, b."""
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])


def hull(points: list[Point]) -> list[Point]:
    """Convex hull, anticlockwise, without points on its edges (Andrew's monotone chain)."""
    ordered = sorted(set(points))
    if len(ordered) < 3:
        return ordered

    def chain(sequence: list[Point]) -> list[Point]:
        out: list[Point] = []
        for p in sequence:
            while len(out) >= 2 and cross(out[-2], out[-1], p) <= 0:
                out.pop()
            out.append(p)
        return out[:-1]

    return chain(ordered) + chain(ordered[::-1])


def area(polygon: list[Point]) -> float:
    """Signed area; positive if anticlockwise."""
    return 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in edges(polygon))


def centroid(polygon: list[Point]) -> Point:
    """Centre of area of a simple polygon."""
    total = x = y = 0.0
    for a, b in edges(polygon):
        c = a[0] * b[1] - a[1] * b[0]
        total += c
        x += (a[0] + b[0]) * c
        y += (a[1] + b[1]) * c
    return (x / (3 * total), y / (3 * total))


def edges(polygon: list[Point]) -> list[tuple[Point, Point]]:
    """Each corner with the next one."""
    return list(zip(polygon, polygon[1:] + polygon[:1], strict=True))


def regular(sides: int, radius: float) -> list[Point]:
    """A regular polygon about the origin, anticlockwise, first corner on the x axis."""
    turn = 2 * math.pi / sides
    return [(radius * math.cos(k * turn), radius * math.sin(k * turn)) for k in range(sides)]


def box(width: float, height: float) -> list[Point]:
    """A box about the origin, anticlockwise from the lower left corner."""
    w, h = width / 2, height / 2
    return [(-w, -h), (w, -h), (w, h), (-w, h)]


def inside_by(polygon: list[Point], point: Point) -> float:
    """How far inside a convex anticlockwise polygon the point is; at most 0 on the edge or outside."""
    return min(cross(a, b, point) / math.dist(a, b) for a, b in edges(polygon))


def placed(points: list[Point], x: float, y: float, angle: float) -> list[Point]:
    """The points turned by angle, then moved by (x, y)."""
    c, s = math.cos(angle), math.sin(angle)
    return [(x + c * px - s * py, y + s * px + c * py) for px, py in points]
