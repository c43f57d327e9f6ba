/* The engine's numbers as doubles, and seeded random numbers, for tests in either arithmetic. */
#ifndef CAIRN_TEST_NUMBER_H
#define CAIRN_TEST_NUMBER_H

#include <cairn/arith.h>

#ifdef CAIRN_DOUBLE

static inline double number_of_real(cairn_real x) { return x; }
static inline double number_of_offset(cairn_offset x) { return x; }
static inline double number_of_unit(cairn_unit x) { return x; }
static inline double number_of_wide(cairn_wide k) { return k; }
/* n * 2^-16 */
static inline cairn_real real_of_steps(int32_t n) { return n / 65536.0; }

#else

static inline double number_of_real(cairn_real x) { return x / 65536.0; }
static inline double number_of_offset(cairn_offset x) { return x / 4194304.0; }
static inline double number_of_unit(cairn_unit x) { return x / 1073741824.0; }
static inline double number_of_wide(cairn_wide k)
{
    double x = k.mantissa;
    for (int e = k.exponent; e < 0; e++) {
        x /= 2;
    }
    for (int e = k.exponent; e > 0; e--) {
        x *= 2;
    }
    return x;
}
static inline cairn_real real_of_steps(int32_t n) { return n; }

#endif

/* xorshift32: the same sequence everywhere; the state is never 0. */
static inline uint32_t random_next(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

/* From low to high, both included. */
static inline int32_t random_between(uint32_t *state, int32_t low, int32_t high)
{
    return low + (int32_t)((random_next(state) >> 4) % (uint32_t)(high - low + 1));
}

/* A real from low to high, in steps of 2^-16. */
static inline cairn_real random_real(uint32_t *state, double low, double high)
{
    return real_of_steps(random_between(state, (int32_t)(low * 65536), (int32_t)(high * 65536)));
}

#endif
