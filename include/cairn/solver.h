/*
 * The two solvers beside the soft one (world.h): up to k passes of sequential impulses over the whole step, without sub-steps, until nothing changes.
 *
 * The slides' own scheme is the baseline of comparisons: accumulated clamping, Baumgarte's bias, nothing kept from the step before. Stacks of six fall.
 * The small one is for games whose flash is short: the same passes, which start with the impulses of the step before and let nothing come nearer in
 * a step than it is. Stacks of 17 unit boxes and a pyramid of 210 stand at 10 passes and come to rest. With CAIRN_WITH_SOFT_SOLVER 0
 * (config.h) all that comes with the soft solver is left out: games of boxes and polygons take half of the flash.
 *
 * What it lacks: bodies of 30 times another one's mass on top of it sink in and squeeze it out, and far heavier ones press it through the floor; contacts
 * lie up to the slop, 1 cm, deep; smaller boxes stack less high, as they all do at fewer steps a second or with less slop; what meets in flight
 * rebounds up to a step's way early (restitution 0.5 from 5 m: back to 1.37 m in place of 1.25); no speed beyond 48.9 m/s at 60 steps a second, to which a
 * change from the soft solver cuts what is faster; moving piles take two to three times the soft solver's instructions; what spins, rubs and
 * bounces almost fully may gain energy. Without continuous collision corners turn aside what is fast and would just pass them, and what bounces
 * rebounds from them.
 */
#ifndef CAIRN_SOLVER_H
#define CAIRN_SOLVER_H

#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * cairn_world_init_with() takes &cairn_solver_slides or &cairn_solver_small too: 10 passes, 1 sub-step, a slop of 1 cm.
 *
 * Use one of them with this many passes, 1 to 100. Sets the sub-steps to 1, which these solvers have no more than, and the slop to 1 cm. Blocks are
 * given up. Errors: CAIRN_ERROR_NULL, CAIRN_ERROR_LOCKED, CAIRN_ERROR_RANGE, CAIRN_ERROR_KIND where the build has no such solver, or,
 * with CAIRN_WITH_SETTINGS 0, for other passes than 10.
 */
cairn_status cairn_world_use_slides_solver(cairn_world *world, int passes);
cairn_status cairn_world_use_small_solver(cairn_world *world, int passes);

#ifdef __cplusplus
}
#endif

#endif
