/* Heavy bodies on light ones: they stand, impacts keep momentum, and blocks come and go without harm. */
#define YARD_ARBITERS 48
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

#include <cairn/block.h>
#include <cairn/sleep.h>
#include <cairn/solver.h>

static const cairn_shape ground = CAIRN_BOX(CAIRN_F(60), CAIRN_F(1));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape plank = CAIRN_BOX(CAIRN_F(5), CAIRN_F(0.5));
static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));

CAIRN_BLOCKS(block_memory);

static void open_with_ground(void)
{
    open_yard(CAIRN_F(-10));
    ASSERT_OK(cairn_blocks_enable(world, &block_memory));
    put_static(&ground, 0, CAIRN_F(-0.5));
}

void setUp(void) { open_with_ground(); }
void tearDown(void) {}

static cairn_body_id put_heavy(const cairn_shape *shape, cairn_real x, cairn_real y, int32_t density)
{
    yard_def def = def_at(shape, x, y);
    def.density = cairn_wide_from_int(density);
    return make(&def);
}

static int arbiters_in_blocks(void)
{
    int count = 0;
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        count += (world->arbiters[world->order[place]].block & 127) != 0;
    }
    return count;
}

static int arbiters_with_exponents(void)
{
    int count = 0;
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        const cairn_arbiter *arbiter = &world->arbiters[world->order[place]];
        count += (arbiter->block & 127) != 0 && arbiter->past.block.exponent != 0;
    }
    return count;
}

static void assert_column_stands(int32_t ratio, cairn_real offset)
{
    open_with_ground();
    cairn_body_id light = put(&box, 0, CAIRN_F(0.5)), heavy = put_heavy(&box, offset, CAIRN_F(1.5), ratio);
    run(300);
    ASSERT_NEAR(0.001, 0.5, y_of(light));
    ASSERT_NEAR(0.001, 1.5, y_of(heavy));
    ASSERT_NEAR(0.001, 0, x_of(light));
    ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_velocity(world, light));
    ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_velocity(world, heavy));
}

void test_a_heavy_box_stands_on_a_light_one_and_comes_to_rest(void)
{
    assert_column_stands(100, 0);
    assert_column_stands(10000, CAIRN_F(0.3));
    assert_column_stands(100000, CAIRN_F(-0.3));
}

void test_a_ratio_that_the_sweeps_can_do_makes_no_block(void)
{
    put(&box, 0, CAIRN_F(0.5));
    put_heavy(&box, 0, CAIRN_F(1.5), 29);
    run(10);
    TEST_ASSERT_EQUAL_INT(0, world->blocks);
}

void test_a_light_body_alone_with_a_heavy_one_makes_no_block(void)
{
    put_heavy(&box, 0, CAIRN_F(0.5), 1000);
    put(&box, 0, CAIRN_F(1.5));
    run(10);
    TEST_ASSERT_EQUAL_INT(0, arbiters_in_blocks());
}

void test_light_neighbours_belong_to_the_block(void)
{
    put(&box, 0, CAIRN_F(0.5));
    put(&box, 0, CAIRN_F(1.5));
    put_heavy(&box, 0, CAIRN_F(2.5), 1000);
    put_heavy(&box, 0, CAIRN_F(3.5), 1000);
    run(10);
    TEST_ASSERT_EQUAL_INT(1, world->blocks);
    TEST_ASSERT_EQUAL_INT(3, arbiters_in_blocks());
}

/* The second contact is heavier loaded and reaches the first one's block. */
void test_a_block_takes_in_what_it_reaches(void)
{
    put_heavy(&box, 0, CAIRN_F(1.5), 40);
    put(&box, 0, CAIRN_F(0.5));
    put_heavy(&box, 0, CAIRN_F(2.5), 4000);
    run(10);
    TEST_ASSERT_EQUAL_INT(1, world->blocks > 0 ? arbiters_in_blocks() / 3 : 0);
}

