/* Where the world lies on the picture: a camera at a place of the world, so many pixels a metre. Fixed point only. */
#ifndef DRAW_VIEW_H
#define DRAW_VIEW_H

#include "fill.h"

#include <cairn/arith.h>

typedef struct draw_view {
    cairn_vec2 center;      /* of the world, shown at (x, y) of the picture */
    int x, y;               /* pixels */
    int scale;              /* pixels a metre, 1 to 64 */
} draw_view;

static inline int32_t draw_view_length(const draw_view *view, cairn_real length)
{
    /* at most 2^27 * 2^6 / 2^12 */
    return (int32_t)(((int64_t)length * view->scale) >> 12);
}

static inline draw_point draw_view_point(const draw_view *view, cairn_vec2 p)
{
    draw_point out;
    out.x = view->x * DRAW_SUB + draw_view_length(view, cairn_real_sub(p.x, view->center.x));
    out.y = view->y * DRAW_SUB - draw_view_length(view, cairn_real_sub(p.y, view->center.y));
    return out;
}

#endif
