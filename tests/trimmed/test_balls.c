/* A build for balls of one kind that neither rub nor turn, among upright boxes (balls.h): it refuses what it lacks, and does the rest. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_material slick = CAIRN_MATERIAL(0, 0);
static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape floor_shape = CAIRN_BOX(CAIRN_F(20), CAIRN_F(1));

/* Bodies keep a pointer to theirs. */
static cairn_body_model ground, model;
static cairn_body_id floor_id;

static cairn_body_model sliding(const cairn_shape *shape)
{
    cairn_body_model made = cairn_body_model_default(shape);
    made.material = &slick;
    made.fixed_rotation = true;
    return made;
}

void setUp(void)
{
    open_yard(CAIRN_F(-10));
    ground = sliding(&floor_shape);
    ground.type = CAIRN_STATIC;
    model = sliding(&ball);
    floor_id = cairn_body_create(world, &ground, at(0, CAIRN_F(-0.5)), 0);
}
void tearDown(void) {}

static void refuses(const cairn_body_model *asked, cairn_angle angle)
{
    ASSERT_REFUSED_ID(CAIRN_ERROR_KIND, cairn_body_create(world, asked, at(0, CAIRN_F(3)), angle));
}

void test_what_rubs_is_refused(void)
{
    model.material = &cairn_material_ice;
    refuses(&model, 0);
}

void test_what_may_turn_is_refused(void)
{
    model.fixed_rotation = false;
    refuses(&model, 0);
    model.type = CAIRN_KINEMATIC;
    refuses(&model, 0);
}

void test_what_stands_at_an_angle_is_refused(void)
{
    refuses(&ground, CAIRN_DEGREES(10));
    cairn_body_id wall = cairn_body_create(world, &ground, at(0, CAIRN_F(9)), 0);
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_set_transform(world, wall, at(0, 0), CAIRN_DEGREES(90)));
}

void test_a_ball_may_have_an_angle(void)
{
    TEST_ASSERT_FALSE(cairn_body_id_is_null(cairn_body_create(world, &model, at(0, CAIRN_F(3)), CAIRN_DEGREES(90))));
}

void test_polygons_are_refused(void)
{
    cairn_polygon stone;
    ASSERT_OK(cairn_polygon_init_regular(&stone, 3, CAIRN_F(1)));
    model = sliding(&stone.shape);
    model.type = CAIRN_STATIC;
    refuses(&model, 0);
}

void test_what_falls_otherwise_is_refused(void)
{
    model.gravity_scale = CAIRN_F(0.5);
    refuses(&model, 0);
}

void test_a_giant_is_refused(void)
{
    static const cairn_shape giant = CAIRN_CIRCLE(CAIRN_F(15) + 1), large = CAIRN_CIRCLE(CAIRN_F(15));
    model = sliding(&giant);
    ASSERT_REFUSED_ID(CAIRN_ERROR_SHAPE, cairn_body_create(world, &model, at(0, CAIRN_F(40)), 0));
    model = sliding(&large);
    TEST_ASSERT_FALSE(cairn_body_id_is_null(cairn_body_create(world, &model, at(0, CAIRN_F(40)), 0)));
}

void test_what_moves_is_of_one_shape_and_one_density(void)
{
    static const cairn_shape smaller = CAIRN_CIRCLE(CAIRN_F(0.4));
    static cairn_body_model other, denser;
    static const cairn_wide two = CAIRN_DENSITY(2);
    other = sliding(&smaller);
    denser = model;
    denser.density = two;
    cairn_body_id id = cairn_body_create(world, &model, at(0, CAIRN_F(3)), 0);
    TEST_ASSERT_FALSE(cairn_body_id_is_null(cairn_body_create(world, &model, at(0, CAIRN_F(5)), 0)));
    refuses(&other, 0);
    refuses(&denser, 0);
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_body_set_model(world, id, &denser));
    other.type = CAIRN_STATIC;
    TEST_ASSERT_FALSE(cairn_body_id_is_null(cairn_body_create(world, &other, at(0, CAIRN_F(9)), 0)));
    denser.density = cairn_wide_zero();
    ASSERT_REFUSED_ID(CAIRN_ERROR_RANGE, cairn_body_create(world, &denser, at(0, CAIRN_F(7)), 0));
}

void test_when_all_are_gone_others_may_come(void)
{
    static const cairn_shape smaller = CAIRN_CIRCLE(CAIRN_F(0.4));
    static cairn_body_model other;
    other = sliding(&smaller);
    ASSERT_OK(cairn_body_destroy(world, cairn_body_create(world, &model, at(0, CAIRN_F(3)), 0)));
    TEST_ASSERT_FALSE(cairn_body_id_is_null(cairn_body_create(world, &other, at(0, CAIRN_F(3)), 0)));
}

