/* Bodies as tests say them: a model and a place in one. The models are kept, as a game would, and shared. */
#ifndef CAIRN_TEST_BODIES_H
#define CAIRN_TEST_BODIES_H

#include <cairn/cairn.h>
#include <unity.h>

typedef struct yard_def {
    const cairn_shape *shape;
    const cairn_material *material;
    cairn_body_type type;
    cairn_vec2 position;
    cairn_angle angle;
    cairn_vec2 velocity;
    cairn_real angular_velocity;
    cairn_wide density;
    cairn_real gravity_scale, damping, angular_damping;
    uint16_t layer, mask;
    bool sensor, fixed_rotation, fixed_position;
    const void *user;
} yard_def;

/* Models outlive their bodies; bodies of one make share one. */
#ifndef YARD_MODELS
#define YARD_MODELS 64
#endif
static cairn_body_model yard_models[YARD_MODELS];
static int yard_model_count;

static inline bool are_equal_models(const cairn_body_model *a, const cairn_body_model *b)
{
    return a->shape == b->shape && a->material == b->material && a->type == b->type && !cairn_wide_less(a->density, b->density)
        && !cairn_wide_less(b->density, a->density) && a->gravity_scale == b->gravity_scale && a->damping == b->damping
        && a->angular_damping == b->angular_damping && a->layer == b->layer && a->mask == b->mask && a->sensor == b->sensor
        && a->fixed_rotation == b->fixed_rotation && a->fixed_position == b->fixed_position && a->user == b->user;
}

static inline const cairn_body_model *keep_model(cairn_body_model model)
{
    for (int i = 0; i < yard_model_count; i++) {
        if (are_equal_models(&yard_models[i], &model)) {
            return &yard_models[i];
        }
    }
    TEST_ASSERT_TRUE_MESSAGE(yard_model_count < YARD_MODELS, "too many models in a test");
    yard_models[yard_model_count] = model;
    return &yard_models[yard_model_count++];
}

static inline yard_def def_at(const cairn_shape *shape, cairn_real x, cairn_real y)
{
    yard_def def;
    memset(&def, 0, sizeof def);
    def.shape = shape;
    def.material = &cairn_material_default;
    def.position = cairn_vec2_of(x, y);
    def.density = cairn_wide_from_int(1);
    def.gravity_scale = CAIRN_F(1);
    def.layer = 1;
    def.mask = 0xFFFF;
    return def;
}

static inline cairn_body_model model_of(const yard_def *def)
{
    cairn_body_model model = CAIRN_BODY_MODEL(def->type, def->shape, def->material);
    model.density = def->density;
    model.gravity_scale = def->gravity_scale;
    model.damping = def->damping;
    model.angular_damping = def->angular_damping;
    model.layer = def->layer;
    model.mask = def->mask;
    model.sensor = def->sensor;
    model.fixed_rotation = def->fixed_rotation;
    model.fixed_position = def->fixed_position;
    model.user = def->user;
    return model;
}

static inline cairn_body_id make_in(cairn_world *in, const yard_def *def)
{
    cairn_body_id id = cairn_body_create(in, keep_model(model_of(def)), def->position, def->angle);
    if (!cairn_body_id_is_null(id) && def->type != CAIRN_STATIC) {
        (void)cairn_body_set_velocity(in, id, def->velocity);
        (void)cairn_body_set_angular_velocity(in, id, def->angular_velocity);
    }
    return id;
}

#endif
