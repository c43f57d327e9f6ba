/* See span.h. */
#include "span.h"

#include <string.h>

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

/* What a row needs: by how much the cover changes from pixel to pixel, and from where to where all of its lines cover all. */
typedef struct span_row {
    int16_t change[DRAW_WIDTH + 2];
    int first, end, full, full_end;
} span_row;

/* The cover of a span is a trapezoid of pixels: it rises over two pixels at its left end and falls over two at its right one. */
static void add_span(span_row *row, int low, int high)
{
    const int left = low / DRAW_SUB, right = high / DRAW_SUB, left_part = low % DRAW_SUB, right_part = high % DRAW_SUB;
    row->change[left] = (int16_t)(row->change[left] + DRAW_SUB - left_part);
    row->change[left + 1] = (int16_t)(row->change[left + 1] + left_part);
    row->change[right] = (int16_t)(row->change[right] - DRAW_SUB + right_part);
    row->change[right + 1] = (int16_t)(row->change[right + 1] - right_part);
    row->first = left < row->first ? left : row->first;
    row->end = right + 2 > row->end ? right + 2 : row->end;
    row->full = left + 2 > row->full ? left + 2 : row->full;
    row->full_end = right < row->full_end ? right : row->full_end;
}

static void mix(uint8_t *pair, bool is_right, int shade, int cover)
{
    const int old = is_right ? *pair & 15 : *pair >> 4;
    const int mixed = (old * DRAW_COVERED + (shade - old) * cover + DRAW_COVERED / 2) / DRAW_COVERED;
    *pair = (uint8_t)(is_right ? (*pair & 0xF0) | mixed : (*pair & 0x0F) | mixed << 4);
}

/* One row: soft pixels, those that are covered by all of its lines, soft pixels. Leaves the changes zero again. */
static void draw_spans_row(draw_canvas *canvas, int y, span_row *row, int shade)
{
    uint8_t *pixels = &canvas->pixels[y * DRAW_PITCH];
    int cover = 0;
    for (int x = row->first; x < row->end; x++) {
        if (x == row->full && x < row->full_end) {
            draw_row(canvas, x, row->full_end, y, shade);
            x = row->full_end;
        }
        cover += row->change[x];
        row->change[x] = 0;
        if (cover > 0 && x < DRAW_WIDTH)
            mix(&pixels[x / 2], (x & 1) != 0, shade, cover);
    }
}

void spans_draw(const draw_spans *spans, draw_canvas *canvas, int32_t top, int32_t bottom, draw_shades shades)
{
    const int32_t first = top >> 4, rows = (bottom >> 4) - first > 0 ? (bottom >> 4) - first : 1;
    span_row row;
    memset(row.change, 0, sizeof row.change);
    for (int y = spans->first / SPAN_LINES; y * SPAN_LINES < spans->end; y++) {
        const int begin = y * SPAN_LINES > spans->first ? y * SPAN_LINES : spans->first;
        const int end = (y + 1) * SPAN_LINES < spans->end ? (y + 1) * SPAN_LINES : spans->end;
        row.first = row.full_end = DRAW_WIDTH;
        row.end = row.full = 0;
        for (int line = begin; line < end; line++) {
            if (spans->low[line] < spans->high[line])
                add_span(&row, spans->low[line], spans->high[line]);
            else
                row.full_end = 0;
        }
        if (end - begin < SPAN_LINES)
            row.full_end = 0;
        const int shade = shades.top == shades.bottom ? shades.top : shades.top + (shades.bottom - shades.top) * (y - first) / rows;
        draw_spans_row(canvas, y, &row, shade);
    }
}
