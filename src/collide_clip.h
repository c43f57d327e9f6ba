/*
 * What the narrow phases of boxes and of polygons share: how one is seen from the other, and the end of both, where the incident edge is clipped
 * against the sides of the reference edge (Sutherland and Hodgman).
 */
#ifndef CAIRN_COLLIDE_CLIP_H
#define CAIRN_COLLIDE_CLIP_H

#include "engine.h"

/* One outline in the frame of another: its centre and its rotation. */
typedef struct cairn_relative {
    cairn_offset2 centre;
    cairn_unit c, s;
} cairn_relative;

/* b in the frame of a. */
CAIRN_ONCE cairn_relative cairn_pose_seen_from(const cairn_pose *a, const cairn_pose *b)
{
    cairn_relative r;
    r.centre = cairn_offset2_turned_back(b->x - a->x, b->y - a->y, a->c, a->s);
    r.c = cairn_unit_dot(a->c, a->s, b->c, b->s);
    r.s = cairn_unit_dot(a->c, a->s, b->s, -b->c);
    return r;
}

/* And then a in that of b. */
static inline void cairn_relative_turn_round(const cairn_relative *r, const cairn_pose *a, const cairn_pose *b, cairn_relative *out)
{
    out->centre = cairn_offset2_turned_back(a->x - b->x, a->y - b->y, b->c, b->s);
    out->c = r->c;
    out->s = -r->s;
}

/* A vector as an edge sees it: what of it goes along the edge, and what goes out of it. */
typedef struct cairn_edge_point {
    cairn_offset along, separation;
} cairn_edge_point;

/* The reference edge, counted from the centre of its polygon; centre and normal are in the world. */
typedef struct cairn_clip_edge {
    cairn_offset2 centre;
    cairn_unit2 n;
    cairn_offset height; /* how far outside of the centre it lies */
    cairn_offset low, high; /* from where to where along it */
    int edge, incident;
    bool swapped; /* it is one of b's */
} cairn_clip_edge;

/* Bring `point`, which lies beyond an end of the reference edge, to `along` by going towards `other`. */
CAIRN_ONCE void cairn_edge_point_cut(cairn_edge_point *point, const cairn_edge_point *other, cairn_offset along)
{
    cairn_offset whole = other->along - point->along, part = along - point->along;
    cairn_unit fraction = whole < 0 ? cairn_offset_fraction(-part, -whole) : cairn_offset_fraction(part, whole);
    point->along = along;
    point->separation += cairn_offset_mul(other->separation - point->separation, fraction);
}

/* Cut the one that is told to what lies beside the reference edge. False if nothing does. */
static inline bool cairn_edge_point_clip(const cairn_clip_edge *by, const cairn_edge_point ends[2], int i, cairn_edge_point *point)
{
    const cairn_edge_point *other = &ends[1 - i];
    cairn_offset along = ends[i].along;
    *point = ends[i];
    if (along >= by->low && along <= by->high) {
        return true;
    }
    if (along < by->low ? other->along < by->low : other->along > by->high) {
        return false;
    }
    cairn_edge_point_cut(point, other, along < by->low ? by->low : by->high);
    return true;
}

/* Keeps what lies within the margin. */
CAIRN_ONCE void cairn_clip(const cairn_clip_edge *by, const cairn_edge_point ends[2], cairn_offset margin, cairn_manifold *out)
{
    for (int i = 0; i < 2; i++) {
        cairn_edge_point point;
        if (!cairn_edge_point_clip(by, ends, i, &point)) {
            continue;
        }
        point.separation -= by->height;
        if (point.separation > margin) {
            continue;
        }
        cairn_manifold_point *result = &out->points[out->count++];
        cairn_offset2 middle;
        middle.x = by->height + cairn_offset_half(point.separation);
        middle.y = point.along;
        middle = cairn_offset2_turned(middle, by->n.x, by->n.y);
        result->x = by->centre.x + middle.x;
        result->y = by->centre.y + middle.y;
        result->separation = point.separation;
        result->feature = cairn_feature(by->edge, by->incident, i, by->swapped);
    }
    out->normal_x = by->swapped ? -by->n.x : by->n.x;
    out->normal_y = by->swapped ? -by->n.y : by->n.y;
}

#endif
