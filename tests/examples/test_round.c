/* The rules of a level, without physics: the engine is a mock that says where the stones are. */
#include "round.h"

#include "mock_cairn_arbiter.h"
#include "mock_cairn_body.h"
#include "mock_cairn_quadtree.h"
#include "mock_cairn_shape.h"
#include "mock_cairn_sleep.h"
#include "mock_cairn_spring.h"
#include "mock_cairn_world.h"
#include "unity.h"

#include <string.h>

static cairn_world world;
static game_round r;
static score points;

/* What the mock's world is like: all stones are here, so fast, and touch something or not. */
static cairn_vec2 place, speed;
static bool touching, is_full, crane_is_low;
static uint16_t made;

static cairn_world *give_world(const cairn_world_storage *storage, cairn_vec2 gravity, const cairn_solver_class *solver,
                               const cairn_continuous_class *continuous, int calls)
{
    (void)storage, (void)gravity, (void)solver, (void)continuous, (void)calls;
    return &world;
}

static cairn_body_id give_body(cairn_world *w, const cairn_body_model *model, cairn_vec2 position, cairn_angle angle, int calls)
{
    const cairn_body_id id = {is_full ? 0 : ++made, 1};
    (void)w, (void)model, (void)position, (void)angle, (void)calls;
    return id;
}

static cairn_vec2 give_place(cairn_world *w, cairn_body_id id, int calls)
{
    (void)w, (void)calls;
    /* The balloon is always where it is wanted, but where a test says otherwise. */
    return id.index == r.crane.trolley.index && !crane_is_low ? cairn_vec2_of(0, r.crane_height) : place;
}

static cairn_vec2 give_speed(cairn_world *w, cairn_body_id id, int calls)
{
    (void)w, (void)id, (void)calls;
    return speed;
}

static bool give_touch(cairn_world *w, cairn_body_id id, int *cursor, cairn_body_id *other, int calls)
{
    (void)w, (void)id, (void)cursor, (void)other, (void)calls;
    return touching;
}

void setUp(void)
{
    const cairn_spring_id rope = {1, 1};
    made = 0;
    touching = false;
    is_full = false;
    crane_is_low = false;
    place = cairn_vec2_of(0, CAIRN_F(1));
    speed = cairn_vec2_of(0, 0);
    cairn_world_init_with_StubWithCallback(give_world);
    cairn_springs_enable_IgnoreAndReturn(CAIRN_OK);
    cairn_quadtree_enable_IgnoreAndReturn(CAIRN_OK);
    cairn_sleep_enable_IgnoreAndReturn(CAIRN_OK);
    cairn_world_step_IgnoreAndReturn(CAIRN_OK);
    cairn_world_hash_IgnoreAndReturn(1);
    cairn_polygon_init_IgnoreAndReturn(CAIRN_OK);
    cairn_body_create_StubWithCallback(give_body);
    cairn_body_destroy_IgnoreAndReturn(CAIRN_OK);
    cairn_body_position_StubWithCallback(give_place);
    cairn_body_center_StubWithCallback(give_place);
    cairn_body_velocity_StubWithCallback(give_speed);
    cairn_body_angle_IgnoreAndReturn(0);
    cairn_body_is_awake_IgnoreAndReturn(false);
    cairn_body_set_model_IgnoreAndReturn(CAIRN_OK);
    cairn_body_set_velocity_IgnoreAndReturn(CAIRN_OK);
    cairn_body_set_angular_velocity_IgnoreAndReturn(CAIRN_OK);
    cairn_body_mass_IgnoreAndReturn(cairn_wide_from_int(1));
    cairn_body_apply_force_IgnoreAndReturn(CAIRN_OK);
    cairn_body_next_touched_StubWithCallback(give_touch);
    cairn_spring_tune_IgnoreAndReturn(CAIRN_OK);
    cairn_spring_create_IgnoreAndReturn(rope);
    cairn_spring_destroy_IgnoreAndReturn(CAIRN_OK);
    points.best = 0;
    score_start(&points);
    round_start(&r, 0, 1, ROUND_LIVES);
}

static void steps(int count)
{
    const round_wish nothing = {{0, 0}, false};
    for (int i = 0; i < count; i++)
        round_step(&r, nothing, &points);
}

static void drop(void)
{
    const round_wish wish = {{0, 0}, true};
    round_step(&r, wish, &points);
}

/* A stone lies on the ground and reaches this high. */
static void land_one(cairn_real top)
{
    touching = false;
    steps(30);
    drop();
    touching = true;
    stone *s = r.current;
    s->top = top;
    steps(1);
}

void test_a_stone_hangs_soon_after_the_start(void)
{
    steps(23);
    TEST_ASSERT_EQUAL(ROUND_LANDED, r.state);
    steps(1);
    TEST_ASSERT_EQUAL(ROUND_HANGING, r.state);
    TEST_ASSERT_EQUAL(EVENT_HUNG, r.events);
    TEST_ASSERT_EQUAL(r.level.stones - 1, r.supply);
}

void test_the_next_stone_waits_for_the_balloon_to_be_above_the_cairn(void)
{
    crane_is_low = true;
    steps(100);
    TEST_ASSERT_EQUAL(ROUND_LANDED, r.state);
    crane_is_low = false;
    steps(1);
    TEST_ASSERT_EQUAL(ROUND_HANGING, r.state);
}

