/*
 * The fixed-point definition of every operation. Each has one exact result, whatever the compiler or the core:
 * products are rounded to nearest, halves upwards, unless an operation says otherwise.
 * A port may replace the few primitives of the first section by faster code that gives the same bits:
 * name a header in CAIRN_ARITH_PORT that defines CAIRN_PORT_MUL16, _MUL16_DOWN, _MUL32, _DOT16, _DOT32, _PRODUCT, _TIMES, _ADD_ROUNDED, _KEPT, _SHORT, _FORGET, _ADD_SQUARE, _ADD, _CLZ or _ASKS;
 * those for the Cortex-M cores are in ports/arith.
 */
#ifndef CAIRN_ARITH_FIXED_H
#define CAIRN_ARITH_FIXED_H

#ifdef CAIRN_ARITH_PORT
#include CAIRN_ARITH_PORT
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef int32_t cairn_real;
typedef int32_t cairn_angle;
typedef int32_t cairn_motion;
typedef int32_t cairn_offset;
typedef int32_t cairn_unit;
typedef int16_t cairn_dir;
typedef uint16_t cairn_heading;
typedef int16_t cairn_lever;
typedef int16_t cairn_ratio;
typedef int32_t cairn_share;
typedef int32_t cairn_factor;
typedef int64_t cairn_push;
typedef int64_t cairn_area; /* Q20.44: products of two offsets, exact; set-up only */
typedef int16_t cairn_carry; /* what of a velocity lies below its last bit, Q0.43: half a unit of Q4.28 at most */
typedef uint16_t cairn_residue; /* what of a coordinate lies below its last bit, Q0.28 in 12 bits */
typedef uint16_t cairn_extent;  /* half the size of a box, rounded up to 1/256 m */
typedef uint16_t cairn_spot;    /* a coordinate in steps of 1/256 m, without the multiples of 256 m */
typedef int16_t cairn_lean;     /* the small angle by which a direction was rounded, rad, Q27 */
typedef uint32_t cairn_packed;  /* the mantissa in the upper 24 bits, the exponent in the lower 8; zero is 0 */

/* mantissa * 2^exponent; the mantissa's top bit is set, or all is zero. */
typedef struct cairn_wide {
    uint32_t mantissa;
    int32_t exponent;
} cairn_wide;

/* What the engine takes for granted of the compiler. */
typedef char cairn_assert_arithmetic_shift[((-3) >> 1) == -2 ? 1 : -1];
typedef char cairn_assert_twos_complement[(int32_t)(uint32_t)0xFFFFFFFFu == -1 ? 1 : -1];

/* Constants, evaluated by the compiler; x is a plain number. */
#define CAIRN_ROUND(x, scale) ((x) * (scale) + ((x) < 0 ? -0.5 : 0.5))
#define CAIRN_F(x) ((cairn_real)CAIRN_ROUND(x, 65536.0))
#define CAIRN_RADIANS(x) ((cairn_angle)(uint32_t)(int64_t)CAIRN_ROUND(x, 683565275.57643158))
#define CAIRN_DEGREES(x) ((cairn_angle)(uint32_t)(int64_t)CAIRN_ROUND(x, 11930464.711111111))
#define CAIRN_MOTION(x) ((cairn_motion)CAIRN_ROUND(x, 268435456.0))
#define CAIRN_OFFSET(x) ((cairn_offset)CAIRN_ROUND(x, 4194304.0))
#define CAIRN_UNIT(x) ((cairn_unit)CAIRN_ROUND(x, 1073741824.0))
#define CAIRN_RATIO(x) ((cairn_ratio)CAIRN_ROUND(x, 16384.0))
#define CAIRN_SHARE(x) ((cairn_share)CAIRN_ROUND(x, 1073741824.0))
#define CAIRN_FACTOR(x) ((cairn_factor)CAIRN_ROUND(x, 1048576.0))

#define CAIRN_REAL_MAX INT32_MAX
#define CAIRN_LEVER_MAX 23170 /* 2 sqrt(2): the farthest a convex body's edge lies from its centre, over its gyration radius */

/* ---- primitives ---- */

/* What a port does not replace is done in plain C. */
#ifndef CAIRN_PORT_MUL16
#define CAIRN_PORT_MUL16(a, b, shift) ((int32_t)(((int64_t)(a) * (b) + ((int64_t)1 << ((shift) - 1))) >> (shift)))
#endif
#ifndef CAIRN_PORT_MUL16_DOWN
#define CAIRN_PORT_MUL16_DOWN(a, b) ((int32_t)(((int64_t)(a) * (b)) >> 16))
#endif
#ifndef CAIRN_PORT_MUL32
#define CAIRN_PORT_MUL32(a, b, shift) ((int32_t)(((int64_t)(a) * (b) + ((int64_t)1 << ((shift) - 1))) >> (shift)))
#endif
/* 0 where the product of two 32-bit numbers costs no more than to ask whether it is needed. */
#ifndef CAIRN_PORT_ASKS
#define CAIRN_PORT_ASKS (!CAIRN_SMALL)
#endif
#ifndef CAIRN_PORT_DOT16
#define CAIRN_PORT_DOT16(a, b, c, d, shift) \
    ((int32_t)(((int64_t)(a) * (b) + (int64_t)(c) * (d) + ((int64_t)1 << ((shift) - 1))) >> (shift)))
#endif
#ifndef CAIRN_PORT_DOT32
#define CAIRN_PORT_DOT32(a, b, c, d, shift) \
    ((int32_t)(((int64_t)(a) * (b) + (int64_t)(c) * (d) + ((int64_t)1 << ((shift) - 1))) >> (shift)))
#endif
#ifndef CAIRN_PORT_PRODUCT
#define CAIRN_PORT_PRODUCT(a, b) ((uint64_t)(a) * (b))
#endif
#ifndef CAIRN_PORT_TIMES
#define CAIRN_PORT_TIMES(a, b) ((int64_t)(a) * (b))
#endif
#ifndef CAIRN_PORT_ADD_ROUNDED
#define CAIRN_PORT_ADD_ROUNDED(sum, x, shift) ((sum) + ((((x) >> ((shift) - 1)) + 1) >> 1))
#endif
#ifndef CAIRN_PORT_KEPT
#define CAIRN_PORT_KEPT(x) (x)
#endif
/* A constant, or a smaller one that an instruction can hold: to ask of it first. */
#ifndef CAIRN_PORT_SHORT
#define CAIRN_PORT_SHORT(x) (x)
#endif
#ifndef CAIRN_PORT_FORGET
#define CAIRN_PORT_FORGET() ((void)0)
#endif
#ifndef CAIRN_PORT_ADD
#define CAIRN_PORT_ADD(a, b, sum) cairn_add_plain(a, b, sum)
#endif
#ifndef CAIRN_PORT_CLZ
#define CAIRN_PORT_CLZ(x) cairn_clz_plain(x)
#endif

static inline bool cairn_add_plain(int32_t a, int32_t b, int32_t *sum)
{
    *sum = (int32_t)((uint32_t)a + (uint32_t)b);
    return ((a ^ *sum) & (b ^ *sum)) < 0;
}

static inline int cairn_clz_plain(uint32_t x)
{
    int n = 32;
    if (CAIRN_SMALL) {
        for (; x != 0; x >>= 1) { n--; }
        return n;
    }
    if (x >> 16) { n -= 16; x >>= 16; }
    if (x >> 8) { n -= 8; x >>= 8; }
    if (x >> 4) { n -= 4; x >>= 4; }
    if (x >> 2) { n -= 2; x >>= 2; }
    if (x >> 1) { return n - 2; }
    return n - (int)x;
}

/* a * b / 2^shift; b in 16 bits, 1 <= shift <= 16. The result must fit. */
static inline int32_t cairn_mul16(int32_t a, int32_t b, int shift) { return CAIRN_PORT_MUL16(a, b, shift); }

