/* Lines, polygons and circles of examples/draw. */
#include "fill.h"
#include "line.h"

#include "unity.h"

#include <stdlib.h>
#include <string.h>

static draw_canvas canvas, other;

void setUp(void)
{
    draw_clear(&canvas, 0);
    draw_clear(&other, 0);
}

static draw_point at(int x, int y)
{
    const draw_point p = {x * DRAW_SUB, y * DRAW_SUB};
    return p;
}

static int count_of(int shade)
{
    int count = 0;
    for (int y = 0; y < DRAW_HEIGHT; y++)
        for (int x = 0; x < DRAW_WIDTH; x++)
            count += draw_get(&canvas, x, y) == shade;
    return count;
}

/* The sum of all shades: what a shape covers, times its shade. */
static int weight(void)
{
    int sum = 0;
    for (int y = 0; y < DRAW_HEIGHT; y++)
        for (int x = 0; x < DRAW_WIDTH; x++)
            sum += draw_get(&canvas, x, y);
    return sum;
}

/* ---- lines ---- */

void test_a_line_has_both_of_its_ends_and_a_pixel_a_column(void)
{
    draw_line(&canvas, 10, 5, 30, 13, 9, DRAW_SOLID);
    TEST_ASSERT_EQUAL(9, draw_get(&canvas, 10, 5));
    TEST_ASSERT_EQUAL(9, draw_get(&canvas, 30, 13));
    TEST_ASSERT_EQUAL(21, count_of(9));
}

void test_a_line_drawn_backwards_is_the_same_line(void)
{
    draw_line(&canvas, 3, 60, 90, 7, 9, DRAW_SOLID);
    draw_line(&other, 90, 7, 3, 60, 9, DRAW_SOLID);
    TEST_ASSERT_EQUAL_MEMORY(other.pixels, canvas.pixels, sizeof canvas.pixels);
}

void test_a_point_is_a_line_too(void)
{
    draw_line(&canvas, 7, 7, 7, 7, 9, DRAW_SOLID);
    TEST_ASSERT_EQUAL(1, count_of(9));
}

void test_a_clipped_line_is_a_part_of_the_whole_one(void)
{
    draw_line(&canvas, 2, 3, 120, 59, 9, DRAW_SOLID);
    draw_clip(&other, 40, 10, 77, 50);
    draw_line(&other, 2, 3, 120, 59, 9, DRAW_SOLID);
    for (int y = 10; y < 50; y++)
        for (int x = 40; x < 77; x++)
            TEST_ASSERT_EQUAL(draw_get(&canvas, x, y), draw_get(&other, x, y));
}

void test_a_line_from_far_away_crosses_the_frame_where_it_should(void)
{
    draw_line(&canvas, -6400, -3200, 6400, 3200, 9, DRAW_SOLID);
    TEST_ASSERT_EQUAL(9, draw_get(&canvas, 0, 0));
    TEST_ASSERT_EQUAL(9, draw_get(&canvas, 100, 50));
}

void test_a_pattern_leaves_pixels_out(void)
{
    draw_line(&canvas, 0, 0, 63, 0, 9, DRAW_DASHED);
    TEST_ASSERT_EQUAL(32, count_of(9));
}

/* ---- polygons ---- */

void test_an_upright_box_covers_its_pixels_and_no_other(void)
{
    const draw_point box[4] = {at(10, 10), at(20, 10), at(20, 15), at(10, 15)};
    draw_convex(&canvas, box, 4, draw_shade(15));
    TEST_ASSERT_EQUAL(50, count_of(15));
    TEST_ASSERT_EQUAL(8192 - 50, count_of(0));
}

void test_a_polygon_is_the_same_in_either_direction(void)
{
    const draw_point forth[3] = {{200, 100}, {700, 333}, {350, 810}}, back[3] = {{350, 810}, {700, 333}, {200, 100}};
    draw_convex(&canvas, forth, 3, draw_shade(11));
    draw_convex(&other, back, 3, draw_shade(11));
    TEST_ASSERT_EQUAL_MEMORY(other.pixels, canvas.pixels, sizeof canvas.pixels);
}

void test_soft_edges_weigh_what_the_polygon_covers(void)
{
    /* 1/2 * 40 * 30 pixels, at shade 15; each soft pixel is rounded by half a shade at most */
    const draw_point triangle[3] = {at(20, 10), at(60, 25), at(20, 40)};
    draw_convex(&canvas, triangle, 3, draw_shade(15));
    TEST_ASSERT_INT_WITHIN(60, 600 * 15, weight());
}

void test_half_a_pixel_is_half_as_bright(void)
{
    const draw_point box[4] = {{160, 160}, {168, 160}, {168, 320}, {160, 320}};
    draw_convex(&canvas, box, 4, draw_shade(12));
    TEST_ASSERT_EQUAL(6, draw_get(&canvas, 10, 12));
}

