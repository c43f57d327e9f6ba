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

static int after(const cairn_outline *polygon, int edge) { return edge + 1 < polygon->count ? edge + 1 : 0; }

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

/* Which edge separates the two most. */
typedef struct reference {
    int edge;
    bool swapped; /* it is one of b's */
} reference;

/* The separation along that edge; above the margin, there need not be one. */
CAIRN_APART cairn_offset find_reference(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, reference *out)
{
    cairn_outline of_a, of_b;
    int edge_b = 0;
    out->edge = 0;
    out->swapped = false;
    a->shape->kind->outline(a->shape, &of_a);
    b->shape->kind->outline(b->shape, &of_b);
    relative at = seen_from(a, b);
    cairn_offset from_a = deepest_axis(&of_a, &of_b, &at, margin, &out->edge);
    if (from_a > margin) {
        return from_a;
    }
    at = turned_round(at, a, b);
    cairn_offset from_b = deepest_axis(&of_b, &of_a, &at, margin, &edge_b);
    if (from_b > from_a + CAIRN_FACE_PREFERENCE) {
        out->edge = edge_b;
        out->swapped = true;
    }
    return from_a > from_b ? from_a : from_b;
}

/* Clip the incident edge against the sides of the reference edge and keep what lies within the margin. */
CAIRN_APART void clip(const cairn_pose *a, const cairn_pose *b, const reference *by, cairn_offset margin, cairn_manifold *out)
{
    const cairn_pose *own = by->swapped ? b : a, *other = by->swapped ? a : b;
    cairn_outline outline;
    own->shape->kind->outline(own->shape, &outline);
    int edge = by->edge;
    cairn_offset2 from = outline.vertex[edge], to = outline.vertex[after(&outline, edge)];
    cairn_unit2 n = outline.normal[edge];
    cairn_offset length = cairn_offset_dot(to.x - from.x, to.y - from.y, -n.y, n.x);

    relative at = seen_from(own, other);
    other->shape->kind->outline(other->shape, &outline);
    int facing = incident_edge(&outline, &at, n);
    edge_point ends[2];
    ends[0] = edge_point_of(outline.vertex[facing], &at, from, n);
    ends[1] = edge_point_of(outline.vertex[after(&outline, facing)], &at, from, n);

    /* From here on in the world's directions. */
    n = cairn_unit2_turned(n, own->c, own->s);
    from = cairn_offset2_turned(from, own->c, own->s);
    from.x += own->x - a->x;
    from.y += own->y - a->y;
    for (int i = 0; i < 2; i++) {
        edge_point point = ends[i], end = ends[1 - i];
        if ((point.along < 0 && end.along < 0) || (point.along > length && end.along > length)) {
            continue;
        }
        if (point.along < 0) {
            point = clipped(point, end, 0);
        } else if (point.along > length) {
            point = clipped(point, end, length);
        }
        if (point.separation > margin) {
            continue;
        }
        cairn_manifold_point *result = &out->points[out->count++];
        cairn_offset half = cairn_offset_half(point.separation);
        result->x = from.x + cairn_offset_dot(point.along, half, -n.y, n.x);
        result->y = from.y + cairn_offset_dot(point.along, half, n.x, n.y);
        result->separation = point.separation;
        result->feature = cairn_feature(edge, facing, i, by->swapped);
    }
    out->normal_x = by->swapped ? -n.x : n.x;
    out->normal_y = by->swapped ? -n.y : n.y;
}

/* In two steps that do not lie on the stack together: the outlines of boxes are there. */
void cairn_collide_polygons(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out)
{
    reference by;
    out->count = 0;
    cairn_offset separation = find_reference(a, b, margin, &by);
    if (separation <= margin) {
        out->separation = separation;
        clip(a, b, &by, margin, out);
    }
}
