/* Bodies: kinds, motion by forces and impulses against closed forms, what a game may ask and change. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

/* The memory of a body on the cores that the engine is for. */
#if !defined(CAIRN_DOUBLE) && UINTPTR_MAX == 0xFFFFFFFF
typedef char assert_body_takes_72_bytes[sizeof(cairn_body) == 72 ? 1 : -1];
#endif

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape marble = CAIRN_CIRCLE(CAIRN_F(0.1));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));          /* 1 kg, 1/6 kg m^2 */
static const cairn_shape plank = CAIRN_BOX(CAIRN_F(2), CAIRN_F(0.5));      /* 1 kg, 17/48 kg m^2 */
static const cairn_shape flipper = CAIRN_BOX(CAIRN_F(2), CAIRN_F(0.2));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(40), CAIRN_F(1));
static const cairn_material smooth = CAIRN_MATERIAL(0, 0);
static cairn_polygon corner; /* a triangle whose centroid is at (1, 1) */

static cairn_body_id body, gone, floor_id;

/* In empty space: a box at the origin, a floor far below, and an id that is stale. */
void setUp(void)
{
    static const cairn_vec2 points[] = { { CAIRN_F(0), CAIRN_F(0) }, { CAIRN_F(3), CAIRN_F(0) }, { CAIRN_F(0), CAIRN_F(3) } };
    open_yard(0);
    ASSERT_OK(cairn_polygon_init(&corner, points, 3));
    gone = put(&ball, 0, 0);
    floor_id = put_static(&ground, 0, CAIRN_F(-100));
    ASSERT_OK(cairn_body_destroy(world, gone));
    body = put(&box, 0, 0);
}
void tearDown(void) {}

/* A call with a world and an id, and what stands behind them, refuses null worlds and ids that name nothing. */
#define ASSERT_REFUSES_NULL_AND_STALE(function, ...) \
    do { \
        TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, function(NULL, body, __VA_ARGS__)); \
        ASSERT_REFUSED(CAIRN_ERROR_STALE, function(world, gone, __VA_ARGS__)); \
        ASSERT_REFUSED(CAIRN_ERROR_STALE, function(world, cairn_body_id_null(), __VA_ARGS__)); \
    } while (0)

/* ---- making one ---- */

static void assert_create_refused(cairn_status status, const yard_def *def) { ASSERT_REFUSED_ID(status, make_in(world, def)); }

void test_create_refuses_null(void)
{
    yard_def def = def_at(&box, 0, 0);
    TEST_ASSERT_TRUE(cairn_body_id_is_null(make_in(NULL, &def)));
    ASSERT_REFUSED_ID(CAIRN_ERROR_NULL, cairn_body_create(world, NULL, at(0, 0), 0));
    def.material = NULL;
    assert_create_refused(CAIRN_ERROR_NULL, &def);
    def = def_at(NULL, 0, 0);
    assert_create_refused(CAIRN_ERROR_NULL, &def);
    cairn_shape kindless = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
    kindless.kind = NULL;
    def = def_at(&kindless, 0, 0);
    assert_create_refused(CAIRN_ERROR_NULL, &def);
}

void test_create_refuses_a_bad_shape(void)
{
    static const cairn_shape nothing = CAIRN_CIRCLE(0);
    yard_def def = def_at(&nothing, 0, 0);
    assert_create_refused(CAIRN_ERROR_SHAPE, &def);
    def.type = CAIRN_STATIC;
    assert_create_refused(CAIRN_ERROR_SHAPE, &def);
}

void test_create_refuses_masses_outside_of_1e_7_to_1e9_kg(void)
{
    yard_def def = def_at(&box, 0, 0);
    def.density = cairn_wide_from_int(0);
    assert_create_refused(CAIRN_ERROR_RANGE, &def);
    def.density = cairn_wide_of(1, -25);
    assert_create_refused(CAIRN_ERROR_RANGE, &def);
    def.density = cairn_wide_from_int(1000000001);
    assert_create_refused(CAIRN_ERROR_RANGE, &def);
    def.density = cairn_wide_from_int(1000000000);
    make(&def);
    def.density = cairn_wide_div(cairn_wide_from_int(1), cairn_wide_from_int(10000000));
    make(&def);
}

void test_create_takes_any_density_of_what_is_not_dynamic(void)
{
    yard_def def = def_at(&box, 0, 0);
    def.density = cairn_wide_from_int(0);
    def.type = CAIRN_STATIC;
    make(&def);
    def.type = CAIRN_KINEMATIC;
    make(&def);
}

void test_create_refuses_an_unknown_type(void)
{
    yard_def def = def_at(&box, 0, 0);
    def.type = (cairn_body_type)3;
    assert_create_refused(CAIRN_ERROR_RANGE, &def);
}

void test_create_refuses_places_beyond_the_edge_of_the_world(void)
{
    static const cairn_vec2 places[] = { { CAIRN_F(16001), 0 }, { CAIRN_F(-16001), 0 }, { 0, CAIRN_F(16001) }, { 0, CAIRN_F(-16001) } };
    for (int i = 0; i < 4; i++) {
        yard_def def = def_at(&box, places[i].x, places[i].y);
        assert_create_refused(CAIRN_ERROR_RANGE, &def);
    }
    put(&box, CAIRN_F(16000), CAIRN_F(-16000));
}

