/*
 * What the tests of the engine share: one world, short names, and comparisons in SI units in either arithmetic.
 * Expected values and tolerances are plain constants, so that no test computes in floating point on a board.
 */
#ifndef CAIRN_TEST_YARD_H
#define CAIRN_TEST_YARD_H

#include "bodies.h"

#include <cairn/cairn.h>
#include <unity.h>

#ifndef YARD_BODIES
#define YARD_BODIES 16
#endif
#ifndef YARD_ARBITERS
#define YARD_ARBITERS 32
#endif

CAIRN_WORLD(yard, YARD_BODIES, YARD_ARBITERS);
static cairn_world *world;

/* actual is a cairn_real; the others are constants. */
#ifdef CAIRN_DOUBLE
#define ASSERT_NEAR(within, expected, actual) TEST_ASSERT_DOUBLE_WITHIN(within, expected, actual)
#define ASSERT_SAME(expected, actual) TEST_ASSERT_TRUE((expected) == (actual))
#else
#define ASSERT_NEAR(within, expected, actual) TEST_ASSERT_INT32_WITHIN(CAIRN_F(within), CAIRN_F(expected), actual)
#define ASSERT_SAME(expected, actual) TEST_ASSERT_EQUAL_INT32(expected, actual)
#endif
/* One step of Q16.16: what rounding alone may do to a number that a game reads. */
#define LSB (1.0 / 65536)

#define ASSERT_NEAR_VEC2(within, expected_x, expected_y, actual) \
    do { \
        cairn_vec2 actual_vec2 = (actual); \
        ASSERT_NEAR(within, expected_x, actual_vec2.x); \
        ASSERT_NEAR(within, expected_y, actual_vec2.y); \
    } while (0)

#define ASSERT_OK(call) TEST_ASSERT_EQUAL_INT(CAIRN_OK, call)

/* ---- nothing changes in a refused call ---- */

static cairn_world world_before;
static cairn_body bodies_before[YARD_BODIES];
static cairn_arbiter arbiters_before[YARD_ARBITERS];
static uint16_t order_before[YARD_ARBITERS];

static inline void keep_yard(void)
{
    yard_world.error = CAIRN_OK;
    world_before = yard_world;
    memcpy(bodies_before, yard_bodies, sizeof yard_bodies);
    memcpy(arbiters_before, yard_arbiters, sizeof yard_arbiters);
    memcpy(order_before, yard_order, sizeof yard_order);
}

static inline void assert_yard_kept(void)
{
    world_before.error = yard_world.error;
    TEST_ASSERT_EQUAL_MEMORY(&world_before, &yard_world, sizeof yard_world);
    TEST_ASSERT_EQUAL_MEMORY(bodies_before, yard_bodies, sizeof yard_bodies);
    TEST_ASSERT_EQUAL_MEMORY(arbiters_before, yard_arbiters, sizeof yard_arbiters);
    TEST_ASSERT_EQUAL_MEMORY(order_before, yard_order, sizeof yard_order);
}

/* The call on the yard's world gives this status, keeps it for cairn_world_error(), and leaves the world as it was. */
#define ASSERT_REFUSED(status, call) \
    do { \
        keep_yard(); \
        TEST_ASSERT_EQUAL_INT(status, call); \
        assert_yard_kept(); \
        TEST_ASSERT_EQUAL_INT(status, cairn_world_error(world)); \
    } while (0)

/* The same for a call that gives an id, or another value that is null or zero on error. */
#define ASSERT_REFUSED_ID(status, call) \
    do { \
        keep_yard(); \
        TEST_ASSERT_EQUAL_UINT16(0, (call).index); \
        assert_yard_kept(); \
        TEST_ASSERT_EQUAL_INT(status, cairn_world_error(world)); \
    } while (0)

static inline cairn_body_id make(const yard_def *def)
{
    cairn_body_id id = make_in(world, def);
    TEST_ASSERT_FALSE(cairn_body_id_is_null(id));
    return id;
}

