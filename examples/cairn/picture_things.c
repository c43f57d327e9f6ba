/* Ledges, the balloon and its rope, stones, dust: see picture.h. */
#include "picture.h"

#include "body_view.h"
#include "line.h"
#include "text.h"

enum { BOX_CORNERS = 4, OFF_FRAME = 24 * DRAW_SUB, PLUMB_LENGTH = 40, BALLOON = 82 /* 5 pixels */ };

static bool is_off(draw_point p)
{
    return p.y < -OFF_FRAME || p.y > DRAW_HEIGHT * DRAW_SUB + OFF_FRAME;
}

/* ---- ledges ---- */

static const draw_shades piece_shades[] = {
    [LOOK_ROCK] = {8, 3}, [LOOK_GRASS] = {7, 2}, [LOOK_SNOW] = {8, 3}, [LOOK_ICE] = {13, 6}, [LOOK_PLANK] = {11, 7}, [LOOK_PIVOT] = {7, 4},
};

/* What grows or lies on a ledge; its corners 3 and 2 are the upper ones. */
static void draw_cover(draw_canvas *canvas, const draw_point *corners, level_look look)
{
    const int left = corners[3].x >> 4, right = corners[2].x >> 4, y = corners[3].y >> 4;
    if (look == LOOK_GRASS) {
        draw_row(canvas, left, right, y, 12);
        draw_row(canvas, left, right, y + 1, 9);
        for (int x = left + 1; x < right; x += 3) {
            draw_pixel(canvas, x, y + 2, 9);
            draw_pixel(canvas, x + (x / 3 & 1), y - 1, 10);
        }
    } else if (look == LOOK_SNOW) {
        draw_row(canvas, left - 1, right + 1, y, 15);
        draw_row(canvas, left, right, y + 1, 13);
        for (int x = left; x < right; x += 5)
            draw_row(canvas, x, x + 3, y + 2, 12);
    } else if (look == LOOK_ICE) {
        draw_row(canvas, left, right, y, 15);
        for (int x = left + 4; x < right - 6; x += 11)
            draw_line(canvas, x, y + 6, x + 4, y + 2, 15, DRAW_SOLID);
    } else if (look == LOOK_ROCK) {
        draw_row(canvas, left, right, y, 11);
        for (int x = left + 3; x < right - 3; x += 7)
            draw_row(canvas, x, x + 3, y + 4 + (x & 3), 3);
    }
}

static void draw_piece(draw_canvas *canvas, const game *g, int index, const draw_view *view)
{
    const level_look look = g->round.level.pieces[index].look;
    draw_point corners[BOX_CORNERS];
    draw_box_corners(view, g->round.world, g->round.pieces[index], corners);
    if (look == LOOK_PIVOT) {
        const draw_point triangle[3] = {{(corners[2].x + corners[3].x) / 2, corners[3].y}, {corners[0].x - 64, corners[0].y}, {corners[1].x + 64, corners[1].y}};
        draw_rimmed(canvas, triangle, 3, 1, piece_shades[look]);
        return;
    }
    draw_rimmed(canvas, corners, BOX_CORNERS, 1, piece_shades[look]);
    draw_cover(canvas, corners, look);
}

/* ---- stones ---- */

static void draw_stone(draw_canvas *canvas, const game *g, const stone *s, const draw_view *view)
{
    cairn_vec2 corners[STONE_CORNERS];
    draw_point points[STONE_CORNERS];
    if (is_off(draw_view_point(view, cairn_body_center(g->round.world, s->body))))
        return;
    const int count = stone_corners(s, g->round.world, corners);
    for (int i = 0; i < count; i++)
        points[i] = draw_view_point(view, corners[i]);
    const int light = 11 + (int)(s->seed >> 8 & 3);
    const draw_shades shades = {light, light - 5};
    draw_rimmed(canvas, points, count, 0, shades);
    /* A vein in the stone, which shows how it has turned. */
    const draw_point a = points[0], b = points[count / 2], c = points[count / 3];
    draw_line(canvas, (a.x * 5 + b.x * 3) >> 7, (a.y * 5 + b.y * 3) >> 7, (b.x + c.x + 2 * a.x) >> 6, (b.y + c.y + 2 * a.y) >> 6, light - 5, DRAW_SOLID);
}

/* ---- the balloon ---- */

static void draw_plumb(draw_canvas *canvas, draw_point load)
{
    draw_line(canvas, load.x >> 4, (load.y >> 4) + 8, load.x >> 4, (load.y >> 4) + PLUMB_LENGTH, 9, DRAW_DOTTED);
}

