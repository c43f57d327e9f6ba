/* Show a world: callbacks that say what a thing is, not which colour it has. Any of them may be null. */
#ifndef CAIRN_DEBUG_DRAW_H
#define CAIRN_DEBUG_DRAW_H

#include "quadtree.h"
#include "spring.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum cairn_draw_state {
    CAIRN_DRAW_DYNAMIC,
    CAIRN_DRAW_ASLEEP,
    CAIRN_DRAW_STATIC,
    CAIRN_DRAW_KINEMATIC,
    CAIRN_DRAW_SENSOR
} cairn_draw_state;

typedef struct cairn_debug_draw {
    void *context;
    /* axis: a unit vector that turns with the body */
    void (*circle)(void *context, cairn_body_id body, cairn_draw_state state, cairn_vec2 center, cairn_real radius, cairn_vec2 axis);
    void (*polygon)(void *context, cairn_body_id body, cairn_draw_state state, const cairn_vec2 *corners, int count);
    void (*contact)(void *context, const cairn_contact *contact);
    void (*cell)(void *context, cairn_vec2 lower, cairn_real size, int depth, int bodies);
    void (*spring)(void *context, cairn_spring_id spring, cairn_vec2 a, cairn_vec2 b, cairn_real rest_length);
} cairn_debug_draw;

/* Bodies, in the order of the pool. */
cairn_status cairn_debug_draw_bodies(cairn_world *world, const cairn_debug_draw *draw);
/* Arbiters: points, normals, impulses. */
cairn_status cairn_debug_draw_contacts(cairn_world *world, const cairn_debug_draw *draw);
/* Leaves of the quadtree as of the last step; nothing if there is none. */
cairn_status cairn_debug_draw_cells(cairn_world *world, const cairn_debug_draw *draw);
cairn_status cairn_debug_draw_springs(cairn_world *world, const cairn_debug_draw *draw);

#ifdef __cplusplus
}
#endif

#endif
