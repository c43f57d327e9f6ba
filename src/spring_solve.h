/* What spring.c (the pool and the game's calls) and spring_solve.c (the sub-step) share. */
#ifndef CAIRN_SPRING_SOLVE_H
#define CAIRN_SPRING_SOLVE_H

#include "engine.h"
#include <cairn/spring.h>

/* spring.flags */
enum {
    CAIRN_SPRING_USED = 1,
    CAIRN_SPRING_NO_CONTACT = 2,
    CAIRN_SPRING_FRESH = 4,     /* has not pulled yet */
    CAIRN_SPRING_EXACT = 8,     /* solved by the exact map, alone */
    CAIRN_SPRING_HEAD = 16,     /* the first of a path */
    CAIRN_SPRING_IN_PATH = 32,
    CAIRN_SPRING_BACKWARDS = 64 /* the path goes from its b to its a */
};

/* Where a spring is. */
typedef struct cairn_reach {
    cairn_offset2 arm_a, arm_b; /* from the centres of mass, in the world */
    cairn_unit x, y;            /* direction from the anchor of a to that of b */
    cairn_offset length;
} cairn_reach;

/* With the displacements of this step. */
void cairn_spring_measure(const cairn_spring *spring, const cairn_body *a, const cairn_body *b, cairn_reach *reach);

void cairn_springs_prepare(cairn_world *world);
void cairn_springs_substep(cairn_world *world, int substep);

#endif
