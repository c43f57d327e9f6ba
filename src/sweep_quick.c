/*
 * The sweeps over the contacts of a step, by the ways that most contacts can take: bodies free to move and of less than
 * CAIRN_UNEVEN times one another's mass, levers at most 2, friction at most 1. They save time, and give the bits that sweep_careful.c would
 * (CAIRN_WITH_QUICK_WAYS). Which way a contact takes is chosen once a step (sweep.c).
 * Nothing is cut off within them, so nothing may wrap:
 *
 * A pair enters only if its speeds and spins are below CAIRN_CALM = 1/32 (with 4 sub-steps of 1/240 s, 7.5 m/s). A row's velocity is then
 * at most 2 sqrt(2) / 32 + 2 * 2 / 32 = 0.22. Push-outs are at most 1/8 and the softening takes at most 7/128 of 2.49, so the first
 * row of a biased pass changes by 0.5, the velocity of the second by at most 1 + 2 * 2 = 5 times that, and all stays below the 8
 * of Q4.28, the impulses' sum below the 4 of cairn_fine. What closes a gap is cut at CAIRN_CLOSED. A relax pass and its friction take
 * kinetic energy out of the pair: bodies of one mass leave it at sqrt(6) / 32 at most, with up to 30 times the mass the lighter
 * one at sqrt(3 * 31) / 32 = 0.30. Only impulses that are given back because a point has come apart, or because the pressure on
 * which friction rested is gone, may add some: hence CAIRN_GIVEN.
 */
#include "sweep_quiet.h"

/* ---- the passes over one contact; a pair that is not calm goes the careful way ---- */

CAIRN_INLINE bool is_out(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, int path)
{
    bool by_flag = path == CAIRN_PATH_CAREFUL || has_two_points(path);
    bool may_be_far = !may_be_apart(path) ? false : by_flag ? (arbiter->path & CAIRN_PATH_APART) != 0 : arbiter->rows[0].gap > 0;
    return CAIRN_WITH_SHORTCUTS && may_be_far && cairn_is_far(a, b, arbiter);
}

CAIRN_ALWAYS_INLINE cairn_size sum_at_start(cairn_sum_with *with, const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, int path)
{
    const cairn_row *rows = arbiter->rows;
    cairn_size sum = with(with(0, arbiter->friction_impulse), rows[0].impulse);
    sum = has_two_points(path) ? with(sum, rows[CAIRN_LAST_ROW].impulse) : sum;
    return cairn_pair_sum(with, sum, a, b, path, true);
}

/* Calm, and so are the impulses. */
CAIRN_INLINE bool starts_calm(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, int path)
{
    if (CAIRN_KNOWS_SQUARES) {
        if (cairn_squares_are_below(sum_at_start(cairn_squares_with, a, b, arbiter, path), CAIRN_CALM)) {
            return true;
        }
        cairn_forget();
    }
    return cairn_size_is_below(sum_at_start(cairn_size_with, a, b, arbiter, path), CAIRN_CALM);
}

CAIRN_INLINE void warm_start(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path, bool from_last)
{
    if (is_out(a, b, arbiter, path)) {
        return;
    }
    if (!starts_calm(a, b, arbiter, path)) {
        cairn_careful_warm_start(world, arbiter, from_last);
        return;
    }
    const cairn_row *rows = arbiter->rows;
    pair_state pair = load(a, b);
    press(&pair, arbiter, &rows[0], rows[0].impulse, path);
    if (has_two_points(path)) {
        press(&pair, arbiter, &rows[CAIRN_LAST_ROW], rows[CAIRN_LAST_ROW].impulse, path);
    }
    finish(&pair, a, b, arbiter, arbiter->friction_impulse, path);
}

