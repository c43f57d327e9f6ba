/* How the runner follows and prints the engine's numbers: exact integers in fixed point, 17 digits in double. */
#ifndef CAIRN_RUNNER_NUMBER_H
#define CAIRN_RUNNER_NUMBER_H

#include <cairn/cairn.h>

#include "cairn_print.h"

#ifdef CAIRN_DOUBLE

#include <stdio.h>

typedef double runner_turn; /* radians */

static inline void runner_print_double(double x)
{
    char text[32];
    snprintf(text, sizeof text, "%.17g", x);
    cairn_print_text(text);
}
static inline void runner_print_real(cairn_real x) { runner_print_double(x); }
static inline void runner_print_turn(runner_turn x) { runner_print_double(x); }
static inline runner_turn runner_turn_on(runner_turn turn, cairn_angle from, cairn_angle to) { return turn + (to - from); }

/* FNV-1a over the bits of all poses and velocities: the engine's own hash is of fixed point only. */
static inline uint32_t runner_hash_on(uint32_t hash, double x)
{
    unsigned char bytes[sizeof x];
    memcpy(bytes, &x, sizeof x);
    for (size_t i = 0; i < sizeof x; i++) {
        hash = (hash ^ bytes[i]) * 16777619u;
    }
    return hash;
}
static inline uint32_t runner_hash(cairn_world *world)
{
    uint32_t hash = 2166136261u;
    for (cairn_body_id id = cairn_world_next_body(world, cairn_body_id_null()); !cairn_body_id_is_null(id);
         id = cairn_world_next_body(world, id)) {
        const cairn_vec2 position = cairn_body_position(world, id);
        const cairn_vec2 velocity = cairn_body_velocity(world, id);
        hash = runner_hash_on(runner_hash_on(hash, position.x), position.y);
        hash = runner_hash_on(runner_hash_on(hash, velocity.x), velocity.y);
        hash = runner_hash_on(runner_hash_on(hash, cairn_body_angle(world, id)), cairn_body_angular_velocity(world, id));
    }
    return hash;
}

#else

typedef int64_t runner_turn; /* 2^-32 turns */

static inline void runner_print_real(cairn_real x) { cairn_print_i32(x); }
static inline void runner_print_turn(runner_turn x) { cairn_print_i64(x); }
/* The shorter way round: no body turns by half a turn in a step. */
static inline runner_turn runner_turn_on(runner_turn turn, cairn_angle from, cairn_angle to)
{
    return turn + (int32_t)((uint32_t)to - (uint32_t)from);
}
static inline uint32_t runner_hash(cairn_world *world) { return cairn_world_hash(world); }

#endif

#endif
