/*
 * The sweeps over the contacts of a step, by the ways that most contacts can take: bodies free to move and of less than
 * CAIRN_UNEVEN times one another's mass, levers at most 2, friction at most 1. Which way a contact takes is chosen once a step.
 * Nothing is cut off within them, so nothing may wrap:
 *
 * A pair enters only if its speeds and spins are below CALM = 1/32 (with 4 sub-steps of 1/240 s, 7.5 m/s). A row's velocity is then
 * at most 2 sqrt(2) / 32 + 2 * 2 / 32 = 0.22. Push-outs are at most 0.2 and the softening takes at most 0.052 of 2.49, so the first
 * row of a biased pass changes by 0.55, the velocity of the second by at most 1 + 2 * 2 = 5 times that, and all stays below the 8
 * of Q4.28; a point that was apart changes by 1.3 at most, since its velocity has beta d in it, and the second one's by 6.5. A
 * relax pass and its friction take kinetic energy out of the pair: bodies of one mass leave it at sqrt(6) / 32 at
 * most, with up to 30 times the mass the lighter one at sqrt(3 * 31) / 32 = 0.30. Only impulses that are given back because a
 * point has come apart, or because the pressure on which friction rested is gone, may add some: hence GIVEN.
 */
#include "sweep.h"

#define CALM CAIRN_MOTION(1.0 / 32)
/* The most by which such an impulse changes in a relax pass: 0.30 and three times 2 / 16 are below CAIRN_SWEEP_SPIN. */
#define GIVEN CAIRN_MOTION(1.0 / 16)
/* Push-outs beyond this are left to the careful way. */
#define PUSH CAIRN_MOTION(0.125)

/* What a pass makes of a pair. */
typedef struct pair_state {
    cairn_motion linear;       /* relative velocity along the normal */
    cairn_motion back_a;       /* a's spin, negative */
    cairn_motion spin_b;
    cairn_motion push, push_a; /* impulses so far; a's part of them where it is not all or half */
} pair_state;

CAIRN_INLINE bool is_calm(const cairn_body *a, const cairn_body *b, int path)
{
    cairn_bulk bulk = cairn_bulk_of(b->vx, CALM) | cairn_bulk_of(b->vy, CALM) | cairn_bulk_of(b->w, CALM);
    if (path != CAIRN_PATH_ON_STATIC) {
        bulk |= cairn_bulk_of(a->vx, CALM) | cairn_bulk_of(a->vy, CALM) | cairn_bulk_of(a->w, CALM);
    }
    return cairn_bulk_is_within(bulk, CALM);
}

CAIRN_INLINE pair_state load(const cairn_body *a, const cairn_body *b, cairn_motion x, cairn_motion y, const cairn_arbiter *arbiter)
{
    pair_state pair;
    pair.linear = cairn_motion_along(x, y, arbiter->normal_x, arbiter->normal_y);
    pair.back_a = -a->w;
    pair.spin_b = b->w;
    pair.push = pair.push_a = 0;
    return pair;
}

/* The velocity of a row, of which this is the linear part. */
CAIRN_INLINE cairn_motion velocity(const pair_state *pair, cairn_motion linear, cairn_lever ja, cairn_lever jb, int path)
{
    return linear + (path == CAIRN_PATH_ON_STATIC ? cairn_motion_lever(pair->spin_b, jb) : cairn_motion_levers(pair->spin_b, jb, pair->back_a, ja));
}

/* What an impulse does to the spins; returns a's part. */
CAIRN_INLINE cairn_motion turn(pair_state *pair, const cairn_arbiter *arbiter, cairn_motion change, cairn_lever ja, cairn_lever jb, int path)
{
    if (path == CAIRN_PATH_ON_STATIC) {
        pair->spin_b += cairn_motion_lever(change, jb);
        return 0;
    }
    if (path == CAIRN_PATH_EVEN) {
        pair->spin_b += cairn_motion_half_lever(change, jb);
        pair->back_a += cairn_motion_half_lever(change, ja);
        return 0;
    }
    cairn_motion of_a = cairn_motion_share(change, arbiter->share_a);
    pair->spin_b += cairn_motion_lever(change - of_a, jb);
    pair->back_a += cairn_motion_lever(of_a, ja);
    return of_a;
}

CAIRN_INLINE void press(pair_state *pair, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion change, int path)
{
    pair->linear += change;
    pair->push += change;
    pair->push_a += turn(pair, arbiter, change, row->lever_a, row->lever_b, path);
}

