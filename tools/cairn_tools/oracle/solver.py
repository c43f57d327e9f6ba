"""Contact and friction of a moment, solved as a whole. Compiled by numba.

Unknowns are the impulses p >= 0 of the normal rows and q of the friction rows, with the velocities
v = v0 + W J'(p, q):

    p >= 0, Jn v >= bn, p (Jn v - bn) = 0
    |q| <= mu (sum of the pair's p), and Jt v = bt or q is at that limit against it

which is the complementarity problem of the slides' variant A (Stewart and Trinkle's). Rows are scaled to unit mass.

Semismooth Newton on the natural map: rows are sorted into those that press, stick and slide by what p and q would be
after one projected step; for that choice the equations are linear. Where forces are not unique (a box on two boxes)
their matrix is singular; a small epsilon on its diagonal, with corrections until nothing is left (the proximal point
method), finds the forces nearest to those before. By Woodbury's identity the matrix has the bodies' unknowns and not
the rows', in the order of Cuthill and McKee: a narrow band. Where Newton's method does not end, sweeps of projected
Gauss-Seidel, more each time, another epsilon and chance lead on to another choice.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from .contacts import along

# On the diagonal, of rows scaled to 1; one after the other where Newton's method does not end.
EPSILONS = np.array([1e-6, 1e-8, 1e-5, 1e-4, 1e-7, 1e-3])
TOLERANCE = 1e-10  # m/s
CORRECTIONS = 12
NEWTON_ROUNDS = 400
FULL_ROUNDS = 8  # of Newton's method; then sweeps, and rounds that change half of what they would
HALF_ROUNDS = 60
SWEEPS = 40
MOST_ROUNDS = 4000

OFF, ON, SLIP_FORWARD, SLIP_BACK = 0, 1, 2, 3


@njit(cache=True)
def order_bodies(x, y, inverse):
    """Cuthill and McKee: places of the bodies that contacts move, those in contact near; their number and spread."""
    bodies = len(inverse)
    movable = np.zeros(bodies, np.bool_)
    for i in range(bodies):
        movable[i] = inverse[i, 0] > 0 or inverse[i, 2] > 0
    degree = np.zeros(bodies + 1, np.int64)
    touched = np.zeros(bodies, np.bool_)
    for c in range(len(x)):
        touched[x[c]] = touched[y[c]] = True
        if movable[x[c]] and movable[y[c]]:
            degree[x[c] + 1] += 1
            degree[y[c] + 1] += 1
    start = np.cumsum(degree)
    filled = start[:-1].copy()
    neighbours = np.empty(start[-1], np.int64)
    for c in range(len(x)):
        if movable[x[c]] and movable[y[c]]:
            neighbours[filled[x[c]]] = y[c]
            neighbours[filled[y[c]]] = x[c]
            filled[x[c]] += 1
            filled[y[c]] += 1
    place = np.full(bodies, -1, np.int64)
    queue = np.empty(bodies, np.int64)
    count = 0
    for _ in range(bodies):
        root = -1
        for i in range(bodies):
            if movable[i] and touched[i] and place[i] < 0 and (root < 0 or degree[i + 1] < degree[root + 1]):
                root = i
        if root < 0:
            break
        head = count
        queue[count], place[root] = root, count
        count += 1
        while head < count:
            i = queue[head]
            head += 1
            for k in range(start[i], start[i + 1]):
                j = neighbours[k]
                if place[j] < 0:
                    queue[count], place[j] = j, count
                    count += 1
    spread = 0
    for c in range(len(x)):
        if place[x[c]] >= 0 and place[y[c]] >= 0:
            spread = max(spread, abs(place[x[c]] - place[y[c]]))
    return place, count, spread


@njit(cache=True)
def factor(band, width, pivots):
    """LU of a band matrix, entry (i, j) at [i, j - i + width], with row exchanges, which need `width` columns more."""
    size, columns = band.shape
    for k in range(size):
        last = min(size - 1, k + width)
        best = k
        for i in range(k + 1, last + 1):
            if abs(band[i, k - i + width]) > abs(band[best, k - best + width]):
                best = i
        pivots[k] = best
        reach = min(columns - 1 - width, size - 1 - k)  # last column that row k may have, from k
        if best != k:
            for d in range(reach + 1):
                a, b = d + width, k + d - best + width
                band[k, a], band[best, b] = band[best, b], band[k, a]
        head = band[k, width]
        for i in range(k + 1, last + 1):
            shift = k - i + width
            share = band[i, shift] / head
            band[i, shift] = share
            if share != 0:
                for d in range(1, reach + 1):
                    band[i, shift + d] -= share * band[k, width + d]


@njit(cache=True)
def solve_band(band, width, pivots, b):
    size, columns = band.shape
    for k in range(size):
        p = pivots[k]
        if p != k:
            b[k], b[p] = b[p], b[k]
        for i in range(k + 1, min(size - 1, k + width) + 1):
            b[i] -= band[i, k - i + width] * b[k]
    for k in range(size - 1, -1, -1):
        for d in range(1, min(columns - 1 - width, size - 1 - k) + 1):
            b[k] -= band[k, width + d] * b[k + d]
        b[k] /= band[k, width]


@njit(cache=True)
def add_row(row, x, y, root, place, motion, amount):
    """motion += amount W^(1/2) row'."""
    for k in range(3):
        if place[x] >= 0:
            motion[3 * place[x] + k] += amount * root[x, k] * row[k]
        if place[y] >= 0:
            motion[3 * place[y] + k] += amount * root[y, k] * row[k + 3]


