/*
 * Sleep: groups of bodies that touch or are joined by springs, and have been at rest for half a second, stop costing anything until something
 * touches, moves, pushes, changes or removes one of them, or one of their springs or the other end of it. Then the group wakes as a whole.
 */
#ifndef CAIRN_SLEEP_H
#define CAIRN_SLEEP_H

#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Let bodies of this world fall asleep. */
cairn_status cairn_sleep_enable(cairn_world *world);
/* Wake everything and let nothing fall asleep any more. */
cairn_status cairn_sleep_disable(cairn_world *world);

#ifdef __cplusplus
}
#endif

#endif
