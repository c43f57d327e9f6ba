/*
 * The primitives of arith_fixed.h for Cortex-M0, M0+, M1 and M23, whose only multiply gives the low 32 bits:
 * products by halves of 16 bits. A right shift leaves the last bit that fell out in the carry, so one ADCS rounds.
 * Where the compiler does not make Thumb-1 code the same steps are plain C, so that the host's tests cover them.
 */
#ifndef CAIRN_ARITH_ARMV6M_H
#define CAIRN_ARITH_ARMV6M_H

#include <stdint.h>

#define CAIRN_PORT_MUL16(a, b, shift) cairn_armv6m_mul16(a, b, shift)
#define CAIRN_PORT_MUL16_DOWN(a, b) cairn_armv6m_mul16_down(a, b)
#define CAIRN_PORT_MUL32(a, b, shift) cairn_armv6m_mul32(a, b, shift)
#define CAIRN_PORT_DOT16(a, b, c, d, shift) cairn_armv6m_dot16(a, b, c, d, shift)
#define CAIRN_PORT_DOT32(a, b, c, d, shift) cairn_armv6m_dot32(a, b, c, d, shift)
#define CAIRN_PORT_PRODUCT(a, b) cairn_armv6m_product(a, b)
#define CAIRN_PORT_TIMES(a, b) cairn_armv6m_times(a, b)
#define CAIRN_PORT_FORGET() CAIRN_ARMV6M_FORGET()
#define CAIRN_PORT_KEPT(x) cairn_armv6m_kept(x)
#define CAIRN_PORT_ADD_ROUNDED(sum, x, shift) cairn_armv6m_round((uint32_t)(sum), x, shift)

#if defined(__GNUC__) && defined(__thumb__) && !defined(__thumb2__)
#define CAIRN_ARMV6M_ASM 1
#endif

#ifdef CAIRN_ARMV6M_ASM
#define CAIRN_ARMV6M_FORGET() __asm__ volatile("" : : : "memory")
/* Also at -Os: a call would cost more than the shorter ones themselves. */
#define CAIRN_ARMV6M_INLINE static inline __attribute__((always_inline))

/* The low 16 bits. gcc shifts twice where one UXTH will do. */
CAIRN_ARMV6M_INLINE int32_t cairn_armv6m_low(int32_t x)
{
    int32_t low;
    if (__builtin_constant_p(x)) { return (uint16_t)x; }
    __asm__("uxth %0, %1" : "=l"(low) : "l"(x));
    return low;
}

CAIRN_ARMV6M_INLINE int32_t cairn_armv6m_kept(int32_t x)
{
    __asm__("" : "+l"(x));
    return x;
}

/* high + low / 2^shift, halves upwards; 1 <= shift <= 16 */
CAIRN_ARMV6M_INLINE int32_t cairn_armv6m_round(uint32_t high, int32_t low, int shift)
{
    __asm__(".syntax unified\n\tasrs %1, %1, %2\n\tadcs %0, %0, %1" : "+l"(high), "+l"(low) : "lN"(shift) : "cc");
    return (int32_t)high;
}

static inline uint64_t cairn_armv6m_product(uint32_t a, uint32_t b)
{
    uint32_t al, bl, cross;
    __asm__(".syntax unified\n\t"
            "uxth %2, %0\n\tlsrs %0, %0, #16\n\tuxth %3, %1\n\tlsrs %1, %1, #16\n\t"
            "movs %4, %2\n\tmuls %4, %1, %4\n\tmuls %1, %0, %1\n\tmuls %0, %3, %0\n\tmuls %2, %3, %2\n\t"
            "movs %3, #0\n\tadds %0, %0, %4\n\tadcs %3, %3, %3\n\tlsls %3, %3, #16\n\tadds %1, %1, %3\n\t"
            "lsls %3, %0, #16\n\tlsrs %0, %0, #16\n\tadds %2, %2, %3\n\tadcs %1, %1, %0"
            : "+l"(a), "+l"(b), "=&l"(al), "=&l"(bl), "=&l"(cross) : : "cc");
    return (uint64_t)b << 32 | al;
}