void test_settings_stay_what_they_are(void)
{
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_world_set_rate(world, CAIRN_F(50)));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_world_set_substeps(world, 8));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_world_set_push_out(world, CAIRN_F(1)));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_rate(world, 0));
    ASSERT_OK(cairn_world_set_rate(world, CAIRN_F(60)));
    ASSERT_OK(cairn_world_set_substeps(world, 4));
    ASSERT_OK(cairn_world_set_push_out(world, CAIRN_F(3)));
}

void test_forces_know_the_mass(void)
{
    cairn_body_id id = cairn_body_create(world, &model, at(0, CAIRN_F(5)), 0);
    ASSERT_OK(cairn_body_apply_impulse(world, id, at(CAIRN_F(0.7854), 0))); /* of pi / 4 kg */
    ASSERT_NEAR(0.0005, 1, cairn_body_velocity(world, id).x);
}

void test_a_ball_slides_on_without_turning(void)
{
    cairn_body_id id = cairn_body_create(world, &model, at(CAIRN_F(-4), CAIRN_F(0.5)), 0);
    ASSERT_OK(cairn_body_set_velocity(world, id, at(CAIRN_F(2), 0)));
    ASSERT_OK(cairn_body_set_angular_velocity(world, id, CAIRN_F(1))); /* as of any body of fixed rotation, to no effect */
    run(60);
    ASSERT_NEAR_VEC2(0.001, -2, 0.5, cairn_body_position(world, id));
    TEST_ASSERT_TRUE(cairn_body_angle(world, id) == 0);
    TEST_ASSERT_EQUAL_INT(1, cairn_world_get_stats(world)->points);
}

void test_balls_of_one_kind_hand_over_their_speed(void)
{
    cairn_body_id a = cairn_body_create(world, &model, at(CAIRN_F(-2), CAIRN_F(0.5)), 0), b = cairn_body_create(world, &model, at(0, CAIRN_F(0.5)), 0);
    ASSERT_OK(cairn_body_set_velocity(world, a, at(CAIRN_F(2), 0)));
    run(120);
    ASSERT_NEAR(0.02, 2, cairn_body_velocity(world, a).x + cairn_body_velocity(world, b).x);
    TEST_ASSERT_TRUE(cairn_body_velocity(world, b).x >= cairn_body_velocity(world, a).x);
}

void test_contacts_say_where_whichever_body_came_first(void)
{
    static const cairn_shape post_shape = CAIRN_BOX(CAIRN_F(1), CAIRN_F(2));
    static cairn_body_model post_model;
    static const struct { int x, y; } middle[4] = { { 2, 0 }, { 4, 0 }, { 3, 1 }, { 5, 1 } }; /* of both surfaces, in halves of a metre */
    cairn_body_id one = cairn_body_create(world, &model, at(CAIRN_F(1), CAIRN_F(0.5)), 0);
    cairn_body_id other = cairn_body_create(world, &model, at(CAIRN_F(2), CAIRN_F(0.5)), 0);
    post_model = sliding(&post_shape);
    post_model.type = CAIRN_STATIC;
    cairn_body_id post = cairn_body_create(world, &post_model, at(CAIRN_F(3), CAIRN_F(1)), 0);
    const cairn_body_id pairs[4][2] = { { floor_id, one }, { floor_id, other }, { one, other }, { other, post } };
    run(1);
    for (int i = 0; i < 4; i++) {
        cairn_contact contact;
        TEST_ASSERT_TRUE(contact_of(pairs[i][0], pairs[i][1], &contact));
        TEST_ASSERT_EQUAL_INT(1, contact.count);
        ASSERT_NEAR(0.001, 0, cairn_real_sub(contact.points[0].position.x, cairn_real_half(cairn_real_from_int(middle[i].x))));
        ASSERT_NEAR(0.001, 0, cairn_real_sub(contact.points[0].position.y, cairn_real_half(cairn_real_from_int(middle[i].y))));
    }
}

CAIRN_WORLD(few, 3, 1);

/* Pairs are looked at before anybody asks whether they have an arbiter: what has one must find it in a full pool, too. */
void test_a_full_pool_keeps_the_contact_that_is_there(void)
{
    cairn_world *full = cairn_world_init_with(&few, at(0, CAIRN_F(-10)), &cairn_solver_soft, NULL);
    cairn_body_create(full, &ground, at(0, CAIRN_F(-0.5)), 0);
    cairn_body_id kept = cairn_body_create(full, &model, at(CAIRN_F(-2), CAIRN_F(0.5)), 0), lost = cairn_body_create(full, &model, at(CAIRN_F(2), CAIRN_F(0.5)), 0);
    for (int step = 0; step < 10; step++) {
        ASSERT_OK(cairn_world_step(full));
        TEST_ASSERT_EQUAL_UINT32(1, cairn_world_get_stats(full)->arbiters);
        TEST_ASSERT_EQUAL_UINT32((uint32_t)step + 1, cairn_world_get_stats(full)->dropped);
    }
    ASSERT_NEAR(0.001, 0.5, cairn_body_position(full, kept).y);
    TEST_ASSERT_TRUE(cairn_body_position(full, lost).y < CAIRN_F(0.45));
}
