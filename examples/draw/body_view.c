/* See body_view.h. */
#include "body_view.h"

enum { CORNERS = 4 };

void draw_box_corners(const draw_view *view, cairn_world *world, cairn_body_id body, draw_point corners[4])
{
    static const int8_t signs[CORNERS][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const cairn_vec2 size = cairn_body_shape(world, body)->size;
    for (int i = 0; i < CORNERS; i++) {
        const cairn_vec2 corner = cairn_vec2_of(size.x / 2 * signs[i][0], size.y / 2 * signs[i][1]);
        corners[i] = draw_view_point(view, cairn_body_to_world(world, body, corner));
    }
}

void draw_box_body(draw_canvas *canvas, const draw_view *view, cairn_world *world, cairn_body_id body, int rim, draw_shades shades)
{
    draw_point corners[CORNERS];
    draw_box_corners(view, world, body, corners);
    draw_rimmed(canvas, corners, CORNERS, rim, shades);
}
