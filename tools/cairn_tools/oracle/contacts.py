"""All contacts of a moment as rows of a constraint system. Compiled by numba."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

from .model import Array
from .shapes import contact, features, place_all, separation
from .world import Ints

SKIN = 0.05  # m: pairs are looked for again when something has moved by half of it
SAME_PLACE = 0.02  # m between a contact and the one before that it goes on from
DRIFT = 2e-5  # m: what pressed before may have come apart by the error of a step


class Rows(NamedTuple):
    """A touching pair has one or two normal rows and one friction row, for its points lie on one line."""

    x: Ints  # [pair]: bodies; a row's six numbers are of X's and Y's x, y and angle
    y: Ints
    pair: Ints  # in the world's list
    first: Ints  # of its normal rows; a pair more than there are holds the end
    normal: Array  # [point, 6]
    friction: Array  # [pair, 6]
    gap: Array  # [point]
    place: Array  # [point, 2]
    feature: Ints  # [point, 5]
    owner: Ints  # [point]: its touching pair


@njit(cache=True)
def find_near(world, memory, poses):
    """Lists the pairs whose boxes come near each other, where bodies have moved since the last time."""
    old, bodies = memory.near_pose, len(world.radius)
    for i in range(bodies):
        turned = abs(poses[i, 2] - old[i, 2]) * world.reach[i]
        if not max(abs(poses[i, 0] - old[i, 0]), abs(poses[i, 1] - old[i, 1])) + turned < SKIN / 2:
            break
    else:
        return
    old[:] = poses
    points, _ = place_all(world, poses)
    low, high = np.empty((bodies, 2)), np.empty((bodies, 2))
    for i in range(bodies):
        for axis in range(2):
            low[i, axis], high[i, axis] = poses[i, axis] - world.radius[i], poses[i, axis] + world.radius[i]
            for k in range(world.counts[i]):
                low[i, axis] = min(low[i, axis], points[i, k, axis])
                high[i, axis] = max(high[i, axis], points[i, k, axis])
    count = 0
    for p in range(len(world.pairs)):
        i, j = world.pairs[p, 0], world.pairs[p, 1]
        if (
            low[i, 0] < high[j, 0] + SKIN
            and low[j, 0] < high[i, 0] + SKIN
            and low[i, 1] < high[j, 1] + SKIN
            and low[j, 1] < high[i, 1] + SKIN
        ):
            memory.near[count] = p
            count += 1
    memory.near_count[0] = count


@njit(cache=True)
def jacobian(x, y, nx, ny, px, py, poses, out):
    """Of the speed at which X's and Y's matter at the point part along (nx, ny)."""
    out[0], out[1] = nx, ny
    out[2] = (px - poses[x, 0]) * ny - (py - poses[x, 1]) * nx
    out[3], out[4] = -nx, -ny
    out[5] = -((px - poses[y, 0]) * ny - (py - poses[y, 1]) * nx)


@njit(cache=True)
def force_before(memory, pair, px, py):
    """The force of the step before at a contact's place."""
    for k in range(2):
        if abs(px - memory.place[pair, k, 0]) + abs(py - memory.place[pair, k, 1]) < SAME_PLACE:
            return memory.force_n[pair, k]
    return 0.0


@njit(cache=True)
def find_rows(world, memory, poses, margin):
    """The contacts whose gap is below the margin, and those that pressed before and are hardly open."""
    find_near(world, memory, poses)
    points, normals = place_all(world, poses)
    most = memory.near_count[0]
    x, y, pair = np.empty(most, np.int64), np.empty(most, np.int64), np.empty(most, np.int64)
    first = np.zeros(most + 1, np.int64)
    normal, friction = np.empty((2 * most, 6)), np.empty((most, 6))
    gap, place = np.empty(2 * most), np.empty((2 * most, 2))
    feature, owner = np.empty((2 * most, 5), np.int64), np.empty(2 * most, np.int64)
    found = np.empty((2, 5), np.int64)
    count, total = 0, 0
    for k in range(most):
        p = memory.near[k]
        i, j = world.pairs[p, 0], world.pairs[p, 1]
        number = features(world, i, j, poses, points, normals, max(margin, DRIFT), found)
        start, least = total, np.inf
        for f in range(number):
            nx, ny, px, py, g = contact(world, found[f], poses, points, normals)
            if g > margin and (g > DRIFT or force_before(memory, p, px, py) == 0):
                continue
            body_x, body_y = found[f, 1], found[f, 3]
            if total == start:
                x[count], y[count] = body_x, body_y
            if g < least:
                least = g
                jacobian(body_x, body_y, -ny, nx, px, py, poses, friction[count])
                turn_round(body_x == x[count], friction[count])
            jacobian(body_x, body_y, nx, ny, px, py, poses, normal[total])
            turn_round(body_x == x[count], normal[total])
            gap[total], place[total, 0], place[total, 1] = g, px, py
            feature[total] = found[f]
            owner[total] = count
            total += 1
        if total > start:
            pair[count] = p
            count += 1
            first[count] = total
    return Rows(
        x[:count],
        y[:count],
        pair[:count],
        first[: count + 1],
        normal[:total],
        friction[:count],
        gap[:total],
        place[:total],
        feature[:total],
        owner[:total],
    )


@njit(cache=True)
def turn_round(same, row):
    """A row of which X and Y are the other way round than of the pair's first row."""
    if not same:
        for k in range(3):
            row[k], row[k + 3] = row[k + 3], row[k]


@njit(cache=True)
def follow(world, rows, poses):
    """The rows of the same features at other poses: normal and friction."""
    points, normals = place_all(world, poses)
    normal, friction = np.empty_like(rows.normal), np.empty_like(rows.friction)
    for c in range(len(rows.x)):
        best = rows.first[c]
        for r in range(rows.first[c], rows.first[c + 1]):
            if rows.gap[r] < rows.gap[best]:
                best = r
        for r in range(rows.first[c], rows.first[c + 1]):
            x, y = rows.feature[r, 1], rows.feature[r, 3]
            nx, ny, px, py, _ = contact(world, rows.feature[r], poses, points, normals)
            jacobian(x, y, nx, ny, px, py, poses, normal[r])
            turn_round(x == rows.x[c], normal[r])
            if r == best:
                jacobian(x, y, -ny, nx, px, py, poses, friction[c])
                turn_round(x == rows.x[c], friction[c])
    return normal, friction


@njit(cache=True)
def along(row, x, y, motion):
    """A row's value for a motion [body, 3]."""
    return (
        row[0] * motion[x, 0]
        + row[1] * motion[x, 1]
        + row[2] * motion[x, 2]
        + row[3] * motion[y, 0]
        + row[4] * motion[y, 1]
        + row[5] * motion[y, 2]
    )


@njit(cache=True)
def push(row, x, y, impulse, inverse, motion):
    """An impulse along a row changes a motion."""
    for k in range(3):
        motion[x, k] += inverse[x, k] * row[k] * impulse
        motion[y, k] += inverse[y, k] * row[k + 3] * impulse


@njit(cache=True)
def deepest(world, memory, poses):
    """The largest penetration of any pair, 0 if there is none."""
    find_near(world, memory, poses)
    points, normals = place_all(world, poses)
    worst = 0.0
    for k in range(memory.near_count[0]):
        i, j = world.pairs[memory.near[k], 0], world.pairs[memory.near[k], 1]
        d = separation(world, i, j, poses[i], poses[j], points[i], normals[i], points[j], normals[j])
        worst = max(worst, -d)
    return worst
