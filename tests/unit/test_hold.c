/* Contacts at rest: rows that serve again, slips that are taken back, loads that no longer sink in. */
#define YARD_BODIES 24
#define YARD_ARBITERS 40
# include "../../src/engine.h"
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(60), CAIRN_F(1));

void setUp(void)
{
    open_yard(CAIRN_F(-10));
    put_static(&ground, 0, CAIRN_F(-0.5));
}
void tearDown(void) {}

static cairn_body_id stack(int count)
{
    cairn_body_id top = cairn_body_id_null();
    for (int i = 0; i < count; i++) {
        top = put(&box, 0, CAIRN_F(0.5) + i * CAIRN_F(1));
    }
    return top;
}

/* Its soft contacts would let it lean by 30 mm, and one of 23 fall. */
void test_a_stack_of_twenty_stands_straight_and_still(void)
{
    cairn_body_id top = stack(20);
    run(3600);
    ASSERT_NEAR(0.001, 0, x_of(top));
    ASSERT_NEAR(0.005, 19.5, y_of(top));
    ASSERT_NEAR(LSB, 0, vx_of(top));
}

/* The points of a contact take turns in coming first: else the boxes begin to turn the same way while their impulses are found. */
void test_a_heavy_column_settles_upright(void)
{
    cairn_world_set_gravity(world, (cairn_vec2){ 0, CAIRN_F(-900) });
    cairn_body_id top = stack(5);
    for (int i = 0; i < 60; i++) {
        run(1);
        ASSERT_NEAR(0.03, 0, x_of(top)); /* else 0.37 */
    }
}

void test_a_push_that_friction_stops_at_once_is_taken_back(void)
{
    cairn_body_id id = put(&box, 0, CAIRN_F(0.5));
    run(60);
    ASSERT_OK(cairn_body_set_velocity(world, id, at(CAIRN_F(0.08), 0)));
    run(2);
    TEST_ASSERT_TRUE(x_of(id) > CAIRN_F(0.0001));
    run(598);
    ASSERT_NEAR(0.00005, 0, x_of(id));
}

void test_a_box_that_slid_stays_where_it_stopped(void)
{
    cairn_body_id id = put(&box, 0, CAIRN_F(0.5));
    ASSERT_OK(cairn_body_set_velocity(world, id, at(CAIRN_F(2), 0)));
    run(60);
    cairn_real stopped = x_of(id);
    run(600);
    ASSERT_NEAR(0.0003, 0, x_of(id) - stopped);
}

void test_a_load_taken_away_throws_nothing_up(void)
{
    cairn_body_id light = put(&box, 0, CAIRN_F(0.5));
    yard_def def = def_at(&box, 0, CAIRN_F(1.5));
    def.density = cairn_wide_from_int(50);
    cairn_body_id heavy = make(&def);
    run(900);
    ASSERT_OK(cairn_body_destroy(world, heavy));
    for (int i = 0; i < 30; i++) {
        run(1);
        TEST_ASSERT_TRUE(y_of(light) < CAIRN_F(0.502));
    }
    run(300);
    ASSERT_NEAR(0.0002, 0.5, y_of(light));
}

void test_a_box_moved_by_the_game_is_not_pulled_back(void)
{
    cairn_body_id id = put(&box, 0, CAIRN_F(0.5));
    run(300);
    ASSERT_OK(cairn_body_set_transform(world, id, at(CAIRN_F(0.001), CAIRN_F(0.5)), 0));
    run(300);
    ASSERT_NEAR(0.00005, 0.001, x_of(id));
}

void test_a_box_on_the_edge_of_its_support_falls_when_that_moves_away(void)
{
    static const cairn_shape shelf = CAIRN_BOX(CAIRN_F(2), CAIRN_F(0.2));
    yard_def def = def_at(&shelf, CAIRN_F(-10), CAIRN_F(3));
    def.type = CAIRN_KINEMATIC;
    cairn_body_id support = make(&def), id = put(&box, CAIRN_F(-10), CAIRN_F(3.6));
    run(300);
    ASSERT_NEAR(0.001, 3.6, y_of(id));
    ASSERT_OK(cairn_body_set_velocity(world, support, at(0, CAIRN_F(-8))));
    run(1);
    ASSERT_OK(cairn_body_set_velocity(world, support, at(CAIRN_F(-20), 0)));
    run(120);
    ASSERT_NEAR(0.01, 0.5, y_of(id));
}

