/*
 * The narrow phase of a circle with a box: what collide_circle_polygon.c finds with four corners and normals, to the same bits, for in a box's
 * own frame each of them is a sign of a half size.
 */
#include "engine.h"

/* In that frame, of the nearest corner of a centre that lies by (x, y) outside of the box, in the quarter that the signs tell. */
static cairn_offset to_corner(cairn_offset x, cairn_offset y, bool left, bool below, cairn_unit2 *n)
{
    return cairn_unit_along(left ? x : -x, below ? y : -y, &n->x, &n->y);
}

void cairn_collide_circle_box(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out)
{
    cairn_offset r = cairn_offset_from_real(a->shape->size.x), reach = r + margin, distance, steady = 0;
    cairn_offset2 centre = cairn_offset2_turned_back(a->x - b->x, a->y - b->y, b->c, b->s);
    bool left = centre.x < 0, below = centre.y < 0;
    cairn_offset x = (left ? -centre.x : centre.x) - cairn_offset_half(cairn_offset_from_real(b->shape->size.x));
    cairn_offset y = (below ? -centre.y : centre.y) - cairn_offset_half(cairn_offset_from_real(b->shape->size.y));
    cairn_unit2 n = { 0, 0 };
    int feature;
    out->count = 0;
    if (x > reach || y > reach) {
        return;
    }
    if (x > 0 && y > 0) {
        distance = to_corner(x, y, left, below, &n);
        feature = 16 + (left ? 3 - (below ? 0 : 1) : below ? 0 : 1); /* from the lower right on */
    } else if (y > x || (y == x && left && !below)) { /* the first of two that are as near, from the right side on */
        distance = y;
        steady = -x;
        feature = below ? 3 : 1;
        n.y = below ? CAIRN_UNIT(1) : -CAIRN_UNIT(1);
    } else {
        distance = x;
        steady = -y;
        feature = left ? 2 : 0;
        n.x = left ? CAIRN_UNIT(1) : -CAIRN_UNIT(1);
    }
    if (distance <= reach) {
        steady = !CAIRN_WITH_CONTINUOUS || distance <= 0 ? 0 : distance < steady ? distance : steady;
        cairn_circle_touch(r, distance - r, cairn_unit2_turned(n, b->c, b->s), feature, steady, out);
    }
}
