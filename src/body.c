/* Bodies: their pool, and what the game may change of them. What it may ask is in body_state.c, forces in body_force.c. */
#include "engine.h"
#include <cairn/spring.h>

#define MASS_MIN CAIRN_WIDE_SCALED(0.5, -23) /* 6e-8 kg */
#define MASS_MAX CAIRN_WIDE_SCALED(1000000000.0 / 1073741824, 30)

/* ---- ids ---- */

static bool holds(const cairn_world *world, cairn_body_id id)
{
    if (id.index == 0 || id.index > world->body_end) {
        return false;
    }
    const cairn_body *body = &world->bodies[id.index - 1];
    return (body->flags & CAIRN_BODY_USED) && body->generation == id.generation;
}

cairn_body *cairn_body_find(cairn_world *world, cairn_body_id id)
{
    if (world == NULL) {
        return NULL;
    }
    if (!holds(world, id)) {
        cairn_fail(world, CAIRN_ERROR_STALE);
        return NULL;
    }
    return &world->bodies[id.index - 1];
}

cairn_body *cairn_body_find_to_change(cairn_world *world, cairn_body_id id, cairn_status *status)
{
    cairn_body *body = NULL;
    if (world == NULL) {
        *status = CAIRN_ERROR_NULL;
    } else if (world->locked) {
        *status = cairn_fail(world, CAIRN_ERROR_LOCKED);
    } else {
        body = cairn_body_find(world, id);
        *status = body == NULL ? CAIRN_ERROR_STALE : CAIRN_OK;
    }
    return body;
}

cairn_body_id cairn_body_id_of(const cairn_world *world, const cairn_body *body)
{
    cairn_body_id id;
    id.index = (uint16_t)(body - world->bodies + 1);
    id.generation = body->generation;
    return id;
}

bool cairn_body_exists(const cairn_world *world, cairn_body_id id) { return world != NULL && holds(world, id); }

cairn_body_id cairn_world_next_body(const cairn_world *world, cairn_body_id id)
{
    if (world != NULL) {
        for (uint16_t i = id.index; i < world->body_end; i++) {
            if (world->bodies[i].flags & CAIRN_BODY_USED) {
                return cairn_body_id_of(world, &world->bodies[i]);
            }
        }
    }
    return cairn_body_id_null();
}

/* ---- masses of two ---- */

cairn_wide_word cairn_body_mass_word(const cairn_body *body)
{
    const cairn_body_model *model = body->model;
    if (!cairn_body_is_dynamic(body)) {
        return cairn_wide_to_word(cairn_wide_zero());
    }
    return cairn_wide_to_word(cairn_wide_mul(cairn_wide_from_word(cairn_shape_area(model->shape)), model->density));
}

cairn_wide_word cairn_bodies_reduced_mass_word(const cairn_body *a, const cairn_body *b)
{
    cairn_wide of_a = cairn_body_mass_of(a), of_b = a->model == b->model ? of_a : cairn_body_mass_of(b);
    if (cairn_wide_is_zero(of_a) || cairn_wide_is_zero(of_b)) {
        return cairn_wide_to_word(cairn_wide_is_zero(of_a) ? of_b : of_a);
    }
    return cairn_wide_to_word(cairn_wide_div(cairn_wide_mul(of_a, of_b), cairn_wide_add(of_a, of_b)));
}

cairn_share cairn_bodies_share(const cairn_body *a, const cairn_body *b)
{
    if (!CAIRN_WITH_MASSES || a->model == b->model) {
        return CAIRN_SHARE(0.5);
    }
    cairn_wide of_a = cairn_body_mass_of(a), of_b = cairn_body_mass_of(b);
    return cairn_wide_to_share(cairn_wide_div(of_b, cairn_wide_add(of_a, of_b)));
}

/* ---- create and destroy ---- */