void test_create_refuses_gravity_scales_beyond_16(void)
{
    yard_def def = def_at(&box, 0, 0);
    def.gravity_scale = CAIRN_F(16.1);
    assert_create_refused(CAIRN_ERROR_RANGE, &def);
    def.gravity_scale = CAIRN_F(-16.1);
    assert_create_refused(CAIRN_ERROR_RANGE, &def);
    def.gravity_scale = CAIRN_F(-16);
    make(&def);
}

void test_create_refuses_dampings_outside_of_0_to_1000(void)
{
    static const cairn_real bad[] = { CAIRN_F(-0.1), CAIRN_F(1000.1) };
    for (int i = 0; i < 2; i++) {
        yard_def def = def_at(&box, 0, 0);
        def.damping = bad[i];
        assert_create_refused(CAIRN_ERROR_RANGE, &def);
        def = def_at(&box, 0, 0);
        def.angular_damping = bad[i];
        assert_create_refused(CAIRN_ERROR_RANGE, &def);
    }
    yard_def def = def_at(&box, 0, 0);
    def.damping = def.angular_damping = CAIRN_F(1000);
    make(&def);
}

void test_destroy_refuses_null_and_stale(void)
{
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_body_destroy(NULL, body));
    ASSERT_REFUSED(CAIRN_ERROR_STALE, cairn_body_destroy(world, gone));
    ASSERT_REFUSED(CAIRN_ERROR_STALE, cairn_body_destroy(world, cairn_body_id_null()));
}

/* ---- what a game may ask ---- */

/* Each gives zero for a stale id, and the error says why. */
#define ASSERT_STALE(condition) \
    do { \
        TEST_ASSERT_TRUE(condition); \
        TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_STALE, cairn_world_error(world)); \
    } while (0)

static bool is_zero(cairn_vec2 v) { return v.x == 0 && v.y == 0; }

void test_questions_about_a_stale_body_give_zero_and_an_error(void)
{
    cairn_vec2 point = at(CAIRN_F(1), CAIRN_F(2));
    ASSERT_STALE(is_zero(cairn_body_position(world, gone)));
    ASSERT_STALE(is_zero(cairn_body_center(world, gone)));
    ASSERT_STALE(cairn_body_angle(world, gone) == 0);
    ASSERT_STALE(is_zero(cairn_body_velocity(world, gone)));
    ASSERT_STALE(cairn_body_angular_velocity(world, gone) == 0);
    ASSERT_STALE(is_zero(cairn_body_velocity_at(world, gone, point)));
    ASSERT_STALE(is_zero(cairn_body_to_world(world, gone, point)));
    ASSERT_STALE(is_zero(cairn_body_to_local(world, gone, point)));
    ASSERT_STALE(cairn_wide_is_zero(cairn_body_mass(world, gone)));
    ASSERT_STALE(cairn_wide_is_zero(cairn_body_inertia(world, gone)));
    ASSERT_STALE(cairn_body_shape(world, gone) == NULL);
    ASSERT_STALE(cairn_body_get_type(world, gone) == (cairn_body_type)0);
    ASSERT_STALE(cairn_body_user(world, gone) == NULL);
    ASSERT_STALE(!cairn_body_is_awake(world, gone));
    ASSERT_STALE(!cairn_body_is_sensor(world, gone));
}

void test_questions_to_no_world_give_zero(void)
{
    cairn_vec2 point = at(CAIRN_F(1), CAIRN_F(2));
    TEST_ASSERT_TRUE(is_zero(cairn_body_position(NULL, body)));
    TEST_ASSERT_TRUE(is_zero(cairn_body_center(NULL, body)));
    TEST_ASSERT_TRUE(cairn_body_angle(NULL, body) == 0);
    TEST_ASSERT_TRUE(is_zero(cairn_body_velocity(NULL, body)));
    TEST_ASSERT_TRUE(cairn_body_angular_velocity(NULL, body) == 0);
    TEST_ASSERT_TRUE(is_zero(cairn_body_velocity_at(NULL, body, point)));
    TEST_ASSERT_TRUE(is_zero(cairn_body_to_world(NULL, body, point)));
    TEST_ASSERT_TRUE(is_zero(cairn_body_to_local(NULL, body, point)));
    TEST_ASSERT_TRUE(cairn_wide_is_zero(cairn_body_mass(NULL, body)));
    TEST_ASSERT_TRUE(cairn_wide_is_zero(cairn_body_inertia(NULL, body)));
    TEST_ASSERT_NULL(cairn_body_shape(NULL, body));
    TEST_ASSERT_EQUAL_INT(0, cairn_body_get_type(NULL, body));
    TEST_ASSERT_NULL(cairn_body_user(NULL, body));
    TEST_ASSERT_FALSE(cairn_body_is_awake(NULL, body));
    TEST_ASSERT_FALSE(cairn_body_is_sensor(NULL, body));
}

