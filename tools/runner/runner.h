/*
 * Runs a scene table and prints what happened, on any port. The host's program (host.c) reads the table from a JSON
 * file, the firmware (target.c) has it linked in; tools/cairn reads the lines.
 *
 *   start BODIES RATE          once; RATE is that of the port's clock
 *   state STEP                 then one line a body: x y angle vx vy omega. Fixed point: Q16.16 as integers, and the
 *                              angle in 2^-32 turns, unwrapped. Double: metres, radians.
 *   cost UNITS                 of cairn_world_step() alone, by the port's clock, once a step
 *   stat NAME VALUE
 *   contact X Y NX NY          of the last step, if asked for
 *   hash HEX                   the engine's own in fixed point; of poses and velocities in double
 *   stack BYTES                the most that was used in the steps
 *   stack_before BYTES         what was in use where cairn_world_step() is called
 *   end
 *   error TEXT                 instead of the rest
 */
#ifndef CAIRN_RUNNER_H
#define CAIRN_RUNNER_H

#include "runner_number.h"
#include "scene_play.h"

/*
 * What a run is asked for, in words: steps=600 every=10 costs=1 contacts=1 solver=small substeps=8 passes=20 rate=120
 * broad=quadtree sleep=1. A tree needs the memory of a scene that has one.
 */
typedef struct runner_options {
    uint32_t steps;
    uint32_t every;    /* print the state of each so many steps; 0: of none */
    bool costs, contacts;
    int substeps, passes;  /* 0: the scene's own */
    int solver;            /* a cairn_scene_solver; -1: the scene's own */
    uint32_t rate;         /* steps per second; 0: the scene's own */
    int broad, sleep;      /* a cairn_scene_broad, 0 or 1; -1: the scene's own */
    uint16_t present;      /* of the scene's bodies are there at the start; the others come by play */
    const cairn_scene_play *play; /* a recorded run, of the host alone, or null; and what plays it: */
    cairn_status (*due)(const cairn_scene_play *play, const cairn_scene *scene, cairn_world *world, cairn_body_id *ids, uint32_t step,
                        uint32_t *next);
} runner_options;

/* Memory of a run beside the world's, one of each per body of the scene. */
typedef struct runner_memory {
    cairn_body_id *ids;
    runner_turn *turns;
    cairn_angle *angles;
} runner_memory;

runner_options runner_options_default(void);
/* Takes one word (it ends at a space or at the text's end); false if it is none of those above. */
bool runner_options_take(runner_options *options, const char *word);

/* Runs; gives the exit code, 0 or 1. */
int runner_run(const cairn_scene *scene, const cairn_scene_storage *storage, runner_memory memory, const runner_options *options);

#endif