/* a * b / 2^16, rounded down; b in 16 bits with its sign. */
static inline int32_t cairn_mul16_down(int32_t a, int32_t b) { return CAIRN_PORT_MUL16_DOWN(a, b); }

/* a * b / 2^shift, 1 <= shift <= 32. The result must fit. */
static inline int32_t cairn_mul32(int32_t a, int32_t b, int shift) { return CAIRN_PORT_MUL32(a, b, shift); }

/* (a * b + c * d) / 2^shift, b and d at most 2^14 in size, rounded once, 1 <= shift <= 16. The result must fit. */
static inline int32_t cairn_dot16(int32_t a, int32_t b, int32_t c, int32_t d, int shift) { return CAIRN_PORT_DOT16(a, b, c, d, shift); }

/* (a * b + c * d) / 2^shift, rounded once, 1 <= shift <= 32. The result must fit. */
static inline int32_t cairn_dot32(int32_t a, int32_t b, int32_t c, int32_t d, int shift)
{
    return CAIRN_PORT_DOT32(a, b, c, d, shift);
}

/* a * b, all 64 bits. */
static inline uint64_t cairn_product(uint32_t a, uint32_t b) { return CAIRN_PORT_PRODUCT(a, b); }

/* The same of numbers with signs. */
static inline int64_t cairn_times(int32_t a, int32_t b) { return CAIRN_PORT_TIMES(a, b); }

/* sum + x / 2^shift, halves upwards; 2 <= shift <= 16. The result must fit. And the same of sum - x / 2^shift, halves of x upwards. */
static inline int32_t cairn_add_rounded(int32_t sum, int32_t x, int shift) { return CAIRN_PORT_ADD_ROUNDED(sum, x, shift); }
static inline int32_t cairn_less_rounded(int32_t sum, int32_t x, int shift) { return cairn_add_rounded(sum, ~x, shift); } /* ~x is -x - 1 */

/* The same number, of which the compiler is not to know how it was made: it keeps this one, and not its parts to make it again. */
static inline int32_t cairn_kept(int32_t x) { return CAIRN_PORT_KEPT(x); }

/* Between two ways that read the same: the second one reads it again, so that no registers are lost to it in the first one. */
static inline void cairn_forget(void) { CAIRN_PORT_FORGET(); }

/* sum = a + b, wrapped; true if it wrapped. */
static inline bool cairn_add_overflows(int32_t a, int32_t b, int32_t *sum) { return CAIRN_PORT_ADD(a, b, sum); }

/* Zero bits above the highest set bit; 32 for 0. */
static inline int cairn_clz(uint32_t x) { return CAIRN_PORT_CLZ(x); }

/*
 * Saturation is to +-INT32_MAX, so that every result may be negated.
 */

/* x into the 32-bit range. */
static inline int32_t cairn_clamp64(int64_t x)
{
    int32_t low = (int32_t)(uint32_t)x, high = (int32_t)(x >> 32);
    if (high != low >> 31) { return high < 0 ? -INT32_MAX : INT32_MAX; }
    return low < -INT32_MAX ? -INT32_MAX : low;
}

/*
 * a * b / 2^shift into the 32-bit range, 1 <= shift <= 31. On ways that are seldom taken: by the compiler's own function, for a product
 * that is inlined there takes registers from the other ways.
 */
static inline int32_t cairn_mul_clamped(int32_t a, int32_t b, int shift)
{
    int64_t product = CAIRN_SMALL ? cairn_times(a, b) : (int64_t)a * b;
    return cairn_clamp64((product + ((int64_t)1 << (shift - 1))) >> shift);
}

/* a + b into the 32-bit range. */
static inline int32_t cairn_add_clamped(int32_t a, int32_t b)
{
    int32_t sum;
    if (cairn_add_overflows(a, b, &sum)) { sum = (a >> 31) ^ INT32_MAX; }
    return sum < -INT32_MAX ? -INT32_MAX : sum;
}

/* x into [-limit, limit]. */
static inline int32_t cairn_clamp(int32_t x, int32_t limit)
{
    if ((uint32_t)x + (uint32_t)limit > 2u * (uint32_t)limit) { return x > 0 ? limit : -limit; }
    return x;
}

/* ---- cairn_real: Q16.16, saturating ---- */

static inline cairn_real cairn_real_add(cairn_real a, cairn_real b) { return cairn_add_clamped(a, b); }
static inline cairn_real cairn_real_sub(cairn_real a, cairn_real b) { return cairn_clamp64((int64_t)a - b); }
static inline cairn_real cairn_real_mul(cairn_real a, cairn_real b) { return cairn_mul_clamped(a, b, 16); }
static inline cairn_real cairn_real_from_int(int32_t x) { return cairn_clamp64((int64_t)x * 65536); }
static inline int32_t cairn_real_floor(cairn_real x) { return x >> 16; }
/* -limit <= x <= limit; limit >= 0 */
static inline bool cairn_real_is_within(cairn_real x, cairn_real limit) { return (uint32_t)x + (uint32_t)limit <= 2u * (uint32_t)limit; }
static inline cairn_real cairn_real_half(cairn_real x) { return x / 2; }
/* Is (x, y) longer than r? Not where it is by less than 1 mm, or r is beyond 8 m. 0 <= r. */
static inline bool cairn_real_is_longer(cairn_real x, cairn_real y, cairn_real r)
{
    uint32_t dx = (uint32_t)(x < 0 ? -x : x), dy = (uint32_t)(y < 0 ? -y : y), limit = ((uint32_t)r >> 4) + 1;
    if (r >= 8 << 16) { return false; }
    if (dx > (uint32_t)r || dy > (uint32_t)r) { return true; }
    dx >>= 4;
    dy >>= 4;
    return dx * dx + dy * dy > limit * limit;
}

/* Is the length of (x, y), rounded as below, at most r? All at least 0. */
static inline bool cairn_real_is_short(cairn_real x, cairn_real y, cairn_real r)
{
    uint32_t a = (uint32_t)x, b = (uint32_t)y, most = (uint32_t)r; /* up to r and a half: r^2 + r */
    return cairn_product(a, a) + cairn_product(b, b) <= cairn_product(most, most + 1u);
}
/* a / b rounded to nearest, halves away from zero; saturates, also for b = 0 (with the sign of a; 0 / 0 is 0). */
cairn_real cairn_real_divide(cairn_real a, cairn_real b);
/* Square root rounded to nearest; 0 for negative x. */
cairn_real cairn_real_sqrt(cairn_real x);
/* Length of (x, y), rounded to nearest; saturates. */
cairn_real cairn_real_length(cairn_real x, cairn_real y);

/* ---- angles ---- */

/* A coarse angle in 16 bits, and whether an angle is near it: within the limit, and 0.0001 rad more. */
static inline cairn_heading cairn_heading_of(cairn_angle a) { return (uint16_t)((uint32_t)a >> 16); }
static inline bool cairn_heading_is_near(cairn_heading heading, cairn_angle a, cairn_angle limit)
{
    return (uint32_t)a - ((uint32_t)heading << 16) + (uint32_t)limit <= 2 * (uint32_t)limit;
}
static inline cairn_angle cairn_angle_add(cairn_angle a, cairn_angle b) { return (int32_t)((uint32_t)a + (uint32_t)b); }
/* Cosine and sine, each within 2.7 units of Q2.30; exact at quarter turns. */
void cairn_angle_rotation(cairn_angle angle, cairn_unit *cosine, cairn_unit *sine);
/* The direction of (x, y), within 1.1 units of the binary angle; 0 for (0, 0). */
cairn_angle cairn_angle_of(cairn_real y, cairn_real x);
/* Radians in [-pi, pi], rounded to nearest. */
static inline cairn_real cairn_angle_radians(cairn_angle a) { return (cairn_mul32(a, 1686629713, 32) + 2048) >> 12; }
/* Any number of radians, within 0.52 units of the binary angle. */
cairn_angle cairn_angle_from_radians(cairn_real radians);
/* part / whole of a turn, rounded to nearest; 0 <= part < whole <= 65535. */
cairn_angle cairn_angle_of_turn(int32_t part, int32_t whole);

