/*
 * The contract of arith_fixed.h in whole numbers: what is exact is exact, what is rounded is rounded to the nearest,
 * what saturates does so on both sides, and every core gives the same bits. Errors in units of the last place are
 * measured by tests/arith/errors.c.
 */
#include "arith_random.h"
#include "cairn/arith.h"

#include <unity.h>

/* The reference arithmetic is slow on a core. */
#ifdef __arm__
#define ROUNDS 10000
#else
#define ROUNDS 1000000
#endif

#define ONE CAIRN_UNIT(1)

static arith_random random;

void setUp(void) { random = arith_random_seeded(7); }
void tearDown(void) {}

static int32_t any(void) { return arith_random_argument(&random); }

/* A random positive number of any magnitude. */
static int32_t some(void)
{
    int32_t x = any();
    return x > 0 ? x : x < 0 ? -x : 1;
}

static uint64_t size64(int64_t x) { return x < 0 ? 0u - (uint64_t)x : (uint64_t)x; }

/* Whether n / d lies within half of r, halves upwards: by division, which the code under test never does. */
static int64_t nearest_up(int64_t n, int64_t d)
{
    int64_t q = n / d, rest = n % d;
    if (rest < 0) {
        rest += d;
        q--;
    }
    return 2 * rest >= d ? q + 1 : q;
}

/* Asserts cheaply: Unity is called for a failure only. */
static void expect(int64_t expected, int64_t actual, int32_t a, int32_t b)
{
    if (expected != actual) {
        UnityPrintNumber(a);
        UnityPrint(" ");
        UnityPrintNumber(b);
        TEST_ASSERT_EQUAL_INT64(expected, actual);
    }
}

static void expect_within(int64_t bound, int64_t expected, int64_t actual, int32_t a, int32_t b)
{
    if (size64(actual - expected) > (uint64_t)bound) {
        UnityPrintNumber(a);
        UnityPrint(" ");
        UnityPrintNumber(b);
        TEST_ASSERT_INT64_WITHIN((uint64_t)bound, expected, actual);
    }
}

static int64_t clamped(int64_t x) { return x > INT32_MAX ? INT32_MAX : x < -INT32_MAX ? -INT32_MAX : x; }

/* ---- constants ---- */

void test_constants_are_rounded_to_nearest(void)
{
    TEST_ASSERT_EQUAL_INT32(65536, CAIRN_F(1));
    TEST_ASSERT_EQUAL_INT32(-98304, CAIRN_F(-1.5));
    TEST_ASSERT_EQUAL_INT32(6554, CAIRN_F(0.1));
    TEST_ASSERT_EQUAL_INT32(-6554, CAIRN_F(-0.1));
    TEST_ASSERT_EQUAL_INT32(1 << 28, CAIRN_MOTION(1));
    TEST_ASSERT_EQUAL_INT32(1 << 22, CAIRN_OFFSET(1));
    TEST_ASSERT_EQUAL_INT32(1 << 30, CAIRN_UNIT(1));
    TEST_ASSERT_EQUAL_INT32(8192, CAIRN_RATIO(0.5));
    TEST_ASSERT_EQUAL_INT32(1 << 29, CAIRN_SHARE(0.5));
    TEST_ASSERT_EQUAL_INT32(1 << 20, CAIRN_FACTOR(1));
}

void test_angles_as_constants_wrap(void)
{
    TEST_ASSERT_EQUAL_INT32(0x40000000, CAIRN_DEGREES(90));
    TEST_ASSERT_EQUAL_INT32(INT32_MIN, CAIRN_DEGREES(180));
    TEST_ASSERT_EQUAL_INT32(-0x40000000, CAIRN_DEGREES(270));
    TEST_ASSERT_EQUAL_INT32(0x40000000, CAIRN_RADIANS(1.57079632679489661923));
    TEST_ASSERT_EQUAL_INT32(CAIRN_DEGREES(-30), CAIRN_DEGREES(330));
}

/* ---- primitives ---- */

void test_products_round_halves_upwards(void)
{
    TEST_ASSERT_EQUAL_INT32(1, cairn_mul16(1, 1, 1));
    TEST_ASSERT_EQUAL_INT32(0, cairn_mul16(-1, 1, 1));
    TEST_ASSERT_EQUAL_INT32(2, cairn_mul16(3, 1, 1));
    TEST_ASSERT_EQUAL_INT32(-1, cairn_mul16(-3, 1, 1));
    TEST_ASSERT_EQUAL_INT32(1, cairn_mul32(1 << 30, 2, 32));
    TEST_ASSERT_EQUAL_INT32(0, cairn_mul32(-(1 << 30), 2, 32));
    TEST_ASSERT_EQUAL_INT32(1, cairn_dot16(8192, 1, 0, 0, 14));
    TEST_ASSERT_EQUAL_INT32(0, cairn_dot16(-8192, 1, 0, 0, 14));
    TEST_ASSERT_EQUAL_INT32(1, cairn_dot32(1 << 15, 1 << 13, 1 << 15, 1 << 13, 30));
}

void test_products_of_64_bits_are_exact(void)
{
    for (int i = 0; i < 20000; i++) {
        int32_t a = any(), b = any();
        TEST_ASSERT_TRUE(cairn_times(a, b) == (int64_t)a * b);
        expect(clamped(nearest_up((int64_t)a * b, 1 << 20)), cairn_mul_clamped(a, b, 20), a, b);
    }
    TEST_ASSERT_TRUE(cairn_times(INT32_MIN, INT32_MIN) == (int64_t)1 << 62);
    TEST_ASSERT_TRUE(cairn_times(INT32_MIN, INT32_MAX) == -((int64_t)1 << 62) + ((int64_t)1 << 31));
}

void test_inverse_of_a_wide_number_is_its_quotient(void)
{
    for (int i = 0; i < 1000; i++) {
        cairn_wide x = cairn_wide_of(any(), -16), inverse = cairn_wide_inverse(x), quotient = cairn_wide_div(cairn_wide_from_int(1), x);
        TEST_ASSERT_EQUAL_UINT32(quotient.mantissa, inverse.mantissa);
        TEST_ASSERT_EQUAL_INT32(quotient.exponent, inverse.exponent);
    }
    TEST_ASSERT_TRUE(cairn_wide_is_zero(cairn_wide_inverse(cairn_wide_zero())));
}

void test_products_are_the_nearest(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t a = any(), b = any(), c = any(), d = any();
        int32_t dir_b = b % 16385, dir_d = d % 16385;
        expect(nearest_up((int64_t)a * dir_b, 16384), cairn_mul16(a, dir_b, 14), a, dir_b);
        expect(nearest_up((int64_t)a * b, (int64_t)1 << 32), cairn_mul32(a, b, 32), a, b);
        expect(nearest_up((int64_t)a / 2 * dir_b + (int64_t)c / 2 * dir_d, 16384), cairn_dot16(a / 2, dir_b, c / 2, dir_d, 14), a, c);
        expect(nearest_up((int64_t)a * (b / 4) + (int64_t)c * (d / 4), (int64_t)1 << 30), cairn_dot32(a, b / 4, c, d / 4, 30), a, b);
    }
}

void test_halves_of_products_are_rounded_once(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t a = any() / 2, c = any() / 2;
        int16_t j = (int16_t)(any() % 16385), k = (int16_t)(any() % 16385);
        expect(nearest_up((int64_t)a * j, 32768), cairn_motion_half_dir(a, j), a, j);
        expect(nearest_up((int64_t)a * j, 16384), cairn_motion_half_lever(a, j), a, j);
        expect(nearest_up((int64_t)a * j + (int64_t)c * k, 32768), cairn_motion_half_along(a, c, j, k), a, c);
        expect(nearest_up((int64_t)(a / 2) * j + (int64_t)(c / 2) * k, 8192), cairn_motion_levers(a / 2, j, c / 2, k), a, c);
        expect(nearest_up((int64_t)(a % (1 << 20)) * (k / 8), 16384), cairn_motion_ratio_short(a % (1 << 20), (int16_t)(k / 8)), a, k);
    }
    TEST_ASSERT_TRUE(cairn_lever_is_short(16384) && cairn_lever_is_short(-16384));
    TEST_ASSERT_FALSE(cairn_lever_is_short(16385) || cairn_lever_is_short(-16385));
}

void test_sizes_of_several_motions(void)
{
    cairn_size size = cairn_size_with(cairn_size_with(cairn_size_of(-9), 5), 0);
    TEST_ASSERT_TRUE(cairn_size_is_below(size, 18));
    TEST_ASSERT_FALSE(cairn_size_is_below(size, 8));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t a = any(), b = any(), limit = any() & INT32_MAX;
        uint32_t greatest = (uint32_t)(size64(a) > size64(b) ? size64(a) : size64(b));
        bool below = cairn_size_is_below(cairn_size_with(cairn_size_of(a), b), limit);
        TEST_ASSERT_TRUE(!below || greatest <= (uint32_t)limit);
        TEST_ASSERT_TRUE(below || 2 * (uint64_t)greatest >= (uint32_t)limit);
    }
    TEST_ASSERT_TRUE(cairn_size_is_far_below(cairn_size_of(1), 64));
    TEST_ASSERT_FALSE(cairn_size_is_far_below(cairn_size_of(1), 63));
    TEST_ASSERT_EQUAL_INT32(0, cairn_motion_above_zero(-1, 7));
    TEST_ASSERT_EQUAL_INT32(7, cairn_motion_above_zero(8, 7));
    TEST_ASSERT_EQUAL_INT32(7, cairn_motion_above_zero(7, 7));
}

void test_leading_zeros_of_every_length(void)
{
    TEST_ASSERT_EQUAL_INT(32, cairn_clz(0));
    for (int bit = 0; bit < 32; bit++) {
        TEST_ASSERT_EQUAL_INT(31 - bit, cairn_clz((uint32_t)1 << bit));
        TEST_ASSERT_EQUAL_INT(31 - bit, cairn_clz(UINT32_MAX >> (31 - bit)));
    }
}

void test_saturation_is_symmetric(void)
{
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_clamp64((int64_t)INT32_MAX + 1));
    TEST_ASSERT_EQUAL_INT32(-INT32_MAX, cairn_clamp64(-(int64_t)INT32_MAX - 1));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_clamp64(INT64_MAX));
    TEST_ASSERT_EQUAL_INT32(-INT32_MAX, cairn_clamp64(INT64_MIN));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_motion_add(INT32_MAX, 1));
    TEST_ASSERT_EQUAL_INT32(-INT32_MAX, cairn_motion_add(-INT32_MAX, -1));
    TEST_ASSERT_EQUAL_INT32(-INT32_MAX, cairn_motion_add(-INT32_MAX, -INT32_MAX));
    TEST_ASSERT_EQUAL_INT32(-5, cairn_clamp(-9, 5));
    TEST_ASSERT_EQUAL_INT32(5, cairn_clamp(9, 5));
    TEST_ASSERT_EQUAL_INT32(3, cairn_clamp(3, 5));
}

void test_sums_saturate_and_are_exact_within(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t a = any(), b = any();
        expect(clamped((int64_t)a + b), cairn_real_add(a, b), a, b);
        expect(clamped((int64_t)a - b), cairn_real_sub(a, b), a, b);
        expect(clamped((int64_t)a + b), cairn_motion_add(a, b), a, b);
        expect(clamped((int64_t)a * 65536), cairn_real_from_int(a), a, 0);
    }
}

