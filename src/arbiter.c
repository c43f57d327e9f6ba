/*
 * Arbiters: one for each pair of bodies within reach of one another, kept in the order of their bodies' places so that
 * the solver's order does not depend on how pairs are found.
 */
#include "engine.h"

static uint32_t key_of(uint16_t a, uint16_t b) { return (uint32_t)a << 16 | b; }

/* The first place whose arbiter's key is not below this one. */
static uint16_t place_of(const cairn_world *world, uint32_t key)
{
    uint16_t low = 0, high = world->arbiter_count;
    while (!CAIRN_WITH_SORT && low < high && key_of(cairn_arbiter_at(world, low)->a, cairn_arbiter_at(world, low)->b) < key) {
        low++; /* of a few */
    }
    if (!CAIRN_WITH_SORT) {
        return low;
    }
    while (low < high) {
        uint16_t middle = (uint16_t)(low + ((high - low) >> 1));
        const cairn_arbiter *arbiter = cairn_arbiter_at(world, middle);
        if (key_of(arbiter->a, arbiter->b) < key) {
            low = (uint16_t)(middle + 1);
        } else {
            high = middle;
        }
    }
    return low;
}

/* Pairs come in nearly the same order as in the step before: each arbiter knows the one that was found after it. */
static void expect_after(cairn_world *world, cairn_arbiter *arbiter)
{
    if (!CAIRN_WITH_SHORTCUTS) {
        return;
    }
    *world->expected = (uint16_t)(arbiter - world->arbiters);
    world->expected = &arbiter->after;
}

cairn_arbiter *cairn_arbiter_search(cairn_world *world, uint16_t a, uint16_t b)
{
    uint16_t place = place_of(world, key_of(a, b));
    if (place == world->arbiter_count) {
        return NULL;
    }
    cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
    if (arbiter->a != a || arbiter->b != b) {
        return NULL;
    }
    expect_after(world, arbiter);
    return arbiter;
}

/* In a build without the soft solver no material names its class. */
static bool is_bouncy(const cairn_material *material) { return CAIRN_WITH_SOFT_SOLVER ? material->bounce != NULL : material->restitution != 0; }

/* Coulomb's coefficients of the pair: geometric means. */
static void mix_materials(cairn_arbiter *arbiter, const cairn_material *a, const cairn_material *b)
{
    if (!CAIRN_WITH_FRICTION && !CAIRN_WITH_BOUNCE) {
        return;
    }
    arbiter->kinetic_friction = a == b ? a->kinetic_friction : cairn_factor_geometric_mean(a->kinetic_friction, b->kinetic_friction);
    arbiter->flags = (uint8_t)(is_bouncy(a) || is_bouncy(b) ? arbiter->flags | CAIRN_ARBITER_BOUNCY
                                                                      : arbiter->flags & ~CAIRN_ARBITER_BOUNCY);
}

cairn_factor cairn_arbiter_static_friction(const cairn_world *world, const cairn_arbiter *arbiter)
{
    const cairn_material *a = world->bodies[arbiter->a].model->material, *b = world->bodies[arbiter->b].model->material;
    return a == b ? a->static_friction : cairn_factor_geometric_mean(a->static_friction, b->static_friction);
}

/* What each body takes of a change of the relative velocity. */
static void share_masses(cairn_arbiter *arbiter, const cairn_body *a, const cairn_body *b)
{
    if (!cairn_body_is_dynamic(a)) {
        arbiter->share_a = 0;
        return;
    }
    arbiter->share_a = cairn_bodies_share(a, b);
    if (CAIRN_WITH_MASSES && (arbiter->share_a < CAIRN_UNEVEN_SHARE || cairn_arbiter_share_b(arbiter) < CAIRN_UNEVEN_SHARE)) {
        arbiter->block = CAIRN_BLOCK_UNEVEN;
    }
}

cairn_arbiter *cairn_arbiter_insert(cairn_world *world, uint16_t a, uint16_t b)
{
    uint16_t place = place_of(world, key_of(a, b));
    if (CAIRN_LOOKS_FIRST && place != world->arbiter_count) { /* it may be there, for nobody has searched for it */
        cairn_arbiter *known = cairn_arbiter_at(world, place);
        if (known->a == a && known->b == b) {
            return known;
        }
    }
    if (world->arbiter_count == world->arbiter_capacity) {
        world->stats.dropped++;
        return NULL;
    }
    const cairn_body *body_a = &world->bodies[a], *body_b = &world->bodies[b];
    uint16_t slot = world->order[world->arbiter_count];
    for (volatile uint16_t *at = &world->order[world->arbiter_count]; at != &world->order[place]; at--) {
        at[0] = at[-1]; /* volatile, or gcc makes a memmove of it, which goes by bytes */
    }
    world->order[place] = slot;
    world->arbiter_count++;

    cairn_arbiter *arbiter = &world->arbiters[slot];
    cairn_clear(arbiter, sizeof *arbiter);
    arbiter->a = a;
    arbiter->b = b;
    if (CAIRN_WITH_SHORTCUTS) {
        arbiter->after = CAIRN_NONE;
    }
    if (cairn_body_is_sensing(body_a) || cairn_body_is_sensing(body_b)) {
        arbiter->flags |= CAIRN_ARBITER_SENSOR;
    }
    if (cairn_body_type_of(body_a) == CAIRN_STATIC) {
        arbiter->flags |= CAIRN_ARBITER_ON_STATIC;
    }
    mix_materials(arbiter, body_a->model->material, body_b->model->material);
    share_masses(arbiter, body_a, body_b);
    expect_after(world, arbiter);
    return arbiter;
}