/* ---- cairn_wide: positive magnitudes of any size, relative error at most 2^-32 an operation ---- */

/* One as functions hand it over: in two registers, for many an ABI returns a structure by way of memory. */
typedef uint64_t cairn_wide_word;
CAIRN_ALWAYS_INLINE cairn_wide_word cairn_wide_to_word(cairn_wide a) { return (uint64_t)(uint32_t)a.exponent << 32 | a.mantissa; }
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_from_word(cairn_wide_word w)
{
    cairn_wide a;
    a.mantissa = (uint32_t)w;
    a.exponent = (int32_t)(uint32_t)(w >> 32);
    return a;
}
cairn_wide_word cairn_word_of(int32_t x, int places);
cairn_wide_word cairn_word_mul(cairn_wide_word a, cairn_wide_word b);
cairn_wide_word cairn_word_div(cairn_wide_word a, cairn_wide_word b);
cairn_wide_word cairn_word_add(cairn_wide_word a, cairn_wide_word b);
cairn_wide_word cairn_word_inverse(cairn_wide_word a);
cairn_wide_word cairn_word_sqrt(cairn_wide_word a);
cairn_wide_word cairn_word_determinant(cairn_share a, cairn_share b, cairn_share c, cairn_share d);
cairn_wide_word cairn_word_from_area(cairn_area a);
cairn_wide_word cairn_word_from_sum(cairn_offset a, cairn_offset b);
int32_t cairn_word_scale(cairn_wide_word k, int32_t x, int exponent);

CAIRN_SHARED cairn_wide_word cairn_word_from_int(int32_t x) { return cairn_word_of(x, 0); }

/* |x| * 2^exponent */
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_of(int32_t x, int exponent) { return cairn_wide_from_word(cairn_word_of(x, -exponent)); }
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_mul(cairn_wide a, cairn_wide b)
{
    return cairn_wide_from_word(cairn_word_mul(cairn_wide_to_word(a), cairn_wide_to_word(b)));
}
/* b = 0 gives zero */
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_div(cairn_wide a, cairn_wide b)
{
    return cairn_wide_from_word(cairn_word_div(cairn_wide_to_word(a), cairn_wide_to_word(b)));
}
/* 1 / a; of zero it is zero */
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_inverse(cairn_wide a) { return cairn_wide_from_word(cairn_word_inverse(cairn_wide_to_word(a))); }
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_add(cairn_wide a, cairn_wide b)
{
    return cairn_wide_from_word(cairn_word_add(cairn_wide_to_word(a), cairn_wide_to_word(b)));
}
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_sqrt(cairn_wide a) { return cairn_wide_from_word(cairn_word_sqrt(cairn_wide_to_word(a))); }
/* |a d - b c|, of shares */
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_determinant(cairn_share a, cairn_share b, cairn_share c, cairn_share d)
{
    return cairn_wide_from_word(cairn_word_determinant(a, b, c, d));
}
/* |a|, rounded to 32 bits. */
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_from_area(cairn_area a) { return cairn_wide_from_word(cairn_word_from_area(a)); }
/* |a + b|, rounded to 32 bits; the sum may lie outside of the offsets' range. */
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_from_sum(cairn_offset a, cairn_offset b) { return cairn_wide_from_word(cairn_word_from_sum(a, b)); }
/* x * k * 2^exponent, rounded to nearest, halves away from zero; saturated to +-INT32_MAX. */
CAIRN_ALWAYS_INLINE int32_t cairn_wide_scale(int32_t x, cairn_wide k, int exponent) { return cairn_word_scale(cairn_wide_to_word(k), x, exponent); }
/* A constant initialiser of 1/2 to less than 1. */
#define CAIRN_WIDE_PART(x) CAIRN_WIDE_SCALED(x, 0)
/* The same times 2^exponent. */
#define CAIRN_WIDE_SCALED(x, exponent) { (uint32_t)CAIRN_ROUND(x, 4294967296.0), (exponent) - 32 }
/* A constant initialiser of 0 to 65535 for what is only multiplied: in steps of 2^-16, its top bit need not be set. */
#define CAIRN_DENSITY(x) { (uint32_t)CAIRN_ROUND(x, 65536.0), -16 }
#define CAIRN_WIDE_PI (cairn_wide_of(1686629713, -29))
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_zero(void) { return cairn_wide_from_word(0); }
static inline bool cairn_wide_is_zero(cairn_wide a) { return a.mantissa == 0; }
static inline bool cairn_wide_is(cairn_wide a, cairn_wide b) { return a.mantissa == b.mantissa && a.exponent == b.exponent; }
bool cairn_wide_less(cairn_wide a, cairn_wide b);
/* As a body keeps it: within 2^-25 of itself, for exponents of -128 to 127. */
static inline cairn_packed cairn_wide_pack(cairn_wide k)
{
    uint32_t carry = k.mantissa >= 0xFFFFFF80u, mantissa = carry ? 0x80000000u : k.mantissa + 128u;
    return k.mantissa == 0 ? 0 : (mantissa & 0xFFFFFF00u) | (((uint32_t)k.exponent + carry) & 0xFFu);
}
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_unpack(cairn_packed p)
{
    cairn_wide k;
    k.mantissa = p & 0xFFFFFF00u;
    k.exponent = (int8_t)(uint8_t)p;
    return k;
}
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_from_real(cairn_real x) { return cairn_wide_of(x, -16); }
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_from_offset(cairn_offset x) { return cairn_wide_of(x, -22); }
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_from_int(int32_t x) { return cairn_wide_from_word(cairn_word_from_int(x)); }
static inline cairn_real cairn_wide_to_real(cairn_wide k) { return cairn_wide_scale(1, k, 16); }
static inline cairn_share cairn_wide_to_share(cairn_wide k) { return cairn_wide_scale(1, k, 30); }
static inline cairn_motion cairn_wide_to_motion(cairn_wide k) { return cairn_wide_scale(1, k, 28); }
static inline cairn_offset cairn_wide_to_offset(cairn_wide k) { return cairn_wide_scale(1, k, 22); }
static inline cairn_motion cairn_motion_from_real(cairn_real x, cairn_wide k) { return cairn_wide_scale(x, k, 12); }
static inline cairn_real cairn_real_from_motion(cairn_motion x, cairn_wide k) { return cairn_wide_scale(x, k, -12); }
/* A displacement times the inverse of the radius of gyration: the angle turned, within 2^-31 of itself and
   half a unit; whole turns wrap away. */
cairn_angle cairn_angle_from_motion(cairn_motion x, cairn_wide inverse_gyration);
/*
 * An arm over the radius of gyration, within 1.1 units of Q2.13 for radii from 31 micrometres up. Called several times
 * a contact, so by the upper 16 bits of the mantissa, rounded, which needs no 64-bit product.
 */
