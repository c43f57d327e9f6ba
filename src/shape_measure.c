/* How much of a shape there is: its area and radius of gyration. They serve where a body is made and where its mass is asked for. */
#include "engine.h"

static bool is_circle(const cairn_shape *shape) { return shape->kind->outline == NULL; }

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
    if (is_circle(shape)) {
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
    bool circle = is_circle(shape);
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
