/*
 * The narrow phase of polygons, in offsets (Q10.22): the separating-axis test with support points, then the incident edge
 * clipped against the sides of the reference edge (Sutherland and Hodgman). Both outlines stay in their own frames, where they are
 * constants: only the axes that are tried, and the two corners that are clipped, are turned.
 */
#include "engine.h"

/* One polygon in the frame of another. */
typedef struct relative {
    cairn_offset2 centre;
    cairn_unit c, s;
} relative;

/* b in the frame of a, and then a in that of b. */
static relative seen_from(const cairn_pose *a, const cairn_pose *b)
{
    relative r;
    r.centre = cairn_offset2_turned_back(b->x - a->x, b->y - a->y, a->c, a->s);
    r.c = cairn_unit_dot(a->c, a->s, b->c, b->s);
    r.s = cairn_unit_dot(a->c, a->s, b->s, -b->c);
    return r;
}

static relative turned_round(relative r, const cairn_pose *a, const cairn_pose *b)
{
    r.centre = cairn_offset2_turned_back(a->x - b->x, a->y - b->y, b->c, b->s);
    r.s = -r.s;
    return r;
}

/* How far the polygon's farthest corner against a direction of the other frame lies from its centre; at most 0. */
static cairn_offset support_distance(const cairn_outline *polygon, const relative *at, cairn_unit2 direction)
{
    cairn_unit2 n = cairn_unit2_turned(direction, at->c, -at->s);
    cairn_offset least = 0;
    for (int i = 0; i < polygon->count; i++) {
        cairn_offset distance = cairn_offset_dot(polygon->vertex[i].x, polygon->vertex[i].y, n.x, n.y);
        least = distance < least ? distance : least;
    }
    return least;
}

/*
 * The edge of `of` that separates it most from `from`. No corner of `from` lies farther out than
 * its centre does, so most edges are told by that one point. Beyond the margin any edge will do.
 */
static cairn_offset deepest_axis(const cairn_outline *of, const cairn_outline *from, const relative *at, cairn_offset margin, int *edge)
{
    cairn_offset most_at_best[CAIRN_MAX_VERTICES];
    int facing = 0;
    for (int i = 0; i < of->count; i++) {
        most_at_best[i] = cairn_offset_dot(at->centre.x - of->vertex[i].x, at->centre.y - of->vertex[i].y, of->normal[i].x, of->normal[i].y);
        facing = most_at_best[i] > most_at_best[facing] ? i : facing;
    }
    cairn_offset most = -CAIRN_OFFSET_MAX;
    for (int k = 0; k < of->count && most <= margin; k++) {
        int i = k == 0 ? facing : k <= facing ? k - 1 : k; /* the one that faces it first */
        if (most_at_best[i] > most) {
            cairn_offset distance = most_at_best[i] + support_distance(from, at, of->normal[i]);
            if (distance > most) {
                most = distance;
                *edge = i;
            }
        }
    }
    return most;
}

/* The edge of the polygon that faces most against a direction of the other frame. */
static int incident_edge(const cairn_outline *polygon, const relative *at, cairn_unit2 direction)
{
    cairn_unit2 n = cairn_unit2_turned(direction, at->c, -at->s);
    int edge = 0;
    cairn_unit least = CAIRN_UNIT(1.5);
    for (int i = 0; i < polygon->count; i++) {
        cairn_unit facing = cairn_unit_dot(polygon->normal[i].x, polygon->normal[i].y, n.x, n.y);
        if (facing < least) {
            least = facing;
            edge = i;
        }
    }
    return edge;
}

/* A corner of the incident edge in the frame of the reference edge. */
typedef struct edge_point {
    cairn_offset along, separation;
} edge_point;

static edge_point edge_point_of(cairn_offset2 corner, const relative *at, cairn_offset2 from, cairn_unit2 n)
{
    edge_point point;
    cairn_offset2 r = cairn_offset2_turned(corner, at->c, at->s);
    r.x += at->centre.x - from.x;
    r.y += at->centre.y - from.y;
    point.along = cairn_offset_dot(r.x, r.y, -n.y, n.x);
    point.separation = cairn_offset_dot(r.x, r.y, n.x, n.y);
    return point;
}

