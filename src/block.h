/*
 * A block: a few light bodies under heavy ones, and the contacts that touch them, solved together. block_find.c finds it, block.c gathers it in
 * the game's memory for one pass, and block_solve.c solves it.
 */
#ifndef CAIRN_BLOCK_PARTS_H
#define CAIRN_BLOCK_PARTS_H

#include "engine.h"
#include <cairn/block.h>

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
