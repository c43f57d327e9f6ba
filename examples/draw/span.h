/* The insides of shapes as spans: from where to where a shape reaches on each quarter of a pixel row. */
#ifndef DRAW_SPAN_H
#define DRAW_SPAN_H

#include "fill.h"

enum {
    SPAN_LINES = 4,                       /* a pixel row */
    SPAN_STEP = DRAW_SUB / SPAN_LINES,    /* sixteenths from one to the next */
    SPAN_FIRST = SPAN_STEP / 2,           /* where the first one lies in its row */
    SPAN_COUNT = DRAW_HEIGHT * SPAN_LINES
};

/* Lines first to end of the frame; empty where low >= high. */
typedef struct draw_spans {
    int first, end;
    int16_t low[SPAN_COUNT], high[SPAN_COUNT];
} draw_spans;

/* The first line at or below y. */
static inline int32_t span_line(int32_t y) { return (y - SPAN_FIRST + SPAN_STEP - 1) >> 2; }

/* Begin a shape that reaches from y = top to bottom: false if no line of the clip is in it. */
bool spans_begin(draw_spans *spans, const draw_canvas *canvas, int32_t top, int32_t bottom);
/* Draw what was found: from the shade at the shape's top to that at its bottom. */
void spans_draw(const draw_spans *spans, draw_canvas *canvas, int32_t top, int32_t bottom, draw_shades shades);

#endif