CAIRN_INLINE void biased(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path, bool from_last)
{
    if (CAIRN_KNOWS_QUIET && has_one_point(path) && arbiter->rows[0].gap <= 0 && quiet_biased(a, b, arbiter, path)) {
        return;
    }
    cairn_forget();
    if (is_out(a, b, arbiter, path)) {
        return;
    }
    if (!cairn_is_calm(a, b, path, !is_central(path))) {
        cairn_careful_biased_pass(world, arbiter, from_last);
        return;
    }
    bool alone = path == CAIRN_PATH_ON_STATIC, second = has_two_points(path) && from_last;
    pair_state pair = load(a, b);
    pair.linear = pair.before = cairn_motion_along(alone ? b->vx : b->vx - a->vx, alone ? b->vy : b->vy - a->vy, arbiter->normal_x, arbiter->normal_y);
    cairn_row *row = &arbiter->rows[second], *last = &arbiter->rows[has_two_points(path) && !from_last];
    for (;; row = last) {
        cairn_motion gap = row->gap, old = row->impulse, u = pair.linear, impulse;
        if (!is_central(path)) {
            u = velocity(&pair, u, row->lever_a, row->lever_b, path);
        }
        if (may_be_apart(path) && gap > 0) {
            impulse = old + cairn_motion_clamp(cairn_biased_apart(a, b, arbiter, row, u) - old, CAIRN_CLOSED);
        } else {
            cairn_motion rigid = old - (is_central(path) ? u + gap : cairn_motion_ratio(u + gap, row->mass));
            impulse = cairn_motion_above_zero(cairn_softened(rigid, row->load), CAIRN_IMPULSE_MAX);
        }
        row->impulse = impulse;
        press(&pair, arbiter, row, cairn_kept(impulse - old), path);
        if (!has_two_points(path) || row == last) {
            break;
        }
    }
    push_apart(&pair, a, b, arbiter, path);
}

CAIRN_INLINE void relax(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path, bool from_last)
{
    if (CAIRN_KNOWS_QUIET && has_one_point(path) && arbiter->rows[0].gap <= 0 && quiet_relax(world, a, b, arbiter, path)) {
        return;
    }
    cairn_forget();
    if (is_out(a, b, arbiter, path)) {
        return;
    }
    if (!cairn_is_calm(a, b, path, true)) {
        cairn_careful_relax_pass(world, arbiter, from_last);
        return;
    }
    bool alone = path == CAIRN_PATH_ON_STATIC, second = has_two_points(path) && from_last;
    cairn_motion x = cairn_kept(alone ? b->vx : b->vx - a->vx), y = cairn_kept(alone ? b->vy : b->vy - a->vy), pressure = 0;
    pair_state pair = load(a, b);
    pair.linear = pair.before = cairn_motion_along(x, y, arbiter->normal_x, arbiter->normal_y);
    cairn_motion across = cairn_motion_along(y, -x, arbiter->normal_x, arbiter->normal_y);
    cairn_row *row = &arbiter->rows[second], *last = &arbiter->rows[has_two_points(path) && !from_last];
    for (;; row = last) {
        cairn_motion old = row->impulse, u = pair.linear, impulse;
        if (!is_central(path)) {
            u = velocity(&pair, u, row->lever_a, row->lever_b, path);
        }
        if (may_be_apart(path) && row->gap > 0) {
            impulse = old + cairn_motion_clamp(cairn_relaxed_apart(a, b, arbiter, row, u) - old, CAIRN_GIVEN);
        } else {
            impulse = cairn_motion_above_zero(old - (is_central(path) ? u : cairn_motion_ratio(u, row->mass)), CAIRN_IMPULSE_MAX);
        }
        row->impulse = impulse;
        pressure += impulse;
        press(&pair, arbiter, row, cairn_kept(impulse - old), path);
        if (!has_two_points(path) || row == last) {
            break;
        }
    }
    cairn_motion u = velocity(&pair, across, arbiter->friction_lever_a, arbiter->friction_lever_b, path);
    cairn_motion pull = has_two_points(path) ? cairn_arbiter_pull(world, arbiter) : 0;
    cairn_motion old = arbiter->friction_impulse, impulse = old - cairn_motion_ratio(u + pull, arbiter->friction_mass);
    /* Within a cone that is a little narrower than the kinetic one it sticks for sure. */
    cairn_motion within = cairn_motion_factor_below(pressure, arbiter->kinetic_friction);
    if (impulse > within || -impulse > within) {
        impulse = old + cairn_motion_clamp(cairn_arbiter_rub(world, arbiter, u, impulse) - old, CAIRN_GIVEN);
    }
    arbiter->friction_impulse = impulse;
    finish(&pair, a, b, arbiter, cairn_kept(impulse - old), path);
}

