/*
 * The fixed-point operations that are too long for arith_fixed.h: roots, quotients, angles, wide numbers.
 * They serve set-up, the API and the narrow phase; the solver's sweeps use none of them. No 64-bit division
 * anywhere, and no division at all: quotients and roots start from a table of 8 bits, take two third-order
 * Newton steps and, where the result is to be exact, are corrected by the remainder.
 * The constants come from tools/derive/arith_tables.py.
 */
#include "cairn/arith.h"

#ifdef CAIRN_DOUBLE

typedef int cairn_arith_fixed_unused; /* a translation unit may not be empty */

#else

#define SINE_1 (1686629690)
#define SINE_3 (-173399356)
#define SINE_5 (5346959)
#define SINE_7 (-77046)
#define COSINE_2 (-1324675872)
#define COSINE_4 (68093819)
#define COSINE_6 (-1399910)
#define COSINE_8 (15167)
#define ARC_1 (1367130546)
#define ARC_3 (-455709331)
#define ARC_5 (273385342)
#define ARC_7 (-194461789)
#define ARC_9 (143276551)
#define ARC_11 (-79794138)

/* 256 (1 / sqrt(m) - 1) for m in [i, i + 1) / 64, i from 16 to 63 */
static const uint8_t root_start[48] = {
    248, 234, 220, 208, 196, 186, 176, 166, 158, 150, 142, 135, 128, 121, 115, 109,
    103, 98, 93, 88, 83, 78, 74, 70, 66, 62, 58, 55, 51, 48, 44, 41,
    38, 35, 32, 29, 27, 24, 21, 19, 16, 14, 12, 10, 7, 5, 3, 1,
};

/* 256 (1 / m - 1) for m in [i, i + 1) / 64, i from 32 to 63 */
static const uint8_t inverse_start[32] = {
    248, 233, 219, 206, 193, 181, 170, 159, 149, 139, 129, 121, 112, 104, 96, 89,
    82, 75, 68, 62, 56, 50, 45, 39, 34, 29, 24, 19, 15, 10, 6, 2,
};

/* ---- shared by the rest ---- */

CAIRN_SHARED uint32_t magnitude(int32_t x)
{
    return x < 0 ? 0u - (uint32_t)x : (uint32_t)x;
}

static int32_t with_sign(uint32_t size, int32_t sign)
{
    int32_t x = size > (uint32_t)INT32_MAX ? INT32_MAX : (int32_t)size;
    return sign < 0 ? -x : x;
}

static uint32_t high_word(uint64_t x)
{
    return (uint32_t)(x >> 32);
}

static int clz64(uint64_t x)
{
    uint32_t high = high_word(x);
    return high != 0 ? cairn_clz(high) : 32 + cairn_clz((uint32_t)x);
}

/* start (1 + correction), start in Q15, correction in Q30, to Q31 */
static uint32_t corrected(uint32_t start, int32_t correction)
{
    return (start << 16) + (uint32_t)(correction * (int32_t)start >> 14);
}

/* 1 / m in Q15, within 2 units; m in Q32, at least 1/2. */
static inline uint32_t inverse_16(uint32_t m)
{
    uint32_t start = 256u + inverse_start[(m >> 26) - 32]; /* Q8, within 2^-5.9 */
    int32_t d = (int32_t)(0x80000000u - (m >> 9) * start) >> 14; /* 1 - m start, Q17 */
    int32_t c = d + (d * d >> 17);
    uint32_t r = (start * (uint32_t)(131072 + c) + 512) >> 10;
    return r - (r >> 16); /* 2 itself: one less */
}

/* 1 / m in Q31, within 4 units; m in Q32, at least 1/2. */
static uint32_t inverse_32(uint32_t m)
{
    uint32_t r = inverse_16(m);
    int32_t d = (int32_t)(0x80000000u - (m >> 16) * r - ((m & 0xFFFFu) * r >> 16)); /* 1 - m r, Q31 */
    uint32_t square = (uint32_t)(d >> 1) * (uint32_t)(d >> 1); /* Q60 */
    return corrected(r, ((d + 1) >> 1) + (int32_t)(square >> 30));
}

