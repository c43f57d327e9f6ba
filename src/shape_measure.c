/*
 * What only some games ask of a shape, by its kind and no pointers of a class, so that it is linked only where it is asked for: its area and radius of
 * gyration, where a body is made and where its mass is asked for; how thick it is; and its outline.
 */
#include "engine.h"

static cairn_wide_word square_of(cairn_real x)
{
    cairn_wide w = cairn_wide_from_real(x);
    return cairn_wide_to_word(cairn_wide_mul(w, w));
}

cairn_wide_word cairn_shape_area(const cairn_shape *shape)
{
    cairn_real x = shape->size.x;
    if (CAIRN_WITH_POLYGONS && shape->polygon != NULL) {
        return cairn_wide_to_word(shape->polygon->mass.area);
    }
    if (cairn_shape_is_round(shape)) {
        return cairn_wide_to_word(cairn_wide_mul(cairn_wide_from_word(square_of(x)), CAIRN_WIDE_PI));
    }
    return cairn_wide_to_word(cairn_wide_mul(cairn_wide_from_real(x), cairn_wide_from_real(shape->size.y)));
}

/* Its square is r^2 / 2 of a circle, (w^2 + h^2) / 12 of a box. */
cairn_wide_word cairn_shape_gyration(const cairn_shape *shape)
{
    if (CAIRN_WITH_POLYGONS && shape->polygon != NULL) {
        return cairn_wide_to_word(shape->polygon->mass.gyration);
    }
    bool circle = cairn_shape_is_round(shape);
    cairn_wide square = cairn_wide_from_word(square_of(shape->size.x));
    if (!circle) {
        square = cairn_wide_add(square, cairn_wide_from_word(square_of(shape->size.y)));
    }
    return cairn_wide_to_word(cairn_wide_sqrt(cairn_wide_div(square, cairn_wide_from_int(circle ? 2 : 12))));
}

cairn_status cairn_shape_measure(const cairn_shape *shape, cairn_mass_data *out)
{
    if (shape == NULL || shape->kind == NULL || out == NULL) {
        return CAIRN_ERROR_NULL;
    }
    cairn_status status = shape->kind->check(shape);
    if (status == CAIRN_OK) {
        out->area = cairn_wide_from_word(cairn_shape_area(shape));
        out->gyration = cairn_wide_from_word(cairn_shape_gyration(shape));
    }
    return status;
}

cairn_real cairn_shape_inradius(const cairn_shape *shape)
{
    if (CAIRN_WITH_POLYGONS && shape->polygon != NULL) {
        return cairn_real_from_offset(shape->polygon->inradius);
    }
    return cairn_shape_is_round(shape) ? shape->size.x : cairn_real_half(shape->size.x < shape->size.y ? shape->size.x : shape->size.y);
}

static const cairn_unit2 normals[4] = { { CAIRN_UNIT(1), 0 }, { 0, CAIRN_UNIT(1) }, { -CAIRN_UNIT(1), 0 }, { 0, -CAIRN_UNIT(1) } };

static void outline_of_box(const cairn_shape *shape, cairn_offset2 *room, cairn_outline *out)
{
    cairn_offset w = cairn_offset_half(cairn_offset_from_real(shape->size.x));
    cairn_offset h = cairn_offset_half(cairn_offset_from_real(shape->size.y));
    for (int i = 0; i < 4; i++) { /* from the lower right on */
        room[i].x = i < 2 ? w : -w;
        room[i].y = i == 1 || i == 2 ? h : -h;
    }
    out->count = 4;
    out->inradius = (w < h ? w : h) - CAIRN_OUTLINE_ROUNDING;
    out->vertex = room;
    out->normal = normals;
}

void cairn_shape_outline(const cairn_shape *shape, cairn_offset2 *room, cairn_outline *out)
{
    const cairn_polygon *polygon = shape->polygon;
    if (!CAIRN_WITH_POLYGONS || polygon == NULL) {
        outline_of_box(shape, room, out);
        return;
    }
    out->count = polygon->count;
    out->inradius = polygon->inradius - CAIRN_OUTLINE_ROUNDING;
    out->vertex = polygon->vertex;
    out->normal = polygon->normal;
}

void cairn_outline_extents(const cairn_shape *shape, cairn_unit c, cairn_unit s, cairn_real *x, cairn_real *y)
{
    cairn_room room;
    cairn_outline outline;
    cairn_offset far_x = 0, far_y = 0;
    cairn_shape_outline(shape, room.corner, &outline);
    for (int i = 0; i < outline.count; i++) {
        cairn_offset2 v = cairn_offset2_turned(outline.vertex[i], c, s);
        v.x = v.x < 0 ? -v.x : v.x;
        v.y = v.y < 0 ? -v.y : v.y;
        far_x = v.x > far_x ? v.x : far_x;
        far_y = v.y > far_y ? v.y : far_y;
    }
    *x = cairn_real_above_offset(far_x);
    *y = cairn_real_above_offset(far_y);
}