void cairn_arbiters_begin(cairn_world *world)
{
    if (CAIRN_WITH_SHORTCUTS) {
        world->expected = &world->first_found;
    }
    world->fresh = 0;
    world->slides = world->idles = false;
    /* What the solver leaves of an approach is too slow to be looked ahead for, unless something is fast. */
    if (cairn_world_continuous(world) != NULL && (world->driven || cairn_world_fast(world) != 0)) {
        cairn_world_continuous(world)->hold_back(world);
    }
}

/* Keep the arbiters for which `keep` holds, in order; the others' slots go to the free ones behind. */
static void retain(cairn_world *world, bool (*keep)(const cairn_world *world, cairn_arbiter *arbiter, uint16_t body), uint16_t body)
{
    uint16_t kept = 0;
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        if (keep(world, cairn_arbiter_at(world, place), body)) {
            uint16_t slot = world->order[place];
            world->order[place] = world->order[kept];
            world->order[kept++] = slot;
        } else {
            cairn_arbiter_at(world, place)->a = CAIRN_NONE;
        }
    }
    world->arbiter_count = kept;
    world->rearranged = true;
}

static bool is_current(const cairn_world *world, cairn_arbiter *arbiter, uint16_t body)
{
    (void)body;
    bool fresh = (arbiter->flags & CAIRN_ARBITER_FRESH) != 0;
    if (fresh || !CAIRN_WITH_SLEEP) { /* one of the two does not sleep then */
        return fresh;
    }
    if (cairn_body_is_active(&world->bodies[arbiter->a]) || cairn_body_is_active(&world->bodies[arbiter->b])) {
        return false;
    }
    unsigned touched = cairn_flag_if((arbiter->flags & CAIRN_ARBITER_TOUCHING) != 0, CAIRN_ARBITER_TOUCHED); /* and still does */
    arbiter->flags = (uint8_t)((arbiter->flags & ~(unsigned)(CAIRN_ARBITER_SOLVED | CAIRN_ARBITER_TOUCHED)) | touched);
    arbiter->path = CAIRN_PATH_NONE;
    return true;
}

void cairn_arbiters_sweep(cairn_world *world)
{
    if (world->fresh != world->arbiter_count) {
        retain(world, is_current, 0);
    }
}

static bool is_of_others(const cairn_world *world, cairn_arbiter *arbiter, uint16_t body)
{
    (void)world;
    return arbiter->a != body && arbiter->b != body;
}

void cairn_arbiters_wake_partners(cairn_world *world, uint16_t body)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (!is_of_others(world, arbiter, body)) {
            cairn_body_wake_up(world, &world->bodies[arbiter->a == body ? arbiter->b : arbiter->a]);
        }
    }
}

void cairn_arbiters_remove_body(cairn_world *world, uint16_t body)
{
    cairn_arbiters_wake_partners(world, body);
    retain(world, is_of_others, body);
}

void cairn_arbiters_refresh_materials(cairn_world *world, uint16_t body)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (!is_of_others(world, arbiter, body)) {
            mix_materials(arbiter, world->bodies[arbiter->a].model->material, world->bodies[arbiter->b].model->material);
            cairn_arbiter_doubt(arbiter); /* may they still meet? */
        }
    }
}

void cairn_arbiters_scale_impulses(cairn_world *world, cairn_wide factor)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        arbiter->friction_impulse = cairn_motion_clamp(cairn_motion_scale(arbiter->friction_impulse, factor), CAIRN_IMPULSE_MAX);
        for (int i = 0; i < CAIRN_MAX_POINTS; i++) {
            arbiter->rows[i].impulse = cairn_motion_clamp(cairn_motion_scale(arbiter->rows[i].impulse, factor), CAIRN_IMPULSE_MAX);
            arbiter->rows[i].load = cairn_motion_clamp(cairn_motion_scale(arbiter->rows[i].load, factor), CAIRN_IMPULSE_MAX);
        }
    }
}
