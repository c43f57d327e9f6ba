/*
 * The quadtree, in place of broad_pairs.c. A cell that holds many bodies is split, a leaf's bodies are held against one another.
 * Coordinates are cairn_real; only comparisons, additions and halvings are needed.
 *
 * Bodies lie in the tree by boxes that are wider than they need at the time, and it serves until one of them leaves its own. Which of these boxes
 * overlap is known as long: those pairs lie behind the entries, so that a step looks at them alone and enters no cell. Where they do not fit, and in
 * builds without quick ways, all bodies of a leaf are held against one another in each step.
 *
 * Cells at the border reach to infinity, since a body's place is decided by the centre lines alone: bodies outside of
 * the bounds need no care. A pair that meets in several leaves is kept in the one that holds the lower left corner
 * of the boxes' overlap.
 */
#include "quadtree_walk.h"

#define LEAF_LENGTH 8 /* a leaf of so many bodies is not worth a split: the quickest of 4 to 14 on a Cortex-M0 but for a few per cent */

/* The centre of the box in which the tree has a body: the same for as long as it is in it. */
static inline cairn_real center_x(const cairn_world *world, uint16_t body) { return cairn_spot_real(world->tree->boxes[body].x, world->bodies[body].x); }
static inline cairn_real center_y(const cairn_world *world, uint16_t body) { return cairn_spot_real(world->tree->boxes[body].y, world->bodies[body].y); }

/* ---- boxes for several steps ---- */

/* Room for twenty steps as it moves now and an eighth of its half size, but for no more than half as much again as that size. */
static cairn_extent wider(cairn_extent extent, cairn_real way)
{
    cairn_real half = cairn_real_from_extent(extent), more = 20 * way + half / 8, most = half + half / 2;
    return cairn_extent_above(half + (more < most ? more : most) + CAIRN_F(1.0 / 128));
}

CAIRN_ONCE void set_box(const cairn_body *body, cairn_quadtree_box *box)
{
    cairn_real way = cairn_body_way(body);
    bool stays = (body->flags & CAIRN_STATIC) != 0;
    box->x = cairn_spot_of(body->x);
    box->y = cairn_spot_of(body->y);
    box->extent_x = stays ? cairn_extent_above(cairn_real_from_extent(body->extent_x) + CAIRN_F(1.0 / 256)) : wider(body->extent_x, way);
    box->extent_y = stays ? cairn_extent_above(cairn_real_from_extent(body->extent_y) + CAIRN_F(1.0 / 256)) : wider(body->extent_y, way);
}

static inline bool is_in(const cairn_body *body, const cairn_quadtree_box *box)
{
    return body->extent_x + cairn_spot_way(box->x, body->x) <= box->extent_x && body->extent_y + cairn_spot_way(box->y, body->y) <= box->extent_y;
}