/* A rest that goes by absolute speeds would be left behind. */
void test_a_stack_on_a_slow_platform_goes_with_it(void)
{
    static const cairn_shape deck = CAIRN_BOX(CAIRN_F(4), CAIRN_F(0.5));
    yard_def def = def_at(&deck, 0, CAIRN_F(2));
    def.type = CAIRN_KINEMATIC;
    def.velocity = at(CAIRN_F(0.03), 0);
    cairn_body_id platform = make(&def);
    put(&box, 0, CAIRN_F(2.75));
    cairn_body_id top = put(&box, 0, CAIRN_F(3.75));
    run(600);
    ASSERT_NEAR(0.001, 0, x_of(top) - x_of(platform));
}

void test_a_stack_at_rest_outlives_a_change_of_the_substeps(void)
{
    cairn_body_id top = stack(6);
    run(300);
    ASSERT_OK(cairn_world_set_substeps(world, 8));
    run(300);
    ASSERT_OK(cairn_world_set_substeps(world, 2));
    run(300);
    ASSERT_NEAR(0.001, 0, x_of(top));
    ASSERT_NEAR(0.01, 5.5, y_of(top));
}

void test_a_world_with_an_allowed_penetration_looks_at_every_contact_anew(void)
{
    ASSERT_OK(cairn_world_set_slop(world, CAIRN_F(0.01)));
    cairn_body_id top = stack(4);
    run(600);
    ASSERT_NEAR(0.05, 3.5, y_of(top));
    ASSERT_NEAR(0.01, 0, x_of(top));
}

void test_a_heading_tells_small_turns_also_across_the_wrap(void)
{
    cairn_heading heading = cairn_heading_of(CAIRN_RADIANS(3.1415));
    TEST_ASSERT_TRUE(cairn_heading_is_near(heading, CAIRN_RADIANS(3.1410), CAIRN_RADIANS(0.001)));
    TEST_ASSERT_FALSE(cairn_heading_is_near(heading, CAIRN_RADIANS(3.1390), CAIRN_RADIANS(0.001)));
#ifndef CAIRN_DOUBLE
    TEST_ASSERT_TRUE(cairn_heading_is_near(heading, CAIRN_RADIANS(-3.1413), CAIRN_RADIANS(0.001)));
#endif
    TEST_ASSERT_FALSE(cairn_heading_is_near(heading, CAIRN_RADIANS(-3.1390), CAIRN_RADIANS(0.001)));
}

/* ---- contacts of one point ---- */

static const cairn_shape disc = CAIRN_CIRCLE(CAIRN_F(0.5));

void test_the_row_of_a_disc_at_rest_serves_until_the_disc_has_moved_by_two_millimetres(void)
{
    cairn_body_id id = put(&disc, 0, CAIRN_F(0.5));
    run(60);
    cairn_motion left = yard_arbiters[0].slip;
    TEST_ASSERT_TRUE(left < 0 && left > -CAIRN_MOTION(0.00201));
    ASSERT_OK(cairn_body_set_velocity(world, id, at(CAIRN_F(0.03), 0))); /* half a millimetre a step, less as it starts to roll */
    run(2);
    TEST_ASSERT_TRUE(yard_arbiters[0].slip > left && yard_arbiters[0].slip < 0);
    run(120);
    ASSERT_NEAR(0.002, 0.04, x_of(id)); /* two thirds of the way at first */
    ASSERT_NEAR(0.0001, 0.5, y_of(id));
}

void test_the_way_that_a_row_serves_goes_by_the_smaller_body(void)
{
    static const cairn_shape marble = CAIRN_CIRCLE(CAIRN_F(0.0256));
    put(&marble, 0, CAIRN_F(0.0256));
    run(1);
    TEST_ASSERT_TRUE(yard_arbiters[0].slip >= -CAIRN_MOTION(0.000101));
}

/* Kept rows do not hold back what rolls. */
void test_a_disc_rolls_off_another_one_as_if_it_was_looked_at_in_each_step(void)
{
    put_static(&disc, 0, CAIRN_F(0.5));
    cairn_body_id id = put(&disc, CAIRN_F(0.02), CAIRN_F(1.4998));
    run(30);
    /* angle = 0.02 cosh(sqrt(2/3 g / R) t), R = 1 m: 0.0391 m after half a second */
    ASSERT_NEAR(0.001, 0.0391, x_of(id));
    run(120);
    ASSERT_NEAR(0.001, 0.5, y_of(id));
}

void test_the_second_point_of_a_plank_that_is_let_down_slowly_is_seen_in_time(void)
{
    static const cairn_shape plank = CAIRN_BOX(CAIRN_F(4), CAIRN_F(0.2));
    yard_def def = def_at(&plank, 0, CAIRN_F(0.135));
    def.angle = CAIRN_RADIANS(0.0175); /* one end touches, the other is 7 cm up */
    cairn_body_id id = make(&def);
    for (int i = 0; i < 60; i++) {
        ASSERT_OK(cairn_body_set_angular_velocity(world, id, CAIRN_F(-0.02)));
        run(1);
        TEST_ASSERT_TRUE(y_of(id) > CAIRN_F(0.099));
    }
    run(60);
    ASSERT_NEAR(0.001, 0.1, y_of(id));
    TEST_ASSERT_EQUAL_UINT16(2, stats()->points);
}