/* 1 / sqrt(m) in Q31, within 5 units; m in Q32, at least 1/4. */
CAIRN_ONCE uint32_t inverse_root_32(uint32_t m)
{
    uint32_t r = 256u + root_start[(m >> 26) - 16]; /* Q8, within 2^-5.8 */
    int32_t d = (int32_t)(0u - (m >> 14) * (r * r)) >> 15; /* 1 - m r^2, Q34 (its 1 is 2^34, gone in 32 bits), to Q19 */
    int32_t c = (d >> 1) + (3 * d * d >> 22); /* d/2 + 3/8 d^2 */
    uint32_t square;

    r = (r * (uint32_t)(524288 + c) + 2048) >> 12; /* Q15, within 2^-15 */
    r -= r >> 16; /* 2 itself: one less */
    d = (int32_t)(0x40000000u - high_word(cairn_product(m, r * r))); /* Q30, below 2^-14 */
    square = (uint32_t)d * (uint32_t)d; /* Q60 */
    return corrected(r, ((d + 1) >> 1) + (int32_t)(square >> 31));
}

/* a / b in so many bits behind the point, 1 to 32, rounded to nearest, halves upwards; a <= b, a < b for 32. Bit by bit. */
static uint32_t quotient(uint32_t a, uint32_t b, int bits)
{
    uint32_t q = 0;
    for (; bits > 0; bits--) {
        uint32_t lack = b - a; /* 2 a - b is a - lack, and does not overflow */
        q = 2 * q + (a >= lack);
        a = a >= lack ? a - lack : 2 * a;
    }
    return q + (a >= b - a);
}

/* a / b in Q31, rounded to nearest; a <= b, b at least 2^31. */
static uint32_t fraction(uint32_t a, uint32_t b)
{
    if (CAIRN_SMALL) { return quotient(a, b, 31); }
    uint32_t q = high_word(cairn_product(a, inverse_32(b)));
    int64_t rest = (int64_t)(((uint64_t)a << 31) - cairn_product(q, b));

    while (rest < 0) { q--; rest += b; } /* at most 5 times: q is within 5 */
    while (rest >= (int64_t)b) { q++; rest -= b; }
    return 2 * rest >= (int64_t)b ? q + 1 : q;
}

/* The same as below, bit by bit: the greatest s with (s - 1/2)^2 < x, which for whole numbers is s (s - 1) < x. */
static uint32_t root_by_bits(uint64_t x)
{
    uint32_t s = 0;
    for (uint32_t bit = 0x80000000u; bit != 0; bit >>= 1) {
        uint32_t more = s + bit;
        if (cairn_product(more, more - 1) < x) { s = more; }
    }
    return s;
}

/* The square root rounded to nearest, at most 2^32 - 1. */
static uint32_t root(uint64_t x)
{
    if (CAIRN_SMALL) { return root_by_bits(x); }
    int shift;
    uint64_t m;
    uint32_t r, s;
    int64_t rest;

    if (x == 0) { return 0; }
    shift = clz64(x) & ~1;
    m = x << shift;
    r = inverse_root_32(high_word(m));
    s = high_word(cairn_product(high_word(m), r)); /* sqrt(m) = m / sqrt(m): Q32 Q31 -> Q31 */
    s = s > 0x7FFFFFFFu ? UINT32_MAX : s << 1;
    s >>= shift / 2;
    rest = (int64_t)(x - cairn_product(s, s));
    while (rest > (int64_t)s && s != UINT32_MAX) { s++; rest -= 2 * (int64_t)s - 1; } /* at most 12 times: s is within 12 */
    while (rest <= -(int64_t)s) { rest += 2 * (int64_t)s - 1; s--; }
    return s;
}

