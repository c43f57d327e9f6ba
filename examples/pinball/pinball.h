/* The rules of the pinball table: bumpers and slings kick, lamps light, the ball drains. */
#ifndef PINBALL_H
#define PINBALL_H

#include "table.h"

typedef struct pinball {
    table table;
    uint32_t frame, score, best;
    uint16_t idle;        /* steps without a button: then it plays by itself */
    uint8_t balls;        /* left, the one in play included; 0: the game is over */
    uint8_t charge;       /* of the plunger, steps */
    uint8_t lit;          /* lamps, a set */
    uint8_t glow[TABLE_PARTS]; /* steps for which a part shines */
    bool waiting;         /* the ball lies before the plunger */
    cairn_real camera;
    uint32_t before;
} pinball;

void pinball_start(pinball *p);
/* 1/60 s. LEFT and RIGHT flip, SELECT pulls the plunger. */
void pinball_step(pinball *p, uint32_t buttons);
uint32_t pinball_hash(const pinball *p);

#endif
