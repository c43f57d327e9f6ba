/* Arguments for the tests of arithmetic: seeded, of every size, with the edges of the range well represented. */
#ifndef CAIRN_TEST_ARITH_RANDOM_H
#define CAIRN_TEST_ARITH_RANDOM_H

#include <stdint.h>

/* Marsaglia's xorshift with 64 bits of state; the low bits are the weaker ones and are not used. */
typedef struct arith_random {
    uint64_t state;
} arith_random;

static inline arith_random arith_random_seeded(uint32_t seed)
{
    arith_random r = { 88172645463325252u ^ ((uint64_t)seed << 20) };
    return r;
}

static inline uint32_t arith_random_bits(arith_random *r)
{
    r->state ^= r->state << 13;
    r->state ^= r->state >> 7;
    r->state ^= r->state << 17;
    return (uint32_t)(r->state >> 32);
}

/* Of every magnitude alike: a random word shifted down by a random number of bits. */
static inline int32_t arith_random_sized(arith_random *r)
{
    uint32_t word = arith_random_bits(r);
    uint32_t shift = arith_random_bits(r) >> 27;
    int32_t size = (int32_t)((word & 0x7FFFFFFFu) >> shift);
    return (word >> 31) != 0 ? -size : size;
}

enum { ARITH_EDGES = 29 };

/* Ends of ranges, powers of two and their neighbours; never INT32_MIN, which no operation gives. */
static inline int32_t arith_edge(uint32_t i)
{
    static const int32_t edges[ARITH_EDGES] = {
        0, 1, -1, 2, -2, 3, -3, 32767, -32767, 32768, -32768, 65535, -65535, 65536, -65536, 65537, -65537,
        1 << 20, 1 << 22, 1 << 28, -(1 << 28), (1 << 30) - 1, 1 << 30, -(1 << 30), (1 << 30) + 1,
        INT32_MAX - 1, INT32_MAX, -INT32_MAX + 1, -INT32_MAX,
    };
    return edges[i % ARITH_EDGES];
}

/* One in eight is an edge. */
static inline int32_t arith_random_argument(arith_random *r)
{
    uint32_t choice = arith_random_bits(r);
    return choice >> 29 == 0 ? arith_edge(choice & 0xFFFFu) : arith_random_sized(r);
}

#endif
