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

/* By insertion. */
static void sort(cairn_world *world)
{
    uint16_t *sorted = world->sorted, last = 0;
    cairn_real last_left = 0;
    for (uint16_t place = 0; place < world->sorted_count; place++) {
        uint16_t i = sorted[place], to = place;
        cairn_real left = left_of(&world->bodies[i]);
        if (place == 0 || !comes_before(left, i, last_left, last)) {
            last = i;
            last_left = left;
            continue;
        }
        while (to > 0 && comes_before(left, i, left_of(&world->bodies[sorted[to - 1]]), sorted[to - 1])) {
            sorted[to] = sorted[to - 1];
            to--;
        }
        sorted[to] = i;
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
static void pair_with_rest(cairn_world *world, const uint16_t *place, const uint16_t *end)
{
    uint16_t i = *place;
    const cairn_body *a = &world->bodies[i];
    cairn_real right = a->x + cairn_real_from_extent(a->extent_x);
    bool idle = !cairn_body_is_active(a);
    while (++place != end) {
        const cairn_body *b = &world->bodies[*place];
        if (left_of(b) > right) {
            return;
        }
        if (cairn_real_is_within(a->y - b->y, cairn_real_from_extents(a->extent_y, b->extent_y)) && (b->flags & CAIRN_BODY_USED)
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