void test_a_shade_goes_from_top_to_bottom(void)
{
    const draw_point box[4] = {at(10, 10), at(20, 10), at(20, 30), at(10, 30)};
    const draw_shades shades = {15, 5};
    draw_convex(&canvas, box, 4, shades);
    TEST_ASSERT_EQUAL(15, draw_get(&canvas, 15, 10));
    TEST_ASSERT_EQUAL(10, draw_get(&canvas, 15, 20));
    TEST_ASSERT_INT_WITHIN(1, 5, draw_get(&canvas, 15, 29));
}

void test_a_rim_lies_over_the_inside(void)
{
    const draw_point box[4] = {at(10, 10), at(20, 10), at(20, 20), at(10, 20)};
    draw_rimmed(&canvas, box, 4, 3, draw_shade(12));
    TEST_ASSERT_EQUAL(3, draw_get(&canvas, 10, 15));
    TEST_ASSERT_EQUAL(12, draw_get(&canvas, 15, 15));
    TEST_ASSERT_EQUAL(3, draw_get(&canvas, 20, 15));
}

void test_fewer_than_three_corners_draw_nothing(void)
{
    const draw_point line[2] = {at(10, 10), at(20, 20)};
    draw_convex(&canvas, line, 2, draw_shade(9));
    TEST_ASSERT_EQUAL(0, weight());
}

void test_a_polygon_larger_than_the_frame_fills_it(void)
{
    const draw_point box[4] = {at(-500, -500), at(500, -500), at(500, 500), at(-500, 500)};
    draw_convex(&canvas, box, 4, draw_shade(6));
    TEST_ASSERT_EQUAL(8192, count_of(6));
}

/* ---- circles ---- */

void test_a_disc_weighs_its_area(void)
{
    draw_disc(&canvas, at(60, 30), 20 * DRAW_SUB, draw_shade(15));
    /* pi * 20^2 */
    TEST_ASSERT_INT_WITHIN(120, 18850, weight());
}

void test_a_disc_is_even_to_both_sides(void)
{
    draw_disc(&canvas, at(64, 32), 11 * DRAW_SUB, draw_shade(13));
    for (int y = 0; y < DRAW_HEIGHT; y++)
        for (int x = 0; x < 64; x++)
            TEST_ASSERT_EQUAL(draw_get(&canvas, x, y), draw_get(&canvas, 127 - x, y));
}

void test_a_huge_disc_fills_the_frame(void)
{
    draw_disc(&canvas, at(0, 0), 1 << 24, draw_shade(4));
    TEST_ASSERT_EQUAL(8192, count_of(4));
}

void test_a_ring_is_closed_and_thin(void)
{
    draw_ring(&canvas, at(60, 30), 10 * DRAW_SUB, 9);
    TEST_ASSERT_EQUAL(9, draw_get(&canvas, 70, 30));
    TEST_ASSERT_EQUAL(9, draw_get(&canvas, 50, 30));
    TEST_ASSERT_EQUAL(9, draw_get(&canvas, 60, 20));
    TEST_ASSERT_EQUAL(9, draw_get(&canvas, 60, 40));
    TEST_ASSERT_EQUAL(0, draw_get(&canvas, 60, 30));
    TEST_ASSERT_TRUE(count_of(9) > 50 && count_of(9) < 80);
}

void test_a_ring_without_a_size_is_a_point(void)
{
    draw_ring(&canvas, at(60, 30), 3, 9);
    TEST_ASSERT_EQUAL(1, count_of(9));
    draw_disc(&canvas, at(60, 30), 0, draw_shade(8));
    TEST_ASSERT_EQUAL(0, count_of(8));
}

void test_the_mark_shows_where_the_axis_points(void)
{
    const draw_point axis = {0, -(1 << 14)};
    draw_mark(&canvas, at(60, 30), 10 * DRAW_SUB, axis, 9);
    TEST_ASSERT_EQUAL(9, draw_get(&canvas, 60, 20));
    TEST_ASSERT_EQUAL(11, count_of(9));
}

/* ---- anything ---- */

static int32_t any(void)
{
    const int32_t sizes[] = {2000, 40000, INT32_MAX / 2};
    return (int32_t)((int64_t)(rand() % 20001 - 10000) * sizes[rand() % 3] / 10000);
}

void test_random_shapes_never_write_behind_the_frame(void)
{
    srand(2);
    for (int i = 0; i < 4000; i++) {
        draw_point points[8];
        for (int k = 0; k < 8; k++) {
            points[k].x = any();
            points[k].y = any();
        }
        draw_convex(&canvas, points, 3 + i % 6, draw_shade(i & 15));
        draw_outline(&canvas, points, 3 + i % 6, i & 15);
        draw_line(&canvas, any(), any(), any(), any(), i & 15, DRAW_SOLID);
        draw_disc(&canvas, points[0], any(), draw_shade(i & 15));
        draw_ring(&canvas, points[1], any(), i & 15);
        const draw_point axis = {rand() % 32769 - 16384, rand() % 32769 - 16384};
        draw_mark(&canvas, points[2], any(), axis, i & 15);
        if (i % 50 == 0)
            draw_clip(&canvas, rand() % 100, rand() % 50, rand() % 128, rand() % 64);
    }
    TEST_PASS();
}
