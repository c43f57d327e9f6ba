/*
 * Blocks, for heavy bodies on light ones. Contacts of bodies of more than 30 times each other's mass are more than the solver's sweeps can
 * settle: at 100 to 1 a box sinks into the one below by a centimetre, from 1000 on that one is squeezed out. With blocks the light
 * bodies between heavy ones, up to six contacts that hang together, are solved at once, to ratios of 262144. It takes 2.3 KB of RAM,
 * 7 KB of flash, and nothing in steps without such contacts.
 */
#ifndef CAIRN_BLOCK_H
#define CAIRN_BLOCK_H

#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

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

/* The layout is the engine's own. */
typedef struct cairn_block {
    const cairn_block_class *kind;
    int row_count, body_count, arbiter_count;
    cairn_wide softness; /* of soft rows, over the matrix' diagonal */
    bool current;        /* velocities and residuals are those of the impulses */
    cairn_block_row rows[CAIRN_BLOCK_ROWS];
    cairn_block_body bodies[CAIRN_BLOCK_BODIES];
    cairn_unit diagonal[CAIRN_BLOCK_ROWS]; /* of the matrix, scaled */
    cairn_block_arbiter arbiters[CAIRN_BLOCK_ARBITERS];
    cairn_block_factors factors;
} cairn_block;

/* Declare, at file scope, the memory in which blocks are solved, one after the other. Two worlds may share it if they are not stepped at the same time. */
#define CAIRN_BLOCKS(name) static cairn_block name

/* Bytes of RAM that it takes, a constant expression. */
#define CAIRN_BLOCKS_BYTES sizeof(cairn_block)

/* Solve heavy bodies on light ones in this world by blocks from now on, in this memory. */
cairn_status cairn_blocks_enable(cairn_world *world, cairn_block *memory);

#ifdef __cplusplus
}
#endif

#endif
