/* Pinball: an example to copy from. A fast ball with continuous collision, flippers that are driven and cannot leave their place, bumpers, sensors. */
#include "body_view.h"
#include "debug_view.h"
#include "line.h"
#include "pinball.h"
#include "shell.h"
#include "text.h"

static pinball the_game;
static draw_layers layers;

static void start(uint32_t seed)
{
    (void)seed; /* nothing here is by chance */
    pinball_start(&the_game);
}

static void step(uint32_t buttons)
{
    (void)draw_layers_step(&layers, buttons);
    pinball_step(&the_game, buttons);
}

static uint32_t hash(void) { return pinball_hash(&the_game); }

static void draw_part(draw_canvas *canvas, const draw_view *view, int index)
{
    const table *t = &the_game.table;
    const cairn_body_id body = t->parts[index];
    const cairn_shape *shape = cairn_body_shape(t->world, body);
    const bool shines = the_game.glow[index] > 0;
    if (shape->kind != &cairn_circle_class) {
        const draw_shades wall = {9, 4}, kicker = {shines ? 15 : 12, shines ? 14 : 7};
        draw_box_body(canvas, view, the_game.table.world, body, 1, t->kinds[index] == PART_SLING ? kicker : wall);
        return;
    }
    const draw_point at = draw_view_point(view, cairn_body_position(t->world, body));
    const int32_t size = draw_view_length(view, shape->size.x);
    if (t->kinds[index] == PART_LAMP) {
        const bool lit = (the_game.lit >> (t->part_count - 1 - index) & 1) != 0;
        draw_disc(canvas, at, size, draw_shade(lit || shines ? 14 : 3));
        draw_ring(canvas, at, size, 8);
        return;
    }
    const draw_shades skin = {shines ? 15 : 11, shines ? 15 : 6};
    draw_disc(canvas, at, size + (shines ? 16 : 0), draw_shade(15));
    draw_disc(canvas, at, size - 20, draw_shade(2));
    draw_disc(canvas, at, size - 44, skin);
}

static void draw_words(draw_canvas *canvas)
{
    char text[DRAW_NUMBER_SIZE];
    draw_number(text, (int32_t)the_game.score, 0);
    draw_label(canvas, 1, 1, text, 15);
    for (int i = 0; i < the_game.balls; i++) {
        const draw_point dot = {(124 - 6 * i) * DRAW_SUB, 4 * DRAW_SUB};
        draw_disc(canvas, dot, 36, draw_shade(14));
    }
    if (the_game.charge > 0)
        draw_box(canvas, 126, 62 - the_game.charge, 2, the_game.charge, 15);
    if (the_game.balls == 0) {
        draw_tint(canvas, 0, 18, DRAW_WIDTH, 27, -7);
        draw_centered(canvas, DRAW_WIDTH / 2, 22, "GAME OVER", 15);
        draw_centered(canvas, DRAW_WIDTH / 2, 31, text, 13);
        draw_centered(canvas, DRAW_WIDTH / 2, 39, "SELECT", 10);
    } else if (the_game.waiting && (the_game.frame & 32) != 0) {
        draw_centered(canvas, 58, 55, "HOLD SELECT, LET GO", 12);
    }
}

static void draw(draw_canvas *canvas)
{
    const table *t = &the_game.table;
    draw_view view = {cairn_vec2_of(0, the_game.camera), DRAW_WIDTH / 2, DRAW_HEIGHT / 2, 15};
    draw_clear(canvas, 0);
    if ((layers.shown & DRAW_LAYER_SHAPES) == 0) {
        for (int y = -((int)(draw_view_length(&view, the_game.camera) / DRAW_SUB) & 7); y < DRAW_HEIGHT; y += 8)
            for (int x = 4; x < DRAW_WIDTH; x += 8)
                draw_pixel(canvas, x, DRAW_HEIGHT - 1 - y, 3);
        for (int i = t->part_count - 1; i >= 0; i--)
            draw_part(canvas, &view, i);
        const draw_shades flipper = {15, 11}, ball = {15, 8};
        draw_box_body(canvas, &view, the_game.table.world, t->flippers[0], 1, flipper);
        draw_box_body(canvas, &view, the_game.table.world, t->flippers[1], 1, flipper);
        draw_part(canvas, &view, 6); /* the guides hide the flippers' other halves */
        draw_part(canvas, &view, 7);
        const draw_point at = draw_view_point(&view, cairn_body_position(t->world, t->ball));
        draw_disc(canvas, at, 70, draw_shade(1));
        draw_disc(canvas, at, 54, ball);
    }
    draw_world(canvas, &view, t->world, &layers);
    draw_words(canvas);
}

int main(void)
{
    static const shell_app app = {"pinball", start, step, draw, hash, NULL};
    cairn_port_init();
    cairn_port_exit(shell_run(&app));
    return 0;
}