/* Store the pair, with impulses along the normal only. */
CAIRN_INLINE void push_apart(const pair_state *pair, cairn_body *a, cairn_body *b, const cairn_arbiter *arbiter, int path)
{
    cairn_dir nx = arbiter->normal_x, ny = arbiter->normal_y;
    b->w = pair->spin_b;
    if (path == CAIRN_PATH_ON_STATIC) {
        b->vx += cairn_motion_dir(pair->push, nx);
        b->vy += cairn_motion_dir(pair->push, ny);
        return;
    }
    a->w = -pair->back_a;
    if (path == CAIRN_PATH_EVEN) {
        cairn_motion x = cairn_motion_half_dir(pair->push, nx), y = cairn_motion_half_dir(pair->push, ny);
        a->vx -= x;
        a->vy -= y;
        b->vx += x;
        b->vy += y;
        return;
    }
    cairn_motion of_b = pair->push - pair->push_a;
    a->vx -= cairn_motion_dir(pair->push_a, nx);
    a->vy -= cairn_motion_dir(pair->push_a, ny);
    b->vx += cairn_motion_dir(of_b, nx);
    b->vy += cairn_motion_dir(of_b, ny);
}

/* Store the pair, with friction's impulse as well: t = (-ny, nx). */
CAIRN_INLINE void finish(pair_state *pair, cairn_body *a, cairn_body *b, const cairn_arbiter *arbiter, cairn_motion rub, int path)
{
    cairn_dir nx = arbiter->normal_x, ny = arbiter->normal_y;
    cairn_motion rub_a = turn(pair, arbiter, rub, arbiter->friction_lever_a, arbiter->friction_lever_b, path);
    b->w = pair->spin_b;
    if (path == CAIRN_PATH_ON_STATIC) {
        b->vx += cairn_motion_along(pair->push, -rub, nx, ny);
        b->vy += cairn_motion_along(rub, pair->push, nx, ny);
        return;
    }
    a->w = -pair->back_a;
    if (path == CAIRN_PATH_EVEN) {
        cairn_motion x = cairn_motion_half_along(pair->push, -rub, nx, ny), y = cairn_motion_half_along(rub, pair->push, nx, ny);
        a->vx -= x;
        a->vy -= y;
        b->vx += x;
        b->vy += y;
        return;
    }
    cairn_motion of_b = pair->push - pair->push_a, rub_b = rub - rub_a;
    a->vx -= cairn_motion_along(pair->push_a, -rub_a, nx, ny);
    a->vy -= cairn_motion_along(rub_a, pair->push_a, nx, ny);
    b->vx += cairn_motion_along(of_b, -rub_b, nx, ny);
    b->vy += cairn_motion_along(rub_b, of_b, nx, ny);
}

/* ---- the passes by path, from the first point on or from the last; false if the pair is not calm ---- */

CAIRN_INLINE bool warm_start(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path, bool from_last)
{
    (void)world;
    (void)from_last;
    cairn_size size = cairn_size_of(arbiter->friction_impulse);
    for (int i = 0; i < arbiter->count; i++) {
        size = cairn_size_with(size, arbiter->rows[i].impulse);
    }
    if (!cairn_size_is_below(size, CALM) || !is_calm(a, b, path)) {
        return false;
    }
    pair_state pair;
    pair.back_a = -a->w;
    pair.spin_b = b->w;
    pair.push = pair.push_a = pair.linear = 0;
    for (int i = 0; i < arbiter->count; i++) {
        press(&pair, arbiter, &arbiter->rows[i], arbiter->rows[i].impulse, path);
    }
    finish(&pair, a, b, arbiter, arbiter->friction_impulse, path);
    return true;
}

CAIRN_INLINE bool biased(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path, bool from_last)
{
    (void)world;
    if (!is_calm(a, b, path)) {
        return false;
    }
    bool alone = path == CAIRN_PATH_ON_STATIC;
    pair_state pair = load(a, b, alone ? b->vx : b->vx - a->vx, alone ? b->vy : b->vy - a->vy, arbiter);
    cairn_row *row = arbiter->rows, *last = row + arbiter->count - 1;
    if (from_last) {
        row = last;
        last = arbiter->rows;
    }
    for (;; row = last) {
        cairn_motion u = velocity(&pair, pair.linear, row->lever_a, row->lever_b, path);
        cairn_motion gap = row->gap, old = row->impulse, impulse;
        if (path == CAIRN_PATH_SHARED && gap > 0) {
            impulse = cairn_biased_apart(a, b, arbiter, row, u);
        } else {
            cairn_motion rigid = old - cairn_motion_ratio(u + gap, row->mass);
            impulse = cairn_motion_above_zero(cairn_softened(rigid, row->load), CAIRN_IMPULSE_MAX);
        }
        row->impulse = impulse;
        press(&pair, arbiter, row, impulse - old, path);
        if (row == last) {
            break;
        }
    }
    push_apart(&pair, a, b, arbiter, path);
    return true;
}

