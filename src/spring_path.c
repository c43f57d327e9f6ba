/*
 * Paths of springs. A network is cut into paths, from spring to spring as straight as it goes: a rope is one path, a
 * curtain its rows and columns. The springs of a path are solved together: their equations are tridiagonal, as each
 * shares bodies with the one before and the one behind. Path after path is Gauss and Seidel's scheme over lines. Solving
 * spring by spring instead lets a rope hang far too long.
 *
 * A spring is judged where the sub-step would end without it (Cairn calls that foreseen), not where it is: its
 * elongation then has the way around the other end in it, and one solution a sub-step is enough for a whip of 1e8 N/m.
 * From where it is, to first order, ropes of 1e5 N/m and more gained energy without bound.
 */
#include "spring_solve.h"

/* A path goes on through a spring that turns by less than 72 degrees. */
#define STRAIGHT CAIRN_UNIT(0.3)
/* The equations are made anew when the springs of a path may have turned by this, rad. */
#define STALE CAIRN_UNIT(0.02)
/* Least pivot of a path's equations. */
#define PIVOT_MIN CAIRN_FACTOR(0.0009765625)

/* ---- the cut ---- */

static uint16_t start_of(const cairn_spring *spring) { return spring->flags & CAIRN_SPRING_BACKWARDS ? spring->b : spring->a; }
static uint16_t end_of(const cairn_spring *spring) { return spring->flags & CAIRN_SPRING_BACKWARDS ? spring->a : spring->b; }

cairn_unit cairn_spring_cosine(const cairn_spring *s, const cairn_spring *t)
{
    return cairn_unit_dot(cairn_unit_from_dir(s->direction_x), cairn_unit_from_dir(s->direction_y), cairn_unit_from_dir(t->direction_x),
                          cairn_unit_from_dir(t->direction_y));
}

/*
 * The unused spring that goes on most straight from a body at the end (or, backwards, the start) of a spring; its
 * direction along the path is set. CAIRN_NONE if there is none.
 */
static uint16_t continuation(cairn_world *world, const cairn_spring *spring, uint16_t body, bool at_end)
{
    cairn_spring_pool *pool = world->springs;
    uint16_t best = CAIRN_NONE;
    bool best_backwards = false;
    cairn_unit straightest = STRAIGHT;
    if (!cairn_body_is_dynamic(&world->bodies[body])) {
        return CAIRN_NONE;
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        const cairn_spring *other = &pool->springs[i];
        if (!cairn_spring_is_used(other) || (other->flags & CAIRN_SPRING_IN_PATH) || (other->a != body && other->b != body)) {
            continue;
        }
        bool backwards = at_end ? other->b == body : other->a == body;
        cairn_unit c = cairn_spring_cosine(spring, other);
        c = backwards != ((spring->flags & CAIRN_SPRING_BACKWARDS) != 0) ? -c : c;
        if (c > straightest) {
            straightest = c;
            best = i;
            best_backwards = backwards;
        }
    }
    if (best != CAIRN_NONE) {
        pool->springs[best].flags |= (uint16_t)(CAIRN_SPRING_IN_PATH | cairn_flag_if(best_backwards, CAIRN_SPRING_BACKWARDS));
    }
    return best;
}

/* The path through an unused spring: on from its end, then back from its start. */
static void make_path(cairn_world *world, uint16_t first)
{
    cairn_spring_pool *pool = world->springs;
    uint16_t last = first, next;
    pool->springs[first].flags |= CAIRN_SPRING_IN_PATH;
    pool->springs[first].next = CAIRN_NONE;
    while ((next = continuation(world, &pool->springs[last], end_of(&pool->springs[last]), true)) != CAIRN_NONE) {
        pool->springs[last].next = next;
        pool->springs[next].next = CAIRN_NONE;
        last = next;
    }
    while ((next = continuation(world, &pool->springs[first], start_of(&pool->springs[first]), false)) != CAIRN_NONE) {
        pool->springs[next].next = first;
        first = next;
    }
    pool->springs[first].flags |= CAIRN_SPRING_HEAD;
}

