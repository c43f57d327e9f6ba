/* Input scripts and the words of an image: what is read, and one clear message for what is not. The port is a mock. */
#include "script.h"
#include "words.h"

#include "cairn_port.h"
#include "mock_cairn_port.h"
#include "unity.h"

#include <string.h>

static const char *file; /* what the mock's port holds; null: no such file */
static script s;

static int32_t load(const char *name, uint32_t offset, void *data, uint32_t size, int calls)
{
    (void)name;
    (void)calls;
    if (file == NULL)
        return -1;
    const size_t length = strlen(file);
    const size_t left = offset < length ? length - offset : 0, count = left < size ? left : size;
    memcpy(data, file + offset, count);
    return (int32_t)count;
}

static void open_text(const char *text)
{
    file = text;
    cairn_port_load_StubWithCallback(load);
    script_open(&s, "play.txt");
}

static void expect_error(const char *text, uint32_t line, const char *error)
{
    open_text(text);
    for (uint32_t frame = 1; frame < 5000 && s.error == NULL; frame += 100)
        (void)script_buttons(&s, frame);
    TEST_ASSERT_EQUAL_STRING(error, s.error);
    TEST_ASSERT_EQUAL(line, s.line);
    TEST_ASSERT_EQUAL(0, script_buttons(&s, 6000));
}

void test_buttons_are_held_from_their_frame_on(void)
{
    open_text("# a play\n\n10 left\n20 left+select # drop\n 21\tright+up+down \r\n30 none");
    TEST_ASSERT_EQUAL(0, script_buttons(&s, 9));
    TEST_ASSERT_EQUAL(CAIRN_BUTTON_LEFT, script_buttons(&s, 10));
    TEST_ASSERT_EQUAL(CAIRN_BUTTON_LEFT | CAIRN_BUTTON_SELECT, script_buttons(&s, 20));
    TEST_ASSERT_EQUAL(CAIRN_BUTTON_RIGHT | CAIRN_BUTTON_UP | CAIRN_BUTTON_DOWN, script_buttons(&s, 25));
    TEST_ASSERT_EQUAL(0, script_buttons(&s, 30));
    TEST_ASSERT_NULL(s.error);
}

void test_frames_may_be_skipped_when_asked_for(void)
{
    open_text("1 left\n2 right\n3 up\n");
    TEST_ASSERT_EQUAL(CAIRN_BUTTON_UP, script_buttons(&s, 99));
}

void test_a_script_may_be_longer_than_a_chunk(void)
{
    static char text[4000];
    size_t length = 0;
    for (int i = 0; i < 200; i++) {
        memcpy(text + length, "0000 select\n", 12);
        text[length] = (char)('0' + (i + 1) / 100);
        text[length + 1] = (char)('0' + (i + 1) / 10 % 10);
        text[length + 2] = (char)('0' + (i + 1) % 10);
        length += 12;
    }
    text[length] = '\0';
    open_text(text);
    TEST_ASSERT_EQUAL(CAIRN_BUTTON_SELECT, script_buttons(&s, 2000));
    TEST_ASSERT_NULL(s.error);
    TEST_ASSERT_TRUE(s.ended);
}

void test_without_a_script_nothing_is_held(void)
{
    script_open(&s, NULL);
    TEST_ASSERT_EQUAL(0, script_buttons(&s, 100));
    TEST_ASSERT_NULL(s.error);
}

void test_an_empty_script_holds_nothing(void)
{
    open_text("");
    TEST_ASSERT_EQUAL(0, script_buttons(&s, 100));
    TEST_ASSERT_NULL(s.error);
}

void test_bad_scripts_are_told_by_line(void)
{
    static const char frame[] = "a line begins with a frame number";
    static const char buttons[] = "buttons are up, down, left, right, select, joined by '+', or none";
    expect_error("10 left\nleft\n", 2, frame);
    expect_error("10left\n", 1, frame);
    expect_error("-3 left\n", 1, frame);
    expect_error("99999999999 left\n", 1, frame);
    expect_error("10\n", 1, buttons);
    expect_error("10 jump\n", 1, buttons);
    expect_error("10 left+\n", 1, buttons);
    expect_error("10 left right\n", 1, buttons);
    expect_error("10 LEFT\n", 1, buttons);
    expect_error("10 left\n10 right\n", 2, "frame numbers must rise");
    expect_error("0 left\n0 right\n", 2, "frame numbers must rise");
    expect_error("20 left\n\n10 right\n", 3, "frame numbers must rise");
    expect_error("# 3456789 123456789 123456789 123456789 123456789 123456789 123456789 123456789 123\n", 1, "a line is longer than 79 characters");
    expect_error(NULL, 0, "cannot be read");
}

void test_names_are_what_a_script_reads(void)
{
    char names[SCRIPT_NAMES];
    for (uint32_t buttons = 0; buttons < 32; buttons++) {
        char line[SCRIPT_NAMES + 2] = "7 ";
        uint32_t frame = 0, held = 99;
        bool empty;
        const char *error;
        script_names(names, buttons);
        strcat(line, names);
        TEST_ASSERT_TRUE(script_read_line(line, &frame, &held, &empty, &error));
        TEST_ASSERT_EQUAL(buttons, held);
    }
}

void test_words_are_read(void)
{
    shell_words words;
    TEST_ASSERT_NULL(words_read(&words, "  frames=600 every=60 dump=7 seed=0 input=a.txt keep=b.sav  cost record paced "));
    TEST_ASSERT_TRUE(words.has_frames && words.has_seed && words.cost && words.record && words.paced);
    TEST_ASSERT_EQUAL(600, words.frames);
    TEST_ASSERT_EQUAL(60, words.every);
    TEST_ASSERT_EQUAL(7, words.dump);
    TEST_ASSERT_EQUAL_STRING("a.txt", words.input);
    TEST_ASSERT_EQUAL_STRING("b.sav", words.keep);
    TEST_ASSERT_NULL(words_read(&words, ""));
    TEST_ASSERT_FALSE(words.has_frames || words.has_seed || words.cost || words.record || words.paced);
}

void test_bad_words_are_told(void)
{
    shell_words words;
    static char name[140] = "keep=";
    memset(name + 5, 'x', 121);
    TEST_ASSERT_EQUAL_STRING("a number is missing after '='", words_read(&words, "frames="));
    TEST_ASSERT_EQUAL_STRING("a number has digits only", words_read(&words, "frames=-1"));
    TEST_ASSERT_EQUAL_STRING("a number is too large", words_read(&words, "seed=4294967296"));
    TEST_ASSERT_EQUAL_STRING("a file's name is missing after '='", words_read(&words, "input= cost"));
    TEST_ASSERT_EQUAL_STRING("a file's name is longer than 120 characters", words_read(&words, name));
    TEST_ASSERT_EQUAL_STRING("the words are frames=N every=K dump=K seed=N input=FILE keep=FILE cost record paced", words_read(&words, "costs"));
    TEST_ASSERT_EQUAL_STRING("the words are frames=N every=K dump=K seed=N input=FILE keep=FILE cost record paced", words_read(&words, "cost help"));
}
