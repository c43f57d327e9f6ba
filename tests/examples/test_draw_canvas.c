/* Pixels, rows and boxes of examples/draw: known pixels, and nothing outside of the clip at any coordinates. */
#include "canvas.h"

#include "unity.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

static draw_canvas canvas;

void setUp(void) { draw_clear(&canvas, 0); }

static int count_of(int shade)
{
    int count = 0;
    for (int y = 0; y < DRAW_HEIGHT; y++)
        for (int x = 0; x < DRAW_WIDTH; x++)
            count += draw_get(&canvas, x, y) == shade;
    return count;
}

void test_the_left_pixel_lies_in_the_high_half(void)
{
    draw_pixel(&canvas, 0, 0, 5);
    draw_pixel(&canvas, 1, 0, 9);
    draw_pixel(&canvas, 127, 63, 15);
    TEST_ASSERT_EQUAL_HEX8(0x59, canvas.pixels[0]);
    TEST_ASSERT_EQUAL_HEX8(0x0F, canvas.pixels[4095]);
}

void test_what_is_outside_of_the_frame_reads_black(void)
{
    draw_clear(&canvas, 7);
    TEST_ASSERT_EQUAL(0, draw_get(&canvas, -1, 0));
    TEST_ASSERT_EQUAL(0, draw_get(&canvas, 0, 64));
    TEST_ASSERT_EQUAL(7, draw_get(&canvas, 127, 63));
}

void test_a_row_of_any_ends_covers_just_its_pixels(void)
{
    for (int from = 0; from < 6; from++)
        for (int end = 0; end < 9; end++) {
            draw_clear(&canvas, 1);
            draw_row(&canvas, from, end, 3, 9);
            for (int x = 0; x < 12; x++)
                TEST_ASSERT_EQUAL(x >= from && x < end ? 9 : 1, draw_get(&canvas, x, 3));
        }
}

void test_a_box_is_cut_at_the_frame(void)
{
    draw_box(&canvas, -5, -5, 10, 10, 6);
    TEST_ASSERT_EQUAL(25, count_of(6));
    draw_box(&canvas, 120, 60, INT_MAX, INT_MAX, 7);
    TEST_ASSERT_EQUAL(8 * 4, count_of(7));
    draw_box(&canvas, INT_MIN, INT_MIN, INT_MAX, INT_MAX, 8);
    draw_box(&canvas, INT_MAX, 0, 5, 5, 8);
    draw_box(&canvas, 3, 3, 0, 5, 8);
    TEST_ASSERT_EQUAL(0, count_of(8));
}

void test_the_clip_holds_for_all_that_is_drawn(void)
{
    draw_clip(&canvas, 10, 20, 30, 40);
    draw_box(&canvas, -100, -100, 400, 400, 3);
    draw_row(&canvas, 0, 128, 25, 4);
    draw_pixel(&canvas, 9, 25, 5);
    draw_blend(&canvas, 30, 25, 5, 64);
    draw_dither(&canvas, 0, 0, 128, 64, 5, 16);
    draw_tint(&canvas, 0, 0, 128, 64, 9);
    TEST_ASSERT_EQUAL(20 * 20, count_of(14));
    TEST_ASSERT_EQUAL(8192 - 400, count_of(0));
}

void test_a_clip_outside_of_the_frame_is_empty(void)
{
    draw_clip(&canvas, 200, -50, 300, 500);
    draw_box(&canvas, 0, 0, 128, 64, 3);
    draw_clip(&canvas, 50, 50, 20, 20);
    draw_box(&canvas, 0, 0, 128, 64, 3);
    TEST_ASSERT_EQUAL(0, count_of(3));
}

void test_a_blend_takes_its_share(void)
{
    draw_clear(&canvas, 4);
    draw_blend(&canvas, 2, 2, 12, 32);
    draw_blend(&canvas, 3, 2, 12, 0);
    draw_blend(&canvas, 4, 2, 12, 64);
    TEST_ASSERT_EQUAL(8, draw_get(&canvas, 2, 2));
    TEST_ASSERT_EQUAL(4, draw_get(&canvas, 3, 2));
    TEST_ASSERT_EQUAL(12, draw_get(&canvas, 4, 2));
}

void test_a_dither_sets_as_many_of_sixteen_as_asked_for(void)
{
    for (int amount = 0; amount <= DRAW_DITHER_ALL; amount++) {
        draw_clear(&canvas, 0);
        draw_dither(&canvas, 8, 8, 16, 16, 3, amount);
        TEST_ASSERT_EQUAL(16 * amount, count_of(3));
    }
}

void test_a_tint_stays_within_the_shades(void)
{
    draw_box(&canvas, 0, 0, 5, 1, 14);
    draw_tint(&canvas, 0, 0, 5, 2, 3);
    TEST_ASSERT_EQUAL(15, draw_get(&canvas, 4, 0));
    TEST_ASSERT_EQUAL(3, draw_get(&canvas, 3, 1));
    draw_tint(&canvas, 1, 0, 3, 1, -20);
    TEST_ASSERT_EQUAL(15, draw_get(&canvas, 0, 0));
    TEST_ASSERT_EQUAL(0, draw_get(&canvas, 1, 0));
    TEST_ASSERT_EQUAL(0, draw_get(&canvas, 3, 0));
    TEST_ASSERT_EQUAL(15, draw_get(&canvas, 4, 0));
}

void test_a_gradient_goes_from_one_shade_to_the_other(void)
{
    draw_gradient(&canvas, 16, 14 * 16);
    TEST_ASSERT_EQUAL(1, draw_get(&canvas, 5, 0));
    TEST_ASSERT_EQUAL(14, draw_get(&canvas, 5, 63));
    TEST_ASSERT_INT_WITHIN(1, 7, draw_get(&canvas, 5, 31));
}

void test_random_calls_never_write_behind_the_frame(void)
{
    srand(1);
    for (int i = 0; i < 20000; i++) {
        const int x = rand() % 400 - 150, y = rand() % 300 - 100, width = rand() % 300 - 20, height = rand() % 200 - 20;
        switch (rand() % 6) {
        case 0: draw_box(&canvas, x, y, width, height, i & 15); break;
        case 1: draw_row(&canvas, x, x + width, y, i & 15); break;
        case 2: draw_dither(&canvas, x, y, width, height, i & 15, i % 17); break;
        case 3: draw_tint(&canvas, x, y, width, height, i % 31 - 15); break;
        case 4: draw_clip(&canvas, x, y, x + width, y + height); break;
        default: draw_blend(&canvas, x, y, i & 15, i % 65); break;
        }
    }
    TEST_ASSERT_TRUE(canvas.left >= 0 && canvas.right <= DRAW_WIDTH && canvas.left <= canvas.right);
}