/* ---- cairn_real ---- */

cairn_real cairn_real_divide(cairn_real a, cairn_real b)
{
    uint32_t over = magnitude(a), under = magnitude(b);
    int32_t sign = a ^ b;
    int shift;
    uint32_t q;
    int64_t rest;

    if (b == 0) { return a > 0 ? CAIRN_REAL_MAX : a < 0 ? -CAIRN_REAL_MAX : 0; }
    if ((uint64_t)over >= (uint64_t)under << 15) { return with_sign(UINT32_MAX, sign); }
    shift = cairn_clz(under);
    q = (uint32_t)(cairn_product(over, inverse_32(under << shift)) >> (47 - shift));
    rest = (int64_t)(((uint64_t)over << 16) - cairn_product(q, under));
    while (rest < 0) { q--; rest += under; } /* at most 5 times: q is within 5 */
    while (rest >= (int64_t)under) { q++; rest -= under; }
    return with_sign(2 * rest >= (int64_t)under ? q + 1 : q, sign);
}

cairn_real cairn_real_sqrt(cairn_real x)
{
    return x > 0 ? (cairn_real)root((uint64_t)(uint32_t)x << 16) : 0;
}

cairn_real cairn_real_length(cairn_real x, cairn_real y)
{
    uint32_t a = magnitude(x), b = magnitude(y);
    return with_sign(root(cairn_product(a, a) + cairn_product(b, b)), 1);
}

cairn_real cairn_real_geometric_mean(cairn_real a, cairn_real b)
{
    return a > 0 && b > 0 ? (cairn_real)root(cairn_product((uint32_t)a, (uint32_t)b)) : 0;
}

/* ---- angles ---- */

void cairn_angle_rotation(cairn_angle angle, cairn_unit *cosine, cairn_unit *sine)
{
    uint32_t quadrant = ((uint32_t)angle + 0x20000000u) >> 30;
    int32_t z = (int32_t)(((uint32_t)angle - (quadrant << 30)) << 2); /* quarters of pi, Q31, in [-1, 1) */
    int32_t w = cairn_mul32(z, z, 32); /* z^2, Q30 */
    int32_t s, c;

    s = cairn_mul32(SINE_7, w, 30);
    s = cairn_mul32(SINE_5 + s, w, 30);
    s = cairn_mul32(SINE_3 + s, w, 30);
    s = cairn_mul32(SINE_1 + s, z, 32); /* Q31 Q31 -> Q30 */
    c = cairn_mul32(COSINE_8, w, 30);
    c = cairn_mul32(COSINE_6 + c, w, 30);
    c = cairn_mul32(COSINE_4 + c, w, 30);
    c = CAIRN_UNIT(1) + cairn_mul32(COSINE_2 + c, w, 32); /* Q32 Q30 -> Q30 */

    if (quadrant & 1) { /* a quarter turn on */
        int32_t t = c;
        c = -s;
        s = t;
    }
    *cosine = quadrant & 2 ? -c : c;
    *sine = quadrant & 2 ? -s : s;
}

/* atan(t) in binary angle; t = a / b in [0, tan(pi/8)], b at least 1. */
static int32_t arc_tangent(uint32_t a, uint32_t b)
{
    int shift = cairn_clz(b);
    int32_t t = (int32_t)fraction(a << shift, b << shift); /* Q31 */
    int32_t w = cairn_mul32(t, t, 32); /* Q30 */
    int32_t p = cairn_mul32(ARC_11, w, 30);

    p = cairn_mul32(ARC_9 + p, w, 30);
    p = cairn_mul32(ARC_7 + p, w, 30);
    p = cairn_mul32(ARC_5 + p, w, 30);
    p = cairn_mul32(ARC_3 + p, w, 30);
    return cairn_mul32(ARC_1 + p, t, 32);
}

