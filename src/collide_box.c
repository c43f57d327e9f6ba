/*
 * The narrow phase of two boxes, the polygons that games have most of: what collide_polygon.c finds, to the same bits, with half sizes instead of
 * corners. All is done in the frame of the box whose face is the reference, where faces are parallel to the axes and clipping needs no product but one.
 */
#include "collide_clip.h"

/* One of the two boxes. */
typedef struct side {
    cairn_offset2 half;   /* half its size */
    cairn_relative other; /* the other one in its frame */
    bool along_y;         /* which of its axes separates them most */
} side;

static cairn_offset magnitude(cairn_offset x) { return x < 0 ? -x : x; }

static inline cairn_offset2 half_size_of(const cairn_shape *shape)
{
    cairn_offset2 half;
    half.x = cairn_offset_half(cairn_offset_from_real(shape->size.x));
    half.y = cairn_offset_half(cairn_offset_from_real(shape->size.y));
    return half;
}

/* How far a box's own two axes separate it from the other one, and which of them does most: of two faces that do so alike the first. */
CAIRN_INLINE cairn_offset separation_of(side *own, cairn_offset2 other)
{
    const cairn_relative *r = &own->other;
    cairn_unit c = magnitude(r->c), s = magnitude(r->s);
    cairn_offset x = magnitude(r->centre.x) - own->half.x + cairn_offset_dot(-other.x, -other.y, c, s);
    cairn_offset y = magnitude(r->centre.y) - own->half.y + cairn_offset_dot(-other.x, -other.y, s, c);
    own->along_y = y > x || (y == x && r->centre.x < 0 && r->centre.y >= 0);
    return y > x ? y : x;
}

/*
 * The face with normal `axis` (0: +x, 1: +y, 2: -x, 3: -y, as in the outline of a box) of the reference, and the face
 * of the other box that looks against it, the one before the corner of two that do so alike. The rotation is turned until the reference face looks along +x.
 */
static int incident_face(const cairn_relative *r, cairn_offset2 other, int axis, cairn_edge_point ends[2])
{
    cairn_offset x = axis == 0 ? r->centre.x : axis == 1 ? r->centre.y : axis == 2 ? -r->centre.x : -r->centre.y;
    cairn_offset y = axis == 0 ? r->centre.y : axis == 1 ? -r->centre.x : axis == 2 ? -r->centre.y : r->centre.x;
    cairn_unit c = axis == 0 ? r->c : axis == 1 ? r->s : axis == 2 ? -r->c : -r->s;
    cairn_unit s = axis == 0 ? r->s : axis == 1 ? -r->c : axis == 2 ? -r->s : r->c;
    bool by_x = magnitude(c) > magnitude(s) || (magnitude(c) == magnitude(s) && (c < 0) == (s > 0));
    int face = by_x ? (c < 0 ? 0 : 2) : s > 0 ? 1 : 3; /* normals: (c, s), (-s, c), (-c, -s), (s, -c) */
    /* The face's own normal and the way along it, counter-clockwise. */
    cairn_unit nx = face == 0 ? c : face == 1 ? -s : face == 2 ? -c : s;
    cairn_unit ny = face == 0 ? s : face == 1 ? c : face == 2 ? -s : -c;
    cairn_offset depth = by_x ? other.x : other.y, width = by_x ? other.y : other.x;
    ends[0].separation = x + cairn_offset_dot(depth, width, nx, ny);
    ends[0].along = y + cairn_offset_dot(depth, -width, ny, nx);
    ends[1].separation = x + cairn_offset_dot(depth, -width, nx, ny);
    ends[1].along = y + cairn_offset_dot(depth, width, ny, nx);
    return face;
}

/* Clip the incident face against the ends of the reference face. */
static void clip(const cairn_pose *a, const cairn_pose *reference, const side *own, cairn_offset2 other, cairn_offset margin, cairn_manifold *out)
{
    const cairn_relative *r = &own->other;
    int axis = own->along_y ? (r->centre.y >= 0 ? 1 : 3) : r->centre.x >= 0 ? 0 : 2;
    cairn_unit c = reference->c, s = reference->s;
    cairn_edge_point ends[2];
    cairn_clip_edge by;
    by.centre.x = reference->x - a->x;
    by.centre.y = reference->y - a->y;
    by.height = own->along_y ? own->half.y : own->half.x;
    by.high = own->along_y ? own->half.x : own->half.y;
    by.low = -by.high;
    by.n.x = axis == 0 ? c : axis == 1 ? -s : axis == 2 ? -c : s;
    by.n.y = axis == 0 ? s : axis == 1 ? c : axis == 2 ? -s : -c;
    by.edge = axis;
    by.swapped = reference != a;
    by.incident = incident_face(r, other, axis, ends);
    cairn_clip(&by, ends, margin, out);
}

void cairn_collide_boxes(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out)
{
    side of[2];
    out->count = 0;
    of[0].half = half_size_of(a->shape);
    of[1].half = half_size_of(b->shape);
    of[0].other = cairn_pose_seen_from(a, b);
    cairn_offset from_a = separation_of(&of[0], of[1].half);
    if (from_a > margin) {
        return;
    }
    cairn_relative_turn_round(&of[0].other, a, b, &of[1].other);
    cairn_offset from_b = separation_of(&of[1], of[0].half);
    if (from_b > margin) {
        return;
    }
    bool swapped = from_b > from_a + CAIRN_FACE_PREFERENCE;
    out->separation = from_a > from_b ? from_a : from_b;
    out->steady = 0;
    clip(a, swapped ? b : a, &of[swapped], of[!swapped].half, margin, out);
}
