"""The motion that contacts do not take part in: gravity and springs. Compiled by numba."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

MIDPOINT, ADAMS_BASHFORTH, SYMPLECTIC, AS_ENGINE = range(4)
METHODS = {
    "euler-midpoint": MIDPOINT,
    "adams-bashforth": ADAMS_BASHFORTH,
    "symplectic": SYMPLECTIC,
    "as-engine": AS_ENGINE,
}


@njit(cache=True)
def accelerations(world, poses, velocities, out):
    """Gravity and Hooke's law: F = -k (L - L0) u - c (relative velocity along u) u."""
    out[:, :2] = world.pull
    out[:, 2] = 0.0
    for s in range(len(world.ends)):
        a, b = world.ends[s, 0], world.ends[s, 1]
        ax, ay = turned(world.anchors[s, 0], world.anchors[s, 1], poses[a, 2])
        bx, by = turned(world.anchors[s, 2], world.anchors[s, 3], poses[b, 2])
        dx, dy = poses[b, 0] + bx - poses[a, 0] - ax, poses[b, 1] + by - poses[a, 1] - ay
        length = math.hypot(dx, dy)
        ux, uy = (dx / length, dy / length) if length > 0 else (1.0, 0.0)
        vx = velocities[b, 0] - by * velocities[b, 2] - velocities[a, 0] + ay * velocities[a, 2]
        vy = velocities[b, 1] + bx * velocities[b, 2] - velocities[a, 1] - ax * velocities[a, 2]
        pull = world.stiffness[s] * (length - world.rest_length[s]) + world.damping[s] * (vx * ux + vy * uy)
        out[a, 0] += world.inverse[a, 0] * pull * ux
        out[a, 1] += world.inverse[a, 1] * pull * uy
        out[a, 2] += world.inverse[a, 2] * pull * (ax * uy - ay * ux)
        out[b, 0] -= world.inverse[b, 0] * pull * ux
        out[b, 1] -= world.inverse[b, 1] * pull * uy
        out[b, 2] -= world.inverse[b, 2] * pull * (bx * uy - by * ux)


@njit(cache=True)
def turned(x, y, angle):
    c, s = math.cos(angle), math.sin(angle)
    return c * x - s * y, s * x + c * y


@njit(cache=True)
def energy(world, poses, velocities):
    """Kinetic, of gravity (0 at the origin) and of the springs, in joules."""
    total = 0.0
    for i in range(len(poses)):
        for k in range(3):
            if world.inverse[i, k] > 0:
                total += velocities[i, k] ** 2 / world.inverse[i, k] / 2
        if world.inverse[i, 0] > 0:
            total -= (world.pull[i, 0] * poses[i, 0] + world.pull[i, 1] * poses[i, 1]) / world.inverse[i, 0]
    for s in range(len(world.ends)):
        a, b = world.ends[s, 0], world.ends[s, 1]
        ax, ay = turned(world.anchors[s, 0], world.anchors[s, 1], poses[a, 2])
        bx, by = turned(world.anchors[s, 2], world.anchors[s, 3], poses[b, 2])
        length = math.hypot(poses[b, 0] + bx - poses[a, 0] - ax, poses[b, 1] + by - poses[a, 1] - ay)
        total += world.stiffness[s] * (length - world.rest_length[s]) ** 2 / 2
    return total


@njit(cache=True)
def runge_kutta(world, poses, velocities, h, steps):
    """The classical method of fourth order, in so many steps; exact for a parabola."""
    q, v = poses.copy(), velocities.copy()
    bodies = len(poses)
    at, speed, rate = np.empty_like(q), np.empty_like(q), np.empty_like(q)
    sum_q, sum_v = np.empty_like(q), np.empty_like(q)
    d = h / steps
    for _ in range(steps):
        for stage in range(4):
            reach = 0.0 if stage == 0 else (d if stage == 3 else d / 2)
            weight = d / 6 if stage == 0 or stage == 3 else d / 3
            for i in range(bodies):
                for k in range(3):
                    at[i, k] = q[i, k] + reach * speed[i, k] if stage > 0 else q[i, k]
                    speed[i, k] = v[i, k] + reach * rate[i, k] if stage > 0 else v[i, k]
            accelerations(world, at, speed, rate)
            for i in range(bodies):
                for k in range(3):
                    sum_q[i, k] = (sum_q[i, k] if stage > 0 else q[i, k]) + weight * speed[i, k]
                    sum_v[i, k] = (sum_v[i, k] if stage > 0 else v[i, k]) + weight * rate[i, k]
        q[:] = sum_q
        v[:] = sum_v
    return q, v


def adams_bashforth(world, memory, poses, velocities, h):
    """The two-step method of second order; its first step is by Euler's. For steps that differ in length."""
    now = np.empty_like(poses)
    accelerations(world, poses, velocities, now)
    part = h / memory.previous_step[0] / 2 if memory.previous_step[0] > 0 else 0.0
    q = poses + h * ((1 + part) * velocities - part * memory.previous[1])
    v = velocities + h * ((1 + part) * now - part * memory.previous[0])
    memory.previous[2] = now
    memory.previous[3] = velocities
    return q, v


def symplectic(world, poses, velocities, h):
    """v += a h, then x += v h."""
    now = np.empty_like(poses)
    accelerations(world, poses, velocities, now)
    v = velocities + h * now
    return poses + h * v, v


def move_freely(world, memory, poses, velocities, h, method, spring_steps):
    if method == ADAMS_BASHFORTH:
        return adams_bashforth(world, memory, poses, velocities, h)
    if method == SYMPLECTIC:
        return symplectic(world, poses, velocities, h)
    return runge_kutta(world, poses, velocities, h, spring_steps)