@njit(cache=True)
def dot_row(row, x, y, root, place, motion):
    total = 0.0
    for k in range(3):
        if place[x] >= 0:
            total += root[x, k] * row[k] * motion[3 * place[x] + k]
        if place[y] >= 0:
            total += root[y, k] * row[k + 3] * motion[3 * place[y] + k]
    return total


@njit(cache=True)
def add_product(band, width, left, right, x, y, root, place):
    """band += (W^(1/2) left') (right W^(1/2)) of two rows of the same pair."""
    for u in range(6):
        body_u = x if u < 3 else y
        if place[body_u] < 0:
            continue
        i = 3 * place[body_u] + u % 3
        a = left[u] * root[body_u, u % 3]
        if a == 0:
            continue
        for v in range(6):
            body_v = x if v < 3 else y
            if place[body_v] >= 0:
                band[i, 3 * place[body_v] + v % 3 - i + width] += a * right[v] * root[body_v, v % 3]


@njit(cache=True)
def bound_of(rows, c, mu, p, ratio):
    total = 0.0
    for r in range(rows.first[c], rows.first[c + 1]):
        total += p[r] * ratio[r]
    return mu[c] * total


@njit(cache=True)
def residual_of(rows, mu, p, q, un, ut, ratio, scale_n, scale_t):
    """The natural map's largest entry in m/s: by how much a projected step would change an impulse."""
    worst = 0.0
    for r in range(len(p)):
        worst = max(worst, abs(p[r] - max(0.0, p[r] - un[r])) / scale_n[r])
    for c in range(len(q)):
        limit = bound_of(rows, c, mu, p, ratio)
        worst = max(worst, abs(q[c] - min(limit, max(-limit, q[c] - ut[c]))) / scale_t[c])
    return worst


@njit(cache=True)
def rows_at(rows, place, root, motion, scale_n, scale_t, bn, bt, un, ut):
    """What is left of all rows: scaled speeds over their targets."""
    for c in range(len(rows.x)):
        x, y = rows.x[c], rows.y[c]
        ut[c] = scale_t[c] * (dot_row(rows.friction[c], x, y, root, place, motion) - bt[c])
        for r in range(rows.first[c], rows.first[c + 1]):
            un[r] = scale_n[r] * (dot_row(rows.normal[r], x, y, root, place, motion) - bn[r])


@njit(cache=True)
def motion_of(rows, place, root, free, scale_n, scale_t, p, q, motion):
    motion[:] = free
    for c in range(len(rows.x)):
        x, y = rows.x[c], rows.y[c]
        if q[c] != 0:
            add_row(rows.friction[c], x, y, root, place, motion, scale_t[c] * q[c])
        for r in range(rows.first[c], rows.first[c + 1]):
            if p[r] != 0:
                add_row(rows.normal[r], x, y, root, place, motion, scale_n[r] * p[r])


