/* The convex polygon: its class, and the measures of its kind. Making one is polygon_init.c's. */
#include "engine.h"

static cairn_status check(const cairn_shape *shape)
{
    const cairn_polygon *polygon = shape->polygon;
    return polygon != NULL && polygon->count >= 3 && polygon->count <= CAIRN_MAX_VERTICES ? CAIRN_OK : CAIRN_ERROR_SHAPE;
}

static void extents(const cairn_shape *shape, cairn_unit c, cairn_unit s, cairn_real *x, cairn_real *y)
{
    const cairn_polygon *polygon = shape->polygon;
    cairn_offset far_x = 0, far_y = 0;
    for (int i = 0; i < polygon->count; i++) {
        cairn_offset vx = cairn_offset_dot(polygon->vertex[i].x, -polygon->vertex[i].y, c, s);
        cairn_offset vy = cairn_offset_dot(polygon->vertex[i].x, polygon->vertex[i].y, s, c);
        vx = vx < 0 ? -vx : vx;
        vy = vy < 0 ? -vy : vy;
        far_x = vx > far_x ? vx : far_x;
        far_y = vy > far_y ? vy : far_y;
    }
    *x = cairn_real_above_offset(far_x);
    *y = cairn_real_above_offset(far_y);
}

const cairn_shape_class cairn_polygon_class = {
    2, check, extents,
    { cairn_collide_circle_polygon CAIRN_AND_OF_TWO(cairn_collide_polygons) CAIRN_AND_OF_TWO(cairn_collide_polygons) }
};
