/* The levels: what stands there, how high the line is, which stones and how much wind. All of it lies in flash. */
#ifndef LEVEL_H
#define LEVEL_H

#include "stone.h"

enum { LEVEL_LAYER = 1, LEVEL_STONES = 24, LEVEL_PIECES = 6 };

typedef enum level_look {
    LOOK_ROCK,
    LOOK_GRASS,
    LOOK_SNOW,
    LOOK_ICE,
    LOOK_PLANK,
    LOOK_PIVOT
} level_look;

/* A body that is there from the start; its shape is a box. */
typedef struct level_piece {
    const cairn_body_model *model;
    cairn_vec2 position;
    cairn_angle angle;
    level_look look;
} level_piece;

typedef struct level {
    const char *name;
    cairn_real goal;   /* height of the line, m */
    cairn_real wind;   /* greatest acceleration of what hangs, m/s^2 */
    cairn_real aim;    /* where a cairn may well be begun: for the machine that plays by itself */
    uint8_t stones;    /* to build with */
    uint8_t piece_count;
    uint8_t dark;      /* of the sky, 0 to 3 */
    stone_style style;
    const level_piece *pieces;
} level;

/* The level of a number from 0 on. They come again, higher and windier. */
int level_count(void);
void level_get(level *out, int number);

#endif
