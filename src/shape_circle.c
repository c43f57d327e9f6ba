/* The circle: its measures and its contact with another circle. */
#include "engine.h"

static cairn_status check(const cairn_shape *shape)
{
    return shape->size.x >= CAIRN_SHAPE_RADIUS_MIN && shape->size.x <= CAIRN_CIRCLE_RADIUS_MAX ? CAIRN_OK : CAIRN_ERROR_SHAPE;
}

static void extents(const cairn_shape *shape, cairn_unit c, cairn_unit s, cairn_real *x, cairn_real *y)
{
    (void)c;
    (void)s;
    *x = *y = shape->size.x;
}

void cairn_collide_circles(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out)
{
    cairn_offset ra = cairn_offset_from_real(a->shape->size.x), rb = cairn_offset_from_real(b->shape->size.x);
    cairn_offset reach = ra + rb + margin, x = b->x - a->x, y = b->y - a->y;
    out->count = 0;
    out->separation = margin;
    if (CAIRN_WITH_SHORTCUTS && (x > reach || -x > reach || y > reach || -y > reach)) {
        return;
    }
    cairn_unit2 n;
    cairn_offset distance = cairn_unit_along(x, y, &n.x, &n.y);
    if (distance <= reach) {
        cairn_circle_touch(ra, distance - ra - rb, n, 0, 0, out);
    }
}

const cairn_shape_class cairn_circle_class = { 0, check, CAIRN_HAS_EXTENTS ? extents : NULL, { cairn_collide_circles } };
