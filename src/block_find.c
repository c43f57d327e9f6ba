/*
 * Which contacts make a block, at the start of a step.
 *
 * A body is light if it touches one of more than CAIRN_UNEVEN times its mass. A block has the contacts of its light bodies;
 * what touches those and is light beside the heaviest body of the block belongs to it too. A block with more rows than
 * there is room for is left to the sweeps as a whole: half a block cannot carry the load on.
 */
#include "block.h"

/* More than this and the shares of a change would not be known well enough. */
#define RATIO_MAX 262144
/* Beyond these numbers: no more blocks; and one that has too many rows. */
#define LAST_NUMBER 126
#define DISSOLVED 127

static void set_number(cairn_arbiter *arbiter, uint8_t number) { arbiter->block = (uint8_t)((arbiter->block & CAIRN_BLOCK_UNEVEN) | number); }

static bool is_solved(const cairn_arbiter *arbiter) { return (arbiter->flags & CAIRN_ARBITER_SOLVED) != 0; }

/* Nothing is in a block yet. A light body's link is the number of its block, or 0. */
static void clear(cairn_world *world)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        bool was_in_one = cairn_block_of(arbiter) != 0;
        arbiter->path = (uint8_t)((arbiter->path & CAIRN_PATH_FRESH) | (was_in_one ? CAIRN_PATH_FORMER : CAIRN_PATH_NONE));
        set_number(arbiter, was_in_one && !is_solved(arbiter) ? DISSOLVED : 0); /* what sleeps keeps its past */
    }
}

/* What a block is found to have while it grows. */
typedef struct growth {
    uint8_t number;
    bool changed;
    cairn_wide heaviest, lightest;
} growth;

static bool outweighs(cairn_wide heavy, cairn_wide light, int32_t ratio)
{
    return cairn_wide_less(cairn_wide_mul(light, cairn_wide_from_int(ratio)), heavy);
}

/* A body that touches a light one: light as well, or a load. */
static void meet(growth *g, cairn_body *body)
{
    if (cairn_body_link(body) == g->number || !cairn_body_is_dynamic(body)) {
        return;
    }
    cairn_wide mass = cairn_body_mass_of(body);
    if (outweighs(g->heaviest, mass, CAIRN_UNEVEN)) {
        cairn_body_set_link(body, g->number);
        g->lightest = cairn_wide_less(mass, g->lightest) ? mass : g->lightest;
        g->changed = true;
    } else if (cairn_wide_less(g->heaviest, mass)) {
        g->heaviest = mass;
        g->changed = true;
    }
}

/*
 * All that hangs together with one uneven contact. Each round finds a body or a heavier one, so it ends. Arbiters of
 * a block found before are of this one if they are reached: its load is the greater one, and all of them will be.
 */
static void grow(cairn_world *world, growth *g)
{
    do {
        g->changed = false;
        for (uint16_t place = 0; place < world->arbiter_count; place++) {
            cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
            cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
            if (is_solved(arbiter) && (cairn_body_link(a) == g->number || cairn_body_link(b) == g->number)) {
                set_number(arbiter, g->number);
                meet(g, a);
                meet(g, b);
            }
        }
    } while (g->changed);
}

/* Whether a block is of use and has room: with one arbiter alone the sweeps do as well. */
static bool is_worth(const cairn_world *world, const growth *g)
{
    int rows = 0, arbiters = 0;
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        const cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (cairn_block_of(arbiter) == g->number) {
            rows += arbiter->count + 1;
            arbiters++;
        }
    }
    return arbiters > 1 && rows <= CAIRN_BLOCK_ROWS && !outweighs(g->heaviest, g->lightest, RATIO_MAX);
}

static void unlink_from(cairn_body *body, uint8_t number)
{
    if (cairn_body_link(body) == number) {
        cairn_body_set_link(body, DISSOLVED);
    }
}

static void dissolve(cairn_world *world, uint8_t number)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (cairn_block_of(arbiter) == number) {
            cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
            unlink_from(a, number);
            unlink_from(b, number);
            set_number(arbiter, DISSOLVED);
        }
    }
}

