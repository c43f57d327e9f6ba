/*
 * Bodies: shapes in space. A body is named by an id, an index with a generation: an id of a destroyed body is
 * recognised as stale and refused. The null id is all zero.
 *
 * Functions that return a cairn_status change nothing unless they return CAIRN_OK. Functions that return a value give
 * zero for a stale id; cairn_world_error() tells why.
 */
#ifndef CAIRN_BODY_H
#define CAIRN_BODY_H

#include "material.h"
#include "shape.h"

#ifdef __cplusplus
extern "C" {
#endif

struct cairn_world;

typedef struct cairn_body_id {
    uint16_t index;      /* place in the pool plus one; 0 is null */
    uint16_t generation;
} cairn_body_id;

typedef enum cairn_body_type {
    CAIRN_DYNAMIC = 0, /* moves by forces and contacts */
    CAIRN_STATIC = 1,  /* never moves */
    CAIRN_KINEMATIC = 2 /* moves by its own velocity only, as if of infinite mass: platforms */
} cairn_body_type;

/*
 * What bodies of one make share: plain constant data that the game keeps for as long as such a body exists, in flash
 * where it is `static const`. Start from CAIRN_BODY_MODEL() or cairn_body_model_default().
 */
typedef struct cairn_body_model {
    const cairn_shape *shape;       /* must outlive the model */
    const cairn_material *material; /* likewise */
    cairn_body_type type;
    cairn_wide density;             /* kg/m^2; mass and inertia follow from the shape; of dynamic bodies only */
    cairn_real gravity_scale;       /* -16 to 16 */
    cairn_real damping;             /* 1/s, share of the velocity lost per second, 0 to 1000 */
    cairn_real angular_damping;     /* 1/s */
    uint16_t layer, mask;           /* bodies meet if a.layer & b.mask and b.layer & a.mask */
    bool sensor;                    /* reports contacts and does not push */
    bool fixed_rotation;            /* cannot turn */
    bool fixed_position;            /* cannot leave its place, can turn about it */
    const void *user;               /* the game's own */
} cairn_body_model;

/* Initialiser: a body of density 1 on layer 1 that meets all layers. */
#define CAIRN_BODY_MODEL(type, shape, material) \
    { (shape), (material), (type), CAIRN_DENSITY(1), CAIRN_F(1), 0, 0, 1, 0xFFFF, false, false, false, NULL }

/*
 * The layout of a body is the engine's own: games use ids and the functions below. What the sub-steps touch comes first,
 * within reach of a Cortex-M0's short offsets.
 */
typedef struct cairn_body {
    uint16_t flags; /* first, so that gcc keeps one pointer to what follows and not a base and an index */
    uint16_t generation;
    /* Sub-step state, see DESIGN.md: velocity * h, velocity at the sub-step's start, displacement in this step.
       The turning components (w) are angles times the radius of gyration. */
    cairn_motion vx, vy, w;
    cairn_motion ux, uy, uw; /* between steps: the velocity change per sub-step by the applied forces */
    cairn_motion dx, dy, dw; /* outside of the sub-steps other things, see engine.h */
    cairn_extent extent_x, extent_y; /* half sizes of the bounding box with a margin; x is 0 while they are not known */
    cairn_real x, y; /* centre of mass */
    unsigned x_residue : 12, y_residue : 12; /* cairn_residue */
    unsigned rest : 8;              /* steps at rest, see sleep.c */
    cairn_carry vx_carry, vy_carry; /* of impacts, see bounce.c */
    cairn_angle angle;
    const cairn_body_model *model;
    cairn_packed inverse_gyration; /* 1/m; zero if it cannot turn */
} cairn_body;

static inline cairn_body_id cairn_body_id_null(void)
{
    cairn_body_id id;
    id.index = 0;
    id.generation = 0;
    return id;
}
static inline bool cairn_body_id_is_null(cairn_body_id id) { return id.index == 0; }
static inline bool cairn_body_id_equal(cairn_body_id a, cairn_body_id b) { return a.index == b.index && a.generation == b.generation; }

/* A dynamic body of density 1 and the default material, on layer 1, meeting all layers. */
static inline cairn_body_model cairn_body_model_default(const cairn_shape *shape)
{
    cairn_body_model model = CAIRN_BODY_MODEL(CAIRN_DYNAMIC, shape, &cairn_material_default);
    return model;
}

/*
 * Make a body at rest: its shape's origin at a position in metres. Null id on error: CAIRN_ERROR_NULL (world, model, shape
 * or material), CAIRN_ERROR_SHAPE, CAIRN_ERROR_RANGE (the position, density of a dynamic body not above zero or mass outside
 * of 1e-7 to 1e9 kg, a material's or a damping's range), CAIRN_ERROR_FULL, CAIRN_ERROR_LOCKED.
 *
 * What the game knows of one body it keeps in an array of its own: id.index is 1 to the capacity, the lowest that is free
 * for the first bodies, and another one's after the body is destroyed.
 */
cairn_body_id cairn_body_create(struct cairn_world *world, const cairn_body_model *model, cairn_vec2 position, cairn_angle angle);
/* Remove a body with its arbiters and springs; bodies that touched it wake. */
cairn_status cairn_body_destroy(struct cairn_world *world, cairn_body_id id);
bool cairn_body_exists(const struct cairn_world *world, cairn_body_id id);

/* Where the shape's origin is; where the centre of mass is. Metres. */
cairn_vec2 cairn_body_position(struct cairn_world *world, cairn_body_id id);
cairn_vec2 cairn_body_center(struct cairn_world *world, cairn_body_id id);
cairn_angle cairn_body_angle(struct cairn_world *world, cairn_body_id id);
cairn_vec2 cairn_body_velocity(struct cairn_world *world, cairn_body_id id);
cairn_real cairn_body_angular_velocity(struct cairn_world *world, cairn_body_id id);
/* Velocity of the body's material at a point of the world. */
cairn_vec2 cairn_body_velocity_at(struct cairn_world *world, cairn_body_id id, cairn_vec2 point);
/* A point of the body in the world, and back. */
cairn_vec2 cairn_body_to_world(struct cairn_world *world, cairn_body_id id, cairn_vec2 local);
cairn_vec2 cairn_body_to_local(struct cairn_world *world, cairn_body_id id, cairn_vec2 point);
/* Mass in kg and moment of inertia in kg m^2 about the centre of mass; zero unless dynamic. */
cairn_wide cairn_body_mass(struct cairn_world *world, cairn_body_id id);
cairn_wide cairn_body_inertia(struct cairn_world *world, cairn_body_id id);
const cairn_body_model *cairn_body_get_model(struct cairn_world *world, cairn_body_id id);
/* What the model says. */
const cairn_shape *cairn_body_shape(struct cairn_world *world, cairn_body_id id);
cairn_body_type cairn_body_get_type(struct cairn_world *world, cairn_body_id id);
const void *cairn_body_user(struct cairn_world *world, cairn_body_id id);
bool cairn_body_is_sensor(struct cairn_world *world, cairn_body_id id);
bool cairn_body_is_awake(struct cairn_world *world, cairn_body_id id);

/* Teleport. Wakes the body and what it touched. */
cairn_status cairn_body_set_transform(struct cairn_world *world, cairn_body_id id, cairn_vec2 position, cairn_angle angle);
/* Speeds are capped, see cairn_world_speed_limit(). A static body refuses (CAIRN_ERROR_KIND). */
cairn_status cairn_body_set_velocity(struct cairn_world *world, cairn_body_id id, cairn_vec2 velocity);
cairn_status cairn_body_set_angular_velocity(struct cairn_world *world, cairn_body_id id, cairn_real radians_per_second);
/*
 * From now on the body is of another model with the same shape and type (else CAIRN_ERROR_KIND; otherwise as creation). It
 * wakes, and so does what it touched. Another density, sensor or freedom to move begins its contacts anew.
 */
cairn_status cairn_body_set_model(struct cairn_world *world, cairn_body_id id, const cairn_body_model *model);
cairn_status cairn_body_wake(struct cairn_world *world, cairn_body_id id);

/* Forces act during the next step and are then forgotten. Newtons, newton metres; points in the world. Dynamic bodies only. */
cairn_status cairn_body_apply_force(struct cairn_world *world, cairn_body_id id, cairn_vec2 force);
cairn_status cairn_body_apply_force_at(struct cairn_world *world, cairn_body_id id, cairn_vec2 force, cairn_vec2 point);
cairn_status cairn_body_apply_torque(struct cairn_world *world, cairn_body_id id, cairn_real torque);
/* Impulses act at once. Newton seconds, newton metre seconds. */
cairn_status cairn_body_apply_impulse(struct cairn_world *world, cairn_body_id id, cairn_vec2 impulse);
cairn_status cairn_body_apply_impulse_at(struct cairn_world *world, cairn_body_id id, cairn_vec2 impulse, cairn_vec2 point);
cairn_status cairn_body_apply_angular_impulse(struct cairn_world *world, cairn_body_id id, cairn_real impulse);

#ifdef __cplusplus
}
#endif

#endif
