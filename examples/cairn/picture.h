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
void picture_hud(draw_canvas *canvas, const game *g, const draw_view *view);

#endif
