/* Materials: what is refused, how a pair mixes, and Coulomb's law against closed forms. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(60), CAIRN_F(1));
static const cairn_material smooth = CAIRN_MATERIAL(0, 0);
static const cairn_material rough = CAIRN_MATERIAL(0.9, 0.8);
static const cairn_material slick = CAIRN_MATERIAL(0.4, 0.2);

void setUp(void) { open_yard(CAIRN_F(-10)); }
void tearDown(void) {}

/* ---- what is refused ---- */

static void assert_material_refused(cairn_material material)
{
    cairn_body_id id = put(&ball, 0, CAIRN_F(50));
    yard_def def = def_at(&box, 0, 0);
    def.material = &material;
    ASSERT_REFUSED_ID(CAIRN_ERROR_RANGE, make_in(world, &def));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, set_material(id, &material));
    ASSERT_OK(cairn_body_destroy(world, id));
}

void test_frictions_outside_of_0_to_64_are_refused(void)
{
    static const cairn_material above = CAIRN_MATERIAL(64.01, 1), below = CAIRN_MATERIAL(-0.1, -0.2), negative = CAIRN_MATERIAL(0.5, -0.1);
    static const cairn_material most = CAIRN_MATERIAL(64, 64);
    assert_material_refused(above);
    assert_material_refused(below);
    assert_material_refused(negative);
    ASSERT_OK(set_material(put(&ball, 0, 0), &most));
}

void test_kinetic_friction_above_static_is_refused(void)
{
    static const cairn_material backwards = CAIRN_MATERIAL(0.4, 0.5);
    assert_material_refused(backwards);
}

void test_restitutions_outside_of_0_to_1_are_refused(void)
{
    static const cairn_material above = CAIRN_MATERIAL_BOUNCING(0.5, 0.4, 1.001, 0), below = CAIRN_MATERIAL_BOUNCING(0.5, 0.4, -0.1, 0);
    assert_material_refused(above);
    assert_material_refused(below);
}

void test_a_negative_threshold_is_refused(void)
{
    static const cairn_material negative = CAIRN_MATERIAL_BOUNCING(0.5, 0.4, 0.5, -0.1);
    assert_material_refused(negative);
}

void test_restitution_without_the_stage_that_makes_it_is_refused(void)
{
    cairn_material unlinked = cairn_material_jelly;
    unlinked.bounce = NULL;
    assert_material_refused(unlinked);
}

void test_a_model_without_a_material_is_refused(void)
{
    cairn_body_id id = put(&ball, 0, 0);
    ASSERT_REFUSED(CAIRN_ERROR_NULL, set_material(id, NULL));
}

/* ---- presets ---- */

static void assert_preset(const cairn_material *preset, cairn_factor fixed, cairn_factor kinetic, cairn_factor restitution)
{
    TEST_ASSERT_TRUE(preset->static_friction == fixed);
    TEST_ASSERT_TRUE(preset->kinetic_friction == kinetic);
    TEST_ASSERT_TRUE(preset->restitution == restitution);
    ASSERT_OK(set_material(put(&ball, 0, CAIRN_F(50)), preset));
}

void test_the_presets_are_those_of_the_header(void)
{
    assert_preset(&cairn_material_default, CAIRN_FACTOR(0.5), CAIRN_FACTOR(0.4), 0);
    assert_preset(&cairn_material_ice, CAIRN_FACTOR(0.05), CAIRN_FACTOR(0.02), 0);
    assert_preset(&cairn_material_metal, CAIRN_FACTOR(0.6), CAIRN_FACTOR(0.4), CAIRN_FACTOR(0.1));
    assert_preset(&cairn_material_jelly, CAIRN_FACTOR(0.9), CAIRN_FACTOR(0.7), CAIRN_FACTOR(0.6));
}

/* ---- sliding ---- */

static cairn_body_id slide(const cairn_material *of_box, const cairn_material *of_floor, cairn_real speed)
{
    yard_def def = def_at(&ground, 0, CAIRN_F(-0.5));
    def.type = CAIRN_STATIC;
    def.material = of_floor;
    make(&def);
    def = def_at(&box, CAIRN_F(-10), CAIRN_F(0.5));
    def.material = of_box;
    def.velocity = at(speed, 0);
    return make(&def);
}

