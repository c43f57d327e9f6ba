/* Springs against the closed forms of the oscillator; their ids, ends, limits and refusals. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1)); /* 1 kg */
static const cairn_shape beam = CAIRN_BOX(CAIRN_F(2), CAIRN_F(0.5)); /* 1 kg, 17/48 kg m^2 */
static const cairn_shape peg = CAIRN_CIRCLE(CAIRN_F(0.05));
static cairn_polygon corner; /* a triangle whose centroid is at (1, 1) */

CAIRN_SPRINGS(coils, 8);

static cairn_body_id wall, body;
static cairn_spring_def def;

/* In empty space: a static peg at the origin, a box 2 m to the right, and the plan of a spring between their centres. */
void setUp(void)
{
    static const cairn_vec2 points[] = { { CAIRN_F(0), CAIRN_F(0) }, { CAIRN_F(3), CAIRN_F(0) }, { CAIRN_F(0), CAIRN_F(3) } };
    open_yard(0);
    memset(coils_springs, 0, sizeof coils_springs);
    ASSERT_OK(cairn_springs_enable(world, &coils));
    ASSERT_OK(cairn_polygon_init(&corner, points, 3));
    wall = put_static(&peg, 0, 0);
    body = put(&box, CAIRN_F(2), 0);
    def = cairn_spring_def_default(wall, body);
    def.stiffness = cairn_wide_from_int(100);
}
void tearDown(void) {}

static cairn_spring_id join(const cairn_spring_def *plan)
{
    cairn_spring_id id = cairn_spring_create(world, plan);
    TEST_ASSERT_FALSE(cairn_spring_id_is_null(id));
    return id;
}

static cairn_real length_of(cairn_spring_id id) { return cairn_spring_length(world, id); }

/* ---- the oscillator; every bound is 0.2 mm ---- */

/* x = 0.5 cos(w t), w = sqrt(k / m) = 10 */
void test_an_undamped_spring_swings_as_a_cosine(void)
{
    def.rest_length = CAIRN_F(1.5);
    join(&def);
    run(60);
    ASSERT_NEAR(0.0002, 1.5 + 0.5 * -0.8390715, x_of(body));
    run(60);
    ASSERT_NEAR(0.0002, 1.5 + 0.5 * 0.4080821, x_of(body));
    ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_position(world, wall));
}

/* A hundred swings later it is still on time. */
void test_an_undamped_spring_keeps_time_and_amplitude(void)
{
    def.rest_length = CAIRN_F(1.5);
    join(&def);
    cairn_real most = 0;
    run(3759 - 120);
    for (int i = 0; i < 120; i++) {
        run(1);
        most = x_of(body) > most ? x_of(body) : most;
    }
    ASSERT_NEAR(0.003, 2, most);
    ASSERT_NEAR(0.01, 1.5 + 0.5 * -0.2452081, x_of(body)); /* cos(626.5): a phase error of 0.02 rad would show */
}

/* zeta = 0.1 */
void test_a_damped_spring_swings_within_its_envelope(void)
{
    def.rest_length = CAIRN_F(1.5);
    def.damping = cairn_wide_from_int(2);
    join(&def);
    run(30);
    ASSERT_NEAR(0.0002, 1.5 + 0.0492753, x_of(body));
    run(30);
    ASSERT_NEAR(0.0002, 1.5 - 0.1684258, x_of(body));
}

void test_a_critically_damped_spring_returns_without_overshoot(void)
{
    def.rest_length = CAIRN_F(1.5);
    def.damping = cairn_wide_from_int(20);
    join(&def);
    run(18);
    ASSERT_NEAR(0.0002, 1.5 + 0.0995741, x_of(body)); /* 0.5 (1 + w t) exp(-w t) at 0.3 s */
    for (int i = 0; i < 120; i++) {
        run(1);
        TEST_ASSERT_TRUE(x_of(body) >= CAIRN_F(1.5) - CAIRN_F(0.0002));
    }
}

void test_an_overdamped_spring_creeps_back(void)
{
    def.rest_length = CAIRN_F(1.5);
    def.damping = cairn_wide_from_int(40);
    join(&def);
    run(30);
    ASSERT_NEAR(0.0002, 1.5 + 0.1410856, x_of(body));
}

