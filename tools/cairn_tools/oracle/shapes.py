"""Exact plane geometry of two bodies: how far apart they are, and which corner meets which face. Compiled by numba."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

# What touches what. X comes first: the contact's normal points from Y to X.
ROUND_ROUND, ROUND_FACE, ROUND_CORNER, CORNER_FACE = 0, 1, 2, 3

LATERAL = 1e-9  # m that a corner may lie beside a face and still be on it
PARALLEL = 0.5  # least cosine between two faces whose corners bear on one another


@njit(cache=True)
def outline(world, body, pose, points, normals):
    """A polygon's corners and normals in the world; gives their count."""
    c, s = math.cos(pose[2]), math.sin(pose[2])
    count = world.counts[body]
    for k in range(count):
        x, y = world.corners[body, k, 0], world.corners[body, k, 1]
        points[k, 0] = pose[0] + (c * x - s * y)
        points[k, 1] = pose[1] + (s * x + c * y)
        x, y = world.normals[body, k, 0], world.normals[body, k, 1]
        normals[k, 0] = c * x - s * y
        normals[k, 1] = s * x + c * y
    return count


@njit(cache=True)
def place_all(world, poses):
    bodies, most = world.corners.shape[0], world.corners.shape[1]
    points, normals = np.zeros((bodies, most, 2)), np.zeros((bodies, most, 2))
    for i in range(bodies):
        outline(world, i, poses[i], points[i], normals[i])
    return points, normals


@njit(cache=True)
def widest_axis(points, count, face_points, face_normals, faces):
    """The face that separates the points most: by how much, the face and the nearest point."""
    best, face, point = -np.inf, 0, 0
    for f in range(faces):
        nx, ny = face_normals[f, 0], face_normals[f, 1]
        least, nearest = np.inf, 0
        for k in range(count):
            d = nx * (points[k, 0] - face_points[f, 0]) + ny * (points[k, 1] - face_points[f, 1])
            if d < least:
                least, nearest = d, k
        if least > best:
            best, face, point = least, f, nearest
    return best, face, point


@njit(cache=True)
def round_and_polygon(x, y, radius, points, normals, count):
    """Distance of a disc and a polygon, and what of the polygon is nearest: (distance, kind, place)."""
    best, face = -np.inf, 0
    for f in range(count):
        d = normals[f, 0] * (x - points[f, 0]) + normals[f, 1] * (y - points[f, 1])
        if d > best:
            best, face = d, f
    following = face + 1 if face + 1 < count else 0
    if best > 0:
        tx, ty = -normals[face, 1], normals[face, 0]
        if (x - points[face, 0]) * tx + (y - points[face, 1]) * ty < 0:
            return math.hypot(x - points[face, 0], y - points[face, 1]) - radius, ROUND_CORNER, face
        if (x - points[following, 0]) * tx + (y - points[following, 1]) * ty > 0:
            return math.hypot(x - points[following, 0], y - points[following, 1]) - radius, ROUND_CORNER, following
    return best - radius, ROUND_FACE, face


@njit(cache=True)
def separation(world, i, j, pose_i, pose_j, points_i, normals_i, points_j, normals_j):
    """How far two placed bodies are apart, negative where they overlap; exact where they touch."""
    ci, cj = world.counts[i], world.counts[j]
    if ci == 0 and cj == 0:
        return math.hypot(pose_i[0] - pose_j[0], pose_i[1] - pose_j[1]) - world.radius[i] - world.radius[j]
    if ci == 0:
        return round_and_polygon(pose_i[0], pose_i[1], world.radius[i], points_j, normals_j, cj)[0]
    if cj == 0:
        return round_and_polygon(pose_j[0], pose_j[1], world.radius[j], points_i, normals_i, ci)[0]
    first = widest_axis(points_i, ci, points_j, normals_j, cj)[0]
    return max(first, widest_axis(points_j, cj, points_i, normals_i, ci)[0])


@njit(cache=True)
def separation_at(world, i, j, pose_i, pose_j):
    """The same of two bodies that are not placed yet."""
    most = world.corners.shape[1]
    pi, ni, pj, nj = np.empty((most, 2)), np.empty((most, 2)), np.empty((most, 2)), np.empty((most, 2))
    outline(world, i, pose_i, pi, ni)
    outline(world, j, pose_j, pj, nj)
    return separation(world, i, j, pose_i, pose_j, pi, ni, pj, nj)


