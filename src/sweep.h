/* The passes of the soft solver over the contacts: sweep_quick.c has the ways of most, sweep_careful.c what serves in all cases. */
#ifndef CAIRN_SWEEP_H
#define CAIRN_SWEEP_H

#include "engine.h"

/* ---- sweep.c ---- */
/* Choose each contact's way again, where contacts have changed since they were found. */
void cairn_sweep_choose_again(cairn_world *world);
/* Arrange them by their ways, when all are chosen; and again where one has changed. */
void cairn_sweep_arrange(cairn_world *world);
/* Apply the impulses of the step before. */
void cairn_sweep_warm_start(cairn_world *world);
/* Soft and pushing out, without friction. In the passes of a sub-step, counted from 0. */
void cairn_sweep_biased(cairn_world *world, int substep);
/* Rigid, with friction. */
void cairn_sweep_relax(cairn_world *world, int substep);

/* Apply the impulses of the sub-step before to what slides: those are not repeated with the bodies' changes. */
void cairn_sweep_push_sliding(cairn_world *world);
/* After the bodies have moved by a sub-step: the levers of what slides. See slide.c. */
void cairn_sweep_slide(cairn_world *world);

/* ---- sweep_quick.c: contacts of the same path, from *at on up to the first of another one, or to the end. Returns where that is. ---- */
typedef const uint16_t *cairn_way(const cairn_world *world, const uint16_t *at, const uint16_t *end, bool from_last);
/* By CAIRN_PATH_TURN; the first place, which is none's, is that of CAIRN_PATH_EVEN_CENTRAL. */
extern cairn_way *const cairn_warm_start_ways[CAIRN_PATH_TURN + 1], *const cairn_biased_ways[CAIRN_PATH_TURN + 1], *const cairn_relax_ways[CAIRN_PATH_TURN + 1];
/* Of the flags that tell a path from another one of the same turn, the one of CAIRN_PATH_EVEN_CENTRAL. */
#define CAIRN_PATH_ALIKE ((unsigned)CAIRN_PATH_WAY & ~(unsigned)CAIRN_PATH_TURN)

/* ---- sweep_careful.c: the same of one contact, from its first point on or from its last ---- */
typedef void cairn_careful_pass(const cairn_world *world, cairn_arbiter *arbiter, bool from_last);
cairn_careful_pass cairn_careful_warm_start, cairn_careful_biased_pass, cairn_careful_relax_pass;
/* Where nothing turns, rubs or bounces a contact is one push along its normal, and one function serves all three passes. */
#define CAIRN_IS_PUSH_ALONE (!CAIRN_WITH_TURNING && !CAIRN_WITH_FRICTION && !CAIRN_WITH_BOUNCE && CAIRN_MAX_POINTS == 1)
typedef enum cairn_pass { CAIRN_WARM_START, CAIRN_BIASED, CAIRN_RELAX } cairn_pass;
void cairn_push_alone(const cairn_world *world, cairn_arbiter *arbiter, cairn_pass pass);
/* The new impulse of a point that was apart when the step began, where the row's velocity is u. */
cairn_motion cairn_biased_apart(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u);
cairn_motion cairn_relaxed_apart(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u);
/* Friction's impulse within its cone, where it slips at u. */
cairn_motion cairn_arbiter_rub(const cairn_world *world, const cairn_arbiter *arbiter, cairn_motion u, cairn_motion impulse);

/*
 * Pairs so slow that the quick ways need cut nothing off, see there. What may add energy to such a pair is cut then: the most by which an
 * impulse that closes a gap changes in a biased pass, and one that is given back in a relax pass (0.30 and three times 2 / 16 are below
 * CAIRN_SWEEP_SPIN).
 */
#define CAIRN_CALM CAIRN_MOTION(1.0 / 32)
#define CAIRN_CLOSED CAIRN_MOTION(1.0 / 4)
#define CAIRN_GIVEN CAIRN_MOTION(1.0 / 16)

