/* The platformer: an example to copy from. One-way ledges, a moving platform, coins as sensors, a hero who cannot turn over. */
#include "body_view.h"
#include "debug_view.h"
#include "hop.h"
#include "line.h"
#include "shell.h"
#include "stage.h"
#include "text.h"

static hop the_game;
static draw_layers layers;

static void start(uint32_t seed)
{
    (void)seed; /* nothing here is by chance */
    hop_start(&the_game);
}

static void step(uint32_t buttons)
{
    (void)draw_layers_step(&layers, buttons);
    hop_step(&the_game, buttons);
}

static uint32_t hash(void) { return hop_hash(&the_game); }

static void draw_ground(draw_canvas *canvas, const draw_view *view, cairn_body_id body)
{
    const draw_shades earth = {8, 3};
    const cairn_vec2 at = cairn_body_position(the_game.world, body), size = cairn_body_shape(the_game.world, body)->size;
    draw_box_body(canvas, view, the_game.world, body, 1, earth);
    const draw_point a = draw_view_point(view, cairn_vec2_of(at.x - size.x / 2, at.y + size.y / 2));
    const draw_point b = draw_view_point(view, cairn_vec2_of(at.x + size.x / 2, at.y));
    draw_row(canvas, a.x >> 4, b.x >> 4, a.y >> 4, 13);
    for (int x = a.x >> 4; x < b.x >> 4; x += 3)
        draw_pixel(canvas, x, (a.y >> 4) + 1, 11);
}

static void draw_hero(draw_canvas *canvas, const draw_view *view)
{
    const draw_point at = draw_view_point(view, cairn_body_position(the_game.world, the_game.hero));
    const cairn_vec2 v = cairn_body_velocity(the_game.world, the_game.hero);
    const int x = at.x >> 4, y = at.y >> 4, walks = v.x > CAIRN_F(0.3) || v.x < CAIRN_F(-0.3) ? (int)(the_game.frame >> 2 & 1) : 0;
    draw_box(canvas, x - 5, y - 6, 10, 13, 0);
    draw_box(canvas, x - 4, y - 5, 8, 5, 15);
    draw_box(canvas, x - 4, y, 8, 4, 10);
    draw_box(canvas, x - 3 + walks, y + 4, 2, 2 - walks, 13);
    draw_box(canvas, x + 1 - walks, y + 4, 2, 1 + walks, 13);
    draw_box(canvas, x + (the_game.facing > 0 ? 1 : -3), y - 4, 2, 2, 0);
    draw_pixel(canvas, x + (the_game.facing > 0 ? 3 : -4), y - 2, 6);
}

static void draw_coins(draw_canvas *canvas, const draw_view *view)
{
    static const uint8_t widths[] = {44, 30, 10, 30};
    for (int i = 0; i < HOP_COINS; i++) {
        if ((the_game.got >> i & 1) != 0)
            continue;
        const draw_point at = draw_view_point(view, stage_coin_at[i]);
        const int32_t wide = widths[(the_game.frame / 8 + (uint32_t)i) % 4];
        const draw_point corners[4] = {{at.x - wide, at.y}, {at.x, at.y - 56}, {at.x + wide, at.y}, {at.x, at.y + 56}};
        const draw_shades gold = {15, 9};
        draw_rimmed(canvas, corners, 4, 4, gold);
    }
}

static void draw_hills(draw_canvas *canvas, const draw_view *view)
{
    const int shift = (int)(draw_view_length(view, view->center.x) / DRAW_SUB) / 3;
    draw_gradient(canvas, 30, 80);
    for (int i = 0; i < 6; i++) {
        const draw_point top = {((i * 61 - shift) % 366 + (i * 61 < shift ? 366 : 0) - 100) * DRAW_SUB, (110 + i % 3 * 5) * DRAW_SUB};
        draw_disc(canvas, top, 66 * DRAW_SUB, draw_shade(3));
    }
}

static void draw_words(draw_canvas *canvas)
{
    char text[DRAW_NUMBER_SIZE];
    int got = 0;
    for (int i = 0; i < HOP_COINS; i++)
        got += the_game.got >> i & 1;
    const int length = draw_number(text, got, 0);
    text[length] = '/';
    draw_number(text + length + 1, HOP_COINS, 0);
    draw_label(canvas, 1, 1, text, 15);
    draw_number(text, (int32_t)(the_game.clock / 6), 1);
    draw_label(canvas, DRAW_WIDTH - 1 - draw_text_width(text), 1, text, 12);
    if (the_game.done > 0) {
        const draw_shades shades = {15, 9};
        draw_tint(canvas, 0, 20, DRAW_WIDTH, 24, -6);
        draw_big_text(canvas, 29, 23, "ALL COINS", 2, shades);
        draw_centered(canvas, DRAW_WIDTH / 2, 36, text, 15);
    }
}

static void draw(draw_canvas *canvas)
{
    const draw_view view = {cairn_vec2_of(the_game.camera_x, the_game.camera_y), DRAW_WIDTH / 2, DRAW_HEIGHT / 2, 16};
    draw_unclip(canvas);
    if ((layers.shown & DRAW_LAYER_SHAPES) != 0) {
        draw_clear(canvas, 0);
    } else {
        const draw_shades wood = {12, 8}, metal = {14, 8}, crate = {13, 7}, open = {9, 6};
        draw_hills(canvas, &view);
        for (int i = 0; i < HOP_GROUNDS; i++)
            draw_ground(canvas, &view, the_game.grounds[i]);
        for (int i = 0; i < HOP_LEDGES; i++)
            draw_box_body(canvas, &view, the_game.world, the_game.ledges[i], 1, (the_game.solid >> i & 1) != 0 ? wood : open);
        draw_box_body(canvas, &view, the_game.world, the_game.platform, 1, metal);
        for (int i = 0; i < HOP_CRATES; i++)
            draw_box_body(canvas, &view, the_game.world, the_game.crates[i], 1, crate);
        draw_coins(canvas, &view);
        draw_hero(canvas, &view);
    }
    draw_world(canvas, &view, the_game.world, &layers);
    draw_words(canvas);
}

int main(void)
{
    static const shell_app app = {"hop", start, step, draw, hash, NULL};
    cairn_port_init();
    cairn_port_exit(shell_run(&app));
    return 0;
}
