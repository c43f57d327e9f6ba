/*
 * Filled convex polygons and discs with soft edges: four lines a pixel row, each from an edge to an edge in sixteenths of
 * a pixel; a pixel at the edge takes the share that is covered. Coordinates are sixteenths of a pixel; (8, 8) is the middle of the first one.
 */
#ifndef DRAW_FILL_H
#define DRAW_FILL_H

#include "canvas.h"

#define DRAW_SUB 16 /* parts of a pixel */

typedef struct draw_point {
    int32_t x, y;
} draw_point;

/* From the shade at the top of a shape to that at its bottom. */
typedef struct draw_shades {
    int top, bottom;
} draw_shades;

static inline draw_shades draw_shade(int shade)
{
    const draw_shades shades = {shade, shade};
    return shades;
}

/* A convex polygon's inside, corners in any direction. Coordinates beyond 2047 pixels are taken as 2047. */
void draw_convex(draw_canvas *canvas, const draw_point *corners, int count, draw_shades shades);
/* Its outline, one pixel wide. */
void draw_outline(draw_canvas *canvas, const draw_point *corners, int count, int shade);
/* Both: its inside, and over its edge the outline in the shade `rim`. */
void draw_rimmed(draw_canvas *canvas, const draw_point *corners, int count, int rim, draw_shades shades);

void draw_disc(draw_canvas *canvas, draw_point center, int32_t radius, draw_shades shades);
/* A circle's outline, one pixel wide. */
void draw_ring(draw_canvas *canvas, draw_point center, int32_t radius, int shade);
/* A line from the centre to the rim: which way the circle has turned. `axis` is a vector of length 2^14 at most. */
void draw_mark(draw_canvas *canvas, draw_point center, int32_t radius, draw_point axis, int shade);

#endif