void test_clamp_and_its_question_agree_with_comparisons(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = (i & 1023) == 0 ? INT32_MIN : any(), limit = i & 1 ? some() : (int32_t)(i & 2) * (INT32_MAX / 2);
        expect(x > limit ? limit : x < -limit ? -limit : x, cairn_clamp(x, limit), x, limit);
        expect(x <= limit && x >= -limit, cairn_real_is_within(x, limit), x, limit);
    }
}

/* ---- cairn_real ---- */

void test_real_product_is_nearest_and_saturates(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(-6), cairn_real_mul(CAIRN_F(2), CAIRN_F(-3)));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_real_mul(CAIRN_F(300), CAIRN_F(300)));
    TEST_ASSERT_EQUAL_INT32(-INT32_MAX, cairn_real_mul(CAIRN_F(300), CAIRN_F(-300)));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t a = any(), b = any();
        expect(clamped(nearest_up((int64_t)a * b, 65536)), cairn_real_mul(a, b), a, b);
    }
}

void test_quotient_is_nearest_with_halves_away_from_zero(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(-0.5), cairn_real_divide(CAIRN_F(1), CAIRN_F(-2)));
    TEST_ASSERT_EQUAL_INT32(1, cairn_real_divide(1, 131072));
    TEST_ASSERT_EQUAL_INT32(-1, cairn_real_divide(-1, 131072));
    TEST_ASSERT_EQUAL_INT32(0, cairn_real_divide(1, 131073));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t a = any(), b = any();
        if (b != 0) {
            int64_t n = (int64_t)size64(a) << 16, d = (int64_t)size64(b), q = (n + d / 2) / d;
            expect(clamped((a < 0) != (b < 0) ? -q : q), cairn_real_divide(a, b), a, b);
        }
    }
}

void test_quotient_by_zero_is_the_largest_of_its_sign(void)
{
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_real_divide(1, 0));
    TEST_ASSERT_EQUAL_INT32(-INT32_MAX, cairn_real_divide(-1, 0));
    TEST_ASSERT_EQUAL_INT32(0, cairn_real_divide(0, 0));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_real_divide(CAIRN_F(1), 1));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_real_divide(INT32_MIN, -1));
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(1), cairn_real_divide(INT32_MIN, INT32_MIN));
}

/* r is the root of n to the nearest: (r - 1/2)^2 < n < (r + 1/2)^2, both sides times 1 and without the quarter. */
static bool is_nearest_root(uint64_t r, uint64_t n)
{
    return (r == 0 || r * r - r < n) && n <= r * r + r;
}

void test_root_is_nearest(void)
{
    TEST_ASSERT_EQUAL_INT32(0, cairn_real_sqrt(0));
    TEST_ASSERT_EQUAL_INT32(0, cairn_real_sqrt(CAIRN_F(-4)));
    TEST_ASSERT_EQUAL_INT32(0, cairn_real_sqrt(INT32_MIN));
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(3), cairn_real_sqrt(CAIRN_F(9)));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = some();
        if (!is_nearest_root((uint64_t)cairn_real_sqrt(x), (uint64_t)x << 16)) { expect(0, cairn_real_sqrt(x), x, 0); }
    }
}

void test_length_is_nearest_and_saturates(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(5), cairn_real_length(CAIRN_F(-3), CAIRN_F(4)));
    TEST_ASSERT_EQUAL_INT32(0, cairn_real_length(0, 0));
    TEST_ASSERT_EQUAL_INT32(1, cairn_real_length(0, -1));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_real_length(INT32_MAX, INT32_MAX));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_real_length(INT32_MIN, INT32_MIN));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_real_length(0, INT32_MIN));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = any(), y = any();
        uint64_t square = (uint64_t)((int64_t)x * x) + (uint64_t)((int64_t)y * y);
        int32_t length = cairn_real_length(x, y);
        bool right = length == INT32_MAX ? square > (uint64_t)length * (uint64_t)length - (uint64_t)length
                                         : is_nearest_root((uint64_t)length, square);
        if (!right) { expect(0, length, x, y); }
    }
}

void test_what_is_longer_by_a_millimetre_is_told_and_nothing_shorter_is(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        cairn_real r = (cairn_real)(arith_random_bits(&random) % (8u << 16)), x = any() >> 11, y = any() >> 11;
        cairn_real length = cairn_real_length(x, y);
        bool longer = cairn_real_is_longer(x, y, r);
        TEST_ASSERT_TRUE(!longer || length >= r);
        TEST_ASSERT_TRUE(longer || length <= r + CAIRN_F(0.001));
    }
    TEST_ASSERT_TRUE(cairn_real_is_longer(CAIRN_F(-20000), CAIRN_F(20000), CAIRN_F(7.9)));
    TEST_ASSERT_FALSE(cairn_real_is_longer(CAIRN_F(9), 0, CAIRN_F(8)));
}

void test_geometric_mean_is_nearest(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(6), cairn_real_geometric_mean(CAIRN_F(4), CAIRN_F(9)));
    TEST_ASSERT_EQUAL_INT32(0, cairn_real_geometric_mean(0, CAIRN_F(9)));
    TEST_ASSERT_EQUAL_INT32(0, cairn_real_geometric_mean(CAIRN_F(-4), CAIRN_F(-9)));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_real_geometric_mean(INT32_MAX, INT32_MAX));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t a = some(), b = some();
        uint64_t mean = (uint64_t)cairn_real_geometric_mean(a, b);
        if (!is_nearest_root(mean, (uint64_t)a * (uint64_t)b)) { expect(0, (int64_t)mean, a, b); }
        expect(a - 1, cairn_real_geometric_mean(a, a - 1), a, a - 1); /* a hair below the middle between the two */
    }
}

void test_floor_and_half_of_negatives(void)
{
    TEST_ASSERT_EQUAL_INT32(-2, cairn_real_floor(CAIRN_F(-1.5)));
    TEST_ASSERT_EQUAL_INT32(1, cairn_real_floor(CAIRN_F(1.5)));
    TEST_ASSERT_EQUAL_INT32(-1, cairn_real_half(-3));
}

void test_turned_real_is_nearest_and_saturates(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(3), cairn_real_turn(CAIRN_F(2), CAIRN_F(4), CAIRN_UNIT(0.5), CAIRN_UNIT(0.5)));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_real_turn(INT32_MAX, INT32_MAX, CAIRN_UNIT(0.75), CAIRN_UNIT(0.75)));
    TEST_ASSERT_EQUAL_INT32(-INT32_MAX, cairn_real_turn(INT32_MAX, INT32_MAX, CAIRN_UNIT(-0.75), CAIRN_UNIT(-0.75)));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = any(), y = any(), c = any() / 2, s = any() / 2;
        expect(clamped(nearest_up((int64_t)x * c + (int64_t)y * s, ONE)), cairn_real_turn(x, y, c, s), x, y);
    }
}

/* ---- angles ---- */

void test_rotation_is_exact_at_quarter_turns(void)
{
    static const int32_t turns[4][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
    for (uint32_t quarter = 0; quarter < 4; quarter++) {
        cairn_unit cosine, sine;
        cairn_angle_rotation((cairn_angle)(quarter << 30), &cosine, &sine);
        TEST_ASSERT_EQUAL_INT32(turns[quarter][0] * ONE, cosine);
        TEST_ASSERT_EQUAL_INT32(turns[quarter][1] * ONE, sine);
    }
}

void test_rotation_turns_by_quarters_exactly(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t angle = (int32_t)arith_random_bits(&random);
        cairn_unit c, s, turned_c, turned_s;
        if (((uint32_t)angle & 0x3FFFFFFFu) == 0x20000000u) { continue; } /* an eighth belongs to one side */
        cairn_angle_rotation(angle, &c, &s);
        cairn_angle_rotation(cairn_angle_add(angle, 0x40000000), &turned_c, &turned_s);
        expect(-s, turned_c, angle, 0);
        expect(c, turned_s, angle, 0);
    }
}

void test_rotation_back_is_the_mirror_image(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t angle = any();
        cairn_unit c, s, back_c, back_s;
        cairn_angle_rotation(angle, &c, &s);
        cairn_angle_rotation(-angle, &back_c, &back_s);
        expect_within(2, c, back_c, angle, 0);
        expect_within(2, -s, back_s, angle, 0);
    }
}

void test_rotation_has_known_values(void)
{
    /* round(2^30 cos), round(2^30 sin) of i / 24 of a turn and of 1 radian */
    static const struct {
        cairn_angle angle;
        int32_t cosine, sine;
    } known[] = {
        { 178956971, 1037154959, 277904834 }, { 357913941, 929887697, 536870912 }, { 536870912, 759250125, 759250125 },
        { 715827883, 536870912, 929887697 },  { 894784853, 277904834, 1037154959 }, { 683565276, 580145183, 903522590 },
    };
    for (uint32_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        cairn_unit c, s;
        cairn_angle_rotation(known[i].angle, &c, &s);
        TEST_ASSERT_INT32_WITHIN(4, known[i].cosine, c);
        TEST_ASSERT_INT32_WITHIN(4, known[i].sine, s);
    }
}

void test_direction_of_axes_and_diagonals_is_exact(void)
{
    for (int32_t size = 1; size > 0 && size < INT32_MAX / 4; size = size * 3 + 1) {
        TEST_ASSERT_EQUAL_INT32(0, cairn_angle_of(0, size));
        TEST_ASSERT_EQUAL_INT32(0x20000000, cairn_angle_of(size, size));
        TEST_ASSERT_EQUAL_INT32(0x40000000, cairn_angle_of(size, 0));
        TEST_ASSERT_EQUAL_INT32(0x60000000, cairn_angle_of(size, -size));
        TEST_ASSERT_EQUAL_INT32(INT32_MIN, cairn_angle_of(0, -size));
        TEST_ASSERT_EQUAL_INT32(-0x60000000, cairn_angle_of(-size, -size));
        TEST_ASSERT_EQUAL_INT32(-0x40000000, cairn_angle_of(-size, 0));
        TEST_ASSERT_EQUAL_INT32(-0x20000000, cairn_angle_of(-size, size));
    }
    TEST_ASSERT_EQUAL_INT32(0, cairn_angle_of(0, 0));
    TEST_ASSERT_EQUAL_INT32(-0x60000000, cairn_angle_of(INT32_MIN, INT32_MIN));
}

void test_direction_undoes_rotation(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t angle = (int32_t)arith_random_bits(&random);
        cairn_unit c, s;
        cairn_angle_rotation(angle, &c, &s);
        expect_within(4, 0, cairn_angle_of(s, c) - (int64_t)angle, angle, 0);
    }
}

void test_radians_there_and_back(void)
{
    TEST_ASSERT_EQUAL_INT32(102944, cairn_angle_radians(0x40000000)); /* pi/2 = 102943.7 / 65536 */
    TEST_ASSERT_EQUAL_INT32(-205887, cairn_angle_radians(INT32_MIN));
    TEST_ASSERT_EQUAL_INT32(0, cairn_angle_from_radians(0));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t radians = any() % 205887;
        expect_within(0, radians, cairn_angle_radians(cairn_angle_from_radians(radians)), radians, 0);
    }
}

