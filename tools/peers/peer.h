/*
 * What an engine's adapter gives to the runner (main.c), and the scene that adapters of engines in floating point build.
 * tools/cairn_tools/peers.py writes the scene from the JSON file; Cairn's own adapter has the table of `tools/cairn table`.
 */
#ifndef CAIRN_PEER_H
#define CAIRN_PEER_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { PEER_CORNERS = 8 };

typedef struct peer_vec {
    float x, y;
} peer_vec;

/* A circle where count is 0, else a convex polygon, anticlockwise. The centre is that of its area. */
typedef struct peer_shape {
    float radius;
    int count;
    peer_vec corners[PEER_CORNERS];
    peer_vec centre;
} peer_shape;

/* The friction of a pair is the geometric mean of its bodies', its restitution the larger. */
typedef struct peer_body {
    uint16_t shape, layer, mask;
    bool is_static, fixed_rotation;
    peer_vec position, velocity;
    float angle, angular_velocity;
    float mass, inertia; /* the inertia about the centre */
    float friction, restitution;
} peer_body;

typedef struct peer_spring {
    uint16_t a, b;
    bool collide;
    peer_vec anchor_a, anchor_b;
    float rest_length, stiffness, damping;
} peer_spring;

typedef struct peer_scene {
    peer_vec gravity;
    float step; /* seconds */
    int shape_count, body_count, spring_count;
    const peer_shape *shapes;
    const peer_body *bodies;
    const peer_spring *springs;
} peer_scene;

extern const peer_scene peer_the_scene;
/* Room for the adapter to keep each body's pointer; peers.py takes it off the image's memory. */
extern void *peer_handles[];

/* A position in 2^-16 m and an angle in 2^-16 radians; PEER_LOST where one is no number or out of range. */
typedef struct peer_place {
    int32_t x, y, angle;
} peer_place;

/* What a run asks for in place of the scene's and the engine's own; 0: nothing. Cairn's are in its table. */
typedef struct peer_wish {
    int iterations;
    float step; /* seconds */
} peer_wish;

#define PEER_LOST INT32_MIN

static inline int32_t peer_fixed(float metres)
{
    /* Written so that NaN is lost too. */
    return metres > -32000.0f && metres < 32000.0f ? (int32_t)(metres * 65536.0f) : PEER_LOST;
}

/* ---- an adapter ---- */

/* Builds the scene; false if the engine refused a part of it. */
bool peer_build(peer_wish wish);
void peer_step(void);
int peer_body_count(void);
peer_place peer_body_place(int body);
/* Bytes of the engine's fixed memory that the last step did without; 0 where memory comes from the heap. */
uint32_t peer_spare(void);

/* ---- what lies under an engine: newlib.c and constructors.c on a board, host/host.c on the host ---- */

/* The most bytes that malloc() ever took; 0 where it is not counted. */
uint32_t peer_heap_used(void);
/* What steps are timed by: on a board its own clock, on the host nanoseconds of the program's own time. */
uint32_t peer_clock(void);
/* Runs the constructors of C++ where the start files do not. */
void peer_construct(void);

#ifdef __cplusplus
}
#endif

#endif