void test_a_damper_without_stiffness_stops_without_pulling(void)
{
    def.stiffness = cairn_wide_from_int(0);
    def.damping = cairn_wide_from_int(1);
    join(&def);
    ASSERT_OK(cairn_body_set_velocity(world, body, at(CAIRN_F(1), 0)));
    run(60);
    /* v = exp(-c t / m), of which implicit Euler makes (1 + h)^-240: 0.2 % more */
    ASSERT_NEAR(0.0002, 0.3686445, vx_of(body));
    run(600);
    ASSERT_NEAR(0.003, 3, x_of(body));
}

/* The pair swings about its centre of mass with the reduced mass. */
void test_a_spring_between_two_bodies_swings_with_the_reduced_mass(void)
{
    yard_def other = def_at(&box, CAIRN_F(10), 0);
    other.density = cairn_wide_from_int(3);
    cairn_body_id heavy = make(&other), light = put(&box, CAIRN_F(13), 0);
    def = cairn_spring_def_default(heavy, light);
    def.stiffness = cairn_wide_from_int(75); /* w^2 = 75 / 0.75 = 100 */
    def.rest_length = CAIRN_F(2.5);
    cairn_spring_id id = join(&def);
    run(60);
    ASSERT_NEAR(0.0002, 2.5 + 0.5 * -0.8390715, length_of(id));
    ASSERT_NEAR(0.0002, 43, 3 * x_of(heavy) + x_of(light)); /* the centre of mass stays */
    ASSERT_NEAR(0.0005, 0, 3 * vx_of(heavy) + vx_of(light));
}

/* m g / k = 0.1 m */
void test_a_damped_spring_sags_by_the_weight_over_the_stiffness(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    ASSERT_OK(cairn_body_set_transform(world, body, at(0, CAIRN_F(-2)), 0));
    def.damping = cairn_wide_from_int(10);
    cairn_spring_id id = join(&def);
    run(300);
    ASSERT_NEAR(0.0002, 2.1, length_of(id));
    ASSERT_NEAR(0.0002, -2.1, y_of(body));
}

void test_an_undamped_spring_swings_about_its_sag(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    ASSERT_OK(cairn_body_set_transform(world, body, at(0, CAIRN_F(-2)), 0));
    cairn_spring_id id = join(&def);
    run(60);
    ASSERT_NEAR(0.0005, 2.1 + 0.1 * 0.8390715, length_of(id)); /* 2 + 0.1 (1 - cos 10) */
}

/* Two hang one below the other: a network, solved implicitly. The upper carries both. */
void test_a_chain_of_springs_sags_by_the_weight_that_each_carries(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    ASSERT_OK(cairn_body_set_transform(world, body, at(0, CAIRN_F(-2)), 0));
    cairn_body_id low = put(&box, 0, CAIRN_F(-4));
    def.damping = cairn_wide_from_int(10);
    cairn_spring_id upper = join(&def);
    def.a = body;
    def.b = low;
    cairn_spring_id lower = join(&def);
    run(900);
    ASSERT_NEAR(0.001, 2.2, length_of(upper));
    ASSERT_NEAR(0.001, 2.1, length_of(lower));
}

/* The order in which a chain's springs are made, and which way each points, says nothing to physics. */
void test_a_chain_hangs_alike_however_it_was_put_together(void)
{
    /* spring k joins link k to link k + 1; made in these orders, the odd ones pointing upwards in the second half */
    static const int orders[4][3] = { { 0, 1, 2 }, { 2, 1, 0 }, { 1, 0, 2 }, { 1, 2, 0 } };
    for (int n = 0; n < 8; n++) {
        setUp();
        ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
        ASSERT_OK(cairn_body_set_transform(world, body, at(0, CAIRN_F(-2)), 0));
        cairn_body_id links[4] = { wall, body, put(&box, 0, CAIRN_F(-4)), put(&box, 0, CAIRN_F(-6)) };
        cairn_spring_id ids[3];
        for (int i = 0; i < 3; i++) {
            int k = orders[n & 3][i];
            bool upwards = n > 3 && k != 0;
            def = cairn_spring_def_default(links[upwards ? k + 1 : k], links[upwards ? k : k + 1]);
            def.stiffness = cairn_wide_from_int(100);
            def.damping = cairn_wide_from_int(10);
            ids[k] = join(&def);
        }
        run(900);
        ASSERT_NEAR(0.002, 2.3, length_of(ids[0]));
        ASSERT_NEAR(0.002, 2.2, length_of(ids[1]));
        ASSERT_NEAR(0.002, 2.1, length_of(ids[2]));
    }
}

