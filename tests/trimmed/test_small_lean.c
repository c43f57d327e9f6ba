/* The least that boxes and polygons that turn, rub and bounce take (small_lean.h): it refuses what it lacks, and does the rest. */
# include "small_yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

void setUp(void) { open_floor(); }
void tearDown(void) {}

static void refuses(const yard_def *def)
{
    const cairn_body_model *model = keep_model(model_of(def));
    ASSERT_REFUSED_ID(CAIRN_ERROR_KIND, cairn_body_create(world, model, def->position, 0));
}

void test_what_enables_a_feature_is_refused(void)
{
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_springs_enable(world, &coils));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_quadtree_enable(world, &tree, at(0, 0), 6, 6));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_blocks_enable(world, &blocks));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_sleep_enable(world));
    assert_other_solvers_are_refused();
    keep_yard();
    TEST_ASSERT_NULL(cairn_world_init_with(&yard, at(0, 0), &cairn_solver_small, &cairn_continuous));
    assert_yard_kept();
}

void test_models_that_ask_for_what_is_left_out_are_refused(void)
{
    yard_def def = def_at(&ball, 0, CAIRN_F(3));
    def.sensor = true;
    refuses(&def);
    def.sensor = false;
    def.fixed_position = true;
    refuses(&def);
    def.fixed_position = false;
    def.damping = CAIRN_F(1);
    refuses(&def);
    def.damping = 0;
    def.gravity_scale = 0;
    refuses(&def);
}

void test_settings_stay_what_they_are(void)
{
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_world_set_rate(world, CAIRN_F(50)));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_world_set_substeps(world, 4));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_world_set_push_out(world, CAIRN_F(1)));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_world_use_small_solver(world, 20));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_use_small_solver(world, 0));
    ASSERT_OK(cairn_world_set_rate(world, CAIRN_F(60)));
    ASSERT_OK(cairn_world_set_substeps(world, 1));
    ASSERT_OK(cairn_world_set_push_out(world, CAIRN_F(3)));
    ASSERT_OK(cairn_world_use_small_solver(world, 10));
    ASSERT_OK(cairn_world_set_slop(world, CAIRN_F(0.005)));
}

void test_a_projectile_flies_its_parabola(void)
{
    cairn_body_id id = put_moving(&ball, 0, CAIRN_F(9), CAIRN_F(3), CAIRN_F(1));
    run(60);
    ASSERT_NEAR_VEC2(4 * LSB, 3, 5, cairn_body_position(world, id));
}

void test_a_stack_stands(void) { assert_a_stack_stands(); }

void test_a_polygon_comes_to_rest_on_a_side(void)
{
    cairn_polygon stone;
    ASSERT_OK(cairn_polygon_init_regular(&stone, 6, CAIRN_F(1)));
    yard_def def = def_at(&stone.shape, 0, CAIRN_F(2));
    def.angle = CAIRN_DEGREES(10);
    cairn_body_id id = make(&def);
    run(600);
    ASSERT_NEAR(0.01, 0.8660, y_of(id));
    ASSERT_NEAR(0.001, 0, spin_of(id));
}

void test_half_the_velocity_is_left_after_a_bounce(void)
{
    yard_def def = def_at(&ball, 0, CAIRN_F(1));
    def.material = &rubber;
    def.velocity = at(0, CAIRN_F(-8));
    cairn_body_id id = make(&def);
    cairn_real most = 0;
    for (int i = 0; i < 20; i++) {
        run(1);
        most = vy_of(id) > most ? vy_of(id) : most;
    }
    ASSERT_NEAR(0.3, 4.2, most); /* 8.5 m/s when it gets there */
}
