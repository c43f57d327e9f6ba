/* Convex polygons, see fill.h. */
#include "line.h"
#include "span.h"

enum {
    COORDINATE_LIMIT = 2047 * DRAW_SUB, /* up to here 32 bits hold an edge's slope and all of its way */
    SLOPE_SHIFT = 14
};

static int32_t limited(int32_t x)
{
    return x > COORDINATE_LIMIT ? COORDINATE_LIMIT : x < -COORDINATE_LIMIT ? -COORDINATE_LIMIT : x;
}

static void widen(draw_spans *spans, int line, int32_t x, int32_t left, int32_t right)
{
    const int16_t place = (int16_t)(x < left ? left : x > right ? right : x);
    if (place < spans->low[line])
        spans->low[line] = place;
    if (place > spans->high[line])
        spans->high[line] = place;
}

/* The spans that one edge ends; a is above b. */
static void add_edge(draw_spans *spans, const draw_canvas *canvas, draw_point a, draw_point b)
{
    int32_t line = span_line(a.y), end = span_line(b.y);
    if (line < spans->first)
        line = spans->first;
    if (end > spans->end)
        end = spans->end;
    if (line >= end)
        return;
    const int32_t left = canvas->left * DRAW_SUB, right = canvas->right * DRAW_SUB;
    const int32_t down = line * SPAN_STEP + SPAN_FIRST - a.y;
    /* |b.x - a.x| < 2^16, and so |slope * down| <= 2^16 * 2^14 */
    const int32_t slope = (b.x - a.x) * (1 << SLOPE_SHIFT) / (b.y - a.y);
    int32_t x = slope * down + (1 << (SLOPE_SHIFT - 1));
    for (; line < end; line++) {
        widen(spans, line, a.x + (x >> SLOPE_SHIFT), left, right);
        x = (int32_t)((uint32_t)x + (uint32_t)slope * SPAN_STEP); /* behind the last line it may wrap */
    }
}

void draw_convex(draw_canvas *canvas, const draw_point *corners, int count, draw_shades shades)
{
    draw_spans spans;
    int32_t top = INT32_MAX, bottom = INT32_MIN;
    for (int i = 0; i < count; i++) {
        const int32_t y = limited(corners[i].y);
        top = y < top ? y : top;
        bottom = y > bottom ? y : bottom;
    }
    if (count < 3 || !spans_begin(&spans, canvas, top, bottom))
        return;
    draw_point a = {limited(corners[count - 1].x), limited(corners[count - 1].y)};
    for (int i = 0; i < count; i++) {
        const draw_point b = {limited(corners[i].x), limited(corners[i].y)};
        if (a.y < b.y)
            add_edge(&spans, canvas, a, b);
        else if (b.y < a.y)
            add_edge(&spans, canvas, b, a);
        a = b;
    }
    spans_draw(&spans, canvas, top, bottom, shades);
}

void draw_outline(draw_canvas *canvas, const draw_point *corners, int count, int shade)
{
    for (int i = 0; i < count; i++) {
        const draw_point a = corners[i], b = corners[i + 1 < count ? i + 1 : 0];
        draw_line(canvas, a.x >> 4, a.y >> 4, b.x >> 4, b.y >> 4, shade, DRAW_SOLID);
    }
}

void draw_rimmed(draw_canvas *canvas, const draw_point *corners, int count, int rim, draw_shades shades)
{
    draw_convex(canvas, corners, count, shades);
    draw_outline(canvas, corners, count, rim);
}