/* Friction's impulse: within a cone that is a little narrower than the kinetic one it sticks for sure. */
CAIRN_INLINE cairn_motion rubbed(const cairn_world *world, const cairn_arbiter *arbiter, cairn_motion u, cairn_motion pressure)
{
    cairn_motion old = arbiter->friction_impulse, impulse = old - cairn_motion_ratio(u + cairn_arbiter_pull(world, arbiter), arbiter->friction_mass);
    cairn_motion within = cairn_motion_factor_below(pressure, arbiter->kinetic_friction);
    if (impulse > within || -impulse > within) {
        impulse = old + cairn_motion_clamp(cairn_arbiter_rub(world, arbiter, u, impulse) - old, GIVEN);
    }
    return impulse;
}

CAIRN_INLINE bool relax(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_arbiter *arbiter, int path, bool from_last)
{
    if (!is_calm(a, b, path)) {
        return false;
    }
    bool alone = path == CAIRN_PATH_ON_STATIC;
    cairn_motion x = alone ? b->vx : b->vx - a->vx, y = alone ? b->vy : b->vy - a->vy, pressure = 0;
    pair_state pair = load(a, b, x, y, arbiter);
    cairn_motion across = cairn_motion_along(y, -x, arbiter->normal_x, arbiter->normal_y);
    cairn_row *row = arbiter->rows, *last = row + arbiter->count - 1;
    if (from_last) {
        row = last;
        last = arbiter->rows;
    }
    for (;; row = last) {
        cairn_motion u = velocity(&pair, pair.linear, row->lever_a, row->lever_b, path);
        cairn_motion old = row->impulse, impulse;
        if (path == CAIRN_PATH_SHARED && row->gap > 0) {
            impulse = old + cairn_motion_clamp(cairn_relaxed_apart(a, b, arbiter, row, u) - old, GIVEN);
        } else {
            impulse = cairn_motion_above_zero(old - cairn_motion_ratio(u, row->mass), CAIRN_IMPULSE_MAX);
        }
        row->impulse = impulse;
        pressure += impulse;
        press(&pair, arbiter, row, impulse - old, path);
        if (row == last) {
            break;
        }
    }
    cairn_motion impulse = rubbed(world, arbiter, velocity(&pair, across, arbiter->friction_lever_a, arbiter->friction_lever_b, path), pressure);
    cairn_motion rub = impulse - arbiter->friction_impulse;
    arbiter->friction_impulse = impulse;
    finish(&pair, a, b, arbiter, rub, path);
    return true;
}

/* ---- over the world ---- */

int cairn_arbiter_path_of(const cairn_world *world, const cairn_arbiter *arbiter)
{
    if (!(arbiter->flags & CAIRN_ARBITER_SOLVED) || (arbiter->block & CAIRN_BLOCK_NUMBER)) {
        return CAIRN_PATH_NONE;
    }
    bool first = arbiter->rows[0].gap > 0, second = arbiter->count > 1 && arbiter->rows[1].gap > 0;
    int apart = first && (second || arbiter->count < 2) ? CAIRN_PATH_APART : 0;
    if (cairn_arbiter_is_sliding(arbiter)) {
        return CAIRN_PATH_SLIDING + apart;
    }
    /* An impact may leave a contact without points: the quick ways take one at least. */
    if (arbiter->count == 0 || (arbiter->flags & CAIRN_ARBITER_CAREFUL) || arbiter->block != 0 || arbiter->kinetic_friction > CAIRN_FACTOR(1) || world->push_out_limit > PUSH) {
        return CAIRN_PATH_CAREFUL + apart;
    }
    if (first || second) {
        return CAIRN_PATH_SHARED + apart;
    }
    return arbiter->flags & CAIRN_ARBITER_ON_STATIC ? CAIRN_PATH_ON_STATIC : arbiter->share_a == CAIRN_SHARE(0.5) ? CAIRN_PATH_EVEN : CAIRN_PATH_SHARED;
}