void test_the_legs_of_a_table_are_blocks_of_their_own(void)
{
    static const cairn_shape leg = CAIRN_BOX(CAIRN_F(0.5), CAIRN_F(1));
    cairn_body_id legs[5];
    for (int i = 0; i < 5; i++) {
        legs[i] = put(&leg, CAIRN_F(1) * (i - 2), CAIRN_F(0.5));
    }
    cairn_body_id top = put_heavy(&plank, 0, CAIRN_F(1.25), 2000);
    run(120);
    TEST_ASSERT_EQUAL_INT(5, world->blocks);
    ASSERT_NEAR(0.001, 1.25, y_of(top));
    for (int i = 0; i < 5; i++) {
        ASSERT_NEAR(0.001, 0.5, y_of(legs[i]));
    }
}

/* Five light boxes side by side: 14 contacts. */
void test_a_block_without_room_is_dissolved_as_a_whole(void)
{
    for (int i = 0; i < 5; i++) {
        put(&box, CAIRN_F(1) * (i - 2), CAIRN_F(0.5));
    }
    cairn_body_id top = put_heavy(&plank, 0, CAIRN_F(1.25), 20);
    run(60);
    TEST_ASSERT_EQUAL_INT(0, world->blocks);
    TEST_ASSERT_EQUAL_INT(0, arbiters_in_blocks());
    ASSERT_NEAR(0.02, 1.25, y_of(top));
}

void test_a_ratio_beyond_all_others_is_left_to_the_sweeps(void)
{
    put(&box, 0, CAIRN_F(0.5));
    put_heavy(&box, 0, CAIRN_F(1.5), 1000000);
    run(2);
    TEST_ASSERT_EQUAL_INT(0, arbiters_in_blocks());
}

void test_a_block_ends_when_its_load_is_gone(void)
{
    cairn_body_id light = put(&box, 0, CAIRN_F(0.5)), heavy = put_heavy(&box, 0, CAIRN_F(1.5), 100000);
    run(30);
    TEST_ASSERT_EQUAL_INT(2, arbiters_in_blocks());
    ASSERT_OK(cairn_body_destroy(world, heavy));
    run(60);
    TEST_ASSERT_EQUAL_INT(0, world->blocks);
    TEST_ASSERT_EQUAL_INT(0, arbiters_with_exponents());
    ASSERT_NEAR(0.001, 0.5, y_of(light));
    ASSERT_NEAR_VEC2(0.001, 0, 0, cairn_body_velocity(world, light));
}

void test_a_block_may_grow_while_it_stands(void)
{
    cairn_body_id light = put(&box, 0, CAIRN_F(0.5)), heavy = put_heavy(&box, 0, CAIRN_F(1.5), 1000);
    run(60);
    cairn_body_id second = put(&box, CAIRN_F(0.2), CAIRN_F(2.5)), third = put_heavy(&box, 0, CAIRN_F(3.5), 1000);
    run(240);
    ASSERT_NEAR(0.001, 0.5, y_of(light));
    ASSERT_NEAR(0.001, 1.5, y_of(heavy));
    ASSERT_NEAR(0.001, 2.5, y_of(second));
    ASSERT_NEAR(0.002, 3.5, y_of(third));
}

void test_contacts_of_a_block_tell_the_load(void)
{
    cairn_contact contact;
    cairn_body_id light = put(&box, 0, CAIRN_F(0.5)), heavy = put_heavy(&box, 0, CAIRN_F(1.5), 24000);
    run(240);
    TEST_ASSERT_TRUE(contact_of(light, heavy, &contact));
    ASSERT_NEAR(1, 1000, contact.points[0].impulse + contact.points[1].impulse); /* m g h of a sub-step */
#ifndef CAIRN_DOUBLE
    TEST_ASSERT_TRUE(arbiters_with_exponents() > 0);
#endif
}

void test_members_may_be_unable_to_turn(void)
{
    yard_def def = def_at(&box, 0, CAIRN_F(0.5));
    def.fixed_rotation = true;
    cairn_body_id light = make(&def), heavy = put_heavy(&box, CAIRN_F(0.3), CAIRN_F(1.5), 10000);
    run(240);
    ASSERT_NEAR(0.001, 0.5, y_of(light));
    ASSERT_NEAR(0.001, 1.5, y_of(heavy));
    ASSERT_SAME(0, turned(light));
}

