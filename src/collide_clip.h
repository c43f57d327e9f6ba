/*
 * What the narrow phases of boxes and of polygons share: how one is seen from the other, and the end of both, where the incident edge is clipped
 * against the sides of the reference edge (Sutherland and Hodgman).
 */
#ifndef CAIRN_COLLIDE_CLIP_H
#define CAIRN_COLLIDE_CLIP_H

#include "engine.h"

/* One outline in the frame of another: its centre and its rotation. */
typedef struct cairn_relative {
    cairn_offset x, y;
    cairn_unit c, s;
} cairn_relative;

/* b in the frame of a. */
CAIRN_ONCE cairn_relative cairn_pose_seen_from(const cairn_pose *a, const cairn_pose *b)
{
    cairn_relative r;
    cairn_offset x = b->x - a->x, y = b->y - a->y;
    r.x = cairn_offset_dot(x, y, a->c, a->s);
    r.y = cairn_offset_dot(x, y, -a->s, a->c);
    r.c = cairn_unit_dot(a->c, a->s, b->c, b->s);
    r.s = cairn_unit_dot(a->c, a->s, b->s, -b->c);
    return r;
}

/* An end of the incident edge as the reference edge sees it: along it, and outside of it. */
typedef struct cairn_edge_point {
    cairn_offset along, separation;
} cairn_edge_point;

/* The reference edge in the world, its normal (x, y): from `low` to `high` along it, counted from the foot of a normal through the origin. */
typedef struct cairn_clip_edge {
    cairn_offset origin_x, origin_y, height; /* how far outside of the origin it lies */
    cairn_offset low, high;
    cairn_unit x, y;
    int edge, incident;
    bool swapped; /* it is one of b's */
} cairn_clip_edge;

/* Bring `point` to `along` by going towards `other`. */
CAIRN_ONCE cairn_edge_point cairn_edge_point_clipped(cairn_edge_point point, cairn_edge_point other, cairn_offset along)
{
    cairn_offset whole = other.along - point.along, part = along - point.along;
    cairn_unit fraction = whole < 0 ? cairn_offset_fraction(-part, -whole) : cairn_offset_fraction(part, whole);
    point.along = along;
    point.separation += cairn_offset_mul(other.separation - point.separation, fraction);
    return point;
}

/* Keeps what lies within the margin. */
CAIRN_ONCE void cairn_clip(const cairn_clip_edge *by, const cairn_edge_point ends[2], cairn_offset margin, cairn_manifold *out)
{
    for (int i = 0; i < 2; i++) {
        cairn_edge_point point = ends[i], end = ends[1 - i];
        if ((point.along < by->low && end.along < by->low) || (point.along > by->high && end.along > by->high)) {
            continue;
        }
        if (point.along < by->low) {
            point = cairn_edge_point_clipped(point, end, by->low);
        } else if (point.along > by->high) {
            point = cairn_edge_point_clipped(point, end, by->high);
        }
        point.separation -= by->height;
        if (point.separation > margin) {
            continue;
        }
        cairn_manifold_point *result = &out->points[out->count++];
        cairn_offset middle = by->height + cairn_offset_half(point.separation);
        result->x = by->origin_x + cairn_offset_dot(middle, point.along, by->x, -by->y);
        result->y = by->origin_y + cairn_offset_dot(middle, point.along, by->y, by->x);
        result->separation = point.separation;
        result->feature = cairn_feature(by->edge, by->incident, i, by->swapped);
    }
    out->normal_x = by->swapped ? -by->x : by->x;
    out->normal_y = by->swapped ? -by->y : by->y;
}

#endif
