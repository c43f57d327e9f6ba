/*
 * Sleep. At the end of a step, bodies linked by contacts and springs form groups (union-find over the bodies' links);
 * a group all of whose bodies have been slow for half a second falls asleep as a whole, and wakes as a whole.
 */
#include "engine.h"
#include <cairn/sleep.h>
#include <cairn/spring.h>

/* Slower than this, m/s, counts as rest; the same for the radius of gyration's speed by spin. */
#define REST_SPEED CAIRN_F(0.03)

/* ---- waking ---- */

static bool is_asleep(const cairn_body *body) { return (body->flags & (CAIRN_BODY_USED | CAIRN_BODY_ASLEEP)) == (CAIRN_BODY_USED | CAIRN_BODY_ASLEEP); }

static void wake_neighbour(cairn_world *world, uint16_t a, uint16_t b)
{
    cairn_body *body_a = &world->bodies[a], *body_b = &world->bodies[b];
    if (!((body_a->flags ^ body_b->flags) & CAIRN_BODY_ASLEEP)) { /* both sleep or neither does */
        return;
    }
    cairn_body *sleeper = is_asleep(body_a) && cairn_body_is_stirring(body_b) ? body_a : is_asleep(body_b) && cairn_body_is_stirring(body_a) ? body_b : NULL;
    if (sleeper != NULL) {
        cairn_body_wake_up(world, sleeper);
        world->stats.awake++;
    }
}

/* Wake whatever touches something awake, and so on through the group. True if anything woke. */
static bool wake(cairn_world *world)
{
    uint16_t before, at_first = world->stats.awake;
    do {
        before = world->stats.awake;
        for (uint16_t place = 0; place < world->arbiter_count; place++) {
            const cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
            if (!(arbiter->flags & CAIRN_ARBITER_SENSOR)) {
                wake_neighbour(world, arbiter->a, arbiter->b);
            }
        }
        if (cairn_world_springs(world) != NULL) {
            cairn_world_springs(world)->kind->link(world, wake_neighbour);
        }
    } while (world->stats.awake != before); /* each round but the last wakes a body */
    return world->stats.awake != at_first;
}

/*
 * A body that does not move has no contact with sleepers: where it is put among them, they have to look for themselves. What hangs on it by
 * springs hangs on it no more as it did.
 */
static void disturb(cairn_world *world, const cairn_body *body)
{
    if (cairn_world_springs(world) != NULL) {
        cairn_world_springs(world)->kind->wake(world, (uint16_t)(body - world->bodies));
    }
    for (uint16_t i = 0; i < world->body_end; i++) {
        cairn_body *other = &world->bodies[i];
        if (is_asleep(other) && cairn_boxes_are_near(body, other, 0)) {
            cairn_body_wake_up(world, other);
        }
    }
}

/* ---- falling asleep ---- */

static uint16_t root_of(cairn_world *world, uint16_t index)
{
    uint16_t next = cairn_body_link(&world->bodies[index]);
    while (next != index) {
        next = cairn_body_link(&world->bodies[next]);
        cairn_body_set_link(&world->bodies[index], next);
        index = next;
        next = cairn_body_link(&world->bodies[index]);
    }
    return index;
}

static void join(cairn_world *world, uint16_t a, uint16_t b)
{
    cairn_body *body_a = &world->bodies[a], *body_b = &world->bodies[b];
    if (!cairn_body_is_active(body_a) || !cairn_body_is_active(body_b)) {
        return; /* static, or a spring between two that sleep: these have no links */
    }
    if (cairn_body_is_dynamic(body_a) && cairn_body_is_dynamic(body_b)) {
        uint16_t root_a = root_of(world, a), root_b = root_of(world, b);
        cairn_body_set_link(&world->bodies[root_a > root_b ? root_a : root_b], root_a > root_b ? root_b : root_a);
    } else if (cairn_body_is_dynamic(body_b) ? cairn_body_is_stirring(body_a) : cairn_body_is_stirring(body_b)) {
        body_a->rest = 0; /* carried by a moving platform */
        body_b->rest = 0;
    }
}

