/*
 * A port's faster primitives give the bits of their definition in arith_fixed.h. Built plain and, by
 * tests/arith/CMakeLists.txt, with each header of ports/arith that this compiler can take.
 */
#include "arith_random.h"
#include "cairn/arith.h"

#include <unity.h>

#define ROUNDS 1000000

void setUp(void) {}
void tearDown(void) {}

/* A port may ask for a constant shift. */
#define SHIFTS_TO_16(X) X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12) X(13) X(14) X(15) X(16)
#define SHIFTS_TO_32(X) SHIFTS_TO_16(X) X(17) X(18) X(19) X(20) X(21) X(22) X(23) X(24) X(25) X(26) X(27) X(28) X(29) X(30) X(31) X(32)

static int32_t mul16_by(int32_t a, int32_t b, int shift)
{
    switch (shift) {
#define CASE(n) case n: return cairn_mul16(a, b, n);
        SHIFTS_TO_16(CASE)
#undef CASE
    default: return 0;
    }
}

static int32_t add_rounded_by(int32_t sum, int32_t x, int shift)
{
    switch (shift) {
#define CASE(n) case n: return cairn_add_rounded(sum, x, n);
        SHIFTS_TO_16(CASE)
#undef CASE
    default: return 0;
    }
}

static int32_t mul32_by(int32_t a, int32_t b, int shift)
{
    switch (shift) {
#define CASE(n) case n: return cairn_mul32(a, b, n);
        SHIFTS_TO_32(CASE)
#undef CASE
    default: return 0;
    }
}

static int32_t dot32_by(int32_t a, int32_t b, int32_t c, int32_t d, int shift)
{
    switch (shift) {
#define CASE(n) case n: return cairn_dot32(a, b, c, d, n);
        SHIFTS_TO_32(CASE)
#undef CASE
    default: return 0;
    }
}

/* What the definition says; false if that does not fit, and then the operation promises nothing. */
static bool narrowed(int64_t x, int shift, int32_t *result)
{
    int64_t wide = (x + ((int64_t)1 << (shift - 1))) >> shift;
    *result = (int32_t)(uint32_t)(uint64_t)wide;
    return wide == *result;
}

typedef struct arguments {
    int32_t a, b, c, d;
    int shift;
} arguments;

/* The edges in all pairs first, then random ones; a may be INT32_MIN. */
static arguments choose(arith_random *random, uint32_t round, int longest)
{
    arguments x;
    x.a = round < ARITH_EDGES * ARITH_EDGES ? arith_edge(round % ARITH_EDGES) : arith_random_argument(random);
    x.b = round < ARITH_EDGES * ARITH_EDGES ? arith_edge(round / ARITH_EDGES) : arith_random_argument(random);
    x.c = arith_random_argument(random);
    x.d = arith_random_argument(random);
    x.shift = 1 + (int)((arith_random_bits(random) >> 8) % (uint32_t)longest);
    if ((round & 1023u) == 1023u) { x.a = INT32_MIN; }
    return x;
}

static void expect(const char *operation, arguments x, int32_t expected, int32_t actual)
{
    if (expected != actual) {
        const int32_t words[] = { x.a, x.b, x.c, x.d, x.shift };
        for (uint32_t i = 0; i < sizeof words / sizeof words[0]; i++) {
            UnityPrintNumber(words[i]);
            UnityPrint(" ");
        }
        TEST_ASSERT_EQUAL_INT32_MESSAGE(expected, actual, operation);
    }
}