static inline cairn_lever cairn_lever_of(cairn_offset arm, cairn_wide inverse_gyration)
{
    uint32_t m = (inverse_gyration.mantissa >> 16) + (inverse_gyration.mantissa >> 15 & 1u);
    int shift = -23 - inverse_gyration.exponent; /* from Q22 + 32 to Q13 */
    int32_t scaled;
    if (shift < 2) {                             /* a radius below 8 mm: its arms are short and have 8 bits to spare */
        arm = (cairn_offset)((uint32_t)cairn_clamp(arm, CAIRN_OFFSET(1)) << 8);
        shift = shift < -6 ? 2 : shift + 8;
    }
    scaled = (int32_t)((uint32_t)(arm >> 16) * m + (((uint32_t)arm & 0xFFFFu) * m >> 16));
    return (cairn_lever)cairn_clamp(((scaled >> (shift < 31 ? shift - 1 : 30)) + 1) >> 1, CAIRN_LEVER_MAX);
}
/* Exact in the mean over the steps. */
cairn_lever cairn_lever_in_turn(cairn_offset arm, cairn_wide inverse_gyration, uint32_t step);
/* The sum of two, cut to the bound that a lever has. */
static inline cairn_lever cairn_lever_add(cairn_lever j, cairn_lever k) { return (cairn_lever)cairn_clamp(j + k, CAIRN_LEVER_MAX); }

/* ---- coordinates: a cairn_real and its residue make a position in steps of 2^-28 m ---- */

/* Move a coordinate by a displacement, to 32 km at most; |by| <= 7.99 m */
static inline void cairn_coordinate_move(cairn_real *x, cairn_residue *residue, cairn_motion by)
{
    int32_t sum = by + (int32_t)*residue;
    *residue = (cairn_residue)(sum & 4095);
    *x += sum >> 12;
}
/* To minus from. Both must lie within 512 m of one another. */
static inline cairn_offset cairn_coordinate_offset(cairn_real from, cairn_residue from_residue, cairn_real to, cairn_residue to_residue)
{
    return (int32_t)((((uint32_t)to - (uint32_t)from) << 6) + (uint32_t)(((int32_t)to_residue - (int32_t)from_residue) >> 6));
}
/* Move a coordinate by an offset. */
static inline void cairn_coordinate_shift(cairn_real *x, cairn_residue *residue, cairn_offset by)
{
    int32_t low = ((by & 63) << 6) + (int32_t)*residue;
    *residue = (cairn_residue)(low & 4095);
    *x = cairn_add_clamped(*x, (by >> 6) + (low >> 12));
}
static inline cairn_motion cairn_motion_half(cairn_motion x) { return x >> 1; }
/* x / 2^bits, rounded down: a shift. */
static inline cairn_motion cairn_motion_shifted(cairn_motion x, int bits) { return x >> bits; }
static inline cairn_motion cairn_motion_eighth(cairn_motion x) { return (x + 4) >> 3; }
/* x c + y s, rounded; saturates */
static inline cairn_real cairn_real_turn(cairn_real x, cairn_real y, cairn_unit c, cairn_unit s)
{
    return cairn_clamp64((cairn_times(x, c) + cairn_times(y, s) + 536870912) >> 30);
}
/* The nearest API number. */
static inline cairn_real cairn_coordinate_round(cairn_real x, cairn_residue residue)
{
    return cairn_add_clamped(x, residue >> 11);
}
static inline cairn_residue cairn_residue_zero(void) { return 0; }

/* ---- cairn_offset and cairn_unit ---- */

static inline cairn_offset cairn_offset_from_real(cairn_real x) { return (cairn_offset)((uint32_t)x << 6); } /* |x| < 512 m */
static inline cairn_real cairn_real_from_offset(cairn_offset x) { return (x >> 6) + (x >> 5 & 1); }
static inline cairn_motion cairn_motion_from_offset(cairn_offset x) { return (cairn_motion)((uint32_t)cairn_clamp(x, 33554431) << 6); }
static inline cairn_offset cairn_offset_from_motion(cairn_motion x) { return (x >> 6) + (x >> 5 & 1); }
#define CAIRN_OFFSET_MAX INT32_MAX
static inline cairn_offset cairn_offset_half(cairn_offset x) { return x >> 1; }
static inline cairn_offset cairn_offset_add(cairn_offset a, cairn_offset b) { return cairn_add_clamped(a, b); }
/* The next API number that is not below x. */
CAIRN_SHARED cairn_extent cairn_extent_above(cairn_real x) { return (cairn_extent)(x > 0xFFFF00 ? 0xFFFF : (x + 255) >> 8); }
static inline cairn_real cairn_real_from_extent(cairn_extent x) { return (cairn_real)x << 8; }
static inline cairn_real cairn_real_from_extents(cairn_extent a, cairn_extent b) { return (cairn_real)(((uint32_t)a + b) << 8); }
/* Of 4096 sectors of a turn, are both angles in the same? And by how much at most a point so far away moves within one. */
static inline bool cairn_angle_is_in_sector(cairn_angle a, cairn_angle b) { return ((uint32_t)a ^ (uint32_t)b) >> 20 == 0; }
static inline cairn_real cairn_real_sector(cairn_real radius) { return (radius >> 9) + 1; }
/* The same of 64 sectors; radius < 512 m */
static inline bool cairn_angle_is_in_wide_sector(cairn_angle a, cairn_angle b) { return ((uint32_t)a ^ (uint32_t)b) >> 26 == 0; }
static inline cairn_real cairn_real_wide_sector(cairn_real radius) { return (radius * 13 >> 7) + 1; }
/* The coordinate that a spot stands for, for one less than 127 m away; and how far that one has come from there at most, at least a step. */
static inline cairn_spot cairn_spot_of(cairn_real x) { return (cairn_spot)((uint32_t)x >> 8); }
static inline int32_t cairn_spot_offset(cairn_spot spot, cairn_real x)
{
    uint32_t by = ((uint32_t)x >> 8) - spot;
    return (int32_t)(by << 16) >> 16;
}
static inline cairn_real cairn_spot_real(cairn_spot spot, cairn_real x) { return (x >> 8) * 256 - cairn_spot_offset(spot, x) * 256; }
static inline cairn_extent cairn_spot_way(cairn_spot spot, cairn_real x)
{
    int32_t by = cairn_spot_offset(spot, x);
    return (cairn_extent)((by < 0 ? -by : by) + 1);
}
/* Are two spots within the sum of two extents? Far apart, beyond 128 m, it may say so wrongly. */
static inline bool cairn_spots_are_near(cairn_spot a, cairn_spot b, cairn_extent half_a, cairn_extent half_b)
{
    int32_t apart = (int32_t)(((uint32_t)a - b) << 16) >> 16;
    return (apart < 0 ? -apart : apart) <= (int32_t)half_a + half_b;
}
/* The next API number that is not below x. */
static inline cairn_real cairn_real_above_motion(cairn_motion x) { return (x + 4095) >> 12; }
static inline cairn_real cairn_real_above_offset(cairn_offset x) { return (x >> 6) + 1; }
static inline cairn_offset cairn_offset_mul(cairn_offset a, cairn_unit u) { return cairn_mul32(a, u, 30); }
/* ax ux + ay uy */
static inline cairn_offset cairn_offset_dot(cairn_offset ax, cairn_offset ay, cairn_unit ux, cairn_unit uy)
{
    return cairn_dot32(ax, ux, ay, uy, 30);
}
/* ax by - ay bx, exact; each product within 500 m by 500 m. */
CAIRN_SHARED cairn_area cairn_offset_cross(cairn_offset ax, cairn_offset ay, cairn_offset bx, cairn_offset by)
{
    return cairn_times(ax, by) - cairn_times(ay, bx);
}
static inline cairn_unit cairn_unit_dot(cairn_unit ax, cairn_unit ay, cairn_unit bx, cairn_unit by)
{
    return cairn_dot32(ax, bx, ay, by, 30);
}
/* a / b as a fraction in [0, 1], within 2 units of Q2.30, exact at both ends; 0 < b, 0 <= a <= b. */
cairn_unit cairn_offset_fraction(cairn_offset a, cairn_offset b);
/* The unit vector along (x, y), within 2 units of Q2.30, and the length within 0.8 units, saturated; exact along the
   axes; (1, 0) and 0 if both are zero. */