/* Does a build without some features (config.h) know all that a material asks for? */
static bool is_built_for_material(const cairn_material *material)
{
    return (CAIRN_WITH_BOUNCE || (material->bounce == NULL && material->restitution == 0))
        && (CAIRN_WITH_FRICTION || (material->static_friction == 0 && material->kinetic_friction == 0));
}

/* And a model? */
static bool is_built_for(const cairn_body_model *model)
{
    bool still = model->type == CAIRN_STATIC, round = cairn_shape_is_round(model->shape);
    return is_built_for_material(model->material) && (CAIRN_WITH_FIXED_POSITION || !model->fixed_position) && (CAIRN_WITH_SENSORS || !model->sensor)
        && (CAIRN_WITH_DAMPING || (model->damping == 0 && model->angular_damping == 0))
        && (CAIRN_WITH_GRAVITY_SCALE || still || model->gravity_scale == CAIRN_F(1))
        && (CAIRN_WITH_POLYGONS || model->shape->polygon == NULL) && (CAIRN_MAX_POINTS > 1 || model->type != CAIRN_DYNAMIC || round)
        && ((CAIRN_WITH_TURNING && (CAIRN_WITH_SLOPES || round)) || still || model->fixed_rotation);
}

/* What a build does not know it has refused. */
static bool is_material_valid(const cairn_material *material)
{
    return (!CAIRN_WITH_FRICTION
            || (material->kinetic_friction >= 0 && material->kinetic_friction <= material->static_friction
                && material->static_friction <= CAIRN_FACTOR(64)))
        && (!CAIRN_WITH_BOUNCE
            || (material->restitution >= 0 && material->restitution <= CAIRN_FACTOR(1) && material->threshold >= 0
                && (!CAIRN_WITH_SOFT_SOLVER || material->restitution == 0 || material->bounce != NULL)));
}

static bool is_damping_valid(cairn_real damping) { return !CAIRN_WITH_DAMPING || (damping >= 0 && damping <= CAIRN_F(1000)); }

static bool is_model_valid(const cairn_body_model *model)
{
    return (model->type == CAIRN_DYNAMIC || model->type == CAIRN_STATIC || model->type == CAIRN_KINEMATIC) && is_material_valid(model->material)
        && (!CAIRN_WITH_GRAVITY_SCALE || cairn_real_is_within(model->gravity_scale, CAIRN_F(16))) && is_damping_valid(model->damping)
        && is_damping_valid(model->angular_damping);
}

/* Where a build knows one mass only: is it that of what moves already? */
static bool is_like_others(const cairn_world *world, const cairn_body_model *model)
{
    for (uint16_t i = 0; !CAIRN_WITH_MASSES && i < world->body_end; i++) {
        const cairn_body *body = &world->bodies[i];
        if ((body->flags & CAIRN_BODY_USED) && cairn_body_is_dynamic(body)
            && (body->model->shape != model->shape || !cairn_wide_is(body->model->density, model->density))) {
            return false;
        }
    }
    return true;
}

static bool is_mass_valid(const cairn_body_model *model)
{
    if (!CAIRN_WITH_MASSES) {
        return !cairn_wide_is_zero(model->density); /* contacts ask for no more */
    }
    cairn_wide kilograms = cairn_wide_mul(cairn_wide_from_word(cairn_shape_area(model->shape)), model->density);
    const cairn_wide least = MASS_MIN, most = MASS_MAX;
    return !cairn_wide_less(kilograms, least) && !cairn_wide_less(most, kilograms);
}

CAIRN_ONCE cairn_status check_model(const cairn_world *world, const cairn_body_model *model)
{
    if (model == NULL || model->shape == NULL || model->shape->kind == NULL || model->material == NULL) {
        return CAIRN_ERROR_NULL;
    }
    cairn_status status = model->shape->kind->check(model->shape);
    if (status != CAIRN_OK) {
        return status;
    }
    bool dynamic = model->type == CAIRN_DYNAMIC;
    if (!is_built_for(model)) {
        return CAIRN_ERROR_KIND;
    }
    if (!is_model_valid(model) || (dynamic && !is_mass_valid(model))) {
        return CAIRN_ERROR_RANGE;
    }
    return !dynamic || is_like_others(world, model) ? CAIRN_OK : CAIRN_ERROR_KIND;
}

