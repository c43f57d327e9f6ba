/*
 * Contacts that do nothing in this step: between the search for contacts and the solver. Where no impulse is left of the step before and the
 * points part, or will not meet in this step, the sweeps would find nothing to do; and where both bodies of such a contact have no other
 * one that does something, they need not go through the sub-steps at all: they coast (solver_soft.c).
 */
#include "engine.h"

/* Faster points may meet; and below it no sum of this file wraps. */
#define NEARING CAIRN_MOTION(0.25)

/* No point of the contact will press: bodies that coast keep their velocities to one another, since gravity changes both alike. */
static bool parts(const cairn_world *world, const cairn_arbiter *arbiter, const cairn_body *a, const cairn_body *b)
{
    cairn_motion straight = cairn_motion_along(b->vx - a->vx, b->vy - a->vy, arbiter->normal_x, arbiter->normal_y);
    for (const cairn_row *row = arbiter->rows; row != arbiter->rows + arbiter->count; row++) {
        cairn_motion u = straight + cairn_motion_lever(b->w, row->lever_b) - cairn_motion_lever(a->w, row->lever_a);
        bool clear = row->gap > 0 ? u >= 0 || (-u < NEARING && row->gap + u * (cairn_world_substeps(world) + 1) > 0) : u >= -row->gap;
        if (!clear) {
            return false;
        }
    }
    return true;
}

static inline bool is_free(const cairn_body *body) { return body->ux == 0 && body->uy == 0 && body->uw == 0; }

/* What the sweeps do not know how to leave alone: other forces than gravity, impacts, blocks, and levers that follow the motion. */
static bool is_plain(const cairn_world *world, const cairn_arbiter *arbiter, const cairn_body *a, const cairn_body *b)
{
    return (a->flags & b->flags & CAIRN_BODY_PLAIN) && !((a->flags | b->flags) & (CAIRN_BODY_MET | CAIRN_BODY_SPRING | CAIRN_BODY_FAST))
        && cairn_world_bounce(world) == NULL && cairn_world_fast(world) == 0 && arbiter->block == 0 && !cairn_arbiter_is_sliding(arbiter) && is_free(a) && is_free(b);
}

bool cairn_arbiter_idle(cairn_world *world, cairn_arbiter *arbiter, unsigned fresh)
{
    const cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    if (arbiter->rows[0].impulse != 0 || (cairn_arbiter_has_two(arbiter) && arbiter->rows[CAIRN_LAST_ROW].impulse != 0) || !is_plain(world, arbiter, a, b)
        || !parts(world, arbiter, a, b)) {
        return false;
    }
    arbiter->path = (uint8_t)(CAIRN_PATH_IDLE | fresh);
    world->idles = true;
    return true;
}

static void engage(cairn_world *world, cairn_arbiter *arbiter)
{
    unsigned before = arbiter->path;
    cairn_arbiter_engage(world, arbiter, &world->bodies[arbiter->a], &world->bodies[arbiter->b]);
    if (cairn_arbiter_idles(arbiter)) {
        arbiter->path = cairn_arbiter_path_of(world, arbiter, before & CAIRN_PATH_FRESH);
        cairn_arbiter_take_turn(world, before, arbiter->path);
    }
}

void cairn_arbiter_engage_unless_idle(cairn_world *world, cairn_arbiter *arbiter)
{
    unsigned before = arbiter->path;
    if (cairn_arbiter_idle(world, arbiter, before & CAIRN_PATH_FRESH)) {
        cairn_arbiter_take_turn(world, before, arbiter->path);
    } else {
        engage(world, arbiter);
    }
}

/* A body of it has a contact that does something: it has to be looked at as well. True if that was so. */
static bool rouse(cairn_world *world, cairn_arbiter *arbiter)
{
    const cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    bool acted_on = cairn_arbiter_idles(arbiter) && (arbiter->flags & CAIRN_ARBITER_FRESH) /* not what is about to be forgotten */
                 && ((a->flags | b->flags) & CAIRN_BODY_MET);
    if (acted_on) {
        engage(world, arbiter);
    }
    return acted_on;
}

void cairn_arbiters_rouse(cairn_world *world)
{
    bool again = world->idles;
    while (again) { /* each round but the last finds one at least */
        again = false;
        for (uint16_t place = 0; place < world->arbiter_count; place++) {
            again = rouse(world, cairn_arbiter_at(world, place)) || again;
        }
    }
}