void test_a_dropped_stone_falls_until_it_touches(void)
{
    steps(30);
    drop();
    TEST_ASSERT_EQUAL(ROUND_FALLING, r.state);
    steps(10);
    TEST_ASSERT_EQUAL(ROUND_FALLING, r.state);
    touching = true;
    steps(1);
    TEST_ASSERT_EQUAL(ROUND_LANDED, r.state);
    TEST_ASSERT_TRUE((r.events & EVENT_LANDED) != 0);
    TEST_ASSERT_TRUE(points.points > 0);
}

void test_what_falls_for_long_has_landed(void)
{
    steps(30);
    drop();
    steps(240);
    TEST_ASSERT_EQUAL(ROUND_LANDED, r.state);
}

void test_a_stone_in_the_water_costs_a_life_and_the_streak(void)
{
    land_one(CAIRN_F(0.5));
    points.streak = 4;
    place.y = CAIRN_F(-2);
    steps(1);
    TEST_ASSERT_EQUAL(ROUND_LIVES - 1, r.lives);
    TEST_ASSERT_EQUAL(1, points.streak);
    TEST_ASSERT_TRUE((r.events & EVENT_SPLASH) != 0 && (r.events & EVENT_LIFE) != 0);
    TEST_ASSERT_EQUAL(STONE_NONE, r.stones[0].state);
}

void test_stones_that_fall_together_cost_one_life(void)
{
    for (int i = 0; i < 3; i++)
        land_one(CAIRN_F(0.5));
    place.y = CAIRN_F(-2);
    steps(1);
    TEST_ASSERT_EQUAL(ROUND_LIVES - 1, r.lives);
}

void test_a_falling_stone_in_the_water_makes_room_for_the_next(void)
{
    steps(30);
    drop();
    place.y = CAIRN_F(-2);
    steps(1);
    TEST_ASSERT_EQUAL(ROUND_LANDED, r.state);
    TEST_ASSERT_NULL(r.current);
}

void test_the_line_has_to_be_held_for_three_seconds(void)
{
    land_one(r.level.goal);
    TEST_ASSERT_EQUAL(1, r.held);
    TEST_ASSERT_TRUE((r.events & EVENT_REACHED) != 0);
    steps(ROUND_HOLD_STEPS - 2);
    TEST_ASSERT_NOT_EQUAL(ROUND_WON, r.state);
    steps(1);
    TEST_ASSERT_EQUAL(ROUND_WON, r.state);
    TEST_ASSERT_TRUE((r.events & EVENT_WON) != 0);
    steps(10);
    TEST_ASSERT_EQUAL(0, r.events);
}

void test_the_clock_runs_back_while_something_moves(void)
{
    land_one(r.level.goal);
    steps(20);
    TEST_ASSERT_EQUAL(21, r.held);
    speed.x = CAIRN_F(0.5);
    steps(5);
    TEST_ASSERT_EQUAL(11, r.held);
    steps(20);
    TEST_ASSERT_EQUAL(0, r.held);
}

void test_below_the_line_no_clock_runs(void)
{
    land_one(r.level.goal - 1);
    steps(100);
    TEST_ASSERT_EQUAL(0, r.held);
}

void test_without_lives_the_round_is_lost(void)
{
    r.lives = 1;
    land_one(CAIRN_F(0.5));
    place.y = CAIRN_F(-2);
    steps(1);
    TEST_ASSERT_EQUAL(ROUND_LOST, r.state);
}

void test_without_stones_it_is_lost_once_the_cairn_rests_below_the_line(void)
{
    r.supply = 1;
    land_one(CAIRN_F(0.5));
    steps(25);
    TEST_ASSERT_EQUAL(ROUND_EMPTY, r.state);
    speed.x = CAIRN_F(1);
    steps(250);
    TEST_ASSERT_EQUAL(ROUND_EMPTY, r.state);
    speed.x = 0;
    steps(250);
    TEST_ASSERT_EQUAL(ROUND_LOST, r.state);
}

void test_the_last_stone_may_still_win(void)
{
    r.supply = 1;
    land_one(r.level.goal);
    steps(ROUND_HOLD_STEPS);
    TEST_ASSERT_EQUAL(ROUND_WON, r.state);
}

void test_a_full_world_hangs_nothing(void)
{
    is_full = true;
    steps(30);
    TEST_ASSERT_EQUAL(ROUND_EMPTY, r.state);
    TEST_ASSERT_NULL(r.current);
}

void test_no_more_stones_than_there_are_places(void)
{
    for (int i = 0; i < LEVEL_STONES; i++)
        TEST_ASSERT_TRUE(round_restore_stone(&r, 7, cairn_vec2_of(0, 0), 0));
    TEST_ASSERT_FALSE(round_restore_stone(&r, 7, cairn_vec2_of(0, 0), 0));
}

void test_the_balloon_stays_over_the_cairn(void)
{
    const cairn_real before = r.crane_height;
    land_one(CAIRN_F(3));
    steps(1);
    TEST_ASSERT_EQUAL(before + CAIRN_F(3), r.crane_height);
}
