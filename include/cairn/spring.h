/*
 * Springs: Hooke's law with damping along the line between two anchors, F = -k (L - L0) u - c (v . u) u.
 * Bodies farther apart than 500 m on an axis are pulled as if they were so near.
 * Any stiffness stays bounded: stiff springs are solved implicitly, a lone spring by the exact map of the oscillator.
 * A spring of no rest length is a pin: it pulls and damps along both axes, and stiff ones hold two points together, as a hinge (spring_path.c).
 * Networks held in shape by diagonals hang as statics say, at any stiffness, with cairn_meshes_enable (spring_mesh.h).
 */
#ifndef CAIRN_SPRING_H
#define CAIRN_SPRING_H

#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cairn_spring_id {
    uint16_t index; /* place in the pool plus one; 0 is null */
    uint16_t generation;
} cairn_spring_id;

typedef struct cairn_spring_def {
    cairn_body_id a, b;
    cairn_vec2 anchor_a, anchor_b; /* in the frames of the bodies, m; each within 125 along x and y */
    cairn_real rest_length;        /* m, 0 to 500; 0: a pin; negative: the distance of the anchors now */
    cairn_wide stiffness;          /* N/m, 0 to 1e9 */
    cairn_wide damping;            /* N s/m, 0 to 1e9 */
    bool no_contact;               /* the two bodies do not collide with one another */
} cairn_spring_def;

/* The layout is the engine's own. */
typedef struct cairn_spring {
    /* small numbers first, for a Cortex-M0 reaches 32 half words and 32 words from where a pointer points */
    uint16_t a, b; /* body indices, in the order of its path: see CAIRN_SPRING_TURNED */
    uint16_t next, previous; /* on its path; of a path's first, previous is the first of the next path */
    cairn_frame frame;                  /* otherwise x and y alone: in which it lies at the end of the sub-step */
    uint8_t lag;                        /* how far behind that it pushes */
    cairn_dir direction_x, direction_y; /* from a to b, in which it pushes */
    cairn_gain pull, drag;              /* what an elongation and a speed make of half a pull; pull is 0: not to be used */
    cairn_swing swing, swung;           /* from the frame to where it lies at the end of this sub-step, and of the one before */
    cairn_part take;                    /* what it takes of half the pull of the spring before */
    cairn_ratio give, keep;             /* of half the pull of the one behind, and of its own in the sweep before */
    uint16_t flags, generation;
    cairn_lever lever_a, lever_b;
    uint16_t network, across;           /* the network, and a spring of another of its paths at one end */
    uint16_t bucket, link_a, link_b;    /* which springs end at which body, see spring_ends.c */

    cairn_motion origin_x, origin_y;    /* where the step began, from where the frame was made */
    cairn_stretch elongation;           /* where the frame was made */
    cairn_motion pulled;                /* half of what it has pulled with; during a sweep what the sweep needs */
    cairn_share share_a, share_b;
    union {
        struct {
            cairn_real x, y;            /* from a to b where the frame was made */
        } frame;
        struct {
            cairn_packed stiffness, damping; /* of a pin, in the units of a sub-step: b e and d e of spring_map.c */
            cairn_motion strain;             /* how far apart its points were in the last sub-step, or its pull, if that is more */
        } pin;
    } made;
    cairn_offset rest_length;
    /* the map of a sub-step, see spring_map.c */
    cairn_share velocity_gain;
    cairn_share yield; /* exact: the gain of gravity; implicit: 1 / (1 + b + d) */
    /* the factors of its path */
    cairn_factor before, behind, inverse_pivot;
    cairn_turn turned; /* of a path's first: by how much its springs have turned since these were made, at most */
    cairn_wide position_gain;
    cairn_offset2 anchor_a, anchor_b; /* from the centres of mass, body frame */
    cairn_packed stiffness, damping;
} cairn_spring;

struct cairn_spring_class;

typedef struct cairn_spring_pool {
    const struct cairn_spring_class *kind;
    cairn_spring *springs;
    uint16_t capacity, end;
    uint16_t first; /* path's first spring */
    uint16_t mask;  /* see spring_ends.c */
    bool changed;   /* the springs' maps have to be made anew */
    bool entangled; /* a network is, see spring_network.c */
    struct cairn_mesh *mesh; /* null unless enabled, see spring_mesh.h */
} cairn_spring_pool;

typedef struct cairn_spring_storage {
    cairn_spring_pool *pool;
    cairn_spring *springs;
    uint16_t capacity;
} cairn_spring_storage;

/* Declare, at file scope, the memory for so many springs. */
#define CAIRN_SPRINGS(name, count) \
    static cairn_spring_pool name##_pool; \
    static cairn_spring name##_springs[count]; \
    static const cairn_spring_storage name = { &name##_pool, name##_springs, (count) }

/* Bytes of RAM that it takes, a constant expression. */
#define CAIRN_SPRINGS_BYTES(count) (sizeof(cairn_spring_pool) + (count) * sizeof(cairn_spring))

static inline cairn_spring_id cairn_spring_id_null(void)
{
    cairn_spring_id id;
    id.index = 0;
    id.generation = 0;
    return id;
}
static inline bool cairn_spring_id_is_null(cairn_spring_id id) { return id.index == 0; }

/* Give a world memory for springs; once per world, before the first spring. */
cairn_status cairn_springs_enable(cairn_world *world, const cairn_spring_storage *storage);

/* A spring from centre to centre at its rest length, without stiffness or damping. */
static inline cairn_spring_def cairn_spring_def_default(cairn_body_id a, cairn_body_id b)
{
    cairn_spring_def def;
    def.a = a;
    def.b = b;
    def.anchor_a = cairn_vec2_of(0, 0);
    def.anchor_b = cairn_vec2_of(0, 0);
    def.rest_length = CAIRN_F(-1);
    def.stiffness = cairn_wide_zero();
    def.damping = cairn_wide_zero();
    def.no_contact = false;
    return def;
}

/*
 * Set stiffness and damping so that the pair of bodies would oscillate along the spring at this frequency (Hz, above 0
 * to 1000) with this damping ratio (0 to 100). CAIRN_ERROR_KIND if neither body is dynamic.
 */
cairn_status cairn_spring_tune(cairn_world *world, cairn_spring_def *def, cairn_real frequency, cairn_real damping_ratio);

/*
 * Make a spring. Null id on error: a null or stale argument, a number out of range, a equal to b, a full pool, springs
 * not enabled (CAIRN_ERROR_KIND). Two bodies that do not move are allowed: the spring then does nothing. Coinciding
 * anchors push along the world's x axis.
 */
cairn_spring_id cairn_spring_create(cairn_world *world, const cairn_spring_def *def);
cairn_status cairn_spring_destroy(cairn_world *world, cairn_spring_id id);
bool cairn_spring_exists(const cairn_world *world, cairn_spring_id id);
/* Distance of the anchors now, m. */
cairn_real cairn_spring_length(cairn_world *world, cairn_spring_id id);
/* Change what an existing spring pulls with. */
cairn_status cairn_spring_set(cairn_world *world, cairn_spring_id id, cairn_real rest_length, cairn_wide stiffness, cairn_wide damping);
/* Where the two anchors are in the world. */
cairn_status cairn_spring_anchors(cairn_world *world, cairn_spring_id id, cairn_vec2 *a, cairn_vec2 *b);
/* Walk all springs: start with the null id, call until null. */
cairn_spring_id cairn_world_next_spring(const cairn_world *world, cairn_spring_id id);

#ifdef __cplusplus
}
#endif

#endif