static inline int64_t cairn_armv6m_times(int32_t a, int32_t b)
{
    uint32_t al, bl, cross;
    __asm__(".syntax unified\n\t"
            "uxth %2, %0\n\tasrs %0, %0, #16\n\tuxth %3, %1\n\tasrs %1, %1, #16\n\t"
            "movs %4, %2\n\tmuls %4, %1, %4\n\tmuls %1, %0, %1\n\tmuls %0, %3, %0\n\tmuls %2, %3, %2\n\t"
            "lsls %3, %0, #16\n\tasrs %0, %0, #16\n\tadds %2, %2, %3\n\tadcs %1, %1, %0\n\t"
            "lsls %3, %4, #16\n\tasrs %4, %4, #16\n\tadds %2, %2, %3\n\tadcs %1, %1, %4"
            : "+l"(a), "+l"(b), "=&l"(al), "=&l"(bl), "=&l"(cross) : : "cc");
    return (int64_t)((uint64_t)(uint32_t)b << 32 | al);
}

/* x / 2^shift, halves upwards; 1 <= shift <= 32 */
static inline int32_t cairn_armv6m_narrow(int64_t x, int shift)
{
    uint32_t low = (uint32_t)x, high = (uint32_t)((uint64_t)x >> 32);
    if (shift == 32) { return (int32_t)(high + (low >> 31)); }
    high <<= 32 - shift;
    __asm__(".syntax unified\n\tlsrs %1, %1, %2\n\tadcs %0, %0, %1" : "+l"(high), "+l"(low) : "lN"(shift) : "cc");
    return (int32_t)high;
}

/* a b + c d in two words, then over 2^shift. Products one by one take half the bytes, but a fifth more instructions. */
static inline int32_t cairn_armv6m_dot32(int32_t a, int32_t b, int32_t c, int32_t d, int shift)
{
    if (CAIRN_SMALL) { return cairn_armv6m_narrow(cairn_armv6m_times(a, b) + cairn_armv6m_times(c, d), shift); }
    uint32_t low, high, dl, cross;
    __asm__(".syntax unified\n\t"
            "uxth %2, %0\n\tasrs %0, %0, #16\n\tuxth %3, %1\n\tasrs %1, %1, #16\n\t"
            "movs %4, %2\n\tmuls %4, %1, %4\n\tmuls %1, %0, %1\n\tmuls %0, %3, %0\n\tmuls %2, %3, %2\n\t"
            "lsls %3, %0, #16\n\tasrs %0, %0, #16\n\tadds %2, %2, %3\n\tadcs %1, %1, %0\n\t"
            "lsls %3, %4, #16\n\tasrs %4, %4, #16\n\tadds %2, %2, %3\n\tadcs %1, %1, %4"
            : "+l"(a), "+l"(b), "=&l"(low), "=&l"(dl), "=&l"(cross) : : "cc");
    high = (uint32_t)b;
    {
        uint32_t cl;
        __asm__(".syntax unified\n\t"
                "uxth %4, %0\n\tasrs %0, %0, #16\n\tuxth %5, %1\n\tasrs %1, %1, #16\n\t"
                "movs %6, %4\n\tmuls %6, %1, %6\n\tmuls %1, %0, %1\n\tmuls %0, %5, %0\n\tmuls %4, %5, %4\n\t"
                "adds %2, %2, %4\n\tadcs %3, %3, %1\n\t"
                "lsls %4, %0, #16\n\tasrs %0, %0, #16\n\tadds %2, %2, %4\n\tadcs %3, %3, %0\n\t"
                "lsls %4, %6, #16\n\tasrs %6, %6, #16\n\tadds %2, %2, %4\n\tadcs %3, %3, %6"
                : "+l"(c), "+l"(d), "+l"(low), "+l"(high), "=&l"(cl), "=&l"(dl), "=&l"(cross) : : "cc");
    }
    return cairn_armv6m_narrow((int64_t)((uint64_t)high << 32 | low), shift);
}

