/* The title, and what it shares with the other cards. See picture.h. */
#include "picture.h"

#include "text.h"

#include <string.h>

enum { LEFT_MIDDLE = 44, ART_STONES = 5, BLINK = 32 };

const char *picture_with_number(char *line, const char *text, int32_t value, int decimals)
{
    const size_t length = strlen(text);
    memcpy(line, text, length + 1);
    (void)draw_number(line + length, value, decimals);
    return line;
}

void picture_menu_line(draw_canvas *canvas, const game *g, int index, int x, int y, const char *text)
{
    const bool chosen = g->menu == index;
    draw_centered(canvas, x, y, text, chosen ? 15 : 8);
    if (chosen)
        draw_label(canvas, x - draw_text_width(text) / 2 - 7 - (int)(g->frame >> 3 & 1), y, ">", 15);
}

/* A cairn of the painter's own: middle, half sizes and how far its upper bed is to the right, in quarters of a pixel. */
static const struct {
    int16_t x, y, wide, high, lean;
} art[ART_STONES] = {{416, 226, 80, 28, -6}, {420, 176, 62, 23, 8}, {410, 134, 50, 20, -5}, {419, 98, 36, 17, 4}, {413, 68, 22, 14, -3}};

static void draw_art(draw_canvas *canvas)
{
    enum { QUARTER = DRAW_SUB / 4, CORNERS = 6 };
    for (int i = 0; i < ART_STONES; i++) {
        const int x = art[i].x * QUARTER, y = art[i].y * QUARTER, wide = art[i].wide * QUARTER, high = art[i].high * QUARTER, lean = art[i].lean * QUARTER;
        const draw_point corners[CORNERS] = {{x - wide * 3 / 4, y + high}, {x + wide * 2 / 3, y + high}, {x + wide, y + high / 5},
                                             {x + wide * 2 / 3 + lean, y - high}, {x - wide * 2 / 3 + lean, y - high}, {x - wide, y - high / 4}};
        const draw_shades shades = {15, 7};
        draw_rimmed(canvas, corners, CORNERS, 0, shades);
        draw_row(canvas, (x - wide / 3) / DRAW_SUB, (x + wide / 5) / DRAW_SUB, y / DRAW_SUB, 8);
    }
}

void picture_title(draw_canvas *canvas, const game *g)
{
    char text[PICTURE_LINE];
    const draw_shades shades = {15, 8};
    draw_art(canvas);
    draw_big_text(canvas, LEFT_MIDDLE - 38, 8, "CAIRN", 4, shades);
    draw_centered(canvas, LEFT_MIDDLE, 33, "STACK. BALANCE.", 12);
    if (g->can_continue) {
        picture_menu_line(canvas, g, 0, LEFT_MIDDLE, 43, picture_with_number(text, "GO ON: LEVEL ", g->kept.number + 1, 0));
        picture_menu_line(canvas, g, 1, LEFT_MIDDLE, 50, "NEW GAME");
    } else if ((g->frame & BLINK) != 0) {
        draw_centered(canvas, LEFT_MIDDLE, 45, "PRESS SELECT", 15);
    }
    draw_centered(canvas, LEFT_MIDDLE, 58, picture_with_number(text, "BEST ", (int32_t)g->score.best, 0), 13);
}
