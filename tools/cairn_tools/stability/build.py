"""What several cases are built of."""

from __future__ import annotations

import math

from ..host import World

# The offsets of the scene stack20-offset: within 2 cm of the middle, in no order.
OFFSETS = (0.013, -0.019, 0.007, -0.004, 0.02, -0.011, 0.016, -0.02, 0.002, 0.018)


def floor(world: World, width: float = 50.0, material: int = 0) -> int:
    """A static box with its upper face at y = 0."""
    return world.fixed(world.box(width, 1.0), 0.0, -0.5, material=material)


def stack(world: World, count: int, side: float = 1.0, offset: bool = False) -> list[int]:
    """Boxes on one another, each touching the next."""
    box = world.box(side, side)
    return [world.add(box, side * OFFSETS[k % len(OFFSETS)] if offset else 0.0, side * (k + 0.5)) for k in range(count)]


def pyramid(world: World, rows: int, pitch: float = 1.05) -> list[int]:
    """Rows of unit boxes, each row one box shorter than the one it stands on."""
    box = world.box(1.0, 1.0)
    return [
        world.add(box, pitch * (k - (rows - row - 1) / 2), row + 0.5) for row in range(rows) for k in range(rows - row)
    ]


def pit(world: World, width: float, height: float, material: int = 0) -> None:
    """A floor at y = 0 between two walls, width apart inside."""
    floor(world, width + 2.0, material)
    wall = world.box(1.0, height)
    for side in (-1, 1):
        world.fixed(wall, side * (width + 1.0) / 2, height / 2, material=material)


def tilted(angle: float, along: float, above: float) -> tuple[float, float]:
    """A point so far up a slope through the origin that rises at an angle, and so far above it."""
    c, s = math.cos(angle), math.sin(angle)
    return (along * c - above * s, along * s + above * c)
