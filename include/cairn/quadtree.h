/*
 * The bounded quadtree, a broad phase for worlds of many bodies above one another (docs/SPEED.md). It lies in memory of fixed
 * size, in boxes wide enough for several steps, and is made anew when a body leaves its own. A full pool makes leaves longer; no pair is ever lost, and bodies outside of its bounds still collide.
 */
#ifndef CAIRN_QUADTREE_H
#define CAIRN_QUADTREE_H

#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cairn_quadtree_cell {
    uint16_t child; /* the first of four, or 0 for a leaf */
    uint16_t first; /* entry list of a leaf */
    uint16_t count;
} cairn_quadtree_cell;

typedef struct cairn_quadtree_entry {
    uint16_t body;
    uint16_t next; /* in its leaf; or of a pair, the other body */
} cairn_quadtree_entry;

/* Where a body was when the tree was made, and half the size of the box in which it is found. */
typedef struct cairn_quadtree_box {
    cairn_spot x, y;
    cairn_extent extent_x, extent_y;
} cairn_quadtree_box;

typedef struct cairn_quadtree {
    cairn_quadtree_box *boxes; /* one a body */
    cairn_quadtree_cell *cells;
    cairn_quadtree_entry *entries;
    uint16_t cell_capacity, entry_capacity;
    uint16_t cell_end, entry_end;
    uint16_t pair_end; /* behind the entries: pairs whose boxes overlap, each once */
    cairn_real x, y;  /* the lower left corner of the root */
    uint8_t size_log2; /* its side is 2^size_log2 m */
    uint8_t depth;
    uint8_t leaf_length;
    bool knows_pairs; /* there was room for all of them */
} cairn_quadtree;

typedef struct cairn_quadtree_storage {
    cairn_quadtree *tree;
    cairn_quadtree_box *boxes;
    cairn_quadtree_cell *cells;
    cairn_quadtree_entry *entries;
    uint16_t box_capacity, cell_capacity, entry_capacity;
} cairn_quadtree_storage;

/*
 * Declare, at file scope, the memory of a tree for a world of so many bodies. Good sizes: as many cells as bodies, four times as many entries, and
 * eight times in heaps, whose pairs are kept behind the entries if there is room for all of them, which is quicker.
 */
#define CAIRN_QUADTREE(name, body_count, cell_count, entry_count) \
    static cairn_quadtree name##_tree; \
    static cairn_quadtree_box name##_boxes[body_count]; \
    static cairn_quadtree_cell name##_cells[cell_count]; \
    static cairn_quadtree_entry name##_entries[entry_count]; \
    static const cairn_quadtree_storage name = { &name##_tree, name##_boxes, name##_cells, name##_entries, \
                                                 (body_count), (cell_count), (entry_count) }

/* Bytes of RAM that it takes, a constant expression. */
#define CAIRN_QUADTREE_BYTES(body_count, cell_count, entry_count) \
    (sizeof(cairn_quadtree) + (body_count) * sizeof(cairn_quadtree_box) + (cell_count) * sizeof(cairn_quadtree_cell) \
     + (entry_count) * sizeof(cairn_quadtree_entry))

/*
 * Use the quadtree instead of the search along x (broad_pairs.c). center: of the square it divides; size_log2: its side is
 * 2^size_log2 m, 0 to 14; depth: most halvings, 1 to 10. At least as many boxes and entries as the world has room for bodies (CAIRN_ERROR_FULL).
 */
cairn_status cairn_quadtree_enable(cairn_world *world, const cairn_quadtree_storage *storage, cairn_vec2 center, int size_log2, int depth);

#ifdef __cplusplus
}
#endif

#endif
