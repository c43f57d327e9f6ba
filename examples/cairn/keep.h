/* A game that outlives its image: plain data of fixed layout, with a checksum. What hangs or falls is not in it. */
#ifndef KEEP_H
#define KEEP_H

#include "round.h"

typedef struct keep_stone {
    uint32_t seed;
    int32_t x, y, angle;
} keep_stone;

typedef struct keep {
    uint32_t magic, checksum; /* of all behind it */
    uint32_t best, points;
    uint32_t random, wind_a, wind_b;
    int32_t piece_angle[LEVEL_PIECES];
    uint16_t number;
    uint8_t playing; /* 0: only the best score counts */
    uint8_t lives, supply, streak, count;
    uint8_t unused;
    keep_stone stones[LEVEL_STONES];
} keep;

/* Write down a game: the round if it is being played, and the score. */
void keep_take(keep *k, const game_round *r, const score *s);
/* The best score alone. */
void keep_take_best(keep *k, const score *s);
/* Is this one of ours, and whole? */
bool keep_is_valid(const keep *k);
/* Go on where it was, but for the stones. The seed of the round is not needed: all that came of it is written down. */
void keep_restore(const keep *k, game_round *r, score *s);
/* Then put some of the stones into place, from a number on; returns the number of the first that is not there yet. To make a
   stone's shape takes time: all 24 at once are more than a frame has. */
int keep_restore_stones(const keep *k, game_round *r, int from, int count);

#endif
