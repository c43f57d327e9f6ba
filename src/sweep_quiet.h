/*
 * One point of a quiet pair, in products of 32 bits: the same bits as the way of sweep_quick.c for any bodies, for cores without a long
 * multiply, where a product then takes half of the instructions. Quiet is what has speeds and spins below QUIET = 2^12 units (3.7 mm/s with 4
 * sub-steps), and whose point touched when the step began. With |j| <= 2 a row's velocity is at most (2 sqrt(2) + 4) QUIET, its change no
 * more, and from it a spin changes by half of that at most, since a j / (1 + a j^2) <= 1/2 for a share a <= 1. So friction's velocity is
 * below (2 sqrt(2) + 4 (1 + 3.42)) QUIET = 2^16.4, whose product with a mass of at most 1 fits; and so do those of an impulse's change below
 * CHANGE, of which all parts are below 2^15 in fine units. A greater one goes on by the wider products.
 */
#ifndef CAIRN_SWEEP_QUIET_H
#define CAIRN_SWEEP_QUIET_H

#include "sweep_pair.h"

#define QUIET (CAIRN_QUIET / 8)
#define CHANGE (CAIRN_QUIET / 2)
/* What a push-out may be, that the product of its sum with the velocity fits. */
#define QUIET_PUSH (CAIRN_QUIET * 2)

/* Does this size of the pair's motion, and this gap, let it go the quick way? */
CAIRN_INLINE bool is_quiet(cairn_size size, cairn_motion gap) { return CAIRN_KNOWS_QUIET && cairn_size_is_below(size, QUIET) && gap <= 0 && gap >= -QUIET_PUSH; }
CAIRN_INLINE bool is_small(cairn_motion change) { return change < CHANGE && change > -CHANGE; }

/* What goes on by the wider products. */
CAIRN_APART void push_single(const pair_state *quiet, cairn_body *a, cairn_body *b, const cairn_arbiter *arbiter, cairn_motion change)
{
    pair_state pair = *quiet;
    press(&pair, arbiter, &arbiter->rows[0], change, CAIRN_PATH_SINGLE);
    push_apart(&pair, a, b, arbiter, CAIRN_PATH_SINGLE);
}
CAIRN_APART void finish_single(const pair_state *quiet, cairn_body *a, cairn_body *b, const cairn_arbiter *arbiter, cairn_motion rub)
{
    pair_state pair = *quiet;
    finish(&pair, a, b, arbiter, rub, CAIRN_PATH_SINGLE);
}

CAIRN_INLINE cairn_motion quiet_velocity(const pair_state *pair, cairn_motion linear, cairn_lever ja, cairn_lever jb)
{
    return linear + cairn_quiet_levers(pair->spin_b, jb, pair->back_a, ja);
}

/* What an impulse does to the spins; returns a's part. */
CAIRN_INLINE cairn_fine quiet_turn(pair_state *pair, const cairn_arbiter *arbiter, cairn_motion change, cairn_lever ja, cairn_lever jb)
{
    cairn_fine of_a = cairn_quiet_share(change, arbiter->share_a);
    pair->spin_b += cairn_quiet_fine_lever(cairn_fine_of(change) - of_a, jb);
    pair->back_a += cairn_quiet_fine_lever(of_a, ja);
    return of_a;
}

CAIRN_INLINE void quiet_biased(cairn_body *a, cairn_body *b, cairn_arbiter *arbiter)
{
    cairn_row *row = &arbiter->rows[0];
    cairn_dir nx = arbiter->normal_x, ny = arbiter->normal_y;
    pair_state pair = load(a, b);
    cairn_motion u = quiet_velocity(&pair, cairn_quiet_along(b->vx - a->vx, b->vy - a->vy, nx, ny), row->lever_a, row->lever_b);
    cairn_motion old = row->impulse, rigid = old - cairn_quiet_ratio(u + row->gap, row->mass);
    cairn_motion impulse = cairn_motion_above_zero(cairn_softened(rigid, row->load), CAIRN_IMPULSE_MAX), change = impulse - old;
    row->impulse = impulse;
    if (!is_small(change)) {
        pair_state wide = pair;
        push_single(&wide, a, b, arbiter, change);
        return;
    }
    cairn_fine of_a = quiet_turn(&pair, arbiter, change, row->lever_a, row->lever_b), of_b = cairn_fine_of(change) - of_a;
    b->w = pair.spin_b;
    a->w = -pair.back_a;
    b->vx += cairn_quiet_fine_dir(of_b, nx);
    b->vy += cairn_quiet_fine_dir(of_b, ny);
    if (arbiter->share_a != 0) {
        a->vx -= cairn_quiet_fine_dir(of_a, nx);
        a->vy -= cairn_quiet_fine_dir(of_a, ny);
    }
}

CAIRN_INLINE void quiet_relax(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter)
{
    cairn_row *row = &arbiter->rows[0];
    cairn_dir nx = arbiter->normal_x, ny = arbiter->normal_y;
    pair_state pair = load(a, b);
    cairn_motion x = b->vx - a->vx, y = b->vy - a->vy, across = cairn_quiet_along(y, -x, nx, ny);
    cairn_motion u = quiet_velocity(&pair, cairn_quiet_along(x, y, nx, ny), row->lever_a, row->lever_b);
    cairn_motion old = row->impulse, pressure = cairn_motion_above_zero(old - cairn_quiet_ratio(u, row->mass), CAIRN_IMPULSE_MAX), push = pressure - old;
    row->impulse = pressure;
    cairn_fine of_a = quiet_turn(&pair, arbiter, push, row->lever_a, row->lever_b), of_b = cairn_fine_of(push) - of_a;

    u = quiet_velocity(&pair, across, arbiter->friction_lever_a, arbiter->friction_lever_b);
    cairn_motion rubbed = arbiter->friction_impulse, impulse = rubbed - cairn_quiet_ratio(u, arbiter->friction_mass);
    cairn_motion within = cairn_motion_factor_below(pressure, arbiter->kinetic_friction);
    if (impulse > within || -impulse > within) {
        impulse = rubbed + cairn_motion_clamp(cairn_arbiter_rub(world, arbiter, u, impulse) - rubbed, CAIRN_GIVEN);
    }
    arbiter->friction_impulse = impulse;
    cairn_motion rub = impulse - rubbed;
    if (!is_small(rub)) {
        pair_state wide = pair;
        wide.linear = push;
        wide.push_a = of_a;
        finish_single(&wide, a, b, arbiter, rub);
        return;
    }
    cairn_fine rub_a = quiet_turn(&pair, arbiter, rub, arbiter->friction_lever_a, arbiter->friction_lever_b), rub_b = cairn_fine_of(rub) - rub_a;
    b->w = pair.spin_b;
    a->w = -pair.back_a;
    b->vx += cairn_quiet_fine_along(of_b, -rub_b, nx, ny);
    b->vy += cairn_quiet_fine_along(rub_b, of_b, nx, ny);
    if (arbiter->share_a != 0) {
        a->vx -= cairn_quiet_fine_along(of_a, -rub_a, nx, ny);
        a->vy -= cairn_quiet_fine_along(rub_a, of_a, nx, ny);
    }
}

#endif
