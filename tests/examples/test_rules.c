/* What needs no world: points, wind, levels, dust. */
#include "feel.h"
#include "level.h"
#include "score.h"
#include "wind.h"

#include "unity.h"

#include <string.h>

void test_a_landing_brings_more_for_growth_and_for_gentleness(void)
{
    score s;
    s.best = 0;
    score_start(&s);
    TEST_ASSERT_EQUAL(10, score_landing(&s, 0, CAIRN_F(3)));
    s.streak = 1;
    TEST_ASSERT_EQUAL(15, score_landing(&s, 0, CAIRN_F(1)));
    s.streak = 1;
    TEST_ASSERT_EQUAL(60, score_landing(&s, CAIRN_F(0.5), CAIRN_F(3)));
}

void test_a_streak_multiplies_up_to_five_and_ends_with_a_lost_stone(void)
{
    score s;
    s.best = 0;
    score_start(&s);
    for (uint32_t i = 1; i <= 7; i++)
        TEST_ASSERT_EQUAL(10 * (i < 5 ? i : 5), score_landing(&s, 0, CAIRN_F(3)));
    score_lost_stone(&s);
    TEST_ASSERT_EQUAL(10, score_landing(&s, 0, CAIRN_F(3)));
}

void test_the_best_score_stays(void)
{
    score s;
    s.best = 100;
    score_start(&s);
    score_add(&s, 50);
    TEST_ASSERT_EQUAL(100, s.best);
    TEST_ASSERT_EQUAL(100 + 3 * 25 + 2 * 50, score_level(&s, 0, 3, 2));
    TEST_ASSERT_EQUAL(325, s.best);
    score_add(&s, 4000000);
    TEST_ASSERT_EQUAL(999999, s.points);
}

void test_the_wind_stays_below_its_greatest_and_blows_both_ways(void)
{
    wind w;
    bool left = false, right = false;
    wind_start(&w, CAIRN_F(2), 5);
    for (int i = 0; i < 2000; i++) {
        wind_step(&w);
        TEST_ASSERT_TRUE(cairn_real_is_within(w.now, CAIRN_F(2)));
        left |= w.now < CAIRN_F(-1);
        right |= w.now > CAIRN_F(1);
    }
    TEST_ASSERT_TRUE(left && right);
    wind_start(&w, 0, 5);
    wind_step(&w);
    TEST_ASSERT_EQUAL(0, w.now);
}

void test_levels_come_again_higher_and_windier(void)
{
    level first, again, far;
    level_get(&first, 2);
    level_get(&again, 2 + level_count());
    level_get(&far, 2 + 1000 * level_count());
    TEST_ASSERT_EQUAL_STRING(first.name, again.name);
    TEST_ASSERT_TRUE(again.goal > first.goal && again.wind > first.wind);
    TEST_ASSERT_EQUAL(LEVEL_STONES, again.stones);
    TEST_ASSERT_TRUE(far.goal < CAIRN_F(10));
}

void test_every_level_can_be_held_by_the_game(void)
{
    for (int i = 0; i < level_count(); i++) {
        level l;
        level_get(&l, i);
        TEST_ASSERT_TRUE(l.stones <= LEVEL_STONES && l.stones > 0);
        TEST_ASSERT_TRUE(l.piece_count <= LEVEL_PIECES && l.piece_count > 0);
        TEST_ASSERT_TRUE(strlen(l.name) <= 10 && l.goal > CAIRN_F(1));
    }
}

void test_dust_fades_and_shaking_ends(void)
{
    feel f;
    feel_start(&f, 3);
    feel_thud(&f, cairn_vec2_of(0, 0), CAIRN_F(20));
    feel_splash(&f, cairn_vec2_of(0, 0));
    feel_sparks(&f, cairn_vec2_of(0, 0));
    feel_points(&f, cairn_vec2_of(0, 0), 70);
    TEST_ASSERT_EQUAL(FEEL_SHAKE_MAX, f.shake);
    TEST_ASSERT_NOT_EQUAL(0, feel_shake_y(&f));
    for (int i = 0; i < 60; i++)
        feel_step(&f);
    for (int i = 0; i < FEEL_GRAINS; i++)
        TEST_ASSERT_EQUAL(0, f.grains[i].life);
    TEST_ASSERT_EQUAL(0, f.pops[0].life);
    TEST_ASSERT_EQUAL(0, feel_shake_x(&f));
    TEST_ASSERT_EQUAL(0, feel_shake_y(&f));
}

void test_a_soft_landing_does_not_shake(void)
{
    feel f;
    feel_start(&f, 3);
    feel_thud(&f, cairn_vec2_of(0, 0), CAIRN_F(0.5));
    TEST_ASSERT_EQUAL(0, f.shake);
}

void test_the_same_seed_gives_the_same_numbers_within_their_bounds(void)
{
    random_source a = random_from(9), b = random_from(9);
    for (int i = 0; i < 1000; i++) {
        const int32_t x = random_between(&a, -3, 4);
        TEST_ASSERT_TRUE(x >= -3 && x <= 4);
        TEST_ASSERT_EQUAL(x, random_between(&b, -3, 4));
    }
}