/*
 * v^2 / (2 mu g) to rest; symplectic Euler takes half a sub-step's way v h / 2 less. The bound is 2 mm in a metre, the
 * tilt with which a pushed box comes to lie on its front edge.
 */
void test_a_sliding_box_stops_after_its_kinetic_energy_is_rubbed_off(void)
{
    cairn_body_id id = slide(&cairn_material_default, &cairn_material_default, CAIRN_F(3));
    run(120);
    ASSERT_NEAR(0.002, -10 + 9 / (2 * 0.4 * 10) - 3.0 / 480, x_of(id));
    run(480); /* its tilt goes back while its load settles, see hold.c */
    ASSERT_NEAR(0.002, -10 + 9 / (2 * 0.4 * 10) - 3.0 / 480, x_of(id));
    ASSERT_NEAR(LSB, 0, vx_of(id));
}

/* sqrt(0.8 * 0.2) = 0.4 */
void test_a_pair_takes_the_geometric_mean_of_its_frictions(void)
{
    cairn_body_id id = slide(&rough, &slick, CAIRN_F(3));
    run(120);
    ASSERT_NEAR(0.002, -10 + 9 / (2 * 0.4 * 10) - 3.0 / 480, x_of(id));
}

void test_deceleration_is_kinetic_friction_times_gravity(void)
{
    cairn_body_id id = slide(&cairn_material_ice, &cairn_material_ice, CAIRN_F(4));
    run(180);
    ASSERT_NEAR(0.005, 4 - 0.02 * 10 * 3, vx_of(id)); /* ice: 0.02 */
}

void test_without_friction_on_one_side_nothing_is_rubbed_off(void)
{
    cairn_body_id id = slide(&smooth, &rough, CAIRN_F(2));
    run(180);
    ASSERT_NEAR(2 * LSB, 2, vx_of(id));
    ASSERT_NEAR(0.0005, -4, x_of(id));
}

void test_a_new_material_acts_on_contacts_that_exist(void)
{
    cairn_body_id id = slide(&smooth, &cairn_material_default, CAIRN_F(3));
    run(60);
    ASSERT_NEAR(2 * LSB, 3, vx_of(id));
    ASSERT_OK(set_material(id, &cairn_material_default));
    run(15);
    ASSERT_NEAR(0.02, 3 - 0.4 * 10 / 4, vx_of(id));
}

/* ---- slopes: a box on a plane that is tilted by so many degrees, its base on the surface ---- */

static cairn_body_id put_on_slope(cairn_angle tilt, const cairn_material *material)
{
    cairn_unit c, s;
    cairn_angle_rotation(tilt, &c, &s);
    yard_def def = def_at(&ground, 0, 0);
    def.type = CAIRN_STATIC;
    def.angle = tilt;
    def.material = material;
    make(&def);
    def = def_at(&box, -cairn_real_from_unit(s), cairn_real_from_unit(c)); /* 1 m along the normal */
    def.angle = tilt;
    def.material = material;
    return make(&def);
}

/* The friction angle of mu = 0.5 is 26.57 degrees. What moves is the settling of the contact, once, and that is taken back. */
void test_a_box_on_a_slope_below_the_friction_angle_stays(void)
{
    cairn_body_id id = put_on_slope(CAIRN_DEGREES(26), &cairn_material_default);
    cairn_vec2 start = cairn_body_position(world, id);
    run(30);
    cairn_vec2 before = cairn_body_position(world, id);
    ASSERT_NEAR(0.002, 0, cairn_real_length(before.x - start.x, before.y - start.y));
    run(570);
    before = cairn_body_position(world, id);
    ASSERT_NEAR(0.0001, 0, cairn_real_length(before.x - start.x, before.y - start.y));
    run(300);
    cairn_vec2 after = cairn_body_position(world, id);
    ASSERT_NEAR(LSB, 0, cairn_real_length(after.x - before.x, after.y - before.y));
}

