/*
 * A scene as a constant table: what a JSON scene file says, in a form that fits in flash. The converter
 * (`tools/cairn table`) writes such tables; the host's loader (scene_json.h) fills one from a file.
 */
#ifndef CAIRN_SCENE_H
#define CAIRN_SCENE_H

#include <cairn/cairn.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cairn_scene_body {
    uint16_t model; /* a place in the scene's models */
    cairn_vec2 position;
    cairn_angle angle;
    cairn_vec2 velocity;
    cairn_real angular_velocity;
} cairn_scene_body;

typedef struct cairn_scene_spring {
    uint16_t a, b; /* places in bodies */
    cairn_vec2 anchor_a, anchor_b;
    cairn_real rest_length;        /* negative: as placed */
    cairn_wide stiffness, damping; /* or, where frequency is not 0: */
    cairn_real frequency, damping_ratio;
    bool no_contact;
} cairn_scene_spring;

typedef enum cairn_scene_solver { CAIRN_SCENE_SOFT, CAIRN_SCENE_SLIDES, CAIRN_SCENE_SMALL } cairn_scene_solver;
typedef enum cairn_scene_broad { CAIRN_SCENE_PAIRS, CAIRN_SCENE_QUADTREE } cairn_scene_broad;

typedef struct cairn_scene {
    const char *name;
    cairn_vec2 gravity;
    cairn_real rate;
    uint8_t substeps, passes;
    cairn_scene_solver solver;
    cairn_scene_broad broad;
    bool sleep;
    uint16_t material_count, shape_count, model_count, body_count, spring_count;
    const cairn_material *materials;
    const cairn_shape *const *shapes;
    const cairn_body_model *models; /* of shapes and materials above */
    const cairn_scene_body *bodies;
    const cairn_scene_spring *springs;
} cairn_scene;

/* The memory a scene is built in. Springs, tree and blocks may be null where the scene has none or needs none. */
typedef struct cairn_scene_storage {
    const cairn_world_storage *world;
    const cairn_spring_storage *springs;
    const cairn_quadtree_storage *tree;
    cairn_block *blocks;
} cairn_scene_storage;

/*
 * Build the scene. ids and spring_ids, where not null, receive the ids in the order of the tables.
 * Null on error; *error then says why and *place which body (or body_count + spring).
 */
cairn_world *cairn_scene_build(const cairn_scene *scene, const cairn_scene_storage *storage, cairn_body_id *ids,
                               cairn_spring_id *spring_ids, cairn_status *error, int *place);

/* One more of the table's bodies; the table may have some behind the first body_count, for later. The null id on error. */
cairn_body_id cairn_scene_add_body(const cairn_scene *scene, cairn_world *world, uint16_t place);

#ifdef __cplusplus
}
#endif

#endif
