/*
 * A block: a few light bodies under heavy ones, and the contacts that touch them, solved together. block_find.c finds it, block.c gathers it and
 * block_solve.c solves it; it lives on the stack for one pass.
 */
#ifndef CAIRN_BLOCK_H
#define CAIRN_BLOCK_H

#include "engine.h"

/* Rows of a block; each arbiter has a row a point and one for friction. Its matrix takes 4 bytes a pair of rows. */
#define CAIRN_BLOCK_ROWS 18
/* Each arbiter has at least two rows, and all of them hang together. */
#define CAIRN_BLOCK_ARBITERS (CAIRN_BLOCK_ROWS / 2)
#define CAIRN_BLOCK_BODIES (CAIRN_BLOCK_ARBITERS + 1)
#define CAIRN_BLOCK_PAIRS (CAIRN_BLOCK_ROWS * (CAIRN_BLOCK_ROWS + 1) / 2)

typedef struct cairn_block_body {
    cairn_body *body;
    cairn_wide inverse;      /* mass of the block's lightest body / mass; 0 if not dynamic */
    cairn_push px, py, pw;   /* what it was given in this pass: velocity * mass / mass of the lightest */
    cairn_push vx, vy, vw;   /* the velocity with that */
} cairn_block_body;

/* Where a row stands. */
typedef enum cairn_block_state {
    CAIRN_ROW_FREE, /* its velocity is brought to zero */
    CAIRN_ROW_LOW,  /* at its least impulse */
    CAIRN_ROW_HIGH  /* at its greatest */
} cairn_block_state;

typedef enum cairn_block_kind {
    CAIRN_ROW_RIGID,   /* a point, impulse from 0 up */
    CAIRN_ROW_SOFT,    /* a point that yields */
    CAIRN_ROW_FRICTION /* impulse from -limit to limit */
} cairn_block_kind;

typedef struct cairn_block_row {
    cairn_push impulse;  /* impulse * h / mass of the lightest */
    cairn_push limit;
    cairn_push residual; /* the velocity that is to vanish, or not to be negative */
    cairn_motion bias;   /* what is added to the velocity */
    cairn_dir x, y;
    cairn_lever lever_a, lever_b;
    uint8_t arbiter;     /* of the block */
    uint8_t kind, state;
    int8_t scale;        /* the matrix is scaled by 2^-scale, row and column, so that its diagonal is in [1/4, 1) */
} cairn_block_row;

typedef struct cairn_block_arbiter {
    uint16_t place;
    uint8_t a, b; /* bodies of the block */
} cairn_block_arbiter;

/* The free rows' part of the matrix, as L D L^T. */
typedef struct cairn_block_factors {
    int count;
    bool valid;
    uint8_t rows[CAIRN_BLOCK_ROWS];
    cairn_unit column[CAIRN_BLOCK_PAIRS]; /* the lower triangle: d, and below it l d */
    cairn_wide inverse[CAIRN_BLOCK_ROWS]; /* 1 / d */
} cairn_block_factors;

typedef struct cairn_block {
    int row_count, body_count, arbiter_count;
    cairn_wide softness; /* of soft rows, over the matrix' diagonal */
    bool current;        /* velocities and residuals are those of the impulses */
    cairn_block_row rows[CAIRN_BLOCK_ROWS];
    cairn_block_body bodies[CAIRN_BLOCK_BODIES];
    cairn_unit diagonal[CAIRN_BLOCK_ROWS]; /* of the matrix, scaled */
    cairn_block_arbiter arbiters[CAIRN_BLOCK_ARBITERS];
    cairn_block_factors factors;
} cairn_block;

static inline cairn_block_body *cairn_block_a(cairn_block *block, const cairn_block_row *row) { return &block->bodies[block->arbiters[row->arbiter].a]; }
static inline cairn_block_body *cairn_block_b(cairn_block *block, const cairn_block_row *row) { return &block->bodies[block->arbiters[row->arbiter].b]; }

/* ---- block_find.c ---- */
static inline uint8_t cairn_block_of(const cairn_arbiter *arbiter) { return arbiter->block & CAIRN_BLOCK_NUMBER; }
/* The blocks of this step. */
void cairn_block_find(cairn_world *world);
/* The sweeps take this one. */
void cairn_block_dissolve(cairn_world *world, uint8_t number);
/* There are none from now on. */
void cairn_block_release(cairn_world *world);

/* ---- block_solve.c ---- */
/* Scale a new row by its diagonal. */
void cairn_block_scale_row(cairn_block *block, int row);
/* Change an impulse and the bodies' momentum with it. */
void cairn_block_press(cairn_block *block, cairn_block_row *row, cairn_push change);
/* The bodies' velocities and the rows' residuals as they are now. */
void cairn_block_evaluate(cairn_block *block);
/* Impulses that satisfy every row, friction apart: within the limits that it has. False if none were found. */
bool cairn_block_settle(cairn_block *block);

#endif