cairn_offset cairn_unit_along(cairn_offset x, cairn_offset y, cairn_unit *ux, cairn_unit *uy);
static inline cairn_dir cairn_dir_from_unit(cairn_unit u) { return (cairn_dir)((u + 32768) >> 16); }
/*
 * Exact in the mean over the steps. What is no whole number of units comes out odd: a product with it is then hardly ever a half, and
 * roundings of opposite products cancel.
 */
cairn_dir cairn_dir_in_turn(cairn_unit u, uint32_t step);
/* The angle from a direction, rounded in either way, to the one that was meant. */
cairn_lean cairn_dir_lean(cairn_unit x, cairn_unit y, cairn_dir dx, cairn_dir dy);
static inline cairn_motion cairn_motion_lean(cairn_motion x, cairn_lean angle) { return cairn_mul32(x, angle, 27); }
/*
 * What impulses along a rounded direction and across it, given so many times with each product rounded, lack of those along the one
 * meant is added to a velocity. Exact in the mean over the steps.
 */
void cairn_motion_add_lack(cairn_motion *vx, cairn_motion *vy, cairn_motion push, cairn_motion rub, cairn_dir dx, cairn_dir dy, cairn_lean lean,
                           int times, uint32_t step);
static inline cairn_unit cairn_unit_from_dir(cairn_dir d) { return (cairn_unit)((uint32_t)(int32_t)d << 16); }
static inline cairn_real cairn_real_from_unit(cairn_unit u) { return (u + 8192) >> 14; }
static inline cairn_lever cairn_lever_negate(cairn_lever j) { return (cairn_lever)-j; }
static inline cairn_dir cairn_dir_negate(cairn_dir d) { return (cairn_dir)-d; }

/* The part of a motion that a coordinate's own steps can say, the rest being less than one of them. */
static inline cairn_real cairn_real_below_motion(cairn_motion x) { return x >> 12; }
/* A short way on an axis, as a coordinate says it, with the residues of both its ends. */
static inline cairn_motion cairn_motion_between(cairn_real way, cairn_residue from_residue, cairn_residue to_residue)
{
    return (cairn_motion)(((uint32_t)way << 12) + (uint32_t)((int32_t)to_residue - (int32_t)from_residue));
}
/* to - from + origin; it wraps, so that only a result below 8 m means anything. */
static inline cairn_motion cairn_motion_apart(cairn_motion from, cairn_motion to, cairn_motion origin)
{
    return (cairn_motion)((uint32_t)to - (uint32_t)from + (uint32_t)origin);
}

/*
 * What is known of a vector, to say how long it is and where it looks when it has changed by little: its direction, the inverse of its
 * length L, and by how much at most it may change on each axis, 2^(15 + shift) units of Q4.28, which is a 64th to a 32nd of L.
 */
typedef struct cairn_frame {
    cairn_dir x, y;
    uint16_t inverse;    /* of L / 2^(shift - 7), which is in [1/2, 1): Q14 */
    uint8_t shift, rest; /* rest: 19 - shift */
} cairn_frame;
/* A small angle from a frame's direction, rad, Q19; and as it is kept, in 16 bits. */
typedef int32_t cairn_tilt;
typedef int16_t cairn_swing;
/* By how much a vector is longer than another, m, Q3.29. */
typedef int32_t cairn_stretch;
#define CAIRN_STRETCH(x) ((cairn_stretch)CAIRN_ROUND(x, 536870912.0))

/* From the unit vector and the length; false if that is not in [2^-8 m, 16 m). */
bool cairn_frame_set(cairn_frame *frame, cairn_unit x, cairn_unit y, cairn_offset length);
/* Whether a change is as small as the frame wants it. */
static inline bool cairn_frame_holds(const cairn_frame *frame, cairn_motion x, cairn_motion y)
{
    return (((uint32_t)(x >> frame->shift) + 32768u) | ((uint32_t)(y >> frame->shift) + 32768u)) < 65536u;
}
/* Whether one that coordinates say is half as small. */
static inline bool cairn_frame_holds_well(const cairn_frame *frame, cairn_real x, cairn_real y)
{
    return (uint32_t)((x ^ (x >> 31)) | (y ^ (y >> 31))) >> (frame->shift + 2) == 0;
}
/*
 * By how much the vector is longer than the frame's when it has changed by (x, y), for which the frame holds, and its angle. With s
 * along the frame and t across it: s + t^2 / 2L, up to L times an eighth of the angle's fourth power, a part in 10^7 for a 32nd.
 */
static inline cairn_stretch cairn_frame_stretch(const cairn_frame *frame, cairn_motion x, cairn_motion y, cairn_tilt *tilt)
{
    int32_t across = ((y >> frame->shift) * frame->x - (x >> frame->shift) * frame->y) >> 14; /* at most 46341 */
    int32_t angle = (across * frame->inverse) >> 16;
    *tilt = angle;
    return cairn_dot16(x, frame->x, y, frame->y, 13) + ((across * angle) >> frame->rest);
}
/* The direction at a small angle from the frame's; longer than 1 by half the angle's square. */
static inline cairn_dir cairn_frame_x(const cairn_frame *frame, cairn_tilt tilt) { return (cairn_dir)(frame->x - ((tilt * frame->y + 262144) >> 19)); }
static inline cairn_dir cairn_frame_y(const cairn_frame *frame, cairn_tilt tilt) { return (cairn_dir)(frame->y + ((tilt * frame->x + 262144) >> 19)); }
/* The small angle of another direction, of which it is the sine. */
static inline cairn_tilt cairn_frame_tilt(const cairn_frame *frame, cairn_dir x, cairn_dir y)
{
    return cairn_clamp((frame->x * y - frame->y * x) >> 9, INT16_MAX);
}
/* Whether a motion is as long as the length over 64 to 128. */
static inline bool cairn_frame_is_passed(const cairn_frame *frame, cairn_motion x) { return (uint32_t)(x ^ (x >> 31)) >> (frame->shift + 14) != 0; }
/* The whole way, or a quarter of it. */
#define CAIRN_LAG_NONE 0
#define CAIRN_LAG_QUARTER 2
static inline cairn_tilt cairn_tilt_towards(cairn_tilt from, cairn_tilt to, uint8_t lag) { return from + ((to - from) >> lag); }

/* The cosine of the angle between two directions. */
static inline cairn_unit cairn_dir_cosine(cairn_dir ax, cairn_dir ay, cairn_dir bx, cairn_dir by) { return (ax * bx + ay * by) * 4; }
/* By how much a direction turns: the greater change of its components, within a unit of Q14. */
typedef int32_t cairn_turn;
#define CAIRN_TURN(x) ((cairn_turn)CAIRN_ROUND(x, 16384.0))
static inline cairn_turn cairn_dir_turn(cairn_dir ax, cairn_dir ay, cairn_dir bx, cairn_dir by)
{
    int32_t dx = ax - bx, dy = ay - by;
    dx ^= dx >> 31;
    dy ^= dy >> 31;
    return dx > dy ? dx : dy;
}
/* At most a half. */
static inline cairn_unit cairn_unit_from_turn(cairn_turn turn) { return (turn < 8192 ? turn : 8192) << 16; }
static inline cairn_turn cairn_turn_from_unit(cairn_unit u) { return u >> 16; }
/* A quarter of the way. */
static inline cairn_dir cairn_dir_towards(cairn_dir from, cairn_dir to) { return (cairn_dir)((3 * from + to + 2) >> 2); }

/* ---- cairn_motion: the solver's sweeps ---- */