/* A path may go through a spring from its b to its a: to the game its ends stay what they are. */
void test_the_ends_of_a_spring_in_a_chain_keep_their_names(void)
{
    ASSERT_OK(cairn_body_set_transform(world, body, at(0, CAIRN_F(-2)), 0));
    cairn_body_id low = put(&box, 0, CAIRN_F(-4));
    join(&def);
    cairn_spring_def upwards = cairn_spring_def_default(low, body);
    upwards.anchor_a = at(CAIRN_F(0.25), 0);
    upwards.stiffness = cairn_wide_from_int(100);
    cairn_spring_id id = join(&upwards);
    cairn_vec2 a, b;
    for (int i = 0; i < 3; i++) {
        ASSERT_OK(cairn_spring_anchors(world, id, &a, &b));
        ASSERT_NEAR_VEC2(0.001, 0.25, -4, a);
        ASSERT_NEAR_VEC2(0.001, 0, -2, b);
        run(1);
        ASSERT_OK(cairn_spring_set(world, id, length_of(id), upwards.stiffness, upwards.damping)); /* which makes the paths anew */
    }
}

/* Light bodies under a heavy one, and pulls of more than 4 m: beyond what the quick products of a path hold. */
void test_a_chain_bears_a_thousand_times_its_mass(void)
{
    static const cairn_shape anvil = CAIRN_BOX(CAIRN_F(32), CAIRN_F(32));
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    ASSERT_OK(cairn_body_set_transform(world, body, at(0, CAIRN_F(-2)), 0));
    cairn_body_id low = put(&anvil, 0, CAIRN_F(-100));
    def.stiffness = cairn_wide_from_int(2000);
    def.damping = cairn_wide_from_int(3000);
    cairn_spring_id upper = join(&def);
    def.a = body;
    def.b = low;
    def.rest_length = CAIRN_F(40);
    cairn_spring_id lower = join(&def);
    run(3000);
    ASSERT_NEAR(0.02, 2 + 10250.0 / 2000, length_of(upper));
    ASSERT_NEAR(0.02, 40 + 10240.0 / 2000, length_of(lower));
}

/* The map of a spring is for one sub-step: a new rate makes it anew, and the swing goes on. */
void test_a_new_rate_does_not_change_the_frequency(void)
{
    def.rest_length = CAIRN_F(1.5);
    join(&def);
    run(30);
    ASSERT_OK(cairn_world_set_rate(world, CAIRN_F(120)));
    run(60);
    ASSERT_NEAR(0.003, 1.5 + 0.5 * -0.8390715, x_of(body)); /* the velocity is that of another moment of the sub-step: v h / 2 */
}

/* ---- off-centre anchors ---- */

/*
 * A beam that turns about its middle, held at its right end by an upright spring: I t'' = -k l^2 t for small angles,
 * w = sqrt(k / I) l. With k = 35.4167 = 100 I and l = 1, w = 10; after 1 s 0.05 cos 10.
 */
void test_a_spring_at_the_end_of_a_pivot_swings_it_by_its_lever(void)
{
    yard_def pivot = def_at(&beam, CAIRN_F(20), 0);
    pivot.fixed_position = true;
    pivot.angle = CAIRN_RADIANS(0.05);
    cairn_body_id id = make(&pivot), above = put_static(&peg, CAIRN_F(21), CAIRN_F(4));
    def = cairn_spring_def_default(above, id);
    def.anchor_b = at(CAIRN_F(1), 0);
    def.stiffness = cairn_wide_div(cairn_wide_from_int(1700), cairn_wide_from_int(48));
    def.rest_length = CAIRN_F(4);
    join(&def);
    run(60);
    ASSERT_NEAR(0.002, 0.05 * -0.8390715, turned(id));
    ASSERT_NEAR_VEC2(0, 20, 0, cairn_body_position(world, id));
}

/* Pulled at its corner, a free box turns until anchor and centre lie in line with the spring. */
void test_a_box_that_hangs_by_its_corner_hangs_straight(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    ASSERT_OK(cairn_body_set_transform(world, body, at(0, CAIRN_F(-2)), 0));
    ASSERT_OK(set_damping(body, CAIRN_F(2), CAIRN_F(2)));
    def.anchor_b = at(CAIRN_F(0.5), CAIRN_F(0.5));
    def.rest_length = CAIRN_F(1);
    def.damping = cairn_wide_from_int(10);
    cairn_spring_id id = join(&def);
    run(900);
    ASSERT_NEAR(0.002, 1.1, length_of(id));
    ASSERT_NEAR(0.002, 0, x_of(body));
    ASSERT_NEAR(0.002, -1.1 - 0.7071068, y_of(body));
    ASSERT_NEAR(0.005, 0.7853982, turned(body));
}

