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
CAIRN_INLINE bool has_two_points(int path) { return CAIRN_MAX_POINTS > 1 && !is_central(path) && path != CAIRN_PATH_SINGLE; }

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

/* ---- the passes over one contact; a pair that is not calm goes the careful way ---- */

CAIRN_INLINE bool is_out(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, int path)
{
    bool by_flag = path == CAIRN_PATH_CAREFUL || has_two_points(path);
    bool may_be_far = !may_be_apart(path) ? false : by_flag ? (arbiter->path & CAIRN_PATH_APART) != 0 : arbiter->rows[0].gap > 0;
    return CAIRN_WITH_SHORTCUTS && may_be_far && cairn_is_far(a, b, arbiter);
}

CAIRN_INLINE void warm_start(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path, bool from_last)
{
    if (is_out(a, b, arbiter, path)) {
        return;
    }
    const cairn_row *rows = arbiter->rows;
    cairn_size size = cairn_size_with(cairn_size_of(arbiter->friction_impulse), rows[0].impulse);
    if (has_two_points(path)) {
        size = cairn_size_with(size, rows[CAIRN_LAST_ROW].impulse);
    }
    if (!cairn_size_is_below(size, CAIRN_CALM) || !cairn_is_calm(a, b, path, true)) {
        cairn_careful_warm_start(world, arbiter, from_last);
        return;
    }
    pair_state pair = load(a, b);
    press(&pair, arbiter, &rows[0], rows[0].impulse, path);
    if (has_two_points(path)) {
        press(&pair, arbiter, &rows[CAIRN_LAST_ROW], rows[CAIRN_LAST_ROW].impulse, path);
    }
    finish(&pair, a, b, arbiter, arbiter->friction_impulse, path);
}

CAIRN_INLINE void biased(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path, bool from_last)
{
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
        press(&pair, arbiter, row, impulse - old, path);
        if (!has_two_points(path) || row == last) {
            break;
        }
    }
    push_apart(&pair, a, b, arbiter, path);
}

CAIRN_INLINE void relax(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path, bool from_last)
{
    if (is_out(a, b, arbiter, path)) {
        return;
    }
    if (!cairn_is_calm(a, b, path, true)) {
        cairn_careful_relax_pass(world, arbiter, from_last);
        return;
    }
    bool alone = path == CAIRN_PATH_ON_STATIC, second = has_two_points(path) && from_last;
    cairn_motion x = alone ? b->vx : b->vx - a->vx, y = alone ? b->vy : b->vy - a->vy, pressure = 0;
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
        press(&pair, arbiter, row, impulse - old, path);
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
    finish(&pair, a, b, arbiter, impulse - old, path);
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
    WAY(pass##_single, pass, CAIRN_PATH_SINGLE) \
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
