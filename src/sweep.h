/* The passes of the soft solver over the contacts: sweep.c has the quick ways, sweep_careful.c what serves in all cases. */
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

/* ---- sweep_careful.c: the same of one contact, from its first point on or from its last ---- */
void cairn_careful_warm_start(const cairn_world *world, cairn_arbiter *arbiter, bool from_last);
void cairn_careful_biased_pass(const cairn_world *world, cairn_arbiter *arbiter, bool from_last);
void cairn_careful_relax_pass(const cairn_world *world, cairn_arbiter *arbiter, bool from_last);
/* The new impulse of a point that was apart when the step began, where the row's velocity is u. */
cairn_motion cairn_biased_apart(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u);
cairn_motion cairn_relaxed_apart(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u);
/* Friction's impulse within its cone, where it slips at u. */
cairn_motion cairn_arbiter_rub(const cairn_world *world, const cairn_arbiter *arbiter, cairn_motion u, cairn_motion impulse);

/*
 * A soft row's impulse from the rigid one: the mass scaled by 1 - a3 and a3 of the impulse given back, but for the load that
 * is carried. See cairn_soft_yield.
 */
static inline cairn_motion cairn_softened(cairn_motion rigid, cairn_motion load)
{
    return rigid - cairn_soft_yield(rigid - load);
}

#endif
