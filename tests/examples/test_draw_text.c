/* Letters and numbers of examples/draw. */
#include "text.h"

#include "unity.h"

#include <string.h>

static draw_canvas canvas;

void setUp(void) { draw_clear(&canvas, 0); }

static void expect(int x, int y, const char *const *rows, int count)
{
    for (int row = 0; row < count; row++)
        for (int column = 0; rows[row][column] != '\0'; column++)
            TEST_ASSERT_EQUAL_MESSAGE(rows[row][column] == '#' ? 15 : 0, draw_get(&canvas, x + column, y + row), rows[row]);
}

void test_letters_look_as_they_should(void)
{
    static const char *const rows[] = {".#..##...##.", "#.#.#.#.#...", "###.##..#...", "#.#.#.#.#...", "#.#.##...##."};
    draw_text(&canvas, 5, 7, "ABC", 15);
    expect(5, 7, rows, 5);
}

void test_small_letters_are_capitals(void)
{
    static const char *const rows[] = {".#.", "#.#", "###", "#.#", "#.#"};
    draw_text(&canvas, 5, 7, "a", 15);
    expect(5, 7, rows, 5);
}

void test_what_is_not_in_the_font_is_blank(void)
{
    static const char *const rows[] = {"......", "......", "......", "......", "......"};
    draw_text(&canvas, 5, 7, "\x7f\x80\x01", 15);
    expect(5, 7, rows, 5);
}

void test_a_label_has_a_dark_rim(void)
{
    draw_clear(&canvas, 8);
    draw_label(&canvas, 5, 7, "I", 15);
    TEST_ASSERT_EQUAL(15, draw_get(&canvas, 6, 9));
    TEST_ASSERT_EQUAL(0, draw_get(&canvas, 5, 9));
    TEST_ASSERT_EQUAL(0, draw_get(&canvas, 6, 6));
    TEST_ASSERT_EQUAL(0, draw_get(&canvas, 6, 12));
    TEST_ASSERT_EQUAL(8, draw_get(&canvas, 4, 5));
}

void test_a_width_leaves_out_the_last_gap(void)
{
    TEST_ASSERT_EQUAL(0, draw_text_width(""));
    TEST_ASSERT_EQUAL(3, draw_text_width("A"));
    TEST_ASSERT_EQUAL(11, draw_text_width("ABC"));
}

void test_big_text_is_made_of_squares(void)
{
    const draw_shades shades = {15, 15};
    draw_big_text(&canvas, 10, 10, "I", 3, shades);
    for (int i = 0; i < 9; i++)
        TEST_ASSERT_EQUAL(15, draw_get(&canvas, 10 + i, 10));
    TEST_ASSERT_EQUAL(0, draw_get(&canvas, 10, 14));
    TEST_ASSERT_EQUAL(15, draw_get(&canvas, 14, 14));
}

void test_text_beside_the_frame_is_cut(void)
{
    draw_text(&canvas, 126, 62, "WWWW", 15);
    draw_text(&canvas, -9, -3, "WWWW", 15);
    draw_centered(&canvas, 127, 63, "CENTRE", 15);
    TEST_ASSERT_EQUAL(15, draw_get(&canvas, 126, 62));
}

static void expect_number(const char *text, int32_t value, int decimals)
{
    char buffer[DRAW_NUMBER_SIZE];
    TEST_ASSERT_EQUAL((int)strlen(text), draw_number(buffer, value, decimals));
    TEST_ASSERT_EQUAL_STRING(text, buffer);
}

void test_numbers_as_text(void)
{
    expect_number("0", 0, 0);
    expect_number("7", 7, 0);
    expect_number("-42", -42, 0);
    expect_number("2147483647", INT32_MAX, 0);
    expect_number("-2147483648", INT32_MIN, 0);
    expect_number("0.5", 5, 1);
    expect_number("1.2", 12, 1);
    expect_number("0.05", 5, 2);
    expect_number("-3.25", -325, 2);
    expect_number("12.345", 12345, 3);
}
