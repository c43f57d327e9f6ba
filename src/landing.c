/*
 * Contacts that stopped something in flight: between two sub-steps, of worlds with fast bodies. What such an impulse did is not repeated
 * in the sub-steps to come.
 */
#include "engine.h"

/* Take what the pair's impulses did to a body out of the change that is to be repeated. */
static void forget(cairn_body *body, const cairn_arbiter *arbiter, cairn_share share, const cairn_lever lever[2], cairn_lever friction_lever)
{
    cairn_motion push = 0, turn, rub = cairn_motion_share(arbiter->friction_impulse, share);
    turn = cairn_motion_lever(rub, friction_lever);
    for (int i = 0; i < arbiter->count; i++) {
        cairn_motion part = cairn_motion_share(arbiter->rows[i].impulse, share);
        push += part;
        turn = cairn_motion_add(turn, cairn_motion_lever(part, lever[i]));
    }
    if (!cairn_body_is_fixed(body)) {
        body->ux = cairn_motion_before(body->ux, cairn_motion_along(push, -rub, arbiter->normal_x, arbiter->normal_y));
        body->uy = cairn_motion_before(body->uy, cairn_motion_along(rub, push, arbiter->normal_x, arbiter->normal_y));
    }
    body->uw = cairn_motion_before(body->uw, turn);
}

/* Whether the last change once more leads beyond the limit of speed. */
static bool repeats_too_fast(const cairn_world *world, const cairn_body *body)
{
    cairn_motion x = 2 * body->vx - body->ux, y = 2 * body->vy - body->uy, w = 2 * body->w - body->uw, limit = cairn_world_most_speed(world);
    return !cairn_motion_is_within(x, limit) || !cairn_motion_is_within(y, limit) || !cairn_motion_is_within(w, limit);
}

/* Whether an impulse of this size, with its friction and by levers of up to 2.83, cannot lead beyond it. */
static bool has_room_for(const cairn_world *world, const cairn_body *body, cairn_motion impulse)
{
    cairn_motion twice = cairn_motion_add(impulse, impulse), room = cairn_world_most_speed(world) - cairn_motion_add(twice, twice);
    return room > 0 && cairn_motion_is_within(body->vx, room) && cairn_motion_is_within(body->vy, room) && cairn_motion_is_within(body->w, room);
}

static void drop(cairn_arbiter *arbiter)
{
    arbiter->rows[0].impulse = 0;
    arbiter->rows[CAIRN_LAST_ROW].impulse = 0;
    arbiter->friction_impulse = 0;
    arbiter->flags |= CAIRN_ARBITER_TOUCHING;
}

/*
 * An impulse that stopped something in flight need not be repeated, and the passes take it back; but not where one of two opposite
 * changes is cut by the limit of speed.
 */
static void land(const cairn_world *world, cairn_arbiter *arbiter)
{
    cairn_row *rows = arbiter->rows;
    cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    bool flew = cairn_row_came_flying(&rows[0]) && (!cairn_arbiter_has_two(arbiter) || cairn_row_came_flying(&rows[CAIRN_LAST_ROW]));
    cairn_motion pressure = cairn_arbiter_pressure(arbiter);
    if (!flew || pressure == 0) {
        return;
    }
    if (cairn_arbiter_is_sliding(arbiter)) {
        if (!has_room_for(world, a, pressure) || !has_room_for(world, b, pressure)) {
            drop(arbiter);
        }
    } else if (repeats_too_fast(world, a) || repeats_too_fast(world, b)) {
        cairn_lever lever_a[2] = { rows[0].lever_a, rows[CAIRN_LAST_ROW].lever_a }, lever_b[2] = { rows[0].lever_b, rows[CAIRN_LAST_ROW].lever_b };
        forget(a, arbiter, -arbiter->share_a, lever_a, arbiter->friction_lever_a);
        forget(b, arbiter, cairn_arbiter_share_b(arbiter), lever_b, arbiter->friction_lever_b);
        drop(arbiter);
    }
}

void cairn_arbiters_land(cairn_world *world)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if ((arbiter->flags & CAIRN_ARBITER_SOLVED) && !(arbiter->block & CAIRN_BLOCK_NUMBER)) {
            land(world, arbiter);
        }
    }
}