/* A body's count of steps has 8 bits: at rates beyond 510 a second only every second, or fourth, step adds to it. */
static unsigned counted_in(const cairn_world *world) { return cairn_world_rate(world) <= CAIRN_F(510) ? 0 : cairn_world_rate(world) <= CAIRN_F(1020) ? 1 : 2; }

static void count_rest(cairn_world *world, cairn_body *body)
{
    unsigned counts = (world->stats.steps & ((1u << counted_in(world)) - 1)) == 0 && body->rest < 255;
    cairn_motion limit = cairn_motion_from_real(REST_SPEED, cairn_world_substep(world));
    bool slow = cairn_motion_is_within(body->vx, limit) && cairn_motion_is_within(body->vy, limit) && cairn_motion_is_within(body->w, limit);
    body->rest = (slow ? body->rest + counts : 0) & 255u;
}

static void fall_asleep(cairn_body *body)
{
    body->flags |= CAIRN_BODY_ASLEEP;
    body->vx = body->vy = body->w = 0;
    body->dx = body->dy = 0; /* its link is dropped later */
    if (body->extent_x == 0) { /* it may have to be found as it lies there */
        cairn_body_refresh_extents(body);
    }
}

static void drop_links(cairn_world *world)
{
    for (uint16_t i = 0; i < world->body_end; i++) {
        if (world->bodies[i].flags & CAIRN_BODY_USED) {
            cairn_body_set_link(&world->bodies[i], 0);
        }
    }
}

static void settle(cairn_world *world)
{
    unsigned patience = (unsigned)(cairn_real_floor(cairn_world_rate(world)) / 2) >> counted_in(world);
    for (uint16_t i = 0; i < world->body_end; i++) {
        cairn_body *body = &world->bodies[i];
        if (cairn_body_is_active(body)) {
            cairn_body_set_link(body, i);
            body->flags &= (uint16_t)~CAIRN_BODY_RESTLESS;
            count_rest(world, body);
        }
    }
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        const cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (arbiter->flags & CAIRN_ARBITER_SOLVED) {
            join(world, arbiter->a, arbiter->b);
        }
    }
    if (cairn_world_springs(world) != NULL) {
        cairn_world_springs(world)->kind->link(world, join);
    }
    for (uint16_t i = 0; i < world->body_end; i++) {
        cairn_body *body = &world->bodies[i];
        if (cairn_body_is_active(body) && cairn_body_is_dynamic(body) && body->rest < patience) {
            world->bodies[root_of(world, i)].flags |= CAIRN_BODY_RESTLESS;
        }
    }
    for (uint16_t i = 0; i < world->body_end; i++) {
        cairn_body *body = &world->bodies[i];
        if (cairn_body_is_active(body) && cairn_body_is_dynamic(body) && !(world->bodies[root_of(world, i)].flags & CAIRN_BODY_RESTLESS)) {
            fall_asleep(body);
        }
    }
    drop_links(world);
}

static const cairn_sleep_class class_of_sleep = { wake, settle, disturb };

/* ---- for the game ---- */

cairn_status cairn_sleep_enable(cairn_world *world)
{
    if (world == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (world->locked) {
        return cairn_fail(world, CAIRN_ERROR_LOCKED);
    }
    if (!CAIRN_WITH_SLEEP) {
        return cairn_fail(world, CAIRN_ERROR_KIND);
    }
    world->sleep = &class_of_sleep;
    return CAIRN_OK;
}

cairn_status cairn_sleep_disable(cairn_world *world)
{
    cairn_status status = cairn_sleep_enable(world);
    if (status == CAIRN_OK) {
        world->sleep = NULL;
        for (uint16_t i = 0; i < world->body_end; i++) {
            cairn_body_wake_up(world, &world->bodies[i]);
        }
    }
    return status;
}