void cairn_spring_paths(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    for (uint16_t i = 0; i < pool->end; i++) {
        cairn_spring *spring = &pool->springs[i];
        spring->flags &= (uint16_t)~(CAIRN_SPRING_HEAD | CAIRN_SPRING_IN_PATH | CAIRN_SPRING_BACKWARDS | CAIRN_SPRING_LEVERS);
        if (cairn_spring_is_used(spring)) {
            const cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
            cairn_reach r;
            cairn_spring_measure(spring, a, b, &r);
            cairn_spring_point(spring, a, b, &r);
            spring->heading_x = spring->direction_x;
            spring->heading_y = spring->direction_y;
        }
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        if (cairn_spring_is_used(&pool->springs[i]) && !(pool->springs[i].flags & CAIRN_SPRING_IN_PATH)) {
            make_path(world, i);
        }
    }
}

/* ---- its equations ---- */

/*
 * How an impulse along s changes the velocity along its neighbour t: the share of their common body, with a minus where
 * one begins and the other ends there.
 */
static cairn_factor coupling(const cairn_world *world, const cairn_spring *s, const cairn_spring *t, uint16_t body)
{
    const cairn_body *common = &world->bodies[body];
    cairn_share share = s->a == body ? s->share_a : s->share_b;
    cairn_lever js = s->a == body ? s->lever_a : s->lever_b, jt = t->a == body ? t->lever_a : t->lever_b;
    cairn_factor linear = common->flags & CAIRN_BODY_FIXED_POSITION ? 0
                        : cairn_factor_mul(cairn_factor_from_share(share), cairn_factor_from_share(cairn_spring_cosine(s, t)));
    cairn_factor whole = linear + cairn_factor_spin(share, js, jt);
    return (s->a == body) == (t->a == body) ? whole : -whole;
}

/* Eliminate downwards: what each spring takes from the one before (before), its pivot and what it gives to the one behind. */
void cairn_path_factorise(cairn_world *world, uint16_t head)
{
    cairn_spring_pool *pool = world->springs;
    const cairn_spring *previous = NULL;
    pool->springs[head].turned = 0;
    for (uint16_t i = head; i != CAIRN_NONE; i = pool->springs[i].next) {
        cairn_spring *spring = &pool->springs[i];
        cairn_factor gain = cairn_factor_mul(cairn_factor_from_share(CAIRN_SHARE(1) - spring->yield), cairn_spring_mass(world, spring));
        cairn_factor pivot = CAIRN_FACTOR(1);
        spring->before = 0;
        if (cairn_spring_is_off_centre(spring)) {
            pool->springs[head].flags |= CAIRN_SPRING_LEVERS;
        }
        if (previous != NULL) {
            spring->before = cairn_factor_mul(gain, coupling(world, previous, spring, start_of(spring)));
            pivot -= cairn_factor_mul(spring->before, previous->behind);
        }
        pivot = pivot < PIVOT_MIN ? PIVOT_MIN : pivot;
        spring->inverse_pivot = cairn_factor_reciprocal(pivot);
        spring->behind = 0;
        if (spring->next != CAIRN_NONE) {
            const cairn_spring *next = &pool->springs[spring->next];
            spring->behind = cairn_factor_mul(cairn_factor_mul(gain, coupling(world, next, spring, end_of(spring))), spring->inverse_pivot);
        }
        previous = spring;
    }
}

/* ---- the sub-step ---- */

/* x more, within the limit; the velocity before goes along, so that their difference, which is repeated, stays as it is. */
static void accelerate(cairn_motion *v, cairn_motion *u, cairn_motion x, cairn_motion limit)
{
    cairn_motion changed = cairn_motion_clamp(cairn_motion_add(*v, x), limit);
    *u += changed - *v;
    *v = changed;
}