void test_anchors_are_in_the_frame_of_the_body(void)
{
    cairn_vec2 a, b;
    yard_def odd = def_at(&corner.shape, CAIRN_F(5), CAIRN_F(5));
    odd.angle = CAIRN_DEGREES(90);
    cairn_body_id id = make(&odd);
    def.b = id;
    def.anchor_a = at(CAIRN_F(0.01), CAIRN_F(0.02));
    def.anchor_b = at(CAIRN_F(3), 0); /* a corner: at (5, 8) in the world */
    cairn_spring_id spring = join(&def);
    ASSERT_OK(cairn_spring_anchors(world, spring, &a, &b));
    ASSERT_NEAR_VEC2(LSB, 0.01, 0.02, a);
    ASSERT_NEAR_VEC2(2 * LSB, 5, 8, b);
    ASSERT_NEAR(2 * LSB, 9.4117214, length_of(spring));
}

/* ---- stiff ---- */

void test_the_stiffest_spring_stays_bounded(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    ASSERT_OK(cairn_body_set_transform(world, body, at(CAIRN_F(2), 0), 0));
    def.stiffness = cairn_wide_from_int(100000000);
    cairn_spring_id id = join(&def);
    for (int i = 0; i < 300; i++) {
        run(1);
        ASSERT_NEAR(0.01, 2, length_of(id)); /* a pendulum on a rod */
    }
    TEST_ASSERT_EQUAL_UINT32(0, stats()->saturations);
}

void test_a_stiff_chain_stays_bounded_and_keeps_its_length(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, CAIRN_F(-10))));
    cairn_spring_id ids[6];
    cairn_body_id last = wall;
    ASSERT_OK(cairn_body_destroy(world, body));
    for (int i = 0; i < 6; i++) {
        cairn_body_id next = put(&peg, CAIRN_F(0.5) * (i + 1), 0);
        def = cairn_spring_def_default(last, next);
        def.stiffness = cairn_wide_from_int(100000000);
        def.damping = cairn_wide_from_int(1000);
        ids[i] = join(&def);
        last = next;
    }
    for (int i = 0; i < 600; i++) {
        run(1);
        for (int k = 0; k < 6; k++) {
            TEST_ASSERT_TRUE(length_of(ids[k]) < CAIRN_F(0.6));
        }
    }
    TEST_ASSERT_TRUE(y_of(last) < CAIRN_F(-1)); /* and it swung down */
}

/* Pulled apart by 10 m with 1e9 N/m: it snaps back and does not fly off. */
void test_a_stiff_spring_that_is_torn_apart_comes_back(void)
{
    def.stiffness = cairn_wide_from_int(1000000000);
    def.damping = cairn_wide_from_int(1000);
    cairn_spring_id id = join(&def);
    ASSERT_OK(cairn_body_set_transform(world, body, at(CAIRN_F(12), 0), 0));
    run(120);
    ASSERT_NEAR(0.01, 2, length_of(id));
}

/* ---- degenerate ---- */

void test_a_spring_of_zero_length_pulls_the_anchors_together(void)
{
    def.rest_length = 0;
    def.damping = cairn_wide_from_int(20);
    def.no_contact = true;
    cairn_spring_id id = join(&def);
    run(240);
    ASSERT_NEAR(0.0005, 0, length_of(id));
}

void test_coinciding_anchors_are_pushed_apart_along_x(void)
{
    ASSERT_OK(cairn_body_set_transform(world, body, at(0, 0), 0));
    def.rest_length = CAIRN_F(1);
    def.damping = cairn_wide_from_int(20);
    def.no_contact = true;
    join(&def);
    run(240);
    ASSERT_NEAR_VEC2(0.0005, 1, 0, cairn_body_position(world, body));
}

void test_a_spring_between_two_that_do_not_move_does_nothing(void)
{
    yard_def lift = def_at(&peg, CAIRN_F(4), 0);
    lift.type = CAIRN_KINEMATIC;
    cairn_body_id platform = make(&lift), other = put_static(&peg, CAIRN_F(5), 0);
    def = cairn_spring_def_default(platform, other);
    def.rest_length = CAIRN_F(9);
    def.stiffness = cairn_wide_from_int(1000);
    cairn_spring_id first = join(&def);
    def.a = wall;
    join(&def);
    run(30);
    ASSERT_NEAR(0, 1, length_of(first));
    ASSERT_NEAR_VEC2(0, 4, 0, cairn_body_position(world, platform));
}