void test_a_body_is_what_its_definition_says(void)
{
    int mine;
    yard_def def = def_at(&plank, CAIRN_F(-3), CAIRN_F(4));
    def.angle = CAIRN_DEGREES(30);
    def.velocity = at(CAIRN_F(1), CAIRN_F(-2));
    def.angular_velocity = CAIRN_F(-1.5);
    def.type = CAIRN_KINEMATIC;
    def.sensor = true;
    def.user = &mine;
    cairn_body_id id = make(&def);
    ASSERT_NEAR_VEC2(0, -3, 4, cairn_body_position(world, id));
    TEST_ASSERT_TRUE(cairn_body_angle(world, id) == def.angle);
    ASSERT_NEAR_VEC2(LSB, 1, -2, cairn_body_velocity(world, id));
    ASSERT_NEAR(LSB, -1.5, spin_of(id));
    TEST_ASSERT_EQUAL_INT(CAIRN_KINEMATIC, cairn_body_get_type(world, id));
    TEST_ASSERT_TRUE(cairn_body_is_sensor(world, id));
    TEST_ASSERT_TRUE(cairn_body_is_awake(world, id));
    TEST_ASSERT_EQUAL_PTR(&mine, cairn_body_user(world, id));
    TEST_ASSERT_EQUAL_PTR(&plank, cairn_body_shape(world, id));
    TEST_ASSERT_FALSE(cairn_body_is_sensor(world, body));
    TEST_ASSERT_FALSE(cairn_body_is_awake(world, floor_id));
}

void test_mass_and_inertia_follow_from_shape_and_density(void)
{
    yard_def def = def_at(&plank, 0, 0);
    def.density = cairn_wide_from_int(6);
    cairn_body_id id = make(&def);
    ASSERT_NEAR(LSB, 6, cairn_wide_to_real(cairn_body_mass(world, id)));
    ASSERT_NEAR(LSB, 6 * 17.0 / 48, cairn_wide_to_real(cairn_body_inertia(world, id))); /* m (w^2 + h^2) / 12 */
    id = put(&ball, 0, 0);
    ASSERT_NEAR(LSB, 3.14159265 / 4, cairn_wide_to_real(cairn_body_mass(world, id)));
    ASSERT_NEAR(LSB, 3.14159265 / 32, cairn_wide_to_real(cairn_body_inertia(world, id))); /* m r^2 / 2 */
    id = put(&corner.shape, 0, 0);
    ASSERT_NEAR(2 * LSB, 4.5, cairn_wide_to_real(cairn_body_mass(world, id)));
    ASSERT_NEAR(2 * LSB, 4.5, cairn_wide_to_real(cairn_body_inertia(world, id))); /* m (a^2 + b^2) / 18 */
    TEST_ASSERT_TRUE(cairn_wide_is_zero(cairn_body_mass(world, floor_id)));
    TEST_ASSERT_TRUE(cairn_wide_is_zero(cairn_body_inertia(world, floor_id)));
}

void test_an_off_centre_polygon_has_its_centre_of_mass_at_its_centroid(void)
{
    yard_def def = def_at(&corner.shape, CAIRN_F(5), CAIRN_F(2));
    cairn_body_id id = make(&def);
    ASSERT_NEAR_VEC2(LSB, 5, 2, cairn_body_position(world, id));
    ASSERT_NEAR_VEC2(LSB, 6, 3, cairn_body_center(world, id));
    ASSERT_OK(cairn_body_set_transform(world, id, at(CAIRN_F(5), CAIRN_F(2)), CAIRN_DEGREES(90)));
    ASSERT_NEAR_VEC2(LSB, 5, 2, cairn_body_position(world, id));
    ASSERT_NEAR_VEC2(LSB, 4, 3, cairn_body_center(world, id));
}

/* The centre flies straight on while the origin goes round it. */
void test_an_off_centre_polygon_turns_about_its_centre_of_mass(void)
{
    yard_def def = def_at(&corner.shape, 0, CAIRN_F(10));
    def.velocity = at(CAIRN_F(2), 0);
    def.angular_velocity = CAIRN_F(3.14159265);
    cairn_body_id id = make(&def);
    run(60);
    ASSERT_NEAR_VEC2(3 * LSB, 3, 11, cairn_body_center(world, id));
    ASSERT_NEAR_VEC2(0.001, 4, 12, cairn_body_position(world, id));
}

void test_points_go_from_the_body_to_the_world_and_back(void)
{
    yard_def def = def_at(&corner.shape, CAIRN_F(5), CAIRN_F(2));
    def.angle = CAIRN_DEGREES(90);
    cairn_body_id id = make(&def);
    ASSERT_NEAR_VEC2(2 * LSB, 4, 5, cairn_body_to_world(world, id, at(CAIRN_F(3), CAIRN_F(1))));
    ASSERT_NEAR_VEC2(2 * LSB, 3, 1, cairn_body_to_local(world, id, at(CAIRN_F(4), CAIRN_F(5))));
    ASSERT_OK(cairn_body_set_transform(world, id, at(CAIRN_F(-7), CAIRN_F(1)), CAIRN_DEGREES(-33)));
    cairn_vec2 there = cairn_body_to_world(world, id, at(CAIRN_F(2.5), CAIRN_F(-1.25)));
    ASSERT_NEAR_VEC2(3 * LSB, 2.5, -1.25, cairn_body_to_local(world, id, there));
}

/* v + cross(w, r) */
void test_the_velocity_at_a_point_adds_the_spin(void)
{
    ASSERT_OK(cairn_body_set_velocity(world, body, at(CAIRN_F(1), CAIRN_F(2))));
    ASSERT_OK(cairn_body_set_angular_velocity(world, body, CAIRN_F(3)));
    ASSERT_NEAR_VEC2(4 * LSB, 1 - 3 * 0.5, 2 + 3 * 0.25, cairn_body_velocity_at(world, body, at(CAIRN_F(0.25), CAIRN_F(0.5))));
    ASSERT_NEAR_VEC2(2 * LSB, 1, 2, cairn_body_velocity_at(world, body, at(0, 0)));
}

