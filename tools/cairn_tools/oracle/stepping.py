"""Time: steps of Moreau's kind, cut where something is hit. What loops over contacts is compiled by numba.

A step solves for the impulses that leave no contact closing at its end, and moves by the mean of both ends'
velocities, which is second order: contacts' directions are those of the middle, and targets make up for how they turn
until the end. Where the way ends inside of something, the moment of the impact is found, and the step goes on behind
it with the velocities that Newton's law of restitution and Coulomb's law of friction leave, of all contacts at once.
After MOST_CUTS in a step the rest of it is done in the manner of Moreau and Jean: what is near may close by no more
than its gap. What then overlaps is moved apart, by least squares.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from .contacts import along, deepest, find_near, find_rows, follow, force_before
from .motion import ADAMS_BASHFORTH, AS_ENGINE, MIDPOINT, SYMPLECTIC, energy, move_freely
from .shapes import place_all, separation, separation_at
from .solver import TOLERANCE, solve

CLOSED = 1e-8  # m: below it a contact is closed
ENTERED = 2e-9  # m of overlap that is an impact, if it came about faster than
SLOW = 1e-3  # m/s
APART = 1e-9  # m of overlap that is moved apart at the end of a step
FAST = 1e6  # m/s: faster than anything
MOST_CUTS = 6
# Of a step that contacts' impulses move bodies by: their mean speed's where methods are of second order.
SHARES = {MIDPOINT: 0.5, ADAMS_BASHFORTH: 0.0}
HOLD = 1e-10  # m of gap or overlap that a contact may keep; of what is beyond it a step takes back
PULL = 0.1

# What is told of a run: largest residual, solves that did not converge, solves, rounds of them, cuts, and the largest
# overlap that was moved apart.
RESIDUAL, FAILED, SOLVES, ROUNDS, CUTS, MOVED = range(6)


def note(log, residual, rounds):
    log[RESIDUAL] = max(log[RESIDUAL], residual)
    log[SOLVES] += 1
    log[ROUNDS] += rounds
    if not residual <= TOLERANCE:
        log[FAILED] += 1


@njit(cache=True)
def laws_of(world, rows):
    pairs = len(rows.x)
    static, kinetic = np.empty(pairs), np.empty(pairs)
    for c in range(pairs):
        static[c] = world.static_friction[rows.pair[c]]
        kinetic[c] = world.kinetic_friction[rows.pair[c]]
    return static, kinetic


@njit(cache=True)
def recall(memory, rows, h, impulse_n, impulse_t, slid):
    """Impulses to begin with: the forces of the step before, by pair and place."""
    for c in range(len(rows.x)):
        p = rows.pair[c]
        slid[c] = memory.slid[p]
        impulse_t[c] = memory.force_t[p] * h
        for r in range(rows.first[c], rows.first[c + 1]):
            impulse_n[r] = force_before(memory, p, rows.place[r, 0], rows.place[r, 1]) * h


@njit(cache=True)
def remember(memory, rows, h, impulse_n, impulse_t, slid):
    memory.force_n[:] = 0.0
    memory.force_t[:] = 0.0
    memory.slid[:] = False
    for c in range(len(rows.x)):
        p = rows.pair[c]
        memory.slid[p] = slid[c]
        memory.force_t[p] = impulse_t[c] / h
        for k in range(rows.first[c + 1] - rows.first[c]):
            r = rows.first[c] + k
            memory.force_n[p, k] = impulse_n[r] / h
            memory.place[p, k] = rows.place[r]


@njit(cache=True)
def targets_of_step(rows, normal, friction, velocities, pressed, h, whole):
    """What a step's rows may be at its end, (normal, friction), from the rows at its start and in its middle.

    A closed contact's target leaves HOLD of gap alone: over a step 1e-11 m are 1e-7 m/s, on which the points of a pile
    do not agree. What is beyond it is taken back in `whole` steps, however short this one is cut.
    """
    points, pairs = len(rows.gap), len(rows.x)
    bn, bt = np.empty(points), np.empty(pairs)
    for c in range(pairs):
        x, y = rows.x[c], rows.y[c]
        # The rows of the end are as much beyond those of the middle as these are beyond those of the start.
        bt[c] = along(rows.friction[c], x, y, velocities) - along(friction[c], x, y, velocities)
        for r in range(rows.first[c], rows.first[c + 1]):
            gap = rows.gap[r]
            rate = 1.0 / h if gap > CLOSED and pressed[r] == 0 else PULL / whole
            beyond = max(gap - HOLD, 0.0) + min(gap + HOLD, 0.0)
            bn[r] = along(rows.normal[r], x, y, velocities) - along(normal[r], x, y, velocities) - rate * beyond
    return bn, bt


@njit(cache=True)
def fastest_closing(rows, velocities):
    """Of the closed contacts."""
    worst = 0.0
    for r in range(len(rows.gap)):
        if rows.gap[r] < CLOSED:
            c = rows.owner[r]
            worst = max(worst, -along(rows.normal[r], rows.x[c], rows.y[c], velocities))
    return worst


def nothing(rows):
    """Impulses of normal and friction rows, and who slid: of contacts without a past."""
    return np.zeros(len(rows.gap)), np.zeros(len(rows.x)), np.zeros(len(rows.x), np.bool_)


@njit(cache=True)
def let_bounce(world, rows, velocities, bn):
    """What will rebound is not slowed on its way: it is stopped by its impact."""
    for r in range(len(rows.gap)):
        c = rows.owner[r]
        p = rows.pair[c]
        approach = -along(rows.normal[r], rows.x[c], rows.y[c], velocities)
        if rows.gap[r] > CLOSED and world.restitution[p] > 0 and approach > world.threshold[p]:
            bn[r] = -FAST


def advance(world, memory, poses, velocities, h, whole, method, spring_steps, margin, log):
    """A part of a step without looking for impacts: (poses, velocities) at its end. Contacts are within the margin."""
    rows = find_rows(world, memory, poses, margin)
    exact = method == MIDPOINT
    by_end = method in (SYMPLECTIC, AS_ENGINE)
    if (exact or (by_end and world.restitution.any())) and fastest_closing(rows, velocities) > SLOW:
        # By chance a step has ended just before an impact.
        velocities = strike(world, memory, poses, velocities, rest_speed(world, whole), log)
    free_q, free_v = move_freely(world, memory, poses, velocities, h, method, spring_steps)
    impulse_n, impulse_t, slid = nothing(rows)
    if len(rows.x) == 0:
        remember(memory, rows, h, impulse_n, impulse_t, slid)
        return free_q, free_v
    recall(memory, rows, h, impulse_n, impulse_t, slid)
    turned = (rows.normal, rows.friction) if by_end else follow(world, rows, poses + velocities * (h / 2))
    bn, bt = targets_of_step(rows, *turned, velocities, impulse_n, h, whole)
    if by_end:
        let_bounce(world, rows, free_v, bn)
    rows.normal[:], rows.friction[:] = turned
    laws = laws_of(world, rows)
    v, residual, rounds = solve(rows, world.inverse, free_v, bn, bt, *laws, slid, impulse_n, impulse_t)
    remember(memory, rows, h, impulse_n, impulse_t, slid)
    note(log, residual, rounds)
    share = SHARES.get(method, 1.0)
    if method == AS_ENGINE:
        for i in range(len(poses)):
            if (v[i] != free_v[i]).any():
                free_q[i] = poses[i] + h * free_v[i]
    return free_q + (v - free_v) * (share * h), v


@njit(cache=True)
def targets_of_impact(world, rows, velocities, slowest):
    """Newton's law of restitution: what a row is to be at least after the impact."""
    out = np.zeros(len(rows.gap))
    for r in range(len(out)):
        c = rows.owner[r]
        approach = -along(rows.normal[r], rows.x[c], rows.y[c], velocities)
        if approach > max(world.threshold[rows.pair[c]], slowest):
            out[r] = world.restitution[rows.pair[c]] * approach
    return out


