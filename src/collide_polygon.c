/*
 * The narrow phase of polygons, in offsets (Q10.22): the separating-axis test with support points, then the incident edge
 * clipped against the sides of the reference edge (Sutherland and Hodgman). Both outlines stay in their own frames, where they are
 * constants: only the axes that are tried, and the two corners that are clipped, are turned.
 */
#include "collide_clip.h"

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
static inline cairn_offset beyond(const cairn_outline *of, int edge, const cairn_relative *at) { return cairn_outline_outside(of, edge, &at->centre); }

/* Look at a face that may separate them more than the best one so far. The result is what the lesser of these two separates them by. */
static cairn_offset try_face(const cairn_outline *of, int edge, cairn_offset centre, const counterpart *from, axis *best)
{
    int corner = 0;
    cairn_unit2 n = cairn_unit2_turned(of->normal[edge], from->at->c, -from->at->s);
    cairn_offset separation = centre + support_distance(from->outline, n, &corner), before = best->separation;
    if (separation < before || (separation == before && edge >= best->edge)) { /* the first of several that are as good */
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
static cairn_offset find_face_quickly(const cairn_outline *of, const counterpart *from, cairn_offset margin, axis *best)
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

/* The same. Without quick ways the faces are tried in their order, and nothing is known of the others. */
static cairn_offset find_face(const cairn_outline *of, const counterpart *from, cairn_offset margin, axis *best)
{
    best->edge = 0;
    if (CAIRN_WITH_QUICK_WAYS) {
        return find_face_quickly(of, from, margin, best);
    }
    for (int i = 0; i < of->count; i++) {
        cairn_offset centre = beyond(of, i, from->at);
        if (centre > best->separation + from->outline->inradius) {
            try_face(of, i, centre, from, best);
        }
    }
    return 0;
}

/* The edge of the polygon that faces most against a direction of its own frame: one of the two at the corner that is farthest against it. */
static int incident_edge(const cairn_outline *polygon, int corner, cairn_unit2 n)
{
    int before = corner > 0 ? corner - 1 : polygon->count - 1;
    cairn_unit one = cairn_unit_dot(polygon->normal[before].x, polygon->normal[before].y, n.x, n.y);
    cairn_unit other = cairn_unit_dot(polygon->normal[corner].x, polygon->normal[corner].y, n.x, n.y);
    return one <= other ? before : corner;
}

static int after(const cairn_outline *polygon, int edge) { return edge + 1 < polygon->count ? edge + 1 : 0; }

/* A vector as an edge sees it that has this normal. */
CAIRN_ONCE void see_by_edge(const cairn_offset2 *v, const cairn_unit2 *n, cairn_edge_point *out)
{
    out->along = cairn_offset_dot(v->x, v->y, -n->y, n->x);
    out->separation = cairn_offset_dot(v->x, v->y, n->x, n->y);
}

/* What separates the two most. */
typedef struct reference {
    axis face;
    cairn_relative at; /* the other one in the frame of the polygon whose face it is */
} reference;

/* False if they are farther apart than the margin. */
CAIRN_APART bool find_reference(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, reference *out, cairn_offset *steady)
{
    cairn_room room[1 + CAIRN_BOXES_ARE_POLYGONS]; /* for what is a box */
    cairn_outline of_a, of_b;
    counterpart from;
    cairn_shape_outline(a->shape, room[0].corner, &of_a);
    cairn_shape_outline(b->shape, room[CAIRN_BOXES_ARE_POLYGONS].corner, &of_b);
    out->at = cairn_pose_seen_from(a, b);
    out->face.separation = -CAIRN_OFFSET(256); /* less than any two overlap by, and so much more than -512 m that no sum wraps */
    out->face.of_b = false;
    from.outline = &of_b;
    from.at = &out->at;
    cairn_offset others = find_face(&of_a, &from, margin, &out->face);
    if (out->face.separation > margin) {
        return false;
    }
    axis face;
    cairn_relative at;
    cairn_relative_turn_round(&out->at, a, b, &at);
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
    const cairn_unit2 *n = &outline.normal[by->face.edge];
    cairn_clip_edge edge;
    cairn_edge_point point, ends[2];
    see_by_edge(&outline.vertex[by->face.edge], n, &point);
    edge.height = point.separation;
    edge.low = point.along;
    see_by_edge(&outline.vertex[after(&outline, by->face.edge)], n, &point);
    edge.high = point.along;
    see_by_edge(&by->at.centre, n, &point);
    edge.n = cairn_unit2_turned(*n, own->c, own->s);
    edge.centre.x = own->x - a->x;
    edge.centre.y = own->y - a->y;
    edge.edge = by->face.edge;
    edge.swapped = by->face.of_b;

    cairn_shape_outline(against->shape, room.corner, &outline);
    edge.incident = incident_edge(&outline, by->face.corner, by->face.normal);
    for (int i = 0, corner = edge.incident; i < 2; i++, corner = after(&outline, corner)) {
        see_by_edge(&outline.vertex[corner], &by->face.normal, &ends[i]);
        ends[i].along += point.along;
        ends[i].separation += point.separation;
    }
    cairn_clip(&edge, ends, margin, out);
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
