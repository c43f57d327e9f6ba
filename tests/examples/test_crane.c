/* The balloon and its rope, without physics: cairn::mock plays the engine. */
#include "crane.h"

#include "mock_cairn_body.h"
#include "mock_cairn_shape.h"
#include "mock_cairn_spring.h"
#include "mock_cairn_arbiter.h"
#include "unity.h"

#include <string.h>

static cairn_world world;
static const cairn_body_id trolley = {1, 1}, body = {2, 1};
static const cairn_spring_id rope = {1, 1};
static crane c;
static stone s;

static cairn_vec2 asked_velocity;
static cairn_real asked_turning;

static cairn_status note_velocity(cairn_world *w, cairn_body_id id, cairn_vec2 v, int calls)
{
    (void)w;
    (void)id;
    (void)calls;
    asked_velocity = v;
    return CAIRN_OK;
}

static cairn_status note_turning(cairn_world *w, cairn_body_id id, cairn_real speed, int calls)
{
    (void)w;
    (void)id;
    (void)calls;
    asked_turning = speed;
    return CAIRN_OK;
}

static cairn_status note_model(cairn_world *w, cairn_body_id id, const cairn_body_model *model, int calls)
{
    (void)w;
    (void)id;
    (void)model;
    (void)calls;
    return CAIRN_OK;
}

void setUp(void)
{
    memset(&c, 0, sizeof c);
    memset(&s, 0, sizeof s);
    c.trolley = trolley;
    cairn_body_set_velocity_StubWithCallback(note_velocity);
    cairn_body_set_angular_velocity_StubWithCallback(note_turning);
    cairn_body_set_model_StubWithCallback(note_model);
}

static void trolley_is(cairn_real x, cairn_real y, cairn_real vx)
{
    cairn_body_position_ExpectAndReturn(&world, trolley, cairn_vec2_of(x, y));
    cairn_body_velocity_ExpectAndReturn(&world, trolley, cairn_vec2_of(vx, 0));
}

static void hang(void)
{
    s.body = body;
    s.state = STONE_HANGING;
    c.load = &s;
    c.rope = rope;
}

static crane_wish wish(int move, int turn)
{
    const crane_wish w = {(int8_t)move, (int8_t)turn};
    return w;
}

void test_it_gains_speed_step_by_step(void)
{
    trolley_is(0, CAIRN_F(2), 0);
    crane_step(&c, &world, wish(1, 0), CAIRN_F(2), 0);
    TEST_ASSERT_EQUAL(CAIRN_F(0.16), asked_velocity.x);
    trolley_is(0, CAIRN_F(2), CAIRN_F(2.4));
    crane_step(&c, &world, wish(1, 0), CAIRN_F(2), 0);
    TEST_ASSERT_EQUAL(CAIRN_F(2.4), asked_velocity.x);
}

void test_it_stops_at_the_end_of_its_reach_and_may_come_back(void)
{
    trolley_is(CAIRN_F(3.6), CAIRN_F(2), CAIRN_F(2));
    crane_step(&c, &world, wish(1, 0), CAIRN_F(2), 0);
    TEST_ASSERT_EQUAL(0, asked_velocity.x);
    trolley_is(CAIRN_F(3.6), CAIRN_F(2), 0);
    crane_step(&c, &world, wish(-1, 0), CAIRN_F(2), 0);
    TEST_ASSERT_TRUE(asked_velocity.x < 0);
}

void test_it_rises_with_the_cairn(void)
{
    trolley_is(0, CAIRN_F(2), 0);
    crane_step(&c, &world, wish(0, 0), CAIRN_F(3), 0);
    TEST_ASSERT_TRUE(asked_velocity.y > 0);
    trolley_is(0, CAIRN_F(3), 0);
    crane_step(&c, &world, wish(0, 0), CAIRN_F(2), 0);
    TEST_ASSERT_TRUE(asked_velocity.y < 0);
}

void test_what_hangs_turns_and_is_blown_by_its_mass(void)
{
    hang();
    trolley_is(0, CAIRN_F(2), 0);
    cairn_body_mass_ExpectAndReturn(&world, body, cairn_wide_from_int(3));
    cairn_body_apply_force_ExpectAndReturn(&world, body, cairn_vec2_of(CAIRN_F(6), 0), CAIRN_OK);
    crane_step(&c, &world, wish(0, -1), CAIRN_F(2), CAIRN_F(2));
    TEST_ASSERT_EQUAL(CAIRN_F(-2.2), asked_turning);
}

void test_no_wind_is_no_force(void)
{
    hang();
    trolley_is(0, CAIRN_F(2), 0);
    crane_step(&c, &world, wish(0, 0), CAIRN_F(2), 0);
    TEST_ASSERT_EQUAL(0, asked_turning);
}

void test_dropping_cuts_the_rope_and_gives_the_stone_back(void)
{
    hang();
    cairn_spring_destroy_ExpectAndReturn(&world, rope, CAIRN_OK);
    TEST_ASSERT_EQUAL_PTR(&s, crane_drop(&c, &world));
    TEST_ASSERT_EQUAL(STONE_FALLING, s.state);
    TEST_ASSERT_NULL(crane_drop(&c, &world));
}

void test_a_stone_hangs_a_rope_below(void)
{
    cairn_body_position_ExpectAndReturn(&world, trolley, cairn_vec2_of(CAIRN_F(1), CAIRN_F(5)));
    cairn_body_create_ExpectAndReturn(&world, NULL, cairn_vec2_of(CAIRN_F(1), CAIRN_F(4)), 5, body);
    cairn_body_create_IgnoreArg_model();
    cairn_spring_tune_IgnoreAndReturn(CAIRN_OK);
    cairn_spring_create_IgnoreAndReturn(rope);
    TEST_ASSERT_TRUE(crane_hang(&c, &world, &s, 5));
    TEST_ASSERT_EQUAL(STONE_HANGING, s.state);
    TEST_ASSERT_EQUAL_PTR(&s, c.load);
}

void test_without_room_for_a_body_nothing_hangs(void)
{
    cairn_body_position_ExpectAndReturn(&world, trolley, cairn_vec2_of(0, 0));
    cairn_body_create_IgnoreAndReturn(cairn_body_id_null());
    TEST_ASSERT_FALSE(crane_hang(&c, &world, &s, 5));
    TEST_ASSERT_NULL(c.load);
}

void test_without_room_for_a_rope_the_stone_is_taken_out_again(void)
{
    cairn_body_position_ExpectAndReturn(&world, trolley, cairn_vec2_of(0, 0));
    cairn_body_create_IgnoreAndReturn(body);
    cairn_spring_tune_IgnoreAndReturn(CAIRN_OK);
    cairn_spring_create_IgnoreAndReturn(cairn_spring_id_null());
    cairn_body_destroy_ExpectAndReturn(&world, body, CAIRN_OK);
    TEST_ASSERT_FALSE(crane_hang(&c, &world, &s, 5));
    TEST_ASSERT_EQUAL(STONE_NONE, s.state);
}