def rest_speed(world, h):
    """What closes slower rests: gravity makes as much of it in two steps."""
    return 2 * h * float(np.hypot(world.pull[:, 0], world.pull[:, 1]).max())


def strike(world, memory, poses, velocities, slowest, log):
    """The velocities after the impacts of all closed contacts at once."""
    rows = find_rows(world, memory, poses, CLOSED)
    if len(rows.x) == 0:
        return velocities
    impulse_n, impulse_t, slid = nothing(rows)
    bn, bt = targets_of_impact(world, rows, velocities, slowest), np.zeros(len(rows.x))
    laws = laws_of(world, rows)
    v, residual, rounds = solve(rows, world.inverse, velocities, bn, bt, *laws, slid, impulse_n, impulse_t)
    note(log, residual, rounds)
    memory.previous[1] += v - velocities
    return v


@njit(cache=True)
def between(q0, v0, q1, v1, h, part):
    """Hermite's cubic between two states of a body."""
    a, b = part * part * (3 - 2 * part), part * (1 - part) * h
    return q0 + a * (q1 - q0) + b * ((1 - part) * v0 - part * v1)


@njit(cache=True)
def crossing(world, i, j, q0, v0, q1, v1, h, high, speed):
    """The part of a step, up to `high`, after which two bodies overlap by more than ENTERED and this speed make."""
    low = 0.0
    for _ in range(50):
        middle = (low + high) / 2
        pose_i = between(q0[i], v0[i], q1[i], v1[i], h, middle)
        pose_j = between(q0[j], v0[j], q1[j], v1[j], h, middle)
        if separation_at(world, i, j, pose_i, pose_j) < -ENTERED - speed * h * middle:
            high = middle
        else:
            low = middle
    return high