static void draw_crane(draw_canvas *canvas, const game *g, const draw_view *view)
{
    const game_round *r = &g->round;
    const draw_point at = draw_view_point(view, cairn_body_position(r->world, r->crane.trolley));
    const int x = at.x >> 4, y = at.y >> 4;
    if (r->crane.load != NULL) {
        const draw_point load = draw_view_point(view, cairn_body_center(r->world, r->crane.load->body));
        draw_plumb(canvas, load);
        draw_line(canvas, x + 1, y, (load.x >> 4) + 1, load.y >> 4, 2, DRAW_SOLID);
        draw_line(canvas, x, y, load.x >> 4, load.y >> 4, 14, DRAW_SOLID);
    } else {
        draw_line(canvas, x, y, x, y + 5, 13, DRAW_SOLID);
    }
    const draw_point middle = {at.x, at.y - 8 * DRAW_SUB}, stripe = {at.x - 20, middle.y};
    const draw_shades skin = {15, 9}, shade = {11, 6};
    draw_disc(canvas, middle, BALLOON + 16, draw_shade(1));
    draw_disc(canvas, middle, BALLOON, skin);
    draw_disc(canvas, stripe, BALLOON - 36, shade);
    draw_line(canvas, x - 2, y - 3, x - 1, y, 8, DRAW_SOLID);
    draw_line(canvas, x + 2, y - 3, x + 1, y, 8, DRAW_SOLID);
    draw_box(canvas, x - 2, y, 5, 2, 1);
    draw_row(canvas, x - 1, x + 2, y, 12);
}

/* ---- dust and points ---- */

static void draw_grains(draw_canvas *canvas, const feel *f, const draw_view *view)
{
    for (int i = 0; i < FEEL_GRAINS; i++) {
        const feel_grain *grain = &f->grains[i];
        if (grain->life == 0)
            continue;
        const draw_point p = draw_view_point(view, grain->at);
        const int shade = grain->heavy ? 13 : 4 + grain->life / 3;
        draw_pixel(canvas, p.x >> 4, p.y >> 4, shade);
        if (!grain->heavy && grain->life > 12)
            draw_pixel(canvas, (p.x >> 4) + 1, p.y >> 4, shade - 2);
    }
}

static void draw_pops(draw_canvas *canvas, const feel *f, const draw_view *view)
{
    for (int i = 0; i < FEEL_POPS; i++) {
        char text[DRAW_NUMBER_SIZE + 1] = "+";
        if (f->pops[i].life == 0)
            continue;
        const draw_point p = draw_view_point(view, f->pops[i].at);
        (void)draw_number(text + 1, (int32_t)f->pops[i].points, 0);
        draw_centered(canvas, p.x >> 4, (p.y >> 4) - 10, text, f->pops[i].life > 12 ? 15 : 9);
    }
}

/* The line to reach: it walks while the cairn stands above it. */
static void draw_goal(draw_canvas *canvas, const game *g, const draw_view *view)
{
    const draw_point p = draw_view_point(view, cairn_vec2_of(0, g->round.level.goal));
    const int y = p.y >> 4, walk = g->round.held > 0 ? (int)(g->frame / 2 & 7) : 0;
    const int shade = g->round.held > 0 ? 15 : 12;
    for (int x = -8; x < DRAW_WIDTH; x += 8) {
        draw_row(canvas, x + walk, x + walk + 4, y + 1, 1);
        draw_row(canvas, x + walk, x + walk + 4, y, shade);
    }
    draw_line(canvas, 3, y, 3, y - 7, 14, DRAW_SOLID);
    const draw_point flag[3] = {{4 * DRAW_SUB, (y - 7) * DRAW_SUB}, {(9 + (int)(g->frame >> 4 & 1)) * DRAW_SUB, (y - 5) * DRAW_SUB}, {4 * DRAW_SUB, (y - 3) * DRAW_SUB}};
    draw_convex(canvas, flag, 3, draw_shade(15));
}

void picture_things(draw_canvas *canvas, const game *g, const draw_view *view)
{
    for (int i = 0; i < g->round.level.piece_count; i++)
        draw_piece(canvas, g, i, view);
    draw_goal(canvas, g, view);
    draw_crane(canvas, g, view);
    for (int i = 0; i < LEVEL_STONES; i++)
        if (g->round.stones[i].state != STONE_NONE)
            draw_stone(canvas, g, &g->round.stones[i], view);
    draw_grains(canvas, &g->feel, view);
    draw_pops(canvas, &g->feel, view);
}
