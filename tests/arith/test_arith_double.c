/*
 * arith_double.h means what arith_fixed.h means: the same operation of the same arguments, and the same where the
 * algorithm limits a value. Includes the double definition whatever the library was built with; it is all inline.
 */
#ifndef CAIRN_DOUBLE
#define CAIRN_DOUBLE 1
#endif
#include "cairn/arith.h"

#include <unity.h>

#define NEAR 1e-12

void setUp(void) {}
void tearDown(void) {}

void test_constants_are_the_numbers_themselves(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(1.5, CAIRN_F(1.5));
    TEST_ASSERT_EQUAL_DOUBLE(1, CAIRN_UNIT(1));
    TEST_ASSERT_EQUAL_DOUBLE(0.5, CAIRN_RATIO(0.5));
    TEST_ASSERT_DOUBLE_WITHIN(NEAR, CAIRN_RADIANS(CAIRN_PI / 2), CAIRN_DEGREES(90));
}

void test_quotients_by_zero_are_as_in_fixed_point(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(-0.5, cairn_real_divide(1, -2));
    TEST_ASSERT_EQUAL_DOUBLE(CAIRN_REAL_MAX, cairn_real_divide(1, 0));
    TEST_ASSERT_EQUAL_DOUBLE(-CAIRN_REAL_MAX, cairn_real_divide(-1, 0));
    TEST_ASSERT_EQUAL_DOUBLE(0, cairn_real_divide(0, 0));
    TEST_ASSERT_TRUE(cairn_wide_is_zero(cairn_wide_div(1, 0)));
}

void test_roots_of_negatives_are_zero_as_in_fixed_point(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(3, cairn_real_sqrt(9));
    TEST_ASSERT_EQUAL_DOUBLE(0, cairn_real_sqrt(-9));
    TEST_ASSERT_EQUAL_DOUBLE(6, cairn_real_geometric_mean(4, 9));
    TEST_ASSERT_EQUAL_DOUBLE(0, cairn_real_geometric_mean(-4, -9));
    TEST_ASSERT_EQUAL_DOUBLE(0, cairn_motion_closing(1, -1, 1));
    TEST_ASSERT_DOUBLE_WITHIN(NEAR, 5, cairn_motion_closing(-3, 4, 2));
    TEST_ASSERT_DOUBLE_WITHIN(NEAR, 5, cairn_real_length(-3, 4));
}

void test_angles_are_radians(void)
{
    cairn_unit c, s;
    cairn_angle_rotation(CAIRN_DEGREES(30), &c, &s);
    TEST_ASSERT_DOUBLE_WITHIN(NEAR, 0.5, s);
    TEST_ASSERT_DOUBLE_WITHIN(NEAR, CAIRN_DEGREES(30), cairn_angle_of(s, c));
    TEST_ASSERT_DOUBLE_WITHIN(NEAR, CAIRN_PI / 2, cairn_angle_of_turn(1, 4));
    TEST_ASSERT_DOUBLE_WITHIN(NEAR, -CAIRN_PI / 2, cairn_angle_radians(CAIRN_DEGREES(270)));
    TEST_ASSERT_EQUAL_DOUBLE(0, cairn_angle_of(0, 0));
}

void test_wide_numbers_are_magnitudes(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(6, cairn_wide_of(-3, 1));
    TEST_ASSERT_EQUAL_DOUBLE(3, cairn_wide_from_int(-3));
    TEST_ASSERT_EQUAL_DOUBLE(3, cairn_wide_from_real(-3));
    TEST_ASSERT_EQUAL_DOUBLE(3, cairn_wide_from_offset(-3));
    TEST_ASSERT_EQUAL_DOUBLE(5, cairn_wide_from_sum(-2, -3));
    TEST_ASSERT_EQUAL_DOUBLE(5, cairn_wide_from_area(-5));
    TEST_ASSERT_EQUAL_DOUBLE(1, cairn_wide_determinant(1, 1, 2, 1));
    TEST_ASSERT_TRUE(cairn_wide_less(1, 2));
}

void test_lever_is_held_to_its_bound(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(1, cairn_lever_of(0.5, 2));
    TEST_ASSERT_EQUAL_DOUBLE(CAIRN_LEVER_MAX, cairn_lever_of(500, 2));
    TEST_ASSERT_EQUAL_DOUBLE(-CAIRN_LEVER_MAX, cairn_lever_of(-500, 2));
}

void test_coordinate_moves(void)
{
    cairn_real x = 0;
    cairn_residue residue = 1;
    cairn_coordinate_move(&x, &residue, 1.25);
    TEST_ASSERT_EQUAL_DOUBLE(1.25, x);
    TEST_ASSERT_EQUAL_INT(0, residue);
    TEST_ASSERT_EQUAL_DOUBLE(-2, cairn_coordinate_offset(5, 0, 3, 0));
    TEST_ASSERT_EQUAL_DOUBLE(5, cairn_coordinate_round(5, 0));
}

void test_unit_along_nothing_is_along_x(void)
{
    cairn_unit ux, uy;
    TEST_ASSERT_EQUAL_DOUBLE(0, cairn_unit_along(0, 0, &ux, &uy));
    TEST_ASSERT_EQUAL_DOUBLE(1, ux);
    TEST_ASSERT_EQUAL_DOUBLE(0, uy);
    TEST_ASSERT_DOUBLE_WITHIN(NEAR, 5, cairn_unit_along(-3, 4, &ux, &uy));
    TEST_ASSERT_DOUBLE_WITHIN(NEAR, -0.6, ux);
    TEST_ASSERT_DOUBLE_WITHIN(NEAR, 0.8, uy);
}

void test_inverse_of_a_factor_is_at_most_two(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0.25, cairn_factor_inverse(4));
    TEST_ASSERT_EQUAL_DOUBLE(2, cairn_factor_inverse(0.5));
    TEST_ASSERT_EQUAL_DOUBLE(2, cairn_factor_inverse(0));
    TEST_ASSERT_EQUAL_DOUBLE(2, cairn_factor_inverse(-1));
}

void test_parts_are_held_between_none_and_all(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0, cairn_motion_fraction(-5, 10));
    TEST_ASSERT_EQUAL_DOUBLE(1, cairn_motion_fraction(11, 10));
    TEST_ASSERT_EQUAL_DOUBLE(0.5, cairn_motion_fraction(5, 10));
    TEST_ASSERT_EQUAL_DOUBLE(-3, cairn_motion_clamp(-5, 3));
    TEST_ASSERT_EQUAL_DOUBLE(3, cairn_motion_clamp(5, 3));
}

void test_diffused_change_is_the_product(void)
{
    cairn_diffused d = cairn_diffused_of(-9.81, 1.0 / 57600);
    TEST_ASSERT_DOUBLE_WITHIN(NEAR, -9.81 / 57600, cairn_diffuse(&d));
    TEST_ASSERT_DOUBLE_WITHIN(NEAR, -9.81 / 57600, cairn_diffuse(&d));
}
