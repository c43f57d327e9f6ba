/* The game around the levels with the real engine, and the port as a mock: what is kept outlives it. */
#include "game.h"
#include "picture.h"

#include "cairn_port.h"
#include "mock_cairn_port.h"
#include "unity.h"

#include <string.h>

static game g;
static draw_canvas canvas;
static keep memory; /* what the mock's port keeps */
static bool has_memory;

static int32_t load(const char *name, uint32_t offset, void *data, uint32_t size, int calls)
{
    (void)name, (void)offset, (void)calls;
    if (!has_memory)
        return -1;
    memcpy(data, &memory, size);
    return (int32_t)size;
}

static int32_t save(const char *name, const void *data, uint32_t size, int calls)
{
    (void)name, (void)calls;
    memcpy(&memory, data, size);
    has_memory = true;
    return 0;
}

void setUp(void)
{
    has_memory = false;
    cairn_port_load_StubWithCallback(load);
    cairn_port_save_StubWithCallback(save);
    game_start(&g, 7);
}

static void hold(uint32_t buttons, int count)
{
    for (int i = 0; i < count; i++)
        game_step(&g, buttons);
}

static void press(uint32_t buttons)
{
    hold(buttons, 2);
    hold(0, 2);
}

/* The machine plays for so many steps; true once the game is in a state. */
static bool play_until(game_state state, int count)
{
    for (int i = 0; i < count && g.state != state; i++)
        game_step(&g, bot_buttons(&g.round, g.frame));
    return g.state == state;
}

void test_the_title_plays_by_itself(void)
{
    hold(0, 600);
    TEST_ASSERT_EQUAL(GAME_DEMO, g.state);
    TEST_ASSERT_EQUAL(0, g.score.points);
    press(CAIRN_BUTTON_LEFT);
    TEST_ASSERT_EQUAL(GAME_TITLE, g.state);
}

void test_the_demo_goes_on_from_level_to_level(void)
{
    hold(0, 600);
    const uint32_t first = g.round.random.state;
    hold(0, 6000);
    TEST_ASSERT_EQUAL(GAME_DEMO, g.state);
    TEST_ASSERT_NOT_EQUAL(first, g.round.random.state);
}

void test_select_starts_the_game(void)
{
    press(CAIRN_BUTTON_SELECT);
    TEST_ASSERT_EQUAL(GAME_PLAY, g.state);
    TEST_ASSERT_EQUAL(0, g.round.number);
    TEST_ASSERT_EQUAL(ROUND_LIVES, g.round.lives);
}

void test_a_level_that_is_won_leads_to_the_next_with_a_life_more(void)
{
    press(CAIRN_BUTTON_SELECT);
    TEST_ASSERT_TRUE(play_until(GAME_WON, 6000));
    TEST_ASSERT_TRUE(g.bonus > 0 && g.score.points >= g.bonus);
    const int lives = g.round.lives;
    hold(0, 50);
    press(CAIRN_BUTTON_SELECT);
    TEST_ASSERT_EQUAL(GAME_PLAY, g.state);
    TEST_ASSERT_EQUAL(1, g.round.number);
    TEST_ASSERT_EQUAL(lives + 1, g.round.lives);
}

void test_a_lost_game_may_be_tried_once_more(void)
{
    press(CAIRN_BUTTON_SELECT);
    g.round.lives = 1;
    hold(CAIRN_BUTTON_RIGHT, 150);
    press(CAIRN_BUTTON_RIGHT | CAIRN_BUTTON_SELECT);
    hold(0, 400);
    TEST_ASSERT_EQUAL(GAME_OVER, g.state);
    press(CAIRN_BUTTON_SELECT);
    TEST_ASSERT_EQUAL(GAME_PLAY, g.state);
    TEST_ASSERT_EQUAL(0, g.score.points);
}

void test_select_held_pauses_and_the_menu_leads_on(void)
{
    press(CAIRN_BUTTON_SELECT);
    hold(CAIRN_BUTTON_SELECT, 60);
    TEST_ASSERT_EQUAL(GAME_PAUSE, g.state);
    const uint32_t before = game_hash(&g);
    hold(0, 30);
    TEST_ASSERT_EQUAL(before, game_hash(&g));
    press(CAIRN_BUTTON_SELECT);
    TEST_ASSERT_EQUAL(GAME_PLAY, g.state);
    hold(CAIRN_BUTTON_SELECT, 60);
    hold(0, 2);
    press(CAIRN_BUTTON_DOWN);
    press(CAIRN_BUTTON_SELECT);
    TEST_ASSERT_EQUAL(GAME_PLAY, g.state);
    hold(CAIRN_BUTTON_SELECT, 60);
    hold(0, 2);
    press(CAIRN_BUTTON_DOWN);
    press(CAIRN_BUTTON_DOWN);
    press(CAIRN_BUTTON_DOWN);
    press(CAIRN_BUTTON_SELECT);
    TEST_ASSERT_EQUAL(GAME_TITLE, g.state);
}

void test_a_direction_while_select_is_held_switches_a_layer(void)
{
    hold(CAIRN_BUTTON_SELECT, 20);
    hold(CAIRN_BUTTON_SELECT | CAIRN_BUTTON_UP, 2);
    TEST_ASSERT_EQUAL(DRAW_LAYER_SHAPES, g.layers.shown);
    hold(CAIRN_BUTTON_SELECT, 2);
    hold(CAIRN_BUTTON_SELECT | CAIRN_BUTTON_LEFT, 2);
    TEST_ASSERT_EQUAL(DRAW_LAYER_SHAPES | DRAW_LAYER_CONTACTS, g.layers.shown);
}