/* And its place, of which the id is made without a division. */
static cairn_body *take_place(cairn_world *world, uint16_t *at)
{
    uint16_t place = world->body_free;
    if (place != CAIRN_NONE) {
        world->body_free = cairn_body_link(&world->bodies[place]);
    } else if (world->body_end < world->body_capacity) {
        place = world->body_end++;
        world->bodies[place].generation = 0;
    } else {
        return NULL;
    }
    *at = place;
    cairn_body *body = &world->bodies[place];
    uint16_t generation = body->generation;
    cairn_clear(body, sizeof *body);
    body->generation = (uint16_t)(generation == 0 ? 1 : generation);
    world->stats.bodies++;
    return body;
}

static unsigned flags_of(const cairn_body_model *model)
{
    bool dynamic = model->type == CAIRN_DYNAMIC, fixed = CAIRN_WITH_FIXED_POSITION && dynamic && model->fixed_position;
    bool plain = dynamic && !CAIRN_HAS_ODD_BODIES;
    plain = plain || (dynamic && !fixed && model->gravity_scale == CAIRN_F(1) && model->damping == 0 && model->angular_damping == 0);
    return (unsigned)model->type | cairn_flag_if(fixed, CAIRN_BODY_FIXED_POSITION) | cairn_flag_if(plain, CAIRN_BODY_PLAIN);
}

#define OF_MODEL (CAIRN_BODY_TYPE | CAIRN_BODY_FIXED_POSITION | CAIRN_BODY_PLAIN)

static void take_model(cairn_world *world, cairn_body *body, const cairn_body_model *model)
{
    body->model = model;
    body->flags = (uint16_t)((body->flags & ~(unsigned)OF_MODEL) | flags_of(model));
    body->inverse_gyration = 0;
    if (CAIRN_WITH_TURNING && model->type != CAIRN_STATIC && !model->fixed_rotation) {
        body->inverse_gyration = cairn_wide_pack(cairn_wide_inverse(cairn_wide_from_word(cairn_shape_gyration(model->shape))));
    }
    if (CAIRN_WITH_BOUNCE && CAIRN_WITH_SOFT_SOLVER && model->material->bounce != NULL) {
        world->bounce = model->material->bounce;
    }
}

void cairn_body_centroid(const cairn_body *body, cairn_offset *x, cairn_offset *y)
{
    const cairn_polygon *polygon = body->model->shape->polygon;
    *x = *y = 0;
    if (CAIRN_WITH_POLYGONS && polygon != NULL) {
        cairn_unit c = CAIRN_UNIT(1), s = 0;
        if (CAIRN_WITH_SLOPES) {
            cairn_angle_rotation(body->angle, &c, &s);
        }
        *x = cairn_offset_dot(polygon->centroid.x, -polygon->centroid.y, c, s);
        *y = cairn_offset_dot(polygon->centroid.x, polygon->centroid.y, s, c);
    }
}

static void place(cairn_world *world, cairn_body *body, cairn_vec2 position, cairn_angle angle)
{
    cairn_offset cx, cy;
    cairn_residue rx = cairn_residue_zero(), ry = rx;
    body->angle = angle;
    body->x = position.x;
    body->y = position.y;
    if (CAIRN_WITH_POLYGONS) { /* else its origin is its centre */
        cairn_body_centroid(body, &cx, &cy);
        cairn_coordinate_shift(&body->x, &rx, cx);
        cairn_coordinate_shift(&body->y, &ry, cy);
    }
    body->x_residue = rx & CAIRN_RESIDUE_BITS;
    body->y_residue = ry & CAIRN_RESIDUE_BITS;
    cairn_body_refresh_extents(body);
    if (CAIRN_WITH_QUADTREE) {
        world->placed = true;
    }
}