cairn_angle cairn_angle_of(cairn_real y, cairn_real x)
{
    uint32_t ax = magnitude(x), ay = magnitude(y);
    uint32_t large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
    uint32_t angle;

    if (large == 0) { return 0; }
    if (large >> 31) { large >>= 1; small >>= 1; }
    if (small <= high_word(cairn_product(large, 1779033704u))) { /* tan(pi/8) */
        angle = (uint32_t)arc_tangent(small, large);
    } else {
        angle = 0x20000000u - (uint32_t)arc_tangent(large - small, large + small);
    }
    angle = ay > ax ? 0x40000000u - angle : angle;
    angle = x < 0 ? 0x80000000u - angle : angle;
    return (cairn_angle)(y < 0 ? 0u - angle : angle);
}

cairn_angle cairn_angle_from_radians(cairn_real radians)
{
    /* 2^16 / 2 pi = 10430.37835047; the whole turns wrap away. */
    return (cairn_angle)((uint32_t)radians * 10430u + (uint32_t)cairn_mul32(radians, 1625002897, 32));
}

cairn_angle cairn_angle_of_turn(int32_t part, int32_t whole)
{
    return (cairn_angle)quotient((uint32_t)part, (uint32_t)whole, 32);
}

/* ---- cairn_wide ---- */

static int32_t exponent_of(cairn_wide_word w) { return (int32_t)high_word(w); }
static cairn_wide_word word_of(uint32_t mantissa, int32_t exponent) { return (uint64_t)(uint32_t)exponent << 32 | mantissa; }

/* x * 2^exponent, rounded to 32 bits. */
static cairn_wide_word word_from_64(uint64_t x, int32_t exponent)
{
    uint32_t mantissa;

    if (x == 0) { return 0; }
    if (CAIRN_SMALL) { /* by single bits, and not by a function that shifts by any number */
        for (; x >> 63 == 0; x <<= 1) { exponent--; }
    } else {
        int shift = clz64(x);
        x <<= shift;
        exponent -= shift;
    }
    mantissa = high_word(x) + ((uint32_t)x >> 31);
    exponent += 32;
    return mantissa != 0 ? word_of(mantissa, exponent) : word_of(0x80000000u, exponent + 1);
}

/* The binary point's place comes with the sign that most calls have it in: Thumb must make negative numbers of positive ones. */
cairn_wide_word cairn_word_of(int32_t x, int places)
{
    return word_from_64(magnitude(x), -places);
}

/* |x| / 2^places */
CAIRN_SHARED cairn_wide_word word_from_signed(int64_t x, int places)
{
    return word_from_64(x < 0 ? 0u - (uint64_t)x : (uint64_t)x, -places);
}

cairn_wide_word cairn_word_from_area(cairn_area a) { return word_from_signed(a, 44); }

cairn_wide_word cairn_word_from_sum(cairn_offset a, cairn_offset b)
{
    return word_from_signed((int64_t)a + b, 22);
}

cairn_wide_word cairn_word_mul(cairn_wide_word a, cairn_wide_word b)
{
    return word_from_64(cairn_product((uint32_t)a, (uint32_t)b), exponent_of(a) + exponent_of(b));
}

cairn_wide_word cairn_word_div(cairn_wide_word a, cairn_wide_word b)
{
    uint32_t over = (uint32_t)a, under = (uint32_t)b;
    int32_t exponent = exponent_of(a) - exponent_of(b) - 31;

    if (over == 0 || under == 0) { return 0; }
    /* 1 + fraction, so that all 32 bits of the quotient count: a/b, or 2a/b when a is the smaller. */
    if (over < under) {
        over *= 2; /* wraps: the difference does not */
        exponent--;
    }
    return word_of(0x80000000u + fraction(over - under, under), exponent);
}

cairn_wide_word cairn_word_inverse(cairn_wide_word a) { return cairn_word_div(word_of(0x80000000u, -31), a); }

