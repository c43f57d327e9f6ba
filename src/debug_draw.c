/* Debug drawing: the world told to callbacks, each kind of thing by a function of its own so that each is linked alone. */
#include "quadtree_walk.h"
#include <cairn/debug_draw.h>

/* The world must not change while a callback looks at it. */
static uint8_t lock(cairn_world *world)
{
    uint8_t before = world->locked;
    world->locked = 1;
    return before;
}

static cairn_draw_state state_of(const cairn_body *body)
{
    if (body->model->sensor) {
        return CAIRN_DRAW_SENSOR;
    }
    switch (cairn_body_type_of(body)) {
    case CAIRN_STATIC:
        return CAIRN_DRAW_STATIC;
    case CAIRN_KINEMATIC:
        return CAIRN_DRAW_KINEMATIC;
    case CAIRN_DYNAMIC:
        break;
    }
    return (body->flags & CAIRN_BODY_ASLEEP) ? CAIRN_DRAW_ASLEEP : CAIRN_DRAW_DYNAMIC;
}

static void draw_circle(const cairn_debug_draw *draw, cairn_body_id id, const cairn_body *body)
{
    cairn_unit c, s;
    cairn_angle_rotation(body->angle, &c, &s);
    cairn_vec2 axis = cairn_vec2_of(cairn_real_from_unit(c), cairn_real_from_unit(s));
    if (draw->circle != NULL) {
        draw->circle(draw->context, id, state_of(body), cairn_body_point(body, 0, 0), body->model->shape->size.x, axis);
    }
}

CAIRN_ONCE void draw_polygon(const cairn_debug_draw *draw, cairn_body_id id, const cairn_body *body)
{
    cairn_outline outline;
    cairn_room room;
    cairn_vec2 corners[CAIRN_MAX_VERTICES];
    if (draw->polygon == NULL) {
        return;
    }
    cairn_unit c, s;
    cairn_angle_rotation(body->angle, &c, &s);
    cairn_shape_outline(body->model->shape, room.corner, &outline);
    for (int i = 0; i < outline.count; i++) {
        cairn_offset2 corner = cairn_offset2_turned(outline.vertex[i], c, s);
        corners[i] = cairn_body_point(body, corner.x, corner.y);
    }
    draw->polygon(draw->context, id, state_of(body), corners, outline.count);
}

cairn_status cairn_debug_draw_bodies(cairn_world *world, const cairn_debug_draw *draw)
{
    if (world == NULL || draw == NULL) {
        return CAIRN_ERROR_NULL;
    }
    uint8_t locked = lock(world);
    for (uint16_t i = 0; i < world->body_end; i++) {
        const cairn_body *body = &world->bodies[i];
        if (!(body->flags & CAIRN_BODY_USED)) {
            continue;
        }
        if (cairn_shape_is_round(body->model->shape)) {
            draw_circle(draw, cairn_body_id_of(world, body), body);
        } else {
            draw_polygon(draw, cairn_body_id_of(world, body), body);
        }
    }
    world->locked = locked;
    return CAIRN_OK;
}

cairn_status cairn_debug_draw_contacts(cairn_world *world, const cairn_debug_draw *draw)
{
    if (world == NULL || draw == NULL) {
        return CAIRN_ERROR_NULL;
    }
    uint8_t locked = lock(world);
    cairn_contact contact;
    int cursor = 0;
    while (draw->contact != NULL && cairn_world_next_contact(world, &cursor, &contact)) {
        draw->contact(draw->context, &contact);
    }
    world->locked = locked;
    return CAIRN_OK;
}

cairn_status cairn_debug_draw_cells(cairn_world *world, const cairn_debug_draw *draw)
{
    if (world == NULL || draw == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (world->tree == NULL || draw->cell == NULL) {
        return CAIRN_OK;
    }
    uint8_t locked = lock(world);
    cairn_quadtree_walk walk;
    cairn_quadtree_walk_start(world->tree, &walk);
    do {
        const cairn_quadtree_place *place = &walk.place;
        const cairn_quadtree_cell *cell = &world->tree->cells[place->cell];
        if (cell->child == 0) {
            draw->cell(draw->context, cairn_vec2_of(place->x, place->y), place->size, walk.depth, cell->count);
        }
    } while (cairn_quadtree_walk_next(world->tree, &walk));
    world->locked = locked;
    return CAIRN_OK;
}

/* The distance at which the spring is at rest. */
static cairn_real rest_length_of(const cairn_world *world, cairn_spring_id id)
{
    return cairn_real_from_offset(world->springs->springs[id.index - 1].rest_length);
}

cairn_status cairn_debug_draw_springs(cairn_world *world, const cairn_debug_draw *draw)
{
    if (world == NULL || draw == NULL) {
        return CAIRN_ERROR_NULL;
    }
    uint8_t locked = lock(world);
    cairn_spring_id id = cairn_world_next_spring(world, cairn_spring_id_null());
    while (draw->spring != NULL && !cairn_spring_id_is_null(id)) {
        cairn_vec2 a, b;
        if (cairn_spring_anchors(world, id, &a, &b) == CAIRN_OK) {
            draw->spring(draw->context, id, a, b, rest_length_of(world, id));
        }
        id = cairn_world_next_spring(world, id);
    }
    world->locked = locked;
    return CAIRN_OK;
}