/* ---- forces and impulses ---- */

void test_a_force_acts_for_one_step(void)
{
    ASSERT_OK(cairn_body_apply_force(world, body, at(CAIRN_F(60), CAIRN_F(-120)))); /* F dt / m = 1, -2 */
    run(1);
    ASSERT_NEAR_VEC2(4 * LSB, 1, -2, cairn_body_velocity(world, body));
    run(5);
    ASSERT_NEAR_VEC2(4 * LSB, 1, -2, cairn_body_velocity(world, body));
}

void test_forces_add_up(void)
{
    ASSERT_OK(cairn_body_apply_force(world, body, at(CAIRN_F(30), 0)));
    ASSERT_OK(cairn_body_apply_force(world, body, at(CAIRN_F(30), CAIRN_F(6))));
    run(1);
    ASSERT_NEAR_VEC2(4 * LSB, 1, 0.1, cairn_body_velocity(world, body));
}

/* v = F t / m; x = F t^2 / 2 m, and symplectic Euler is a sub-step's v h / 2 ahead. */
void test_a_steady_force_gives_a_steady_acceleration(void)
{
    for (int i = 0; i < 60; i++) {
        ASSERT_OK(cairn_body_apply_force(world, body, at(CAIRN_F(2), 0)));
        run(1);
    }
    ASSERT_NEAR(0.0005, 2, vx_of(body));
    ASSERT_NEAR(0.0005, 1 + 2.0 / 240 / 2, x_of(body));
}

void test_a_torque_turns_by_the_moment_of_inertia(void)
{
    for (int i = 0; i < 60; i++) {
        ASSERT_OK(cairn_body_apply_torque(world, body, CAIRN_F(0.5))); /* T t / I = 3 */
        run(1);
    }
    ASSERT_NEAR(0.001, 3, spin_of(body));
    ASSERT_NEAR(0.002, 1.5 + 3.0 / 240 / 2, turned(body));
    ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_position(world, body));
}

void test_a_force_at_a_point_is_a_force_and_a_torque(void)
{
    /* r x F = 0.5 * 60 = 30: w = 30 / 60 / (1/6) = 3 */
    ASSERT_OK(cairn_body_apply_force_at(world, body, at(0, CAIRN_F(60)), at(CAIRN_F(0.5), CAIRN_F(0.3))));
    run(1);
    ASSERT_NEAR_VEC2(4 * LSB, 0, 1, cairn_body_velocity(world, body));
    ASSERT_NEAR(8 * LSB, 3, spin_of(body));
}

void test_an_impulse_acts_at_once(void)
{
    ASSERT_OK(cairn_body_apply_impulse(world, body, at(CAIRN_F(3), CAIRN_F(-4))));
    ASSERT_NEAR_VEC2(2 * LSB, 3, -4, cairn_body_velocity(world, body));
    ASSERT_NEAR(0, 0, spin_of(body));
}

void test_an_impulse_at_a_point_also_spins(void)
{
    /* r x J = 0.5 * 1 - 0.5 * 2: w = -0.5 * 6 */
    ASSERT_OK(cairn_body_apply_impulse_at(world, body, at(CAIRN_F(2), CAIRN_F(1)), at(CAIRN_F(0.5), CAIRN_F(0.5))));
    ASSERT_NEAR_VEC2(2 * LSB, 2, 1, cairn_body_velocity(world, body));
    ASSERT_NEAR(4 * LSB, -3, spin_of(body));
}

void test_an_angular_impulse_spins_and_does_not_shift(void)
{
    ASSERT_OK(cairn_body_apply_angular_impulse(world, body, CAIRN_F(0.25)));
    ASSERT_NEAR(4 * LSB, 1.5, spin_of(body));
    run(60);
    ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_position(world, body));
    ASSERT_NEAR(0.0005, 1.5, turned(body));
}

/* The levers of an off-centre polygon are taken from its centre of mass. */
void test_an_impulse_through_the_centre_of_mass_does_not_spin(void)
{
    cairn_body_id id = put(&corner.shape, CAIRN_F(5), CAIRN_F(5));
    ASSERT_OK(cairn_body_apply_impulse_at(world, id, at(CAIRN_F(9), 0), at(CAIRN_F(2), CAIRN_F(6))));
    ASSERT_NEAR(2 * LSB, 0, spin_of(id));
    ASSERT_NEAR(2 * LSB, 2, vx_of(id));
}

void test_apply_force_refuses_null_stale_and_bodies_that_are_not_dynamic(void)
{
    ASSERT_REFUSES_NULL_AND_STALE(cairn_body_apply_force, at(1, 1));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_apply_force(world, floor_id, at(1, 1)));
}

void test_apply_force_at_refuses_null_stale_and_bodies_that_are_not_dynamic(void)
{
    ASSERT_REFUSES_NULL_AND_STALE(cairn_body_apply_force_at, at(1, 1), at(0, 0));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_apply_force_at(world, floor_id, at(1, 1), at(0, 0)));
}

