/* Random numbers of a game: xorshift32 (Marsaglia, 2003). The same seed gives the same game. */
#ifndef RANDOM_H
#define RANDOM_H

#include <stdint.h>

typedef struct random_source {
    uint32_t state; /* never 0 */
} random_source;

static inline random_source random_from(uint32_t seed)
{
    random_source r;
    r.state = seed * 2654435761u ^ 0x9E3779B9u;
    if (r.state == 0)
        r.state = 1;
    return r;
}

static inline uint32_t random_next(random_source *r)
{
    r->state ^= r->state << 13;
    r->state ^= r->state >> 17;
    r->state ^= r->state << 5;
    return r->state;
}

/* low to high, both included; high - low below 2^16. */
static inline int32_t random_between(random_source *r, int32_t low, int32_t high)
{
    return low + (int32_t)((random_next(r) >> 16) * (uint32_t)(high - low + 1) >> 16);
}

#endif