void test_a_heap_of_discs_stands_and_comes_to_rest(void)
{
    cairn_body_id top = cairn_body_id_null();
    static const cairn_shape wall = CAIRN_BOX(CAIRN_F(0.2), CAIRN_F(4));
    put_static(&wall, CAIRN_F(-1.61), CAIRN_F(2));
    put_static(&wall, CAIRN_F(1.61), CAIRN_F(2));
    for (int row = 0; row < 3; row++) {
        for (int i = 0; i < 3 - row; i++) {
            top = put(&disc, CAIRN_F(0.5) * (2 * i - 2 + row), CAIRN_F(0.5) + row * CAIRN_F(0.867));
        }
    }
    run(900);
    ASSERT_NEAR(0.002, 0, x_of(top));
    ASSERT_NEAR(0.02, 2.232, y_of(top));
    ASSERT_NEAR(LSB, 0, vx_of(top));
}

void test_a_disc_driven_into_another_one_is_looked_at_anew(void)
{
    cairn_body_id left = put(&disc, 0, CAIRN_F(0.5)), right = put(&disc, CAIRN_F(1), CAIRN_F(0.5));
    run(120);
    ASSERT_OK(cairn_body_set_velocity(world, left, at(CAIRN_F(2), 0)));
    run(2);
    TEST_ASSERT_TRUE(vx_of(right) > CAIRN_F(0.4));
    TEST_ASSERT_TRUE(x_of(right) - x_of(left) > CAIRN_F(0.995));
}

/* Two crates that fall together, 8 mm from one another. */
static cairn_arbiter *fall_together(cairn_body_id *lower, cairn_body_id *upper)
{
    *lower = put(&box, 0, CAIRN_F(20));
    *upper = put(&box, 0, CAIRN_F(21.008));
    run(1);
    return &world->arbiters[world->order[0]];
}

/* Its rows are to be made anew. */
static bool is_doubted(const cairn_arbiter *arbiter) { return arbiter->path == CAIRN_PATH_NONE || (arbiter->path & CAIRN_PATH_DOUBTED) != 0; }

void test_crates_that_fall_together_keep_their_rows(void)
{
    cairn_body_id lower, upper;
    const cairn_arbiter *between = fall_together(&lower, &upper);
    run(20);
    TEST_ASSERT_EQUAL(1, world->arbiter_count);
    TEST_ASSERT_FALSE(is_doubted(between));
    TEST_ASSERT_EQUAL(0, between->path & CAIRN_PATH_FRESH);
    ASSERT_NEAR(0.0001, 1.008, y_of(upper) - y_of(lower));
}

void test_what_drifts_apart_while_it_falls_is_looked_at_anew(void)
{
    cairn_body_id lower, upper;
    const cairn_arbiter *between = fall_together(&lower, &upper);
    ASSERT_OK(cairn_body_set_velocity(world, upper, at(CAIRN_F(0.05), cairn_body_velocity(world, lower).y)));
    int anew = 0;
    for (int i = 0; i < 12; i++) { /* 10 mm */
        run(1);
        anew += is_doubted(between) ? 1 : 0;
    }
    TEST_ASSERT_TRUE(anew >= 2 && anew <= 6);
}

void test_crates_that_fell_together_land_on_one_another(void)
{
    cairn_body_id lower = put(&box, 0, CAIRN_F(0.51)), upper = put(&box, CAIRN_F(0.2), CAIRN_F(1.52));
    run(300);
    ASSERT_NEAR(0.001, 0.5, y_of(lower));
    ASSERT_NEAR(0.001, 1.5, y_of(upper));
    ASSERT_NEAR(0.001, 0.2, x_of(upper));
}

void test_crates_that_a_game_drives_together_in_the_air_are_looked_at_anew(void)
{
    cairn_body_id lower, upper;
    const cairn_arbiter *between = fall_together(&lower, &upper);
    ASSERT_OK(cairn_body_set_velocity(world, upper, at(0, CAIRN_F(-0.2))));
    run(1);
    TEST_ASSERT_TRUE(is_doubted(between) || between->rows[0].gap < CAIRN_MOTION(0.008));
    run(20);
    TEST_ASSERT_TRUE(y_of(upper) - y_of(lower) > CAIRN_F(0.999));
}
