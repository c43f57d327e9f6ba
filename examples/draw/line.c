/* See line.h. One axis is walked pixel by pixel, the other follows by an exact remainder (Bresenham, 1965). */
#include "line.h"

enum { COORDINATE_LIMIT = 1 << 13 }; /* so that all of it fits into 32 bits: 64-bit division alone is 1 KB of flash */

static int32_t limited(int32_t x)
{
    return x > COORDINATE_LIMIT ? COORDINATE_LIMIT : x < -COORDINATE_LIMIT ? -COORDINATE_LIMIT : x;
}

static void swap(int32_t *a, int32_t *b)
{
    const int32_t kept = *a;
    *a = *b;
    *b = kept;
}

/* The line's second coordinate at a place along the first, and the remainder of it, in units of 1 / (2 * length). */
static int32_t start_at(int32_t along, int32_t way, int32_t length, int32_t *remainder)
{
    const int32_t doubled = 2 * length, numerator = 2 * along * way + length; /* below 2^30 */
    *remainder = numerator % doubled;
    return numerator / doubled;
}

void draw_line(draw_canvas *canvas, int32_t x0, int32_t y0, int32_t x1, int32_t y1, int shade, unsigned pattern)
{
    int32_t a0 = limited(x0), b0 = limited(y0), a1 = limited(x1), b1 = limited(y1);
    const bool is_steep = (b1 > b0 ? b1 - b0 : b0 - b1) > (a1 > a0 ? a1 - a0 : a0 - a1);
    if (is_steep) {
        swap(&a0, &b0);
        swap(&a1, &b1);
    }
    if (a0 > a1) {
        swap(&a0, &a1);
        swap(&b0, &b1);
    }
    const int32_t low = is_steep ? canvas->top : canvas->left, high = is_steep ? canvas->bottom : canvas->right;
    int32_t a = a0 < low ? low : a0;
    const int32_t end = a1 < high ? a1 + 1 : high;
    if (a >= end)
        return;
    const int32_t length = a1 - a0 > 0 ? a1 - a0 : 1, way = b1 - b0;
    const int32_t size = way < 0 ? -way : way, step = way < 0 ? -1 : 1;
    int32_t remainder;
    int32_t b = b0 + step * start_at(a - a0, size, length, &remainder);
    for (; a < end; a++) {
        if ((pattern >> ((unsigned)a & 7u) & 1u) != 0)
            draw_pixel(canvas, is_steep ? b : a, is_steep ? a : b, shade);
        if (remainder >= 2 * (length - size)) {
            remainder -= 2 * (length - size);
            b += step;
        } else {
            remainder += 2 * size;
        }
    }
}