void test_apply_torque_refuses_null_stale_and_bodies_that_are_not_dynamic(void)
{
    ASSERT_REFUSES_NULL_AND_STALE(cairn_body_apply_torque, 1);
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_apply_torque(world, floor_id, 1));
}

void test_apply_impulse_refuses_null_stale_and_bodies_that_are_not_dynamic(void)
{
    ASSERT_REFUSES_NULL_AND_STALE(cairn_body_apply_impulse, at(1, 1));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_apply_impulse(world, floor_id, at(1, 1)));
}

void test_apply_impulse_at_refuses_null_stale_and_bodies_that_are_not_dynamic(void)
{
    ASSERT_REFUSES_NULL_AND_STALE(cairn_body_apply_impulse_at, at(1, 1), at(0, 0));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_apply_impulse_at(world, floor_id, at(1, 1), at(0, 0)));
}

void test_apply_angular_impulse_refuses_null_stale_and_bodies_that_are_not_dynamic(void)
{
    ASSERT_REFUSES_NULL_AND_STALE(cairn_body_apply_angular_impulse, 1);
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_apply_angular_impulse(world, floor_id, 1));
}

/* ---- gravity and damping of a body ---- */

void test_gravity_scale_scales_the_fall(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    static const cairn_real scales[] = { 0, CAIRN_F(-1), CAIRN_F(0.5), CAIRN_F(16) };
    cairn_body_id ids[4];
    for (int i = 0; i < 4; i++) {
        yard_def def = def_at(&marble, CAIRN_F(5) * (i + 1), 0);
        def.gravity_scale = scales[i];
        ids[i] = make(&def);
    }
    ASSERT_OK(set_gravity_scale(body, CAIRN_F(2)));
    run(30);
    ASSERT_NEAR(LSB, 0, y_of(ids[0]));
    ASSERT_NEAR(4 * LSB, 1.25, y_of(ids[1]));
    ASSERT_NEAR(4 * LSB, -0.625, y_of(ids[2]));
    ASSERT_NEAR(8 * LSB, -20, y_of(ids[3]));
    ASSERT_NEAR(4 * LSB, -2.5, y_of(body));
    TEST_ASSERT_EQUAL_UINT32(0, stats()->saturations);
}

void test_a_model_with_a_gravity_scale_beyond_16_is_refused(void)
{
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, set_gravity_scale(body, CAIRN_F(16.01)));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, set_gravity_scale(body, CAIRN_F(-16.01)));
    ASSERT_OK(set_gravity_scale(body, CAIRN_F(16)));
}

/* Implicit: a factor of 1 / (1 + c dt) a step; after one second (1 + c / 60)^-60. */
void test_damping_takes_its_share_of_the_velocity(void)
{
    ASSERT_OK(set_damping(body, CAIRN_F(1), CAIRN_F(2)));
    ASSERT_OK(cairn_body_set_velocity(world, body, at(CAIRN_F(10), CAIRN_F(-4))));
    ASSERT_OK(cairn_body_set_angular_velocity(world, body, CAIRN_F(5)));
    run(60);
    ASSERT_NEAR_VEC2(0.0005, 3.709244, -1.483698, cairn_body_velocity(world, body));
    ASSERT_NEAR(0.0005, 0.699049, spin_of(body));
}

void test_the_strongest_damping_stops_without_overshoot(void)
{
    ASSERT_OK(set_damping(body, CAIRN_F(1000), CAIRN_F(1000)));
    ASSERT_OK(cairn_body_set_velocity(world, body, at(CAIRN_F(10), 0)));
    ASSERT_OK(cairn_body_set_angular_velocity(world, body, CAIRN_F(10)));
    run(1);
    ASSERT_NEAR(0.001, 10 / (1 + 1000.0 / 60), vx_of(body));
    run(20);
    ASSERT_NEAR(LSB, 0, vx_of(body));
    ASSERT_NEAR(LSB, 0, spin_of(body));
}

/* m g = c m v: falling ends at g / c, but for the step in which the damping is taken. */
void test_damping_gives_falling_a_final_speed(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    ASSERT_OK(set_damping(body, CAIRN_F(5), 0));
    run(300);
    ASSERT_NEAR(10.0 / 60, -2 - 10.0 / 120, vy_of(body));
}

void test_a_model_with_a_damping_outside_of_0_to_1000_is_refused(void)
{
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, set_damping(body, CAIRN_F(-0.01), 0));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, set_damping(body, CAIRN_F(1000.01), 0));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, set_damping(body, 0, CAIRN_F(-0.01)));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, set_damping(body, 0, CAIRN_F(1000.01)));
}

/* ---- kinds of bodies ---- */

void test_a_static_body_never_moves(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    yard_def def = def_at(&ground, 0, CAIRN_F(-1));
    def.type = CAIRN_STATIC;
    def.velocity = at(CAIRN_F(3), CAIRN_F(3)); /* says nothing of a static body */
    cairn_body_id id = make(&def);
    run(60);
    ASSERT_NEAR_VEC2(0, 0, -1, cairn_body_position(world, id));
    ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_velocity(world, id));
    ASSERT_NEAR(0.001, 0, y_of(body)); /* the box lies on it */
}