/* At an angle, if the build knows of any. */
static bool may_stand(const cairn_body_model *model, cairn_angle angle)
{
    return CAIRN_WITH_SLOPES || angle == 0 || cairn_shape_is_round(model->shape);
}

/* After a change of where a body is or of whom it meets. */
static void disturb(cairn_world *world, const cairn_body *body)
{
    if (cairn_world_sleep(world) != NULL && !cairn_body_is_dynamic(body)) {
        cairn_world_sleep(world)->disturb(world, body);
    }
}

static void set_spin(cairn_world *world, cairn_body *body, cairn_real radians_per_second)
{
    if (!cairn_body_can_turn(body)) {
        return;
    }
    body->w = cairn_motion_from_real(radians_per_second, cairn_wide_div(cairn_world_substep(world), cairn_body_inverse_gyration(body)));
    cairn_body_limit_speed(world, body);
}

static void set_velocity(cairn_world *world, cairn_body *body, cairn_vec2 velocity)
{
    if (cairn_body_is_fixed(body)) {
        return;
    }
    world->driven = true;
    body->vx = cairn_motion_from_real(velocity.x, cairn_world_substep(world));
    body->vx_carry = body->vy_carry = 0;
    body->vy = cairn_motion_from_real(velocity.y, cairn_world_substep(world));
    cairn_body_limit_speed(world, body);
}

cairn_body_id cairn_body_create(cairn_world *world, const cairn_body_model *model, cairn_vec2 position, cairn_angle angle)
{
    if (world == NULL) {
        return cairn_body_id_null();
    }
    cairn_status status = world->locked ? CAIRN_ERROR_LOCKED : check_model(world, model);
    if (status == CAIRN_OK && !may_stand(model, angle)) {
        status = CAIRN_ERROR_KIND;
    }
    if (status == CAIRN_OK && (!cairn_real_is_within(position.x, CAIRN_WORLD_EDGE) || !cairn_real_is_within(position.y, CAIRN_WORLD_EDGE))) {
        status = CAIRN_ERROR_RANGE;
    }
    cairn_body_id id;
    cairn_body *body = status == CAIRN_OK ? take_place(world, &id.index) : NULL;
    if (body == NULL) {
        cairn_fail(world, status == CAIRN_OK ? CAIRN_ERROR_FULL : status);
        return cairn_body_id_null();
    }
    body->flags = CAIRN_BODY_USED;
    take_model(world, body, model);
    place(world, body, position, angle);
    disturb(world, body);
    id.index++;
    id.generation = body->generation;
    return id;
}

cairn_status cairn_body_destroy(cairn_world *world, cairn_body_id id)
{
    cairn_status status;
    cairn_body *body = cairn_body_find_to_change(world, id, &status);
    if (body == NULL) {
        return status;
    }
    uint16_t index = (uint16_t)(id.index - 1);
    cairn_arbiters_remove_body(world, index);
    if (cairn_world_springs(world) != NULL) {
        cairn_world_springs(world)->kind->remove_body(world, index);
    }
    body->flags = 0;
    body->generation = (uint16_t)(body->generation == UINT16_MAX ? 1 : body->generation + 1);
    cairn_body_set_link(body, world->body_free);
    world->body_free = index;
    world->placed = true;
    world->stats.bodies--;
    return CAIRN_OK;
}

/* ---- what the game may change ---- */

void cairn_body_wake_up(cairn_world *world, cairn_body *body)
{
    (void)world;
    body->flags &= (uint16_t)~CAIRN_BODY_ASLEEP;
    body->rest = 0;
}

cairn_status cairn_body_wake(cairn_world *world, cairn_body_id id)
{
    cairn_status status;
    cairn_body *body = cairn_body_find_to_change(world, id, &status);
    if (body != NULL) {
        cairn_body_wake_up(world, body);
    }
    return status;
}