/* A spring to a moving platform pulls after it. */
void test_a_kinematic_end_pulls_the_other(void)
{
    yard_def lift = def_at(&peg, CAIRN_F(4), CAIRN_F(5));
    lift.type = CAIRN_KINEMATIC;
    lift.velocity.x = CAIRN_F(1);
    cairn_body_id platform = make(&lift), load = put(&box, CAIRN_F(2), CAIRN_F(5));
    def = cairn_spring_def_default(platform, load);
    def.stiffness = cairn_wide_from_int(100);
    def.damping = cairn_wide_from_int(20);
    join(&def);
    run(240);
    ASSERT_NEAR(0.001, 1, vx_of(load));
    ASSERT_NEAR(0.001, 2, x_of(platform) - x_of(load));
}

void test_a_spring_on_a_body_of_fixed_rotation_and_position_is_as_on_a_wall(void)
{
    yard_def post = def_at(&peg, CAIRN_F(20), 0);
    post.fixed_rotation = post.fixed_position = true;
    post.density = cairn_wide_from_int(1000000);
    cairn_body_id fixed = make(&post), load = put(&box, CAIRN_F(22), 0);
    def = cairn_spring_def_default(fixed, load);
    def.stiffness = cairn_wide_from_int(100);
    def.damping = cairn_wide_from_int(20);
    def.rest_length = CAIRN_F(1);
    join(&def);
    run(240);
    ASSERT_NEAR_VEC2(0, 20, 0, cairn_body_position(world, fixed));
    ASSERT_NEAR(0.001, 21, x_of(load));
}

/* ---- contact of joined bodies ---- */

void test_joined_bodies_collide_unless_the_spring_says_otherwise(void)
{
    cairn_body_id a = put(&ball, CAIRN_F(10), 0), b = put(&ball, CAIRN_F(11.2), 0);
    def = cairn_spring_def_default(a, b);
    def.stiffness = cairn_wide_from_int(100);
    def.damping = cairn_wide_from_int(10);
    def.rest_length = CAIRN_F(0.5);
    cairn_spring_id id = join(&def);
    run(120);
    ASSERT_NEAR(0.003, 1, length_of(id)); /* their radii */
    TEST_ASSERT_TRUE(are_touching(a, b));
    ASSERT_OK(cairn_spring_destroy(world, id));
    def.a = b; /* either end first */
    def.b = a;
    def.no_contact = true;
    id = join(&def);
    run(120);
    ASSERT_NEAR(0.001, 0.5, length_of(id));
    TEST_ASSERT_FALSE(are_touching(a, b));
    /* the third body is still met, and without the spring they meet again */
    cairn_body_id third = put(&ball, x_of(b) + CAIRN_F(0.95), 0);
    run(1);
    TEST_ASSERT_TRUE(are_touching(b, third));
    ASSERT_OK(cairn_spring_destroy(world, id));
    run(120);
    TEST_ASSERT_TRUE(x_of(b) - x_of(a) > CAIRN_F(0.99));
}

void test_two_sprung_bodies_that_are_not_joined_to_one_another_still_collide(void)
{
    cairn_body_id a = put(&ball, CAIRN_F(10), 0), b = put(&ball, CAIRN_F(10.9), 0);
    def.no_contact = true;
    def.b = a;
    join(&def);
    def.b = b;
    join(&def);
    run(1);
    TEST_ASSERT_TRUE(are_touching(a, b));
}

/* ---- tuning ---- */

void test_tune_sets_what_gives_the_frequency_and_the_damping_ratio(void)
{
    ASSERT_OK(cairn_spring_tune(world, &def, CAIRN_F(2), CAIRN_F(0.25)));
    ASSERT_NEAR(0.001, 157.913670, cairn_wide_to_real(def.stiffness)); /* m (2 pi f)^2 */
    ASSERT_NEAR(0.001, 6.283185, cairn_wide_to_real(def.damping));     /* 2 zeta m (2 pi f) */
    def.a = body;
    def.b = wall;
    ASSERT_OK(cairn_spring_tune(world, &def, CAIRN_F(2), CAIRN_F(0.25)));
    ASSERT_NEAR(0.001, 157.913670, cairn_wide_to_real(def.stiffness));
    def.b = put(&box, CAIRN_F(5), 0);
    ASSERT_OK(cairn_spring_tune(world, &def, CAIRN_F(2), CAIRN_F(0.25)));
    ASSERT_NEAR(0.001, 157.913670 / 2, cairn_wide_to_real(def.stiffness));
}