void test_a_kinematic_body_moves_by_its_own_velocity_only(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    yard_def def = def_at(&plank, CAIRN_F(-10), CAIRN_F(10));
    def.type = CAIRN_KINEMATIC;
    def.velocity = at(CAIRN_F(2), CAIRN_F(-1));
    def.angular_velocity = CAIRN_F(1);
    cairn_body_id id = make(&def);
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_apply_force(world, id, at(CAIRN_F(100), 0)));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_apply_impulse(world, id, at(CAIRN_F(100), 0)));
    run(60);
    ASSERT_NEAR_VEC2(4 * LSB, -8, 9, cairn_body_position(world, id));
    ASSERT_NEAR(0.0005, 1, turned(id));
}

void test_a_kinematic_body_pushes_what_it_meets_and_is_not_slowed(void)
{
    yard_def def = def_at(&box, CAIRN_F(-2), 0);
    def.type = CAIRN_KINEMATIC;
    def.velocity = at(CAIRN_F(3), 0);
    cairn_body_id pusher = make(&def), pushed = put(&ball, CAIRN_F(-0.9), 0);
    ASSERT_OK(cairn_body_destroy(world, body));
    run(60);
    ASSERT_NEAR_VEC2(4 * LSB, 1, 0, cairn_body_position(world, pusher));
    ASSERT_NEAR_VEC2(0.001, 2, 0, cairn_body_position(world, pushed));
    ASSERT_NEAR_VEC2(0.001, 3, 0, cairn_body_velocity(world, pushed));
}

/* A platform carries the box that stands on it: friction brings it to the platform's speed. */
void test_a_moving_platform_carries_what_stands_on_it(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    yard_def def = def_at(&plank, 0, CAIRN_F(-0.75));
    def.type = CAIRN_KINEMATIC;
    def.velocity = at(CAIRN_F(1), 0);
    cairn_body_id platform = make(&def);
    run(120);
    ASSERT_NEAR(0.002, 1, vx_of(body));
    /* it slid back while mu_k g brought it up to speed: v^2 / (2 mu_k g) = 0.125 m */
    ASSERT_NEAR(0.125 * 0.05, -0.125, x_of(body) - x_of(platform));
}

void test_bodies_that_cannot_be_pushed_do_not_meet(void)
{
    cairn_contact contact;
    yard_def def = def_at(&box, 0, CAIRN_F(-100));
    def.type = CAIRN_KINEMATIC;
    cairn_body_id first = make(&def), second = make(&def);
    run(2);
    TEST_ASSERT_FALSE(contact_of(first, second, &contact));
    TEST_ASSERT_FALSE(contact_of(first, floor_id, &contact));
}

void test_a_body_of_fixed_rotation_does_not_turn(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    put_static(&ground, 0, CAIRN_F(-3));
    yard_def def = def_at(&box, 0, CAIRN_F(-1.5));
    def.angle = CAIRN_DEGREES(30);
    def.fixed_rotation = true;
    def.angular_velocity = CAIRN_F(5);
    ASSERT_OK(cairn_body_destroy(world, body));
    cairn_body_id id = make(&def);
    ASSERT_OK(cairn_body_apply_impulse_at(world, id, at(CAIRN_F(0.1), 0), at(0, CAIRN_F(-1))));
    ASSERT_OK(cairn_body_apply_torque(world, id, CAIRN_F(10)));
    run(120);
    TEST_ASSERT_TRUE(cairn_body_angle(world, id) == CAIRN_DEGREES(30));
    ASSERT_NEAR(0, 0, spin_of(id));
    /* it stands on its corner: (cos 30 + sin 30) / 2 above the floor */
    ASSERT_NEAR(0.001, -2.5 + 0.6830127, y_of(id));
}

void test_a_body_of_fixed_position_turns_about_it_and_does_not_leave_it(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    yard_def def = def_at(&flipper, CAIRN_F(5), CAIRN_F(5));
    def.fixed_position = true;
    def.velocity = at(CAIRN_F(3), CAIRN_F(3)); /* says nothing of it */
    cairn_body_id id = make(&def);
    ASSERT_OK(cairn_body_set_velocity(world, id, at(CAIRN_F(3), CAIRN_F(3))));
    ASSERT_OK(cairn_body_apply_impulse(world, id, at(CAIRN_F(3), CAIRN_F(3))));
    ASSERT_OK(cairn_body_apply_force(world, id, at(CAIRN_F(3), CAIRN_F(3))));
    ASSERT_OK(cairn_body_apply_angular_impulse(world, id, CAIRN_F(0.4 * 4.04 / 12)));
    run(60);
    ASSERT_NEAR_VEC2(0, 5, 5, cairn_body_position(world, id));
    ASSERT_NEAR(0.0005, 1, turned(id));
    ASSERT_NEAR(8 * LSB, 1, spin_of(id));
}

/*
 * A ball lands on a flipper 0.8 m from its pivot without rebound. Angular momentum about the pivot is kept:
 * m u r = (I + m r^2) w, and the ball goes on with the flipper.
 */
