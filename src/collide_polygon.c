/*
 * The narrow phase of polygons, in offsets (Q10.22) in the first body's own frame, so that only the second one's outline
 * has to be turned: the separating-axis test with support points, then the incident edge clipped against the sides of
 * the reference edge (Sutherland and Hodgman). The contact found is turned back.
 */
#include "engine.h"

void cairn_pose_hull(const cairn_pose *pose, cairn_hull *hull)
{
    pose->shape->kind->outline(pose->shape, pose->c, pose->s, hull);
    for (int i = 0; i < hull->count; i++) {
        hull->vertex[i].x += pose->x;
        hull->vertex[i].y += pose->y;
    }
}

/* How far the hull's deepest corner lies outside of the line through (x, y) with normal (nx, ny). */
static cairn_offset support_distance(const cairn_hull *hull, cairn_offset x, cairn_offset y, cairn_unit nx, cairn_unit ny)
{
    cairn_offset least = cairn_offset_dot(hull->vertex[0].x - x, hull->vertex[0].y - y, nx, ny);
    for (int i = 1; i < hull->count; i++) {
        cairn_offset distance = cairn_offset_dot(hull->vertex[i].x - x, hull->vertex[i].y - y, nx, ny);
        least = distance < least ? distance : least;
    }
    return least;
}

/*
 * The edge of `of` that separates it most from `from`, whose centre is at (x, y). No corner of `from` lies farther out than
 * its centre does, so most edges are told by that one point. Beyond the margin any edge will do.
 */
static cairn_offset deepest_axis(const cairn_hull *of, const cairn_hull *from, cairn_offset x, cairn_offset y, cairn_offset margin, int *edge)
{
    cairn_offset most_at_best[CAIRN_MAX_VERTICES];
    int facing = 0;
    for (int i = 0; i < of->count; i++) {
        most_at_best[i] = cairn_offset_dot(x - of->vertex[i].x, y - of->vertex[i].y, of->normal[i].x, of->normal[i].y);
        facing = most_at_best[i] > most_at_best[facing] ? i : facing;
    }
    cairn_offset most = -CAIRN_OFFSET_MAX;
    for (int k = 0; k < of->count && most <= margin; k++) {
        int i = k == 0 ? facing : k <= facing ? k - 1 : k; /* the one that faces it first */
        if (most_at_best[i] > most) {
            cairn_offset distance = support_distance(from, of->vertex[i].x, of->vertex[i].y, of->normal[i].x, of->normal[i].y);
            if (distance > most) {
                most = distance;
                *edge = i;
            }
        }
    }
    return most;
}

/* The edge of the hull that faces most against (nx, ny). */
static int incident_edge(const cairn_hull *hull, cairn_unit nx, cairn_unit ny)
{
    int edge = 0;
    cairn_unit least = cairn_unit_dot(hull->normal[0].x, hull->normal[0].y, nx, ny);
    for (int i = 1; i < hull->count; i++) {
        cairn_unit facing = cairn_unit_dot(hull->normal[i].x, hull->normal[i].y, nx, ny);
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

static edge_point edge_point_of(const cairn_hull *hull, int corner, cairn_offset x, cairn_offset y, cairn_unit nx, cairn_unit ny)
{
    edge_point point;
    cairn_offset rx = hull->vertex[corner].x - x, ry = hull->vertex[corner].y - y;
    point.along = cairn_offset_dot(rx, ry, -ny, nx);
    point.separation = cairn_offset_dot(rx, ry, nx, ny);
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

/* Clip the incident edge against the sides of the reference edge and keep what lies within the margin. */
static void clip(const cairn_hull *reference, int edge, const cairn_hull *incident, bool swapped, cairn_offset margin, cairn_manifold *out)
{
    cairn_unit nx = reference->normal[edge].x, ny = reference->normal[edge].y;
    int next = edge + 1 < reference->count ? edge + 1 : 0;
    cairn_offset x = reference->vertex[edge].x, y = reference->vertex[edge].y;
    cairn_offset length = cairn_offset_dot(reference->vertex[next].x - x, reference->vertex[next].y - y, -ny, nx);

    int facing = incident_edge(incident, nx, ny);
    int after = facing + 1 < incident->count ? facing + 1 : 0;
    edge_point ends[2];
    ends[0] = edge_point_of(incident, facing, x, y, nx, ny);
    ends[1] = edge_point_of(incident, after, x, y, nx, ny);

    out->count = 0;
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
        result->x = x + cairn_offset_dot(point.along, half, -ny, nx);
        result->y = y + cairn_offset_dot(point.along, half, nx, ny);
        result->separation = point.separation;
        result->feature = cairn_feature(edge, facing, i, swapped);
    }
    out->normal_x = swapped ? -nx : nx;
    out->normal_y = swapped ? -ny : ny;
}

/* b as seen from a's own frame. */
static cairn_pose seen_from(const cairn_pose *a, const cairn_pose *b)
{
    cairn_pose pose;
    cairn_offset x = b->x - a->x, y = b->y - a->y;
    pose.shape = b->shape;
    pose.x = cairn_offset_dot(x, y, a->c, a->s);
    pose.y = cairn_offset_dot(x, y, -a->s, a->c);
    pose.c = cairn_unit_dot(a->c, a->s, b->c, b->s);
    pose.s = cairn_unit_dot(a->c, a->s, b->s, -b->c);
    return pose;
}

/* A contact in the frame of a back into the world's. */
static void turn_back(const cairn_pose *a, cairn_manifold *contact)
{
    cairn_unit nx = contact->normal_x, ny = contact->normal_y;
    contact->normal_x = cairn_unit_dot(nx, ny, a->c, -a->s);
    contact->normal_y = cairn_unit_dot(nx, ny, a->s, a->c);
    for (int i = 0; i < contact->count; i++) {
        cairn_manifold_point *point = &contact->points[i];
        cairn_offset x = point->x, y = point->y;
        point->x = a->x + cairn_offset_dot(x, y, a->c, -a->s);
        point->y = a->y + cairn_offset_dot(x, y, a->s, a->c);
    }
}

void cairn_collide_polygons(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out)
{
    cairn_hull hull_a, hull_b;
    int edge_a = 0, edge_b = 0;
    cairn_pose relative = seen_from(a, b);
    out->count = 0;
    a->shape->kind->outline(a->shape, CAIRN_UNIT(1), 0, &hull_a);
    cairn_pose_hull(&relative, &hull_b);
    cairn_offset from_a = deepest_axis(&hull_a, &hull_b, relative.x, relative.y, margin, &edge_a);
    if (from_a > margin) {
        return;
    }
    cairn_offset from_b = deepest_axis(&hull_b, &hull_a, 0, 0, margin, &edge_b);
    if (from_b > margin) {
        return;
    }
    out->separation = from_a > from_b ? from_a : from_b;
    if (from_b > from_a + CAIRN_FACE_PREFERENCE) {
        clip(&hull_b, edge_b, &hull_a, true, margin, out);
    } else {
        clip(&hull_a, edge_a, &hull_b, false, margin, out);
    }
    turn_back(a, out);
}