void test_a_killed_game_comes_back_but_for_the_stone_in_hand(void)
{
    game_use_keep(&g, "k");
    TEST_ASSERT_FALSE(g.can_continue);
    press(CAIRN_BUTTON_SELECT);
    while (g.state == GAME_PLAY && !(g.round.supply == 8 && g.round.state == ROUND_HANGING && g.round.top > CAIRN_F(0.9)))
        game_step(&g, bot_buttons(&g.round, g.frame));
    TEST_ASSERT_EQUAL(GAME_PLAY, g.state);
    const cairn_real top = g.round.top;
    const uint32_t points = g.score.points;
    const int left = g.round.supply + 1, lives = g.round.lives;
    /* The power goes, and comes back. */
    game_start(&g, 99);
    game_use_keep(&g, "k");
    TEST_ASSERT_TRUE(g.can_continue);
    press(CAIRN_BUTTON_SELECT);
    hold(0, 200);
    TEST_ASSERT_EQUAL(GAME_PLAY, g.state);
    TEST_ASSERT_EQUAL(points, g.score.points);
    TEST_ASSERT_EQUAL(left, g.round.supply + 1);
    TEST_ASSERT_EQUAL(lives, g.round.lives);
    TEST_ASSERT_INT_WITHIN(CAIRN_F(0.01), top, g.round.top);
}

void test_a_kept_game_that_is_damaged_is_not_continued(void)
{
    game_use_keep(&g, "k");
    press(CAIRN_BUTTON_SELECT);
    hold(0, 60);
    TEST_ASSERT_TRUE(has_memory && keep_is_valid(&memory));
    for (size_t i = 0; i < sizeof memory; i += 7) {
        ((uint8_t *)&memory)[i] ^= 0x10;
        TEST_ASSERT_FALSE(keep_is_valid(&memory));
        game_use_keep(&g, "k");
        TEST_ASSERT_FALSE(g.can_continue);
        ((uint8_t *)&memory)[i] ^= 0x10;
    }
}

void test_the_best_score_outlives_a_lost_game(void)
{
    g.keep_name = "k";
    press(CAIRN_BUTTON_SELECT);
    score_add(&g.score, 777);
    g.round.lives = 1;
    hold(CAIRN_BUTTON_RIGHT, 150);
    press(CAIRN_BUTTON_RIGHT | CAIRN_BUTTON_SELECT);
    hold(0, 400);
    TEST_ASSERT_EQUAL(GAME_OVER, g.state);
    game_start(&g, 3);
    game_use_keep(&g, "k");
    TEST_ASSERT_TRUE(g.score.best >= 777);
    TEST_ASSERT_FALSE(g.can_continue);
}

void test_drawing_decides_nothing(void)
{
    press(CAIRN_BUTTON_SELECT);
    for (int i = 0; i < 600; i++) {
        game_step(&g, bot_buttons(&g.round, g.frame));
        const uint32_t before = game_hash(&g);
        picture_draw(&canvas, &g);
        TEST_ASSERT_EQUAL(before, game_hash(&g));
    }
}

void test_every_state_and_layer_has_a_picture(void)
{
    static const game_state states[] = {GAME_TITLE, GAME_DEMO, GAME_PLAY, GAME_PAUSE, GAME_WON, GAME_OVER};
    press(CAIRN_BUTTON_SELECT);
    hold(0, 30);
    for (unsigned i = 0; i < sizeof states / sizeof states[0]; i++)
        for (unsigned layers = 0; layers <= DRAW_LAYERS_ALL; layers += 5) {
            int lit = 0;
            g.state = states[i];
            g.layers.shown = layers;
            picture_draw(&canvas, &g);
            for (int x = 0; x < DRAW_WIDTH; x++)
                for (int y = 0; y < DRAW_HEIGHT; y++)
                    lit += draw_get(&canvas, x, y) > 10;
            TEST_ASSERT_TRUE(lit > 100);
        }
}

void test_the_machine_wins_most_levels(void)
{
    int won = 0;
    for (int number = 0; number < level_count(); number++) {
        score s;
        s.best = 0;
        score_start(&s);
        round_start(&g.round, number, 5, ROUND_LIVES);
        uint32_t before = 0;
        for (uint32_t i = 0; i < 8000 && g.round.state < ROUND_WON; i++) {
            const uint32_t buttons = bot_buttons(&g.round, i), pressed = buttons & ~before;
            const round_wish wish = {{(int8_t)(((buttons & CAIRN_BUTTON_RIGHT) != 0) - ((buttons & CAIRN_BUTTON_LEFT) != 0)),
                                      (int8_t)(((buttons & CAIRN_BUTTON_UP) != 0) - ((buttons & CAIRN_BUTTON_DOWN) != 0))},
                                     (pressed & CAIRN_BUTTON_SELECT) != 0};
            before = buttons;
            round_step(&g.round, wish, &s);
        }
        won += g.round.state == ROUND_WON;
        TEST_ASSERT_EQUAL(0, cairn_world_get_stats(g.round.world)->dropped);
    }
    TEST_ASSERT_TRUE(won >= 6);
}
