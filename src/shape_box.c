/* The box: a polygon that is told by two numbers. */
#include "engine.h"

static cairn_status check(const cairn_shape *shape)
{
    cairn_real w = shape->size.x, h = shape->size.y;
    bool fits = w >= CAIRN_SHAPE_RADIUS_MIN && h >= CAIRN_SHAPE_RADIUS_MIN && cairn_real_is_short(w, h, 2 * CAIRN_SHAPE_RADIUS_MAX);
    return fits ? CAIRN_OK : CAIRN_ERROR_SHAPE;
}

static cairn_offset magnitude(cairn_offset x) { return x < 0 ? -x : x; }

static void extents(const cairn_shape *shape, cairn_unit c, cairn_unit s, cairn_real *x, cairn_real *y)
{
    cairn_offset w = cairn_offset_half(cairn_offset_from_real(shape->size.x));
    cairn_offset h = cairn_offset_half(cairn_offset_from_real(shape->size.y));
    c = magnitude(c);
    s = magnitude(s);
    *x = cairn_real_above_offset(CAIRN_WITH_SLOPES ? cairn_offset_dot(w, h, c, s) : w);
    *y = cairn_real_above_offset(CAIRN_WITH_SLOPES ? cairn_offset_dot(w, h, s, c) : h);
}

const cairn_shape_class cairn_box_class = {
    1, check, CAIRN_BOXES_ARE_POLYGONS ? cairn_outline_extents : CAIRN_HAS_EXTENTS ? extents : NULL,
    { CAIRN_BOXES_ARE_POLYGONS ? cairn_collide_circle_polygon : cairn_collide_circle_box
      CAIRN_AND_OF_TWO(CAIRN_BOXES_ARE_POLYGONS ? cairn_collide_polygons : cairn_collide_boxes) }
};
