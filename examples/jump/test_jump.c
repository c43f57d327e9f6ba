/* A game's rule tested without physics: cairn::mock plays the engine and checks what the game asks of it. */
#include "jump.h"

#include "mock_cairn_arbiter.h"
#include "mock_cairn_body.h"
#include "unity.h"

static cairn_world world;
static const cairn_body_id player = {1, 1};
static cairn_body_id floor_body = {2, 1};
static cairn_body_id coin = {3, 1};

static void player_touches(cairn_body_id *body)
{
    cairn_body_next_touched_ExpectAndReturn(&world, player, NULL, NULL, true);
    cairn_body_next_touched_IgnoreArg_cursor();
    cairn_body_next_touched_IgnoreArg_other();
    cairn_body_next_touched_ReturnThruPtr_other(body);
}

static void player_touches_nothing_more(void)
{
    cairn_body_next_touched_ExpectAndReturn(&world, player, NULL, NULL, false);
    cairn_body_next_touched_IgnoreArg_cursor();
    cairn_body_next_touched_IgnoreArg_other();
}

void test_player_on_the_floor_jumps(void)
{
    player_touches(&floor_body);
    cairn_body_is_sensor_ExpectAndReturn(&world, floor_body, false);
    cairn_body_apply_impulse_ExpectAndReturn(&world, player, cairn_vec2_of(0, JUMP_IMPULSE), CAIRN_OK);
    TEST_ASSERT_TRUE(jump(&world, player));
}

void test_player_in_the_air_does_not_jump(void)
{
    player_touches_nothing_more();
    TEST_ASSERT_FALSE(jump(&world, player));
}

void test_a_coin_in_the_air_is_no_ground(void)
{
    player_touches(&coin);
    cairn_body_is_sensor_ExpectAndReturn(&world, coin, true);
    player_touches_nothing_more();
    TEST_ASSERT_FALSE(jump(&world, player));
}

void test_a_player_that_is_gone_does_not_jump(void)
{
    player_touches(&floor_body);
    cairn_body_is_sensor_ExpectAndReturn(&world, floor_body, false);
    cairn_body_apply_impulse_ExpectAndReturn(&world, player, cairn_vec2_of(0, JUMP_IMPULSE), CAIRN_ERROR_STALE);
    TEST_ASSERT_FALSE(jump(&world, player));
}
