/*
 * The primitives of arith_fixed.h for Cortex-M3 and up (ARMv7-M, v7E-M, v8-M Mainline): SMULL and SMLAL give the whole
 * product, and a right shift leaves the last bit that fell out in the carry, so one ADC joins the two words and rounds.
 * The DSP extension's SMULWB and SMMUL drop bits below their 16 or 32: they give the right bits for no 14-bit
 * shift; SMULWB does where 16 are to be dropped, SMMULR for a shift of 32, and are used where there are.
 * Where the compiler does not make Thumb-2 code the same steps are plain C, so that the host's tests cover them.
 */
#ifndef CAIRN_ARITH_ARMV7M_H
#define CAIRN_ARITH_ARMV7M_H

#include <stdint.h>

#define CAIRN_PORT_MUL16(a, b, shift) cairn_armv7m_mul32(a, b, shift)
#define CAIRN_PORT_MUL16_DOWN(a, b) cairn_armv7m_mul16_down(a, b)
#define CAIRN_PORT_MUL32(a, b, shift) cairn_armv7m_mul32(a, b, shift)
#define CAIRN_PORT_DOT16(a, b, c, d, shift) cairn_armv7m_dot32(a, b, c, d, shift)
#define CAIRN_PORT_DOT32(a, b, c, d, shift) cairn_armv7m_dot32(a, b, c, d, shift)
#define CAIRN_PORT_CLZ(x) cairn_armv7m_clz(x)
#define CAIRN_PORT_ADD(a, b, sum) __builtin_add_overflow(a, b, sum)
#define CAIRN_PORT_ASKS 0
#define CAIRN_PORT_KEPT(x) cairn_armv7m_kept(x)
#define CAIRN_PORT_FORGET() CAIRN_ARMV7M_FORGET()
#define CAIRN_PORT_SHORT(x) ((x) & 0x7F000000)
#if defined(__ARM_FEATURE_DSP) || !defined(__thumb2__)
#define CAIRN_PORT_ADD_SQUARE(sum, x) cairn_armv7m_add_square(sum, x)
#endif

/* x / 2^shift, halves upwards */
static inline int32_t cairn_armv7m_narrow(int64_t x, int shift)
{
    uint32_t low = (uint32_t)x, high = (uint32_t)((uint64_t)x >> 32);
    if (shift == 32) { return (int32_t)(high + (low >> 31)); }
#if defined(__GNUC__) && defined(__thumb2__)
    if (__builtin_constant_p(shift)) {
        /* C has no way to the carry */
        __asm__("lsrs %1, %1, %2\n\tadc %0, %1, %0, lsl %3" : "+r"(high), "+r"(low) : "M"(shift), "M"(32 - shift) : "cc");
        return (int32_t)high;
    }
#endif
    return (int32_t)((high << (32 - shift)) + (low >> shift) + (low >> (shift - 1) & 1u));
}

static inline int32_t cairn_armv7m_kept(int32_t x)
{
#if defined(__GNUC__) && defined(__thumb2__)
    __asm__("" : "+r"(x));
#endif
    return x;
}

/* As one piece: from C gcc makes 64-bit values of operands that it uses twice, with their sign words. */
#if defined(__GNUC__) && defined(__thumb2__)
#define CAIRN_ARMV7M_ASM 1
#define CAIRN_ARMV7M_FORGET() __asm__ volatile("" : : : "memory")
#else
#define CAIRN_ARMV7M_FORGET() ((void)0)
#endif

static inline int32_t cairn_armv7m_mul32(int32_t a, int32_t b, int shift)
{
#ifdef CAIRN_ARMV7M_ASM
    if (__builtin_constant_p(shift) && !(__builtin_constant_p(a) && __builtin_constant_p(b))) {
        int32_t r, low;
#ifdef __ARM_FEATURE_DSP
        if (shift == 32) {
            __asm__("smmulr %0, %1, %2" : "=r"(r) : "r"(a), "r"(b));
            return r;
        }
#endif
        if (shift < 32) {
            __asm__("smull %1, %0, %2, %3\n\tlsrs %1, %1, %4\n\tadc %0, %1, %0, lsl %5"
                    : "=r"(r), "=r"(low) : "r"(a), "r"(b), "M"(shift), "M"(32 - shift) : "cc");
            return r;
        }
    }
#endif
    return cairn_armv7m_narrow((int64_t)a * b, shift);
}

static inline int32_t cairn_armv7m_mul16_down(int32_t a, int32_t b)
{
#if defined(CAIRN_ARMV7M_ASM) && defined(__ARM_FEATURE_DSP)
    int32_t r;
    __asm__("smulwb %0, %1, %2" : "=r"(r) : "r"(a), "r"(b));
    return r;
#else
    return (int32_t)(((int64_t)a * b) >> 16);
#endif
}

static inline int32_t cairn_armv7m_dot32(int32_t a, int32_t b, int32_t c, int32_t d, int shift)
{
#ifdef CAIRN_ARMV7M_ASM
    if (__builtin_constant_p(shift) && shift < 32) {
        int32_t r, low;
        __asm__("smull %1, %0, %2, %3\n\tsmlal %1, %0, %4, %5\n\tlsrs %1, %1, %6\n\tadc %0, %1, %0, lsl %7"
                : "=&r"(r), "=&r"(low) : "r"(a), "r"(b), "r"(c), "r"(d), "M"(shift), "M"(32 - shift) : "cc");
        return r;
    }
#endif
    return cairn_armv7m_narrow((int64_t)a * b + (int64_t)c * d, shift);
}

/* sum + x x / 2^32, without the rest */
static inline uint32_t cairn_armv7m_add_square(uint32_t sum, int32_t x)
{
#if defined(CAIRN_ARMV7M_ASM) && defined(__ARM_FEATURE_DSP)
    uint32_t r;
    if (__builtin_constant_p(sum) && sum == 0) {
        __asm__("smmul %0, %1, %1" : "=r"(r) : "r"(x));
    } else {
        __asm__("smmla %0, %1, %1, %2" : "=r"(r) : "r"(x), "r"(sum));
    }
    return r;
#else
    return sum + (uint32_t)((int64_t)x * x >> 32);
#endif
}

static inline int cairn_armv7m_clz(uint32_t x)
{
    return x != 0 ? __builtin_clz(x) : 32; /* CLZ gives the 32 by itself, and the compilers know it */
}

#endif
