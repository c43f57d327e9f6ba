/* A build without what makes the engine quick and tall stacks stand (lean.h): the physics is all there. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */
# include "../support/test_number.h"

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape crate = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape floor_shape = CAIRN_BOX(CAIRN_F(40), CAIRN_F(1));

void setUp(void)
{
    open_yard(CAIRN_F(-10));
    put_static(&floor_shape, 0, CAIRN_F(-0.5));
}
void tearDown(void) {}

void test_a_stack_stands(void)
{
    cairn_body_id ids[10];
    for (int i = 0; i < 10; i++) {
        ids[i] = put(&crate, CAIRN_F(0.05 * (i % 2)), CAIRN_F(0.5 + i));
    }
    run(1200);
    for (int i = 0; i < 10; i++) {
        ASSERT_NEAR(0.02, 0.05 * (i % 2), cairn_body_position(world, ids[i]).x);
        ASSERT_NEAR(0.02, 0.5 + i, cairn_body_position(world, ids[i]).y);
    }
}

void test_what_only_falls_goes_along_a_parabola(void)
{
    cairn_body_id id = put_moving(&ball, CAIRN_F(-5), CAIRN_F(8), CAIRN_F(2), 0), other = put(&ball, CAIRN_F(3), CAIRN_F(8));
    run(60);
    ASSERT_NEAR(0.0002, -3, cairn_body_position(world, id).x);
    ASSERT_NEAR(0.0002, 3, cairn_body_position(world, id).y);
    ASSERT_NEAR(0.0002, 3, cairn_body_position(world, other).y);
}

void test_a_ball_rolls_into_another_one_and_both_come_to_rest(void)
{
    cairn_body_id a = put_moving(&ball, CAIRN_F(-2), CAIRN_F(0.5), CAIRN_F(2), 0), b = put(&ball, 0, CAIRN_F(0.5));
    run(120);
    TEST_ASSERT_TRUE(cairn_body_position(world, b).x > CAIRN_F(0.5));
    TEST_ASSERT_TRUE(cairn_body_position(world, a).x < cairn_body_position(world, b).x - CAIRN_F(0.99));
    ASSERT_NEAR(0.005, 0.5, cairn_body_position(world, b).y);
}

/* Each of the links carries what hangs below it: m g n / k longer. */
void test_a_rope_hangs_as_long_as_its_weight_makes_it(void)
{
    enum { LINKS = 5 };
    CAIRN_SPRINGS(ropes, LINKS);
    cairn_body_id above = put_static(&ball, 0, CAIRN_F(8)), ids[LINKS];
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_springs_enable(world, &ropes));
    for (int i = 0; i < LINKS; i++) {
        ids[i] = put(&ball, 0, CAIRN_F(7 - i));
        cairn_spring_def def = cairn_spring_def_default(above, ids[i]);
        def.stiffness = cairn_wide_from_int(2000);
        def.damping = cairn_wide_from_int(40);
        def.no_contact = true;
        cairn_spring_create(world, &def);
        above = ids[i];
    }
    run(1200);
    double y = 8, weight = 10 * number_of_wide(cairn_body_mass(world, ids[0]));
    for (int i = 0; i < LINKS; i++) {
        y -= 1 + (LINKS - i) * weight / 2000;
        ASSERT_NEAR(0.002, y, cairn_body_position(world, ids[i]).y);
        ASSERT_NEAR(0.0002, 0, cairn_body_position(world, ids[i]).x);
    }
}
