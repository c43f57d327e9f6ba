/* The way through the cells of a quadtree, for the broad phase and for drawing. */
#ifndef CAIRN_QUADTREE_WALK_H
#define CAIRN_QUADTREE_WALK_H

#include "engine.h"
#include <cairn/quadtree.h>

#define CAIRN_QUADTREE_DEPTH 10 /* most halvings */

/* Where a cell is: its lower left corner and its side. */
typedef struct cairn_quadtree_place {
    cairn_real x, y, size;
    uint16_t cell;
} cairn_quadtree_place;

/* The cells from the root to the present one, and where that is. */
typedef struct cairn_quadtree_walk {
    int depth;
    cairn_quadtree_place place;
    int32_t column, row; /* its corner, counted in its own size from the root's */
    uint16_t path[CAIRN_QUADTREE_DEPTH + 1];
} cairn_quadtree_walk;

/* At the root. */
void cairn_quadtree_walk_start(const cairn_quadtree *tree, cairn_quadtree_walk *walk);
/* To the first child of the present cell, else to the next cell that was not visited; false at the end. */
bool cairn_quadtree_walk_next(const cairn_quadtree *tree, cairn_quadtree_walk *walk);

#endif
