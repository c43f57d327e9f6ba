/*
 * An arbiter is all there is to know of one pair's collision. It lives from the step in which the pair comes within
 * reach until the step in which it leaves it, and keeps the impulses from step to step (warm starting).
 */
#ifndef CAIRN_ARBITER_H
#define CAIRN_ARBITER_H

#include "body.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One contact point's row. Impulses are in sub-step units: impulse * h * (1/mA + 1/mB), see DESIGN.md. */
typedef struct cairn_row {
    cairn_motion impulse; /* accumulated, never negative */
    cairn_motion load;    /* the part of it that has rested here for long and does not sink in any more, see hold.c */
    cairn_motion gap;     /* at the start of the step: the separation where positive, else the push-out per sub-step */
    cairn_lever lever_a, lever_b;
    cairn_ratio mass;      /* effective mass over the reduced mass */
    uint16_t feature;      /* which corner meets which edge: matches points from step to step */
} cairn_row;

/* In 80 bytes, what the sweeps read within reach of short load instructions. */
typedef struct cairn_arbiter {
    uint8_t count; /* contact points: 0 to 2 */
    uint8_t flags;
    uint8_t block; /* see block.c: the number of its block, and whether the masses differ much */
    uint8_t path;  /* which way the sweeps take in this step, see sweep.c */
    uint16_t a, b; /* indices of the bodies; the normal points from a to b */
    cairn_dir normal_x, normal_y;
    cairn_row rows[CAIRN_MAX_POINTS];
    cairn_motion friction_impulse; /* accumulated, along (-normal_y, normal_x) */
    cairn_lever friction_lever_a, friction_lever_b; /* where a is static, and never turns, the first is a cairn_lean: of the normal */
    cairn_ratio friction_mass;
    uint16_t after; /* the slot of the arbiter whose pair was found next, see arbiter.c */
    cairn_factor kinetic_friction;
    cairn_share share_a; /* (1/m) / (1/mA + 1/mB): what a takes of a relative velocity change; b takes the rest */
    cairn_motion slip;   /* of two points, how far the surfaces have slipped since they stuck; see hold.c */
    union {
        struct {
            cairn_heading a, b; /* of the bodies when the rows were made */
        } heading;
        struct {
            uint16_t a, b; /* of one point: how far turning may move the surface, in ways of the radius of gyration */
        } swept;
        struct {
            uint16_t mark;    /* tells whether the block is the one of the step before */
            uint8_t exponent; /* of all its impulses: times 2^exponent */
        } block;              /* in a block, where rows do not hold */
    } past;
} cairn_arbiter;

typedef struct cairn_contact_point {
    cairn_vec2 position;   /* in the world, between the two surfaces, m */
    cairn_real separation; /* m, negative when penetrating */
    cairn_real impulse;    /* along the normal in the last sub-step, N s */
} cairn_contact_point;

/* A collision as a game sees it. */
typedef struct cairn_contact {
    cairn_body_id a, b;
    cairn_vec2 normal; /* unit, from a to b */
    int count;
    cairn_contact_point points[2];
    bool touching; /* the shapes touch, or pushed one another in this step; else they are merely near */
    bool began;    /* and did not in the step before */
    bool sensor;   /* one of them is a sensor */
} cairn_contact;

/*
 * Walk all contacts: start with *cursor = 0, call until false. Between two calls the world may not change.
 * Positions and separations are those of the bodies' present poses.
 */
bool cairn_world_next_contact(struct cairn_world *world, int *cursor, cairn_contact *contact);

/* Walk the bodies that this one touched in the last step: start with *cursor = 0, call until false. */
bool cairn_body_next_touched(struct cairn_world *world, cairn_body_id id, int *cursor, cairn_body_id *other);

#ifdef __cplusplus
}
#endif

#endif
