/*
 * Which springs end at a body: lists by the lowest bits of the body's number, in the order of the pool. Made anew when springs change, so
 * that whatever asks for neighbours takes a time that grows with the springs and not with their square; a body needs no memory for it.
 */
#include "spring_solve.h"

/* One less than the number of buckets, the greatest power of two that is not above that of the springs. */
static unsigned mask_of(const cairn_spring_pool *pool)
{
    unsigned mask = 0;
    while (2 * mask + 2 <= pool->end) {
        mask = 2 * mask + 1;
    }
    return mask;
}

/* Into the lists of both ends; once, if they are the same. */
static void insert(cairn_spring_pool *pool, uint16_t i)
{
    cairn_spring *springs = pool->springs, *spring = &springs[i];
    uint16_t *at_a = &springs[spring->a & pool->mask].bucket, *at_b = &springs[spring->b & pool->mask].bucket;
    spring->link_a = *at_a;
    spring->link_b = *at_b;
    *at_a = i;
    *at_b = i;
}

void cairn_spring_find_ends(cairn_spring_pool *pool)
{
    pool->mask = (uint16_t)mask_of(pool);
    for (uint16_t i = 0; i < pool->end; i++) {
        pool->springs[i].bucket = CAIRN_NONE;
    }
    for (uint16_t i = pool->end; i > 0; i--) {
        if (cairn_spring_is_used(&pool->springs[i - 1])) {
            insert(pool, (uint16_t)(i - 1));
        }
    }
}

/* From a spring on, the first that ends at a body. */
static uint16_t ending_at(const cairn_spring_pool *pool, uint16_t body, uint16_t i)
{
    while (i != CAIRN_NONE && pool->springs[i].a != body && pool->springs[i].b != body) {
        const cairn_spring *spring = &pool->springs[i];
        i = ((spring->a ^ body) & pool->mask) == 0 ? spring->link_a : spring->link_b;
    }
    return i;
}

uint16_t cairn_spring_first_at(const cairn_spring_pool *pool, uint16_t body)
{
    return pool->end == 0 ? (uint16_t)CAIRN_NONE : ending_at(pool, body, pool->springs[body & pool->mask].bucket);
}

uint16_t cairn_spring_next_at(const cairn_spring_pool *pool, uint16_t body, uint16_t i)
{
    const cairn_spring *spring = &pool->springs[i];
    return ending_at(pool, body, ((spring->a ^ body) & pool->mask) == 0 ? spring->link_a : spring->link_b);
}
