/* The way through a quadtree's cells, depth first: a path of bounded length instead of recursion. */
#include "quadtree_walk.h"

void cairn_quadtree_walk_start(const cairn_quadtree *tree, cairn_quadtree_walk *walk)
{
    walk->depth = 0;
    walk->path[0].x = tree->x;
    walk->path[0].y = tree->y;
    walk->path[0].size = cairn_real_from_int((int32_t)1 << tree->size_log2);
    walk->path[0].cell = 0;
}

/* Quadrants are numbered from the lower left: 1 is to its right, 2 above it, 3 both. */
static void enter(cairn_quadtree_walk *walk, uint16_t first_child, int quadrant)
{
    const cairn_quadtree_place *parent = &walk->path[walk->depth++];
    cairn_quadtree_place *child = &walk->path[walk->depth];
    child->size = cairn_real_half(parent->size);
    child->x = (quadrant & 1) ? parent->x + child->size : parent->x;
    child->y = (quadrant & 2) ? parent->y + child->size : parent->y;
    child->cell = (uint16_t)(first_child + quadrant);
}

bool cairn_quadtree_walk_next(const cairn_quadtree *tree, cairn_quadtree_walk *walk)
{
    uint16_t child = tree->cells[walk->path[walk->depth].cell].child;
    if (child != 0) {
        enter(walk, child, 0);
        return true;
    }
    while (walk->depth > 0) {
        uint16_t cell = walk->path[walk->depth--].cell;
        uint16_t first = tree->cells[walk->path[walk->depth].cell].child;
        if (cell - first < 3) {
            enter(walk, first, cell - first + 1);
            return true;
        }
    }
    return false;
}