bool cairn_wide_less(cairn_wide a, cairn_wide b)
{
    if (a.mantissa == 0 || b.mantissa == 0) { return a.mantissa < b.mantissa; }
    return (int64_t)cairn_wide_to_word(a) < (int64_t)cairn_wide_to_word(b); /* by the exponents, then by the mantissas */
}

cairn_wide_word cairn_word_add(cairn_wide_word a, cairn_wide_word b)
{
    if ((uint32_t)a == 0) { return b; }
    if ((uint32_t)b == 0) { return a; }
    bool less = exponent_of(a) < exponent_of(b);
    cairn_wide_word large = less ? b : a, small = less ? a : b;
    int32_t apart = exponent_of(large) - exponent_of(small);

    if (apart > 33) { return large; }
    return word_from_64(((uint64_t)(uint32_t)large << 31) + (((uint64_t)(uint32_t)small << 31) >> apart), exponent_of(large) - 31);
}

cairn_wide_word cairn_word_determinant(cairn_share a, cairn_share b, cairn_share c, cairn_share d)
{
    return word_from_signed(cairn_times(a, d) - cairn_times(b, c), 60);
}

cairn_wide_word cairn_word_sqrt(cairn_wide_word a)
{
    int odd = (int)(high_word(a) & 1u);
    /* mantissa * 2^exponent = (mantissa * 2^(32 - odd)) * 2^(exponent - 32 + odd), an even power */
    return word_from_64(root((uint64_t)(uint32_t)a << (32 - odd)), (exponent_of(a) - 32 + odd) / 2);
}

/* x / 2^shift rounded, shift from 1 on; x < 2^63 */
CAIRN_SHARED uint64_t shifted(uint64_t x, int shift)
{
    if (!CAIRN_SMALL && shift > 32) { /* the common case of what comes to 32 bits: the high word alone */
        return shift > 63 ? 0 : ((high_word(x) >> (shift - 33)) + 1) >> 1;
    }
    return shift > 63 ? 0 : ((x >> (shift - 1)) + 1) >> 1;
}

int32_t cairn_word_scale(cairn_wide_word k, int32_t x, int exponent)
{
    uint64_t product = cairn_product(magnitude(x), (uint32_t)k);
    int shift = -(exponent_of(k) + exponent);

    if (product == 0) { return 0; }
    if (shift <= 0) { return with_sign(UINT32_MAX, x); }
    product = shifted(product, shift);
    return with_sign(high_word(product) ? UINT32_MAX : (uint32_t)product, x);
}

cairn_angle cairn_angle_from_motion(cairn_motion x, cairn_wide inverse_gyration)
{
    /* 2^32 / 2 pi over 2^28 is 16 / 2 pi, in Q30 here */
    uint32_t k = high_word(cairn_product(inverse_gyration.mantissa, 2734261102u) + 0x80000000u);
    uint64_t product = cairn_product(magnitude(x), k);
    int shift = -(inverse_gyration.exponent + 2);
    uint32_t turned;

    if (!CAIRN_SMALL && shift > 0 && shift <= 32) { /* a radius of gyration below 8 m; word by word */
        uint32_t low = (uint32_t)product >> (shift - 1);
        turned = (high_word(product) << (32 - shift)) + (low >> 1) + (low & 1u);
    } else if (shift > 0) {
        turned = (uint32_t)shifted(product, shift);
    } else {
        turned = shift > -32 ? (uint32_t)product << -shift : 0;
    }
    return (cairn_angle)(x < 0 ? 0u - turned : turned);
}

cairn_diffused cairn_diffused_of(cairn_real x, cairn_wide k)
{
    uint64_t size = cairn_product(magnitude(x), k.mantissa); /* to Q60: Q28 and 32 bits below */
    int shift = -(k.exponent + 12 + 32);
    cairn_diffused d;

    d.carry = 0;
    if (shift > 0) {
        size = shifted(size, shift);
    } else if (size != 0) {
        size = -shift >= clz64(size) ? UINT64_MAX : size << -shift;
    }
    if (high_word(size) >= (uint32_t)INT32_MAX) { size = (uint64_t)INT32_MAX << 32; }
    if (x < 0) { size = 0u - size; }
    d.whole = (cairn_motion)high_word(size);
    d.fraction = (uint32_t)size;
    return d;
}

