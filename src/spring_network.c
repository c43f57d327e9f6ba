/*
 * Networks: springs that are linked through bodies which move. Where paths of one network pull along one another, as
 * diagonals of a mesh do, it is entangled: path after path is then a poor solution, and needs more.
 */
#include "spring_solve.h"

/*
 * What one path leaves of another's error is, in units of the spring's own pull, about (b + d) cos^2, cos being the angle
 * between them. Beyond this it counts.
 */
#define COUNTS CAIRN_SHARE(0.02)

/* The first spring that is known to belong to the same network. Ways there are halved, so that they stay short. */
static uint16_t root_of(cairn_spring_pool *pool, uint16_t i)
{
    cairn_spring *springs = pool->springs;
    while (springs[i].network != i) {
        springs[i].network = springs[springs[i].network].network;
        i = springs[i].network; /* a smaller one each time */
    }
    return i;
}

static bool moves(const cairn_world *world, uint16_t body) { return cairn_body_is_dynamic(&world->bodies[body]); }

/* Is t behind or before s on its path? */
static bool are_neighbours(const cairn_spring_pool *pool, uint16_t s, uint16_t t)
{
    return pool->springs[s].next == t || pool->springs[t].next == s;
}

CAIRN_ONCE cairn_unit alignment(const cairn_spring *s, const cairn_spring *t)
{
    cairn_unit c = cairn_spring_cosine(s, t);
    return c < 0 ? -c : c;
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

static void link_to_earlier(cairn_world *world, uint16_t i, uint16_t body)
{
    const cairn_spring_pool *pool = world->springs;
    if (moves(world, body)) {
        for (uint16_t j = cairn_spring_first_at(pool, body); j < i; j = cairn_spring_next_at(pool, body, j)) {
            link(world, i, j);
        }
    }
}

void cairn_spring_networks(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    pool->entangled = false;
    for (uint16_t i = 0; i < pool->end; i++) {
        pool->springs[i].network = i;
        pool->springs[i].across = CAIRN_NONE;
        pool->springs[i].flags &= (uint16_t)~(CAIRN_SPRING_ENTANGLED | CAIRN_SPRING_MESHED | CAIRN_SPRING_PINNED);
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        if (cairn_spring_is_used(&pool->springs[i])) {
            link_to_earlier(world, i, pool->springs[i].a);
            link_to_earlier(world, i, pool->springs[i].b);
        }
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        pool->springs[i].network = root_of(pool, i);
        if (cairn_spring_is_pin(&pool->springs[i])) { /* its two axes pull along one another by the bodies' turning */
            pool->springs[pool->springs[i].network].flags |= CAIRN_SPRING_PINNED;
            pool->entangled = true;
        }
    }
}

static bool counts(const cairn_spring *s, const cairn_spring *t)
{
    cairn_unit along = alignment(s, t);
    return cairn_share_mul(cairn_share_mul(along, along), CAIRN_SHARE(1) - s->yield) > cairn_share_mul(s->yield, COUNTS);
}

/* A network that was a web when it was made may become entangled as it folds; it stays so until its springs change. */
bool cairn_spring_entangle(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    bool more = false;
    for (uint16_t i = 0; i < pool->end; i++) {
        const cairn_spring *spring = &pool->springs[i];
        if (!cairn_spring_is_used(spring) || spring->across == CAIRN_NONE) {
            continue;
        }
        cairn_spring *first = &pool->springs[spring->network];
        if (!(first->flags & CAIRN_SPRING_ENTANGLED) && counts(spring, &pool->springs[spring->across])) {
            first->flags |= CAIRN_SPRING_ENTANGLED;
            more = pool->entangled = true;
        }
    }
    return more;
}