void test_a_tuned_spring_has_its_period(void)
{
    def.rest_length = CAIRN_F(1.5);
    ASSERT_OK(cairn_spring_tune(world, &def, CAIRN_F(1.25), 0));
    join(&def);
    run(48); /* one period */
    ASSERT_NEAR(0.0002, 2, x_of(body));
    run(24);
    ASSERT_NEAR(0.0002, 1, x_of(body));
}

void test_tune_refuses_null_stale_numbers_out_of_range_and_two_ends_that_do_not_move(void)
{
    cairn_spring_def before = def, bad = def;
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_spring_tune(NULL, &def, CAIRN_F(1), 0));
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_spring_tune(world, NULL, CAIRN_F(1), 0));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_spring_tune(world, &def, 0, 0));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_spring_tune(world, &def, CAIRN_F(1000.1), 0));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_spring_tune(world, &def, CAIRN_F(1), CAIRN_F(-0.1)));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_spring_tune(world, &def, CAIRN_F(1), CAIRN_F(100.1)));
    TEST_ASSERT_EQUAL_MEMORY(&before, &def, sizeof def);
    bad.a = cairn_body_id_null();
    ASSERT_REFUSED(CAIRN_ERROR_STALE, cairn_spring_tune(world, &bad, CAIRN_F(1), 0));
    bad = def;
    bad.b = cairn_body_id_null();
    ASSERT_REFUSED(CAIRN_ERROR_STALE, cairn_spring_tune(world, &bad, CAIRN_F(1), 0));
    bad.b = put_static(&peg, CAIRN_F(9), 0);
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_spring_tune(world, &bad, CAIRN_F(1), 0));
}

/* ---- changing and ending ---- */

void test_the_rest_length_is_the_present_one_if_none_is_given(void)
{
    cairn_spring_id id = join(&def);
    ASSERT_NEAR(LSB, 2, length_of(id));
    run(60);
    ASSERT_NEAR(LSB, 2, x_of(body));
}

/* However small, and whatever its exponent. */
void test_a_stiffness_that_is_next_to_nothing_is_nothing(void)
{
    def.rest_length = CAIRN_F(1);
    def.stiffness = cairn_wide_of(1, -1000);
    def.damping = cairn_wide_of(1, -200);
    join(&def);
    run(60);
    ASSERT_NEAR(0, 2, x_of(body));
}

void test_set_changes_what_a_spring_pulls_with(void)
{
    cairn_spring_id id = join(&def);
    run(10);
    ASSERT_OK(cairn_spring_set(world, id, CAIRN_F(3), cairn_wide_from_int(400), cairn_wide_from_int(40)));
    run(240);
    ASSERT_NEAR(0.0005, 3, length_of(id));
}

void test_without_its_spring_a_body_flies_straight_on(void)
{
    def.rest_length = CAIRN_F(1.5);
    cairn_spring_id id = join(&def);
    run(25); /* on its way out */
    ASSERT_OK(cairn_spring_destroy(world, id));
    TEST_ASSERT_FALSE(cairn_spring_exists(world, id));
    cairn_real x = x_of(body), v = vx_of(body);
    run(60);
    ASSERT_NEAR(0.001, 0, x_of(body) - x - v);
    TEST_ASSERT_EQUAL_UINT16(0, stats()->springs);
}

void test_destroying_a_body_takes_its_springs(void)
{
    cairn_body_id other = put(&box, CAIRN_F(6), 0);
    cairn_spring_id first = join(&def);
    def.a = body;
    def.b = other;
    cairn_spring_id second = join(&def);
    def.a = other;
    def.b = wall;
    cairn_spring_id third = join(&def);
    TEST_ASSERT_EQUAL_UINT16(3, stats()->springs);
    ASSERT_OK(cairn_body_destroy(world, body));
    TEST_ASSERT_FALSE(cairn_spring_exists(world, first));
    TEST_ASSERT_FALSE(cairn_spring_exists(world, second));
    TEST_ASSERT_TRUE(cairn_spring_exists(world, third));
    TEST_ASSERT_EQUAL_UINT16(1, stats()->springs);
    run(10);
}

