/* A body of the world on a canvas, by its shape and where it is now. */
#ifndef DRAW_BODY_VIEW_H
#define DRAW_BODY_VIEW_H

#include "view.h"

#include <cairn/world.h>

/* Where the corners of a body's box are on the picture: lower left, lower right, upper right, upper left of the box. */
void draw_box_corners(const draw_view *view, cairn_world *world, cairn_body_id body, draw_point corners[4]);
/* A body whose shape is a box, with a rim. */
void draw_box_body(draw_canvas *canvas, const draw_view *view, cairn_world *world, cairn_body_id body, int rim, draw_shades shades);

#endif
