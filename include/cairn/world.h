/*
 * The world: bodies, arbiters, gravity and time. The game declares its memory with CAIRN_WORLD; the library owns none.
 * What a world can do beyond bodies and contacts is added by a call: springs (spring.h), the quadtree (quadtree.h),
 * sleep (sleep.h), blocks for heavy bodies on light ones (block.h), other solvers (solver.h). What is not called is not linked.
 */
#ifndef CAIRN_WORLD_H
#define CAIRN_WORLD_H

#include "arbiter.h"

#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

struct cairn_world;
struct cairn_spring_pool;
struct cairn_quadtree;
struct cairn_block;

typedef enum cairn_solver_kind { CAIRN_SOLVER_SOFT, CAIRN_SOLVER_SLIDES, CAIRN_SOLVER_SMALL } cairn_solver_kind;

/* How constraints are solved, given the arbiters of this step: from velocities and forces to new poses. */
typedef struct cairn_solver_class {
    void (*solve)(struct cairn_world *world);
    cairn_solver_kind kind; /* what of the rest of the step goes with it */
} cairn_solver_class;

/* How pairs are found: calls cairn_arbiter_pair() once for every pair of bodies whose boxes overlap. */
typedef struct cairn_broad_class {
    void (*find_pairs)(struct cairn_world *world);
} cairn_broad_class;

/* What keeps fast bodies from passing through others: see continuous.c. */
typedef struct cairn_continuous_class {
    /* The contact of two bodies, one of them fast: as they will meet in this step, if they do. */
    void (*meet)(const struct cairn_world *world, const cairn_body *a, const cairn_body *b, struct cairn_manifold *out);
    /* Of two slower ones: what slides past the other's corner does not run into it. */
    void (*slide)(const struct cairn_world *world, const cairn_body *a, const cairn_body *b, cairn_offset margin, struct cairn_manifold *out);
    /* Cut displacements short where they would carry a fast body's core into another one. */
    void (*clip)(struct cairn_world *world);
    void (*hold_back)(struct cairn_world *world); /* before the search: what is driven against what it touches, see driven.c */
    void (*land)(struct cairn_world *world);      /* between sub-steps: what stopped something in flight, see landing.c */
} cairn_continuous_class;

extern const cairn_continuous_class cairn_continuous;

/* What solves heavy bodies on light ones: see block.c. */
typedef struct cairn_block_class {
    void (*find)(struct cairn_world *world); /* the blocks of this step */
    void (*warm_start)(struct cairn_world *world);
    void (*biased_pass)(struct cairn_world *world);
    void (*relax_pass)(struct cairn_world *world);
    void (*release)(struct cairn_world *world); /* there are none from now on */
} cairn_block_class;

/* What sleep adds to the step. */
typedef struct cairn_sleep_class {
    bool (*wake)(struct cairn_world *world);   /* what touches something awake; true if anything woke */
    void (*settle)(struct cairn_world *world); /* what has come to rest falls asleep */
    void (*disturb)(struct cairn_world *world, const cairn_body *body); /* what this body now lies in wakes */
} cairn_sleep_class;

/* Counters of the last step, and of all steps where marked. */
typedef struct cairn_world_stats {
    uint32_t steps;         /* all */
    uint32_t dropped;       /* all: contacts lost because the pool of arbiters was full */
    uint32_t saturations;   /* all: speeds and positions that met their limit */
    uint16_t bodies, awake; /* now; a platform that stands still is not awake */
    uint16_t pairs;         /* whose boxes overlap */
    uint16_t arbiters, points;
    /* What did not cost anything is the rest: */
    uint16_t looked; /* pairs whose shapes were compared; other contacts are held from the step before */
    uint16_t solved; /* arbiters that took part in the sub-steps; others are apart, idle, asleep or a sensor's */
    uint16_t moved;  /* bodies that took part in the sub-steps; others that are awake met nothing, and coast */
    uint16_t springs;
    uint16_t tree_cells, tree_entries; /* of the quadtree */
    uint16_t tree_full;                /* leaves that stayed longer than wished because a pool was full, and one more if pairs could not be kept */
} cairn_world_stats;

