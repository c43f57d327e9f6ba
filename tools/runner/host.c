/* The host's program: cairn-runner SCENE.json [WORD...], the words of runner.h. */
#include "host_file.h"
#include "host_play.h"
#include "runner.h"
#include "storage.h"

#include "cairn_port.h"

#include <stdio.h>
#include <stdlib.h>

enum { BAD_CALL = 2 };

#define PLAY "play=" /* a word of the host's own */

static void *room(size_t count, size_t size)
{
    void *memory = calloc(count > 0 ? count : 1, size);
    if (memory == NULL) {
        fputs("not enough memory\n", stderr);
        exit(EXIT_FAILURE);
    }
    return memory;
}

static int run(const cairn_scene *scene, const runner_options *options)
{
    const uint16_t arbiters = runner_arbiters(scene);
    const uint16_t cells = runner_cells(scene);
    const uint16_t entries = runner_entries(scene);
    const cairn_world_storage world = {
        room(1, sizeof(cairn_world)), room(scene->body_count, sizeof(cairn_body)), room(arbiters, sizeof(cairn_arbiter)),
        room(arbiters, sizeof(uint16_t)), room(arbiters, sizeof(uint16_t)), room(scene->body_count, sizeof(uint16_t)), scene->body_count, arbiters,
    };
    const cairn_spring_storage springs = {
        room(1, sizeof(cairn_spring_pool)), room(scene->spring_count, sizeof(cairn_spring)), scene->spring_count,
    };
    const cairn_quadtree_storage tree = {
        room(1, sizeof(cairn_quadtree)), room(scene->body_count, sizeof(cairn_quadtree_box)), room(cells, sizeof(cairn_quadtree_cell)),
        room(entries, sizeof(cairn_quadtree_entry)),
        scene->body_count, cells, entries,
    };
    cairn_block *blocks = runner_is_uneven(scene) ? room(1, sizeof *blocks) : NULL;
    const cairn_scene_storage storage = {&world, &springs, &tree, blocks};
    const runner_memory memory = {
        room(scene->body_count, sizeof(cairn_body_id)),
        room(scene->body_count, sizeof(runner_turn)),
        room(scene->body_count, sizeof(cairn_angle)),
    };
    const int code = runner_run(scene, &storage, memory, options);
    cairn_print_flush();
    free(world.world);
    free(world.bodies);
    free(world.arbiters);
    free(world.order);
    free(world.swept);
    free(world.sorted);
    free(springs.pool);
    free(springs.springs);
    free(tree.tree);
    free(tree.boxes);
    free(tree.cells);
    free(tree.entries);
    free(blocks);
    free(memory.ids);
    free(memory.turns);
    free(memory.angles);
    return code;
}

int main(int count, char **words)
{
    runner_options options = runner_options_default();
    cairn_scene_play play = { 0, NULL };
    for (int i = 2; i < count; i++) {
        const bool is_play = strncmp(words[i], PLAY, strlen(PLAY)) == 0;
        if (is_play ? !host_read_play(words[i] + strlen(PLAY), &options, &play) : !runner_options_take(&options, words[i])) {
            fprintf(stderr, "unknown word or no such play: '%s'\n", words[i]);
            return BAD_CALL;
        }
    }
    if (count < 2) {
        fprintf(stderr, "usage: %s SCENE.json|- [steps=N] [every=K] [costs=1] [contacts=1] [solver=soft|slides|small] [substeps=N] [passes=N]\n", words[0]);
        return BAD_CALL;
    }
    cairn_port_init();
    cairn_scene_file *file = host_read_scene(words[1]);
    if (file == NULL) {
        return BAD_CALL;
    }
    const int code = run(cairn_scene_file_table(file), &options);
    cairn_scene_file_free(file);
    host_free_play(&play);
    return code;
}
