/*
 * The slides' own scheme, as a second solver and the baseline of comparisons: k passes of sequential impulses over the
 * whole step, accumulated clamping, Baumgarte's bias, no warm start, no sub-steps.
 */
#ifndef CAIRN_SOLVER_H
#define CAIRN_SOLVER_H

#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const cairn_solver_class cairn_solver_slides;

/* Use the slides' scheme with this many passes (1 to 100, the slides take 10). Sets the sub-steps to 1 and the slop to 1 cm. */
cairn_status cairn_world_use_slides_solver(cairn_world *world, int passes);

#ifdef __cplusplus
}
#endif

#endif
