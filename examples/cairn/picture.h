/* The game on a canvas. Nothing here decides anything: a frame that is not drawn changes no other. */
#ifndef PICTURE_H
#define PICTURE_H

#include "game.h"

#include "canvas.h"

/* The whole frame. */
void picture_draw(draw_canvas *canvas, const game *g);

/* Its parts: sky, mountains, water; ledges, balloon, stones and dust; what is written on it. */
void picture_landscape(draw_canvas *canvas, const game *g, const draw_view *view);
void picture_things(draw_canvas *canvas, const game *g, const draw_view *view);
void picture_hud(draw_canvas *canvas, const game *g);
/* The title stands before the landscape alone. */
void picture_title(draw_canvas *canvas, const game *g);

enum { PICTURE_LINE = 32 };

/* A text and a number in one line of PICTURE_LINE characters; returns the line. */
const char *picture_with_number(char *line, const char *text, int32_t value, int decimals);
/* A line of a menu about x: the chosen one is brighter and has an arrow. */
void picture_menu_line(draw_canvas *canvas, const game *g, int index, int x, int y, const char *text);

#endif
