/* Pinball and the platformer, with the real engine: what their tables and ledges promise. */
#include "hop.h"
#include "pinball.h"
#include "stage.h"

#include "cairn_port.h"
#include "unity.h"

#include <string.h>

static pinball p;
static hop h;

void setUp(void)
{
    memset(&p, 0, sizeof p);
    pinball_start(&p);
    memset(&h, 0, sizeof h);
    hop_start(&h);
}

static void flip(uint32_t buttons, int count)
{
    for (int i = 0; i < count; i++)
        pinball_step(&p, buttons);
}

static void go(uint32_t buttons, int count)
{
    for (int i = 0; i < count; i++)
        hop_step(&h, buttons);
}

void test_a_flipper_rises_turns_back_and_stays_in_its_place(void)
{
    const cairn_vec2 before = cairn_body_position(p.table.world, p.table.flippers[0]);
    flip(CAIRN_BUTTON_LEFT, 30);
    TEST_ASSERT_INT_WITHIN(CAIRN_DEGREES(2), CAIRN_DEGREES(32), cairn_body_angle(p.table.world, p.table.flippers[0]));
    TEST_ASSERT_INT_WITHIN(CAIRN_DEGREES(2), CAIRN_DEGREES(24), cairn_body_angle(p.table.world, p.table.flippers[1]));
    flip(0, 30);
    TEST_ASSERT_INT_WITHIN(CAIRN_DEGREES(2), CAIRN_DEGREES(-24), cairn_body_angle(p.table.world, p.table.flippers[0]));
    const cairn_vec2 after = cairn_body_position(p.table.world, p.table.flippers[0]);
    TEST_ASSERT_EQUAL(before.x, after.x);
    TEST_ASSERT_EQUAL(before.y, after.y);
}

void test_the_plunger_shoots_farther_the_longer_it_is_pulled(void)
{
    flip(CAIRN_BUTTON_SELECT, 10);
    flip(0, 2);
    const cairn_real little = cairn_body_velocity(p.table.world, p.table.ball).y;
    pinball_start(&p);
    flip(CAIRN_BUTTON_SELECT, 50);
    flip(0, 2);
    TEST_ASSERT_TRUE(cairn_body_velocity(p.table.world, p.table.ball).y > little + CAIRN_F(3));
}

void test_the_ball_never_leaves_the_table_and_the_game_ends(void)
{
    bool scored = false;
    uint8_t fewest = 3;
    for (int i = 0; i < 60000 && fewest > 0; i++) { /* how long a game lasts is luck: 128 s in one build, 540 s in the next */
        pinball_step(&p, 0); /* it plays by itself */
        const cairn_vec2 at = cairn_body_position(p.table.world, p.table.ball);
        TEST_ASSERT_TRUE(cairn_real_is_within(at.x, CAIRN_F(4)));
        TEST_ASSERT_TRUE(at.y < CAIRN_F(13) && at.y > CAIRN_F(-1));
        scored |= p.score > 1000;
        fewest = p.balls < fewest ? p.balls : fewest;
    }
    TEST_ASSERT_TRUE(scored);
    TEST_ASSERT_EQUAL(0, fewest);
}

void test_a_ledge_lets_the_hero_through_from_below_and_carries_him_then(void)
{
    (void)cairn_body_set_transform(h.world, h.hero, cairn_vec2_of(stage_ledge_at[0].x, CAIRN_F(0.4)), 0);
    go(0, 20);
    go(CAIRN_BUTTON_SELECT, 1);
    go(0, 90);
    TEST_ASSERT_INT_WITHIN(CAIRN_F(0.02), stage_ledge_at[0].y + STAGE_LEDGE_HALF + STAGE_HERO_HALF, cairn_body_position(h.world, h.hero).y);
    go(CAIRN_BUTTON_DOWN, 60);
    TEST_ASSERT_INT_WITHIN(CAIRN_F(0.02), STAGE_HERO_HALF, cairn_body_position(h.world, h.hero).y);
}

void test_the_hero_jumps_off_ground_only(void)
{
    go(0, 30);
    go(CAIRN_BUTTON_SELECT, 1);
    go(0, 10);
    const cairn_real rising = cairn_body_velocity(h.world, h.hero).y;
    go(CAIRN_BUTTON_SELECT, 1);
    TEST_ASSERT_TRUE(cairn_body_velocity(h.world, h.hero).y < rising);
}

void test_the_platform_carries_the_hero(void)
{
    const cairn_vec2 start = cairn_body_position(h.world, h.platform);
    (void)cairn_body_set_transform(h.world, h.hero, cairn_vec2_of(start.x, start.y + CAIRN_F(0.55)), 0);
    go(0, 500);
    const cairn_vec2 hero = cairn_body_position(h.world, h.hero), platform = cairn_body_position(h.world, h.platform);
    TEST_ASSERT_INT_WITHIN(CAIRN_F(0.4), platform.x, hero.x);
    TEST_ASSERT_TRUE(hero.y > platform.y);
}

void test_a_coin_is_taken_once(void)
{
    (void)cairn_body_set_transform(h.world, h.hero, stage_coin_at[0], 0);
    go(0, 3);
    TEST_ASSERT_EQUAL(1, h.got);
    TEST_ASSERT_TRUE(cairn_body_id_is_null(h.coins[0]));
    go(0, 30);
    TEST_ASSERT_EQUAL(1, h.got);
}

void test_who_falls_comes_back_to_the_start(void)
{
    (void)cairn_body_set_transform(h.world, h.hero, cairn_vec2_of(CAIRN_F(4.4), CAIRN_F(-2)), 0);
    go(0, 90);
    TEST_ASSERT_INT_WITHIN(CAIRN_F(0.1), stage_start.x, cairn_body_position(h.world, h.hero).x);
}

void test_all_coins_end_the_run_and_begin_another(void)
{
    for (int i = 0; i < HOP_COINS; i++) {
        (void)cairn_body_set_transform(h.world, h.hero, stage_coin_at[i], 0);
        go(0, 3);
    }
    TEST_ASSERT_EQUAL(255, h.got);
    go(0, 2);
    TEST_ASSERT_TRUE(h.best > 0);
    go(0, 240);
    TEST_ASSERT_EQUAL(0, h.got);
}