static inline cairn_motion cairn_motion_clamp(cairn_motion x, cairn_motion limit) { return cairn_clamp(x, limit); }
static inline cairn_motion cairn_motion_add(cairn_motion a, cairn_motion b) { return cairn_add_clamped(a, b); }
/* x dx + y dy */
static inline cairn_motion cairn_motion_along(cairn_motion x, cairn_motion y, cairn_dir dx, cairn_dir dy)
{
    return cairn_dot16(x, dx, y, dy, 14);
}
/* Half of that. */
static inline cairn_motion cairn_motion_half_along(cairn_motion x, cairn_motion y, cairn_dir dx, cairn_dir dy)
{
    return cairn_dot16(x, dx, y, dy, 15);
}
static inline cairn_motion cairn_motion_dir(cairn_motion a, cairn_dir d) { return cairn_mul16(a, d, 14); }
static inline cairn_motion cairn_motion_lever(cairn_motion a, cairn_lever j) { return cairn_mul16(a, j, 13); }
/* Half of the two above. */
static inline cairn_motion cairn_motion_half_dir(cairn_motion a, cairn_dir d) { return cairn_mul16(a, d, 15); }
static inline cairn_motion cairn_motion_half_lever(cairn_motion a, cairn_lever j) { return cairn_mul16(a, j, 14); }
/* a j + b k; both levers at most CAIRN_LEVER_SHORT */
#define CAIRN_LEVER_SHORT 16384
static inline cairn_motion cairn_motion_levers(cairn_motion a, cairn_lever j, cairn_motion b, cairn_lever k) { return cairn_dot16(a, j, b, k, 13); }
/* The same on top of u. */
static inline cairn_motion cairn_motion_add_levers(cairn_motion u, cairn_motion a, cairn_lever j, cairn_motion b, cairn_lever k)
{
    return u + cairn_dot16(a, j, b, k, 13);
}
static inline bool cairn_lever_is_short(cairn_lever j) { return (uint32_t)j + CAIRN_LEVER_SHORT <= 2u * CAIRN_LEVER_SHORT; }
static inline bool cairn_motion_is_within(cairn_motion x, cairn_motion limit) { return (uint32_t)x + (uint32_t)limit <= 2u * (uint32_t)limit; }
/* The size of several motions at once: as great as the greatest, less than twice as great, and perhaps one unit short. */
typedef uint32_t cairn_size;
static inline cairn_size cairn_size_of(cairn_motion x) { return (uint32_t)(x ^ (x >> 31)); }
static inline cairn_size cairn_size_with(cairn_size size, cairn_motion x) { return size | cairn_size_of(x); }
static inline bool cairn_size_is_below(cairn_size size, cairn_motion limit) { return size < (uint32_t)limit; }
static inline bool cairn_size_is_far_below(cairn_size size, cairn_motion limit) { return size < (uint32_t)limit >> 5; } /* a 32nd */
/*
 * Are motions within a limit for sure, by the sum of their squares' upper words? For cores with one instruction for each; where it says no, sizes
 * have to tell.
 */
#ifdef CAIRN_PORT_ADD_SQUARE
#define CAIRN_KNOWS_SQUARES 1
#else
#define CAIRN_KNOWS_SQUARES 0
#define CAIRN_PORT_ADD_SQUARE(sum, x) ((sum) + (uint32_t)((int64_t)(x) * (x) >> 32))
#endif
static inline cairn_size cairn_squares_with(cairn_size sum, cairn_motion x) { return CAIRN_PORT_ADD_SQUARE(sum, x); }
static inline bool cairn_squares_are_below(cairn_size sum, cairn_motion limit) { return sum < (uint32_t)((int64_t)limit * limit >> 32); }
/* Do all of them lie in [-limit, limit), a constant power of two? */
CAIRN_SHARED bool cairn_motions_are_within(cairn_motion x, cairn_motion y, cairn_motion w, cairn_motion limit)
{
    if (CAIRN_KNOWS_SQUARES && cairn_squares_are_below(cairn_squares_with(cairn_squares_with(cairn_squares_with(0, x), y), w), limit)) { return true; }
    uint32_t bits = ((uint32_t)x + (uint32_t)limit) | ((uint32_t)y + (uint32_t)limit) | ((uint32_t)w + (uint32_t)limit);
    return bits < 2u * (uint32_t)limit;
}
/* x into [0, limit] */
CAIRN_SHARED cairn_motion cairn_motion_above_zero(cairn_motion x, cairn_motion limit)
{
    if (CAIRN_SMALL) { return cairn_clamp(x < 0 ? 0 : x, limit); }
    if ((uint32_t)x > (uint32_t)CAIRN_PORT_SHORT(limit)) { return x < 0 ? 0 : x < limit ? x : limit; }
    return x;
}
static inline cairn_motion cairn_motion_ratio(cairn_motion a, cairn_ratio r) { return cairn_mul16(a, r, 14); }
static inline cairn_motion cairn_motion_share(cairn_motion a, cairn_share s)
{
    return !CAIRN_SMALL && s == CAIRN_SHARE(0.5) ? (a >> 1) + (a & 1) : cairn_mul32(a, s, 30); /* equal masses are the common case */
}
/* Parts of a change before they are rounded, Q3.29; of changes below 4. */
typedef int32_t cairn_fine;
static inline cairn_fine cairn_fine_of(cairn_motion a) { return a * 2; }
static inline cairn_motion cairn_motion_from_fine(cairn_fine a) { return a >> 1; }
/* Saturates. */
static inline cairn_fine cairn_fine_add(cairn_fine a, cairn_fine b) { return cairn_add_clamped(a, b); }
static inline cairn_fine cairn_fine_half(cairn_motion a) { return a; } /* of a motion */
static inline cairn_fine cairn_fine_share(cairn_motion a, cairn_share s)
{
    if (CAIRN_PORT_ASKS && s == 0) { return 0; }
    return CAIRN_PORT_ASKS && s == CAIRN_SHARE(0.5) ? a : cairn_mul32(a, s, 29);
}
static inline cairn_motion cairn_fine_dir(cairn_fine a, cairn_dir d) { return cairn_mul16(a, d, 15); }
static inline cairn_motion cairn_fine_lever(cairn_fine a, cairn_lever j) { return cairn_mul16(a, j, 14); }
static inline cairn_motion cairn_fine_along(cairn_fine x, cairn_fine y, cairn_dir dx, cairn_dir dy) { return cairn_dot16(x, dx, y, dy, 15); }
/*
 * The same of motions below CAIRN_QUIET in size, to the same bits, on top of a sum or taken from it: the products fit into 32 bits. They are for
 * cores on which that is quicker.
 */
