/* Cairn, with the table and the memory that tools/cairn writes. Not by cairn_scene_build(), which links every feature. */
#include "peer_cairn.h"

extern const cairn_scene cairn_the_scene;
extern const cairn_scene_storage cairn_the_scene_storage;

static cairn_world *world;

static bool add_body(const cairn_scene_body *entry)
{
    const cairn_body_model *model = &cairn_the_scene.models[entry->model];
    const cairn_body_id id = cairn_body_create(world, model, entry->position, entry->angle);
    return !cairn_body_id_is_null(id) &&
           (model->type == CAIRN_STATIC || (cairn_body_set_velocity(world, id, entry->velocity) == CAIRN_OK &&
                                            cairn_body_set_angular_velocity(world, id, entry->angular_velocity) == CAIRN_OK));
}

/* Bodies of a fresh world take the places of the pool in order. */
static cairn_body_id body_at(int place)
{
    cairn_body_id id = cairn_body_id_null();
    for (int i = 0; i <= place; i++) {
        id = cairn_world_next_body(world, id);
    }
    return id;
}

static bool add_spring(const cairn_scene_spring *entry)
{
    cairn_spring_def def = cairn_spring_def_default(body_at(entry->a), body_at(entry->b));
    def.anchor_a = entry->anchor_a;
    def.anchor_b = entry->anchor_b;
    def.rest_length = entry->rest_length;
    def.stiffness = entry->stiffness;
    def.damping = entry->damping;
    def.no_contact = entry->no_contact;
    return !cairn_spring_id_is_null(cairn_spring_create(world, &def));
}

bool peer_use_springs(void)
{
    bool fine = cairn_springs_enable(world, cairn_the_scene_storage.springs) == CAIRN_OK;
    for (int i = 0; fine && i < cairn_the_scene.spring_count; i++) {
        fine = add_spring(&cairn_the_scene.springs[i]);
    }
    return fine;
}

bool peer_use_quadtree(void)
{
    return cairn_quadtree_enable(world, cairn_the_scene_storage.tree, cairn_vec2_of(0, 0), 6, 6) == CAIRN_OK;
}

bool peer_use_blocks(void) { return cairn_blocks_enable(world, cairn_the_scene_storage.blocks) == CAIRN_OK; }

bool peer_use_slides(void) { return cairn_world_use_slides_solver(world, cairn_the_scene.passes) == CAIRN_OK; }

bool peer_use_small(void) { return cairn_world_use_small_solver(world, cairn_the_scene.passes) == CAIRN_OK; }

bool peer_build(peer_wish wish)
{
    (void)wish;
    world = cairn_world_init(cairn_the_scene_storage.world, cairn_the_scene.gravity);
    bool fine = world != NULL && cairn_world_set_rate(world, cairn_the_scene.rate) == CAIRN_OK &&
                cairn_world_set_substeps(world, cairn_the_scene.substeps) == CAIRN_OK;
    for (int i = 0; fine && i < cairn_the_scene.body_count; i++) {
        fine = add_body(&cairn_the_scene.bodies[i]);
    }
    for (const peer_feature *use = peer_features; fine && *use != NULL; use++) {
        fine = (*use)();
    }
    return fine;
}

void peer_step(void) { cairn_world_step(world); }
int peer_body_count(void) { return cairn_the_scene.body_count; }

peer_place peer_body_place(int body)
{
    const cairn_vec2 position = cairn_body_position(world, body_at(body));
    /* A turn of 2^32 in 2^-16 radians is 2 pi 2^16 = 411,775. */
    const int32_t angle = (int32_t)(((int64_t)cairn_body_angle(world, body_at(body)) * 411775) >> 32);
    return (peer_place){position.x, position.y, angle};
}

/* The free arbiters: the pool of the table is for any scene of so many bodies. */
uint32_t peer_spare(void)
{
    const int spare = cairn_the_scene_storage.world->arbiter_capacity - cairn_world_get_stats(world)->arbiters;
    return (uint32_t)spare * (uint32_t)(sizeof(cairn_arbiter) + sizeof(uint16_t));
}
