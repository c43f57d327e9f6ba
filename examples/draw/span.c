/* See span.h. */
#include "span.h"

bool spans_begin(draw_spans *spans, const draw_canvas *canvas, int32_t top, int32_t bottom)
{
    const int32_t first = span_line(top), end = span_line(bottom);
    spans->first = first > canvas->top * SPAN_LINES ? first : canvas->top * SPAN_LINES;
    spans->end = end < canvas->bottom * SPAN_LINES ? end : canvas->bottom * SPAN_LINES;
    for (int line = spans->first; line < spans->end; line++) {
        spans->low[line] = INT16_MAX;
        spans->high[line] = INT16_MIN;
    }
    return spans->first < spans->end;
}

/* How much of a pixel the spans of its row cover. */
static int cover_of(const int16_t *low, const int16_t *high, int count, int x)
{
    const int left = x * DRAW_SUB, right = left + DRAW_SUB;
    int cover = 0;
    for (int i = 0; i < count; i++) {
        const int from = low[i] > left ? low[i] : left, to = high[i] < right ? high[i] : right;
        if (to > from)
            cover += to - from;
    }
    return cover;
}

static void blend_from(draw_canvas *canvas, int x, int end, int y, const int16_t *low, const int16_t *high, int count, int shade)
{
    for (; x < end; x++)
        draw_blend(canvas, x, y, shade, cover_of(low, high, count, x));
}

/* One row: soft pixels, those that are covered by all of its lines, soft pixels. */
static void draw_spans_row(draw_canvas *canvas, int y, const int16_t *low, const int16_t *high, int count, int shade)
{
    int left = INT16_MAX, right = 0, inner_left = 0, inner_right = count < SPAN_LINES ? 0 : INT16_MAX;
    for (int i = 0; i < count; i++) {
        if (low[i] >= high[i]) {
            inner_right = 0;
            continue;
        }
        if (low[i] < left)
            left = low[i];
        if (high[i] > right)
            right = high[i];
        if (low[i] > inner_left)
            inner_left = low[i];
        if (high[i] < inner_right)
            inner_right = high[i];
    }
    if (left >= right)
        return;
    int x = left / DRAW_SUB, full = (inner_left + DRAW_SUB - 1) / DRAW_SUB;
    const int end = (right + DRAW_SUB - 1) / DRAW_SUB, full_end = inner_right / DRAW_SUB;
    if (full < full_end) {
        blend_from(canvas, x, full, y, low, high, count, shade);
        draw_row(canvas, full, full_end, y, shade);
        x = full_end;
    }
    blend_from(canvas, x, end, y, low, high, count, shade);
}

void spans_draw(const draw_spans *spans, draw_canvas *canvas, int32_t top, int32_t bottom, draw_shades shades)
{
    const int32_t first = top >> 4, rows = (bottom >> 4) - first > 0 ? (bottom >> 4) - first : 1;
    for (int y = spans->first / SPAN_LINES; y * SPAN_LINES < spans->end; y++) {
        const int begin = y * SPAN_LINES > spans->first ? y * SPAN_LINES : spans->first;
        const int end = (y + 1) * SPAN_LINES < spans->end ? (y + 1) * SPAN_LINES : spans->end;
        int shade = shades.top;
        if (shades.top != shades.bottom)
            shade += (shades.bottom - shades.top) * (y - first) / rows;
        draw_spans_row(canvas, y, &spans->low[begin], &spans->high[begin], end - begin, shade);
    }
}
