/* What is written on the picture: points, lives, stones, height, cards between the levels. See picture.h. */
#include "picture.h"

#include "text.h"

#include <string.h>

enum { BAR_X = 124, BAR_TOP = 20, BAR_BOTTOM = 61, CARD_STEPS = 110, BLINK = 32, MIDDLE = DRAW_WIDTH / 2 };

static bool blinks(const game *g) { return (g->frame & BLINK) != 0; }

static void draw_heart(draw_canvas *canvas, int x, int y)
{
    static const uint8_t rows[] = {0x0A, 0x1F, 0x1F, 0x0E, 0x04};
    draw_box(canvas, x, y, 7, 6, 0);
    for (int row = 0; row < 5; row++)
        for (int column = 0; column < 5; column++)
            if ((rows[row] >> column & 1) != 0)
                draw_pixel(canvas, x + 1 + column, y + row, 15 - row);
}

static void draw_lives(draw_canvas *canvas, const game *g)
{
    const bool hurt = g->round.mercy > 60 && (g->frame & 4) != 0;
    for (int i = 0; i < g->round.lives && !hurt; i++)
        draw_heart(canvas, DRAW_WIDTH - 7 - 7 * i, 0);
}

/* Stones left: a small stone and their number. */
static void draw_supply(draw_canvas *canvas, const game *g)
{
    char text[PICTURE_LINE];
    const int left = g->round.supply + (g->round.state == ROUND_HANGING);
    const draw_point icon[5] = {{107 * DRAW_SUB, 10 * DRAW_SUB}, {109 * DRAW_SUB, 8 * DRAW_SUB}, {112 * DRAW_SUB, 8 * DRAW_SUB},
                                 {113 * DRAW_SUB, 10 * DRAW_SUB}, {111 * DRAW_SUB, 12 * DRAW_SUB}};
    const draw_shades shades = {14, 9};
    draw_convex(canvas, icon, 5, shades);
    (void)draw_number(text, left, 0);
    draw_label(canvas, 116, 8, text, left > 3 || blinks(g) ? 14 : 8);
}

static void draw_altimeter(draw_canvas *canvas, const game *g)
{
    const int length = BAR_BOTTOM - BAR_TOP;
    cairn_real part = cairn_real_divide(g->round.top, g->round.level.goal);
    part = part > CAIRN_F(1) ? CAIRN_F(1) : part;
    const int filled = (int)cairn_real_floor(part * (cairn_real)length);
    draw_box(canvas, BAR_X - 1, BAR_TOP - 1, 4, length + 2, 0);
    draw_box(canvas, BAR_X, BAR_TOP, 2, length, 3);
    draw_box(canvas, BAR_X, BAR_BOTTOM - filled, 2, filled, part == CAIRN_F(1) ? 15 : 11);
    draw_row(canvas, BAR_X - 3, BAR_X + 3, BAR_TOP, 15);
}

static void draw_height(draw_canvas *canvas, const game *g)
{
    char text[PICTURE_LINE];
    const int32_t decimetres = (int32_t)cairn_real_floor(g->round.top * 10), goal = (int32_t)cairn_real_floor(g->round.level.goal * 10 + CAIRN_F(0.5));
    int length = draw_number(text, decimetres, 1);
    text[length++] = '/';
    length += draw_number(text + length, goal, 1);
    text[length++] = 'M';
    text[length] = '\0';
    draw_label(canvas, 1, 8, text, 12);
}

static void draw_points(draw_canvas *canvas, const game *g)
{
    char text[PICTURE_LINE];
    draw_number(text, (int32_t)g->score.points, 0);
    draw_label(canvas, 1, 1, text, 15);
    if (g->score.streak > 1)
        {
        const int x = 4 + draw_text_width(text);
        draw_label(canvas, x, 1, picture_with_number(text, "X", g->score.streak, 0), 10);
    }
}

/* Seconds that the cairn still has to stand. */
static void draw_hold(draw_canvas *canvas, const game *g)
{
    char text[DRAW_NUMBER_SIZE];
    if (g->round.held == 0 || g->round.state == ROUND_WON)
        return;
    const draw_shades shades = {15, 10};
    draw_number(text, (ROUND_HOLD_STEPS - g->round.held) / 60 + 1, 0);
    draw_big_text(canvas, MIDDLE - 7, 10, text, 4, shades);
    draw_centered(canvas, MIDDLE, 32, "HOLD!", 15);
}