@njit(cache=True)
def sweep(rows, place, root, mu, motion, scale_n, scale_t, bn, bt, p, q, ratio):
    """One pass of projected Gauss-Seidel over all rows."""
    for c in range(len(rows.x)):
        x, y = rows.x[c], rows.y[c]
        for r in range(rows.first[c], rows.first[c + 1]):
            u = scale_n[r] * (dot_row(rows.normal[r], x, y, root, place, motion) - bn[r])
            new = max(0.0, p[r] - u)
            if new != p[r]:
                add_row(rows.normal[r], x, y, root, place, motion, scale_n[r] * (new - p[r]))
                p[r] = new
        u = scale_t[c] * (dot_row(rows.friction[c], x, y, root, place, motion) - bt[c])
        limit = bound_of(rows, c, mu, p, ratio)
        new = min(limit, max(-limit, q[c] - u))
        if new != q[c]:
            add_row(rows.friction[c], x, y, root, place, motion, scale_t[c] * (new - q[c]))
            q[c] = new


@njit(cache=True)
def sort_rows(rows, mu, p, q, un, ut, ratio, state_n, state_t, seed):
    """The choice that the natural map makes; says whether it is another one than before.

    With a seed above 0 a random half of what is to change does: what goes round in circles finds a way out.
    """
    changed = False
    for c in range(len(q)):
        any_on = False
        for r in range(rows.first[c], rows.first[c + 1]):
            state = ON if p[r] - un[r] > 0 else OFF
            any_on |= state == ON
            if state != state_n[r]:
                changed = True
                seed = next_random(seed)
                if seed & 65536 == 0:
                    state_n[r] = state
        state = OFF
        if any_on and mu[c] > 0:
            limit = bound_of(rows, c, mu, p, ratio)
            wish = q[c] - ut[c]
            state = SLIP_FORWARD if wish > limit else (SLIP_BACK if wish < -limit else ON)
        if state != state_t[c]:
            changed = True
            seed = next_random(seed)
            if seed & 65536 == 0:
                state_t[c] = state
    return changed


@njit(cache=True)
def next_random(seed):
    """Of an old generator, whose bit 16 is random enough for this; 0 stays 0."""
    return (seed * 1103515245 + 12345) & 0x7FFFFFFF if seed > 0 else 0


@njit(cache=True)
def impose(rows, mu, p, q, ratio, state_n, state_t):
    """The impulses that the choice fixes."""
    for c in range(len(q)):
        for r in range(rows.first[c], rows.first[c + 1]):
            if state_n[r] == OFF:
                p[r] = 0.0
        if state_t[c] == OFF:
            q[c] = 0.0
        elif state_t[c] != ON:
            q[c] = bound_of(rows, c, mu, p, ratio) * (1.0 if state_t[c] == SLIP_FORWARD else -1.0)


@njit(cache=True)
def assemble(rows, place, root, count, spread, mu, scale_n, scale_t, state_n, state_t, epsilon, band, width):
    """epsilon + sum of c j' over the rows that are on: a normal row of a pair that slides drags its friction along."""
    band[:] = 0.0
    for i in range(3 * count):
        band[i, width] = epsilon
    left, right = np.empty(6), np.empty(6)
    for c in range(len(rows.x)):
        x, y = rows.x[c], rows.y[c]
        for r in range(rows.first[c], rows.first[c + 1]):
            if state_n[r] == OFF:
                continue
            drag = mu[c] if state_t[c] == SLIP_FORWARD else (-mu[c] if state_t[c] == SLIP_BACK else 0.0)
            for k in range(6):
                right[k] = scale_n[r] * rows.normal[r, k]
                left[k] = scale_n[r] * (rows.normal[r, k] + drag * rows.friction[c, k])
            add_product(band, width, left, right, x, y, root, place)
        if state_t[c] == ON:
            for k in range(6):
                right[k] = scale_t[c] * rows.friction[c, k]
            add_product(band, width, right, right, x, y, root, place)


