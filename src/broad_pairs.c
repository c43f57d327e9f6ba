/*
 * The broad phase of a world without a tree: sweep and prune along x (Baraff 1992). Bodies are kept sorted by the left ends of
 * their boxes from step to step, which costs one comparison a body where few have passed one another; then each is
 * held against those behind it that begin before it ends.
 */
#include "engine.h"

static inline cairn_real left_of(const cairn_body *body) { return body->x - cairn_real_from_extent(body->extent_x); }

/* Ties by place in the pool, so that the order does not depend on how bodies came there. */
static bool comes_before(cairn_real left, uint16_t i, cairn_real other_left, uint16_t other)
{
    return left < other_left || (left == other_left && i < other);
}

/* Those that were made since come last; places that are free again stay where they are. */
static void take_in_new_bodies(cairn_world *world)
{
    while (world->sorted_count < world->body_end) {
        world->sorted[world->sorted_count] = world->sorted_count;
        world->sorted_count++;
    }
}

/* Bring a body whose box begins at `left` to its place among those before it. */
CAIRN_APART void insert(const cairn_world *world, uint16_t *at, cairn_real left, uint16_t i)
{
    while (at != world->sorted && comes_before(left, i, left_of(&world->bodies[at[-1]]), at[-1])) {
        at[0] = at[-1];
        at--;
    }
    *at = i;
}

/* By insertion. */
static void sort(const cairn_world *world)
{
    const uint16_t *end = world->sorted + world->sorted_count;
    const cairn_body *bodies = world->bodies;
    cairn_real most = -CAIRN_REAL_MAX; /* the last one's, which comes first: no box begins there */
    uint16_t last = 0;
    for (uint16_t *at = world->sorted; at != end; at++) {
        uint16_t i = *at;
        cairn_real left = left_of(&bodies[i]);
        if (comes_before(left, i, most, last)) {
            insert(world, at, left, i);
        } else {
            most = left;
            last = i;
        }
    }
}

/* Are their boxes near on the y axis, and may they meet as bodies? */
static bool may_pair(const cairn_body *a, const cairn_body *b)
{
    return cairn_real_is_within(a->y - b->y, cairn_real_from_extents(a->extent_y, b->extent_y)) && (b->flags & CAIRN_BODY_USED)
        && (cairn_body_is_active(a) || cairn_body_is_active(b));
}

/* Each against those with higher places: where it is not worth sorting them. */
static void pair_all(cairn_world *world)
{
    for (uint16_t i = 0; i < world->body_end; i++) {
        const cairn_body *a = &world->bodies[i];
        for (uint16_t j = 0; (a->flags & CAIRN_BODY_USED) && j < i; j++) {
            const cairn_body *b = &world->bodies[j];
            if (cairn_boxes_are_near(a, b, 0) && may_pair(a, b)) {
                cairn_arbiter_pair(world, j, i);
            }
        }
    }
}

/* A body against those behind it. */
static inline void pair_with_rest(cairn_world *world, const uint16_t *place, const uint16_t *end)
{
    const cairn_body *bodies = world->bodies;
    uint16_t i = *place;
    const cairn_body *a = &bodies[i];
    cairn_real right = a->x + cairn_real_from_extent(a->extent_x), y = a->y;
    cairn_extent high = a->extent_y;
    bool idle = !cairn_body_is_active(a);
    while (++place != end) {
        const cairn_body *b = &bodies[*place];
        if (left_of(b) > right) {
            return;
        }
        if (cairn_real_is_within(y - b->y, cairn_real_from_extents(high, b->extent_y)) && (b->flags & CAIRN_BODY_USED)
            && !(idle && !cairn_body_is_active(b))) {
            cairn_arbiter_pair(world, i, *place);
        }
    }
}

static void find_pairs(cairn_world *world)
{
    if (!CAIRN_WITH_SORT) {
        pair_all(world);
        return;
    }
    take_in_new_bodies(world);
    sort(world);
    const uint16_t *end = world->sorted + world->sorted_count;
    for (const uint16_t *place = world->sorted; place != end; place++) {
        if (world->bodies[*place].flags & CAIRN_BODY_USED) {
            pair_with_rest(world, place, end);
        }
    }
}

const cairn_broad_class cairn_broad_pairs = { find_pairs };