void test_a_ball_that_hits_a_flipper_turns_it_by_the_law_of_angular_momentum(void)
{
    yard_def def = def_at(&flipper, CAIRN_F(5), CAIRN_F(5));
    def.fixed_position = true;
    def.material = &smooth;
    cairn_body_id pivot = make(&def);
    def = def_at(&marble, CAIRN_F(5.8), CAIRN_F(5.31));
    def.material = &smooth;
    def.velocity = at(0, CAIRN_F(-2));
    cairn_body_id marble_id = make(&def);
    run(4); /* it has 0.11 m to go: 3.3 steps */
    /* m = 0.01 pi, I = 0.4 * 4.04 / 12: w = -0.324770, v = -0.259816 */
    ASSERT_NEAR(0.001 * 0.324770, -0.324770, spin_of(pivot));
    ASSERT_NEAR(0.001 * 0.259816, -0.259816, vy_of(marble_id));
    ASSERT_NEAR_VEC2(0, 5, 5, cairn_body_position(world, pivot));
}

void test_a_fixed_body_of_both_kinds_is_as_good_as_static(void)
{
    yard_def def = def_at(&box, CAIRN_F(5), 0);
    def.fixed_position = def.fixed_rotation = true;
    cairn_body_id post = make(&def), thrown = put_moving(&ball, CAIRN_F(1), 0, CAIRN_F(10), 0);
    run(60);
    ASSERT_NEAR_VEC2(0, 5, 0, cairn_body_position(world, post));
    ASSERT_NEAR(0.001, 4, x_of(thrown));
    ASSERT_NEAR(0.001, 0, vx_of(thrown));
}

/* ---- what a game may change ---- */

void test_set_transform_places_exactly_and_keeps_the_velocity(void)
{
    ASSERT_OK(cairn_body_set_velocity(world, body, at(CAIRN_F(1), CAIRN_F(2))));
    ASSERT_OK(cairn_body_set_transform(world, body, at(CAIRN_F(-7.25), CAIRN_F(12.5)), CAIRN_DEGREES(-120)));
    ASSERT_NEAR_VEC2(0, -7.25, 12.5, cairn_body_position(world, body));
    TEST_ASSERT_TRUE(cairn_body_angle(world, body) == CAIRN_DEGREES(-120));
    ASSERT_NEAR_VEC2(LSB, 1, 2, cairn_body_velocity(world, body));
}

void test_set_transform_ends_contacts_and_moves_static_bodies_too(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    cairn_body_id table = put_static(&plank, 0, CAIRN_F(-0.75));
    run(10);
    TEST_ASSERT_TRUE(are_touching(body, table));
    ASSERT_OK(cairn_body_set_transform(world, table, at(CAIRN_F(10), CAIRN_F(10)), 0));
    TEST_ASSERT_FALSE(are_touching(body, table));
    cairn_real height = y_of(body);
    run(30);
    ASSERT_NEAR(0.01, -1.25, y_of(body) - height);
}

void test_set_transform_refuses_null_stale_and_places_beyond_the_edge(void)
{
    ASSERT_REFUSES_NULL_AND_STALE(cairn_body_set_transform, at(0, 0), 0);
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_body_set_transform(world, body, at(CAIRN_F(16000.1), 0), 0));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_body_set_transform(world, body, at(CAIRN_F(-16000.1), 0), 0));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_body_set_transform(world, body, at(0, CAIRN_F(16000.1)), 0));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_body_set_transform(world, body, at(0, CAIRN_F(-16000.1)), 0));
    ASSERT_OK(cairn_body_set_transform(world, body, at(CAIRN_F(16000), CAIRN_F(-16000)), 0));
}

void test_set_velocity_refuses_null_stale_and_static(void)
{
    ASSERT_REFUSES_NULL_AND_STALE(cairn_body_set_velocity, at(1, 1));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_set_velocity(world, floor_id, at(1, 1)));
}

void test_set_angular_velocity_refuses_null_stale_and_static(void)
{
    ASSERT_REFUSES_NULL_AND_STALE(cairn_body_set_angular_velocity, 1);
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_set_angular_velocity(world, floor_id, 1));
}

void test_set_model_refuses_null_and_stale(void)
{
    static const cairn_body_model crate = CAIRN_BODY_MODEL(CAIRN_DYNAMIC, &box, &cairn_material_default);
    ASSERT_REFUSES_NULL_AND_STALE(cairn_body_set_model, &crate);
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_body_set_model(world, body, NULL));
}

void test_set_model_refuses_another_shape_and_another_type(void)
{
    static const cairn_body_model round = CAIRN_BODY_MODEL(CAIRN_DYNAMIC, &ball, &cairn_material_default);
    static const cairn_body_model still = CAIRN_BODY_MODEL(CAIRN_STATIC, &box, &cairn_material_default);
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_set_model(world, body, &round));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_set_model(world, body, &still));
}

void test_set_model_refuses_a_mass_that_creation_refuses(void)
{
    cairn_body_model light = cairn_body_model_default(&box);
    light.density = cairn_wide_from_int(0);
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_body_set_model(world, body, &light));
}

void test_a_body_tells_its_model_and_what_is_in_it(void)
{
    static const int mine = 1;
    cairn_body_model model = cairn_body_model_default(&box);
    model.user = &mine;
    model.sensor = true;
    ASSERT_OK(cairn_body_set_model(world, body, &model));
    TEST_ASSERT_EQUAL_PTR(&model, cairn_body_get_model(world, body));
    TEST_ASSERT_EQUAL_PTR(&mine, cairn_body_user(world, body));
    TEST_ASSERT_EQUAL_PTR(&box, cairn_body_shape(world, body));
    TEST_ASSERT_TRUE(cairn_body_is_sensor(world, body));
    TEST_ASSERT_NULL(cairn_body_get_model(world, gone));
}