@njit(cache=True)
def first_impact(world, memory, q0, v0, q1, v1, h, only_bouncing):
    """The part of the step after which something is hit, 2 if nothing is.

    An overlap that grows by less than SLOW is a step's own error or two surfaces at rest. Where there is more, its
    moment is found to ENTERED, unless there was an overlap before.
    """
    find_near(world, memory, q1)
    points, normals = place_all(world, q1)
    earliest = 2.0
    for k in range(memory.near_count[0]):
        p = memory.near[k]
        i, j = world.pairs[p, 0], world.pairs[p, 1]
        if only_bouncing and world.restitution[p] == 0:
            continue
        d = separation(world, i, j, q1[i], q1[j], points[i], normals[i], points[j], normals[j])
        if d >= -ENTERED - SLOW * h:
            continue
        part = crossing(world, i, j, q0, v0, q1, v1, h, 1.0, SLOW)
        if part < earliest:
            if separation_at(world, i, j, q0[i], q0[j]) > -ENTERED:
                part = crossing(world, i, j, q0, v0, q1, v1, h, part, 0.0)
            earliest = part
    return earliest


def move_apart(world, memory, poses, log):
    """Ends an overlap by place, where there is one: by the least move, weighted by mass, that leaves none."""
    for _ in range(8):
        overlap = deepest(world, memory, poses)
        if overlap <= APART:
            return
        log[MOVED] = max(log[MOVED], overlap)
        rows = find_rows(world, memory, poses, CLOSED)
        impulse_n, impulse_t, slid = nothing(rows)
        none, still = np.zeros(len(rows.x)), np.zeros_like(poses)
        poses += solve(rows, world.inverse, still, -rows.gap, none, none, none, slid, impulse_n, impulse_t)[0]


def largest_closing(velocities, reach):
    """No two surfaces close faster."""
    return 2 * float((np.hypot(velocities[:, 0], velocities[:, 1]) + np.abs(velocities[:, 2]) * reach).max())


def step(world, memory, poses, velocities, h, method, spring_steps, log):
    """One step of length h; changes poses and velocities."""
    left, cuts = h, 0
    exact = method == MIDPOINT
    while left > 0:
        last = cuts >= MOST_CUTS
        margin = CLOSED
        if last or not exact:
            margin = largest_closing(velocities, world.reach) * left + 100 * left * left
        inner = max(1, int(np.ceil(spring_steps * left / h)))
        q, v = advance(world, memory, poses, velocities, left, h, method, inner, margin, log)
        done = left
        if not last:
            part = first_impact(world, memory, poses, velocities, q, v, left, not exact)
            if part <= 1:
                done = left * part
                if done > 1e-9 * h:
                    inner = max(1, int(np.ceil(spring_steps * done / h)))
                    q, v = advance(world, memory, poses, velocities, done, h, method, inner, CLOSED, log)
                else:
                    q, v = poses.copy(), velocities.copy()
                v = strike(world, memory, q, v, rest_speed(world, h), log)
                cuts += 1
                log[CUTS] += 1
        poses[:] = q
        velocities[:] = v
        if method == ADAMS_BASHFORTH and done > 0:
            memory.previous[0] = memory.previous[2]
            memory.previous[1] = memory.previous[3]
            memory.previous_step[0] = done
        left -= done
        if left < 1e-9 * h:
            break
    move_apart(world, memory, poses, log)


def run_steps(world, memory, poses, velocities, h, steps, method, spring_steps, log):
    for _ in range(steps):
        step(world, memory, poses, velocities, h, method, spring_steps, log)
    return energy(world, poses, velocities), deepest(world, memory, poses)


def begin(world, memory, poses, velocities, h, log):
    """Before the first step: nothing overlaps, and what touches and closes has met."""
    move_apart(world, memory, poses, log)
    velocities[:] = strike(world, memory, poses, velocities, rest_speed(world, h), log)
    return energy(world, poses, velocities), deepest(world, memory, poses)
