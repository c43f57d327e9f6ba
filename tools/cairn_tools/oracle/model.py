"""A scene as the oracle sees it: masses, shapes about their centres of mass, and who may meet whom. In double."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import geometry
from ..scene import Body, Scene, Shape, Spring

Array = NDArray[np.float64]
X, Y, ANGLE, VX, VY, OMEGA = range(6)


@dataclass(frozen=True)
class Bodies:
    """One row a body of the scene. An inverse of 0 is what nothing moves (or turns)."""

    states: Array  # of the centres of mass
    inverse_mass: Array
    inverse_inertia: Array
    radius: Array  # of circles; 0 for polygons
    corners: Array  # [body, corner, 2] about the centre of mass, anticlockwise
    corner_counts: NDArray[np.int64]  # 0 for circles
    centres: Array  # of mass, in the frame that the scene places

    def placed(self, states: Array) -> Array:
        """The same states, [..., body, 6], but of the shapes' origins: x and y are what a scene calls the position."""
        out = states.copy()
        c, s = np.cos(states[..., ANGLE]), np.sin(states[..., ANGLE])
        out[..., X] -= c * self.centres[:, 0] - s * self.centres[:, 1]
        out[..., Y] -= s * self.centres[:, 0] + c * self.centres[:, 1]
        return out


def bodies_of(scene: Scene) -> Bodies:
    count = len(scene.bodies)
    widest = max([len(scene.shape_of(body).corners) for body in scene.bodies] + [1])
    out = Bodies(np.zeros((count, 6)), np.zeros(count), np.zeros(count), np.zeros(count),
                 np.zeros((count, widest, 2)), np.zeros(count, dtype=np.int64), np.zeros((count, 2)))  # fmt: skip
    for i, body in enumerate(scene.bodies):
        shape = scene.shape_of(body)
        centre = shape.centre
        x, y = geometry.placed([centre], *body.position, body.angle)[0]
        free_to_move = not (body.static or body.fixed_position)
        free_to_turn = not (body.static or body.fixed_rotation)
        velocity = body.velocity if free_to_move else (0.0, 0.0)
        out.states[i] = (x, y, body.angle, *velocity, body.angular_velocity if free_to_turn else 0.0)
        mass = body.density * shape.area
        out.inverse_mass[i] = 1 / mass if free_to_move else 0.0
        out.inverse_inertia[i] = 1 / (body.density * second_moment(shape)) if free_to_turn else 0.0
        out.radius[i] = 0.0 if shape.corners else shape.radius
        out.corner_counts[i] = len(shape.corners)
        out.corners[i, : len(shape.corners)] = np.array(shape.corners).reshape(-1, 2) - centre
        out.centres[i] = centre
    return out


def second_moment(shape: Shape) -> float:
    """Of the area, about its centre: the moment of inertia at density 1."""
    if not shape.corners:
        return math.pi / 2 * shape.radius**4
    cx, cy = shape.centre
    total = 0.0
    for (ax, ay), (bx, by) in geometry.edges([(x - cx, y - cy) for x, y in shape.corners]):
        square = ax * ax + ax * bx + bx * bx + ay * ay + ay * by + by * by
        total += (ax * by - bx * ay) * square / 12
    return total


@dataclass(frozen=True)
class Contact:
    """What two materials make together: the larger rebound, the geometric mean of the frictions."""

    static_friction: float
    kinetic_friction: float
    restitution: float
    threshold: float  # approach speed below which there is no rebound: the smaller one of those that bounce


def contact_of(scene: Scene, a: Body, b: Body) -> Contact:
    one, other = scene.material(a.material), scene.material(b.material)
    bouncing = [m.restitution_threshold for m in (one, other) if m.restitution > 0]
    return Contact(
        math.sqrt(one.static_friction * other.static_friction),
        math.sqrt(one.kinetic_friction * other.kinetic_friction),
        max(one.restitution, other.restitution),
        min(bouncing, default=math.inf),
    )


def pairs_that_meet(scene: Scene) -> list[tuple[int, int]]:
    """Every two bodies that push one another when they touch."""
    apart = {frozenset((spring.a, spring.b)) for spring in scene.springs if not spring.collide}
    out = []
    for i, a in enumerate(scene.bodies):
        for j, b in enumerate(scene.bodies[:i]):
            if _both_take_part(a, b) and (not apart or frozenset((i, j)) not in apart):
                out.append((j, i))
    return sorted(out)


def _both_take_part(a: Body, b: Body) -> bool:
    moving = not (_is_held(a) and _is_held(b))
    return moving and not (a.sensor or b.sensor) and bool(a.layer & b.mask and b.layer & a.mask)


def _is_held(body: Body) -> bool:
    return body.static or (body.fixed_position and body.fixed_rotation)


def hooke(spring: Spring, bodies: Bodies) -> tuple[float, float]:
    """Stiffness and damping; a frequency is that of the two bodies' reduced mass."""
    if spring.stiffness is not None or spring.frequency is None:
        return spring.stiffness or 0.0, spring.damping
    inverse = bodies.inverse_mass[spring.a] + bodies.inverse_mass[spring.b]
    if inverse == 0:
        return 0.0, 0.0
    turn = 2 * math.pi * spring.frequency
    return turn * turn / inverse, 2 * spring.damping_ratio * turn / inverse


def anchors_of(spring: Spring, bodies: Bodies) -> tuple[Array, Array]:
    """From the centres of mass, in the bodies' frames."""
    return np.array(spring.anchor_a) - bodies.centres[spring.a], np.array(spring.anchor_b) - bodies.centres[spring.b]
