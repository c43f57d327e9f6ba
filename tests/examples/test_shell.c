/* What an image of the examples does with its words, on a mock of the port. */
#include "shell.h"

#include "cairn_port.h"
#include "mock_cairn_port.h"
#include "unity.h"

#include <string.h>

static char console[12000];
static const char *words, *file;
static uint32_t clock_now, clock_step, started_with, steps, draws, last_buttons;
static const char *resumed;

static void start(uint32_t seed) { started_with = seed; }

static void step(uint32_t buttons)
{
    steps++;
    last_buttons = buttons;
    clock_now += 100;
}

static void draw(draw_canvas *canvas)
{
    draws++;
    draw_pixel(canvas, 0, 0, 12);
    clock_now += 1000;
}

static uint32_t hash(void) { return steps; }
static void resume(const char *name) { resumed = name; }
static const shell_app app = {"game", start, step, draw, hash, resume};

static void write(const char *text, int calls)
{
    (void)calls;
    TEST_ASSERT_TRUE(strlen(console) + strlen(text) < sizeof console);
    strcat(console, text);
}

static const char *give_words(int calls)
{
    (void)calls;
    return words;
}

static uint32_t give_clock(int calls)
{
    (void)calls;
    return clock_now += clock_step;
}

static int32_t load(const char *name, uint32_t offset, void *data, uint32_t size, int calls)
{
    (void)name, (void)calls;
    if (file == NULL)
        return -1;
    const size_t left = offset < strlen(file) ? strlen(file) - offset : 0, count = left < size ? left : size;
    memcpy(data, file + offset, count);
    return (int32_t)count;
}

void setUp(void)
{
    console[0] = '\0';
    clock_step = 0;
    steps = draws = last_buttons = started_with = 0;
    resumed = NULL;
    file = NULL;
    cairn_port_write_StubWithCallback(write);
    cairn_port_arguments_StubWithCallback(give_words);
    cairn_port_clock_StubWithCallback(give_clock);
    cairn_port_load_StubWithCallback(load);
    cairn_port_buttons_IgnoreAndReturn(CAIRN_BUTTON_UP);
    cairn_port_seed_IgnoreAndReturn(1234);
    cairn_port_display_Ignore();
    cairn_port_stack_used_IgnoreAndReturn(99);
}

static int run(const char *text)
{
    words = text;
    return shell_run(&app);
}

void test_frames_are_stepped_drawn_and_hashed(void)
{
    TEST_ASSERT_EQUAL(0, run("frames=5 every=2 seed=8"));
    TEST_ASSERT_EQUAL(5, steps);
    TEST_ASSERT_EQUAL(5, draws);
    TEST_ASSERT_EQUAL(8, started_with);
    TEST_ASSERT_EQUAL(CAIRN_BUTTON_UP, last_buttons);
    TEST_ASSERT_NOT_NULL(strstr(console, "frame 2 state 00000002 picture "));
    TEST_ASSERT_NOT_NULL(strstr(console, "frame 4 state 00000004 picture "));
    TEST_ASSERT_NOT_NULL(strstr(console, "end 5 state 00000005 picture "));
}

void test_the_port_gives_a_seed_if_there_is_no_word(void)
{
    TEST_ASSERT_EQUAL(0, run("frames=1"));
    TEST_ASSERT_EQUAL(1234, started_with);
    TEST_ASSERT_NULL(resumed);
}

void test_a_script_holds_the_buttons(void)
{
    file = "2 left\n4 none\n";
    TEST_ASSERT_EQUAL(0, run("frames=3 input=play"));
    TEST_ASSERT_EQUAL(CAIRN_BUTTON_LEFT, last_buttons);
}

void test_a_bad_script_ends_it_with_one_line(void)
{
    file = "2 left\nx\n";
    TEST_ASSERT_EQUAL(2, run("frames=3 input=play"));
    TEST_ASSERT_EQUAL_STRING("game: play line 2: a line begins with a frame number\n", console);
}

void test_a_script_that_is_not_there_is_told(void)
{
    TEST_ASSERT_EQUAL(2, run("frames=3 input=play"));
    TEST_ASSERT_EQUAL_STRING("game: play: cannot be read\n", console);
    TEST_ASSERT_EQUAL(0, steps);
}

void test_a_bad_word_is_told(void)
{
    TEST_ASSERT_EQUAL(2, run("frame=3"));
    TEST_ASSERT_EQUAL_STRING("game: the words are frames=N every=K dump=K seed=N input=FILE keep=FILE cost record paced\n", console);
}

void test_a_picture_is_dumped_as_digits(void)
{
    TEST_ASSERT_EQUAL(0, run("frames=1 dump=1"));
    const char *picture = strstr(console, "picture 1\n");
    TEST_ASSERT_NOT_NULL(picture);
    TEST_ASSERT_EQUAL_STRING_LEN("c000", picture + 10, 4);
    TEST_ASSERT_EQUAL_STRING_LEN("\n0000", picture + 10 + 128, 5);
}

void test_the_cost_is_told_by_its_parts(void)
{
    TEST_ASSERT_EQUAL(0, run("frames=2 cost"));
    TEST_ASSERT_NOT_NULL(strstr(console, "cost worst 1100 in frame 1 "));
    TEST_ASSERT_NOT_NULL(strstr(console, " worst step 100 drawing 1000 flush 0 stack 99\n"));
}

void test_what_is_held_is_recorded_as_a_script(void)
{
    file = "2 left\n4 left+select\n5 none\n";
    TEST_ASSERT_EQUAL(0, run("frames=6 input=play record"));
    TEST_ASSERT_NOT_NULL(strstr(console, "held 2 left\nheld 4 left+select\nheld 5 none\nend 6 "));
}

void test_paced_play_waits_for_its_time_and_ends_with_a_picture(void)
{
    cairn_port_clock_rate_IgnoreAndReturn(60 * 1000);
    clock_step = 10;
    TEST_ASSERT_EQUAL(0, run("frames=30 paced every=10 record"));
    TEST_ASSERT_EQUAL(30, steps);
    /* A step takes a tenth of a frame and a picture all of one: some are left out, and the last is there. */
    TEST_ASSERT_TRUE(draws < 30 && draws > 10);
    TEST_ASSERT_NOT_NULL(strstr(console, "held 1 up\nframe 10 state 0000000a picture "));
    TEST_ASSERT_NOT_NULL(strstr(console, "end 30 state 0000001e picture "));
}

void test_paced_play_ends_at_a_bad_script(void)
{
    file = "2 left\nx\n";
    cairn_port_clock_rate_IgnoreAndReturn(60 * 1000);
    clock_step = 10;
    TEST_ASSERT_EQUAL(2, run("input=play"));
    TEST_ASSERT_EQUAL_STRING("game: play line 2: a line begins with a frame number\n", console);
}

void test_a_keep_is_handed_to_the_game(void)
{
    TEST_ASSERT_EQUAL(0, run("frames=1 keep=a.sav"));
    TEST_ASSERT_EQUAL_STRING("a.sav", resumed);
}