void test_springs_are_walked_in_the_order_of_the_pool(void)
{
    cairn_spring_id ids[3], id = cairn_spring_id_null();
    TEST_ASSERT_TRUE(cairn_spring_id_is_null(cairn_world_next_spring(world, id)));
    for (int i = 0; i < 3; i++) {
        ids[i] = join(&def);
    }
    ASSERT_OK(cairn_spring_destroy(world, ids[1]));
    id = cairn_world_next_spring(world, id);
    TEST_ASSERT_EQUAL_UINT16(ids[0].index, id.index);
    id = cairn_world_next_spring(world, id);
    TEST_ASSERT_EQUAL_UINT16(ids[2].index, id.index);
    TEST_ASSERT_TRUE(cairn_spring_id_is_null(cairn_world_next_spring(world, id)));
}

/* ---- the pool and what is refused ---- */

void test_a_full_spring_pool_refuses_until_one_is_destroyed(void)
{
    cairn_spring_id ids[8];
    for (int i = 0; i < 8; i++) {
        ids[i] = join(&def);
    }
    ASSERT_REFUSED_ID(CAIRN_ERROR_FULL, cairn_spring_create(world, &def));
    TEST_ASSERT_EQUAL_UINT16(8, stats()->springs);
    ASSERT_OK(cairn_spring_destroy(world, ids[3]));
    cairn_spring_id again = join(&def);
    TEST_ASSERT_EQUAL_UINT16(ids[3].index, again.index);
    TEST_ASSERT_NOT_EQUAL(ids[3].generation, again.generation);
    TEST_ASSERT_FALSE(cairn_spring_exists(world, ids[3]));
    TEST_ASSERT_TRUE(cairn_spring_exists(world, again));
}

void test_spring_generations_wrap_round_zero(void)
{
    cairn_spring_id first = join(&def), id = first;
    for (int32_t i = 0; i < 65535; i++) {
        cairn_spring_destroy(world, id);
        id = cairn_spring_create(world, &def);
        if (id.generation == 0 || id.index != first.index) {
            TEST_FAIL_MESSAGE("generation 0");
        }
    }
    TEST_ASSERT_EQUAL_UINT16(first.generation, id.generation);
}

static void assert_create_refused(cairn_status status, const cairn_spring_def *bad)
{
    ASSERT_REFUSED_ID(status, cairn_spring_create(world, bad));
    TEST_ASSERT_EQUAL_UINT16(0, stats()->springs);
}

void test_create_refuses_null_stale_and_one_body_twice(void)
{
    cairn_spring_def bad = def;
    TEST_ASSERT_TRUE(cairn_spring_id_is_null(cairn_spring_create(NULL, &def)));
    assert_create_refused(CAIRN_ERROR_NULL, NULL);
    bad.a = cairn_body_id_null();
    assert_create_refused(CAIRN_ERROR_STALE, &bad);
    bad = def;
    bad.b = cairn_body_id_null();
    assert_create_refused(CAIRN_ERROR_STALE, &bad);
    bad.b = bad.a;
    assert_create_refused(CAIRN_ERROR_RANGE, &bad);
}

void test_create_refuses_numbers_out_of_range(void)
{
    cairn_spring_def bad = def;
    bad.rest_length = CAIRN_F(500.1);
    assert_create_refused(CAIRN_ERROR_RANGE, &bad);
    bad = def;
    bad.stiffness = cairn_wide_from_int(1000000001);
    assert_create_refused(CAIRN_ERROR_RANGE, &bad);
    bad = def;
    bad.damping = cairn_wide_from_int(1000000001);
    assert_create_refused(CAIRN_ERROR_RANGE, &bad);
    static const cairn_vec2 far[] = { { CAIRN_F(125.1), 0 }, { CAIRN_F(-125.1), 0 }, { 0, CAIRN_F(125.1) }, { 0, CAIRN_F(-125.1) } };
    for (int i = 0; i < 4; i++) {
        bad = def;
        bad.anchor_a = far[i];
        assert_create_refused(CAIRN_ERROR_RANGE, &bad);
        bad = def;
        bad.anchor_b = far[i];
        assert_create_refused(CAIRN_ERROR_RANGE, &bad);
    }
    bad = def;
    bad.rest_length = CAIRN_F(500);
    bad.anchor_a = bad.anchor_b = at(CAIRN_F(125), CAIRN_F(-125));
    bad.stiffness = bad.damping = cairn_wide_from_int(1000000000);
    join(&bad);
}

