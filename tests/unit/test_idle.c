/* Contacts that do nothing in a step: which those are, and that leaving them out changes nothing. */
# include "../../src/engine.h"
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape disc = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(60), CAIRN_F(1));

void setUp(void) { open_yard(0); }
void tearDown(void) {}

static cairn_arbiter *arbiter_at(uint16_t place) { return &world->arbiters[world->order[place]]; }
static bool works(uint16_t place) { return (arbiter_at(place)->flags & CAIRN_ARBITER_SOLVED) != 0; }

void test_what_parts_is_left_out(void)
{
    cairn_body_id left = put_moving(&disc, 0, 0, CAIRN_F(-0.05), 0), right = put_moving(&disc, CAIRN_F(1), 0, CAIRN_F(0.05), 0);
    for (int i = 0; i < 3; i++) {
        run(1);
        TEST_ASSERT_EQUAL_UINT16(1, world->arbiter_count);
        TEST_ASSERT_FALSE(works(0));
        TEST_ASSERT_FALSE(world->bodies[left.index - 1].flags & CAIRN_BODY_GOES);
    }
    ASSERT_NEAR(LSB, 0.1, vx_of(right) - vx_of(left));
    ASSERT_NEAR(2 * LSB, 1.005, x_of(right) - x_of(left));
}

void test_what_falls_together_and_does_not_meet_is_left_out(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, cairn_vec2_of(0, CAIRN_F(-10))));
    cairn_body_id lower = put(&box, 0, 0), upper = put(&box, 0, CAIRN_F(1.004));
    run(30);
    TEST_ASSERT_EQUAL_UINT16(1, world->arbiter_count);
    TEST_ASSERT_FALSE(works(0));
    ASSERT_NEAR(LSB, 1.004, y_of(upper) - y_of(lower));
}

void test_what_nears_is_left_out_until_the_step_in_which_it_meets(void)
{
    cairn_body_id left = put(&disc, 0, 0), right = put_moving(&disc, CAIRN_F(1.004), 0, CAIRN_F(-0.06), 0); /* 1 mm a step */
    int out = 0;
    for (run(1); !works(0) && out < 8; run(1)) {
        out++;
    }
    TEST_ASSERT_TRUE(out >= 2 && out <= 3);
    ASSERT_NEAR(0.001, -0.03, vx_of(left));
    ASSERT_NEAR(0.001, -0.03, vx_of(right));
    ASSERT_NEAR(0.0001, 1, x_of(right) - x_of(left));
}

void test_what_lies_on_something_works(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, cairn_vec2_of(0, CAIRN_F(-10))));
    put_static(&ground, 0, CAIRN_F(-0.5));
    put(&box, 0, CAIRN_F(0.5));
    run(10);
    TEST_ASSERT_TRUE(works(0));
}

void test_what_lies_too_deep_is_pushed_out(void)
{
    cairn_body_id left = put(&disc, 0, 0), right = put_moving(&disc, CAIRN_F(0.99), 0, CAIRN_F(0.05), 0);
    run(1);
    TEST_ASSERT_TRUE(works(0));
    run(20);
    TEST_ASSERT_TRUE(x_of(right) - x_of(left) > CAIRN_F(0.998));
}

/* The first of three would be left out: but the second is struck by the third. */
void test_what_works_rouses_what_its_bodies_touch(void)
{
    cairn_body_id first = put(&disc, 0, 0);
    put(&disc, CAIRN_F(1.0001), 0);
    put_moving(&disc, CAIRN_F(2.002), 0, CAIRN_F(-1), 0);
    run(3);
    TEST_ASSERT_EQUAL_UINT16(2, world->arbiter_count);
    TEST_ASSERT_TRUE(works(0));
    TEST_ASSERT_TRUE(vx_of(first) < CAIRN_F(-0.2));
}

/* And of a row that is struck at its other end all are roused, in whichever order they lie. */
void test_a_blow_goes_through_a_row(void)
{
    cairn_body_id row[5];
    for (int i = 0; i < 5; i++) {
        row[i] = put(&disc, i * CAIRN_F(1.0001), 0);
    }
    run(2);
    TEST_ASSERT_FALSE(works(0));
    put_moving(&disc, CAIRN_F(5.02), 0, CAIRN_F(-2), 0);
    run(4);
    TEST_ASSERT_TRUE(works(0));
    TEST_ASSERT_TRUE(vx_of(row[0]) < CAIRN_F(-0.1));
}

void test_what_a_force_acts_on_is_looked_at(void)
{
    cairn_body_id left = put(&disc, 0, 0), right = put(&disc, CAIRN_F(1), 0);
    run(1);
    TEST_ASSERT_FALSE(works(0));
    ASSERT_OK(cairn_body_apply_force(world, right, cairn_vec2_of(CAIRN_F(-10), 0)));
    run(1);
    TEST_ASSERT_TRUE(works(0));
    TEST_ASSERT_TRUE(vx_of(left) < 0);
}

void test_what_is_damped_is_looked_at(void)
{
    cairn_body_id left = put(&disc, 0, 0);
    put(&disc, CAIRN_F(1), 0);
    cairn_body_model model = model_now(left);
    model.damping = CAIRN_F(1);
    ASSERT_OK(cairn_body_set_model(world, left, keep_model(model)));
    run(1);
    TEST_ASSERT_TRUE(works(0));
}

void test_two_points_that_hang_are_left_out_and_do_not_touch(void)
{
    put(&box, 0, 0);
    put(&box, CAIRN_F(1.003), 0);
    run(4);
    TEST_ASSERT_EQUAL_UINT8(2, arbiter_at(0)->count);
    TEST_ASSERT_FALSE(works(0));
    TEST_ASSERT_FALSE(arbiter_at(0)->flags & CAIRN_ARBITER_TOUCHING);
}