void test_parts_of_a_turn_are_nearest(void)
{
    TEST_ASSERT_EQUAL_INT32(0x40000000, cairn_angle_of_turn(1, 4));
    TEST_ASSERT_EQUAL_INT32(INT32_MIN, cairn_angle_of_turn(2, 4));
    TEST_ASSERT_EQUAL_INT32(1431655765, cairn_angle_of_turn(1, 3));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t whole = (int32_t)(arith_random_bits(&random) >> 16) + 1, part;
        whole = whole > 65535 ? 65535 : whole;
        part = (int32_t)(arith_random_bits(&random) >> 16) % whole;
        expect((int32_t)(uint32_t)nearest_up((int64_t)part << 32, whole), cairn_angle_of_turn(part, whole), part, whole);
    }
}

/* ---- cairn_wide ---- */

/* A statement each: the order of a call's arguments is the compiler's. */
static cairn_wide some_wide(void)
{
    int32_t x = some();
    int exponent = (int)(arith_random_bits(&random) >> 26) - 32;
    return cairn_wide_of(x, exponent);
}

static bool is_normal(cairn_wide k) { return k.mantissa == 0 ? k.exponent == 0 : k.mantissa >> 31 == 1; }

void test_wide_of_is_exact(void)
{
    cairn_wide zero = cairn_wide_of(0, 5);
    TEST_ASSERT_TRUE(cairn_wide_is_zero(zero) && is_normal(zero));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = any();
        cairn_wide k = cairn_wide_of(x, 3);
        if (x != 0) {
            expect(1, k.mantissa >> 31, x, 0);
            expect((int64_t)size64(x), k.mantissa >> (3 - k.exponent), x, 0);
        }
    }
    TEST_ASSERT_EQUAL_HEX32(0x80000000u, cairn_wide_of(INT32_MIN, 0).mantissa);
}

void test_wide_product_is_within_half_a_unit(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        cairn_wide a = some_wide(), b = some_wide(), p = cairn_wide_mul(a, b);
        int down = p.exponent - a.exponent - b.exponent; /* 31 or 32 */
        uint64_t exact = (uint64_t)a.mantissa * b.mantissa;
        int64_t off = (int64_t)(((uint64_t)p.mantissa << down) - exact); /* wraps back when the product does not fit */
        if (!is_normal(p) || size64(off) > (uint64_t)1 << (down - 1)) { expect(0, off, (int32_t)a.mantissa, (int32_t)b.mantissa); }
    }
}

void test_wide_quotient_times_divisor_is_the_dividend(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        cairn_wide a = some_wide(), b = some_wide(), q = cairn_wide_div(a, b);
        int up = a.exponent - b.exponent - q.exponent; /* 31 or 32 */
        int64_t rest = (int64_t)(((uint64_t)a.mantissa << (up - 1)) - (uint64_t)q.mantissa * b.mantissa / 2); /* in halves: up to 2^63 */
        if (!is_normal(q) || size64(rest) > b.mantissa / 2 + 1) { expect(0, rest, (int32_t)a.mantissa, (int32_t)b.mantissa); }
    }
}

void test_wide_zero_absorbs_and_is_neutral(void)
{
    cairn_wide zero = cairn_wide_of(0, 0), two = cairn_wide_from_int(2);
    TEST_ASSERT_TRUE(cairn_wide_is_zero(cairn_wide_mul(zero, two)));
    TEST_ASSERT_TRUE(cairn_wide_is_zero(cairn_wide_div(zero, two)));
    TEST_ASSERT_TRUE(cairn_wide_is_zero(cairn_wide_div(two, zero)));
    TEST_ASSERT_TRUE(cairn_wide_is_zero(cairn_wide_sqrt(zero)));
    TEST_ASSERT_TRUE(cairn_wide_is_zero(cairn_wide_add(zero, zero)));
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(2), cairn_wide_to_real(cairn_wide_add(zero, two)));
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(2), cairn_wide_to_real(cairn_wide_add(two, zero)));
    TEST_ASSERT_TRUE(cairn_wide_less(zero, two));
    TEST_ASSERT_FALSE(cairn_wide_less(two, zero));
    TEST_ASSERT_FALSE(cairn_wide_less(zero, zero));
    TEST_ASSERT_FALSE(cairn_wide_less(two, two));
    TEST_ASSERT_EQUAL_INT32(0, cairn_wide_scale(INT32_MAX, zero, 100));
    TEST_ASSERT_EQUAL_INT32(0, cairn_wide_scale(0, two, 100));
}

void test_a_packed_number_is_within_2_to_the_minus_25_and_zero_stays_zero(void)
{
    static const uint32_t mantissas[] = { 0x80000000u, 0x8000007Fu, 0x80000080u, 0xC0FFEE42u, 0xFFFFFF7Fu, 0xFFFFFF80u, 0xFFFFFFFFu };
    static const int32_t exponents[] = { -127, -40, -31, 0, 126 };
    for (int i = 0; i < 7; i++) {
        for (int j = 0; j < 5; j++) {
            cairn_wide k = { mantissas[i], exponents[j] };
            cairn_wide back = cairn_wide_unpack(cairn_wide_pack(k));
            int64_t off = back.exponent == k.exponent ? (int64_t)back.mantissa - k.mantissa : 2 * (int64_t)back.mantissa - k.mantissa;
            TEST_ASSERT_TRUE(back.mantissa & 0x80000000u);
            TEST_ASSERT_TRUE(back.exponent == k.exponent || back.exponent == k.exponent + 1);
            TEST_ASSERT_TRUE(off <= 128 && off >= -128);
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, cairn_wide_pack(cairn_wide_from_int(0)));
    TEST_ASSERT_TRUE(cairn_wide_is_zero(cairn_wide_unpack(0)));
}

void test_wide_sum_of_neighbours_and_of_far_ones(void)
{
    cairn_wide one = cairn_wide_from_int(1);
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(3), cairn_wide_to_real(cairn_wide_add(one, cairn_wide_from_int(2))));
    for (int exponent = 0; exponent < 40; exponent++) {
        cairn_wide sum = cairn_wide_add(cairn_wide_of(1, -exponent), one);
        uint32_t expected = exponent == 0 ? 0x80000000u : exponent < 32 ? 0x80000000u + (0x80000000u >> exponent) : 0x80000000u;
        expected += exponent == 32 ? 1u : 0u; /* half a unit: upwards */
        TEST_ASSERT_EQUAL_HEX32(expected, sum.mantissa);
    }
    for (int32_t i = 0; i < ROUNDS; i++) { /* in whole numbers the sum is exact */
        int32_t a = some() / 2, b = some() / 2;
        expect((int64_t)a + b, cairn_wide_scale(1, cairn_wide_add(cairn_wide_from_int(a), cairn_wide_from_int(b)), 0), a, b);
    }
}

void test_wide_order_is_that_of_the_numbers(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t a = some(), b = some();
        expect(a < b, cairn_wide_less(cairn_wide_from_int(a), cairn_wide_from_int(b)), a, b);
    }
}

void test_wide_root_squared_is_the_number(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(1.5), cairn_wide_to_real(cairn_wide_sqrt(cairn_wide_from_real(CAIRN_F(2.25)))));
    for (int32_t i = 0; i < ROUNDS; i++) {
        cairn_wide a = some_wide(), r = cairn_wide_sqrt(a);
        int up = a.exponent - 2 * r.exponent; /* 31 or 32 */
        int64_t rest = (int64_t)(((uint64_t)a.mantissa << up) - (uint64_t)r.mantissa * r.mantissa);
        if (!is_normal(r) || up < 31 || up > 32 || size64(rest) > r.mantissa) { expect(0, rest, (int32_t)a.mantissa, a.exponent); }
    }
}

void test_wide_of_sums_and_areas(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(1000), cairn_wide_to_real(cairn_wide_from_sum(CAIRN_OFFSET(500), CAIRN_OFFSET(500))));
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(1000), cairn_wide_to_real(cairn_wide_from_sum(-CAIRN_OFFSET(500), -CAIRN_OFFSET(500))));
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(6), cairn_wide_to_real(cairn_wide_from_area((cairn_area)CAIRN_OFFSET(2) * CAIRN_OFFSET(-3))));
    TEST_ASSERT_EQUAL_INT32(CAIRN_OFFSET(2.5), cairn_wide_to_offset(cairn_wide_from_offset(CAIRN_OFFSET(-2.5))));
}

void test_wide_determinant_is_within_half_a_unit(void)
{
    TEST_ASSERT_TRUE(cairn_wide_is_zero(cairn_wide_determinant(ONE, ONE / 2, ONE, ONE / 2)));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t a = any() / 2, b = any() / 2, c = any() / 2, d = any() / 2;
        uint64_t exact = size64((int64_t)a * d - (int64_t)b * c);
        cairn_wide k = cairn_wide_determinant(a, b, c, d);
        int up = k.exponent + 60; /* of the mantissa over the exact value */
        uint64_t given = up >= 0 ? (uint64_t)k.mantissa << up : (uint64_t)(k.mantissa >> -up);
        uint64_t unit = up > 0 ? (uint64_t)1 << (up - 1) : 0;
        if (!is_normal(k) || (given > exact ? given - exact : exact - given) > unit) { expect(0, k.mantissa, a, d); }
    }
}

void test_wide_of_coefficients_and_back(void)
{
    TEST_ASSERT_EQUAL_INT(INT16_MAX, cairn_ratio_from_wide(cairn_wide_from_int(2)));
    TEST_ASSERT_EQUAL_INT32(CAIRN_SHARE(0.25), cairn_wide_to_share(cairn_wide_from_share(CAIRN_SHARE(0.25))));
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(1.5), cairn_wide_to_real(cairn_wide_from_factor(CAIRN_FACTOR(1.5))));
    TEST_ASSERT_EQUAL_INT32(CAIRN_MOTION(0.25), cairn_wide_to_motion(cairn_wide_of(1, -2)));
    TEST_ASSERT_EQUAL_INT32(CAIRN_MOTION(-1.5), cairn_motion_from_offset_wide(CAIRN_OFFSET(-0.5), cairn_wide_from_int(3)));
    TEST_ASSERT_EQUAL_INT32(205887, cairn_wide_to_real(CAIRN_WIDE_PI));
}

/* x * m / 2^shift to the nearest, halves away from zero */
static int64_t scaled(int32_t x, uint32_t m, int shift)
{
    uint64_t product = size64(x) * m;
    uint64_t size;
    if (shift <= 0) {
        size = product == 0 ? 0 : INT32_MAX; /* a mantissa is at least 2^31 */
    } else if (shift > 63) {
        size = 0;
    } else {
        size = (product >> shift) + (product >> (shift - 1) & 1u);
    }
    size = size > INT32_MAX ? INT32_MAX : size;
    return x < 0 ? -(int64_t)size : (int64_t)size;
}

