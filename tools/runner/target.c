/* The firmware: runs the scene that was linked in, by the words the image was started with. */
#include "runner.h"

#include "cairn_port.h"

#ifndef CAIRN_RUNNER_BODIES
#define CAIRN_RUNNER_BODIES 512
#endif

/* The table that tools/cairn writes, with memory for it. */
extern const cairn_scene cairn_the_scene;
extern const cairn_scene_storage cairn_the_scene_storage;

static cairn_body_id ids[CAIRN_RUNNER_BODIES];
static runner_turn turns[CAIRN_RUNNER_BODIES];
static cairn_angle angles[CAIRN_RUNNER_BODIES];

static bool take_all(runner_options *options, const char *words)
{
    while (*words != '\0') {
        if (*words == ' ') {
            words++;
            continue;
        }
        if (!runner_options_take(options, words)) {
            return false;
        }
        while (*words != '\0' && *words != ' ') {
            words++;
        }
    }
    return true;
}

static int run(void)
{
    runner_options options = runner_options_default();
    if (!take_all(&options, cairn_port_arguments())) {
        cairn_print_text("error unknown word among the arguments\n");
        return 2;
    }
    if (cairn_the_scene.body_count > CAIRN_RUNNER_BODIES) {
        cairn_print_text("error more bodies than CAIRN_RUNNER_BODIES\n");
        return 1;
    }
    const runner_memory memory = {ids, turns, angles};
    return runner_run(&cairn_the_scene, &cairn_the_scene_storage, memory, &options);
}

int main(void)
{
    cairn_port_init();
    const int code = run();
    cairn_print_flush();
    cairn_port_exit(code);
    return code;
}