typedef cairn_size cairn_sum_with(cairn_size sum, cairn_motion x);

/* The motion of both, of a path for which it is right: a constant where a quick way asks. With the sizes of all, or their squares. */
CAIRN_ALWAYS_INLINE cairn_size cairn_pair_sum(cairn_sum_with *with, cairn_size sum, const cairn_body *a, const cairn_body *b, int path, bool with_spins)
{
    sum = with(with(sum, b->vx), b->vy);
    with_spins = with_spins && CAIRN_WITH_TURNING;
    sum = with_spins ? with(sum, b->w) : sum;
    if (path != CAIRN_PATH_ON_STATIC) {
        sum = with(with(sum, a->vx), a->vy);
        sum = with_spins ? with(sum, a->w) : sum;
    }
    return sum;
}
CAIRN_INLINE bool cairn_is_calm(const cairn_body *a, const cairn_body *b, int path, bool with_spins)
{
    return (CAIRN_KNOWS_SQUARES && cairn_squares_are_below(cairn_pair_sum(cairn_squares_with, 0, a, b, path, with_spins), CAIRN_CALM))
        || cairn_size_is_below(cairn_pair_sum(cairn_size_with, 0, a, b, path, with_spins), CAIRN_CALM);
}

/* Faster pairs are not far from meeting: no sum of that question may wrap. Nor may its rounding tell. */
#define NEARING CAIRN_MOTION(0.25)
#define ROUNDED CAIRN_MOTION(3.7e-9)

/*
 * So far apart that no point can meet in this sub-step: where gap + d > 0, its row presses if gap + v + d < 0, of the motion along the normal; in
 * the biased pass v has beta d in it, so d counts 1 - beta times, which is between nothing and once. Spins add 2 sqrt(2) times each at
 * most, to v and to d: 12 times the greatest of them. What falls together does not near one another at all. Halves are taken where the
 * difference of two displacements may not fit.
 */
static inline bool cairn_is_far(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter)
{
    const cairn_row *rows = arbiter->rows;
    bool second = cairn_arbiter_has_two(arbiter);
    if (rows[0].impulse != 0 || arbiter->friction_impulse != 0 || (second && rows[CAIRN_LAST_ROW].impulse != 0)) {
        return false;
    }
    cairn_motion gap = second && rows[CAIRN_LAST_ROW].gap < rows[0].gap ? rows[CAIRN_LAST_ROW].gap : rows[0].gap;
    cairn_motion vx = b->vx - a->vx, vy = b->vy - a->vy;
    cairn_motion x = cairn_motion_half(b->dx) - cairn_motion_half(a->dx), y = cairn_motion_half(b->dy) - cairn_motion_half(a->dy);
    cairn_size spin = cairn_size_with(cairn_size_with(cairn_size_with(cairn_size_of(a->w), b->w), a->dw), b->dw);
    cairn_size size = cairn_size_with(cairn_size_with(cairn_size_with(cairn_size_with(spin, vx), vy), x), y);
    if (cairn_size_is_far_below(size, gap) || !cairn_size_is_below(size, NEARING)) {
        return cairn_size_is_below(size, NEARING);
    }
    cairn_motion v = cairn_motion_along(vx, vy, arbiter->normal_x, arbiter->normal_y), d = 2 * cairn_motion_along(x, y, arbiter->normal_x, arbiter->normal_y);
    cairn_motion room = gap + (v < 0 && d < 0 ? v + d : v < d ? v : d) - 12 * ROUNDED;
    return room > 0 && cairn_size_is_below(12 * spin, room);
}

/*
 * A soft row's impulse from the rigid one: the mass scaled by 1 - a3 and a3 of the impulse given back, but for the load that
 * is carried. See cairn_soft_yield.
 */
static inline cairn_motion cairn_softened(cairn_motion rigid, cairn_motion load)
{
    return rigid - cairn_soft_yield(rigid - load);
}

#endif