static void draw_card(draw_canvas *canvas, const game *g)
{
    char text[PICTURE_LINE];
    if (g->since > CARD_STEPS || g->state != GAME_PLAY)
        return;
    const int slide = g->since < 10 ? (int)(10 - g->since) * 8 : g->since > CARD_STEPS - 10 ? -(int)(g->since + 10 - CARD_STEPS) * 8 : 0;
    const draw_shades shades = {15, 9};
    const int width = (int)strlen(g->round.level.name) * 8 - 2;
    draw_tint(canvas, 0, 37, DRAW_WIDTH, 23, -4);
    draw_centered(canvas, MIDDLE + slide, 39, picture_with_number(text, "LEVEL ", g->round.number + 1, 0), 12);
    draw_big_text(canvas, MIDDLE - width / 2 - slide, 47, g->round.level.name, 2, shades);
}

static void draw_won(draw_canvas *canvas, const game *g)
{
    char text[PICTURE_LINE];
    const draw_shades shades = {15, 10};
    draw_tint(canvas, 0, 8, DRAW_WIDTH, 40, -4);
    draw_big_text(canvas, MIDDLE - 35, 11, "IT STANDS", 2, shades);
    draw_centered(canvas, MIDDLE, 26, picture_with_number(text, "BONUS ", (int32_t)g->bonus, 0), 14);
    draw_centered(canvas, MIDDLE, 33, picture_with_number(text, "SCORE ", (int32_t)g->score.points, 0), 15);
    if (blinks(g))
        draw_centered(canvas, MIDDLE, 41, "SELECT: NEXT LEVEL", 12);
}

static void draw_over(draw_canvas *canvas, const game *g)
{
    char text[PICTURE_LINE];
    const draw_shades shades = {14, 6};
    const bool fell = g->round.lives == 0;
    draw_tint(canvas, 0, 6, DRAW_WIDTH, 53, -6);
    draw_big_text(canvas, fell ? MIDDLE - 31 : MIDDLE - 35, 9, fell ? "IT FELL." : "NO STONES", 2, shades);
    draw_centered(canvas, MIDDLE, 24, picture_with_number(text, "SCORE ", (int32_t)g->score.points, 0), 15);
    draw_centered(canvas, MIDDLE, 31, picture_with_number(text, "BEST ", (int32_t)g->score.best, 0), g->score.points == g->score.best ? 15 : 10);
    picture_menu_line(canvas, g, 0, MIDDLE, 42, "ONCE MORE");
    picture_menu_line(canvas, g, 1, MIDDLE, 50, "TITLE");
}

static void draw_pause(draw_canvas *canvas, const game *g)
{
    const draw_shades shades = {15, 10};
    draw_tint(canvas, 0, 0, DRAW_WIDTH, DRAW_HEIGHT, -6);
    draw_big_text(canvas, MIDDLE - 19, 8, "PAUSE", 2, shades);
    picture_menu_line(canvas, g, 0, MIDDLE, 26, "RESUME");
    picture_menu_line(canvas, g, 1, MIDDLE, 34, "RETRY");
    picture_menu_line(canvas, g, 2, MIDDLE, 42, "TITLE");
    draw_centered(canvas, MIDDLE, 56, "HOLD SELECT + PAD: LAYERS", 7);
}

void picture_hud(draw_canvas *canvas, const game *g)
{
    draw_altimeter(canvas, g);
    draw_height(canvas, g);
    draw_lives(canvas, g);
    draw_supply(canvas, g);
    draw_hold(canvas, g);
    if (g->state == GAME_DEMO) {
        if (blinks(g))
            draw_label(canvas, 1, 1, "DEMO", 15);
        return;
    }
    draw_points(canvas, g);
    draw_card(canvas, g);
    if (g->state == GAME_WON)
        draw_won(canvas, g);
    else if (g->state == GAME_OVER)
        draw_over(canvas, g);
    else if (g->state == GAME_PAUSE)
        draw_pause(canvas, g);
}
