/* What the quick ways of sweep_quick.c make of a pair of bodies, by the path that it takes. */
#ifndef CAIRN_SWEEP_PAIR_H
#define CAIRN_SWEEP_PAIR_H

#include "sweep.h"

/* What a pass makes of a pair. */
typedef struct pair_state {
    cairn_motion linear; /* relative velocity along the normal, */
    cairn_motion before; /* as it was: what it has changed by since are the impulses */
    cairn_motion back_a; /* a's spin, negative */
    cairn_motion spin_b;
    cairn_fine push_a;   /* a's part of the impulses, where it is not all or half */
} pair_state;

/* What the paths stand for; all constants where the passes ask. */
CAIRN_INLINE bool is_even(int path) { return path == CAIRN_PATH_EVEN || path == CAIRN_PATH_EVEN_CENTRAL; }
CAIRN_INLINE bool is_central(int path) { return path == CAIRN_PATH_CENTRAL || path == CAIRN_PATH_EVEN_CENTRAL; }
CAIRN_INLINE bool may_be_apart(int path) { return path != CAIRN_PATH_ON_STATIC && path != CAIRN_PATH_EVEN; }
CAIRN_INLINE bool has_one_point(int path) { return is_central(path) || path == CAIRN_PATH_SINGLE; }
CAIRN_INLINE bool has_two_points(int path) { return CAIRN_MAX_POINTS > 1 && !has_one_point(path); }

CAIRN_INLINE pair_state load(const cairn_body *a, const cairn_body *b)
{
    pair_state pair;
    pair.linear = pair.before = pair.push_a = 0;
    pair.back_a = -a->w;
    pair.spin_b = b->w;
    return pair;
}

/* What a takes of a change of the velocity to one another: in fine units, so that it is rounded once, where the body takes it. */
CAIRN_INLINE cairn_fine part_of_a(const cairn_arbiter *arbiter, cairn_motion change) { return cairn_fine_share(change, arbiter->share_a); }

/* The velocity of a row, of which this is the linear part. */
CAIRN_INLINE cairn_motion velocity(const pair_state *pair, cairn_motion linear, cairn_lever ja, cairn_lever jb, int path)
{
    if (path == CAIRN_PATH_EVEN_CENTRAL) {
        return linear + cairn_motion_lever(pair->spin_b - pair->back_a, jb); /* ja is -jb */
    }
    return linear + (path == CAIRN_PATH_ON_STATIC ? cairn_motion_lever(pair->spin_b, jb) : cairn_motion_levers(pair->spin_b, jb, pair->back_a, ja));
}

/* What an impulse does to the spins; returns a's part. */
CAIRN_INLINE cairn_fine turn(pair_state *pair, const cairn_arbiter *arbiter, cairn_motion change, cairn_lever ja, cairn_lever jb, int path)
{
    if (path == CAIRN_PATH_ON_STATIC) {
        pair->spin_b += cairn_motion_lever(change, jb);
        return 0;
    }
    if (path == CAIRN_PATH_EVEN_CENTRAL) {
        cairn_motion half = cairn_motion_half_lever(change, jb);
        pair->spin_b += half;
        pair->back_a -= half;
        return 0;
    }
    if (is_even(path)) {
        pair->spin_b += cairn_motion_half_lever(change, jb);
        pair->back_a += cairn_motion_half_lever(change, ja);
        return 0;
    }
    cairn_fine of_a = part_of_a(arbiter, change);
    pair->spin_b += cairn_fine_lever(cairn_fine_of(change) - of_a, jb);
    pair->back_a += cairn_fine_lever(of_a, ja);
    return of_a;
}

CAIRN_INLINE void press(pair_state *pair, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion change, int path)
{
    pair->linear += change;
    if (path == CAIRN_PATH_CENTRAL) {
        pair->push_a = part_of_a(arbiter, change);
    } else if (!is_central(path)) {
        pair->push_a += turn(pair, arbiter, change, row->lever_a, row->lever_b, path);
    }
}

/* Store the pair, with impulses along the normal only. */
CAIRN_INLINE void push_apart(const pair_state *pair, cairn_body *a, cairn_body *b, const cairn_arbiter *arbiter, int path)
{
    cairn_dir nx = arbiter->normal_x, ny = arbiter->normal_y;
    cairn_motion push = pair->linear - pair->before;
    if (!is_central(path)) {
        b->w = pair->spin_b;
        if (path != CAIRN_PATH_ON_STATIC) {
            a->w = -pair->back_a;
        }
    }
    if (path == CAIRN_PATH_ON_STATIC) {
        b->vx += cairn_motion_dir(push, nx);
        b->vy += cairn_motion_dir(push, ny);
    } else if (is_even(path)) {
        cairn_motion x = cairn_motion_half_dir(push, nx), y = cairn_motion_half_dir(push, ny);
        a->vx -= x;
        a->vy -= y;
        b->vx += x;
        b->vy += y;
    } else {
        cairn_fine of_b = cairn_fine_of(push) - pair->push_a;
        b->vx += cairn_fine_dir(of_b, nx);
        b->vy += cairn_fine_dir(of_b, ny);
        if (arbiter->share_a != 0) {
            a->vx -= cairn_fine_dir(pair->push_a, nx);
            a->vy -= cairn_fine_dir(pair->push_a, ny);
        }
    }
}

/* Store the pair, with friction's impulse as well: t = (-ny, nx). */
CAIRN_INLINE void finish(pair_state *pair, cairn_body *a, cairn_body *b, const cairn_arbiter *arbiter, cairn_motion rub, int path)
{
    cairn_dir nx = arbiter->normal_x, ny = arbiter->normal_y;
    cairn_motion push = pair->linear - pair->before;
    cairn_fine rub_a = turn(pair, arbiter, rub, arbiter->friction_lever_a, arbiter->friction_lever_b, path);
    b->w = pair->spin_b;
    if (path != CAIRN_PATH_ON_STATIC) {
        a->w = -pair->back_a;
    }
    if (path == CAIRN_PATH_ON_STATIC) {
        b->vx += cairn_motion_along(push, -rub, nx, ny);
        b->vy += cairn_motion_along(rub, push, nx, ny);
    } else if (is_even(path)) {
        cairn_motion x = cairn_motion_half_along(push, -rub, nx, ny), y = cairn_motion_half_along(rub, push, nx, ny);
        a->vx -= x;
        a->vy -= y;
        b->vx += x;
        b->vy += y;
    } else {
        cairn_fine of_b = cairn_fine_of(push) - pair->push_a, rub_b = cairn_fine_of(rub) - rub_a;
        b->vx += cairn_fine_along(of_b, -rub_b, nx, ny);
        b->vy += cairn_fine_along(rub_b, of_b, nx, ny);
        if (arbiter->share_a != 0) {
            a->vx -= cairn_fine_along(pair->push_a, -rub_a, nx, ny);
            a->vy -= cairn_fine_along(rub_a, pair->push_a, nx, ny);
        }
    }
}

#endif