void test_a_ball_that_cannot_turn_stays_on_the_same_slope(void)
{
    yard_def def = def_at(&ground, 0, 0);
    def.type = CAIRN_STATIC;
    def.angle = CAIRN_DEGREES(26);
    make(&def);
    def = def_at(&ball, CAIRN_F(-0.438371), CAIRN_F(0.898794));
    def.fixed_rotation = true;
    cairn_body_id id = make(&def);
    run(300);
    ASSERT_NEAR_VEC2(0.002, -0.438371, 0.898794, cairn_body_position(world, id));
}

static cairn_real speed_of(cairn_body_id id)
{
    cairn_vec2 v = cairn_body_velocity(world, id);
    return cairn_real_length(v.x, v.y);
}

/* g (sin 28 - 0.4 cos 28) = 1.162926 m/s^2 down the slope, once static friction has let go */
void test_a_box_on_a_slope_above_the_friction_angle_slides_as_newton_says(void)
{
    cairn_body_id id = put_on_slope(CAIRN_DEGREES(28), &cairn_material_default);
    cairn_real height = y_of(id);
    run(30);
    cairn_real before = speed_of(id);
    run(60);
    ASSERT_NEAR(0.002 * 1.162926, 1.162926, speed_of(id) - before);
    TEST_ASSERT_TRUE(y_of(id) < height);
}

void test_just_above_the_friction_angle_a_box_does_not_stay(void)
{
    cairn_body_id id = put_on_slope(CAIRN_DEGREES(27), &cairn_material_default);
    run(120);
    TEST_ASSERT_TRUE(speed_of(id) > CAIRN_F(1));
}

/* g (sin 5 - 0.02 cos 5) */
void test_on_ice_a_slope_of_five_degrees_does_not_hold(void)
{
    cairn_body_id id = put_on_slope(CAIRN_DEGREES(5), &cairn_material_ice);
    run(30);
    cairn_real before = speed_of(id);
    run(60);
    ASSERT_NEAR(0.002 * 0.672319, 0.672319, speed_of(id) - before);
}

/* ---- restitution of a pair (how exactly it bounces is test_bounce.c's) ---- */

/* The height a ball reaches again that fell from 1 m above the floor. */
static cairn_real rebound(const cairn_material *of_ball, const cairn_material *of_floor)
{
    open_yard(CAIRN_F(-10));
    yard_def def = def_at(&ground, 0, CAIRN_F(-0.5));
    def.type = CAIRN_STATIC;
    def.material = of_floor;
    make(&def);
    def = def_at(&ball, 0, CAIRN_F(1.5));
    def.material = of_ball;
    cairn_body_id id = make(&def);
    cairn_real top = 0;
    for (int i = 0; i < 90; i++) {
        run(1);
        if (vy_of(id) >= 0 || top > 0) {
            top = y_of(id) - CAIRN_F(0.5) > top ? y_of(id) - CAIRN_F(0.5) : top;
        }
    }
    return top;
}

static const cairn_material half_low = CAIRN_MATERIAL_BOUNCING(0.5, 0.4, 0.5, 1);
static const cairn_material half_high = CAIRN_MATERIAL_BOUNCING(0.5, 0.4, 0.5, 20);
static const cairn_material little_high = CAIRN_MATERIAL_BOUNCING(0.5, 0.4, 0.1, 20);

void test_a_pair_takes_the_larger_restitution(void)
{
    ASSERT_NEAR(0.001, 0.25, rebound(&half_low, &cairn_material_default));
    ASSERT_NEAR(0.001, 0.25, rebound(&cairn_material_default, &half_low));
    ASSERT_NEAR(0.001, 0.25, rebound(&half_low, &cairn_material_metal));
}

/* 1 m gives 4.47 m/s: below a threshold of 20. */
void test_below_the_threshold_nothing_rebounds(void)
{
    ASSERT_NEAR(0.001, 0, rebound(&half_high, &cairn_material_default));
    ASSERT_NEAR(0.001, 0, rebound(&half_high, &little_high));
}

void test_a_pair_takes_the_smaller_threshold_of_its_bouncing_materials(void)
{
    ASSERT_NEAR(0.001, 0.25, rebound(&half_low, &little_high));
    ASSERT_NEAR(0.001, 0.25, rebound(&little_high, &half_low));
    /* the default's threshold of 0 says nothing: it does not bounce */
    ASSERT_NEAR(0.001, 0, rebound(&cairn_material_default, &half_high));
}
