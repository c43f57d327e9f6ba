/* The way through a quadtree's cells, depth first: a path of bounded length instead of recursion. */
#include "quadtree_walk.h"

void cairn_quadtree_walk_start(const cairn_quadtree *tree, cairn_quadtree_walk *walk)
{
    walk->depth = 0;
    walk->column = walk->row = 0;
    walk->place.x = tree->x;
    walk->place.y = tree->y;
    walk->place.size = cairn_real_from_int((int32_t)1 << tree->size_log2);
    walk->place.cell = walk->path[0] = 0;
}

/* Quadrants are numbered from the lower left: 1 is to its right, 2 above it, 3 both. */
CAIRN_ONCE void enter(const cairn_quadtree *tree, cairn_quadtree_walk *walk, uint16_t first_child, int quadrant)
{
    cairn_quadtree_place *place = &walk->place;
    walk->depth++;
    walk->column = 2 * walk->column + (quadrant & 1);
    walk->row = 2 * walk->row + (quadrant >> 1);
    place->size = cairn_real_half(place->size);
    place->x = tree->x + walk->column * place->size; /* sizes are powers of two: exact in both arithmetics, by whichever way it came */
    place->y = tree->y + walk->row * place->size;
    place->cell = walk->path[walk->depth] = (uint16_t)(first_child + quadrant);
}

static void leave(cairn_quadtree_walk *walk)
{
    walk->depth--;
    walk->column >>= 1;
    walk->row >>= 1;
    walk->place.size += walk->place.size;
}

/* To the next cell, without those below the present one. */
static bool walk_over(const cairn_quadtree *tree, cairn_quadtree_walk *walk)
{
    while (walk->depth > 0) {
        uint16_t cell = walk->path[walk->depth];
        leave(walk);
        uint16_t first = tree->cells[walk->path[walk->depth]].child;
        if (cell - first < 3) {
            enter(tree, walk, first, cell - first + 1);
            return true;
        }
    }
    return false;
}

bool cairn_quadtree_walk_next(const cairn_quadtree *tree, cairn_quadtree_walk *walk)
{
    uint16_t child = tree->cells[walk->place.cell].child;
    if (child != 0) {
        enter(tree, walk, child, 0);
        return true;
    }
    return walk_over(tree, walk);
}