/* ---- vectors between bodies ---- */

cairn_unit cairn_offset_fraction(cairn_offset a, cairn_offset b)
{
    int shift = cairn_clz((uint32_t)b);
    uint32_t q = (high_word(cairn_product((uint32_t)a << shift, inverse_32((uint32_t)b << shift))) + 1) >> 1;
    return a == b ? CAIRN_UNIT(1) : (cairn_unit)q;
}

/* size * scale / 2^33, rounded, with a sign: one component of the unit vector */
CAIRN_SHARED cairn_unit component(uint32_t size, uint32_t scale, int32_t sign)
{
    int32_t u = (int32_t)((high_word(cairn_product(size, scale)) + 1) >> 1);
    u = u > CAIRN_UNIT(1) ? CAIRN_UNIT(1) : u;
    return sign < 0 ? -u : u;
}

/* One of the two is zero. */
CAIRN_ONCE cairn_offset along_axis(cairn_offset x, cairn_offset y, cairn_unit *ux, cairn_unit *uy)
{
    cairn_offset along = x + y;
    cairn_unit way = (along >> 31 | 1) * CAIRN_UNIT(1); /* with the sign */
    *ux = y != 0 ? 0 : way;
    *uy = y != 0 ? way : 0;
    return with_sign(magnitude(along), 1);
}

cairn_offset cairn_unit_along(cairn_offset x, cairn_offset y, cairn_unit *ux, cairn_unit *uy)
{
    uint32_t ax = magnitude(x), ay = magnitude(y), r, length;
    uint64_t square;
    int shift;

    if (x == 0 || y == 0) { return along_axis(x, y, ux, uy); }

    /* Scale so that the squared length lies in [2^62, 2^64): at once, but for a last bit, or bit by bit. */
    shift = CAIRN_SMALL ? 0 : cairn_clz(ax | ay) - 1;
    shift = shift < 0 ? 0 : shift; /* 2^31 itself */
    ax <<= shift;
    ay <<= shift;
    square = cairn_product(ax, ax) + cairn_product(ay, ay);
    if (high_word(square) >> 30 == 0) {
        do {
            ax <<= 1;
            ay <<= 1;
            square <<= 2;
            shift++;
        } while (CAIRN_SMALL && high_word(square) >> 30 == 0);
    }
    r = inverse_root_32(high_word(square));
    *ux = component(ax, r, x);
    *uy = component(ay, r, y);
    if (!CAIRN_WITH_GIANTS || shift >= 4) { /* below 32 m: length = square / length */
        length = high_word(cairn_product(high_word(square), r));
        return shift < 2 ? with_sign(length << (1 - shift), 1) : (cairn_offset)(((length >> (shift - 2)) + 1) >> 1);
    }
    /* That is too coarse for the last bit of a longer one: take the root itself. */
    return with_sign((uint32_t)(((uint64_t)root(square) + ((1u << shift) >> 1)) >> shift), 1);
}

/* Where a step stands in a turn of 2^16: steps of the golden ratio fill it evenly, however many there are. */
static int32_t turn_of(uint32_t step) { return (int32_t)((step * 40503u) & 0xFFFFu); }

cairn_lever cairn_lever_in_turn(cairn_offset arm, cairn_wide inverse_gyration, uint32_t step)
{
    int32_t fine = cairn_clamp(cairn_wide_scale(arm, inverse_gyration, 6), CAIRN_LEVER_MAX << 15); /* Q2.28 */
    return (cairn_lever)((fine + (turn_of(step) >> 1)) >> 15);
}