@njit(cache=True)
def correct(
    rows, place, root, mu, scale_n, scale_t, state_n, state_t, epsilon, un, ut, band, width, pivots, p, q, work
):
    """One Newton step for the rows that are on."""
    work[:] = 0.0
    for c in range(len(rows.x)):
        x, y = rows.x[c], rows.y[c]
        drag = mu[c] if state_t[c] == SLIP_FORWARD else (-mu[c] if state_t[c] == SLIP_BACK else 0.0)
        for r in range(rows.first[c], rows.first[c + 1]):
            if state_n[r] == ON:
                add_row(rows.normal[r], x, y, root, place, work, -scale_n[r] * un[r])
                if drag != 0:
                    add_row(rows.friction[c], x, y, root, place, work, -scale_n[r] * drag * un[r])
        if state_t[c] == ON:
            add_row(rows.friction[c], x, y, root, place, work, -scale_t[c] * ut[c])
    solve_band(band, width, pivots, work)
    for c in range(len(rows.x)):
        x, y = rows.x[c], rows.y[c]
        for r in range(rows.first[c], rows.first[c + 1]):
            if state_n[r] == ON:
                p[r] -= (un[r] + scale_n[r] * dot_row(rows.normal[r], x, y, root, place, work)) / epsilon
        if state_t[c] == ON:
            q[c] -= (ut[c] + scale_t[c] * dot_row(rows.friction[c], x, y, root, place, work)) / epsilon


@njit(cache=True)
def left_over(state_n, state_t, un, ut, scale_n, scale_t):
    worst = 0.0
    for r in range(len(un)):
        if state_n[r] == ON:
            worst = max(worst, abs(un[r]) / scale_n[r])
    for c in range(len(ut)):
        if state_t[c] == ON:
            worst = max(worst, abs(ut[c]) / scale_t[c])
    return worst


@njit(cache=True)
def solve_cone(rows, inverse, start, bn, bt, mu, impulse_n, impulse_t, most_rounds, sweeps):
    """For given coefficients of friction: changes the impulses in place; gives (velocities, residual, rounds)."""
    out = start.copy()
    pairs, points = len(rows.x), len(rows.gap)
    if pairs == 0:
        return out, 0.0, 0
    root = np.sqrt(inverse)
    place, count, spread = order_bodies(rows.x, rows.y, inverse)
    free = np.zeros(3 * count)
    base_n, base_t = bn.copy(), bt.copy()
    for c in range(pairs):
        # What cannot be moved in a direction has its part of a row's speed in the target.
        x, y = rows.x[c], rows.y[c]
        base_t[c] -= along(rows.friction[c], x, y, start)
        for r in range(rows.first[c], rows.first[c + 1]):
            base_n[r] -= along(rows.normal[r], x, y, start)
    scale_n, scale_t, ratio = np.empty(points), np.empty(pairs), np.empty(points)
    unit = np.empty(6)
    for c in range(pairs):
        x, y = rows.x[c], rows.y[c]
        for r in range(rows.first[c] - 1, rows.first[c + 1]):
            unit[:] = rows.friction[c] if r < rows.first[c] else rows.normal[r]
            total, all_of_it = 0.0, 0.0
            for k in range(3):
                total += unit[k] ** 2 * inverse[x, k] + unit[k + 3] ** 2 * inverse[y, k]
                all_of_it += inverse[x, k] + inverse[y, k]
            dead = total < 1e-18 * all_of_it  # the row moves nothing: a disc that can only turn is pressed
            scale = 1.0 if dead else 1 / np.sqrt(total)
            if r < rows.first[c]:
                scale_t[c] = scale
                if dead:
                    base_t[c] = 0.0
            else:
                scale_n[r] = scale
                ratio[r] = scale / scale_t[c]
                if dead:
                    base_n[r] = -1e100
    # In units of the scaled rows friction's limit is mu ratio p; a slipping row drags mu scale_n friction.
    p, q = impulse_n / scale_n, impulse_t / scale_t
    un, ut, motion, work = np.empty(points), np.empty(pairs), np.empty(3 * count), np.empty(3 * count)
    state_n, state_t = np.full(points, -1), np.full(pairs, -1)
    width = 3 * spread + 2
    band = np.empty((3 * count, 3 * width + 1))
    pivots = np.empty(3 * count, np.int64)
    best, best_p, best_q = np.inf, p.copy(), q.copy()
    rounds, phase, left_in_phase, seed = 0, 0, FULL_ROUNDS, 0
    while rounds < most_rounds:
        motion_of(rows, place, root, free, scale_n, scale_t, p, q, motion)
        rows_at(rows, place, root, motion, scale_n, scale_t, base_n, base_t, un, ut)
        residual = residual_of(rows, mu, p, q, un, ut, ratio, scale_n, scale_t)
        changed = sort_rows(rows, mu, p, q, un, ut, ratio, state_n, state_t, seed)
        if residual < best:
            best, best_p, best_q = residual, p.copy(), q.copy()
        if best < TOLERANCE / 10 or (not changed and best < TOLERANCE):
            break
        rounds += 1
        epsilon = EPSILONS[phase % len(EPSILONS)]
        left_in_phase -= 1
        seed = rounds if phase > 0 else 0
        if left_in_phase == 0:
            p, q = best_p.copy(), best_q.copy()
            motion_of(rows, place, root, free, scale_n, scale_t, p, q, motion)
            for _ in range(sweeps):
                sweep(rows, place, root, mu, motion, scale_n, scale_t, base_n, base_t, p, q, ratio)
            sweeps += sweeps // 2
            phase += 1
            left_in_phase, seed = HALF_ROUNDS, 0
            continue
        impose(rows, mu, p, q, ratio, state_n, state_t)
        assemble(rows, place, root, count, spread, mu, scale_n, scale_t, state_n, state_t, epsilon, band, width)
        factor(band, width, pivots)
        previous = np.inf
        for _ in range(CORRECTIONS):
            motion_of(rows, place, root, free, scale_n, scale_t, p, q, motion)
            rows_at(rows, place, root, motion, scale_n, scale_t, base_n, base_t, un, ut)
            left = left_over(state_n, state_t, un, ut, scale_n, scale_t)
            if left < TOLERANCE / 1000 or left > previous / 2:
                break
            previous = left
            correct(
                rows,
                place,
                root,
                mu,
                scale_n,
                scale_t,
                state_n,
                state_t,
                epsilon,
                un,
                ut,
                band,
                width,
                pivots,
                p,
                q,
                work,
            )
            impose(rows, mu, p, q, ratio, state_n, state_t)
    motion_of(rows, place, root, free, scale_n, scale_t, best_p, best_q, motion)
    for i in range(len(place)):
        if place[i] >= 0:
            for k in range(3):
                out[i, k] += root[i, k] * motion[3 * place[i] + k]
    impulse_n[:] = best_p * scale_n
    impulse_t[:] = best_q * scale_t
    return out, best, rounds


