/*
 * The narrow phase of polygons, in offsets (Q10.22): the separating-axis test with support points, then the incident edge
 * clipped against the sides of the reference edge (Sutherland and Hodgman). Both outlines stay in their own frames, where they are
 * constants: only the axes that are tried, and the two corners that are clipped, are turned.
 */
#include "collide_clip.h"

/* And then a in that of b. */
static inline cairn_relative turned_round(cairn_relative r, const cairn_pose *a, const cairn_pose *b)
{
    cairn_offset2 centre = cairn_offset2_turned_back(a->x - b->x, a->y - b->y, b->c, b->s);
    r.x = centre.x;
    r.y = centre.y;
    r.s = -r.s;
    return r;
}

/* A face of one polygon and what of the other one lies nearest to it. */
typedef struct axis {
    cairn_offset separation; /* along the face's normal */
    cairn_unit2 normal;      /* of the face, in the other one's frame */
    uint8_t edge;            /* which face */
    uint8_t corner;          /* the nearest one of the other polygon */
    bool of_b;               /* it is one of b's */
} axis;

/* How far the polygon's farthest corner against a direction of its own frame lies from its centre; at most 0. */
static inline cairn_offset support_distance(const cairn_outline *polygon, cairn_unit2 n, int *corner)
{
    cairn_offset least = 0;
    for (int i = 0; i < polygon->count; i++) {
        cairn_offset distance = cairn_offset_dot(polygon->vertex[i].x, polygon->vertex[i].y, n.x, n.y);
        if (distance < least) {
            least = distance;
            *corner = i;
        }
    }
    return least;
}

/* What the faces of `of` are to be separated from, in the frame of `of`. */
typedef struct counterpart {
    const cairn_outline *outline;
    const cairn_relative *at;
} counterpart;

/* How far the other one's centre lies beyond a face. The face separates them by its inradius less at most: most faces are told by that. */
static inline cairn_offset beyond(const cairn_outline *of, int edge, const cairn_relative *at)
{
    const cairn_offset2 *vertex = &of->vertex[edge];
    return cairn_offset_dot(at->x - vertex->x, at->y - vertex->y, of->normal[edge].x, of->normal[edge].y);
}

/* Look at a face that may separate them more than the best one so far. The result is what the lesser of these two separates them by. */
static cairn_offset try_face(const cairn_outline *of, int edge, cairn_offset centre, const counterpart *from, axis *best)
{
    int corner = 0;
    cairn_unit2 n = cairn_unit2_turned(of->normal[edge], from->at->c, -from->at->s);
    cairn_offset separation = centre + support_distance(from->outline, n, &corner), before = best->separation;
    if (separation <= before) {
        return separation;
    }
    best->separation = separation;
    best->normal = n;
    best->edge = (uint8_t)edge;
    best->corner = (uint8_t)corner;
    return before;
}

/*
 * Find the face of `of` that separates the two most, if it does more than the best one that is given. Beyond the margin any will do. The result is what any
 * other may separate them by at most.
 */
static cairn_offset find_face(const cairn_outline *of, const counterpart *from, cairn_offset margin, axis *best)
{
    cairn_offset first = -CAIRN_OFFSET_MAX, second = -CAIRN_OFFSET_MAX, inradius = from->outline->inradius;
    int facing = 0;
    for (int i = 0; i < of->count; i++) {
        cairn_offset centre = beyond(of, i, from->at);
        if (centre > first) {
            second = first;
            first = centre;
            facing = i;
        } else if (centre > second) {
            second = centre;
        }
    }
    cairn_offset centre = first;
    for (int edge = facing, next = 0;; edge = next++) { /* the one that faces it, then any other: these are seldom needed */
        if (centre > best->separation + inradius) {
            centre = try_face(of, edge, centre, from, best) + inradius;
            first = edge == facing || centre > first ? centre : first;
        }
        if (best->separation > margin || second <= best->separation + inradius || next == of->count) {
            break;
        }
        centre = next == facing ? -CAIRN_OFFSET_MAX : beyond(of, next, from->at);
    }
    return cairn_offset_add(first > second ? first : second, -inradius); /* giants' far sides are cut at -512 m */
}

/* The edge of the polygon that faces most against a direction of its own frame: one of the two at the corner that is farthest against it. */
static int incident_edge(const cairn_outline *polygon, int corner, cairn_unit2 n)
{
    int before = corner > 0 ? corner - 1 : polygon->count - 1;
    cairn_unit one = cairn_unit_dot(polygon->normal[before].x, polygon->normal[before].y, n.x, n.y);
    cairn_unit other = cairn_unit_dot(polygon->normal[corner].x, polygon->normal[corner].y, n.x, n.y);
    return one < other || (one == other && before < corner) ? before : corner;
}