void test_the_mass_follows_the_density_of_a_new_model(void)
{
    cairn_body_model heavy = cairn_body_model_default(&box);
    heavy.density = cairn_wide_from_int(6);
    ASSERT_OK(cairn_body_set_model(world, body, &heavy));
    ASSERT_NEAR(LSB, 6, cairn_wide_to_real(cairn_body_mass(world, body)));
    ASSERT_NEAR(LSB, 1, cairn_wide_to_real(cairn_body_inertia(world, body)));
    ASSERT_OK(cairn_body_apply_impulse(world, body, at(CAIRN_F(6), 0)));
    ASSERT_NEAR(LSB, 1, vx_of(body));
}

void test_a_density_of_less_than_one_is_kept_in_a_constant_model(void)
{
    static const cairn_body_model cork = { &box, &smooth, CAIRN_DYNAMIC, CAIRN_DENSITY(0.24), 0, 0, 0, 1, 1, false, false, false, NULL };
    ASSERT_OK(cairn_body_set_model(world, body, &cork));
    ASSERT_NEAR(LSB, 0.24, cairn_wide_to_real(cairn_body_mass(world, body)));
}

CAIRN_BLOCKS(blocks);

/* The load on a body that grows heavy is felt at once: both still lie there. */
void test_a_body_that_grows_heavy_in_a_stack_stays_on_it(void)
{
    cairn_body_model heavy = cairn_body_model_default(&box);
    heavy.density = cairn_wide_from_int(100);
    ASSERT_OK(cairn_blocks_enable(world, &blocks));
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    cairn_body_id top = put(&box, 0, CAIRN_F(1)), table = put_static(&plank, 0, CAIRN_F(-0.75));
    run(60);
    TEST_ASSERT_TRUE(are_touching(top, body));
    ASSERT_OK(cairn_body_set_model(world, top, &heavy));
    TEST_ASSERT_FALSE(are_touching(top, body));
    run(60);
    TEST_ASSERT_TRUE(are_touching(top, body) && are_touching(body, table));
    ASSERT_NEAR(0.003, 1, y_of(top));
}

void test_a_model_that_fixes_a_body_stops_it(void)
{
    cairn_body_model nailed = cairn_body_model_default(&box);
    nailed.fixed_position = nailed.fixed_rotation = true;
    ASSERT_OK(cairn_body_set_velocity(world, body, at(CAIRN_F(3), CAIRN_F(2))));
    ASSERT_OK(cairn_body_set_angular_velocity(world, body, CAIRN_F(2)));
    ASSERT_OK(cairn_body_set_model(world, body, &nailed));
    run(30);
    ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_position(world, body));
    ASSERT_NEAR(0, 0, turned(body));
    ASSERT_OK(cairn_body_set_model(world, body, keep_model(cairn_body_model_default(&box))));
    ASSERT_OK(cairn_body_apply_impulse(world, body, at(CAIRN_F(3), 0)));
    run(60);
    ASSERT_NEAR(0.001, 3, x_of(body));
}

void test_wake_refuses_null_and_stale(void)
{
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_body_wake(NULL, body));
    ASSERT_REFUSED(CAIRN_ERROR_STALE, cairn_body_wake(world, gone));
    ASSERT_OK(cairn_body_wake(world, body));
}

/* ---- layers ---- */

/* Do two boxes in one place meet? */
static bool do_meet(uint16_t layer_a, uint16_t mask_a, uint16_t layer_b, uint16_t mask_b)
{
    cairn_contact contact;
    yard_def def = def_at(&box, CAIRN_F(20), 0);
    def.layer = layer_a;
    def.mask = mask_a;
    cairn_body_id a = make(&def);
    def.layer = layer_b;
    def.mask = mask_b;
    cairn_body_id b = make(&def);
    run(1);
    bool met = contact_of(a, b, &contact);
    ASSERT_OK(cairn_body_destroy(world, a));
    ASSERT_OK(cairn_body_destroy(world, b));
    return met;
}

void test_bodies_meet_if_each_is_on_a_layer_that_the_other_meets(void)
{
    TEST_ASSERT_TRUE(do_meet(1, 0xFFFF, 1, 0xFFFF));
    TEST_ASSERT_TRUE(do_meet(0x8000, 0x0006, 0x0004, 0x8000));
    TEST_ASSERT_FALSE(do_meet(1, 2, 1, 0xFFFF));
    TEST_ASSERT_FALSE(do_meet(1, 0xFFFF, 1, 2));
    TEST_ASSERT_FALSE(do_meet(0, 0xFFFF, 1, 0xFFFF));
    TEST_ASSERT_FALSE(do_meet(1, 0xFFFF, 1, 0));
}

void test_changed_layers_take_effect_in_the_next_step(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    cairn_body_id table = put_static(&plank, 0, CAIRN_F(-0.75));
    run(30);
    ASSERT_NEAR(0.001, 0, y_of(body));
    ASSERT_OK(set_layers(body, 2, 2));
    run(30);
    ASSERT_NEAR(0.01, -1.25, y_of(body)); /* it fell through */
    TEST_ASSERT_FALSE(are_touching(body, table));
    ASSERT_OK(set_layers(body, 1, 1));
    run(1);
    TEST_ASSERT_TRUE(are_touching(body, table)); /* still in it */
}
