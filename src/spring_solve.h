/*
 * What the files of springs share: spring.c (the pool and the game's calls) -> spring_solve.c (step and sub-step)
 * -> spring_map.c (one spring), spring_ends.c, spring_network.c, spring_path.c and spring_quick.c (many), spring_reach.c (where they are).
 */
#ifndef CAIRN_SPRING_SOLVE_H
#define CAIRN_SPRING_SOLVE_H

#include "engine.h"
#include <cairn/spring.h>

/* spring.flags */
enum {
    CAIRN_SPRING_USED = 1,
    CAIRN_SPRING_NO_CONTACT = 2,
    CAIRN_SPRING_FRESH = 4,      /* has not pulled yet */
    CAIRN_SPRING_EXACT = 8,      /* solved by the exact map, alone */
    CAIRN_SPRING_HEAD = 16,      /* the first of a path */
    CAIRN_SPRING_IN_PATH = 32,
    CAIRN_SPRING_TURNED = 64,    /* its path goes from the b of its definition to the a: they have changed places */
    CAIRN_SPRING_ENTANGLED = 128, /* of a network's first: its paths pull along one another */
    CAIRN_SPRING_LEVERS = 256,    /* of a path's first: some anchors are off their centres */
    CAIRN_SPRING_MESHED = 512,    /* of a network's first: solved as a whole */
    CAIRN_SPRING_PLAIN = 1024,    /* from centre to centre of bodies that may shift or are at rest */
    CAIRN_SPRING_SIMPLE = 2048,   /* of a path's first: all of them are plain */
    CAIRN_SPRING_FRAMED = 4096,   /* of a path's first: they have frames, see spring_quick.c */
    CAIRN_SPRING_OFF_CENTRE = 8192, /* an anchor of it is */
    CAIRN_SPRING_PIN = 16384,       /* has no rest length: holds two points together, see cairn_path_solve() */
    CAIRN_SPRING_PINNED = 32768     /* of a network's first: some of its springs are pins */
};

static inline bool cairn_spring_is_used(const cairn_spring *spring) { return (spring->flags & CAIRN_SPRING_USED) != 0; }
static inline bool cairn_spring_is_pin(const cairn_spring *spring) { return CAIRN_WITH_PINS && (spring->flags & CAIRN_SPRING_PIN) != 0; }
static inline bool cairn_spring_is_off_centre(const cairn_spring *spring) { return (spring->flags & CAIRN_SPRING_OFF_CENTRE) != 0; }
static inline bool cairn_body_is_free_to_shift(const cairn_body *body)
{
    return cairn_body_is_dynamic(body) && !(body->flags & CAIRN_BODY_FIXED_POSITION);
}

/*
 * Pulls in this step: an end of it is dynamic and awake. Which stands for all that hangs together by springs, for that sleeps and wakes as a whole.
 * A platform that stands still is awake, but what hangs on it may sleep: nobody would take the pull back from a velocity that is not used.
 */
static inline bool cairn_body_is_pulled(const cairn_body *body)
{
    return (body->flags & (CAIRN_BODY_USED | CAIRN_BODY_ASLEEP | CAIRN_BODY_TYPE)) == (CAIRN_BODY_USED | CAIRN_DYNAMIC);
}
static inline bool cairn_spring_is_active(const cairn_world *world, const cairn_spring *spring)
{
    return cairn_body_is_pulled(&world->bodies[spring->a]) || cairn_body_is_pulled(&world->bodies[spring->b]);
}

/* The spring behind one on its path, null if there is none. */
static inline cairn_spring *cairn_spring_behind(const cairn_spring_pool *pool, const cairn_spring *spring)
{
    return spring->next == CAIRN_NONE ? NULL : &pool->springs[spring->next];
}

/* The farthest that bodies may be apart on one axis, m; beyond it a spring pulls as if they were so near. */
#define CAIRN_SPRING_FAR CAIRN_F(500)

/* ---- spring_ends.c ---- */
/* Which springs end where: after any change, before the two below. */
void cairn_spring_find_ends(cairn_spring_pool *pool);
/* The springs that end at a body, in the order of the pool, up to CAIRN_NONE. */
uint16_t cairn_spring_first_at(const cairn_spring_pool *pool, uint16_t body);
uint16_t cairn_spring_next_at(const cairn_spring_pool *pool, uint16_t body, uint16_t spring);

/* ---- spring_reach.c ---- */

/* Where a spring is. */
typedef struct cairn_reach {
    cairn_offset2 arm_a, arm_b; /* from the centres of mass, in the world */
    cairn_unit x, y;            /* direction from the anchor of a to that of b */
    cairn_offset length;
} cairn_reach;

/* With the displacements of this step. */
void cairn_spring_measure(const cairn_spring *spring, const cairn_body *a, const cairn_body *b, cairn_reach *reach);
/* (arm x n) / rho */
cairn_lever cairn_spring_lever(const cairn_body *body, cairn_offset2 arm, cairn_unit x, cairn_unit y);
/* Keep direction and levers for the sweeps. */
void cairn_spring_point(cairn_spring *spring, const cairn_body *a, const cairn_body *b, const cairn_reach *reach);
/*
 * Direction and levers for this sub-step; the length is that at the end of it. How far it turns, levers included.
 * Ahead: along the direction foreseen in any case.
 */