void test_scaling_is_nearest_and_saturates(void)
{
    TEST_ASSERT_EQUAL_INT32(2, cairn_wide_scale(1, cairn_wide_of(3, -1), 0));
    TEST_ASSERT_EQUAL_INT32(-2, cairn_wide_scale(-1, cairn_wide_of(3, -1), 0));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_wide_scale(1, cairn_wide_of(1, 31), 0));
    TEST_ASSERT_EQUAL_INT32(-INT32_MAX, cairn_wide_scale(-1, cairn_wide_of(1, 31), 0));
    TEST_ASSERT_EQUAL_INT32(1 << 30, cairn_wide_scale(1, cairn_wide_of(1, 30), 0));
    TEST_ASSERT_EQUAL_INT32(-INT32_MAX, cairn_wide_scale(INT32_MIN, cairn_wide_of(1, 0), 0));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = any();
        cairn_wide k = some_wide();
        int exponent = (int)(arith_random_bits(&random) >> 26) - 32;
        expect(scaled(x, k.mantissa, -(k.exponent + exponent)), cairn_wide_scale(x, k, exponent), x, exponent);
    }
}

void test_velocities_go_into_substeps_and_back(void)
{
    cairn_wide h = cairn_wide_div(cairn_wide_from_int(1), cairn_wide_from_int(240));
    cairn_wide inverse = cairn_wide_from_int(240);
    TEST_ASSERT_EQUAL_INT32(11184811, cairn_motion_from_real(CAIRN_F(10), h)); /* 10/240 * 2^28 */
    TEST_ASSERT_EQUAL_INT32(CAIRN_F(10), cairn_real_from_motion(11184811, inverse));
    for (int32_t v = -CAIRN_F(100); v < CAIRN_F(100); v += 7919) {
        expect(v, cairn_real_from_motion(cairn_motion_from_real(v, h), inverse), v, 0);
    }
}

void test_motion_turns_by_its_angle(void)
{
    cairn_wide one = cairn_wide_from_int(1);
    TEST_ASSERT_EQUAL_INT32(CAIRN_RADIANS(1), cairn_angle_from_motion(CAIRN_MOTION(1), one));
    TEST_ASSERT_EQUAL_INT32(-CAIRN_RADIANS(1), cairn_angle_from_motion(-CAIRN_MOTION(1), one));
    TEST_ASSERT_EQUAL_INT32(CAIRN_RADIANS(0.5), cairn_angle_from_motion(CAIRN_MOTION(2), cairn_wide_of(1, -2)));
    TEST_ASSERT_EQUAL_INT32(0, cairn_angle_from_motion(CAIRN_MOTION(1), cairn_wide_of(0, 0)));
    TEST_ASSERT_EQUAL_INT32(0, cairn_angle_from_motion(CAIRN_MOTION(1), cairn_wide_of(1, -40)));
}

void test_whole_turns_wrap_away(void)
{
    cairn_wide ten = cairn_wide_from_int(10), thousand = cairn_wide_from_int(1000);
    /* within 2^-30 of the whole angle: 10 and 1000 radians are 1.6 and 159 * 2^32 */
    TEST_ASSERT_INT32_WITHIN(7, CAIRN_RADIANS(10), cairn_angle_from_motion(CAIRN_MOTION(1), ten));
    TEST_ASSERT_INT32_WITHIN(7, CAIRN_RADIANS(-10), cairn_angle_from_motion(CAIRN_MOTION(-1), ten));
    TEST_ASSERT_INT32_WITHIN(637, CAIRN_RADIANS(1000), cairn_angle_from_motion(CAIRN_MOTION(1), thousand));
    TEST_ASSERT_EQUAL_INT32(0, cairn_angle_from_motion(1, cairn_wide_of(1, 70)));
}

void test_lever_is_near_and_held_to_its_bound(void)
{
    cairn_wide two = cairn_wide_from_int(2);
    TEST_ASSERT_INT_WITHIN(1, 8192, cairn_lever_of(CAIRN_OFFSET(0.5), two));
    TEST_ASSERT_INT_WITHIN(1, -8192, cairn_lever_of(CAIRN_OFFSET(-0.5), two));
    TEST_ASSERT_EQUAL_INT(CAIRN_LEVER_MAX, cairn_lever_of(CAIRN_OFFSET(500), two));
    TEST_ASSERT_EQUAL_INT(-CAIRN_LEVER_MAX, cairn_lever_of(-CAIRN_OFFSET(500), two));
    TEST_ASSERT_EQUAL_INT(CAIRN_LEVER_MAX, cairn_lever_of(CAIRN_OFFSET(500), cairn_wide_of(1, 40)));
    TEST_ASSERT_EQUAL_INT(CAIRN_LEVER_MAX, cairn_lever_of(INT32_MAX, cairn_wide_of(1, -5)));
    TEST_ASSERT_EQUAL_INT(-CAIRN_LEVER_MAX, cairn_lever_of(INT32_MIN, cairn_wide_of(INT32_MAX, -32)));
    TEST_ASSERT_EQUAL_INT(0, cairn_lever_of(0, cairn_wide_from_int(1000)));
    TEST_ASSERT_EQUAL_INT(-CAIRN_LEVER_MAX, cairn_lever_of(-CAIRN_OFFSET(500), cairn_wide_of(1, 40)));
    TEST_ASSERT_EQUAL_INT(0, cairn_lever_of(CAIRN_OFFSET(500), cairn_wide_of(1, -60)));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t arm = any();
        int exponent = (int)(arith_random_bits(&random) >> 27) - 40;
        cairn_wide k = cairn_wide_of(some(), exponent);
        int64_t exact = cairn_clamp((int32_t)scaled(arm, k.mantissa, 9 - k.exponent), CAIRN_LEVER_MAX);
        bool smaller = k.exponent > 15 - 32; /* a radius below 31 micrometres: bounded and of the right sign */
        expect_within(smaller ? 0 : 1, smaller ? 0 : exact, smaller ? 0 : cairn_lever_of(arm, k), arm, (int32_t)k.mantissa);
        expect_within(CAIRN_LEVER_MAX, 0, cairn_lever_of(arm, k), arm, (int32_t)k.mantissa);
    }
}

/* ---- what is rounded in turn, step by step ---- */

void test_a_lever_in_turn_is_exact_in_the_mean(void)
{
    cairn_wide k = cairn_wide_sqrt(cairn_wide_from_int(8)); /* of a disc of 0.5 m: the lever is sqrt(2), 11585.2375 units */
    int32_t sum = 0;
    for (uint32_t step = 0; step < 10000; step++) {
        cairn_lever j = cairn_lever_in_turn(CAIRN_OFFSET(0.5), k, step);
        TEST_ASSERT_INT_WITHIN(1, 11585, j);
        sum += j;
    }
    TEST_ASSERT_INT_WITHIN(5, 115852375, sum);
}

void test_a_lever_in_turn_keeps_its_bound(void)
{
    for (uint32_t step = 0; step < 100; step++) {
        TEST_ASSERT_EQUAL_INT(CAIRN_LEVER_MAX, cairn_lever_in_turn(CAIRN_OFFSET(500), cairn_wide_from_int(2), step));
        TEST_ASSERT_EQUAL_INT(-CAIRN_LEVER_MAX, cairn_lever_in_turn(INT32_MIN, cairn_wide_of(1, 40), step));
        TEST_ASSERT_EQUAL_INT(0, cairn_lever_in_turn(0, cairn_wide_from_int(2), step));
    }
}

void test_a_direction_in_turn_is_odd_and_exact_in_the_mean(void)
{
    for (int i = 0; i < 100; i++) {
        cairn_unit u = any() / 2;
        int64_t sum = 0;
        for (uint32_t step = 0; step < 1024; step++) {
            cairn_dir d = cairn_dir_in_turn(u, step);
            sum += (int64_t)d * 65536 - u;
            TEST_ASSERT_TRUE((u & 65535) == 0 || (d & 1));
        }
        expect_within(65536 * 16, 0, sum, u, 0);
    }
}

void test_a_direction_of_whole_units_stays_itself(void)
{
    for (uint32_t step = 0; step < 100; step++) {
        TEST_ASSERT_EQUAL_INT(0, cairn_dir_in_turn(0, step));
        TEST_ASSERT_EQUAL_INT(16384, cairn_dir_in_turn(CAIRN_UNIT(1), step));
        TEST_ASSERT_EQUAL_INT(-16384, cairn_dir_in_turn(-CAIRN_UNIT(1), step));
        TEST_ASSERT_EQUAL_INT(8192, cairn_dir_in_turn(CAIRN_UNIT(0.5), step));
    }
}

/* The lean turns a direction back to the one that was meant; both were rounded in any way. */
void test_a_lean_is_the_angle_that_rounding_made(void)
{
    for (uint32_t step = 0; step < 5000; step++) {
        cairn_unit x, y;
        cairn_angle_rotation(any(), &x, &y);
        cairn_dir dx = cairn_dir_in_turn(x, step), dy = step % 2 ? cairn_dir_from_unit(y) : cairn_dir_in_turn(y, step);
        /* the sine of the angle in Q44, and in Q27 */
        int64_t sine = (int64_t)y * dx - (int64_t)x * dy;
        expect_within(2, sine / 131072, cairn_dir_lean(x, y, dx, dy), x, y);
    }
    TEST_ASSERT_EQUAL_INT(0, cairn_dir_lean(CAIRN_UNIT(1), 0, 16384, 0));
}

void test_pushes_along_a_rounded_direction_and_what_they_lack_are_those_along_the_exact_one(void)
{
    enum { TIMES = 4, STEPS = 1000 };
    for (int i = 0; i < 100; i++) {
        cairn_unit x, y;
        cairn_motion push = 30000 + (any() >> 16), rub = any() >> 18, vx = 0, vy = 0;
        cairn_angle_rotation(any(), &x, &y);
        cairn_dir dx = cairn_dir_from_unit(x), dy = cairn_dir_from_unit(y);
        cairn_lean lean = cairn_dir_lean(x, y, dx, dy);
        for (uint32_t step = 0; step < STEPS; step++) {
            vx += TIMES * cairn_motion_along(push, -rub, dx, dy);
            vy += TIMES * cairn_motion_along(rub, push, dx, dy);
            cairn_motion_add_lack(&vx, &vy, push, rub, dx, dy, lean, TIMES, step);
        }
        /* Across the push, within 4e-5 of the rub, by which a rounded direction may be longer than 1; a contact takes that back. */
        int64_t across = ((int64_t)vy * x - (int64_t)vx * y) / CAIRN_UNIT(1);
        expect_within(TIMES * 400, (int64_t)rub * TIMES * STEPS, across, push, rub);
    }
}

void test_what_a_great_push_lacks_is_cut_and_does_not_wrap(void)
{
    cairn_motion vx = 0, vy = 0;
    cairn_motion_add_lack(&vx, &vy, CAIRN_MOTION(4.98), 0, 11585, 11585, 17378, 16, 0);
    TEST_ASSERT_INT_WITHIN(65536, -46341, vx);
    TEST_ASSERT_TRUE(vx < 0 && vy > 0);
}

/* ---- what is carried from call to call ---- */

void test_gravity_adds_up_over_a_second(void)
{
    /* 240 sub-steps of -9.81 / 240^2 m: Q16 642908, times 2^12, over 240 */
    cairn_wide squared = cairn_wide_div(cairn_wide_from_int(1), cairn_wide_from_int(57600));
    cairn_diffused gravity = cairn_diffused_of(CAIRN_F(-9.81), squared);
    int32_t sum = 0;
    for (int i = 0; i < 240; i++) { sum += cairn_diffuse(&gravity); }
    TEST_ASSERT_INT32_WITHIN(1, -10972296, sum);
}

