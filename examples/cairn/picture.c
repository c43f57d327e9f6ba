/* See picture.h. */
#include "picture.h"

enum { SCALE = 16, MIDDLE_X = DRAW_WIDTH / 2, MIDDLE_Y = DRAW_HEIGHT / 2 };

static draw_view view_of(const game *g)
{
    draw_view view;
    view.center = cairn_vec2_of(0, g->camera);
    view.x = MIDDLE_X + feel_shake_x(&g->feel);
    view.y = MIDDLE_Y + feel_shake_y(&g->feel);
    view.scale = SCALE;
    return view;
}

void picture_draw(draw_canvas *canvas, const game *g)
{
    const draw_view view = view_of(g);
    draw_unclip(canvas);
    if ((g->layers.shown & DRAW_LAYER_SHAPES) != 0) {
        draw_clear(canvas, 0);
    } else {
        picture_landscape(canvas, g, &view);
        if (g->state != GAME_TITLE)
            picture_things(canvas, g, &view);
    }
    draw_world(canvas, &view, g->round.world, &g->layers);
    if (g->state == GAME_TITLE)
        picture_title(canvas, g);
    else
        picture_hud(canvas, g);
}
