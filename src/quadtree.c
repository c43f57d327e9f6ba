/*
 * The quadtree, in place of broad_pairs.c. Each step it is rebuilt and searched in one walk: a cell that holds many
 * bodies is split, a leaf's bodies are held against one another. Coordinates are cairn_real; only comparisons,
 * additions and halvings are needed.
 *
 * Cells at the border reach to infinity, since a body's place is decided by the centre lines alone: bodies outside of
 * the bounds need no care. A pair that meets in several leaves is reported in the one that holds the lower left corner
 * of the boxes' overlap.
 */
#include "quadtree_walk.h"

#define LEAF_LENGTH 8 /* a leaf of so many bodies is not worth a split: the quickest of 4 to 14 on a Cortex-M0 but for a few per cent */

typedef struct bounds {
    cairn_real left, right, bottom, top;
} bounds;

static bounds bounds_of(const cairn_body *body)
{
    bounds box;
    cairn_real x = cairn_real_from_extent(body->extent_x), y = cairn_real_from_extent(body->extent_y);
    box.left = body->x - x;
    box.right = body->x + x;
    box.bottom = body->y - y;
    box.top = body->y + y;
    return box;
}

/* ---- building ---- */

static void push(cairn_quadtree *tree, cairn_quadtree_cell *cell, uint16_t entry)
{
    tree->entries[entry].next = cell->first;
    cell->first = entry;
    cell->count++;
}

static void empty(cairn_quadtree_cell *cell)
{
    cell->child = 0;
    cell->first = CAIRN_NONE;
    cell->count = 0;
}

/* All bodies into the root, the first of the pool in front. There are at least as many entries as bodies. */
static void fill_root(const cairn_world *world, cairn_quadtree *tree)
{
    empty(&tree->cells[0]);
    tree->cell_end = 1;
    tree->entry_end = 0;
    for (uint16_t i = world->body_end; i > 0; i--) {
        if (world->bodies[i - 1].flags & CAIRN_BODY_USED) {
            tree->entries[tree->entry_end].body = (uint16_t)(i - 1);
            push(tree, &tree->cells[0], tree->entry_end++);
        }
    }
}

/* The quadrants that a body's box meets, as bits. */
static unsigned quadrants_of(const cairn_body *body, cairn_real x, cairn_real y)
{
    bounds box = bounds_of(body);
    unsigned columns = (box.left < x ? 5u : 0u) | (box.right >= x ? 10u : 0u);
    unsigned rows = (box.bottom < y ? 3u : 0u) | (box.top >= y ? 12u : 0u);
    return columns & rows;
}

/* By quadrants: how many there are, and the one there is, or STRADDLING. */
enum { STRADDLING = 4 };
static const uint8_t quadrant_count[16] = { 0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4 };
static const uint8_t quadrant_home[16] = { 4, 0, 1, 4, 2, 4, 4, 4, 3, 4, 4, 4, 4, 4, 4, 4 };

/* A cell's bodies by quadrant; those that lie in several are in the last list. */
typedef struct sorting {
    cairn_quadtree_cell list[STRADDLING + 1];
    uint32_t needed; /* entries, if the cell is split */
    uint32_t small;  /* bodies at most half as wide as a quadrant: those that a split tells apart */
} sorting;

static void sort(const cairn_world *world, cairn_quadtree *tree, const cairn_quadtree_place *place, sorting *s)
{
    cairn_real half = cairn_real_half(place->size), eighth = cairn_real_half(cairn_real_half(half));
    cairn_real x = place->x + half, y = place->y + half;
    uint16_t entry = tree->cells[place->cell].first;
    s->needed = s->small = 0;
    for (int i = 0; i <= STRADDLING; i++) {
        empty(&s->list[i]);
    }
    while (entry != CAIRN_NONE) {
        uint16_t next = tree->entries[entry].next;
        const cairn_body *body = &world->bodies[tree->entries[entry].body];
        unsigned quadrants = quadrants_of(body, x, y);
        push(tree, &s->list[quadrant_home[quadrants]], entry);
        s->needed += quadrant_count[quadrants];
        s->small += cairn_real_from_extent(body->extent_x) <= eighth && cairn_real_from_extent(body->extent_y) <= eighth ? 1u : 0u;
        entry = next;
    }
}

/* Move a list into a cell. */
static void move(cairn_quadtree *tree, uint16_t entry, cairn_quadtree_cell *cell)
{
    while (entry != CAIRN_NONE) {
        uint16_t next = tree->entries[entry].next;
        push(tree, cell, entry);
        entry = next;
    }
}

/* The cell stays a leaf. */
static void join(cairn_quadtree *tree, cairn_quadtree_cell *cell, const sorting *s)
{
    empty(cell);
    for (int i = 0; i <= STRADDLING; i++) {
        move(tree, s->list[i].first, cell);
    }
}

/* A body that lies in several quadrants takes an entry in each. */
static void spread(cairn_quadtree *tree, cairn_quadtree_cell *children, unsigned quadrants, uint16_t entry)
{
    uint16_t body = tree->entries[entry].body;
    for (int i = 0; quadrants != 0; i++, quadrants >>= 1) {
        if (quadrants & 1u) {
            tree->entries[entry].body = body;
            push(tree, &children[i], entry);
            entry = quadrants > 1 ? tree->entry_end++ : entry;
        }
    }
}

