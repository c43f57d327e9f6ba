/*
 * A platformer in small: a hero who runs and jumps, ledges that are solid from above only, a platform that moves, coins.
 * The jump is the rule of examples/jump.
 */
#ifndef HOP_H
#define HOP_H

#include <cairn/cairn.h>

enum { HOP_LEDGES = 6, HOP_COINS = 8, HOP_GROUNDS = 3, HOP_CRATES = 3 };

typedef struct hop {
    cairn_world *world;
    cairn_body_id hero, platform;
    cairn_body_id grounds[HOP_GROUNDS], ledges[HOP_LEDGES], coins[HOP_COINS], crates[HOP_CRATES];
    uint8_t solid;      /* ledges that carry the hero now, a set */
    uint8_t got;        /* coins, a set */
    int8_t facing;
    uint32_t frame, before, best; /* best: frames for all coins; 0: never yet */
    uint32_t clock;     /* frames since the start of this run */
    uint16_t done;      /* frames since the last coin */
    uint16_t idle;
    cairn_real camera_x, camera_y;
} hop;

void hop_start(hop *h);
/* 1/60 s. LEFT and RIGHT run, SELECT or UP jumps, DOWN drops through a ledge. */
void hop_step(hop *h, uint32_t buttons);
uint32_t hop_hash(const hop *h);

#endif
