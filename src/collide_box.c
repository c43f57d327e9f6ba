/*
 * The narrow phase of two boxes, the polygons that games have most of: the same test and the same clipping as in
 * collide_polygon.c, with half sizes instead of corners. All is done in the frame of the box whose face is the
 * reference, where faces are parallel to the axes and clipping needs no product but one.
 */
#include "collide_clip.h"

typedef struct half_size {
    cairn_offset x, y;
} half_size;

static cairn_offset magnitude(cairn_offset x) { return x < 0 ? -x : x; }

static half_size half_size_of(const cairn_shape *shape)
{
    half_size half;
    half.x = cairn_offset_half(cairn_offset_from_real(shape->size.x));
    half.y = cairn_offset_half(cairn_offset_from_real(shape->size.y));
    return half;
}

/* The first box as it is seen from the other one. */
static cairn_relative seen_back(const cairn_relative *r)
{
    cairn_relative back;
    back.x = -cairn_offset_dot(r->x, r->y, r->c, r->s);
    back.y = -cairn_offset_dot(r->x, r->y, -r->s, r->c);
    back.c = r->c;
    back.s = -r->s;
    return back;
}

/* How far a box's own two axes separate it from the other, and which of them does most. */
static cairn_offset separation_of(half_size own, half_size other, const cairn_relative *r, bool *along_y)
{
    cairn_unit c = magnitude(r->c), s = magnitude(r->s);
    cairn_offset x = magnitude(r->x) - own.x - cairn_offset_dot(other.x, other.y, c, s);
    cairn_offset y = magnitude(r->y) - own.y - cairn_offset_dot(other.x, other.y, s, c);
    *along_y = y > x;
    return y > x ? y : x;
}

/*
 * The face with normal `axis` (0: +x, 1: +y, 2: -x, 3: -y, as in the outline of a box) of the reference, and the face
 * of the other box that looks against it. The rotation is turned until the reference face looks along +x.
 */
static int incident_face(const cairn_relative *r, half_size other, int axis, cairn_edge_point ends[2])
{
    cairn_offset x = axis == 0 ? r->x : axis == 1 ? r->y : axis == 2 ? -r->x : -r->y;
    cairn_offset y = axis == 0 ? r->y : axis == 1 ? -r->x : axis == 2 ? -r->y : r->x;
    cairn_unit c = axis == 0 ? r->c : axis == 1 ? r->s : axis == 2 ? -r->c : -r->s;
    cairn_unit s = axis == 0 ? r->s : axis == 1 ? -r->c : axis == 2 ? -r->s : r->c;
    bool by_x = magnitude(c) > magnitude(s);
    int face = by_x ? (c < 0 ? 0 : 2) : s > 0 ? 1 : 3; /* normals: (c, s), (-s, c), (-c, -s), (s, -c) */
    /* The face's own normal and the way along it, counter-clockwise. */
    cairn_unit nx = face == 0 ? c : face == 1 ? -s : face == 2 ? -c : s;
    cairn_unit ny = face == 0 ? s : face == 1 ? c : face == 2 ? -s : -c;
    cairn_offset depth = by_x ? other.x : other.y, width = by_x ? other.y : other.x;
    cairn_offset middle_x = x + cairn_offset_mul(depth, nx), middle_y = y + cairn_offset_mul(depth, ny);
    cairn_offset way_x = -cairn_offset_mul(width, ny), way_y = cairn_offset_mul(width, nx);
    ends[0].separation = middle_x - way_x;
    ends[0].along = middle_y - way_y;
    ends[1].separation = middle_x + way_x;
    ends[1].along = middle_y + way_y;
    return face;
}

/* Clip the incident face against the ends of the reference face. */
static void clip(const cairn_pose *a, const cairn_pose *reference, half_size own, half_size other, const cairn_relative *r, bool along_y, bool swapped,
                 cairn_offset margin, cairn_manifold *out)
{
    int axis = along_y ? (r->y > 0 ? 1 : 3) : r->x > 0 ? 0 : 2;
    cairn_unit c = reference->c, s = reference->s;
    cairn_edge_point ends[2];
    cairn_clip_edge by;
    by.origin_x = reference->x - a->x;
    by.origin_y = reference->y - a->y;
    by.height = along_y ? own.y : own.x;
    by.high = along_y ? own.x : own.y;
    by.low = -by.high;
    by.x = axis == 0 ? c : axis == 1 ? -s : axis == 2 ? -c : s;
    by.y = axis == 0 ? s : axis == 1 ? c : axis == 2 ? -s : -c;
    by.edge = axis;
    by.swapped = swapped;
    by.incident = incident_face(r, other, axis, ends);
    cairn_clip(&by, ends, margin, out);
}

void cairn_collide_boxes(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out)
{
    half_size half_a = half_size_of(a->shape), half_b = half_size_of(b->shape);
    bool y_a, y_b;
    out->count = 0;
    cairn_relative b_from_a = cairn_pose_seen_from(a, b);
    cairn_offset from_a = separation_of(half_a, half_b, &b_from_a, &y_a);
    if (from_a > margin) {
        return;
    }
    cairn_relative a_from_b = seen_back(&b_from_a);
    cairn_offset from_b = separation_of(half_b, half_a, &a_from_b, &y_b);
    if (from_b > margin) {
        return;
    }
    out->separation = from_a > from_b ? from_a : from_b;
    out->steady = 0;
    if (from_b > from_a + CAIRN_FACE_PREFERENCE) {
        clip(a, b, half_b, half_a, &a_from_b, y_b, true, margin, out);
    } else {
        clip(a, a, half_a, half_b, &b_from_a, y_a, false, margin, out);
    }
}
