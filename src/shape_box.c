/* The box: a polygon that is told by two numbers. */
#include "engine.h"

static cairn_status check(const cairn_shape *shape)
{
    cairn_real w = shape->size.x, h = shape->size.y;
    if (w < CAIRN_SHAPE_RADIUS_MIN || h < CAIRN_SHAPE_RADIUS_MIN || w > 2 * CAIRN_SHAPE_RADIUS_MAX || h > 2 * CAIRN_SHAPE_RADIUS_MAX) {
        return CAIRN_ERROR_SHAPE;
    }
    return cairn_real_length(w, h) <= 2 * CAIRN_SHAPE_RADIUS_MAX ? CAIRN_OK : CAIRN_ERROR_SHAPE;
}

static cairn_wide area(const cairn_shape *shape)
{
    return cairn_wide_mul(cairn_wide_from_real(shape->size.x), cairn_wide_from_real(shape->size.y));
}

/* gyration^2 = (w^2 + h^2) / 12 */
static cairn_wide gyration(const cairn_shape *shape)
{
    cairn_wide w = cairn_wide_from_real(shape->size.x), h = cairn_wide_from_real(shape->size.y);
    return cairn_wide_sqrt(cairn_wide_div(cairn_wide_add(cairn_wide_mul(w, w), cairn_wide_mul(h, h)), cairn_wide_from_int(12)));
}

static cairn_real inradius(const cairn_shape *shape)
{
    return cairn_real_half(shape->size.x < shape->size.y ? shape->size.x : shape->size.y);
}

static cairn_offset magnitude(cairn_offset x) { return x < 0 ? -x : x; }

static void extents(const cairn_shape *shape, cairn_unit c, cairn_unit s, cairn_real *x, cairn_real *y)
{
    cairn_offset w = cairn_offset_half(cairn_offset_from_real(shape->size.x));
    cairn_offset h = cairn_offset_half(cairn_offset_from_real(shape->size.y));
    c = magnitude(c);
    s = magnitude(s);
    *x = cairn_real_above_offset(cairn_offset_dot(w, h, c, s));
    *y = cairn_real_above_offset(cairn_offset_dot(w, h, s, c));
}

static void outline(const cairn_shape *shape, cairn_unit c, cairn_unit s, cairn_hull *hull)
{
    cairn_offset w = cairn_offset_half(cairn_offset_from_real(shape->size.x));
    cairn_offset h = cairn_offset_half(cairn_offset_from_real(shape->size.y));
    cairn_offset wx = cairn_offset_mul(w, c), wy = cairn_offset_mul(w, s); /* half the width, rotated */
    cairn_offset hx = -cairn_offset_mul(h, s), hy = cairn_offset_mul(h, c);
    hull->count = 4;
    hull->vertex[0].x = wx - hx;
    hull->vertex[0].y = wy - hy;
    hull->vertex[1].x = wx + hx;
    hull->vertex[1].y = wy + hy;
    hull->vertex[2].x = -hull->vertex[0].x;
    hull->vertex[2].y = -hull->vertex[0].y;
    hull->vertex[3].x = -hull->vertex[1].x;
    hull->vertex[3].y = -hull->vertex[1].y;
    hull->normal[0].x = c;
    hull->normal[0].y = s;
    hull->normal[1].x = -s;
    hull->normal[1].y = c;
    hull->normal[2].x = -c;
    hull->normal[2].y = -s;
    hull->normal[3].x = s;
    hull->normal[3].y = -c;
}

const cairn_shape_class cairn_box_class = {
    1, check, area, gyration, inradius, extents, outline, { cairn_collide_circle_polygon, cairn_collide_boxes, NULL }
};
