/* The balloon over the cairn and the rope under it, a spring on which the stone hangs. */
#ifndef CRANE_H
#define CRANE_H

#include "stone.h"

#include <cairn/spring.h>

#define CRANE_ROPE CAIRN_F(1.0)  /* m */
#define CRANE_REACH CAIRN_F(3.5) /* to both sides */

typedef struct crane {
    cairn_body_id trolley;
    cairn_spring_id rope; /* null: nothing hangs on it */
    cairn_body_model hung; /* of what hangs */
    stone *load;
} crane;

/* What a player asks of it in a step. */
typedef struct crane_wish {
    int8_t move; /* -1 left, 1 right */
    int8_t turn; /* 1 counter-clockwise */
} crane_wish;

/* Put the balloon there. False if the world has no room. */
bool crane_start(crane *c, cairn_world *world, cairn_vec2 position);
/* Hang a stone on it, turned so; false if there is no room. */
bool crane_hang(crane *c, cairn_world *world, stone *s, cairn_angle angle);
/* Move, rise or sink towards a height, turn the load, and let the wind push it. */
void crane_step(crane *c, cairn_world *world, crane_wish wish, cairn_real height, cairn_real wind);
/* Let go: the stone falls from now on. Null if nothing hangs. */
stone *crane_drop(crane *c, cairn_world *world);

#endif