/* The cell gets four children; the entries they need are there. */
static void split(const cairn_world *world, cairn_quadtree *tree, const cairn_quadtree_place *place, const sorting *s)
{
    cairn_quadtree_cell *children = &tree->cells[tree->cell_end];
    cairn_real half = cairn_real_half(place->size);
    uint16_t entry = s->list[STRADDLING].first;
    for (int i = 0; i < 4; i++) {
        children[i] = s->list[i];
    }
    while (entry != CAIRN_NONE) {
        uint16_t next = tree->entries[entry].next;
        spread(tree, children, quadrants_of(&world->bodies[tree->entries[entry].body], place->x + half, place->y + half), entry);
        entry = next;
    }
    tree->cells[place->cell].child = tree->cell_end;
    tree->cell_end = (uint16_t)(tree->cell_end + 4);
}

/*
 * Split the cell if that helps and the pools allow it. It does not help where few bodies are small enough to be told
 * apart by it, or most lie in several quadrants.
 */
CAIRN_APART void refine(cairn_world *world, cairn_quadtree *tree, const cairn_quadtree_walk *walk)
{
    const cairn_quadtree_place *place = &walk->place;
    cairn_quadtree_cell *cell = &tree->cells[place->cell];
    uint32_t count = cell->count;
    sorting s;
    if (count <= tree->leaf_length || walk->depth >= tree->depth) {
        return;
    }
    sort(world, tree, place, &s);
    bool helps = s.small > tree->leaf_length && s.needed <= 2 * count;
    bool fits = (uint32_t)tree->cell_end + 4 <= tree->cell_capacity && tree->entry_end + s.needed - count <= tree->entry_capacity;
    if (helps && fits) {
        split(world, tree, place, &s);
    } else {
        join(tree, cell, &s);
        world->stats.tree_full = (uint16_t)(world->stats.tree_full + (helps ? 1 : 0));
    }
}

/* ---- pairs ---- */

/* The larger of the two lower bounds lies in the last cell that both bodies reach; is it this one? */
static bool is_last(cairn_real a, cairn_real b, cairn_real cell, cairn_real root)
{
    return a >= cell || b >= cell || cell <= root;
}

CAIRN_APART bool reports(const cairn_quadtree *tree, const cairn_quadtree_place *place, const cairn_body *a, const cairn_body *b)
{
    bounds box_a = bounds_of(a), box_b = bounds_of(b);
    return is_last(box_a.left, box_b.left, place->x, tree->x) && is_last(box_a.bottom, box_b.bottom, place->y, tree->y);
}

/* One body against those behind it in the leaf. */
static void pair_with_rest(cairn_world *world, const cairn_quadtree *tree, const cairn_quadtree_place *place, const cairn_quadtree_entry *entry)
{
    const cairn_body *a = &world->bodies[entry->body];
    bool idle = !cairn_body_is_active(a);
    for (uint16_t other = entry->next; other != CAIRN_NONE; other = tree->entries[other].next) {
        uint16_t index = tree->entries[other].body;
        const cairn_body *b = &world->bodies[index];
        if (cairn_boxes_are_near(a, b, 0) && !(idle && !cairn_body_is_active(b)) && reports(tree, place, a, b)) {
            cairn_arbiter_pair(world, entry->body, index);
        }
    }
}

static void find_pairs(cairn_world *world)
{
    cairn_quadtree *tree = world->tree;
    cairn_quadtree_walk walk;
    world->stats.tree_full = 0;
    fill_root(world, tree);
    cairn_quadtree_walk_start(tree, &walk);
    do {
        const cairn_quadtree_place *place = &walk.place;
        refine(world, tree, &walk);
        if (tree->cells[place->cell].child == 0) {
            for (uint16_t entry = tree->cells[place->cell].first; entry != CAIRN_NONE; entry = tree->entries[entry].next) {
                pair_with_rest(world, tree, place, &tree->entries[entry]);
            }
        }
    } while (cairn_quadtree_walk_next(tree, &walk));
    world->stats.tree_cells = tree->cell_end;
    world->stats.tree_entries = tree->entry_end;
}

static const cairn_broad_class quadtree_class = { find_pairs };

/* ---- set-up ---- */

static cairn_status check(const cairn_world *world, const cairn_quadtree_storage *storage, cairn_vec2 center, int size_log2, int depth)
{
    if (storage == NULL || storage->tree == NULL || storage->cells == NULL || storage->entries == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (world->locked) {
        return CAIRN_ERROR_LOCKED;
    }
    if (size_log2 < 0 || size_log2 > 14 || depth < 1 || depth > CAIRN_QUADTREE_DEPTH || center.x > CAIRN_WORLD_EDGE
        || -center.x > CAIRN_WORLD_EDGE || center.y > CAIRN_WORLD_EDGE || -center.y > CAIRN_WORLD_EDGE) {
        return CAIRN_ERROR_RANGE;
    }
    return storage->cell_capacity == 0 || storage->entry_capacity < world->body_capacity ? CAIRN_ERROR_FULL : CAIRN_OK;
}

cairn_status cairn_quadtree_enable(cairn_world *world, const cairn_quadtree_storage *storage, cairn_vec2 center, int size_log2, int depth)
{
    if (world == NULL) {
        return CAIRN_ERROR_NULL;
    }
    cairn_status status = check(world, storage, center, size_log2, depth);
    if (status != CAIRN_OK) {
        return cairn_fail(world, status);
    }
    cairn_quadtree *tree = storage->tree;
    cairn_real half = cairn_real_half(cairn_real_from_int((int32_t)1 << size_log2));
    memset(tree, 0, sizeof *tree);
    tree->cells = storage->cells;
    tree->entries = storage->entries;
    tree->cell_capacity = storage->cell_capacity;
    tree->entry_capacity = storage->entry_capacity;
    tree->x = center.x - half;
    tree->y = center.y - half;
    tree->size_log2 = (uint8_t)size_log2;
    tree->depth = (uint8_t)depth;
    tree->leaf_length = LEAF_LENGTH;
    fill_root(world, tree);
    world->tree = tree;
    world->broad = &quadtree_class;
    return CAIRN_OK;
}
