/* Stones of all levels: every seed gives a convex one, the same each time, that the engine takes. */
#include "level.h"
#include "stone.h"

#include "unity.h"

CAIRN_WORLD(yard, 4, 8);

static stone s, other;
static cairn_world *world;

void setUp(void) { world = cairn_world_init(&yard, cairn_vec2_of(0, CAIRN_F(-8))); }

void test_every_seed_of_every_level_gives_a_stone_of_the_sizes_asked_for(void)
{
    for (int number = 0; number < level_count(); number++) {
        level l;
        level_get(&l, number);
        for (uint32_t seed = 1; seed < 300; seed++) {
            stone_shape(&s, seed * 2654435761u, &l.style);
            TEST_ASSERT_TRUE(s.polygon.count >= 4 && s.polygon.count <= STONE_CORNERS);
            TEST_ASSERT_EQUAL(CAIRN_OK, cairn_shape_measure(&s.polygon.shape, &s.polygon.mass));
            TEST_ASSERT_TRUE(s.polygon.shape.size.x < 2 * l.style.wide_max && s.polygon.shape.size.x > l.style.high_min / 2);
        }
    }
}

void test_the_same_seed_gives_the_same_stone(void)
{
    level l;
    level_get(&l, 0);
    stone_shape(&s, 77, &l.style);
    stone_shape(&other, 77, &l.style);
    TEST_ASSERT_EQUAL(s.polygon.count, other.polygon.count);
    for (int i = 0; i < s.polygon.count; i++) {
        TEST_ASSERT_EQUAL(s.polygon.vertex[i].x, other.polygon.vertex[i].x);
        TEST_ASSERT_EQUAL(s.polygon.vertex[i].y, other.polygon.vertex[i].y);
    }
    stone_shape(&other, 78, &l.style);
    TEST_ASSERT_TRUE(s.polygon.vertex[0].x != other.polygon.vertex[0].x || s.polygon.count != other.polygon.count);
}

void test_its_flat_angle_lays_the_longest_edge_down(void)
{
    const cairn_vec2 wedge[3] = {{0, 0}, {CAIRN_F(0.3), CAIRN_F(1)}, {CAIRN_F(-0.3), CAIRN_F(0.4)}};
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init(&s.polygon, wedge, 3));
    s.model = cairn_body_model_default(&s.polygon.shape);
    TEST_ASSERT_TRUE(stone_place(&s, world, cairn_vec2_of(0, 0), stone_flat_angle(&s), STONE_LANDED));
    cairn_vec2 corners[STONE_CORNERS];
    TEST_ASSERT_EQUAL(3, stone_corners(&s, world, corners));
    /* The longest edge is that of the first two corners. */
    TEST_ASSERT_INT_WITHIN(20, corners[0].y, corners[1].y);
    TEST_ASSERT_TRUE(corners[2].y > corners[0].y);
}

void test_its_top_is_its_highest_corner(void)
{
    level l;
    level_get(&l, 0);
    stone_shape(&s, 5, &l.style);
    TEST_ASSERT_TRUE(stone_place(&s, world, cairn_vec2_of(0, CAIRN_F(3)), CAIRN_DEGREES(30), STONE_LANDED));
    stone_measure(&s, world);
    cairn_vec2 corners[STONE_CORNERS];
    cairn_real top = 0;
    for (int i = 0; i < stone_corners(&s, world, corners); i++)
        top = corners[i].y > top ? corners[i].y : top;
    TEST_ASSERT_EQUAL(top, s.top);
    TEST_ASSERT_EQUAL(0, stone_speed(&s, world));
    TEST_ASSERT_FALSE(stone_touches(&s, world));
}

void test_a_full_world_takes_no_stone(void)
{
    level l;
    level_get(&l, 0);
    stone_shape(&s, 5, &l.style);
    for (int i = 0; i < 4; i++) {
        other = s;
        TEST_ASSERT_TRUE(stone_place(&other, world, cairn_vec2_of(0, 0), 0, STONE_LANDED));
    }
    TEST_ASSERT_FALSE(stone_place(&s, world, cairn_vec2_of(0, 0), 0, STONE_LANDED));
}