void test_diffused_change_loses_nothing(void)
{
    for (int32_t i = 0; i < 100; i++) {
        int32_t x = any() / 65536, over = 1024 + (some() & 0xFFFF);
        cairn_diffused d = cairn_diffused_of(x, cairn_wide_div(cairn_wide_from_int(1), cairn_wide_from_int(over)));
        int64_t sum = 0;
        for (int j = 0; j < 1024; j++) { sum += cairn_diffuse(&d); }
        expect_within(1, nearest_up((int64_t)x * 4096 * 1024, over), sum, x, over);
    }
}

void test_diffused_change_saturates(void)
{
    cairn_diffused d = cairn_diffused_of(CAIRN_F(30000), cairn_wide_from_int(30000));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_diffuse(&d));
    d = cairn_diffused_of(CAIRN_F(-30000), cairn_wide_from_int(30000));
    TEST_ASSERT_EQUAL_INT32(-INT32_MAX, cairn_diffuse(&d));
    d = cairn_diffused_of(0, cairn_wide_from_int(30000));
    TEST_ASSERT_EQUAL_INT32(0, cairn_diffuse(&d));
    d = cairn_diffused_of(CAIRN_F(1), cairn_wide_of(1, -80));
    TEST_ASSERT_EQUAL_INT32(0, cairn_diffuse(&d));
}

/* ---- coordinates ---- */

void test_coordinate_moves_without_loss(void)
{
    cairn_real x = 0;
    cairn_residue residue = cairn_residue_zero();
    int64_t exact = 0;
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t by = any();
        if (size64(by) <= (uint64_t)CAIRN_MOTION(7.99) && size64(exact + by) < (uint64_t)INT32_MAX * 4096) {
            exact += by;
            cairn_coordinate_move(&x, &residue, by);
            expect(exact, (int64_t)x * 4096 + residue, by, 0);
            expect(x + (residue >= 2048), cairn_coordinate_round(x, residue), x, residue);
        }
    }
}

void test_coordinate_shifts_by_offsets_without_loss(void)
{
    cairn_real x = 0;
    cairn_residue residue = 17;
    int64_t exact = 17;
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t by = any();
        if (size64(exact / 64 + by) < (uint64_t)INT32_MAX * 64) {
            exact += (int64_t)by * 64;
            cairn_coordinate_shift(&x, &residue, by);
            expect(exact, (int64_t)x * 4096 + residue, by, 0);
        }
    }
    x = INT32_MAX - 1;
    cairn_coordinate_shift(&x, &residue, CAIRN_OFFSET(1));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, x);
}

void test_a_spot_knows_its_coordinate_from_near_by(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = any() / 2, by = any() / 512, whole = (int32_t)((uint32_t)x & ~255u); /* 64 m at most */
        cairn_spot spot = cairn_spot_of(x);
        expect(whole, cairn_spot_real(spot, x + by), x, by);
        int32_t way = cairn_spot_way(spot, x + by);
        expect(true, way >= 1 && way * 256 >= (by < 0 ? -by : by) && (way - 2) * 256 <= (by < 0 ? -by : by), x, by);
        expect(true, cairn_spots_are_near(spot, cairn_spot_of(x + by), (cairn_extent)way, 0), x, by);
    }
    TEST_ASSERT_FALSE(cairn_spots_are_near(cairn_spot_of(0), cairn_spot_of(CAIRN_F(1)), 128, 127));
    TEST_ASSERT_TRUE(cairn_spots_are_near(cairn_spot_of(CAIRN_F(-0.5)), cairn_spot_of(CAIRN_F(0.5)), 128, 128));
}

void test_motions_within_a_limit_are_told(void)
{
    const int32_t limit = CAIRN_MOTION(0.25);
    TEST_ASSERT_TRUE(cairn_motions_are_within(0, limit - 1, -limit, limit));
    TEST_ASSERT_FALSE(cairn_motions_are_within(limit, 0, 0, limit));
    TEST_ASSERT_FALSE(cairn_motions_are_within(0, -limit - 1, 0, limit));
    TEST_ASSERT_FALSE(cairn_motions_are_within(0, 0, INT32_MAX, limit));
    TEST_ASSERT_FALSE(cairn_motions_are_within(0, 0, INT32_MIN, limit));
}

void test_a_wide_sector_is_a_64th_of_a_turn(void)
{
    TEST_ASSERT_TRUE(cairn_angle_is_in_wide_sector(0, CAIRN_RADIANS(0.098)));
    TEST_ASSERT_FALSE(cairn_angle_is_in_wide_sector(0, CAIRN_RADIANS(0.0982)));
    TEST_ASSERT_FALSE(cairn_angle_is_in_wide_sector(0, -1));
    TEST_ASSERT_TRUE(cairn_real_wide_sector(CAIRN_F(2)) >= CAIRN_F(2 * 0.09818));
    TEST_ASSERT_EQUAL_INT32(2, cairn_real_above_motion(4097));
    TEST_ASSERT_EQUAL_INT32(0, cairn_real_above_motion(0));
}

void test_offset_between_coordinates_keeps_the_residues(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_OFFSET(1), cairn_coordinate_offset(CAIRN_F(3), 0, CAIRN_F(4), 0));
    TEST_ASSERT_EQUAL_INT32(CAIRN_OFFSET(-1), cairn_coordinate_offset(CAIRN_F(-32000), 77, CAIRN_F(-32001), 77));
    TEST_ASSERT_EQUAL_INT32(63, cairn_coordinate_offset(5, 0, 5, 4095));
    TEST_ASSERT_EQUAL_INT32(-64, cairn_coordinate_offset(5, 4095, 5, 0));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t from = any() / 2, by = any() / 128;
        uint16_t a = (uint16_t)(arith_random_bits(&random) >> 20), b = (uint16_t)(arith_random_bits(&random) >> 20);
        int64_t exact = (int64_t)by * 4096 + b - a;
        expect(exact >= 0 ? exact / 64 : -((-exact + 63) / 64), cairn_coordinate_offset(from, a, from + by, b), from, by);
    }
}

/* ---- offsets and units ---- */

void test_conversions_are_nearest_to_the_ends_of_the_range(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = any();
        expect(nearest_up(x, 64), cairn_real_from_offset(x), x, 0);
        expect(nearest_up(x, 64), cairn_offset_from_motion(x), x, 0);
        expect(nearest_up(x / 2, 16384), cairn_real_from_unit(x / 2), x, 0);
        expect(nearest_up(x / 2, 65536), cairn_dir_from_unit(x / 2), x, 0);
        expect(x / 64, cairn_real_from_offset(cairn_offset_from_real(x / 64)), x, 0);
        expect(cairn_clamp(x, 33554431) * (int64_t)64, cairn_motion_from_offset(x), x, 0);
        expect(cairn_clamp(x, 134217727) * (int64_t)16, cairn_factor_from_real(x), x, 0);
    }
    TEST_ASSERT_EQUAL_INT32(ONE, cairn_unit_from_dir(cairn_dir_from_unit(ONE)));
    TEST_ASSERT_EQUAL_INT32(-ONE, cairn_unit_from_dir(cairn_dir_negate(cairn_dir_from_unit(ONE))));
    TEST_ASSERT_EQUAL_INT32(CAIRN_FACTOR(1), cairn_factor_from_share(CAIRN_SHARE(1)));
}

void test_halves_and_bounds_of_offsets(void)
{
    TEST_ASSERT_EQUAL_INT32(-2, cairn_offset_half(-3));
    TEST_ASSERT_EQUAL_INT32(1, cairn_offset_half(3));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = any();
        if ((int64_t)cairn_real_above_offset(x) * 64 < x) { expect(x, cairn_real_above_offset(x), x, 0); }
    }
}

void test_fraction_has_exact_ends(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t b = some();
        expect(0, cairn_offset_fraction(0, b), 0, b);
        expect(ONE, cairn_offset_fraction(b, b), b, b);
    }
}

void test_fraction_is_within_two_units(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t a = some(), b = some(), low = a < b ? a : b, high = a < b ? b : a;
        cairn_unit f = cairn_offset_fraction(low, high);
        int64_t off = (int64_t)f * high - ((int64_t)low << 30); /* in units of 1/high */
        if (f < 0 || f > ONE || size64(off) > 2 * (uint64_t)high) { expect(0, off, low, high); }
    }
}

void test_unit_along_an_axis_is_exact(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t size = some();
        cairn_unit ux, uy;
        expect(size, cairn_unit_along(size, 0, &ux, &uy), size, 0);
        expect(ONE, ux, size, 0);
        expect(0, uy, size, 0);
        expect(size, cairn_unit_along(0, -size, &ux, &uy), 0, -size);
        expect(0, ux, 0, -size);
        expect(-ONE, uy, 0, -size);
        cairn_unit_along(-size, 0, &ux, &uy);
        expect(-ONE, ux, -size, 0);
        cairn_unit_along(0, size, &ux, &uy);
        expect(ONE, uy, 0, size);
    }
}

void test_unit_along_nothing_is_along_x(void)
{
    cairn_unit ux, uy;
    TEST_ASSERT_EQUAL_INT32(0, cairn_unit_along(0, 0, &ux, &uy));
    TEST_ASSERT_EQUAL_INT32(ONE, ux);
    TEST_ASSERT_EQUAL_INT32(0, uy);
}

void test_unit_along_has_direction_and_length_one(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = any(), y = any();
        cairn_unit ux, uy;
        int64_t across, square;
        if (x == 0 && y == 0) { continue; }
        cairn_unit_along(x, y, &ux, &uy);
        across = (int64_t)x / 2 * uy - (int64_t)y / 2 * ux; /* halves, so that the sum fits; the lost bits weigh 2^30 */
        if (size64(across) > (3 * (size64(x) + size64(y))) / 2 + (uint64_t)ONE) { expect(0, across, x, y); }
        square = (int64_t)ux * ux + (int64_t)uy * uy - ((int64_t)1 << 60);
        if (size64(square) > (uint64_t)1 << 33) { expect(0, square, x, y); } /* 2 * 4 units */
        if ((ux != 0 && (ux < 0) != (x < 0)) || (uy != 0 && (uy < 0) != (y < 0))) { expect(x, ux, x, y); }
    }
}

void test_unit_along_mirrors_exactly(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = any(), y = any();
        cairn_unit ux, uy, vx, vy;
        int32_t length = cairn_unit_along(x, y, &ux, &uy);
        if (x == 0 && y == 0) { continue; }
        expect(length, cairn_unit_along(-y, x, &vx, &vy), x, y);
        expect(-uy, vx, x, y);
        expect(ux, vy, x, y);
    }
}

void test_unit_along_gives_the_length_within_a_unit(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = any(), y = any();
        cairn_unit ux, uy;
        uint64_t square = (uint64_t)((int64_t)x * x) + (uint64_t)((int64_t)y * y);
        uint64_t length = (uint64_t)cairn_unit_along(x, y, &ux, &uy);
        bool above = length == 0 || (length - 1) * (length - 1) <= square;
        bool below = length == INT32_MAX || square <= (length + 1) * (length + 1);
        if (!above || !below) { expect(0, (int64_t)length, x, y); }
    }
    {
        cairn_unit ux, uy;
        TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_unit_along(INT32_MAX, INT32_MAX, &ux, &uy));
        TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_unit_along(INT32_MIN, INT32_MIN, &ux, &uy));
        TEST_ASSERT_EQUAL_INT32(ux, uy);
        TEST_ASSERT_INT32_WITHIN(4, -759250125, ux);
    }
}

