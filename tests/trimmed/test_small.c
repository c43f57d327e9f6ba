/* A build whose only solver is the small one (small.h): it refuses the others, and has all else. */
# include "small_yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

void setUp(void) { open_floor(); }
void tearDown(void) {}

void test_other_solvers_are_refused(void) { assert_other_solvers_are_refused(); }

void test_what_belongs_to_the_soft_solver_is_refused(void)
{
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_blocks_enable(world, &blocks));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_world_set_substeps(world, 4));
    ASSERT_OK(cairn_world_set_substeps(world, 1));
}

void test_settings_may_change(void)
{
    ASSERT_OK(cairn_world_use_small_solver(world, 20));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_use_small_solver(world, 0));
    ASSERT_OK(cairn_world_set_rate(world, CAIRN_F(120)));
    ASSERT_OK(cairn_world_set_push_out(world, CAIRN_F(1)));
    cairn_body_id id = put_moving(&ball, 0, CAIRN_F(9), CAIRN_F(1), 0);
    run(120);
    ASSERT_NEAR_VEC2(4 * LSB, 1, 4, cairn_body_position(world, id));
}

void test_a_stack_stands(void) { assert_a_stack_stands(); }

void test_a_material_bounces_that_names_no_class(void)
{
    TEST_ASSERT_NULL(rubber.bounce);
    yard_def def = def_at(&ball, 0, CAIRN_F(1));
    def.material = &rubber;
    def.velocity = at(0, CAIRN_F(-8));
    def.gravity_scale = 0;
    cairn_body_id id = make(&def);
    run(20);
    ASSERT_NEAR(4 * LSB, 4, vy_of(id));
}

void test_the_other_features_are_there(void)
{
    ASSERT_OK(cairn_springs_enable(world, &coils));
    ASSERT_OK(cairn_quadtree_enable(world, &tree, at(0, 0), 6, 6));
    ASSERT_OK(cairn_sleep_enable(world));
    cairn_body_id hook = put_static(&ball, CAIRN_F(5), CAIRN_F(9)), load = put(&crate, CAIRN_F(5), CAIRN_F(7)), box = put(&crate, 0, CAIRN_F(0.5));
    yard_def def = def_at(&crate, CAIRN_F(-5), CAIRN_F(3));
    def.sensor = true;
    def.type = CAIRN_STATIC;
    cairn_body_id sensor = make(&def), falling = put(&ball, CAIRN_F(-5), CAIRN_F(5));
    cairn_spring_def coil = cairn_spring_def_default(hook, load);
    coil.stiffness = cairn_wide_from_int(100);
    coil.damping = cairn_wide_from_int(20);
    cairn_spring_id spring = cairn_spring_create(world, &coil);
    run(36); /* 1.8 m */
    TEST_ASSERT_TRUE(are_touching(sensor, falling));
    run(600);
    ASSERT_NEAR(0.001, 2.1, cairn_spring_length(world, spring));
    ASSERT_NEAR(0.01, 0.5, y_of(falling));
    ASSERT_NEAR(0.01, 0.5, y_of(box));
    TEST_ASSERT_FALSE(cairn_body_is_awake(world, box));
}
