/* The circle: its measures and its contact with another circle. */
#include "engine.h"

static cairn_status check(const cairn_shape *shape)
{
    return shape->size.x >= CAIRN_SHAPE_RADIUS_MIN && shape->size.x <= CAIRN_SHAPE_RADIUS_MAX ? CAIRN_OK : CAIRN_ERROR_SHAPE;
}

static cairn_wide_word square(const cairn_shape *shape)
{
    cairn_wide r = cairn_wide_from_real(shape->size.x);
    return cairn_wide_to_word(cairn_wide_mul(r, r));
}

static cairn_wide_word area(const cairn_shape *shape)
{
    return cairn_wide_to_word(cairn_wide_mul(cairn_wide_from_word(square(shape)), CAIRN_WIDE_PI));
}

/* gyration^2 = r^2 / 2 */
static cairn_wide_word gyration(const cairn_shape *shape)
{
    return cairn_wide_to_word(cairn_wide_sqrt(cairn_wide_div(cairn_wide_from_word(square(shape)), cairn_wide_from_int(2))));
}

static cairn_real inradius(const cairn_shape *shape) { return shape->size.x; }

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
    if (x > reach || -x > reach || y > reach || -y > reach) {
        return;
    }
    cairn_offset distance = cairn_unit_along(x, y, &out->normal_x, &out->normal_y);
    if (distance > reach) {
        return;
    }
    cairn_manifold_point *point = &out->points[0];
    point->separation = out->separation = distance - ra - rb;
    cairn_offset middle = ra + cairn_offset_half(point->separation);
    point->x = cairn_offset_mul(middle, out->normal_x);
    point->y = cairn_offset_mul(middle, out->normal_y);
    point->feature = 0;
    out->steady = 0;
    out->count = 1;
}

const cairn_shape_class cairn_circle_class = { 0, check, area, gyration, inradius, extents, NULL, { cairn_collide_circles, NULL, NULL } };