void test_members_may_be_unable_to_move(void)
{
    yard_def def = def_at(&ball, 0, CAIRN_F(3));
    def.fixed_position = true;
    cairn_body_id pivot = make(&def);
    cairn_body_id heavy = put_heavy(&ball, CAIRN_F(0.6), CAIRN_F(3.8), 10000);
    cairn_body_id other = put_heavy(&ball, CAIRN_F(-0.6), CAIRN_F(3.8), 10000);
    run(20);
    ASSERT_NEAR_VEC2(0, 0, 3, cairn_body_position(world, pivot));
    TEST_ASSERT_TRUE(x_of(heavy) > CAIRN_F(0.6));
    TEST_ASSERT_TRUE(x_of(other) < CAIRN_F(-0.6));
    TEST_ASSERT_TRUE(y_of(heavy) > CAIRN_F(2));
}

void test_a_platform_lifts_a_heavy_box_on_a_light_one(void)
{
    yard_def def = def_at(&plank, 0, CAIRN_F(1));
    def.type = CAIRN_KINEMATIC;
    def.velocity = at(CAIRN_F(0.5), CAIRN_F(1));
    cairn_body_id lift = make(&def), light = put(&box, 0, CAIRN_F(1.75)), heavy = put_heavy(&box, 0, CAIRN_F(2.75), 10000);
    run(120);
    ASSERT_NEAR(0.002, 1.75, y_of(heavy) - y_of(lift));
    ASSERT_NEAR(0.01, 1, vy_of(light));
    ASSERT_NEAR(0.05, 0, x_of(light) - x_of(lift));
}

/* One strikes two in a row: the pair that touches is a block. */
void test_impacts_keep_momentum_and_leave_together_without_restitution(void)
{
    open_yard(0);
    ASSERT_OK(cairn_blocks_enable(world, &block_memory));
    yard_def def = def_at(&box, 0, 0);
    def.velocity = at(CAIRN_F(3), 0);
    def.density = cairn_wide_from_int(1000);
    cairn_body_id heavy = make(&def), near = put(&box, CAIRN_F(1.2), 0), far = put(&box, CAIRN_F(2.2), 0);
    run(60);
    ASSERT_NEAR(0.001, 2.994012, vx_of(heavy)); /* 3 * 1000 / 1002 */
    ASSERT_NEAR(0.001, 2.994012, vx_of(near));
    ASSERT_NEAR(0.001, 2.994012, vx_of(far));
    ASSERT_NEAR(0.001, 0, cairn_body_velocity(world, far).y);
}

void test_a_heavy_box_dropped_on_a_light_one_throws_nothing(void)
{
    cairn_body_id light = put(&box, 0, CAIRN_F(0.5));
    yard_def def = def_at(&box, CAIRN_F(0.2), CAIRN_F(4));
    def.density = cairn_wide_from_int(10000);
    def.angle = CAIRN_DEGREES(20);
    cairn_body_id heavy = make(&def);
    for (int i = 0; i < 240; i++) {
        run(1);
        TEST_ASSERT_TRUE(size_of(vx_of(light)) < CAIRN_F(16));
        TEST_ASSERT_TRUE(y_of(light) > CAIRN_F(0.4));
    }
    TEST_ASSERT_TRUE(size_of(vx_of(heavy)) < CAIRN_F(0.01));
}

void test_what_slept_in_a_block_goes_on_standing(void)
{
    cairn_body_id light = put(&box, 0, CAIRN_F(0.5)), heavy = put_heavy(&box, 0, CAIRN_F(1.5), 10000);
    ASSERT_OK(cairn_sleep_enable(world));
    run(120);
    TEST_ASSERT_FALSE(cairn_body_is_awake(world, heavy));
    ASSERT_OK(cairn_body_wake(world, light));
    run(20);
    ASSERT_NEAR(0.001, 0.5, y_of(light));
    ASSERT_NEAR(0.001, 1.5, y_of(heavy));
}