/*
 * The layout is the engine's own: bytes first, then halves of words, then words, for a Cortex-M0 reaches 32, 64 and 128 bytes of them with
 * one short instruction; last what is seldom asked for.
 */
typedef struct cairn_world {
    uint8_t substeps, passes;
    uint8_t locked;
    uint8_t uneven; /* a contact of very different masses in this step, or a block in the one before */
    uint8_t blocks; /* of this step: the highest number */
    int8_t error;
    bool driven;    /* the game has set a velocity since the last step */
    bool held_back; /* a body is driven against another one that it touches */
    bool placed;    /* a body was put somewhere, or taken out, since pairs were searched for */
    bool coasted;   /* what takes no part in the sub-steps has moved by all of the step */
    bool slides;    /* a contact does in this step, see slide.c */
    bool idles;     /* a contact does nothing in this step, see idle.c */
    bool in_flight; /* a row was when impacts were looked for last, see bounce.c */
    bool rearranged; /* a contact has come, gone or taken another way since they were arranged */

    uint16_t body_capacity, body_end, body_free;
    uint16_t arbiter_capacity, arbiter_count;
    uint16_t sorted_count;
    uint16_t fast;        /* bodies in this step */
    uint16_t fresh;       /* arbiters found in this step */
    uint16_t first_found; /* the slot of the first one, CAIRN_NONE if there was none yet */
    cairn_ratio rest_damping; /* by this share a step */
    cairn_ratio stick;        /* of what has slipped, taken back in a sub-step, see hold.c */

    cairn_world_stats stats; /* here, as far as short instructions reach */

    cairn_body *bodies;
    cairn_arbiter *arbiters;
    uint16_t *order; /* arbiters by pair of bodies; the free ones behind */
    uint16_t *swept; /* the same as the solver takes them, see sweep.c */
    uint16_t *sorted; /* bodies by the left ends of their boxes, see broad_pairs.c */
    uint16_t *expected; /* says which is likely to be found next: first_found, or `after` of the last one */

    const cairn_solver_class *solver;
    const cairn_continuous_class *continuous;
    cairn_real slop;
    cairn_motion push_out_limit;               /* the same as push_out, in metres per sub-step */
    cairn_motion speed_limit;                  /* of spins, too; metres per sub-step */
    cairn_motion rest_limit;                   /* slower bodies may be calmed, see motion.c */
    cairn_diffused gravity_x, gravity_y;       /* g h^2 */

    const cairn_broad_class *broad;
    const cairn_bounce_class *bounce;
    const cairn_sleep_class *sleep;
    cairn_wide substep, inverse_substep;       /* h and 1/h */
    cairn_vec2 gravity;
    cairn_real rate; /* steps per second */
    cairn_real push_out;

    struct cairn_block *block; /* null: without, see block.h */
    struct cairn_spring_pool *springs;
    struct cairn_quadtree *tree;
    uint16_t swept_ends[8]; /* where those of each way end, see sweep.c */
} cairn_world;

/* The memory of a world, as CAIRN_WORLD declares it. */
typedef struct cairn_world_storage {
    cairn_world *world;
    cairn_body *bodies;
    cairn_arbiter *arbiters;
    uint16_t *order, *swept, *sorted; /* the first two of as many as arbiters, the third as bodies */
    uint16_t body_capacity, arbiter_capacity;
} cairn_world_storage;

