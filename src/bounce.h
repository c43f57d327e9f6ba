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

/* The line that an impulse acts along: its direction, and its levers on both bodies. */
typedef struct cairn_line {
    cairn_dir x, y;
    cairn_lever lever[2];
} cairn_line;

/* How the two have moved in this step: centre against centre, and each by turning. */
typedef struct cairn_course {
    cairn_offset x, y, turn_a, turn_b;
} cairn_course;

typedef struct cairn_velocity {
    cairn_motion x, y, w;
} cairn_velocity;

typedef struct cairn_impact {
    cairn_arbiter *arbiter;
    cairn_body *body[2];
    bool adopted;            /* the rows were made within the step, by a look ahead or by the impact itself */
    bool changed;            /* its path through the sweeps may be another one */
    cairn_lean lean;         /* by how much the normal was rounded, where it tells */
    int substep;
    cairn_factor restitution;
    cairn_motion rest;       /* what closes slower does not rebound: the threshold, or what gravity gives in a sub-step */
    cairn_motion gx, gy;     /* gravity's change of the relative velocity in a sub-step; nothing where both fall alike */
    cairn_unit time;         /* in sub-steps from this one's start; may lie a little beyond its end */
    cairn_course course;     /* until the contact was looked at */
    cairn_motion depth;      /* of the point that hits, at that moment */
    cairn_motion closing[2]; /* speed at the moment of the impact; 0: this point does not take part */
    cairn_repeated before;   /* by the rows that were there before those were adopted */
    cairn_share share[2];    /* of a change of the relative velocity */
    cairn_factor linear;     /* what an impulse along the rounded normal changes along it but for turning */
    cairn_motion px, py;     /* sum of the impulses on b */
} cairn_impact;

CAIRN_SHARED cairn_line cairn_impact_line(const cairn_impact *i, int k)
{
    const cairn_arbiter *arbiter = i->arbiter;
    const cairn_row *row = &arbiter->rows[k];
    cairn_line line;
    line.x = arbiter->normal_x;
    line.y = arbiter->normal_y;
    line.lever[0] = row->lever_a;
    line.lever[1] = row->lever_b;
    return line;
}

CAIRN_SHARED cairn_motion cairn_impact_velocity(const cairn_impact *i, const cairn_line *line)
{
    const cairn_body *a = i->body[0], *b = i->body[1];
    return cairn_motion_along(b->vx - a->vx, b->vy - a->vy, line->x, line->y) + cairn_motion_lever(b->w, line->lever[1])
         - cairn_motion_lever(a->w, line->lever[0]);
}

/* Gravity's pull along the approach. */
CAIRN_SHARED cairn_motion cairn_impact_pull(const cairn_impact *i) { return -cairn_motion_along(i->gx, i->gy, i->arbiter->normal_x, i->arbiter->normal_y); }

/* ---- bounce_meet.c ---- */
/* A pair that turns while near gets the rows of where it will be at the end of this sub-step. */
void cairn_impact_refresh(cairn_world *world, cairn_impact *i);
/* Do the rows as they are say that some point hits in this sub-step? About when the first one does. */
bool cairn_impact_foresee(cairn_impact *i);
/* Finds the contact at the moment of the impact, and the moment exactly; false if the two miss in this sub-step. */
bool cairn_impact_meet(cairn_world *world, cairn_impact *i);
/* How fast a point closes at the time of the impact; 0 if that is too slow to rebound. */
cairn_motion cairn_impact_closing(const cairn_impact *i, const cairn_line *line);
/* Has the warm start repeat so much less of a body's change, v - u. */
void cairn_body_repeat_less(cairn_body *body, cairn_motion x, cairn_motion y, cairn_motion turn);
/* Hands rows that were made within the step to the sweeps. */
void cairn_impact_hand_back(cairn_impact *i);

/* ---- bounce_strike.c ---- */
/* The impact, and what follows from it. */
void cairn_impact_rebound(cairn_world *world, cairn_impact *i);

#endif