cairn_status cairn_body_set_transform(cairn_world *world, cairn_body_id id, cairn_vec2 position, cairn_angle angle)
{
    cairn_status status;
    cairn_body *body = cairn_body_find_to_change(world, id, &status);
    if (body == NULL) {
        return status;
    }
    if (!cairn_real_is_within(position.x, CAIRN_WORLD_EDGE) || !cairn_real_is_within(position.y, CAIRN_WORLD_EDGE)) {
        return cairn_fail(world, CAIRN_ERROR_RANGE);
    }
    if (!may_stand(body->model, angle)) {
        return cairn_fail(world, CAIRN_ERROR_KIND);
    }
    cairn_arbiters_remove_body(world, (uint16_t)(id.index - 1));
    cairn_body_wake_up(world, body);
    place(world, body, position, angle);
    disturb(world, body);
    return CAIRN_OK;
}

static cairn_body *find_mobile(cairn_world *world, cairn_body_id id, cairn_status *status)
{
    cairn_body *body = cairn_body_find_to_change(world, id, status);
    if (body != NULL && cairn_body_type_of(body) == CAIRN_STATIC) {
        *status = cairn_fail(world, CAIRN_ERROR_KIND);
        body = NULL;
    }
    if (body != NULL) {
        cairn_body_wake_up(world, body);
    }
    return body;
}

cairn_status cairn_body_set_velocity(cairn_world *world, cairn_body_id id, cairn_vec2 velocity)
{
    cairn_status status;
    cairn_body *body = find_mobile(world, id, &status);
    if (body != NULL) {
        set_velocity(world, body, velocity);
    }
    return status;
}

cairn_status cairn_body_set_angular_velocity(cairn_world *world, cairn_body_id id, cairn_real radians_per_second)
{
    cairn_status status;
    cairn_body *body = find_mobile(world, id, &status);
    if (body != NULL) {
        set_spin(world, body, radians_per_second);
    }
    return status;
}

/* Without the contacts of the body that no longer are what they were. */
static void change_contacts(cairn_world *world, const cairn_body *body, uint16_t index, bool as_before)
{
    if (as_before) {
        cairn_arbiters_refresh_materials(world, index);
        cairn_arbiters_wake_partners(world, index);
    } else {
        cairn_arbiters_remove_body(world, index);
    }
    disturb(world, body);
    if (cairn_world_springs(world) != NULL) {
        cairn_world_springs(world)->changed = true;
    }
}

cairn_status cairn_body_set_model(cairn_world *world, cairn_body_id id, const cairn_body_model *model)
{
    cairn_status status;
    cairn_body *body = cairn_body_find_to_change(world, id, &status);
    if (body == NULL) {
        return status;
    }
    status = check_model(world, model);
    if (status == CAIRN_OK && (model->shape != body->model->shape || model->type != body->model->type)) {
        status = CAIRN_ERROR_KIND;
    }
    if (status != CAIRN_OK) {
        return cairn_fail(world, status);
    }
    cairn_wide old_mass = cairn_body_mass_of(body), new_mass;
    const cairn_body_model *old = body->model;
    take_model(world, body, model);
    new_mass = cairn_body_mass_of(body);
    if (!cairn_body_can_turn(body)) {
        body->w = 0;
    }
    if (cairn_body_is_fixed(body)) {
        body->vx = body->vy = 0;
    }
    bool same_mass = !cairn_wide_less(old_mass, new_mass) && !cairn_wide_less(new_mass, old_mass);
    bool as_free = old->sensor == model->sensor && old->fixed_rotation == model->fixed_rotation && old->fixed_position == model->fixed_position;
    cairn_body_wake_up(world, body);
    change_contacts(world, body, (uint16_t)(id.index - 1), same_mass && as_free);
    return CAIRN_OK;
}