/*
 * So far apart that the points cannot meet in this sub-step. They come nearer by v + d at most, and that by sqrt(2) times the greater
 * component of the relative motion and 2 sqrt(2) times each spin: 7.1 times the greatest of v and as much of d, of which halves are taken, for
 * the difference of two displacements may not fit. The velocities of two that fall together differ by nothing.
 */
static bool is_far(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter)
{
    const cairn_row *rows = arbiter->rows;
    bool second = arbiter->count > 1;
    if (rows[0].impulse != 0 || arbiter->friction_impulse != 0 || (second && rows[1].impulse != 0)) {
        return false;
    }
    cairn_motion gap = second && rows[1].gap < rows[0].gap ? rows[1].gap : rows[0].gap;
    cairn_size size = cairn_size_with(cairn_size_of(b->vx - a->vx), b->vy - a->vy);
    size = cairn_size_with(size, cairn_motion_half(b->dx) - cairn_motion_half(a->dx));
    size = cairn_size_with(size, cairn_motion_half(b->dy) - cairn_motion_half(a->dy));
    size = cairn_size_with(cairn_size_with(size, a->w), b->w);
    return cairn_size_is_far_below(cairn_size_with(cairn_size_with(size, a->dw), b->dw), gap);
}

void cairn_sweep_choose_again(cairn_world *world)
{
    bool any_slides = false;
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        int path = cairn_arbiter_path_of(world, arbiter);
        arbiter->path = (uint8_t)(path == CAIRN_PATH_NONE ? CAIRN_PATH_NONE : path | (arbiter->path & CAIRN_PATH_FRESH));
        any_slides = any_slides || cairn_arbiter_is_sliding(arbiter);
    }
    world->slides = any_slides;
}

/*
 * One pass over all contacts, each by its path. The two points of a contact take turns in coming first, from sub-step to sub-step:
 * of_pair and of_static say whether the last one does. What comes first takes more of what both are to stop: were it always the same one,
 * all boxes of a column that settles would begin to turn the same way. Held rows keep their order in the biased pass, where turns would
 * leave a wide pyramid breathing for ever, and on something static, where they come to rest sooner.
 */
#define SWEEP(pass, careful, of_pair, of_static) \
    cairn_body *bodies = world->bodies; \
    cairn_arbiter *arbiters = world->arbiters; \
    const uint16_t *end = world->order + world->arbiter_count; \
    for (const uint16_t *at = world->order; at != end; at++) { \
        cairn_arbiter *arbiter = &arbiters[*at]; \
        int path = arbiter->path; \
        if (path == CAIRN_PATH_NONE) { \
            continue; \
        } \
        bool fresh = false; \
        cairn_body *a = &bodies[arbiter->a], *b = &bodies[arbiter->b]; \
        if (path >= CAIRN_PATH_FRESH) { \
            if (path >= CAIRN_PATH_APART && is_far(a, b, arbiter)) { \
                continue; \
            } \
            fresh = (path & CAIRN_PATH_FRESH) != 0; \
            path &= CAIRN_PATH_WAY; \
        } \
        bool done = path == CAIRN_PATH_EVEN ? pass(world, a, b, arbiter, CAIRN_PATH_EVEN, of_pair) \
                  : path == CAIRN_PATH_ON_STATIC ? pass(world, a, b, arbiter, CAIRN_PATH_ON_STATIC, of_static) \
                  : path == CAIRN_PATH_SHARED && pass(world, a, b, arbiter, CAIRN_PATH_SHARED, of_pair); \
        if (!done) { \
            careful(world, arbiter, arbiter->flags & CAIRN_ARBITER_ON_STATIC ? of_static : of_pair); \
        } \
    }

void cairn_sweep_warm_start(cairn_world *world)
{
    SWEEP(warm_start, cairn_careful_warm_start, fresh, fresh)
}

void cairn_sweep_biased(cairn_world *world, int substep)
{
    const bool odd = (substep & 1) != 0;
    SWEEP(biased, cairn_careful_biased_pass, fresh && odd, fresh && odd)
}

void cairn_sweep_relax(cairn_world *world, int substep)
{
    const bool odd = (substep & 1) != 0;
    SWEEP(relax, cairn_careful_relax_pass, odd, fresh && odd)
}
