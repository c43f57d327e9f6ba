/*
 * Contacts that slide: between the passes of a sub-step. A row has the levers of the step's start, and its impulse acts on either body at
 * the end of its own. Once one body has slid past the other these are two points and no longer one line: the pair of
 * impulses then turns both, and angular momentum is not kept. So the levers of what slides fast follow the motion, from sub-step to
 * sub-step: each body's end moves by half of it, or, since a circle's own never moves, the polygon's by all.
 */
#include "sweep.h"

static bool is_polygon(const cairn_body *body) { return !cairn_shape_is_round(body->model->shape); }

bool cairn_arbiter_may_slide(const cairn_body *a, const cairn_body *b)
{
    return CAIRN_MAX_POINTS > 1 && cairn_body_is_dynamic(a) && !cairn_bodies_are_fixed(a, b) && (is_polygon(a) || is_polygon(b));
}

/* Within half of its size? What goes farther in a sub-step only flies past. */
static bool is_within_half(const cairn_body *body, cairn_motion way)
{
    cairn_motion half = cairn_motion_half(cairn_motion_from_offset(cairn_offset_from_real(cairn_shape_inradius(body->model->shape))));
    return cairn_motion_is_within(way, half);
}

/* What lies deeper than 5 mm is pushed out so far that levers which follow it would add energy. */
static bool is_shallow(const cairn_arbiter *arbiter)
{
    cairn_motion most = -CAIRN_MOTION(0.005 * CAIRN_SOFT_BETA_NUMBER);
    return arbiter->rows[0].gap > most && (!cairn_arbiter_has_two(arbiter) || arbiter->rows[CAIRN_LAST_ROW].gap > most);
}

bool cairn_arbiter_slips_fast(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter)
{
    cairn_motion across = cairn_motion_along(b->vy - a->vy, a->vx - b->vx, arbiter->normal_x, arbiter->normal_y);
    return !cairn_motion_is_within(across, CAIRN_SLIDES) && cairn_arbiter_may_slide(a, b) && is_within_half(a, across) && is_within_half(b, across)
        && is_shallow(arbiter);
}

static cairn_lever followed(const cairn_body *body, cairn_lever lever, cairn_offset by)
{
    return cairn_lever_add(lever, cairn_body_lever(body, by));
}

/* How much of the way is body b's. */
static cairn_offset part_of_b(const cairn_body *a, const cairn_body *b, cairn_offset by)
{
    return !is_polygon(a) ? by : !is_polygon(b) ? 0 : cairn_offset_half(by);
}

void cairn_arbiter_slide(const cairn_body *a, const cairn_body *b, cairn_arbiter *arbiter, cairn_offset x, cairn_offset y)
{
    cairn_offset across = cairn_motion_along(y, -x, arbiter->normal_x, arbiter->normal_y);
    cairn_offset apart = cairn_motion_along(x, y, arbiter->normal_x, arbiter->normal_y);
    cairn_offset across_b = part_of_b(a, b, across), apart_b = part_of_b(a, b, apart);
    for (int i = 0; i < arbiter->count; i++) {
        cairn_row *row = &arbiter->rows[i];
        row->lever_a = followed(a, row->lever_a, across_b - across);
        row->lever_b = followed(b, row->lever_b, across_b);
    }
    /* Friction's levers are those of bodies that touch: from where it acts on they move apart, too. */
    if (arbiter->friction_impulse != 0) {
        arbiter->friction_lever_a = followed(a, arbiter->friction_lever_a, apart - apart_b);
        arbiter->friction_lever_b = followed(b, arbiter->friction_lever_b, -apart_b);
    }
}

static bool pushes(const cairn_arbiter *arbiter)
{
    return arbiter->rows[0].impulse != 0 || (cairn_arbiter_has_two(arbiter) && arbiter->rows[CAIRN_LAST_ROW].impulse != 0) || arbiter->friction_impulse != 0;
}

void cairn_sweep_push_sliding(cairn_world *world)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (cairn_arbiter_is_sliding(arbiter) && pushes(arbiter)) {
            cairn_careful_warm_start(world, arbiter, false);
        }
    }
}

void cairn_sweep_slide(cairn_world *world)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (cairn_arbiter_is_sliding(arbiter)) {
            cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
            cairn_arbiter_slide(a, b, arbiter, cairn_offset_from_motion(b->vx - a->vx), cairn_offset_from_motion(b->vy - a->vy));
        }
    }
}
