/*
 * A picture of 128 x 64 pixels in 16 greys, laid out as cairn_port_display() takes it, and the pixels, rows and boxes
 * everything else is made of. Whatever lies outside of the clip is not drawn, at any coordinates.
 */
#ifndef DRAW_CANVAS_H
#define DRAW_CANVAS_H

#include "cairn_port.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    DRAW_WIDTH = CAIRN_PORT_DISPLAY_WIDTH,
    DRAW_HEIGHT = CAIRN_PORT_DISPLAY_HEIGHT,
    DRAW_PITCH = DRAW_WIDTH / 2,
    DRAW_WHITE = 15,
    DRAW_COVERED = 64, /* a pixel that is covered by all of a shape */
    DRAW_DITHER_ALL = 16
};

typedef struct draw_canvas {
    uint8_t pixels[CAIRN_PORT_DISPLAY_BYTES];
    int16_t left, top, right, bottom; /* the clip: what is drawn has left <= x < right and top <= y < bottom */
} draw_canvas;

/* Everything one shade, and the clip open. */
void draw_clear(draw_canvas *canvas, int shade);

/* All of the frame from a shade at the top to one at the bottom, in sixteenths of a shade, dithered; the clip does not count. */
void draw_gradient(draw_canvas *canvas, int top, int bottom);

/* From now on draw only inside of this box (or what of it is in the frame), until draw_unclip(). */
void draw_clip(draw_canvas *canvas, int left, int top, int right, int bottom);
void draw_unclip(draw_canvas *canvas);

/* The shade of a pixel; 0 outside of the frame. */
int draw_get(const draw_canvas *canvas, int x, int y);
void draw_pixel(draw_canvas *canvas, int x, int y, int shade);
/* Mix a shade into a pixel: all of it at DRAW_COVERED, nothing at 0. */
void draw_blend(draw_canvas *canvas, int x, int y, int shade, int cover);

/* The pixels from x to before `end` of a row. */
void draw_row(draw_canvas *canvas, int x, int end, int y, int shade);
void draw_box(draw_canvas *canvas, int x, int y, int width, int height, int shade);
/* A box of a shade in `amount` of 16 pixels, in an even pattern; the others stay. */
void draw_dither(draw_canvas *canvas, int x, int y, int width, int height, int shade, int amount);
/* A box darkened (below 0) or lightened by this many shades. */
void draw_tint(draw_canvas *canvas, int x, int y, int width, int height, int change);

#endif