@njit(cache=True)
def who_slides(rows, mu, bt, velocities, impulse_n, impulse_t, slides):
    """The pairs whose friction is at its limit and whose surfaces move past one another."""
    for c in range(len(mu)):
        pressed = 0.0
        for r in range(rows.first[c], rows.first[c + 1]):
            pressed += impulse_n[r]
        at_limit = pressed > 0 and abs(impulse_t[c]) >= mu[c] * pressed * (1 - 1e-12)
        slip = along(rows.friction[c], rows.x[c], rows.y[c], velocities) - bt[c]
        slides[c] = at_limit and abs(slip) > TOLERANCE


def solve(rows, inverse, start, bn, bt, static, kinetic, slid, impulse_n, impulse_t):
    """With Coulomb's law: what did not slide before may stick by static friction; what slides has the kinetic one.

    `slid` says who slid and is set to who does. Gives (velocities, residual, rounds). A pair goes over to sliding once
    at most, so this ends.
    """
    mu = np.where(slid, kinetic, static)
    total = 0
    while True:
        out, residual, rounds = solve_cone(
            rows, inverse, start, bn, bt, mu, impulse_n, impulse_t, NEWTON_ROUNDS, SWEEPS
        )
        while residual > TOLERANCE and rounds < MOST_ROUNDS:
            # Ever more sweeps, and looks whether Newton's method ends from there.
            more = 2 * rounds
            out, residual, rounds = solve_cone(rows, inverse, start, bn, bt, mu, impulse_n, impulse_t, more, 8 * more)
        total += rounds
        who_slides(rows, mu, bt, out, impulse_n, impulse_t, slid)
        new = slid & (mu > kinetic)
        if not new.any():
            return out, residual, total
        mu = np.where(new, kinetic, mu)