#if defined(__OPTIMIZE_SIZE__)
#define CAIRN_KNOWS_QUIET 0
#else
#define CAIRN_KNOWS_QUIET CAIRN_PORT_ASKS
#endif
#define CAIRN_QUIET (1 << 15)
/* Is it below 2^15, 2^17, 2^22 units (1/64 m)? Without a constant that Thumb must load. */
static inline bool cairn_motion_is_quiet(cairn_motion x) { return x == (int16_t)x; }
static inline bool cairn_motion_is_fairly_quiet(cairn_motion x) { return x == (int32_t)((uint32_t)x << 14) >> 14; }
static inline bool cairn_motion_is_calm(cairn_motion x) { return x == (int32_t)((uint32_t)x << 9) >> 9; }
static inline cairn_motion cairn_quiet_add_along(cairn_motion sum, cairn_motion x, cairn_motion y, cairn_dir dx, cairn_dir dy)
{
    return cairn_add_rounded(sum, x * dx + y * dy, 14);
}
static inline cairn_motion cairn_quiet_add_levers(cairn_motion sum, cairn_motion a, cairn_lever j, cairn_motion b, cairn_lever k)
{
    return cairn_add_rounded(sum, a * j + b * k, 13);
}
/* r at most 1: this one up to four times CAIRN_QUIET */
static inline cairn_motion cairn_quiet_less_ratio(cairn_motion sum, cairn_motion a, cairn_ratio r) { return cairn_less_rounded(sum, a * r, 14); }
static inline cairn_fine cairn_quiet_share(cairn_motion a, cairn_share s) { return cairn_add_rounded(0, a * (s >> 15) + ((a * (s & 32767)) >> 15), 14); }
static inline cairn_motion cairn_quiet_half_dir(cairn_motion a, cairn_dir d) { return cairn_add_rounded(0, a * d, 15); }
static inline cairn_motion cairn_quiet_half_lever(cairn_motion a, cairn_lever j) { return cairn_add_rounded(0, a * j, 14); }
static inline cairn_motion cairn_quiet_half_along(cairn_motion x, cairn_motion y, cairn_dir dx, cairn_dir dy) { return cairn_add_rounded(0, x * dx + y * dy, 15); }
static inline cairn_motion cairn_quiet_add_fine_dir(cairn_motion sum, cairn_fine a, cairn_dir d) { return cairn_add_rounded(sum, a * d, 15); }
static inline cairn_motion cairn_quiet_less_fine_dir(cairn_motion sum, cairn_fine a, cairn_dir d) { return cairn_less_rounded(sum, a * d, 15); }
static inline cairn_motion cairn_quiet_add_fine_lever(cairn_motion sum, cairn_fine a, cairn_lever j) { return cairn_add_rounded(sum, a * j, 14); }
static inline cairn_motion cairn_quiet_add_fine_along(cairn_motion sum, cairn_fine x, cairn_fine y, cairn_dir dx, cairn_dir dy)
{
    return cairn_add_rounded(sum, x * dx + y * dy, 15);
}
static inline cairn_motion cairn_quiet_less_fine_along(cairn_motion sum, cairn_fine x, cairn_fine y, cairn_dir dx, cairn_dir dy)
{
    return cairn_less_rounded(sum, x * dx + y * dy, 15);
}
/* The share with what was cut off before added, and what is cut off now kept. */
static inline cairn_motion cairn_motion_share_carried(cairn_motion a, cairn_share s, cairn_carry *carry)
{
    int64_t exact = cairn_times(a, s) + (int64_t)*carry * 32768 + 536870912; /* and a half, for the rounding, which is not carried */
    *carry = (cairn_carry)(((int32_t)((uint32_t)exact & 0x3FFFFFFFu) - 536870912) >> 15);
    return (cairn_motion)(exact >> 30);
}
/* The same where |a| is at most 2^20 units and r at most 1/8: one product. */
static inline cairn_motion cairn_motion_ratio_short(cairn_motion a, cairn_ratio r) { return (a * r + 8192) >> 14; }
/* a f, or less by up to 2^-18 and a 1024th of a: cheap; 0 <= a < 8, 0 <= f <= 1 */
static inline cairn_motion cairn_motion_factor_below(cairn_motion a, cairn_factor f) { return (a >> 10) * (f >> 10); }
/* a times a coefficient; saturates. At most 1 is the common case, and a third of the cost. */
static inline cairn_motion cairn_motion_factor(cairn_motion a, cairn_factor f)
{
    if (!CAIRN_SMALL && (uint32_t)f <= (uint32_t)CAIRN_FACTOR(1)) { return cairn_mul32(a, f, 20); }
    return cairn_mul_clamped(a, f, 20);
}

/* x as a share of a whole: part / whole in [0, 1]; 0 < whole. */
static inline cairn_unit cairn_motion_fraction(cairn_motion part, cairn_motion whole)
{
    return cairn_offset_fraction(part < 0 ? 0 : part > whole ? whole : part, whole);
}
static inline cairn_motion cairn_motion_unit(cairn_motion x, cairn_unit u) { return cairn_mul32(x, u, 30); }
/* The speed after a way s under the acceleration g: sqrt(u^2 + 2 g s) to the nearest, 0 where that is negative; saturates. */
cairn_motion cairn_motion_closing(cairn_motion u, cairn_motion g, cairn_motion s);
/* x / f, within 2^-31 of it and half a unit; saturates, f > 0 */
cairn_motion cairn_motion_divide(cairn_motion x, cairn_factor f);
static inline cairn_motion cairn_motion_scale(cairn_motion x, cairn_wide k) { return cairn_wide_scale(x, k, 0); }

/* A coefficient in [0, 1) of which 15 bits count, however small it is. */
typedef struct cairn_gain {
    uint16_t mantissa, shift;
} cairn_gain;
cairn_gain cairn_gain_from_wide(cairn_wide k);
cairn_gain cairn_gain_from_share(cairn_share s);
/* Half a coefficient times one of 1 to 2. */
static inline cairn_gain cairn_gain_times_half(cairn_gain k, cairn_factor f)
{
    uint32_t product = k.mantissa * ((uint32_t)f >> 6); /* below 2^30 */
    uint32_t doubled = product >> 29 == 0 && k.shift < 30;
    k.mantissa = (uint16_t)(product >> (15 - doubled));
    k.shift = (uint16_t)(k.shift + doubled);
    return k;
}
static inline cairn_gain cairn_gain_zero(void)
{
    cairn_gain k;
    k.mantissa = k.shift = 0;
    return k;
}
static inline bool cairn_gain_is_zero(cairn_gain k) { return k.mantissa == 0; }
/* x times the gain, rounded down, within two units and 2^-14 of it. */
static inline cairn_motion cairn_motion_gain(cairn_stretch x, cairn_gain k) { return cairn_mul16_down(x, k.mantissa) >> k.shift; }
/* x dx + y dy below 4 m as a stretch, a stretch as a motion, and an offset as a stretch, saturating. */
static inline cairn_stretch cairn_stretch_along(cairn_motion x, cairn_motion y, cairn_dir dx, cairn_dir dy) { return cairn_dot16(x, dx, y, dy, 13); }
static inline cairn_motion cairn_motion_from_stretch(cairn_stretch x) { return x >> 1; }
static inline cairn_stretch cairn_stretch_from_offset(cairn_offset x) { return (cairn_stretch)((uint32_t)cairn_clamp(x, 16777215) << 7); }
static inline cairn_stretch cairn_stretch_clamp(cairn_stretch x, cairn_stretch limit) { return cairn_clamp(x, limit); }
/* A coefficient of at most 1 in size, Q0.15: what is as great lacks its last bit. */
typedef int16_t cairn_part;
static inline cairn_part cairn_part_from_factor(cairn_factor f) { return (cairn_part)cairn_clamp((f + 16) >> 5, INT16_MAX); }
/* |x| < 4 m; rounded down. */
static inline cairn_motion cairn_motion_part(cairn_motion x, cairn_part f) { return cairn_mul16_down(2 * x, f); }
/* A 64th of a length. */
static inline cairn_motion cairn_motion_64th(cairn_offset x) { return x; }

/* x * k */
static inline cairn_motion cairn_motion_from_offset_wide(cairn_offset x, cairn_wide k) { return cairn_wide_scale(x, k, 6); }
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_from_factor(cairn_factor x) { return cairn_wide_of(x, -20); }
static inline cairn_ratio cairn_ratio_from_wide(cairn_wide k) { return (cairn_ratio)cairn_clamp(cairn_wide_scale(1, k, 14), INT16_MAX); }
/* An angle times a fraction in [0, 1]. */
static inline cairn_angle cairn_angle_part(cairn_angle a, cairn_unit part) { return cairn_mul32(a, part, 30); }
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_from_share(cairn_share x) { return cairn_wide_of(x, -30); }
/* x / 2^n, 0 <= n <= 30 */
static inline cairn_share cairn_share_shift(cairn_share x, int n) { return n > 0 ? (x + (1 << (n - 1))) >> n : x; }
static inline cairn_share cairn_share_mul(cairn_share a, cairn_share b) { return cairn_mul32(a, b, 30); }

/* ---- sums of products of shares, of which one is at most 1 and the others' squares sum up to about 1: Q4.60 ---- */