void test_mul16_gives_the_bits_of_its_definition(void)
{
    arith_random random = arith_random_seeded(16);
    uint32_t compared = 0;
    for (uint32_t i = 0; i < ROUNDS; i++) {
        arguments x = choose(&random, i, 16);
        int32_t expected;
        x.b = (int16_t)(i & 1u ? x.b : x.b >> 16);
        if (narrowed((int64_t)x.a * x.b, x.shift, &expected)) {
            expect("mul16", x, expected, mul16_by(x.a, x.b, x.shift));
            compared++;
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT32(ROUNDS / 2, compared);
}

void test_add_rounded_gives_the_bits_of_its_definition(void)
{
    arith_random random = arith_random_seeded(29);
    for (uint32_t i = 0; i < ROUNDS; i++) {
        arguments x = choose(&random, i, 16);
        int32_t sum = x.a / 2, term;
        x.shift = x.shift < 2 ? 2 : x.shift;
        term = (int32_t)(((int64_t)x.b + ((int64_t)1 << (x.shift - 1))) >> x.shift);
        expect("add_rounded", x, sum + term, add_rounded_by(sum, x.b, x.shift));
    }
}

void test_mul32_gives_the_bits_of_its_definition(void)
{
    arith_random random = arith_random_seeded(32);
    uint32_t compared = 0;
    for (uint32_t i = 0; i < ROUNDS; i++) {
        arguments x = choose(&random, i, 32);
        int32_t expected;
        if (narrowed((int64_t)x.a * x.b, x.shift, &expected)) {
            expect("mul32", x, expected, mul32_by(x.a, x.b, x.shift));
            compared++;
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT32(ROUNDS / 2, compared);
}

static int32_t dot16_by(const arguments *x)
{
    switch (x->shift) {
    case 13: return cairn_dot16(x->a, x->b, x->c, x->d, 13);
    case 14: return cairn_dot16(x->a, x->b, x->c, x->d, 14);
    default: return cairn_dot16(x->a, x->b, x->c, x->d, 15);
    }
}

void test_dot16_gives_the_bits_of_its_definition(void)
{
    arith_random random = arith_random_seeded(1614);
    uint32_t compared = 0;
    for (uint32_t i = 0; i < ROUNDS; i++) {
        arguments x = choose(&random, i, 14);
        int32_t expected;
        x.b = cairn_clamp(i & 1u ? (int16_t)x.b : x.b >> 16, 16384);
        x.d = cairn_clamp(i & 2u ? (int16_t)x.d : x.d >> 16, 16384);
        x.shift = 13 + (int)(i / 4 % 3);
        if (narrowed((int64_t)x.a * x.b + (int64_t)x.c * x.d, x.shift, &expected)) {
            expect("dot16", x, expected, dot16_by(&x));
            compared++;
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT32(ROUNDS / 2, compared);
}

void test_dot32_gives_the_bits_of_its_definition(void)
{
    arith_random random = arith_random_seeded(3232);
    uint32_t compared = 0;
    for (uint32_t i = 0; i < ROUNDS; i++) {
        arguments x = choose(&random, i, 32);
        int32_t expected;
        if (narrowed((int64_t)x.a * x.b + (int64_t)x.c * x.d, x.shift, &expected)) {
            expect("dot32", x, expected, dot32_by(x.a, x.b, x.c, x.d, x.shift));
            compared++;
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT32(ROUNDS / 4, compared);
}

void test_squares_sum_their_upper_words_and_are_below_only_what_each_motion_is_below(void)
{
    arith_random random = arith_random_seeded(2);
    for (uint32_t i = 0; i < ROUNDS; i++) {
        arguments x = choose(&random, i, 26);
        const cairn_motion limit = 1 << x.shift, a = x.a / 8, b = x.b >> x.shift / 2;
        const uint32_t upper_a = (uint32_t)((int64_t)a * a >> 32), upper_b = (uint32_t)((int64_t)b * b >> 32);
        const cairn_size sum = cairn_squares_with(cairn_squares_with(0, a), b);
        expect("squares", x, (int32_t)(upper_a + upper_b), (int32_t)sum);
        if (cairn_squares_are_below(sum, limit)) {
            TEST_ASSERT_TRUE(cairn_size_is_below(cairn_size_with(cairn_size_of(a), b), limit));
        }
    }
}

void test_product_gives_all_64_bits(void)
{
    arith_random random = arith_random_seeded(64);
    for (uint32_t i = 0; i < ROUNDS; i++) {
        arguments x = choose(&random, i, 1);
        uint32_t a = (uint32_t)x.a, b = (uint32_t)x.b;
        if (cairn_product(a, b) != (uint64_t)a * b) { TEST_ASSERT_EQUAL_HEX64((uint64_t)a * b, cairn_product(a, b)); }
    }
}

void test_sum_wraps_and_says_so(void)
{
    arith_random random = arith_random_seeded(33);
    for (uint32_t i = 0; i < ROUNDS; i++) {
        arguments x = choose(&random, i, 1);
        int64_t exact = (int64_t)x.a + x.b;
        int32_t sum;
        bool wrapped = cairn_add_overflows(x.a, x.b, &sum);
        expect("add", x, (int32_t)(uint32_t)(uint64_t)exact, sum);
        expect("add's overflow", x, exact != sum, wrapped);
    }
}

void test_leading_zeros_are_counted(void)
{
    arith_random random = arith_random_seeded(1);
    TEST_ASSERT_EQUAL_INT(32, cairn_clz(0));
    for (uint32_t bit = 0; bit < 32; bit++) {
        for (uint32_t i = 0; i < 1000; i++) {
            uint32_t below = arith_random_bits(&random) & (((uint32_t)1 << bit) - 1u);
            TEST_ASSERT_EQUAL_INT(31 - (int)bit, cairn_clz((uint32_t)1 << bit | below));
        }
    }
}
