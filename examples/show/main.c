/*
 * The show: the slides' demo scenes, solved by the slides' scheme on the left and by Cairn on the right, at once. An example to copy from.
 * LEFT and RIGHT browse, SELECT begins anew; SELECT held and a direction switch the layers.
 */
#include "debug_view.h"
#include "line.h"
#include "shell.h"
#include "stages.h"
#include "text.h"

enum { BODIES = 36, ARBITERS = 120, SPRINGS = 48, HALF = DRAW_WIDTH / 2, PASSES = 10, SCENE_STEPS = 600, SIDES = 2, TAP = 12 };

CAIRN_WORLD(left_world, BODIES, ARBITERS);
CAIRN_WORLD(right_world, BODIES, ARBITERS);
CAIRN_SPRINGS(left_springs, SPRINGS);
CAIRN_SPRINGS(right_springs, SPRINGS);

static cairn_world *worlds[SIDES];
static draw_layers layers = {DRAW_LAYER_SHAPES | DRAW_LAYER_SPRINGS, 0, 0};
static int scene;
static uint32_t since, before, held;

static void build(int number)
{
    scene = number;
    since = 0;
    worlds[0] = cairn_world_init(&left_world, cairn_vec2_of(0, CAIRN_F(-10)));
    worlds[1] = cairn_world_init(&right_world, cairn_vec2_of(0, CAIRN_F(-10)));
    (void)cairn_springs_enable(worlds[0], &left_springs);
    (void)cairn_springs_enable(worlds[1], &right_springs);
    (void)cairn_world_use_slides_solver(worlds[0], PASSES);
    for (int i = 0; i < SIDES; i++)
        stages_build(scene, worlds[i]);
}

static void start(uint32_t seed)
{
    (void)seed; /* nothing here is by chance */
    build(0);
}

static void step(uint32_t buttons)
{
    const uint32_t pressed = buttons & ~before, released = before & ~buttons;
    const bool tapped = (released & CAIRN_BUTTON_SELECT) != 0 && held < TAP;
    const bool switched = draw_layers_step(&layers, buttons);
    before = buttons;
    held = (buttons & CAIRN_BUTTON_SELECT) != 0 ? held + 1 : 0;
    since++;
    if (!switched && held == 0 && (pressed & CAIRN_BUTTON_LEFT) != 0)
        build((scene + stages_count() - 1) % stages_count());
    else if ((!switched && held == 0 && (pressed & CAIRN_BUTTON_RIGHT) != 0) || since > SCENE_STEPS)
        build((scene + 1) % stages_count());
    else if (tapped)
        build(scene);
    for (int i = 0; i < SIDES; i++)
        (void)cairn_world_step(worlds[i]);
}

static uint32_t hash(void) { return (cairn_world_hash(worlds[0]) * 31 + cairn_world_hash(worlds[1])) * 31 + (uint32_t)scene; }

static void draw_side(draw_canvas *canvas, int side)
{
    const draw_view view = {cairn_vec2_of(0, stages_height(scene)), HALF / 2 + HALF * side, DRAW_HEIGHT / 2 + 2, stages_scale(scene)};
    draw_clip(canvas, HALF * side + side, 7, HALF * (side + 1) - 1 + side, DRAW_HEIGHT);
    draw_world(canvas, &view, worlds[side], &layers);
    draw_unclip(canvas);
}

static void draw(draw_canvas *canvas)
{
    const char *name = stages_name(scene);
    draw_clear(canvas, 0);
    for (int side = 0; side < SIDES; side++)
        draw_side(canvas, side);
    draw_line(canvas, HALF - 1, 7, HALF - 1, DRAW_HEIGHT - 1, 5, DRAW_SOLID);
    draw_box(canvas, 0, 0, DRAW_WIDTH, 7, 3);
    draw_text(canvas, 2, 1, "SLIDES", 11);
    draw_text(canvas, DRAW_WIDTH - 21, 1, "CAIRN", 15);
    if (since < SCENE_STEPS / 4)
        draw_centered(canvas, HALF, 12, name, 15);
    draw_row(canvas, 0, (int)(since * DRAW_WIDTH / SCENE_STEPS), 6, 8);
}

int main(void)
{
    static const shell_app app = {"show", start, step, draw, hash, NULL};
    cairn_port_init();
    cairn_port_exit(shell_run(&app));
    return 0;
}
