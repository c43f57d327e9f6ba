/* The convex polygon: its class, and the measures of its kind. Making one is polygon_init.c's. */
#include "engine.h"

static cairn_status check(const cairn_shape *shape)
{
    const cairn_polygon *polygon = shape->polygon;
    return polygon != NULL && polygon->count >= 3 && polygon->count <= CAIRN_MAX_VERTICES ? CAIRN_OK : CAIRN_ERROR_SHAPE;
}

const cairn_shape_class cairn_polygon_class = {
    2, check, cairn_outline_extents,
    { cairn_collide_circle_polygon CAIRN_AND_OF_TWO(cairn_collide_polygons) CAIRN_AND_OF_TWO(cairn_collide_polygons) }
};
