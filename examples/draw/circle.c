/* Discs and rings, see fill.h. */
#include "line.h"
#include "span.h"

enum { COORDINATE_LIMIT = 1 << 26, WALKED = 1 << 12, AXIS_ONE = 1 << 14 };

static int32_t limited(int32_t x)
{
    return x > COORDINATE_LIMIT ? COORDINATE_LIMIT : x < -COORDINATE_LIMIT ? -COORDINATE_LIMIT : x;
}

/* The integer square root, bit by bit; x < 2^56. */
static int32_t root(int64_t x)
{
    int64_t result = 0;
    for (int bit = 27; bit >= 0; bit--) {
        const int64_t next = result + ((int64_t)1 << bit);
        if (next * next <= x)
            result = next;
    }
    return (int32_t)result;
}

/* Half the width of a circle at a height from its centre. From line to line of a small one it changes by little: `last` is walked on. */
static int32_t half_width(int32_t radius, int32_t height, int32_t last)
{
    const int64_t square = (int64_t)radius * radius - (int64_t)height * height;
    if (square <= 0)
        return 0;
    if (radius > WALKED || last < 0)
        return root(square);
    const int32_t small = (int32_t)square; /* below 2^24 */
    while ((last + 1) * (last + 1) <= small)
        last++;
    while (last * last > small)
        last--;
    return last;
}

static int16_t within(int32_t x, int32_t left, int32_t right) { return (int16_t)(x < left ? left : x > right ? right : x); }

void draw_disc(draw_canvas *canvas, draw_point center, int32_t radius, draw_shades shades)
{
    draw_spans spans;
    const int32_t x = limited(center.x), y = limited(center.y), size = limited(radius);
    if (size <= 0 || !spans_begin(&spans, canvas, y - size, y + size))
        return;
    int32_t half = -1;
    for (int line = spans.first; line < spans.end; line++) {
        half = half_width(size, line * SPAN_STEP + SPAN_FIRST - y, half);
        spans.low[line] = within(x - half, canvas->left * DRAW_SUB, canvas->right * DRAW_SUB);
        spans.high[line] = within(x + half, canvas->left * DRAW_SUB, canvas->right * DRAW_SUB);
    }
    spans_draw(&spans, canvas, y - size, y + size, shades);
}

/* Each row's two arcs, from its own width to the row's above, or to the middle of the circle at its ends. */
void draw_ring(draw_canvas *canvas, draw_point center, int32_t radius, int shade)
{
    const int32_t x = limited(center.x) >> 4, y = limited(center.y) >> 4, size = limited(radius) >> 4;
    if (size <= 0) {
        draw_pixel(canvas, x, y, shade);
        return;
    }
    const int32_t first = y - size > canvas->top ? y - size : canvas->top;
    const int32_t last = y + size < canvas->bottom - 1 ? y + size : canvas->bottom - 1;
    for (int32_t row = first; row <= last; row++) {
        const int32_t height = row < y ? y - row : row - y;
        const int32_t outer = root((int64_t)size * size + size - (int64_t)height * height);
        const int64_t above = (int64_t)size * size + size - (int64_t)(height + 1) * (height + 1);
        int32_t inner = above < 0 ? 0 : root(above) + 1;
        inner = inner > outer ? outer : inner;
        draw_row(canvas, x - outer, x - inner + 1, row, shade);
        draw_row(canvas, x + inner, x + outer + 1, row, shade);
    }
}

void draw_mark(draw_canvas *canvas, draw_point center, int32_t radius, draw_point axis, int shade)
{
    const int32_t size = radius < AXIS_ONE ? radius : AXIS_ONE; /* a longer mark leaves the frame as well */
    const int32_t way_x = (int32_t)((int64_t)size * axis.x / AXIS_ONE), way_y = (int32_t)((int64_t)size * axis.y / AXIS_ONE);
    const int32_t x = limited(center.x), y = limited(center.y);
    draw_line(canvas, x >> 4, y >> 4, (x + way_x) >> 4, (y + way_y) >> 4, shade, DRAW_SOLID);
}
