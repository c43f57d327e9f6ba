"""Runs a scene on the oracle."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..scene import Scene
from ..trajectory import Trajectory
from . import stepping
from .model import Array, bodies_of
from .motion import AS_ENGINE, MIDPOINT
from .motion import METHODS as CODES
from .world import Memory, World, memory_of, spring_steps, world_of

METHODS = tuple(CODES)
# Columns of OracleRun.contacts: two bodies; forces in N, both points' along the normal, each one's, and friction.
CONTACT = ("a", "b", "normal", "first", "second", "friction")


@dataclass(frozen=True)
class OracleRun:
    """What the oracle found, at each recorded step; and how well it solved."""

    trajectory: Trajectory
    penetration: Array  # m, the deepest
    energy: Array  # J: kinetic, of gravity and of the springs
    fineness: int
    method: str
    residual: float  # m/s, the largest that any solve was left with
    not_converged: int  # solves that were left with more than 1e-10 m/s
    solves: int
    rounds: int  # of Newton's method, all solves together
    impacts: int  # moments at which steps were cut
    moved_apart: float  # m, the largest overlap that was taken back by place
    contacts: Array  # at the end, of the last part of a step, see CONTACT


def run(
    scene: Scene,
    steps: int,
    every: int = 1,
    fineness: int = 64,
    method: str = "euler-midpoint",
    say: Callable[[int], None] | None = None,
) -> OracleRun:
    """A scene's motion, `fineness` steps of the oracle to each of the scene's, whose numbers the trajectory has.

    Methods: "euler-midpoint", second order between impacts, which it finds; "adams-bashforth" and "symplectic",
    first order at contacts, for comparison; "as-engine" is symplectic for bodies that a contact pushes, exact for those
    in free flight or on springs: as the engine integrates. `say` is told each step's number.
    """
    if steps < 0 or every < 1 or fineness < 1 or method not in METHODS:
        raise ValueError(f"steps {steps}, every {every}, fineness {fineness}, method {method}")
    bodies = bodies_of(scene)
    world = world_of(scene, bodies)
    memory = memory_of(world)
    poses, velocities = bodies.states[:, :3].copy(), bodies.states[:, 3:].copy()
    h = 1.0 / (scene.steps_per_second * fineness)
    code = CODES[method]
    inner = spring_steps(world, h) if code in (MIDPOINT, AS_ENGINE) else 1
    log = np.zeros(6)
    records = [(0, bodies.states.copy(), *stepping.begin(world, memory, poses, velocities, h, log))]
    for number in range(every, steps + 1, every):
        values = stepping.run_steps(world, memory, poses, velocities, h, every * fineness, code, inner, log)
        records.append((number, np.concatenate([poses, velocities], axis=1), *values))
        if say:
            say(number)
    numbers, states, energies, depths = zip(*records, strict=True)
    return OracleRun(
        Trajectory(np.array(numbers, dtype=np.int64), bodies.placed(np.array(states))),
        np.array(depths),
        np.array(energies),
        fineness,
        method,
        float(log[stepping.RESIDUAL]),
        int(log[stepping.FAILED]),
        int(log[stepping.SOLVES]),
        int(log[stepping.ROUNDS]),
        int(log[stepping.CUTS]),
        float(log[stepping.MOVED]),
        _contacts(world, memory),
    )


def _contacts(world: World, memory: Memory) -> Array:
    pressed = np.flatnonzero(memory.force_n.any(axis=1))
    force = memory.force_n[pressed]
    return np.column_stack([world.pairs[pressed], force.sum(axis=1), force, memory.force_t[pressed]])