void test_the_slides_solver_finds_no_blocks_left(void)
{
    put(&box, 0, CAIRN_F(0.5));
    put_heavy(&box, 0, CAIRN_F(1.5), 100000);
    run(30);
    ASSERT_OK(cairn_world_use_slides_solver(world, 10));
    TEST_ASSERT_EQUAL_INT(0, arbiters_in_blocks());
    TEST_ASSERT_EQUAL_INT(0, arbiters_with_exponents());
    run(1);
}

void test_blocks_need_a_world_and_memory(void)
{
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_blocks_enable(NULL, &block_memory));
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_blocks_enable(world, NULL));
}

void test_blocks_may_be_enabled_on_a_column_that_stands_already(void)
{
    open_yard(CAIRN_F(-10));
    put_static(&ground, 0, CAIRN_F(-0.5));
    cairn_body_id light = put(&box, 0, CAIRN_F(0.5));
    put_heavy(&box, 0, CAIRN_F(1.5), 100);
    run(30);
    TEST_ASSERT_EQUAL_INT(0, arbiters_in_blocks());
    ASSERT_OK(cairn_blocks_enable(world, &block_memory));
    run(60);
    TEST_ASSERT_EQUAL_INT(2, arbiters_in_blocks());
    ASSERT_NEAR(0.001, 0.5, y_of(light));
}

void test_a_world_without_blocks_leaves_all_to_the_sweeps(void)
{
    open_yard(CAIRN_F(-10));
    put_static(&ground, 0, CAIRN_F(-0.5));
    cairn_body_id light = put(&box, 0, CAIRN_F(0.5));
    put_heavy(&box, 0, CAIRN_F(1.5), 100);
    run(60);
    TEST_ASSERT_EQUAL_INT(0, world->blocks);
    TEST_ASSERT_TRUE(y_of(light) < CAIRN_F(0.499));
}

/* Numbers in no order, the same on every target. */
static uint32_t lot(uint32_t *state, uint32_t below)
{
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) % below;
}

/* Masses over seven decades, elastic ones too: blocks come, grow and go in every step. */
void test_violent_scenes_of_all_masses_stay_in_bounds(void)
{
    static const cairn_material bouncing = CAIRN_MATERIAL_BOUNCING(0.5, 0.3, 0.6, 0.2);
    static const cairn_shape wall = CAIRN_BOX(CAIRN_F(1), CAIRN_F(30)), slate = CAIRN_BOX(CAIRN_F(0.6), CAIRN_F(0.3));
    int blocks = 0;
    for (uint32_t seed = 1; seed < 7; seed++) {
        uint32_t state = seed;
        open_with_ground();
        put_static(&wall, CAIRN_F(-3), CAIRN_F(15));
        put_static(&wall, CAIRN_F(3), CAIRN_F(15));
        for (int i = 0; i < 12; i++) {
            int32_t density = 1;
            cairn_real x = CAIRN_F(-2) + CAIRN_F(0.5) * (int32_t)lot(&state, 8), y = CAIRN_F(1) + CAIRN_F(0.75) * i;
            yard_def def = def_at(i % 3 == 0 ? &ball : i % 3 == 1 ? &box : &slate, x, y);
            for (uint32_t decades = lot(&state, 8); decades > 0; decades--) {
                density *= 10;
            }
            def.density = cairn_wide_from_int(density);
            def.angle = CAIRN_DEGREES(5) * (int32_t)lot(&state, 36);
            def.velocity = at(CAIRN_F(1) * ((int32_t)lot(&state, 21) - 10), CAIRN_F(-1) * (int32_t)lot(&state, 20));
            def.material = seed % 2 == 0 ? &bouncing : def.material;
            make(&def);
        }
        for (int step = 0; step < 100; step++) {
            run(1);
            blocks += world->blocks;
        }
        for (cairn_body_id id = cairn_world_next_body(world, cairn_body_id_null()); !cairn_body_id_is_null(id);
             id = cairn_world_next_body(world, id)) {
            TEST_ASSERT_TRUE(size_of(x_of(id)) < CAIRN_F(1000));
            TEST_ASSERT_TRUE(size_of(y_of(id)) < CAIRN_F(1000));
        }
    }
    TEST_ASSERT_TRUE(blocks > 0);
}