static void forget_impulses(cairn_arbiter *arbiter)
{
    arbiter->rows[0].impulse = 0;
    arbiter->rows[CAIRN_LAST_ROW].impulse = 0;
    arbiter->friction_impulse = 0;
}

/* It is none of a block's, and starts from zero if it was until now. */
static void leave(const cairn_world *world, cairn_arbiter *arbiter)
{
    set_number(arbiter, 0);
    forget_impulses(arbiter);
    cairn_arbiter_take_hold(world, arbiter);
    cairn_arbiter_let_go(arbiter);
    arbiter->path = CAIRN_PATH_CAREFUL | CAIRN_PATH_FRESH;
}

/* What was in a block and is no longer does so: its impulses may be anything. */
static void forget_former(cairn_world *world)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (is_solved(arbiter) && cairn_block_of(arbiter) == DISSOLVED) {
            set_number(arbiter, 0);
        }
        if (is_solved(arbiter) && cairn_block_of(arbiter) == 0 && (arbiter->path & CAIRN_PATH_FORMER)) {
            leave(world, arbiter);
        }
    }
}

void cairn_block_dissolve(cairn_world *world, uint8_t number)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        arbiter->path = cairn_block_of(arbiter) == number ? (uint8_t)CAIRN_PATH_FORMER : arbiter->path;
    }
    dissolve(world, number);
    forget_former(world);
}

/* Stands for the pairs and points of a block. Not zero. */
static uint16_t mark_of(const cairn_world *world, uint8_t number)
{
    uint32_t hash = 0;
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        const cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (cairn_block_of(arbiter) == number) {
            hash = (hash ^ ((uint32_t)arbiter->a << 16 | arbiter->b)) * 16777619u;
            for (int i = 0; i < arbiter->count; i++) {
                hash = (hash ^ arbiter->rows[i].feature) * 16777619u;
            }
        }
    }
    return (uint16_t)(hash >> 16 | 1u);
}

/* Impulses are good for a warm start only if the block is the one that they were found for. */
static void compare(cairn_world *world, uint8_t number)
{
    uint16_t mark = mark_of(world, number);
    bool same = true;
    for (int again = 0; again < 2; again++) {
        for (uint16_t place = 0; place < world->arbiter_count; place++) {
            cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
            if (cairn_block_of(arbiter) == number) {
                same = same && (again || ((arbiter->path & CAIRN_PATH_FORMER) && arbiter->past.block.mark == mark));
                if (!same && again) {
                    forget_impulses(arbiter);
                    arbiter->past.block.mark = mark;
                    arbiter->past.block.exponent = 0;
                }
            }
        }
    }
}

static void drop_links(cairn_world *world)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        const cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        cairn_body_set_link(&world->bodies[arbiter->a], 0);
        cairn_body_set_link(&world->bodies[arbiter->b], 0);
    }
}

void cairn_block_find(cairn_world *world)
{
    clear(world);
    world->blocks = 0;
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (!(arbiter->block & CAIRN_BLOCK_UNEVEN) || cairn_block_of(arbiter) != 0 || !is_solved(arbiter) || world->blocks == LAST_NUMBER) {
            continue;
        }
        cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
        cairn_wide mass_a = cairn_body_mass_of(a), mass_b = cairn_body_mass_of(b);
        bool a_is_light = cairn_wide_less(mass_a, mass_b);
        growth g;
        g.number = (uint8_t)(world->blocks + 1);
        g.heaviest = a_is_light ? mass_b : mass_a;
        g.lightest = a_is_light ? mass_a : mass_b;
        cairn_body_set_link(a_is_light ? a : b, g.number);
        grow(world, &g);
        if (is_worth(world, &g)) {
            world->blocks++;
        } else {
            dissolve(world, g.number);
        }
    }
    drop_links(world);
    forget_former(world);
    for (uint8_t number = 1; number <= world->blocks; number++) {
        compare(world, number);
    }
    world->uneven = world->blocks; /* look again in the next step, if only to release them */
}

void cairn_block_release(cairn_world *world)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (cairn_block_of(arbiter) != 0) {
            leave(world, arbiter);
            cairn_arbiter_doubt(arbiter);
        }
    }
    world->blocks = world->uneven = 0;
}
