/*
 * What the parts of the impact phase share: bounce.c goes through the pairs, bounce_meet.c finds when and where two meet, bounce_strike.c
 * gives the impulses.
 */
#ifndef CAIRN_BOUNCE_H
#define CAIRN_BOUNCE_H

#include "engine.h"

/* Bodies that lie deeper than this in one another when they hit are moved apart. Less is left: it costs angular momentum. */
#define CAIRN_IMPACT_DEEP CAIRN_MOTION(0.005)
/* A pair that turns by more than this in a sub-step, m at the radius of gyration, is looked at again while near. */
#define CAIRN_IMPACT_TURNING CAIRN_OFFSET(0.001)

/* The sum of a pair's impulses as the warm start repeats them: on b, and the turning of each. */
typedef struct cairn_repeated {
    cairn_motion x, y, turn_a, turn_b;
} cairn_repeated;

typedef struct cairn_impact {
    cairn_arbiter *arbiter;
    cairn_body *a, *b;
    cairn_factor restitution;
    cairn_factor norm;       /* the rounded normal's own square */
    cairn_motion rest;       /* what closes slower does not rebound: the threshold, or what gravity gives in a sub-step */
    cairn_motion gx, gy;     /* gravity's change of the relative velocity in a sub-step; nothing where both fall alike */
    cairn_motion closing[2]; /* speed at the moment of the impact; 0: this point does not take part */
    cairn_motion px, py;     /* sum of the impulses on b */
    cairn_motion depth;      /* of the point that hits, at that moment */
    cairn_offset x, y;       /* how far b had moved to a in this step when the rows were looked at */
    cairn_unit time;         /* in sub-steps from this one's start; may lie a little beyond its end */
    bool adopted;            /* the rows were made within the step, by a look ahead or by the impact itself; those before held: */
    cairn_repeated before;
    cairn_lean lean;         /* by how much the normal was rounded, where it tells */
    bool changed;            /* its path through the sweeps may be another one */
    int substep;
} cairn_impact;

static inline cairn_motion cairn_impact_velocity(const cairn_impact *i, cairn_dir nx, cairn_dir ny, cairn_lever ja, cairn_lever jb)
{
    return cairn_motion_along(i->b->vx - i->a->vx, i->b->vy - i->a->vy, nx, ny) + cairn_motion_lever(i->b->w, jb) - cairn_motion_lever(i->a->w, ja);
}

static inline cairn_motion cairn_impact_row_velocity(const cairn_impact *i, const cairn_row *row)
{
    return cairn_impact_velocity(i, i->arbiter->normal_x, i->arbiter->normal_y, row->lever_a, row->lever_b);
}

/* Gravity's pull along the approach. */
static inline cairn_motion cairn_impact_pull(const cairn_impact *i) { return -cairn_motion_along(i->gx, i->gy, i->arbiter->normal_x, i->arbiter->normal_y); }

/* ---- bounce_meet.c ---- */
/* A pair that turns while near gets the rows of where it will be at the end of this sub-step. */
void cairn_impact_refresh(cairn_world *world, cairn_impact *i);
/* Do the rows as they are say that some point hits in this sub-step? About when the first one does. */
bool cairn_impact_foresee(cairn_impact *i);
/* Finds the contact at the moment of the impact, and the moment exactly; false if the two miss in this sub-step. */
bool cairn_impact_meet(cairn_world *world, cairn_impact *i);
/* Hands rows that were made within the step to the sweeps. */
void cairn_impact_hand_back(cairn_impact *i);

/* ---- bounce_strike.c ---- */
/* The impact, and what follows from it. */
void cairn_impact_rebound(cairn_world *world, cairn_impact *i);

#endif
