/*
 * Bodies that are driven against what they touch: before the search for contacts, of worlds with continuous collision, which looks ahead
 * by their velocities.
 */
#include "engine.h"

/* What touches and is driven together faster than this, m per sub-step, is held back: see hold_back(). */
#define DRIVEN CAIRN_MOTION(0.0001)
/* And faster than this, which a pile that settles does not reach, its rows are made anew. */
#define DRIVEN_HARD CAIRN_MOTION(0.0004)

static void give_way(cairn_body *body, cairn_share share, cairn_motion closing, const cairn_arbiter *arbiter)
{
    if (cairn_body_is_dynamic(body) && !cairn_body_is_fixed(body)) {
        cairn_motion by = cairn_motion_share(closing, share);
        body->dx = cairn_motion_add(cairn_body_held_x(body), cairn_motion_dir(by, arbiter->normal_x));
        body->dy = cairn_motion_add(cairn_body_held_y(body), cairn_motion_dir(by, arbiter->normal_y));
        body->flags &= (uint16_t)~CAIRN_BODY_FACING;
    }
}

/* Does a point of the contact open? Where a corner has hit and turning carries it away, nothing is driven: the next corner may come. */
static bool opens(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, cairn_motion straight)
{
    for (int i = 0; i < arbiter->count; i++) {
        const cairn_row *row = &arbiter->rows[i];
        cairn_motion turning = cairn_motion_lever(b->w, row->lever_b) - cairn_motion_lever(a->w, row->lever_a);
        if (cairn_motion_add(straight, turning) > 0) {
            return true;
        }
    }
    return false;
}

/*
 * A game may set a velocity that drives a body against what it touches. It will not go that way, and the search for contacts
 * ahead must not follow it there: until the search is done, the bodies' dx and dy keep what is to be added to their velocities.
 */
static void hold_back(cairn_world *world, cairn_arbiter *arbiter)
{
    cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    cairn_motion x = b->vx - a->vx, y = b->vy - a->vy;
    if (!cairn_motion_is_within(x, DRIVEN) || !cairn_motion_is_within(y, DRIVEN)) {
        cairn_motion closing = -cairn_motion_along(x + cairn_body_held_x(b) - cairn_body_held_x(a),
                                                    y + cairn_body_held_y(b) - cairn_body_held_y(a), arbiter->normal_x, arbiter->normal_y);
        if (closing > DRIVEN && !opens(a, b, arbiter, -closing)) {
            give_way(a, arbiter->share_a, -closing, arbiter);
            give_way(b, cairn_arbiter_share_b(arbiter), closing, arbiter);
            if (closing > DRIVEN_HARD) {
                cairn_arbiter_doubt(arbiter);
            }
            world->held_back = true;
        }
    }
}

void cairn_arbiters_hold_back(cairn_world *world)
{
    bool driven = world->driven;
    world->driven = false;
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if ((arbiter->flags & (CAIRN_ARBITER_TOUCHING | CAIRN_ARBITER_SENSOR)) == CAIRN_ARBITER_TOUCHING
            && (cairn_body_is_active(&world->bodies[arbiter->a]) || cairn_body_is_active(&world->bodies[arbiter->b]))) {
            hold_back(world, arbiter);
        } else if (driven) {
            cairn_arbiter_doubt(arbiter); /* what is apart may be driven together */
        }
    }
}