void test_dot_products_of_units(void)
{
    TEST_ASSERT_EQUAL_INT32(ONE, cairn_unit_dot(ONE, 0, ONE, 0));
    TEST_ASSERT_EQUAL_INT32(0, cairn_unit_dot(ONE, 0, 0, ONE));
    TEST_ASSERT_EQUAL_INT32(CAIRN_OFFSET(250), cairn_offset_dot(CAIRN_OFFSET(300), CAIRN_OFFSET(400), CAIRN_UNIT(0.5), CAIRN_UNIT(0.25)));
    TEST_ASSERT_EQUAL_INT32(-CAIRN_OFFSET(511), cairn_offset_mul(CAIRN_OFFSET(511), -ONE));
}

/* ---- coefficients ---- */

void test_inverse_of_a_factor_is_within_a_unit(void)
{
    TEST_ASSERT_EQUAL_INT(16384, cairn_factor_inverse(CAIRN_FACTOR(1)));
    TEST_ASSERT_EQUAL_INT(8192, cairn_factor_inverse(CAIRN_FACTOR(2)));
    TEST_ASSERT_EQUAL_INT(1024, cairn_factor_inverse(CAIRN_FACTOR(16)));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t f = some();
        if (f > CAIRN_FACTOR(0.5)) {
            int64_t off = (int64_t)cairn_factor_inverse(f) * f - ((int64_t)1 << 34); /* in units of 1/f */
            if (size64(off) > (uint64_t)f && cairn_factor_inverse(f) != INT16_MAX) { expect(0, off, f, 0); }
        }
    }
}

void test_inverse_of_a_factor_saturates_just_below_two(void)
{
    TEST_ASSERT_EQUAL_INT(INT16_MAX, cairn_factor_inverse(CAIRN_FACTOR(0.5)));
    TEST_ASSERT_EQUAL_INT(INT16_MAX, cairn_factor_inverse(CAIRN_FACTOR(0.5) + 1));
    TEST_ASSERT_EQUAL_INT(INT16_MAX, cairn_factor_inverse(1));
    TEST_ASSERT_EQUAL_INT(INT16_MAX, cairn_factor_inverse(0));
    TEST_ASSERT_EQUAL_INT(INT16_MAX, cairn_factor_inverse(-5));
    TEST_ASSERT_EQUAL_INT(8, cairn_factor_inverse(INT32_MAX));
}

void test_factor_of_a_motion_is_nearest_and_saturates(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t a = any(), f = any() / (i & 1 ? 1 : 2048);
        expect(clamped(nearest_up((int64_t)a * f, 1 << 20)), cairn_motion_factor(a, f), a, f);
    }
}

void test_spin_factor_is_share_times_levers(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_FACTOR(0.5), cairn_factor_spin(CAIRN_SHARE(0.5), 8192, 8192));
    TEST_ASSERT_EQUAL_INT32(CAIRN_FACTOR(-1), cairn_factor_spin(CAIRN_SHARE(1), 8192, -8192));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t share = any() & (ONE - 1);
        int16_t j = (int16_t)(any() % CAIRN_LEVER_MAX), k = (int16_t)(any() % CAIRN_LEVER_MAX);
        int64_t exact = nearest_up((int64_t)share * j / 256 * k, (int64_t)1 << 24); /* 16th parts of a unit */
        expect_within(9, exact, (int64_t)cairn_factor_spin(share, j, k) * 16, j, k);
    }
}

void test_products_of_ratios_and_motions(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_MOTION(0.75), cairn_motion_ratio(CAIRN_MOTION(1.5), CAIRN_RATIO(0.5)));
    TEST_ASSERT_EQUAL_INT32(CAIRN_MOTION(-3), cairn_motion_lever(CAIRN_MOTION(-1.5), 16384));
    TEST_ASSERT_EQUAL_INT32(CAIRN_MOTION(-1.5), cairn_motion_dir(CAIRN_MOTION(1.5), -16384));
    TEST_ASSERT_EQUAL_INT32(CAIRN_MOTION(-7.5), cairn_motion_share(CAIRN_MOTION(-7.5), CAIRN_SHARE(1)));
    TEST_ASSERT_EQUAL_INT32(CAIRN_MOTION(5), cairn_motion_along(CAIRN_MOTION(4), CAIRN_MOTION(-4), 16384, -4096));
    TEST_ASSERT_EQUAL_INT32(-9, cairn_motion_clamp(-10, 9));
    TEST_ASSERT_EQUAL_INT32(CAIRN_MOTION(2), cairn_motion_scale(CAIRN_MOTION(1), cairn_wide_from_int(2)));
    TEST_ASSERT_EQUAL_INT32(CAIRN_FACTOR(0.5), cairn_factor_geometric_mean(CAIRN_FACTOR(0.25), CAIRN_FACTOR(1)));
}

void test_closing_speed_is_the_nearest_root(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_MOTION(5), cairn_motion_closing(CAIRN_MOTION(-3), CAIRN_MOTION(4), CAIRN_MOTION(2)));
    TEST_ASSERT_EQUAL_INT32(0, cairn_motion_closing(CAIRN_MOTION(1), CAIRN_MOTION(-1), CAIRN_MOTION(1)));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_motion_closing(INT32_MAX, INT32_MAX, INT32_MAX));
    TEST_ASSERT_EQUAL_INT32(0, cairn_motion_closing(INT32_MAX, -INT32_MAX, INT32_MAX));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t u = any(), g = any() / 4, s = some() / 4;
        int64_t square = (int64_t)u * u + 2 * (int64_t)g * s;
        uint64_t speed = (uint64_t)cairn_motion_closing(u, g, s);
        bool right = square <= 0 ? speed == 0 : speed == INT32_MAX ? (uint64_t)square > speed * speed - speed : is_nearest_root(speed, (uint64_t)square);
        if (!right) { expect(0, (int64_t)speed, u, g); }
    }
}

void test_motion_over_a_factor(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_MOTION(-0.5), cairn_motion_divide(CAIRN_MOTION(-1), CAIRN_FACTOR(2)));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_motion_divide(CAIRN_MOTION(4), CAIRN_FACTOR(0.25)));
    TEST_ASSERT_EQUAL_INT32(-INT32_MAX, cairn_motion_divide(CAIRN_MOTION(-4), CAIRN_FACTOR(0.25)));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = any(), f = some();
        expect_within(1, clamped(nearest_up((int64_t)x * (1 << 20), f)), cairn_motion_divide(x, f), x, f);
    }
}

void test_part_of_a_way_is_held_between_none_and_all(void)
{
    TEST_ASSERT_EQUAL_INT32(0, cairn_motion_fraction(-5, 10));
    TEST_ASSERT_EQUAL_INT32(ONE, cairn_motion_fraction(11, 10));
    TEST_ASSERT_EQUAL_INT32(ONE / 2, cairn_motion_fraction(5, 10));
    TEST_ASSERT_EQUAL_INT32(CAIRN_MOTION(-0.5), cairn_motion_unit(CAIRN_MOTION(-1), ONE / 2));
    TEST_ASSERT_EQUAL_INT32(CAIRN_RADIANS(0.5), cairn_angle_part(CAIRN_RADIANS(1), ONE / 2));
    TEST_ASSERT_EQUAL_INT32(-2, cairn_motion_half(-3));
}

void test_products_of_shares_and_factors(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_SHARE(0.125), cairn_share_mul(CAIRN_SHARE(0.5), CAIRN_SHARE(0.25)));
    TEST_ASSERT_EQUAL_INT32(CAIRN_FACTOR(3), cairn_factor_mul(CAIRN_FACTOR(2), CAIRN_FACTOR(1.5)));
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, cairn_factor_mul(CAIRN_FACTOR(2000), CAIRN_FACTOR(2)));
    TEST_ASSERT_EQUAL_INT32(CAIRN_FACTOR(1), cairn_factor_square(16384, 0));
    TEST_ASSERT_INT32_WITHIN(CAIRN_FACTOR(0.0001), CAIRN_FACTOR(1), cairn_factor_square(9830, -13107));
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t share = any() & (ONE - 1), motion = any();
        expect(nearest_up(share, (int64_t)1 << (i % 31)), cairn_share_shift(share, i % 31), share, i % 31);
        expect(nearest_up((int64_t)motion * share, ONE), cairn_motion_share(motion, share), motion, share);
        expect(nearest_up(motion, 2), cairn_motion_share(motion, CAIRN_SHARE(0.5)), motion, 0);
    }
}

void test_parts_in_fine_units_are_rounded_to_half_a_unit(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t share = any() & (ONE - 1), a = any() / 2, c = any() / 2;
        int16_t j = (int16_t)(any() % 16385), k = (int16_t)(any() % 16385);
        expect(nearest_up((int64_t)a * share, ONE / 2), cairn_fine_share(a, share), a, share);
        TEST_ASSERT_EQUAL_INT32(a, cairn_fine_share(a, CAIRN_SHARE(0.5)));
        TEST_ASSERT_EQUAL_INT32(cairn_motion_half_dir(a, j), cairn_fine_dir(cairn_fine_share(a, CAIRN_SHARE(0.5)), j));
        TEST_ASSERT_EQUAL_INT32(cairn_motion_half_lever(a, j), cairn_fine_lever(cairn_fine_share(a, CAIRN_SHARE(0.5)), j));
        TEST_ASSERT_EQUAL_INT32(cairn_motion_along(a / 2, c / 2, j, k), cairn_fine_along(cairn_fine_of(a / 2), cairn_fine_of(c / 2), j, k));
    }
}

/* Greatest and least ones come by the first rounds. */
static int32_t quiet(int32_t i, int32_t limit) { return i < 8 ? (i & 1 ? limit : -limit) : any() % (limit + 1); }