CAIRN_APART bool all_are_in(const cairn_world *world)
{
    const cairn_body *end = world->bodies + world->body_end;
    const cairn_quadtree_box *box = world->tree->boxes;
    for (const cairn_body *body = world->bodies; body != end; body++, box++) {
        if ((body->flags & CAIRN_BODY_USED) && !is_in(body, box)) {
            return false;
        }
    }
    return true;
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
static unsigned quadrants_of(const cairn_world *world, uint16_t body, cairn_real x, cairn_real y)
{
    const cairn_quadtree_box *box = &world->tree->boxes[body];
    cairn_real right = center_x(world, body) - x, up = center_y(world, body) - y;
    cairn_real half_x = cairn_real_from_extent(box->extent_x), half_y = cairn_real_from_extent(box->extent_y);
    unsigned columns = (right < half_x ? 5u : 0u) | (right >= -half_x ? 10u : 0u);
    unsigned rows = (up < half_y ? 3u : 0u) | (up >= -half_y ? 12u : 0u);
    return columns & rows;
}

/* By quadrants: how many there are. */
static const uint8_t quadrant_count[16] = { 0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4 };

/* What a split of a cell would take, and tell apart. */
typedef struct prospect {
    uint32_t needed; /* entries, if the cell is split */
    uint32_t small;  /* bodies at most half as wide as a quadrant: those that a split tells apart */
} prospect;

static prospect prospect_of(const cairn_world *world, const cairn_quadtree *tree, const cairn_quadtree_place *place)
{
    cairn_real half = cairn_real_half(place->size), eighth = cairn_real_half(cairn_real_half(half));
    prospect p = { 0, 0 };
    for (uint16_t entry = tree->cells[place->cell].first; entry != CAIRN_NONE; entry = tree->entries[entry].next) {
        uint16_t body = tree->entries[entry].body;
        const cairn_quadtree_box *box = &tree->boxes[body];
        p.needed += quadrant_count[quadrants_of(world, body, place->x + half, place->y + half)];
        p.small += cairn_real_from_extent(box->extent_x) <= eighth && cairn_real_from_extent(box->extent_y) <= eighth ? 1u : 0u;
    }
    return p;
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
static void split(const cairn_world *world, cairn_quadtree *tree, const cairn_quadtree_place *place)
{
    cairn_quadtree_cell *cell = &tree->cells[place->cell], *children = &tree->cells[tree->cell_end];
    cairn_real half = cairn_real_half(place->size);
    for (int i = 0; i < 4; i++) {
        empty(&children[i]);
    }
    for (uint16_t entry = cell->first, next; entry != CAIRN_NONE; entry = next) {
        next = tree->entries[entry].next;
        spread(tree, children, quadrants_of(world, tree->entries[entry].body, place->x + half, place->y + half), entry);
    }
    cell->child = tree->cell_end;
    tree->cell_end = (uint16_t)(tree->cell_end + 4);
}

/*
 * Split the cell if that helps and the pools allow it. It does not help where few bodies are small enough to be told
 * apart by it, or most lie in several quadrants.
 */
CAIRN_APART void refine(cairn_world *world, cairn_quadtree *tree, const cairn_quadtree_walk *walk)
{
    const cairn_quadtree_place *place = &walk->place;
    uint32_t count = tree->cells[place->cell].count;
    if (count <= tree->leaf_length || walk->depth >= tree->depth) {
        return;
    }
    prospect p = prospect_of(world, tree, place);
    bool helps = p.small > tree->leaf_length && p.needed <= 2 * count;
    bool fits = (uint32_t)tree->cell_end + 4 <= tree->cell_capacity && tree->entry_end + p.needed - count <= tree->entry_capacity;
    if (helps && fits) {
        split(world, tree, place);
    } else {
        world->stats.tree_full = (uint16_t)(world->stats.tree_full + (helps ? 1 : 0));
    }
}

/* ---- pairs ---- */

/* Does a body's box begin in this column, or row, of cells? */
static inline bool begins_right_of(const cairn_world *world, uint16_t body, cairn_real x)
{
    return center_x(world, body) - cairn_real_from_extent(world->tree->boxes[body].extent_x) >= x;
}
static inline bool begins_above(const cairn_world *world, uint16_t body, cairn_real y)
{
    return center_y(world, body) - cairn_real_from_extent(world->tree->boxes[body].extent_y) >= y;
}

/* The larger of two lower bounds lies in the last cell that both bodies reach; is it this one? Of boxes as the tree has them, since these say who is where. */
CAIRN_APART bool reports(const cairn_world *world, const cairn_quadtree_place *place, uint16_t a, uint16_t b)
{
    return (place->x <= world->tree->x || begins_right_of(world, a, place->x) || begins_right_of(world, b, place->x))
        && (place->y <= world->tree->y || begins_above(world, a, place->y) || begins_above(world, b, place->y));
}

static inline bool are_near(const cairn_world *world, uint16_t a, uint16_t b)
{
    const cairn_quadtree_box *box_a = &world->tree->boxes[a], *box_b = &world->tree->boxes[b];
    return cairn_spots_are_near(box_a->x, box_b->x, box_a->extent_x, box_b->extent_x)
        && cairn_spots_are_near(box_a->y, box_b->y, box_a->extent_y, box_b->extent_y)
        && !(world->bodies[a].flags & world->bodies[b].flags & CAIRN_STATIC);
}

/* Keep a pair behind the entries, if there is room. */
static void keep(cairn_quadtree *tree, uint16_t a, uint16_t b)
{
    tree->knows_pairs = tree->knows_pairs && tree->pair_end < tree->entry_capacity;
    if (tree->knows_pairs) {
        tree->entries[tree->pair_end].body = a;
        tree->entries[tree->pair_end++].next = b;
    }
}

/* The pairs of a leaf whose boxes overlap. */
CAIRN_APART void keep_pairs(const cairn_world *world, const cairn_quadtree_place *place)
{
    cairn_quadtree *tree = world->tree;
    const cairn_quadtree_entry *entries = tree->entries;
    for (uint16_t entry = tree->cells[place->cell].first; entry != CAIRN_NONE; entry = entries[entry].next) {
        uint16_t a = entries[entry].body;
        for (uint16_t other = entries[entry].next; other != CAIRN_NONE; other = entries[other].next) {
            uint16_t b = entries[other].body;
            if (are_near(world, a, b) && reports(world, place, a, b)) {
                keep(tree, a, b);
            }
        }
    }
}

/* The pairs of all leaves, if there is room for them. */
static void keep_all_pairs(cairn_world *world)
{
    cairn_quadtree *tree = world->tree;
    cairn_quadtree_walk walk;
    tree->knows_pairs = true;
    cairn_quadtree_walk_start(tree, &walk);
    do {
        if (tree->cells[walk.place.cell].child == 0) {
            keep_pairs(world, &walk.place);
        }
    } while (tree->knows_pairs && cairn_quadtree_walk_next(tree, &walk));
    world->stats.tree_full = (uint16_t)(world->stats.tree_full + (tree->knows_pairs ? 0 : 1));
}

/* Split what is to be split, then look for the pairs. */
CAIRN_APART void rebuild(cairn_world *world)
{
    cairn_quadtree *tree = world->tree;
    cairn_quadtree_walk walk;
    world->stats.tree_full = 0;
    for (uint16_t i = 0; i < world->body_end; i++) {
        set_box(&world->bodies[i], &tree->boxes[i]);
    }
    fill_root(world, tree);
    cairn_quadtree_walk_start(tree, &walk);
    do {
        refine(world, tree, &walk);
    } while (cairn_quadtree_walk_next(tree, &walk));
    world->stats.tree_cells = tree->cell_end;
    world->stats.tree_entries = tree->pair_end = tree->entry_end;
    if (CAIRN_WITH_QUICK_WAYS) {
        keep_all_pairs(world);
    }
}

static inline bool may_pair(const cairn_world *world, uint16_t a, uint16_t b)
{
    const cairn_body *body_a = &world->bodies[a], *body_b = &world->bodies[b];
    return cairn_boxes_are_near(body_a, body_b, 0) && (cairn_body_is_active(body_a) || cairn_body_is_active(body_b));
}

CAIRN_APART void look_at_kept(cairn_world *world)
{
    const cairn_quadtree_entry *end = world->tree->entries + world->tree->pair_end;
    for (const cairn_quadtree_entry *pair = world->tree->entries + world->tree->entry_end; pair != end; pair++) {
        if (may_pair(world, pair->body, pair->next)) {
            cairn_arbiter_pair(world, pair->body, pair->next);
        }
    }
}

/* A body against those behind it in the leaf. */
static inline void look_behind(cairn_world *world, const cairn_quadtree_place *place, const cairn_quadtree_entry *entry)
{
    const cairn_quadtree_entry *entries = world->tree->entries;
    for (uint16_t other = entry->next; other != CAIRN_NONE; other = entries[other].next) {
        if (may_pair(world, entry->body, entries[other].body) && reports(world, place, entry->body, entries[other].body)) {
            cairn_arbiter_pair(world, entry->body, entries[other].body);
        }
    }
}

/* Where there was no room for the pairs. */
CAIRN_APART void look_through_leaves(cairn_world *world)
{
    cairn_quadtree *tree = world->tree;
    cairn_quadtree_walk walk;
    cairn_quadtree_walk_start(tree, &walk);
    do {
        const cairn_quadtree_cell *cell = &tree->cells[walk.place.cell];
        for (uint16_t entry = cell->child != 0 ? CAIRN_NONE : cell->first; entry != CAIRN_NONE; entry = tree->entries[entry].next) {
            look_behind(world, &walk.place, &tree->entries[entry]);
        }
    } while (cairn_quadtree_walk_next(tree, &walk));
}

static void find_pairs(cairn_world *world)
{
    if (world->placed || !all_are_in(world)) {
        rebuild(world);
        world->placed = false;
    }
    if (CAIRN_WITH_QUICK_WAYS && world->tree->knows_pairs) {
        look_at_kept(world);
    } else {
        look_through_leaves(world);
    }
}

static const cairn_broad_class quadtree_class = { find_pairs };

/* ---- set-up ---- */

static cairn_status check(const cairn_world *world, const cairn_quadtree_storage *storage, cairn_vec2 center, int size_log2, int depth)
{
    if (storage == NULL || storage->tree == NULL || storage->boxes == NULL || storage->cells == NULL || storage->entries == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (world->locked) {
        return CAIRN_ERROR_LOCKED;
    }
    if (size_log2 < 0 || size_log2 > 14 || depth < 1 || depth > CAIRN_QUADTREE_DEPTH || !cairn_real_is_within(center.x, CAIRN_WORLD_EDGE)
        || !cairn_real_is_within(center.y, CAIRN_WORLD_EDGE)) {
        return CAIRN_ERROR_RANGE;
    }
    bool fits = storage->cell_capacity != 0 && storage->box_capacity >= world->body_capacity && storage->entry_capacity >= world->body_capacity;
    return fits ? CAIRN_OK : CAIRN_ERROR_FULL;
}

cairn_status cairn_quadtree_enable(cairn_world *world, const cairn_quadtree_storage *storage, cairn_vec2 center, int size_log2, int depth)
{
    if (world == NULL) {
        return CAIRN_ERROR_NULL;
    }
    cairn_status status = CAIRN_WITH_QUADTREE ? check(world, storage, center, size_log2, depth) : CAIRN_ERROR_KIND;
    if (status != CAIRN_OK) {
        return cairn_fail(world, status);
    }
    cairn_quadtree *tree = storage->tree;
    cairn_real half = cairn_real_half(cairn_real_from_int((int32_t)1 << size_log2));
    cairn_clear(tree, sizeof *tree);
    tree->boxes = storage->boxes;
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
    world->placed = true;
    return CAIRN_OK;
}
