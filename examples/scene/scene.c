/* Builds a world from a scene table: the same function on the host and in firmware. */
#include "scene.h"

/* Sub-steps are the soft solver's: the others have none. */
static cairn_status use_solver(const cairn_scene *scene, cairn_world *world)
{
    switch (scene->solver) {
    case CAIRN_SCENE_SLIDES:
        return cairn_world_use_slides_solver(world, scene->passes);
    case CAIRN_SCENE_SMALL:
        return cairn_world_use_small_solver(world, scene->passes);
    default:
        return cairn_world_set_substeps(world, scene->substeps);
    }
}

static cairn_status settle_world(const cairn_scene *scene, const cairn_scene_storage *storage, cairn_world *world)
{
    cairn_status status = cairn_world_set_gravity(world, scene->gravity);
    if (status == CAIRN_OK) {
        status = cairn_world_set_rate(world, scene->rate);
    }
    if (status == CAIRN_OK) {
        status = use_solver(scene, world);
    }
    if (status == CAIRN_OK && scene->broad == CAIRN_SCENE_QUADTREE) {
        status = storage->tree == NULL ? CAIRN_ERROR_NULL : cairn_quadtree_enable(world, storage->tree, cairn_vec2_of(0, 0), 6, 6);
    }
    if (status == CAIRN_OK && storage->blocks != NULL) {
        status = cairn_blocks_enable(world, storage->blocks);
    }
    if (status == CAIRN_OK && scene->sleep) {
        status = cairn_sleep_enable(world);
    }
    if (status == CAIRN_OK && scene->spring_count > 0) {
        status = storage->springs == NULL ? CAIRN_ERROR_NULL : cairn_springs_enable(world, storage->springs);
    }
    return status;
}

cairn_body_id cairn_scene_add_body(const cairn_scene *scene, cairn_world *world, uint16_t place)
{
    const cairn_scene_body *entry = &scene->bodies[place];
    const cairn_body_model *model = entry->model < scene->model_count ? &scene->models[entry->model] : NULL;
    cairn_body_id id = cairn_body_create(world, model, entry->position, entry->angle);
    if (!cairn_body_id_is_null(id) && model->type != CAIRN_STATIC) {
        (void)cairn_body_set_velocity(world, id, entry->velocity);
        (void)cairn_body_set_angular_velocity(world, id, entry->angular_velocity);
    }
    return id;
}

/* Bodies of a fresh world take the places of the pool in order. The null id if the scene has no such body. */
static cairn_body_id body_at(const cairn_scene *scene, const cairn_world *world, uint16_t place)
{
    cairn_body_id id = cairn_body_id_null();
    if (place < scene->body_count) {
        id.index = (uint16_t)(place + 1);
        id.generation = world->bodies[place].generation;
    }
    return id;
}

static cairn_spring_id make_spring(const cairn_scene *scene, cairn_world *world, const cairn_scene_spring *entry)
{
    cairn_spring_def def = cairn_spring_def_default(body_at(scene, world, entry->a), body_at(scene, world, entry->b));
    def.anchor_a = entry->anchor_a;
    def.anchor_b = entry->anchor_b;
    def.rest_length = entry->rest_length;
    def.stiffness = entry->stiffness;
    def.damping = entry->damping;
    def.no_contact = entry->no_contact;
    if (entry->frequency > 0 && cairn_spring_tune(world, &def, entry->frequency, entry->damping_ratio) != CAIRN_OK) {
        return cairn_spring_id_null();
    }
    return cairn_spring_create(world, &def);
}

cairn_world *cairn_scene_build(const cairn_scene *scene, const cairn_scene_storage *storage, cairn_body_id *ids,
                               cairn_spring_id *spring_ids, cairn_status *error, int *place)
{
    *place = -1;
    *error = CAIRN_ERROR_NULL;
    cairn_world *world = cairn_world_init(storage->world, cairn_vec2_of(0, 0));
    if (world == NULL) {
        return NULL;
    }
    *error = settle_world(scene, storage, world);
    if (*error != CAIRN_OK) {
        return NULL;
    }
    for (uint16_t i = 0; i < scene->body_count; i++) {
        cairn_body_id id = cairn_scene_add_body(scene, world, i);
        if (cairn_body_id_is_null(id)) {
            *error = cairn_world_error(world);
            *place = i;
            return NULL;
        }
        if (ids != NULL) {
            ids[i] = id;
        }
    }
    for (uint16_t i = 0; i < scene->spring_count; i++) {
        cairn_spring_id id = make_spring(scene, world, &scene->springs[i]);
        if (cairn_spring_id_is_null(id)) {
            *error = cairn_world_error(world);
            *place = scene->body_count + i;
            return NULL;
        }
        if (spring_ids != NULL) {
            spring_ids[i] = id;
        }
    }
    return world;
}
