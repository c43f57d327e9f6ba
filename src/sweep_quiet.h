/*
 * One point of a quiet pair, in products of 32 bits: the same bits as the ways of sweep_quick.c for any bodies, for cores without a long
 * multiply, where a product then takes half of the instructions. Quiet is a pair of calm bodies whose speed to one another and whose spins are
 * below Q = 2^15 units (30 mm/s with 4 sub-steps), and whose point touched when the step began. With |n| = 1, |j| <= 2, shares a + b = 1 and a
 * row's mass e = 1 / (1 + a jA^2 + b jB^2) these are the products:
 *
 * - Levers times spins are at most 2 * 2^15 * 2^14.
 * - A row's velocity, times e: (1.42 + |jA| + |jB|) Q e is below 3.2 Q, its greatest near jA = 2, a = 0, jB = 0.15. With the push-out it has no
 *   such bound, and what is beyond 2^17 is not quiet. Nor is a change of an impulse beyond 2^15, which is 2^16 in fine units.
 * - By that spins grow to Q + 2^16 a and Q + 2^16 b. Friction's levers then give 2^17 * 2^14 at most, and not quite, since all of these limits are
 *   not reached; and its velocity, times e, is (1.42 + (1 + 2 a) |jA| + (1 + 2 b) |jB|) Q e, below 4 Q (jA = 2, a = 0, jB = 0.38).
 */
#ifndef CAIRN_SWEEP_QUIET_H
#define CAIRN_SWEEP_QUIET_H

#include "sweep_pair.h"

/* The motion of b to a, and the spins, a's negative. */
typedef struct quiet_state {
    cairn_motion x, y, back_a, spin_b;
} quiet_state;

/* False if the pair is not quiet. If b is calm with room to spare, so is a. */
CAIRN_INLINE bool quiet_load(quiet_state *pair, const cairn_body *a, const cairn_body *b, bool with_spins)
{
    pair->x = cairn_kept(b->vx - a->vx);
    pair->y = cairn_kept(b->vy - a->vy);
    pair->spin_b = b->w;
    pair->back_a = -a->w;
    return cairn_motion_is_calm(b->vx) && cairn_motion_is_calm(b->vy) && cairn_motion_is_quiet(pair->x) && cairn_motion_is_quiet(pair->y)
        && (!with_spins || (cairn_motion_is_quiet(pair->spin_b) && cairn_motion_is_quiet(pair->back_a)));
}

/* What an impulse does to the spins; returns a's part. */
CAIRN_INLINE cairn_fine quiet_turn(quiet_state *pair, const cairn_arbiter *arbiter, cairn_motion change, cairn_lever ja, cairn_lever jb, int path)
{
    if (path == CAIRN_PATH_EVEN_CENTRAL) {
        cairn_motion half = cairn_quiet_half_lever(change, jb); /* ja is -jb */
        pair->spin_b += half;
        pair->back_a -= half;
        return 0;
    }
    cairn_fine of_a = cairn_quiet_share(change, arbiter->share_a);
    pair->spin_b = cairn_quiet_add_fine_lever(pair->spin_b, cairn_fine_of(change) - of_a, jb);
    pair->back_a = cairn_quiet_add_fine_lever(pair->back_a, of_a, ja);
    return of_a;
}

/* A row's velocity, on top of its linear part. */
CAIRN_INLINE cairn_motion quiet_velocity(const quiet_state *pair, cairn_motion linear, cairn_lever ja, cairn_lever jb, int path)
{
    return path == CAIRN_PATH_EVEN_CENTRAL ? cairn_quiet_add_levers(linear, pair->spin_b - pair->back_a, jb, 0, 0)
                                           : cairn_quiet_add_levers(linear, pair->spin_b, jb, pair->back_a, ja);
}

