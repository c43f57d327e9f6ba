/* Lines from pixel to pixel. A clipped line has the same pixels as the part of the whole line. */
#ifndef DRAW_LINE_H
#define DRAW_LINE_H

#include "canvas.h"

enum { DRAW_SOLID = 0xFF, DRAW_DASHED = 0xF0, DRAW_DOTTED = 0x11, DRAW_SPARSE = 0x01 };

/* Ends included. Coordinates beyond 8192 are taken as 8192. pattern: which of 8 pixels are set, from bit 0. */
void draw_line(draw_canvas *canvas, int32_t x0, int32_t y0, int32_t x1, int32_t y1, int shade, unsigned pattern);

#endif
