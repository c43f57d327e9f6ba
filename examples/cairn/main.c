/* The game as an image: see shell.h for its words. */
#include "picture.h"

#include "shell.h"

static game the_game;

static void start(uint32_t seed) { game_start(&the_game, seed); }
static void step(uint32_t buttons) { game_step(&the_game, buttons); }
static void draw(draw_canvas *canvas) { picture_draw(canvas, &the_game); }
static uint32_t hash(void) { return game_hash(&the_game); }
static void resume(const char *name) { game_use_keep(&the_game, name); }

int main(void)
{
    static const shell_app app = {"cairn", start, step, draw, hash, resume};
    cairn_port_init();
    cairn_port_exit(shell_run(&app));
    return 0;
}
