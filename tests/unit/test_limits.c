/* The largest bodies: what touches stays within the reach of an offset, from far corner to far corner. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape plank = CAIRN_BOX(CAIRN_F(240), CAIRN_F(2));

void setUp(void) { open_yard(CAIRN_F(-10)); }
void tearDown(void) {}

/* A plank on the end of another: they share 10 m, and their far ends are 470 m apart. */
static cairn_body_id overhang(bool fixed_rotation)
{
    yard_def def = def_at(&plank, CAIRN_F(230), CAIRN_F(2));
    put_static(&plank, 0, 0);
    def.fixed_rotation = fixed_rotation;
    return make(&def);
}

void test_a_long_plank_that_cannot_tip_rests_on_the_end_of_another(void)
{
    cairn_body_id id = overhang(true);
    for (int i = 0; i < 120; i++) {
        run(1);
        ASSERT_NEAR(0.02, 2, y_of(id));
        ASSERT_NEAR(0.001, 230, x_of(id));
        ASSERT_NEAR(0.02, 0, vy_of(id));
    }
}

/* About the corner, 110 m from its middle: a = 10 (110 cos t + sin t) / ((240^2 + 2^2) / 12 + 110^2 + 1), 1 s of it. */
void test_a_long_plank_that_may_tip_turns_about_the_end_of_another(void)
{
    cairn_body_id id = overhang(false);
    run(60);
    ASSERT_NEAR(0.0005, -0.032543, turned(id));
    ASSERT_NEAR(0.001, -0.065083, spin_of(id));
}

/* The same as polygons, which have a narrow phase of their own; half the way round as well. */
static void assert_polygons_rest(cairn_angle angle)
{
    static const cairn_vec2 corners[] = {
        { CAIRN_F(-120), CAIRN_F(-1) }, { CAIRN_F(120), CAIRN_F(-1) }, { CAIRN_F(120), CAIRN_F(1) }, { CAIRN_F(-120), CAIRN_F(1) }
    };
    cairn_polygon polygon;
    ASSERT_OK(cairn_polygon_init(&polygon, corners, 4));
    open_yard(CAIRN_F(-10));
    put_static(&polygon.shape, 0, 0);
    yard_def def = def_at(&polygon.shape, CAIRN_F(-230), CAIRN_F(2));
    def.angle = angle;
    def.fixed_rotation = true;
    cairn_body_id id = make(&def);
    for (int i = 0; i < 120; i++) {
        run(1);
        ASSERT_NEAR(0.02, 2, y_of(id));
        ASSERT_NEAR(0.001, -230, x_of(id));
    }
}

void test_long_polygons_rest_on_the_end_of_one_another(void)
{
    assert_polygons_rest(0);
    assert_polygons_rest(CAIRN_DEGREES(180));
}

/* The largest ball rolls to no side on the largest one: centres 250 m apart. */
void test_the_largest_circles_balance(void)
{
    static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_SHAPE_RADIUS_MAX);
    put_static(&ball, 0, 0);
    cairn_body_id id = put(&ball, 0, CAIRN_F(250));
    run(120);
    ASSERT_NEAR(0.02, 250, y_of(id));
    ASSERT_NEAR(0.001, 0, x_of(id));
}

/* Their boxes overlap with the margin of a step's motion, but their far corners are more than 512 m apart. */
void test_giants_that_pass_at_top_speed_stay_in_range(void)
{
    cairn_polygon giant;
    ASSERT_OK(cairn_polygon_init_regular(&giant, 8, CAIRN_F(124.9)));
    for (int substeps = 4; substeps <= 16; substeps += 12) {
        open_yard(0);
        ASSERT_OK(cairn_world_set_substeps(world, substeps));
        cairn_real top = cairn_world_speed_limit(world);
        yard_def def = def_at(&giant.shape, 0, 0);
        def.velocity = cairn_vec2_of(top, top);
        def.angular_velocity = CAIRN_F(0.5);
        cairn_body_id a = make(&def);
        def.position = cairn_vec2_of(CAIRN_F(262), CAIRN_F(262));
        def.velocity = cairn_vec2_of(-top, -top);
        cairn_body_id b = make(&def);
        run(2);
        TEST_ASSERT_TRUE(x_of(b) > x_of(a)); /* nor have they swapped sides */
    }
}

/*
 * Planks side by side, slanted so that their boxes overlap, 110 m from one another: farther than any distance that is
 * asked for, so that the narrow phase says nothing of them, not even a normal.
 */
void test_fast_planks_far_from_one_another_do_not_meet(void)
{
    open_yard(0);
    yard_def def = def_at(&plank, 0, 0);
    def.angle = CAIRN_DEGREES(45);
    def.velocity = at(CAIRN_F(30), CAIRN_F(-30));
    cairn_body_id a = make(&def);
    def.position = at(CAIRN_F(78), CAIRN_F(-78));
    def.velocity = at(CAIRN_F(-30), CAIRN_F(30));
    cairn_body_id b = make(&def);
    run(2);
    TEST_ASSERT_EQUAL_UINT32(1, stats()->pairs);
    TEST_ASSERT_EQUAL_UINT32(0, stats()->arbiters);
    ASSERT_NEAR_VEC2(4 * LSB, 1, -1, cairn_body_position(world, a));
    ASSERT_NEAR_VEC2(4 * LSB, 77, -77, cairn_body_position(world, b));
}

/* The heavy one's speed across the contact is 1.3 of the limit, and 1.2 of that along x: the ball is held to what there is. */
void test_no_speed_is_above_the_limit_after_a_step(void)
{
    static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(1));
    open_yard(0);
    cairn_real top = cairn_world_speed_limit(world);
    yard_def def = def_at(&ball, 0, 0);
    def.density = cairn_wide_from_int(1000);
    def.velocity = at(top, top);
    make(&def);
    cairn_body_id id = put(&ball, CAIRN_F(1.8478), CAIRN_F(0.7654));
    for (int i = 0; i < 4; i++) {
        run(1);
        TEST_ASSERT_TRUE(vx_of(id) > 0 && vx_of(id) <= top);
        TEST_ASSERT_TRUE(size_of(vy_of(id)) <= top);
    }
    TEST_ASSERT_TRUE(stats()->saturations > 0);
}