typedef int64_t cairn_sum;
static inline cairn_sum cairn_sum_of(cairn_share a) { return (int64_t)a * ((int64_t)1 << 30); }
static inline cairn_sum cairn_sum_less(cairn_sum sum, cairn_share a, cairn_share b) { return sum - cairn_times(a, b); }
CAIRN_SHARED cairn_share cairn_sum_share(cairn_sum sum) { return cairn_clamp64((sum + ((int64_t)1 << 29)) >> 30); }

/* How many bits a motion of this size may be lifted (or, negative, has to be lowered) to have 22 of them. */
static inline int cairn_motion_headroom(cairn_motion most) { return most == 0 ? 0 : cairn_clz((uint32_t)most) - 10; }
#define CAIRN_MOTION_LIFTED (1 << 28)
/* x * 2^n */
static inline cairn_motion cairn_motion_lift(cairn_motion x, int n) { return n >= 0 ? (cairn_motion)((uint32_t)x << n) : x >> -n; }
/* x * k / 2^n */
static inline cairn_motion cairn_motion_lower(cairn_motion x, cairn_wide k, int n) { return cairn_wide_scale(x, k, -n); }

/* A constant change per sub-step that is smaller than its last bit can say: the rest is carried from call to call. */
typedef struct cairn_diffused {
    cairn_motion whole;
    uint32_t fraction, carry;
} cairn_diffused;

/* x * k */
cairn_diffused cairn_diffused_of(cairn_real x, cairn_wide k);
/* The same for a k of 2^-76 to 2^-10 that is a constant, and an x of which is known that it fits. */
static inline cairn_diffused cairn_diffused_of_short(cairn_real x, cairn_wide k)
{
    uint64_t size = cairn_product((uint32_t)(x < 0 ? -x : x), k.mantissa);
    cairn_diffused d;
    size = k.exponent > -45 ? size << (k.exponent + 44) : ((size >> (-45 - k.exponent)) + 1) >> 1;
    size = x < 0 ? 0u - size : size;
    d.whole = (cairn_motion)(uint32_t)(size >> 32);
    d.fraction = (uint32_t)size;
    d.carry = 0;
    return d;
}
static inline cairn_motion cairn_diffuse(cairn_diffused *d)
{
    d->carry += d->fraction;
    return d->whole + (d->carry < d->fraction ? 1 : 0);
}

/*
 * ---- cairn_push: the blocks' impulses ----
 * Whatever makes one saturates it to CAIRN_PUSH_MAX, 2^19 m, so that the sum of a block's rows, 2 in size at most
 * after their levers and directions, stays far within 64 bits.
 */

#define CAIRN_PUSH_MAX ((cairn_push)1 << 47)

/* x * f / 2^shift, 1 <= shift <= 31, rounded. The result must fit. */
int64_t cairn_mul64(int64_t x, int32_t f, int shift);
/* x < 2^28 (1 m), which most are: the short way, of the same bits, is open. */
static inline bool cairn_push_is_short(cairn_push x) { return !CAIRN_SMALL && (uint64_t)(x + ((cairn_push)1 << 28)) < (uint64_t)1 << 29; }
CAIRN_SHARED cairn_push cairn_push_clamp(cairn_push x, cairn_push limit) { return x > limit ? limit : x < -limit ? -limit : x; }
static inline cairn_push cairn_push_from_motion(cairn_motion x) { return x; }
static inline cairn_motion cairn_motion_from_push(cairn_push x) { return cairn_clamp64(x); }
static inline cairn_push cairn_push_half(cairn_push x) { return x >> 1; }
cairn_push cairn_push_dir(cairn_push x, cairn_dir d);
cairn_push cairn_push_lever(cairn_push x, cairn_lever j);
cairn_push cairn_push_unit(cairn_push x, cairn_unit u);
static inline cairn_push cairn_push_factor(cairn_push x, cairn_factor f) { return cairn_push_clamp(cairn_mul64(x, f, 20), CAIRN_PUSH_MAX); }
/* x * k */
cairn_push cairn_push_scale(cairn_push x, cairn_wide k);
/* x * 2^n, -30 <= n <= 30 */
cairn_push cairn_push_shift(cairn_push x, int n);
/* The least n, not negative, for which x / 2^n is below 2 m. */
int cairn_push_excess(cairn_push x);

/* ---- matrices of cairn_unit ---- */

/* ((x, y) (x', y') + j j') * k * 2^exponent: what an impulse along one row changes in another one. */
static inline cairn_unit cairn_unit_coupling(cairn_dir x, cairn_dir y, cairn_lever j, cairn_dir x2, cairn_dir y2, cairn_lever j2,
                                             cairn_wide k, int exponent)
{
    int32_t along = (int32_t)x * x2 + (int32_t)y * y2; /* Q28, at most 1 and rounding */
    return cairn_wide_scale((along >> 1) + (int32_t)j * j2 * 2, k, exponent + 3); /* Q27 */
}
/* The most that x > 0, below 1, can be multiplied by 4 and stay below 1. */
static inline int cairn_unit_room(cairn_unit x) { return x < CAIRN_UNIT(0.25) ? (cairn_clz((uint32_t)x) - 2) >> 1 : 0; }
/* x * 2^n; the result must fit */
static inline cairn_unit cairn_unit_grow(cairn_unit x, int n) { return (cairn_unit)((uint32_t)x << n); }
static inline cairn_unit cairn_unit_mul(cairn_unit a, cairn_unit b) { return cairn_mul32(a, b, 30); }
static inline cairn_unit cairn_unit_scale(cairn_unit x, cairn_wide k, int exponent) { return cairn_wide_scale(x, k, exponent); }
CAIRN_ALWAYS_INLINE cairn_wide cairn_wide_from_unit(cairn_unit x) { return cairn_wide_of(x, -30); }

/* ---- coefficients ---- */

static inline cairn_factor cairn_factor_from_real(cairn_real x) { return (cairn_factor)((uint32_t)cairn_clamp(x, 134217727) << 4); }
static inline cairn_factor cairn_factor_from_share(cairn_share s) { return (s + 512) >> 10; }
/* s * j * k: how much one unit of impulse along a row with levers j, k changes the row's velocity through the spin.
   Within 0.55 units. */
static inline cairn_factor cairn_factor_spin(cairn_share s, cairn_lever j, cairn_lever k)
{
    return (cairn_mul16(cairn_mul16(s, j, 16), k, 16) + 8) >> 4; /* Q30 -> Q27 -> Q24 -> Q20 */
}
static inline cairn_factor cairn_factor_from_ratio(cairn_ratio x) { return (int32_t)x << 6; }
/* Of one below 2 in size. */
static inline cairn_ratio cairn_ratio_from_factor(cairn_factor f) { return (cairn_ratio)((f + 32) >> 6); }
/* 1 / f, f > 0, within 0.76 units; saturates */
static inline cairn_factor cairn_factor_reciprocal(cairn_factor f)
{
    return cairn_wide_scale(1, cairn_wide_div(cairn_wide_of(1, 0), cairn_wide_of(f, -20)), 20);
}
static inline cairn_factor cairn_factor_mul(cairn_factor a, cairn_factor b) { return cairn_mul_clamped(a, b, 20); }
/* x x + y y: one, but for rounding */
static inline cairn_factor cairn_factor_square(cairn_dir x, cairn_dir y) { return ((int32_t)x * x + (int32_t)y * y + 128) >> 8; }
/* 1 / f, within 0.9 units of Q1.14; just below 2 from f = 0.5 down. */
cairn_ratio cairn_factor_inverse(cairn_factor f);
/* sqrt(a b), both non-negative, rounded to nearest. */
cairn_real cairn_real_geometric_mean(cairn_real a, cairn_real b);
static inline cairn_factor cairn_factor_geometric_mean(cairn_factor a, cairn_factor b) { return cairn_real_geometric_mean(a, b); }

#ifdef __cplusplus
}
#endif

#endif
