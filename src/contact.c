/* Contacts as a game sees them: arbiters with their points where the bodies are now. */
#include "engine.h"

/* N s of an accumulated impulse: impulse / (h (1/mA + 1/mB)). */
static cairn_real newton_seconds(const cairn_world *world, const cairn_body *a, const cairn_body *b, cairn_motion impulse, int exponent)
{
    cairn_wide reduced = cairn_bodies_reduced_mass(a, b);
    return cairn_real_from_motion(impulse, cairn_wide_mul(cairn_wide_mul(reduced, cairn_wide_of(1, exponent)), cairn_world_inverse_substep(world)));
}

/* The accumulated impulse of the point with this feature. */
static cairn_motion impulse_of(const cairn_arbiter *arbiter, uint16_t feature)
{
    for (int i = 0; i < arbiter->count; i++) {
        if ((arbiter->rows[i].feature & ~CAIRN_ROW_IN_FLIGHT) == feature) {
            return arbiter->rows[i].impulse;
        }
    }
    return 0;
}

/* Where builds do not look for it: as cairn_circle_touch() does. One of the two is round. */
static void place_point(const cairn_body *a, const cairn_body *b, cairn_manifold *manifold)
{
    bool first = cairn_body_is_round(a);
    cairn_offset r = cairn_offset_from_real((first ? a : b)->model->shape->size.x);
    cairn_unit2 n = { first ? manifold->normal_x : -manifold->normal_x, first ? manifold->normal_y : -manifold->normal_y };
    cairn_circle_place(r, n, manifold->points[0].separation, manifold);
    manifold->points[0].x += first ? 0 : cairn_bodies_apart_x(a, b);
    manifold->points[0].y += first ? 0 : cairn_bodies_apart_y(a, b);
}

static void describe(const cairn_world *world, const cairn_arbiter *arbiter, cairn_contact *contact)
{
    const cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    cairn_manifold manifold;
    cairn_bodies_collide(a, b, cairn_body_reach(world, a) + cairn_body_reach(world, b), &manifold);
    if (!CAIRN_HAS_PLACES && manifold.count != 0) {
        place_point(a, b, &manifold);
    }
    contact->a = cairn_body_id_of(world, a);
    contact->b = cairn_body_id_of(world, b);
    contact->touching = (arbiter->flags & CAIRN_ARBITER_TOUCHING) != 0;
    contact->began = contact->touching && !(arbiter->flags & CAIRN_ARBITER_TOUCHED);
    contact->sensor = (arbiter->flags & CAIRN_ARBITER_SENSOR) != 0;
    contact->normal = cairn_vec2_of(cairn_real_from_unit(cairn_unit_from_dir(arbiter->normal_x)),
                                    cairn_real_from_unit(cairn_unit_from_dir(arbiter->normal_y)));
    contact->count = manifold.count;
    for (int i = 0; i < manifold.count; i++) {
        const cairn_manifold_point *from = &manifold.points[i];
        contact->points[i].position = cairn_vec2_of(a->x + cairn_real_from_offset(from->x), a->y + cairn_real_from_offset(from->y));
        contact->points[i].separation = cairn_real_from_offset(from->separation);
        contact->points[i].impulse = newton_seconds(world, a, b, impulse_of(arbiter, from->feature), cairn_arbiter_exponent(arbiter));
    }
}

bool cairn_world_next_contact(cairn_world *world, int *cursor, cairn_contact *contact)
{
    if (world == NULL || cursor == NULL || contact == NULL || *cursor < 0 || *cursor >= world->arbiter_count) {
        return false;
    }
    describe(world, cairn_arbiter_at(world, (uint16_t)*cursor), contact);
    (*cursor)++;
    return true;
}

bool cairn_body_next_touched(cairn_world *world, cairn_body_id id, int *cursor, cairn_body_id *other)
{
    const cairn_body *body = cairn_body_find(world, id);
    if (body == NULL || cursor == NULL || other == NULL || *cursor < 0) {
        return false;
    }
    uint16_t index = (uint16_t)(id.index - 1);
    while (*cursor < world->arbiter_count) {
        const cairn_arbiter *arbiter = cairn_arbiter_at(world, (uint16_t)*cursor);
        (*cursor)++;
        if ((arbiter->a == index || arbiter->b == index) && (arbiter->flags & CAIRN_ARBITER_TOUCHING)) {
            *other = cairn_body_id_of(world, &world->bodies[arbiter->a == index ? arbiter->b : arbiter->a]);
            return true;
        }
    }
    return false;
}