/* Declare, at file scope, the memory of a world of so many bodies and arbiters (1 to 65000 each). */
#define CAIRN_WORLD(name, body_count, arbiter_count) \
    static cairn_world name##_world; \
    static cairn_body name##_bodies[body_count]; \
    static cairn_arbiter name##_arbiters[arbiter_count]; \
    static uint16_t name##_order[arbiter_count], name##_swept[arbiter_count], name##_sorted[CAIRN_WITH_SORT ? (body_count) : 1]; \
    static const cairn_world_storage name = { &name##_world, name##_bodies, name##_arbiters, name##_order, name##_swept, \
                                              name##_sorted, (body_count), (arbiter_count) }

/*
 * Bytes of RAM that CAIRN_WORLD takes, a constant expression, but for what the linker puts between its arrays (at most 3 bytes each).
 * What is declared beside it has its own: CAIRN_SPRINGS_BYTES, CAIRN_QUADTREE_BYTES, CAIRN_BLOCKS_BYTES, CAIRN_SPRING_MESHES_BYTES.
 * The README has all of them in numbers.
 */
#define CAIRN_WORLD_BYTES(body_count, arbiter_count) \
    (sizeof(cairn_world) + (body_count) * (sizeof(cairn_body) + sizeof(uint16_t)) + (arbiter_count) * (sizeof(cairn_arbiter) + 2 * sizeof(uint16_t)))

extern const cairn_solver_class cairn_solver_soft;
extern const cairn_solver_class cairn_solver_slides, cairn_solver_small; /* solver.h tells of them */

/*
 * Make an empty world with a solver of your choice, and with continuous collision (&cairn_continuous) or, where nothing
 * is fast, without (null). Null if storage or solver is null or a capacity is zero.
 */
cairn_world *cairn_world_init_with(const cairn_world_storage *storage, cairn_vec2 gravity, const cairn_solver_class *solver,
                                   const cairn_continuous_class *continuous);

/*
 * Make an empty world: 60 steps a second, 4 sub-steps, gravity in m/s^2 (each component -2000 to 2000). A build without the soft solver has the small
 * one here, or the slides' if that is all it has.
 */
static inline cairn_world *cairn_world_init(const cairn_world_storage *storage, cairn_vec2 gravity)
{
    const cairn_solver_class *hard = CAIRN_WITH_SMALL_SOLVER ? &cairn_solver_small : &cairn_solver_slides;
    return cairn_world_init_with(storage, gravity, CAIRN_WITH_SOFT_SOLVER ? &cairn_solver_soft : hard, CAIRN_WITH_CONTINUOUS ? &cairn_continuous : NULL);
}

/* Advance by one step, 1 / rate seconds. Does nothing (CAIRN_ERROR_LOCKED) inside a callback. */
cairn_status cairn_world_step(cairn_world *world);

/* The status of the last call that failed, and CAIRN_OK from then on. */
cairn_status cairn_world_error(cairn_world *world);
const cairn_world_stats *cairn_world_get_stats(const cairn_world *world);

cairn_status cairn_world_set_gravity(cairn_world *world, cairn_vec2 gravity);
/* Steps per second, 10 to 2000. Velocities and warm impulses carry over. */
cairn_status cairn_world_set_rate(cairn_world *world, cairn_real steps_per_second);
/* Sub-steps a step, 1 to 16. More stand higher and cost more. CAIRN_ERROR_KIND for more than one where the solver has none (solver.h). */
cairn_status cairn_world_set_substeps(cairn_world *world, int substeps);
/* Penetration in metres that is left alone, 0 to 0.1 (default 0; 0.01 with the solvers of solver.h). */
cairn_status cairn_world_set_slop(cairn_world *world, cairn_real slop);
/* Greatest speed at which penetrating bodies are pushed apart, 0 to 100 m/s (default 3). */
cairn_status cairn_world_set_push_out(cairn_world *world, cairn_real speed);
/* The greatest speed per axis in m/s that bodies can have with the present settings; faster ones are cut to it and counted. */
cairn_real cairn_world_speed_limit(const cairn_world *world);

/* Walk all bodies in the order of the pool: start with the null id, call until null. */
cairn_body_id cairn_world_next_body(const cairn_world *world, cairn_body_id id);

/* A hash of all that decides the future: poses, velocities, impulses. Equal on every processor. Fixed point only. */
uint32_t cairn_world_hash(const cairn_world *world);

#ifdef __cplusplus
}
#endif

#endif
