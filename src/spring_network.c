/*
 * Networks: springs that are linked through bodies which move. Where paths of one network pull along one another, as
 * diagonals of a mesh do, it is entangled: path after path is then a poor solution, and needs more.
 */
#include "spring_solve.h"

/* Springs of different paths at one body are not across one another if the cosine of their angle is beyond this. */
#define ALONG CAIRN_UNIT(0.3)

static uint16_t root_of(const cairn_spring_pool *pool, uint16_t i)
{
    while (pool->springs[i].network != i) {
        i = pool->springs[i].network; /* a smaller one each time */
    }
    return i;
}

static bool moves(const cairn_world *world, uint16_t body) { return cairn_body_is_dynamic(&world->bodies[body]); }

static bool are_linked(const cairn_world *world, const cairn_spring *s, const cairn_spring *t)
{
    return ((s->a == t->a || s->a == t->b) && moves(world, s->a)) || ((s->b == t->a || s->b == t->b) && moves(world, s->b));
}

/* Is t behind or before s on its path? */
static bool are_neighbours(const cairn_spring_pool *pool, uint16_t s, uint16_t t)
{
    return pool->springs[s].next == t || pool->springs[t].next == s;
}

static cairn_unit alignment(const cairn_spring *s, const cairn_spring *t)
{
    cairn_unit c = cairn_spring_cosine(s, t);
    return c < 0 ? -c : c;
}

static void entangle(cairn_spring_pool *pool, uint16_t i)
{
    pool->springs[root_of(pool, i)].flags |= CAIRN_SPRING_ENTANGLED;
    pool->entangled = true;
}

static void link(cairn_world *world, uint16_t i, uint16_t j)
{
    cairn_spring_pool *pool = world->springs;
    cairn_spring *s = &pool->springs[i], *t = &pool->springs[j];
    uint16_t p = root_of(pool, i), q = root_of(pool, j);
    pool->springs[p].network = p < q ? p : q;
    pool->springs[q].network = p < q ? p : q;
    if (are_neighbours(pool, i, j)) {
        return;
    }
    if (s->across == CAIRN_NONE || alignment(s, &pool->springs[s->across]) < alignment(s, t)) {
        s->across = j;
    }
    if (t->across == CAIRN_NONE) {
        t->across = i;
    }
}

void cairn_spring_networks(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    pool->entangled = false;
    for (uint16_t i = 0; i < pool->end; i++) {
        pool->springs[i].network = i;
        pool->springs[i].across = CAIRN_NONE;
        pool->springs[i].flags &= (uint16_t)~CAIRN_SPRING_ENTANGLED;
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        for (uint16_t j = 0; j < i && cairn_spring_is_used(&pool->springs[i]); j++) {
            if (cairn_spring_is_used(&pool->springs[j]) && are_linked(world, &pool->springs[i], &pool->springs[j])) {
                link(world, i, j);
            }
        }
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        pool->springs[i].network = root_of(pool, i);
    }
    cairn_spring_entangle(world);
}

/* A network that was a web when it was made may become entangled as it folds; it stays so until its springs change. */
void cairn_spring_entangle(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    for (uint16_t i = 0; i < pool->end; i++) {
        const cairn_spring *spring = &pool->springs[i];
        if (cairn_spring_is_used(spring) && spring->across != CAIRN_NONE
            && alignment(spring, &pool->springs[spring->across]) > ALONG) {
            entangle(pool, i);
        }
    }
}