static int after(const cairn_outline *polygon, int edge) { return edge + 1 < polygon->count ? edge + 1 : 0; }

/* A corner of the incident edge in the frame of the reference edge. */
static cairn_edge_point edge_point_of(cairn_offset2 corner, const cairn_relative *at, cairn_offset2 from, cairn_unit2 n)
{
    cairn_edge_point point;
    cairn_offset2 r = cairn_offset2_turned(corner, at->c, at->s);
    r.x += at->x - from.x;
    r.y += at->y - from.y;
    point.along = cairn_offset_dot(r.x, r.y, -n.y, n.x);
    point.separation = cairn_offset_dot(r.x, r.y, n.x, n.y);
    return point;
}

/* What separates the two most. */
typedef struct reference {
    axis face;
    cairn_relative at; /* the other one in the frame of the polygon whose face it is */
} reference;

/* Of two that are not both boxes. False if they are farther apart than the margin. */
CAIRN_APART bool find_reference(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, reference *out, cairn_offset *steady)
{
    cairn_room room; /* for the box, if one of them is */
    cairn_outline of_a, of_b;
    counterpart from;
    cairn_shape_outline(a->shape, room.corner, &of_a);
    cairn_shape_outline(b->shape, room.corner, &of_b);
    out->at = cairn_pose_seen_from(a, b);
    out->face.separation = -CAIRN_OFFSET_MAX;
    out->face.of_b = false;
    from.outline = &of_b;
    from.at = &out->at;
    cairn_offset others = find_face(&of_a, &from, margin, &out->face);
    if (out->face.separation > margin) {
        return false;
    }
    axis face;
    cairn_relative at = turned_round(out->at, a, b);
    face.separation = out->face.separation;
    from.outline = &of_a;
    from.at = &at;
    cairn_offset others_of_b = find_face(&of_b, &from, margin, &face);
    others = others_of_b > others ? others_of_b : others;
    if (face.separation > out->face.separation + CAIRN_FACE_PREFERENCE) {
        out->face = face;
        out->at = at;
        out->face.of_b = true;
    } else if (face.separation > out->face.separation) {
        out->face.separation = others = face.separation;
    }
    /* What nears along one face goes away along another one by as much, at most. */
    *steady = CAIRN_WITH_QUICK_WAYS ? cairn_offset_half(out->face.separation - others - (CAIRN_FACE_PREFERENCE + CAIRN_OUTLINE_ROUNDING)) : 0;
    return out->face.separation <= margin;
}

/* Clip the incident edge against the sides of the reference edge and keep what lies within the margin. */
CAIRN_APART void clip(const cairn_pose *a, const cairn_pose *b, const reference *by, cairn_offset margin, cairn_manifold *out)
{
    const cairn_pose *own = by->face.of_b ? b : a, *against = by->face.of_b ? a : b;
    cairn_outline outline;
    cairn_room room;
    cairn_shape_outline(own->shape, room.corner, &outline);
    int edge = by->face.edge;
    cairn_offset2 from = outline.vertex[edge], to = outline.vertex[after(&outline, edge)];
    cairn_unit2 n = outline.normal[edge];
    cairn_offset length = cairn_offset_dot(to.x - from.x, to.y - from.y, -n.y, n.x);

    cairn_shape_outline(against->shape, room.corner, &outline);
    int facing = incident_edge(&outline, by->face.corner, by->face.normal);
    cairn_edge_point ends[2];
    ends[0] = edge_point_of(outline.vertex[facing], &by->at, from, n);
    ends[1] = edge_point_of(outline.vertex[after(&outline, facing)], &by->at, from, n);

    /* In the world's directions. */
    n = cairn_unit2_turned(n, own->c, own->s);
    from = cairn_offset2_turned(from, own->c, own->s);
    cairn_clip_edge in_world;
    in_world.origin_x = from.x + own->x - a->x;
    in_world.origin_y = from.y + own->y - a->y;
    in_world.height = in_world.low = 0;
    in_world.high = length;
    in_world.x = n.x;
    in_world.y = n.y;
    in_world.edge = edge;
    in_world.incident = facing;
    in_world.swapped = by->face.of_b;
    cairn_clip(&in_world, ends, margin, out);
}

/* In two steps that do not lie on the stack together: a box's corners are there. */
void cairn_collide_polygons(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out)
{
    reference by;
    out->count = 0;
    if (find_reference(a, b, margin, &by, &out->steady)) {
        out->separation = by.face.separation;
        clip(a, b, &by, margin, out);
    }
}