/* One point of one of three paths: CAIRN_PATH_SINGLE, _CENTRAL, _EVEN_CENTRAL. False, and nothing done, if it is not quiet. */
CAIRN_INLINE bool quiet_biased(cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path)
{
    cairn_row *row = &arbiter->rows[0];
    quiet_state pair;
    if (!quiet_load(&pair, a, b, !is_central(path))) {
        return false;
    }
    cairn_dir nx = arbiter->normal_x, ny = arbiter->normal_y;
    cairn_motion old = row->impulse, u = cairn_quiet_add_along(row->gap, pair.x, pair.y, nx, ny);
    if (!is_central(path)) {
        u = quiet_velocity(&pair, u, row->lever_a, row->lever_b, path);
        if (!cairn_motion_is_fairly_quiet(u)) {
            return false;
        }
    }
    cairn_motion rigid = is_central(path) ? old - u : cairn_quiet_less_ratio(old, u, row->mass);
    cairn_motion impulse = cairn_motion_above_zero(cairn_softened(rigid, row->load), CAIRN_IMPULSE_MAX), change = impulse - old;
    if (!cairn_motion_is_quiet(change)) {
        return false;
    }
    row->impulse = impulse;
    if (is_even(path)) {
        cairn_motion x = cairn_quiet_half_dir(change, nx), y = cairn_quiet_half_dir(change, ny);
        a->vx -= x;
        a->vy -= y;
        b->vx += x;
        b->vy += y;
        return true;
    }
    cairn_fine of_a, of_b;
    if (is_central(path)) {
        of_a = cairn_quiet_share(change, arbiter->share_a);
    } else {
        of_a = quiet_turn(&pair, arbiter, change, row->lever_a, row->lever_b, path);
        b->w = pair.spin_b;
        a->w = -pair.back_a;
    }
    of_b = cairn_fine_of(change) - of_a;
    b->vx = cairn_quiet_add_fine_dir(b->vx, of_b, nx);
    b->vy = cairn_quiet_add_fine_dir(b->vy, of_b, ny);
    a->vx = cairn_quiet_less_fine_dir(a->vx, of_a, nx);
    a->vy = cairn_quiet_less_fine_dir(a->vy, of_a, ny);
    return true;
}

CAIRN_INLINE bool quiet_relax(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path)
{
    cairn_row *row = &arbiter->rows[0];
    quiet_state pair;
    if (!quiet_load(&pair, a, b, true)) {
        return false;
    }
    cairn_dir nx = arbiter->normal_x, ny = arbiter->normal_y;
    cairn_motion across = cairn_quiet_add_along(0, pair.y, -pair.x, nx, ny), u = cairn_quiet_add_along(0, pair.x, pair.y, nx, ny);
    u = is_central(path) ? u : quiet_velocity(&pair, u, row->lever_a, row->lever_b, path);
    cairn_motion old = row->impulse, rigid = is_central(path) ? old - u : cairn_quiet_less_ratio(old, u, row->mass);
    cairn_motion pressure = cairn_motion_above_zero(rigid, CAIRN_IMPULSE_MAX), push = pressure - old;
    if (!cairn_motion_is_quiet(push)) {
        return false;
    }
    row->impulse = pressure;
    cairn_fine of_a = 0;
    if (path == CAIRN_PATH_CENTRAL) {
        of_a = cairn_quiet_share(push, arbiter->share_a);
    } else if (!is_central(path)) {
        of_a = quiet_turn(&pair, arbiter, push, row->lever_a, row->lever_b, path);
    }
    cairn_fine of_b = cairn_fine_of(push) - of_a;

    u = quiet_velocity(&pair, across, arbiter->friction_lever_a, arbiter->friction_lever_b, path);
    cairn_motion rubbed = arbiter->friction_impulse, impulse = cairn_quiet_less_ratio(rubbed, u, arbiter->friction_mass);
    cairn_motion within = cairn_motion_factor_below(pressure, arbiter->kinetic_friction);
    if (impulse > within || -impulse > within) {
        impulse = rubbed + cairn_motion_clamp(cairn_arbiter_rub(world, arbiter, u, impulse) - rubbed, CAIRN_GIVEN);
    }
    cairn_motion rub = impulse - rubbed;
    if (!cairn_motion_is_quiet(rub)) {
        row->impulse = old;
        return false;
    }
    arbiter->friction_impulse = impulse;
    cairn_fine rub_a = quiet_turn(&pair, arbiter, rub, arbiter->friction_lever_a, arbiter->friction_lever_b, path), rub_b = cairn_fine_of(rub) - rub_a;
    b->w = pair.spin_b;
    a->w = -pair.back_a;
    if (is_even(path)) {
        cairn_motion x = cairn_quiet_half_along(push, -rub, nx, ny), y = cairn_quiet_half_along(rub, push, nx, ny);
        a->vx -= x;
        a->vy -= y;
        b->vx += x;
        b->vy += y;
        return true;
    }
    b->vx = cairn_quiet_add_fine_along(b->vx, of_b, -rub_b, nx, ny);
    b->vy = cairn_quiet_add_fine_along(b->vy, rub_b, of_b, nx, ny);
    a->vx = cairn_quiet_less_fine_along(a->vx, of_a, -rub_a, nx, ny);
    a->vy = cairn_quiet_less_fine_along(a->vy, rub_a, of_a, nx, ny);
    return true;
}

#endif
