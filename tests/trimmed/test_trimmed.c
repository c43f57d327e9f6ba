/* A build without what config.h can leave out (without.h): it refuses what it lacks, and does the rest. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape crate = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape floor_shape = CAIRN_BOX(CAIRN_F(20), CAIRN_F(1));
static const cairn_material rubber = CAIRN_MATERIAL_BOUNCING(0.5, 0.5, 0.5, 1);
CAIRN_SPRINGS(coils, 2);
CAIRN_QUADTREE(tree, 16, 16, 64);
CAIRN_BLOCKS(blocks);

void setUp(void) { open_yard(CAIRN_F(-10)); }
void tearDown(void) {}

static void refuses(cairn_body_model model)
{
    TEST_ASSERT_TRUE(cairn_body_id_is_null(cairn_body_create(world, &model, at(0, 0), 0)));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_KIND, cairn_world_error(world));
}

void test_what_enables_a_feature_is_refused(void)
{
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_KIND, cairn_springs_enable(world, &coils));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_KIND, cairn_quadtree_enable(world, &tree, at(0, 0), 6, 6));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_KIND, cairn_blocks_enable(world, &blocks));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_KIND, cairn_sleep_enable(world));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_KIND, cairn_world_use_slides_solver(world, 10));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_KIND, cairn_world_use_small_solver(world, 10));
    cairn_spring_def def = cairn_spring_def_default(put(&ball, 0, 0), put(&ball, CAIRN_F(3), 0));
    TEST_ASSERT_TRUE(cairn_spring_id_is_null(cairn_spring_create(world, &def)));
}

void test_models_that_ask_for_what_is_left_out_are_refused(void)
{
    cairn_body_model model = cairn_body_model_default(&ball);
    model.sensor = true;
    refuses(model);
    model = cairn_body_model_default(&ball);
    model.fixed_position = true;
    refuses(model);
    model = cairn_body_model_default(&ball);
    model.angular_damping = CAIRN_F(1);
    refuses(model);
    model = cairn_body_model_default(&ball);
    model.material = &rubber;
    refuses(model);
    refuses(cairn_body_model_default(&crate));
}

void test_a_ball_comes_to_rest_on_the_floor(void)
{
    put_static(&floor_shape, 0, CAIRN_F(-0.5));
    cairn_body_id id = put(&ball, 0, CAIRN_F(0.7));
    for (int i = 0; i < 120; i++) {
        ASSERT_OK(cairn_world_step(world));
    }
    TEST_ASSERT_EQUAL_INT(1, cairn_world_get_stats(world)->points);
    ASSERT_NEAR(0.01, 0.5, cairn_body_position(world, id).y);
}