#else
#define CAIRN_ARMV6M_INLINE static inline
#define CAIRN_ARMV6M_FORGET() ((void)0)

CAIRN_ARMV6M_INLINE int32_t cairn_armv6m_low(int32_t x) { return (uint16_t)x; }
CAIRN_ARMV6M_INLINE int32_t cairn_armv6m_kept(int32_t x) { return x; }

CAIRN_ARMV6M_INLINE int32_t cairn_armv6m_round(uint32_t high, int32_t low, int shift)
{
    return (int32_t)(high + (uint32_t)(low >> shift) + ((uint32_t)low >> (shift - 1) & 1u));
}

static inline uint64_t cairn_armv6m_product(uint32_t a, uint32_t b)
{
    uint32_t al = (uint16_t)a, bl = (uint16_t)b, ah = a >> 16, bh = b >> 16;
    uint32_t low = al * bl;
    uint32_t inner = ah * bl + (low >> 16); /* neither sum overflows: (2^16 - 1)^2 + 2^16 - 1 < 2^32 */
    uint32_t outer = al * bh + (uint16_t)inner;
    uint32_t high = ah * bh + (inner >> 16) + (outer >> 16);
    return (uint64_t)high << 32 | outer << 16 | (uint16_t)low;
}

static inline int64_t cairn_armv6m_times(int32_t a, int32_t b) { return (int64_t)a * b; }

static inline int32_t cairn_armv6m_narrow(int64_t x, int shift) { return (int32_t)((x + ((int64_t)1 << (shift - 1))) >> shift); }

static inline int32_t cairn_armv6m_dot32(int32_t a, int32_t b, int32_t c, int32_t d, int shift)
{
    return cairn_armv6m_narrow(cairn_armv6m_times(a, b) + cairn_armv6m_times(c, d), shift);
}
#endif

/* The low half of a times b, and its sum with a half, fit in 31 bits. */
CAIRN_ARMV6M_INLINE int32_t cairn_armv6m_mul16(int32_t a, int32_t b, int shift)
{
    uint32_t high = (uint32_t)((a >> 16) * b) << (16 - shift);
    return cairn_armv6m_round(high, cairn_armv6m_low(a) * b, shift);
}

/* The low half of a times b fits in 31 bits. */
CAIRN_ARMV6M_INLINE int32_t cairn_armv6m_mul16_down(int32_t a, int32_t b) { return (a >> 16) * b + ((cairn_armv6m_low(a) * b) >> 16); }

/* b and d are at most 2^14 in size, so the sum of the low products still fits. */
CAIRN_ARMV6M_INLINE int32_t cairn_armv6m_dot16(int32_t a, int32_t b, int32_t c, int32_t d, int shift)
{
    uint32_t high = (uint32_t)((a >> 16) * b + (c >> 16) * d) << (16 - shift);
    return cairn_armv6m_round(high, cairn_armv6m_low(a) * b + cairn_armv6m_low(c) * d, shift);
}

static inline int32_t cairn_armv6m_mul32(int32_t a, int32_t b, int shift)
{
    if (CAIRN_SMALL) { return cairn_armv6m_narrow(cairn_armv6m_times(a, b), shift); }
    /* high 2^32 + outer 2^16 + the low half of low; inner and outer are at most 2^15 (2^16 - 1) in size */
    uint32_t low = (uint32_t)cairn_armv6m_low(a) * (uint32_t)cairn_armv6m_low(b);
    int32_t inner = (a >> 16) * cairn_armv6m_low(b) + (int32_t)(low >> 16);
    int32_t outer = cairn_armv6m_low(a) * (b >> 16) + cairn_armv6m_low(inner);
    uint32_t high = (uint32_t)((a >> 16) * (b >> 16) + (inner >> 16));

    if (shift > 16) { return cairn_armv6m_round(shift < 32 ? high << (32 - shift) : high, outer, shift - 16); }
    low &= 0xFFFFu;
    return (int32_t)((high << 16 << (16 - shift)) + ((uint32_t)outer << (16 - shift)) + (low >> shift) + (low >> (shift - 1) & 1u));
}

#endif