/* ---- each pass by each path ---- */

#define WAY(name, pass, way_path) \
    static const uint16_t *name(const cairn_world *world, const uint16_t *at, const uint16_t *end, bool from_last) \
    { \
        cairn_arbiter *const arbiters = world->arbiters, *arbiter = &arbiters[*at]; \
        cairn_body *const bodies = world->bodies; \
        const unsigned path = arbiter->path; \
        do { \
            pass(world, &bodies[arbiter->a], &bodies[arbiter->b], arbiter, way_path, from_last); \
        } while (++at != end && (arbiter = &arbiters[*at])->path == path); \
        return at; \
    }

/* The same of a way whose turn is no other one's: no flag tells contacts of one point apart. */
#define WAY_OF_TURN(name, pass, way_path) \
    static const uint16_t *name(const cairn_world *world, const uint16_t *at, const uint16_t *end, bool from_last) \
    { \
        cairn_arbiter *const arbiters = world->arbiters; \
        cairn_body *const bodies = world->bodies; \
        end = world->swept + world->swept_ends[way_path]; \
        do { \
            cairn_arbiter *arbiter = &arbiters[*at]; \
            pass(world, &bodies[arbiter->a], &bodies[arbiter->b], arbiter, way_path, from_last); \
        } while (++at != end); \
        return at; \
    }

CAIRN_INLINE void careful_warm_start(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path, bool from_last)
{
    if (!is_out(a, b, arbiter, path)) {
        cairn_careful_warm_start(world, arbiter, from_last);
    }
}
CAIRN_INLINE void careful_biased(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path, bool from_last)
{
    if (!is_out(a, b, arbiter, path)) {
        cairn_careful_biased_pass(world, arbiter, from_last);
    }
}
CAIRN_INLINE void careful_relax(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path, bool from_last)
{
    if (!is_out(a, b, arbiter, path)) {
        cairn_careful_relax_pass(world, arbiter, from_last);
    }
}

/* By CAIRN_PATH_TURN; the first place, which is none's, is that of CAIRN_PATH_EVEN_CENTRAL. */
#define WAYS(pass) \
    WAY(pass##_careful, careful_##pass, CAIRN_PATH_CAREFUL) \
    WAY(pass##_on_static, pass, CAIRN_PATH_ON_STATIC) \
    WAY(pass##_central, pass, CAIRN_PATH_CENTRAL) \
    WAY(pass##_even_central, pass, CAIRN_PATH_EVEN_CENTRAL) \
    WAY_OF_TURN(pass##_single, pass, CAIRN_PATH_SINGLE) \
    WAY(pass##_shared, pass, CAIRN_PATH_SHARED) \
    WAY(pass##_even, pass, CAIRN_PATH_EVEN) \
    cairn_way *const cairn_##pass##_ways[CAIRN_PATH_TURN + 1] = { pass##_even_central, pass##_careful, pass##_careful, CAIRN_OF_TWO(pass##_on_static), \
                                        pass##_central, pass##_single, CAIRN_OF_TWO(pass##_shared), CAIRN_OF_TWO(pass##_even) };

WAYS(biased)
WAYS(relax)

/* The warm start comes once a step: what it may do, it does by the wide ways, to the same bits. */
WAY(warm_start_careful, careful_warm_start, CAIRN_PATH_CAREFUL)
WAY(warm_start_even, warm_start, CAIRN_PATH_EVEN)
WAY(warm_start_shared, warm_start, CAIRN_PATH_SHARED)
WAY(warm_start_single, warm_start, CAIRN_PATH_SINGLE)
WAY(warm_start_even_central, warm_start, CAIRN_PATH_EVEN_CENTRAL)
cairn_way *const cairn_warm_start_ways[CAIRN_PATH_TURN + 1] = { warm_start_even_central, warm_start_careful, warm_start_careful, CAIRN_OF_TWO(warm_start_shared),
                                        warm_start_single, warm_start_single, CAIRN_OF_TWO(warm_start_shared), CAIRN_OF_TWO(warm_start_even) };