void test_products_of_quiet_motions_are_those_of_any(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t share = i < 8 ? ONE : any() & (ONE - 1), sum = any() / 4;
        int32_t a = quiet(i, CAIRN_QUIET - 1), c = quiet(i >> 1, CAIRN_QUIET - 1), half = a / 2, other = c / 2;
        int16_t j = (int16_t)quiet(i, 16384), k = (int16_t)quiet(i >> 1, 16384), x = (int16_t)(j - j / 4), y = (int16_t)(k / 2);
        TEST_ASSERT_EQUAL_INT32(sum + cairn_motion_along(a, c, x, y), cairn_quiet_add_along(sum, a, c, x, y));
        TEST_ASSERT_EQUAL_INT32(sum + cairn_motion_levers(a, j, c, k), cairn_quiet_add_levers(sum, a, j, c, k));
        TEST_ASSERT_EQUAL_INT32(sum - cairn_motion_ratio(3 * a, k), cairn_quiet_less_ratio(sum, 3 * a, k));
        TEST_ASSERT_EQUAL_INT32(cairn_fine_share(a, share), cairn_quiet_share(a, share));
        TEST_ASSERT_EQUAL_INT32(cairn_motion_half_dir(a, j), cairn_quiet_half_dir(a, j));
        TEST_ASSERT_EQUAL_INT32(cairn_motion_half_lever(a, j), cairn_quiet_half_lever(a, j));
        TEST_ASSERT_EQUAL_INT32(cairn_motion_half_along(a, c, x, y), cairn_quiet_half_along(a, c, x, y));
        TEST_ASSERT_EQUAL_INT32(sum + cairn_fine_dir(2 * a, j), cairn_quiet_add_fine_dir(sum, 2 * a, j));
        TEST_ASSERT_EQUAL_INT32(sum - cairn_fine_dir(2 * a, j), cairn_quiet_less_fine_dir(sum, 2 * a, j));
        TEST_ASSERT_EQUAL_INT32(sum + cairn_fine_lever(2 * a, j), cairn_quiet_add_fine_lever(sum, 2 * a, j));
        TEST_ASSERT_EQUAL_INT32(sum + cairn_fine_along(2 * half, 2 * other, x, y), cairn_quiet_add_fine_along(sum, 2 * half, 2 * other, x, y));
        TEST_ASSERT_EQUAL_INT32(sum - cairn_fine_along(2 * half, 2 * other, x, y), cairn_quiet_less_fine_along(sum, 2 * half, 2 * other, x, y));
    }
    TEST_ASSERT_EQUAL_INT32(0, cairn_quiet_share(1234, 0));
    TEST_ASSERT_EQUAL_INT32(1235, cairn_quiet_share(1235, CAIRN_SHARE(0.5)));
}

static void expect_below(bool (*is_below)(cairn_motion x), int32_t limit)
{
    TEST_ASSERT_TRUE(is_below(0));
    TEST_ASSERT_TRUE(is_below(limit - 1));
    TEST_ASSERT_TRUE(is_below(-limit));
    TEST_ASSERT_FALSE(is_below(limit));
    TEST_ASSERT_FALSE(is_below(-limit - 1));
    TEST_ASSERT_FALSE(is_below(INT32_MAX));
    TEST_ASSERT_FALSE(is_below(INT32_MIN));
}

void test_quiet_and_calm_motions_are_told_from_others(void)
{
    expect_below(cairn_motion_is_quiet, CAIRN_QUIET);
    expect_below(cairn_motion_is_fairly_quiet, 4 * CAIRN_QUIET);
    expect_below(cairn_motion_is_calm, CAIRN_MOTION(1.0 / 64));
}

void test_share_of_the_cone_that_is_cheap_to_find_is_none_beyond_it(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t pressure = any() & INT32_MAX, friction = any() & (CAIRN_FACTOR(1) - 1), below;
        pressure = pressure < CAIRN_MOTION(4.98) ? pressure : 0;
        below = cairn_motion_factor_below(pressure, friction);
        TEST_ASSERT_TRUE(below <= cairn_motion_factor(pressure, friction));
        expect_within(1024 + (pressure >> 10), cairn_motion_factor(pressure, friction), below, pressure, friction);
    }
}

void test_shifted_motions_are_rounded_down(void)
{
    TEST_ASSERT_EQUAL_INT32(2, cairn_motion_shifted(23, 3));
    TEST_ASSERT_EQUAL_INT32(-3, cairn_motion_shifted(-17, 3));
}

void test_area_of_a_parallelogram_is_exact(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t ax = any() / 2, ay = any() / 2, bx = any() / 2, by = any() / 2;
        if (cairn_offset_cross(ax, ay, bx, by) != (int64_t)ax * by - (int64_t)ay * bx) { expect(0, 1, ax, by); }
        if (cairn_offset_cross(ax, ay, bx, by) != -cairn_offset_cross(bx, by, ax, ay)) { expect(0, 2, ax, by); }
    }
    TEST_ASSERT_TRUE(cairn_offset_cross(CAIRN_OFFSET(2), 0, 0, CAIRN_OFFSET(3)) == (cairn_area)6 << 44);
}

/* ---- the same bits everywhere ---- */

static uint32_t folded(uint32_t hash, int32_t x) { return (hash ^ (uint32_t)x) * 16777619u; }

static uint32_t folded_wide(uint32_t hash, cairn_wide k) { return folded(folded(hash, (int32_t)k.mantissa), k.exponent); }

void test_pushes_take_the_short_way_with_the_same_bits(void)
{
    static const cairn_push xs[] = { 0, 1, -1, 12345, -98765, (1 << 28) - 1, -(1 << 28), 1 << 28, -(1 << 28) - 1, (cairn_push)3 << 40, -((cairn_push)5 << 38) - 7 };
    static const int32_t factors[] = { 0, 1, -1, 16384, -16384, 11585, -23170, 8191 };
    for (size_t i = 0; i < sizeof xs / sizeof *xs; i++) {
        for (size_t j = 0; j < sizeof factors / sizeof *factors; j++) {
            int32_t f = factors[j];
            TEST_ASSERT_TRUE(cairn_push_lever(xs[i], (cairn_lever)f) == cairn_mul64(xs[i], f, 13));
            TEST_ASSERT_TRUE(cairn_push_dir(xs[i], (cairn_dir)f) == cairn_mul64(xs[i], f, 14));
            TEST_ASSERT_TRUE(cairn_push_unit(xs[i], f * 32768) == cairn_mul64(xs[i], f * 32768, 30));
        }
    }
    TEST_ASSERT_TRUE(cairn_mul64((cairn_push)3 << 40, 3, 1) == (cairn_push)9 << 39);
    TEST_ASSERT_TRUE(cairn_mul64(-3, 1, 1) == -1); /* halves upwards */
}

void test_a_push_times_a_wide_number_is_rounded_and_saturates(void)
{
    cairn_push large = (cairn_push)1 << 40;
    TEST_ASSERT_TRUE(cairn_push_scale(large, cairn_wide_of(3, 0)) == 3 * large);
    TEST_ASSERT_TRUE(cairn_push_scale(-large, cairn_wide_of(3, 0)) == -3 * large);
    TEST_ASSERT_TRUE(cairn_push_scale(large + 1, cairn_wide_of(1, -1)) == large / 2 + 1);
    TEST_ASSERT_TRUE(cairn_push_scale(large, cairn_wide_of(1, -20)) == 1 << 20);
    TEST_ASSERT_TRUE(cairn_push_scale(large, cairn_wide_of(1, -41)) == 1);
    TEST_ASSERT_TRUE(cairn_push_scale(large, cairn_wide_of(1, -100)) == 0);
    TEST_ASSERT_TRUE(cairn_push_scale(large, cairn_wide_of(0, 0)) == 0);
    TEST_ASSERT_TRUE(cairn_push_scale(0, cairn_wide_of(1, 40)) == 0);
    TEST_ASSERT_TRUE(cairn_push_scale(large, cairn_wide_of(1, 8)) == CAIRN_PUSH_MAX);
    TEST_ASSERT_TRUE(cairn_push_scale(-large, cairn_wide_of(1, 40)) == -CAIRN_PUSH_MAX);
    TEST_ASSERT_TRUE(cairn_push_scale(7, cairn_wide_of(1, -1)) == 4);
    TEST_ASSERT_TRUE(cairn_push_scale(7, cairn_wide_of(5, 2)) == 140);
}

void test_pushes_shift_and_tell_their_excess(void)
{
    TEST_ASSERT_TRUE(cairn_push_shift(3, -1) == 2);
    TEST_ASSERT_TRUE(cairn_push_shift(-5, 2) == -20);
    TEST_ASSERT_TRUE(cairn_push_shift(CAIRN_PUSH_MAX, 3) == CAIRN_PUSH_MAX);
    TEST_ASSERT_EQUAL_INT(0, cairn_push_excess((1 << 29) - 1));
    TEST_ASSERT_EQUAL_INT(1, cairn_push_excess(-(1 << 29)));
    TEST_ASSERT_EQUAL_INT(18, cairn_push_excess(CAIRN_PUSH_MAX - 1));
}

void test_units_of_a_matrix_have_room_for_powers_of_four(void)
{
    TEST_ASSERT_EQUAL_INT(0, cairn_unit_room(CAIRN_UNIT(1.5)));
    TEST_ASSERT_EQUAL_INT(0, cairn_unit_room(CAIRN_UNIT(0.25)));
    TEST_ASSERT_EQUAL_INT(1, cairn_unit_room(CAIRN_UNIT(0.25) - 1));
    TEST_ASSERT_EQUAL_INT(14, cairn_unit_room(1));
    TEST_ASSERT_EQUAL_INT(CAIRN_UNIT(-0.5), cairn_unit_grow(CAIRN_UNIT(-0.125), 2));
    /* (0.6, 0.8) (0.8, 0.6) + 2 * (-0.5) = -0.04, times 3 / 4 */
    TEST_ASSERT_INT32_WITHIN(100000, CAIRN_UNIT(-0.03), cairn_unit_coupling(9830, 13107, 16384, 13107, 9830, -4096, cairn_wide_of(3, 0), -2));
}

void test_every_core_gives_the_same_bits(void)
{
    uint32_t hash = 2166136261u;
    for (int i = 0; i < 5000; i++) {
        int32_t a = any(), b = any(), pa = some(), pb = some();
        int32_t low = pa < pb ? pa : pb, high = pa < pb ? pb : pa;
        cairn_wide k = some_wide(), m = some_wide();
        cairn_unit c, s;
        hash = folded(hash, cairn_real_divide(a, b));
        hash = folded(hash, cairn_real_mul(a, b));
        hash = folded(hash, cairn_real_sqrt(a));
        hash = folded(hash, cairn_real_length(a, b));
        hash = folded(hash, cairn_real_geometric_mean(pa, pb));
        cairn_angle_rotation(a, &c, &s);
        hash = folded(folded(hash, c), s);
        hash = folded(hash, cairn_angle_of(a, b));
        hash = folded(hash, cairn_angle_radians(a));
        hash = folded(hash, cairn_angle_from_radians(a));
        hash = folded(hash, cairn_angle_from_motion(a, k));
        hash = folded_wide(hash, cairn_wide_mul(k, m));
        hash = folded_wide(hash, cairn_wide_div(k, m));
        hash = folded_wide(hash, cairn_wide_add(k, m));
        hash = folded_wide(hash, cairn_wide_sqrt(k));
        hash = folded(hash, cairn_wide_scale(a, k, 0));
        hash = folded(hash, cairn_lever_of(a, k));
        hash = folded(hash, cairn_diffused_of(a, k).whole);
        hash = folded(hash, (int32_t)cairn_diffused_of(a, k).fraction);
        hash = folded(hash, cairn_offset_fraction(low, high));
        hash = folded(hash, cairn_unit_along(a, b, &c, &s));
        hash = folded(folded(hash, c), s);
        hash = folded(hash, cairn_factor_inverse(pa));
        hash = folded(hash, cairn_motion_factor(a, pb));
        hash = folded(hash, cairn_motion_closing(a, b / 4, pa / 4));
        hash = folded(hash, cairn_motion_divide(a, pb));
    }
    TEST_ASSERT_EQUAL_HEX32(0x5F5D824Fu, hash);
}

/* ---- frames and gains: the springs' ---- */