@njit(cache=True)
def features(world, i, j, poses, points, normals, margin, out):
    """The at most two features in which bodies i and j touch or nearly do: rows kind, X, place in X, Y, place in Y."""
    ci, cj = world.counts[i], world.counts[j]
    if ci > 0 and cj > 0:
        return corner_features(i, j, ci, cj, points, normals, margin, out)
    x, y = (i, j) if ci == 0 else (j, i)
    if ci == 0 and cj == 0:
        distance = math.hypot(poses[i, 0] - poses[j, 0], poses[i, 1] - poses[j, 1]) - world.radius[i] - world.radius[j]
        kind, place = ROUND_ROUND, 0
    else:
        distance, kind, place = round_and_polygon(
            poses[x, 0], poses[x, 1], world.radius[x], points[y], normals[y], world.counts[y]
        )
    if distance > margin:
        return 0
    fill(out, 0, kind, x, 0, y, place)
    return 1


@njit(cache=True)
def fill(out, row, kind, x, place_x, y, place_y):
    out[row, 0], out[row, 1], out[row, 2], out[row, 3], out[row, 4] = kind, x, place_x, y, place_y


@njit(cache=True)
def corner_features(i, j, ci, cj, points, normals, margin, out):
    """Of two polygons: corners of X on the face of Y that separates most, corners of that face on X's face there."""
    by_j, face_j, near_i = widest_axis(points[i], ci, points[j], normals[j], cj)
    by_i, face_i, near_j = widest_axis(points[j], cj, points[i], normals[i], ci)
    if max(by_i, by_j) > margin:
        return 0
    x, y, cx, cy, face, nearest = (i, j, ci, cj, face_j, near_i) if by_j >= by_i else (j, i, cj, ci, face_i, near_j)
    nx, ny = normals[y, face, 0], normals[y, face, 1]
    other = 0
    for f in range(cx):
        if normals[x, f, 0] * nx + normals[x, f, 1] * ny < normals[x, other, 0] * nx + normals[x, other, 1] * ny:
            other = f
    parallel = -(normals[x, other, 0] * nx + normals[x, other, 1] * ny) > PARALLEL
    low, high, found = np.inf, -np.inf, 0
    for side in range(4):
        if side < 2:  # an end of X's face on Y's face
            owner, corner, host, host_face = x, (other + side) % cx, y, face
        else:  # an end of Y's face on X's face
            if not parallel:
                continue
            owner, corner, host, host_face = y, (face + side - 2) % cy, x, other
        count = cy if host == y else cx
        px, py = points[owner, corner, 0], points[owner, corner, 1]
        ax, ay = points[host, host_face, 0], points[host, host_face, 1]
        bx, by = points[host, (host_face + 1) % count, 0], points[host, (host_face + 1) % count, 1]
        hx, hy = normals[host, host_face, 0], normals[host, host_face, 1]
        if hx * (px - ax) + hy * (py - ay) > margin:
            continue
        if (px - ax) * -hy + (py - ay) * hx < -LATERAL or (bx - px) * -hy + (by - py) * hx < -LATERAL:
            continue
        along = px * -ny + py * nx
        if along < low:
            low = along
            fill(out, 0, CORNER_FACE, owner, corner, host, host_face)
        if along > high + LATERAL:
            high = along
            fill(out, 1, CORNER_FACE, owner, corner, host, host_face)
        found += 1
    if found == 0:
        fill(out, 0, CORNER_FACE, x, nearest, y, face)
        return 1
    return 2 if high > low + LATERAL else 1


@njit(cache=True)
def contact(world, feature, poses, points, normals):
    """Of a feature at these poses: normal (x, y), the point (x, y) and the gap along the normal."""
    kind, x, y = feature[0], feature[1], feature[3]
    if kind == CORNER_FACE:
        nx, ny = normals[y, feature[4], 0], normals[y, feature[4], 1]
        px, py = points[x, feature[2], 0], points[x, feature[2], 1]
        return nx, ny, px, py, nx * (px - points[y, feature[4], 0]) + ny * (py - points[y, feature[4], 1])
    radius = world.radius[x]
    if kind == ROUND_FACE:
        nx, ny = normals[y, feature[4], 0], normals[y, feature[4], 1]
        gap = nx * (poses[x, 0] - points[y, feature[4], 0]) + ny * (poses[x, 1] - points[y, feature[4], 1]) - radius
    else:
        ox = poses[y, 0] if kind == ROUND_ROUND else points[y, feature[4], 0]
        oy = poses[y, 1] if kind == ROUND_ROUND else points[y, feature[4], 1]
        nx, ny = poses[x, 0] - ox, poses[x, 1] - oy
        distance = math.hypot(nx, ny)
        if distance == 0:
            nx, ny = 0.0, 1.0
        else:
            nx, ny = nx / distance, ny / distance
        gap = distance - radius - (world.radius[y] if kind == ROUND_ROUND else 0.0)
    # Half way between the surfaces where they are apart.
    way = radius + gap / 2
    return nx, ny, poses[x, 0] - way * nx, poses[x, 1] - way * ny, gap
