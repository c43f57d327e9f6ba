"""A scene as flat arrays, which is what the compiled loops take."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from ..scene import Scene
from .model import Array, Bodies, anchors_of, contact_of, hooke, pairs_that_meet

Ints = NDArray[np.int64]

# Of an RK4 step of the springs: the fastest oscillation and the fastest decay, in radians and in e-folds.
SPRING_TURN = 0.2
SPRING_FADE = 0.5
MOST_SPRING_STEPS = 20000


class World(NamedTuple):
    inverse: Array  # [body, 3]: of mass, mass, inertia
    pull: Array  # [body, 2]: gravity, where it acts
    radius: Array
    corners: Array  # [body, corner, 2], about the centre of mass
    normals: Array  # of the edge from each corner to the next
    counts: Ints
    reach: Array
    pairs: Ints  # [pair, 2]
    static_friction: Array  # by pair
    kinetic_friction: Array
    restitution: Array
    threshold: Array
    ends: Ints  # [spring, 2]
    anchors: Array  # [spring, 4]
    stiffness: Array
    damping: Array
    rest_length: Array


class Memory(NamedTuple):
    """What a step leaves to the next one: pairs that are near, and by pair the forces, where they are and who slid."""

    near: Ints
    near_count: Ints  # of one entry
    near_pose: Array  # where they were looked for
    force_n: Array  # [pair, point]
    force_t: Array
    place: Array  # [pair, point, 2]
    slid: NDArray[np.bool_]
    previous: Array  # [4, body, 3]: acceleration and velocity of the step before (Adams-Bashforth); scratch
    previous_step: Array  # its length; 0 if there is none


def world_of(scene: Scene, bodies: Bodies) -> World:
    inverse = np.stack([bodies.inverse_mass, bodies.inverse_mass, bodies.inverse_inertia], axis=1)
    pull = np.where(bodies.inverse_mass[:, None] > 0, np.array(scene.gravity)[None, :], 0.0)
    normals = np.zeros_like(bodies.corners)
    for i, count in enumerate(bodies.corner_counts):
        own = bodies.corners[i, :count]
        along = np.roll(own, -1, axis=0) - own
        normals[i, :count] = np.stack([along[:, 1], -along[:, 0]], axis=1) / np.hypot(*along.T)[:, None]
    pairs = pairs_that_meet(scene)
    contacts = [contact_of(scene, scene.bodies[a], scene.bodies[b]) for a, b in pairs]
    laws = [hooke(spring, bodies) for spring in scene.springs]
    anchors = [np.concatenate(anchors_of(spring, bodies)) for spring in scene.springs]
    return World(
        inverse,
        pull,
        bodies.radius,
        bodies.corners,
        normals,
        bodies.corner_counts,
        np.maximum(bodies.radius, np.hypot(bodies.corners[:, :, 0], bodies.corners[:, :, 1]).max(axis=1)),
        np.array(pairs, dtype=np.int64).reshape(-1, 2),
        np.array([contact.static_friction for contact in contacts], dtype=np.float64),
        np.array([contact.kinetic_friction for contact in contacts], dtype=np.float64),
        np.array([contact.restitution for contact in contacts], dtype=np.float64),
        np.array([contact.threshold for contact in contacts], dtype=np.float64),
        np.array([(spring.a, spring.b) for spring in scene.springs], dtype=np.int64).reshape(-1, 2),
        np.array(anchors, dtype=np.float64).reshape(-1, 4),
        np.array([law[0] for law in laws], dtype=np.float64),
        np.array([law[1] for law in laws], dtype=np.float64),
        np.array([spring.rest_length for spring in scene.springs], dtype=np.float64),
    )


def memory_of(world: World) -> Memory:
    pairs, bodies = len(world.pairs), len(world.radius)
    return Memory(
        np.zeros(pairs, dtype=np.int64),
        np.zeros(1, dtype=np.int64),
        np.full((bodies, 3), np.inf),
        np.zeros((pairs, 2)),
        np.zeros(pairs),
        np.zeros((pairs, 2, 2)),
        np.zeros(pairs, dtype=np.bool_),
        np.zeros((4, bodies, 3)),
        np.zeros(1),
    )


def spring_steps(world: World, h: float) -> int:
    """How many steps the springs take within h: by Gershgorin's bound of how fast they can swing and fade."""
    if len(world.ends) == 0:
        return 1
    at = [np.zeros(0, dtype=np.int64) for _ in world.radius]
    for k in range(len(world.ends)):
        for body in world.ends[k]:
            at[body] = np.append(at[body], k)
    bounds = []
    for law in (world.stiffness, world.damping):
        root, worst = np.sqrt(law), 0.0
        for k, (a, b) in enumerate(world.ends):
            total = 0.0
            for body, arm in ((a, world.anchors[k, :2]), (b, world.anchors[k, 2:])):
                for other in at[body]:
                    own = 0 if world.ends[other, 0] == body else 2
                    lever = np.hypot(*arm) * np.hypot(*world.anchors[other, own : own + 2])
                    share = world.inverse[body, 0] + world.inverse[body, 2] * lever
                    total += root[k] * root[other] * share
            worst = max(worst, total)
        bounds.append(worst)
    steps = int(np.ceil(max(np.sqrt(bounds[0]) * h / SPRING_TURN, bounds[1] * h / SPRING_FADE, 1.0)))
    if steps > MOST_SPRING_STEPS:
        raise UserError(f"the springs are too stiff for the oracle: {steps} steps of them in {h:.1e} s")
    return steps