void cairn_spring_push(cairn_body *body, cairn_motion x, cairn_motion y, cairn_motion turn)
{
    if (cairn_body_is_free_to_shift(body)) {
        accelerate(&body->vx, &body->ux, x, CAIRN_SWEEP_SPEED);
        accelerate(&body->vy, &body->uy, y, CAIRN_SWEEP_SPEED);
    }
    if (turn != 0) {
        accelerate(&body->w, &body->uw, turn, CAIRN_SWEEP_SPIN);
    }
    body->flags |= CAIRN_BODY_HELD;
}

/* Velocity of b relative to a along the spring. */
cairn_motion cairn_spring_speed(const cairn_spring *spring, const cairn_body *a, const cairn_body *b)
{
    cairn_motion u = cairn_motion_along(b->vx - a->vx, b->vy - a->vy, spring->direction_x, spring->direction_y);
    return cairn_motion_add(u, cairn_motion_lever(b->w, spring->lever_b) - cairn_motion_lever(a->w, spring->lever_a));
}

/*
 * The right sides of a path's equations: D u + B C*, and what the spring yields to the impulse that the sweep before gave it.
 * How far its springs turned, at most.
 */
static cairn_unit ask(cairn_world *world, uint16_t head, bool again)
{
    cairn_spring_pool *pool = world->springs;
    cairn_unit most = 0;
    for (uint16_t i = head; i != CAIRN_NONE; i = pool->springs[i].next) {
        cairn_spring *spring = &pool->springs[i];
        const cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
        cairn_reach r;
        cairn_unit turned = cairn_spring_aim(spring, a, b, &r, false);
        most = turned > most ? turned : most;
        cairn_motion demand = cairn_motion_from_offset_wide(r.length - spring->rest_length, spring->position_gain);
        if (spring->velocity_gain != 0) {
            demand = cairn_motion_add(demand, cairn_motion_share(cairn_spring_speed(spring, a, b), spring->velocity_gain));
        }
        if (spring->lever_a != 0 || spring->lever_b != 0) {
            demand = cairn_motion_factor(demand, cairn_spring_mass(world, spring));
        }
        spring->impulse = again ? cairn_motion_add(demand, cairn_motion_share(spring->sum, spring->yield)) : demand;
    }
    return most;
}

static void apply(cairn_world *world, cairn_spring *spring, cairn_motion impulse)
{
    cairn_motion of_a = -cairn_motion_share(impulse, spring->share_a), of_b = cairn_motion_share(impulse, spring->share_b);
    cairn_spring_push(&world->bodies[spring->a], cairn_motion_dir(of_a, spring->direction_x), cairn_motion_dir(of_a, spring->direction_y),
                      spring->lever_a != 0 ? cairn_twist(of_a, spring->lever_a) : 0);
    cairn_spring_push(&world->bodies[spring->b], cairn_motion_dir(of_b, spring->direction_x), cairn_motion_dir(of_b, spring->direction_y),
                      spring->lever_b != 0 ? cairn_twist(of_b, spring->lever_b) : 0);
}

void cairn_path_solve(cairn_world *world, uint16_t head, bool again)
{
    cairn_spring_pool *pool = world->springs;
    cairn_motion impulse = 0;
    uint16_t last = CAIRN_NONE;
    pool->springs[head].turned += ask(world, head, again);
    if (pool->springs[head].turned > STALE) {
        cairn_path_factorise(world, head);
    }
    for (uint16_t i = head; i != CAIRN_NONE; i = pool->springs[i].next) {
        cairn_spring *spring = &pool->springs[i];
        cairn_motion left = cairn_motion_add(spring->impulse, cairn_motion_factor(impulse, spring->before));
        impulse = -cairn_motion_factor(left, spring->inverse_pivot);
        spring->impulse = impulse;
        spring->previous = last;
        last = i;
    }
    impulse = 0;
    for (uint16_t i = last; i != CAIRN_NONE; i = pool->springs[i].previous) {
        cairn_spring *spring = &pool->springs[i];
        impulse = cairn_motion_add(spring->impulse, -cairn_motion_factor(impulse, spring->behind));
        spring->sum = impulse;
        apply(world, spring, impulse);
    }
}
