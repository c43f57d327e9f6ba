/*
 * A game that runs a scene and says what came of it, for `tools/cairn trim`: once with all of Cairn, once with what the scene needs.
 * Without SCENE it is what an image is without Cairn.
 */
#include "cairn_port.h"
#include "cairn_print.h"

#ifdef SCENE

#include "scene.h"

extern const cairn_scene SCENE;
extern const cairn_scene_storage STORAGE;

#ifdef PLAY
#include "scene_play.h"

extern const cairn_scene_play PLAY;
extern cairn_body_id IDS[]; /* one a body of the table */

static bool play(cairn_world *world, uint32_t step)
{
    static uint32_t next;
    return cairn_scene_play_due(&PLAY, &SCENE, world, IDS, step, &next) == CAIRN_OK;
}
#else
#define IDS NULL
static bool play(const cairn_world *world, uint32_t step)
{
    (void)world;
    (void)step;
    return true;
}
#endif

static void print_line(const char *name, uint32_t value)
{
    cairn_print_text(name);
    cairn_print_text(" ");
    cairn_print_u32(value);
    cairn_print_text("\n");
}

static int run(void)
{
    cairn_status status = CAIRN_OK;
    int place = 0;
    cairn_world *world = cairn_scene_build(&SCENE, &STORAGE, IDS, NULL, &status, &place);
    if (world == NULL) {
        print_line("refused", (uint32_t)-(int)status);
        return 1;
    }
    const uint32_t before = cairn_port_clock(), clock_cost = cairn_port_clock() - before;
    const uint32_t stack = cairn_port_stack_now();
    uint64_t total = 0;
    uint32_t worst = 0;
    cairn_port_stack_paint();
    for (uint32_t step = 0; step < STEPS; step++) {
        if (!play(world, step)) {
            print_line("event fails at step", step);
            return 1;
        }
        const uint32_t start = cairn_port_clock();
        (void)cairn_world_step(world);
        const uint32_t cost = cairn_port_clock() - start - clock_cost;
        total += cost;
        worst = cost > worst ? cost : worst;
    }
    print_line("stack", cairn_port_stack_used() - stack);
    print_line("mean", (uint32_t)(total / STEPS));
    print_line("worst", worst);
    print_line("dropped", cairn_world_get_stats(world)->dropped);
    cairn_print_text("hash ");
    cairn_print_hex32(cairn_world_hash(world));
    cairn_print_text("\n");
    return 0;
}

#else

static int run(void)
{
    const uint32_t before = cairn_port_clock();
    cairn_port_stack_paint();
    cairn_print_u32((uint32_t)((cairn_port_clock() - before + (uint64_t)cairn_port_stack_used()) / STEPS) + cairn_port_stack_now());
    cairn_print_hex32(before);
    return 0;
}

#endif

int main(void)
{
    cairn_port_init();
    const int code = run();
    cairn_print_flush();
    cairn_port_exit(code);
    return code;
}