void test_springs_need_to_be_enabled(void)
{
    open_yard(0);
    wall = put_static(&peg, 0, 0);
    body = put(&box, CAIRN_F(2), 0);
    cairn_spring_def plan = cairn_spring_def_default(wall, body);
    assert_create_refused(CAIRN_ERROR_KIND, &plan);
    cairn_spring_id never = { 1, 1 };
    TEST_ASSERT_FALSE(cairn_spring_exists(world, never));
    ASSERT_REFUSED(CAIRN_ERROR_STALE, cairn_spring_destroy(world, never));
    TEST_ASSERT_TRUE(cairn_spring_id_is_null(cairn_world_next_spring(world, cairn_spring_id_null())));
}

void test_enable_refuses_null_capacities_out_of_range_and_a_second_time(void)
{
    cairn_spring_storage storage = coils;
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_springs_enable(world, &coils));
    open_yard(0);
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_springs_enable(NULL, &coils));
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_springs_enable(world, NULL));
    storage.pool = NULL;
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_springs_enable(world, &storage));
    storage = coils;
    storage.springs = NULL;
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_springs_enable(world, &storage));
    storage = coils;
    storage.capacity = 0;
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_springs_enable(world, &storage));
    storage.capacity = 65001;
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_springs_enable(world, &storage));
}

static cairn_spring_id stale_spring(void)
{
    cairn_spring_id id = join(&def);
    ASSERT_OK(cairn_spring_destroy(world, id));
    return id;
}

void test_destroy_refuses_null_and_stale(void)
{
    cairn_spring_id gone = stale_spring();
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_spring_destroy(NULL, gone));
    ASSERT_REFUSED(CAIRN_ERROR_STALE, cairn_spring_destroy(world, gone));
    ASSERT_REFUSED(CAIRN_ERROR_STALE, cairn_spring_destroy(world, cairn_spring_id_null()));
}

void test_set_refuses_null_stale_and_numbers_out_of_range(void)
{
    cairn_wide none = cairn_wide_from_int(0), much = cairn_wide_from_int(1000000001);
    cairn_spring_id gone = stale_spring(), id = join(&def);
    cairn_spring before[8];
    memcpy(before, coils_springs, sizeof before);
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_spring_set(NULL, id, 0, none, none));
    ASSERT_REFUSED(CAIRN_ERROR_STALE, cairn_spring_set(world, gone, 0, none, none));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_spring_set(world, id, CAIRN_F(-0.1), none, none));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_spring_set(world, id, CAIRN_F(500.1), none, none));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_spring_set(world, id, 0, much, none));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_spring_set(world, id, 0, none, much));
    TEST_ASSERT_EQUAL_MEMORY(before, coils_springs, sizeof before);
}

void test_questions_about_a_stale_spring_give_zero_and_an_error(void)
{
    cairn_vec2 a, b;
    cairn_spring_id gone = stale_spring();
    ASSERT_SAME(0, cairn_spring_length(NULL, gone));
    ASSERT_SAME(0, cairn_spring_length(world, gone));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_STALE, cairn_world_error(world));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_spring_anchors(NULL, gone, &a, &b));
    ASSERT_REFUSED(CAIRN_ERROR_STALE, cairn_spring_anchors(world, gone, &a, &b));
    TEST_ASSERT_FALSE(cairn_spring_exists(NULL, gone));
    TEST_ASSERT_TRUE(cairn_spring_id_is_null(cairn_world_next_spring(NULL, gone)));
}

void test_anchors_refuses_null(void)
{
    cairn_vec2 a, b;
    cairn_spring_id id = join(&def);
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_spring_anchors(world, id, NULL, &b));
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_spring_anchors(world, id, &a, NULL));
}

/* ---- far ends ---- */

/* Half a kilometre is what an offset holds: farther ends pull as those at that distance, and never the wrong way. */
void test_ends_farther_apart_than_an_offset_holds_still_pull_together(void)
{
    static const cairn_vec2 places[] = { { CAIRN_F(1500), CAIRN_F(40) }, { CAIRN_F(-1500), CAIRN_F(-900) } };
    for (int i = 0; i < 2; i++) {
        cairn_body_id far = put(&box, places[i].x, places[i].y);
        def.b = far;
        def.rest_length = 0;
        def.stiffness = cairn_wide_from_int(1);
        cairn_spring_id id = join(&def);
        TEST_ASSERT_TRUE(length_of(id) >= CAIRN_F(500));
        run(1);
        TEST_ASSERT_TRUE(i == 0 ? vx_of(far) < 0 : vx_of(far) > 0);
        TEST_ASSERT_TRUE(i == 0 ? vy_of(far) <= 0 : vy_of(far) > 0);
    }
}