/* Bring `point` to `along` by going towards `other`. */
static edge_point clipped(edge_point point, edge_point other, cairn_offset along)
{
    edge_point result;
    cairn_offset whole = other.along - point.along, part = along - point.along;
    cairn_unit fraction = whole < 0 ? cairn_offset_fraction(-part, -whole) : cairn_offset_fraction(part, whole);
    result.along = along;
    result.separation = point.separation + cairn_offset_mul(other.separation - point.separation, fraction);
    return result;
}

/* The polygon whose edge is the reference. */
typedef struct reference {
    const cairn_outline *outline;
    const cairn_pose *pose;
    cairn_offset2 from_a; /* its centre */
    int edge;
    bool swapped; /* it is b */
} reference;

/* Clip the incident edge against the sides of the reference edge and keep what lies within the margin. */
static void clip(const reference *face, const cairn_outline *incident, const relative *at, cairn_offset margin, cairn_manifold *out)
{
    const cairn_outline *outline = face->outline;
    int edge = face->edge, next = edge + 1 < outline->count ? edge + 1 : 0;
    cairn_offset2 from = outline->vertex[edge], to = outline->vertex[next];
    cairn_unit2 n = outline->normal[edge];
    cairn_offset length = cairn_offset_dot(to.x - from.x, to.y - from.y, -n.y, n.x);

    int facing = incident_edge(incident, at, n);
    int after = facing + 1 < incident->count ? facing + 1 : 0;
    edge_point ends[2];
    ends[0] = edge_point_of(incident->vertex[facing], at, from, n);
    ends[1] = edge_point_of(incident->vertex[after], at, from, n);

    /* From here on in the world's directions. */
    cairn_unit c = face->pose->c, s = face->pose->s;
    n = cairn_unit2_turned(n, c, s);
    from = cairn_offset2_turned(from, c, s);
    for (int i = 0; i < 2; i++) {
        edge_point point = ends[i], other = ends[1 - i];
        if ((point.along < 0 && other.along < 0) || (point.along > length && other.along > length)) {
            continue;
        }
        if (point.along < 0) {
            point = clipped(point, other, 0);
        } else if (point.along > length) {
            point = clipped(point, other, length);
        }
        if (point.separation > margin) {
            continue;
        }
        cairn_manifold_point *result = &out->points[out->count++];
        cairn_offset half = cairn_offset_half(point.separation);
        result->x = face->from_a.x + from.x + cairn_offset_dot(point.along, half, -n.y, n.x);
        result->y = face->from_a.y + from.y + cairn_offset_dot(point.along, half, n.x, n.y);
        result->separation = point.separation;
        result->feature = cairn_feature(edge, facing, i, face->swapped);
    }
    out->normal_x = face->swapped ? -n.x : n.x;
    out->normal_y = face->swapped ? -n.y : n.y;
}

void cairn_collide_polygons(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out)
{
    cairn_outline of_a, of_b;
    int edge_a = 0, edge_b = 0;
    out->count = 0;
    a->shape->kind->outline(a->shape, &of_a);
    b->shape->kind->outline(b->shape, &of_b);
    relative at = seen_from(a, b);
    cairn_offset from_a = deepest_axis(&of_a, &of_b, &at, margin, &edge_a);
    if (from_a > margin) {
        return;
    }
    relative back = turned_round(at, a, b);
    cairn_offset from_b = deepest_axis(&of_b, &of_a, &back, margin, &edge_b);
    if (from_b > margin) {
        return;
    }
    out->separation = from_a > from_b ? from_a : from_b;
    if (from_b > from_a + CAIRN_FACE_PREFERENCE) {
        reference face = { &of_b, b, { b->x - a->x, b->y - a->y }, edge_b, true };
        clip(&face, &of_a, &back, margin, out);
    } else {
        reference face = { &of_a, a, { 0, 0 }, edge_a, false };
        clip(&face, &of_b, &at, margin, out);
    }
}