cairn_dir cairn_dir_in_turn(cairn_unit u, uint32_t step)
{
    if ((u & 65535) == 0) { return (cairn_dir)(u >> 16); }
    return (cairn_dir)(2 * ((u - 65536 + 2 * turn_of(step)) >> 17) + 1);
}

cairn_lean cairn_dir_lean(cairn_unit x, cairn_unit y, cairn_dir dx, cairn_dir dy)
{
    int32_t rest_x = x - dx * 65536, rest_y = y - dy * 65536; /* at most two units of Q14 */
    return (cairn_lean)(((rest_y >> 2) * dx - (rest_x >> 2) * dy + 16384) >> 15);
}

/* Of x / 2^14, what lies beyond the nearest whole number: its lowest 14 bits, with their sign. */
static int32_t beyond(uint32_t x) { return (int32_t)(x << 18) >> 18; }

void cairn_motion_add_lack(cairn_motion *vx, cairn_motion *vy, cairn_motion push, cairn_motion rub, cairn_dir dx, cairn_dir dy, cairn_lean lean,
                           int times, uint32_t step)
{
    /* All in 2^-14 of a unit. What is cut off is 2000 times what gravity presses with. */
    int32_t across = cairn_clamp(cairn_mul32(cairn_clamp(push, CAIRN_MOTION(1)), lean, 13), 1 << 26), turn = turn_of(step) >> 2;
    int32_t x = beyond((uint32_t)push * (uint32_t)dx - (uint32_t)rub * (uint32_t)dy);
    int32_t y = beyond((uint32_t)rub * (uint32_t)dx + (uint32_t)push * (uint32_t)dy);
    *vx += (times * (x - cairn_mul16(across, dy, 14)) + turn) >> 14;
    *vy += (times * (y + cairn_mul16(across, dx, 14)) + turn) >> 14;
}

bool cairn_frame_set(cairn_frame *frame, cairn_unit x, cairn_unit y, cairn_offset length)
{
    int shift = 17 - cairn_clz((uint32_t)length);
    frame->x = cairn_dir_from_unit(x);
    frame->y = cairn_dir_from_unit(y);
    if (shift < 0 || shift > 11) { return false; }
    frame->inverse = (uint16_t)(cairn_offset_fraction(16384 << shift, length) >> 15);
    frame->shift = (uint8_t)shift;
    frame->rest = (uint8_t)(19 - shift);
    return true;
}

/* ---- coefficients ---- */

cairn_gain cairn_gain_from_wide(cairn_wide k)
{
    int shift = -32 - k.exponent;
    cairn_gain gain;
    gain.mantissa = (uint16_t)(shift < 0 ? 32767u : shift > 30 ? 0u : k.mantissa >> 17);
    gain.shift = (uint16_t)(shift < 0 || shift > 30 ? 0 : shift);
    if (k.mantissa == 0) { gain.mantissa = 0; }
    return gain;
}

cairn_gain cairn_gain_from_share(cairn_share s)
{
    int shift = cairn_clz((uint32_t)s) - 2;
    cairn_gain gain;
    gain.mantissa = (uint16_t)(shift < 0 ? 32767 : shift > 15 ? s << (shift - 15) : s >> (15 - shift));
    gain.shift = (uint16_t)(shift < 0 || s == 0 ? 0 : shift);
    return gain;
}

/* 1 / f for f below 1, which no effective mass is */
static cairn_ratio inverse_of_fraction(cairn_factor f)
{
    uint32_t r = f > CAIRN_FACTOR(0.5) ? (inverse_16((uint32_t)f << 12) + 1) >> 1 : (uint32_t)INT16_MAX;
    return r > (uint32_t)INT16_MAX ? INT16_MAX : (cairn_ratio)r;
}