cairn_offset cairn_spring_aim(cairn_spring *spring, const cairn_body *a, const cairn_body *b, bool ahead, cairn_turn *turned);

/* Of a pin, along the world's x axis or upright: how far apart the two points will be; its levers, unless they are to stay. */
cairn_offset cairn_spring_aim_along(cairn_spring *spring, const cairn_body *a, const cairn_body *b, bool upright, bool stays);

/* A spring that turns faster than this in a sub-step, rad. */
#define CAIRN_SPRING_FAST CAIRN_TURN(0.03)

/*
 * Which way a spring pushes. Along the foreseen direction a spring that turns fast, or that a strong pull swings fast, gains no energy; but
 * it takes away of any swing, (turn in a sub-step)^2 each time. So the others push along a direction only a quarter of the way from that
 * at the start to the one foreseen. A spring is taut if its pull would swing it about itself with (w h)^2 beyond about 1 / 64.
 */
static inline bool cairn_spring_is_taut(const cairn_spring *spring, cairn_offset length)
{
    cairn_motion most = cairn_motion_64th(length);
    return 2 * spring->pulled > most || -2 * spring->pulled > most;
}

/* ---- spring_map.c ---- */
void cairn_spring_map(const cairn_world *world, cairn_spring *spring);
/* Of a pin, by the levers of its axis. */
void cairn_spring_map_pin(const cairn_world *world, cairn_spring *pin);
/* Does no other spring end at either of them, as far as they move? */
bool cairn_spring_is_alone(const cairn_body *a, const cairn_body *b);
/* Take over the map of another spring, if it is the same. */
bool cairn_spring_map_as(const cairn_world *world, cairn_spring *spring, const cairn_spring *model);
/* e: the effective mass over the reduced one */
cairn_factor cairn_spring_mass(const cairn_world *world, const cairn_spring *spring);

/* ---- spring_path.c ---- */
/* The cosine of the angle between two springs, each from its a to its b. */
cairn_unit cairn_spring_cosine(const cairn_spring *s, const cairn_spring *t);
/* Cut all networks into paths. */
void cairn_spring_paths(cairn_world *world);
/* What of a path's solution depends on directions only. */
void cairn_path_factorise(cairn_world *world, cairn_spring *first);
/* The springs of a path, together; again: after another sweep in this sub-step. */
void cairn_path_solve(cairn_world *world, cairn_spring *first, bool again);
/* No impulse of a path is above this, no demand above CAIRN_DEMAND_MAX, m per sub-step: with factors of at most 1 no sum wraps. */
#define CAIRN_SPRING_IMPULSE CAIRN_MOTION(3.5)
#define CAIRN_SPRING_DEMAND CAIRN_MOTION(4)
/* A demand with what a spring yields to the pull of the sweep before. As B + D + yield is 1, the sum is no greater than the greatest of the three. */
cairn_motion cairn_spring_ask_more(const cairn_spring *spring, cairn_motion demand);
/* The impulse that meets a demand, after the one that the spring before on the path takes. */
cairn_motion cairn_spring_answer(const cairn_spring *spring, cairn_motion demand, cairn_motion before);
/* x and y more, both within 2 CAIRN_SPRING_IMPULSE, so that no sum wraps when two springs push at once: 7 + CAIRN_SWEEP_SPEED < 8. */
void cairn_spring_shift(cairn_body *body, cairn_motion x, cairn_motion y);
cairn_motion cairn_spring_speed(const cairn_spring *spring, const cairn_body *a, const cairn_body *b);
/* Add a velocity change to a body, and to the velocity that the warm start compares with. */
void cairn_spring_push(cairn_body *body, cairn_motion x, cairn_motion y, cairn_motion turn);

/* ---- spring_quick.c: paths of plain springs ---- */
/* When springs have changed: which paths are such. */
void cairn_path_look(cairn_world *world, cairn_spring *first);
/* At the start of a step; false if the path is none, or has to be solved with care. */
bool cairn_path_follow(cairn_world *world, cairn_spring *first);
/* The sub-step of a path that is framed. */
void cairn_path_solve_quickly(cairn_world *world, cairn_spring *first, bool again);

/* ---- spring_network.c ---- */
/* Which springs belong together. After the paths. */
void cairn_spring_networks(cairn_world *world);
/* Which networks have become entangled; true if one did. */
bool cairn_spring_entangle(cairn_world *world);

/* ---- spring_mesh.c, through the class so that worlds without meshes do not link it ---- */
typedef struct cairn_mesh_class {
    void (*make)(cairn_world *world); /* of the entangled networks */
    void (*solve)(cairn_world *world, int substep);
} cairn_mesh_class;

/* ---- spring_solve.c ---- */
void cairn_springs_prepare(cairn_world *world);
void cairn_springs_substep(cairn_world *world, int substep);

#endif