/* What a frame says of a vector that has changed by so little that it holds is what the vector itself says. */
void test_frame_tells_length_and_direction_of_a_vector_that_changed_by_little(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        cairn_frame frame;
        cairn_unit ux, uy;
        cairn_tilt swing;
        int32_t x = any() >> (5 + (i & 15)), y = any() >> (5 + (i & 15));
        cairn_offset length = cairn_unit_along(x, y, &ux, &uy);
        if (!cairn_frame_set(&frame, ux, uy, length)) {
            TEST_ASSERT_TRUE(length < CAIRN_OFFSET(0.00390625) || length >= CAIRN_OFFSET(16));
            continue;
        }
        int32_t most = 32768 << frame.shift, dx = any() % (2 * most), dy = any() % (2 * most);
        TEST_ASSERT_EQUAL_INT(dx < most && dx >= -most && dy < most && dy >= -most, cairn_frame_holds(&frame, dx, dy));
        dx /= 2;
        dy /= 2;
        dx &= ~63; /* to the last bit of an offset, so that the moved vector is exact */
        dy &= ~63;
        cairn_offset moved = cairn_unit_along(x + dx / 64, y + dy / 64, &ux, &uy);
        cairn_motion stretch = cairn_motion_from_stretch(cairn_frame_stretch(&frame, dx, dy, &swing));
        expect_within(128 + (length >> 10) + (length >> 13), /* s t^2 / 2 L^2, each up to L / 32 */
                       (int64_t)(moved - length) * 64, stretch, x, y);
        expect_within((1 << 16) * 30, ux, cairn_unit_from_dir(cairn_frame_x(&frame, swing)), x, y);
        expect_within((1 << 16) * 30, uy, cairn_unit_from_dir(cairn_frame_y(&frame, swing)), x, y);
        cairn_tilt back = cairn_frame_tilt(&frame, cairn_frame_x(&frame, swing), cairn_frame_y(&frame, swing));
        expect_within(64, swing, back, x, y);
    }
}

void test_frame_is_for_lengths_of_4_mm_to_16_m(void)
{
    cairn_frame frame;
    TEST_ASSERT_FALSE(cairn_frame_set(&frame, CAIRN_UNIT(1), 0, 0));
    TEST_ASSERT_FALSE(cairn_frame_set(&frame, CAIRN_UNIT(1), 0, CAIRN_OFFSET(0.0039)));
    TEST_ASSERT_TRUE(cairn_frame_set(&frame, CAIRN_UNIT(1), 0, CAIRN_OFFSET(0.00390625)));
    TEST_ASSERT_EQUAL_INT(32768, frame.inverse);
    TEST_ASSERT_TRUE(cairn_frame_set(&frame, CAIRN_UNIT(1), 0, CAIRN_OFFSET(16) - 1));
    TEST_ASSERT_EQUAL_INT(16384, frame.inverse);
    TEST_ASSERT_FALSE(cairn_frame_set(&frame, CAIRN_UNIT(1), 0, CAIRN_OFFSET(16)));
    TEST_ASSERT_FALSE(cairn_frame_set(&frame, CAIRN_UNIT(1), 0, INT32_MAX));
}

/* Half of the reach that it has for motions. */
void test_frame_holds_well_for_half_as_much(void)
{
    cairn_frame frame;
    TEST_ASSERT_TRUE(cairn_frame_set(&frame, CAIRN_UNIT(1), 0, CAIRN_OFFSET(1)));
    TEST_ASSERT_TRUE(cairn_frame_holds(&frame, CAIRN_MOTION(1.0 / 32) - 1, -CAIRN_MOTION(1.0 / 32)));
    TEST_ASSERT_FALSE(cairn_frame_holds(&frame, CAIRN_MOTION(1.0 / 32), 0));
    TEST_ASSERT_FALSE(cairn_frame_holds(&frame, 0, -CAIRN_MOTION(1.0 / 32) - 1));
    TEST_ASSERT_TRUE(cairn_frame_holds_well(&frame, CAIRN_F(1.0 / 64) - 1, -CAIRN_F(1.0 / 64)));
    TEST_ASSERT_FALSE(cairn_frame_holds_well(&frame, CAIRN_F(1.0 / 64), 0));
    TEST_ASSERT_FALSE(cairn_frame_holds_well(&frame, 0, INT32_MIN));
    TEST_ASSERT_FALSE(cairn_frame_holds_well(&frame, CAIRN_F(16), 0));
}

void test_swing_follows_by_a_quarter_or_at_once(void)
{
    TEST_ASSERT_EQUAL_INT(100, cairn_tilt_towards(-20, 100, CAIRN_LAG_NONE));
    TEST_ASSERT_EQUAL_INT(10, cairn_tilt_towards(-20, 100, CAIRN_LAG_QUARTER));
    TEST_ASSERT_EQUAL_INT(-40, cairn_tilt_towards(-40, -40, CAIRN_LAG_QUARTER));
}

void test_turn_is_the_greater_change(void)
{
    TEST_ASSERT_EQUAL_INT32(CAIRN_UNIT(1), cairn_dir_cosine(16384, 0, 16384, 0));
    TEST_ASSERT_EQUAL_INT32(CAIRN_UNIT(-0.5), cairn_dir_cosine(0, -8192, 0, 16384));
    TEST_ASSERT_EQUAL_INT32(0, cairn_dir_turn(5, -7, 5, -7));
    TEST_ASSERT_INT32_WITHIN(1, 300, cairn_dir_turn(100, 0, -200, 200));
    TEST_ASSERT_INT32_WITHIN(1, 32768, cairn_dir_turn(-16384, 0, 16384, 0));
    TEST_ASSERT_EQUAL_INT32(CAIRN_UNIT(0.5), cairn_unit_from_turn(32768));
    TEST_ASSERT_EQUAL_INT32(CAIRN_UNIT(0.25), cairn_unit_from_turn(cairn_turn_from_unit(CAIRN_UNIT(0.25))));
}

void test_gain_keeps_fifteen_bits_of_any_coefficient(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = any() % CAIRN_MOTION(4);
        cairn_wide k = cairn_wide_of(some(), 0);
        k.exponent = -32 - (int32_t)(arith_random_bits(&random) >> 28);
        int32_t exact = cairn_motion_scale(x, k);
        expect_within(3 + (int64_t)(size64(exact) >> 14), exact, cairn_motion_gain(2 * x, cairn_gain_from_wide(k)), x, (int32_t)k.mantissa);
    }
    TEST_ASSERT_EQUAL_INT32(0, cairn_motion_gain(CAIRN_STRETCH(3), cairn_gain_from_wide(cairn_wide_from_int(0))));
    TEST_ASSERT_EQUAL_INT32(0, cairn_motion_gain(CAIRN_STRETCH(3), cairn_gain_from_wide(cairn_wide_of(1, -70))));
    TEST_ASSERT_INT32_WITHIN(CAIRN_MOTION(0.001), CAIRN_MOTION(3), cairn_motion_gain(CAIRN_STRETCH(3), cairn_gain_from_wide(cairn_wide_from_int(1))));
    TEST_ASSERT_TRUE(cairn_gain_is_zero(cairn_gain_from_wide(cairn_wide_from_int(0))));
    TEST_ASSERT_FALSE(cairn_gain_is_zero(cairn_gain_from_wide(cairn_wide_of(1, -20))));
}

void test_gain_of_a_share_keeps_fifteen_bits_and_halves_with_a_factor(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t x = any() % CAIRN_MOTION(4), f = CAIRN_FACTOR(1) + (int32_t)((uint32_t)any() % (uint32_t)CAIRN_FACTOR(1));
        cairn_share s = (int32_t)((uint32_t)any() % (uint32_t)CAIRN_SHARE(1)) >> (i & 31);
        cairn_motion exact = cairn_motion_share(x, s);
        expect_within(3 + (int64_t)(size64(exact) >> 14), exact, cairn_motion_gain(2 * x, cairn_gain_from_share(s)), x, s);
        exact = cairn_motion_factor(exact, f / 2);
        expect_within(3 + (int64_t)(size64(exact) >> 12), exact, cairn_motion_gain(2 * x, cairn_gain_times_half(cairn_gain_from_share(s), f)), x, s);
    }
    TEST_ASSERT_TRUE(cairn_gain_is_zero(cairn_gain_from_share(0)));
    TEST_ASSERT_TRUE(cairn_gain_is_zero(cairn_gain_zero()));
    TEST_ASSERT_EQUAL_INT(32767, cairn_gain_from_share(CAIRN_SHARE(1)).mantissa);
}

void test_part_and_product_rounded_down(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t a = any(), b = any() >> 16;
        expect((int32_t)(((int64_t)a * b - (((int64_t)a * b) & 65535)) / 65536), cairn_mul16_down(a, b), a, b);
        cairn_factor f = any() % CAIRN_FACTOR(1);
        expect_within(2 + CAIRN_MOTION(4) / 32768, cairn_motion_factor(a % CAIRN_MOTION(4), f), cairn_motion_part(a % CAIRN_MOTION(4), cairn_part_from_factor(f)), a, f);
    }
    TEST_ASSERT_EQUAL_INT(32767, cairn_part_from_factor(CAIRN_FACTOR(1)));
    TEST_ASSERT_EQUAL_INT(-32767, cairn_part_from_factor(-CAIRN_FACTOR(1)));
    TEST_ASSERT_EQUAL_INT32(CAIRN_STRETCH(-2), cairn_stretch_from_offset(CAIRN_OFFSET(-2)));
    TEST_ASSERT_TRUE(cairn_stretch_from_offset(INT32_MAX) > CAIRN_STRETCH(3.9));
    TEST_ASSERT_INT32_WITHIN(1, CAIRN_STRETCH(1.5), cairn_stretch_along(CAIRN_MOTION(3), CAIRN_MOTION(1), 8192, 0));
}

void test_frame_is_passed_by_a_64th_of_its_length(void)
{
    cairn_frame frame;
    TEST_ASSERT_TRUE(cairn_frame_set(&frame, CAIRN_UNIT(1), 0, CAIRN_OFFSET(1)));
    TEST_ASSERT_TRUE(cairn_frame_is_passed(&frame, CAIRN_MOTION(1.0 / 64)));
    TEST_ASSERT_TRUE(cairn_frame_is_passed(&frame, -CAIRN_MOTION(1.0 / 64) - 1));
    TEST_ASSERT_FALSE(cairn_frame_is_passed(&frame, CAIRN_MOTION(1.0 / 64) - 1));
    TEST_ASSERT_FALSE(cairn_frame_is_passed(&frame, 0));
}

/* Where bodies will be, as the way between them from where a frame was made, wherever in the world. */
void test_motions_between_coordinates_add_up(void)
{
    for (int32_t i = 0; i < ROUNDS; i++) {
        int32_t from = any() >> 2, to = from + (any() >> 16), from_by = any() >> 1, to_by = any() >> 1;
        cairn_residue low = (cairn_residue)(any() & 4095), high = (cairn_residue)(any() & 4095);
        cairn_real made = to - from + cairn_real_below_motion(to_by) - cairn_real_below_motion(from_by);
        cairn_motion origin = cairn_motion_between(to - from - made, low, high);
        cairn_motion rest = cairn_motion_apart(from_by, to_by, origin); /* what the frame's own coordinates cannot say */
        expect_within(0, (to_by & 4095) - (from_by & 4095) + high - low, rest, from, to);
    }
}