cairn_ratio cairn_factor_inverse(cairn_factor f)
{
    int down = 1; /* f = m 2^down, m in [1/2, 1) */

    if (f < CAIRN_FACTOR(1)) { return inverse_of_fraction(f); }
    for (; f >= CAIRN_FACTOR(2); f >>= 1) { down++; } /* most are below 4: cheaper than to count zeros */
    return (cairn_ratio)(((inverse_16((uint32_t)f << 11) >> down) + 1) >> 1); /* Q15 -> Q14 */
}

cairn_motion cairn_motion_closing(cairn_motion u, cairn_motion g, cairn_motion s)
{
    const int64_t most = (int64_t)1 << 61; /* beyond it the root is 0 or saturates whatever u is */
    int64_t gain = cairn_times(g, s);
    int64_t square = cairn_times(u, u) + 2 * (gain > most ? most : gain < -most ? -most : gain);
    uint32_t speed = square > 0 ? root((uint64_t)square) : 0;
    return speed > INT32_MAX ? INT32_MAX : (int32_t)speed;
}

cairn_motion cairn_motion_divide(cairn_motion x, cairn_factor f)
{
    int32_t quotient = cairn_word_scale(cairn_word_div(cairn_word_of(x, 28), cairn_word_of(f, 20)), 1, 28);
    return x < 0 ? -quotient : quotient;
}

/* ---- cairn_push ---- */

/* high * 2^31 + low is x: both products fit in 64 bits. */
int64_t cairn_mul64(int64_t x, int32_t f, int shift)
{
    int64_t high = cairn_times((int32_t)(x >> 31), f), low = cairn_times((int32_t)((uint32_t)x & 0x7FFFFFFFu), f);
    low += (uint32_t)1 << (shift - 1);
    return (int64_t)((uint64_t)high << (31 - shift)) + (low >> shift);
}

cairn_push cairn_push_dir(cairn_push x, cairn_dir d)
{
    return cairn_push_is_short(x) ? cairn_mul16((int32_t)x, d, 14) : cairn_mul64(x, d, 14);
}

cairn_push cairn_push_lever(cairn_push x, cairn_lever j)
{
    return cairn_push_is_short(x) ? cairn_mul16((int32_t)x, j, 13) : cairn_mul64(x, j, 13);
}

cairn_push cairn_push_unit(cairn_push x, cairn_unit u)
{
    return cairn_push_is_short(x) ? cairn_mul32((int32_t)x, u, 30) : cairn_mul64(x, u, 30);
}

cairn_push cairn_push_scale(cairn_push x, cairn_wide k)
{
    if (x == 0 || k.mantissa == 0) { return 0; }
    if (cairn_push_is_short(x) && k.exponent <= -32) { return cairn_wide_scale((int32_t)x, k, 0); }
    uint64_t size = x < 0 ? 0u - (uint64_t)x : (uint64_t)x;
    uint64_t low = cairn_product((uint32_t)size, k.mantissa);
    uint64_t top = cairn_product(high_word(size), k.mantissa) + high_word(low); /* with the lower half of low: 96 bits */
    int shift = -k.exponent;
    if (shift > 32) {
        size = shifted(top, shift - 32);
    } else if (shift == 32) {
        size = top + ((uint32_t)low >> 31);
    } else if (shift <= 0 || top >> (15 + shift) != 0) {
        size = (uint64_t)CAIRN_PUSH_MAX;
    } else {
        size = (top << (32 - shift)) + ((((uint32_t)low >> (shift - 1)) + 1) >> 1);
    }
    return cairn_push_clamp(x < 0 ? -(int64_t)size : (int64_t)size, CAIRN_PUSH_MAX);
}

cairn_push cairn_push_shift(cairn_push x, int n)
{
    if (n < 0) { return ((x >> (-n - 1)) + 1) >> 1; }
    return cairn_push_clamp(x, CAIRN_PUSH_MAX >> n) * ((cairn_push)1 << n);
}

int cairn_push_excess(cairn_push x)
{
    int used = 64 - clz64((uint64_t)(x < 0 ? -x : x));
    return used > 29 ? used - 29 : 0;
}

#endif