/* ---- short names ---- */

static inline const cairn_world_stats *stats(void) { return cairn_world_get_stats(world); }

static inline void open_yard(cairn_real gravity_y)
{
    world = cairn_world_init(&yard, cairn_vec2_of(0, gravity_y));
    yard_model_count = 0;
    TEST_ASSERT_NOT_NULL(world);
}

static inline void run(int steps)
{
    for (int i = 0; i < steps; i++) {
        ASSERT_OK(cairn_world_step(world));
    }
}

static inline cairn_body_id put(const cairn_shape *shape, cairn_real x, cairn_real y)
{
    yard_def def = def_at(shape, x, y);
    return make(&def);
}

static inline cairn_body_id put_static(const cairn_shape *shape, cairn_real x, cairn_real y)
{
    yard_def def = def_at(shape, x, y);
    def.type = CAIRN_STATIC;
    return make(&def);
}

static inline cairn_body_id put_moving(const cairn_shape *shape, cairn_real x, cairn_real y, cairn_real vx, cairn_real vy)
{
    yard_def def = def_at(shape, x, y);
    def.velocity = cairn_vec2_of(vx, vy);
    return make(&def);
}

/* One thing of a body's model changed. */
static inline cairn_body_model model_now(cairn_body_id id) { return *cairn_body_get_model(world, id); }
static inline cairn_status set_material(cairn_body_id id, const cairn_material *material)
{
    cairn_body_model model = model_now(id);
    model.material = material;
    return cairn_body_set_model(world, id, keep_model(model));
}
static inline cairn_status set_layers(cairn_body_id id, uint16_t layer, uint16_t mask)
{
    cairn_body_model model = model_now(id);
    model.layer = layer;
    model.mask = mask;
    return cairn_body_set_model(world, id, keep_model(model));
}
static inline cairn_status set_gravity_scale(cairn_body_id id, cairn_real scale)
{
    cairn_body_model model = model_now(id);
    model.gravity_scale = scale;
    return cairn_body_set_model(world, id, keep_model(model));
}
static inline cairn_status set_damping(cairn_body_id id, cairn_real linear, cairn_real angular)
{
    cairn_body_model model = model_now(id);
    model.damping = linear;
    model.angular_damping = angular;
    return cairn_body_set_model(world, id, keep_model(model));
}

static inline cairn_vec2 at(cairn_real x, cairn_real y) { return cairn_vec2_of(x, y); }
static inline cairn_real x_of(cairn_body_id id) { return cairn_body_position(world, id).x; }
static inline cairn_real y_of(cairn_body_id id) { return cairn_body_position(world, id).y; }
static inline cairn_real vx_of(cairn_body_id id) { return cairn_body_velocity(world, id).x; }
static inline cairn_real vy_of(cairn_body_id id) { return cairn_body_velocity(world, id).y; }
static inline cairn_real spin_of(cairn_body_id id) { return cairn_body_angular_velocity(world, id); }
static inline cairn_real turned(cairn_body_id id) { return cairn_angle_radians(cairn_body_angle(world, id)); }
static inline cairn_real size_of(cairn_real x) { return x < 0 ? -x : x; }

static inline bool same(cairn_body_id a, cairn_body_id b) { return cairn_body_id_equal(a, b); }

/* The contact of two bodies, in either order; false if there is none. */
static inline bool contact_of(cairn_body_id a, cairn_body_id b, cairn_contact *contact)
{
    int cursor = 0;
    while (cairn_world_next_contact(world, &cursor, contact)) {
        if ((same(contact->a, a) && same(contact->b, b)) || (same(contact->a, b) && same(contact->b, a))) {
            return true;
        }
    }
    return false;
}

static inline bool are_touching(cairn_body_id a, cairn_body_id b)
{
    cairn_contact contact;
    return contact_of(a, b, &contact) && contact.touching;
}

#endif
