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
#define STALE CAIRN_TURN(0.02)
/* Least pivot of a path's equations. */
#define PIVOT_MIN CAIRN_FACTOR(0.0009765625)

/* ---- the cut ---- */

cairn_unit cairn_spring_cosine(const cairn_spring *s, const cairn_spring *t)
{
    return cairn_dir_cosine(s->direction_x, s->direction_y, t->direction_x, t->direction_y);
}

CAIRN_ONCE void swap(uint16_t *a, uint16_t *b)
{
    uint16_t was = *a;
    *a = *b;
    *b = was;
}

/* Its two ends change places, so that it goes from a to b as its path does. */
static void turn_round(cairn_spring *spring)
{
    cairn_offset2 anchor = spring->anchor_a;
    spring->anchor_a = spring->anchor_b;
    spring->anchor_b = anchor;
    cairn_lever lever = spring->lever_a;
    spring->lever_a = cairn_lever_negate(spring->lever_b);
    spring->lever_b = cairn_lever_negate(lever);
    spring->direction_x = cairn_dir_negate(spring->direction_x);
    spring->direction_y = cairn_dir_negate(spring->direction_y);
    swap(&spring->a, &spring->b);
    swap(&spring->link_a, &spring->link_b);
    spring->flags ^= CAIRN_SPRING_TURNED;
}

/* The unused spring that goes on most straight from the b of a spring, or back from its a, or any pin from a pin. CAIRN_NONE if there is none. */
static uint16_t continuation(cairn_world *world, const cairn_spring *spring, bool at_end)
{
    cairn_spring_pool *pool = world->springs;
    uint16_t body = at_end ? spring->b : spring->a, best = CAIRN_NONE;
    cairn_unit straightest = STRAIGHT;
    if (!cairn_body_is_dynamic(&world->bodies[body])) {
        return CAIRN_NONE;
    }
    for (uint16_t i = cairn_spring_first_at(pool, body); i != CAIRN_NONE; i = cairn_spring_next_at(pool, body, i)) {
        const cairn_spring *other = &pool->springs[i];
        if ((other->flags & CAIRN_SPRING_IN_PATH) || cairn_spring_is_pin(spring) != cairn_spring_is_pin(other)) {
            continue;
        }
        cairn_unit c = cairn_spring_cosine(spring, other);
        c = cairn_spring_is_pin(spring) ? STRAIGHT + 1 : (at_end ? other->a : other->b) == body ? c : -c;
        if (c > straightest) {
            straightest = c;
            best = i;
        }
    }
    if (best != CAIRN_NONE) {
        cairn_spring *next = &pool->springs[best];
        next->flags |= CAIRN_SPRING_IN_PATH;
        if ((at_end ? next->a : next->b) != body) {
            turn_round(next);
        }
    }
    return best;
}

/* On from the end of a spring, or back from its start, as far as it goes: the last one. */
CAIRN_ALWAYS_INLINE uint16_t follow(cairn_world *world, uint16_t spring, bool at_end)
{
    cairn_spring *springs = world->springs->springs;
    uint16_t next;
    while ((next = continuation(world, &springs[spring], at_end)) != CAIRN_NONE) {
        uint16_t before = at_end ? spring : next, behind = at_end ? next : spring;
        springs[before].next = behind;
        springs[behind].previous = before;
        spring = next;
    }
    return spring;
}

/* The path through an unused spring. */
static void make_path(cairn_world *world, uint16_t spring)
{
    cairn_spring *springs = world->springs->springs;
    springs[spring].flags |= CAIRN_SPRING_IN_PATH;
    springs[follow(world, spring, true)].next = CAIRN_NONE;
    springs[follow(world, spring, false)].flags |= CAIRN_SPRING_HEAD;
}

void cairn_spring_paths(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    uint16_t *link = &pool->first;
    for (uint16_t i = 0; i < pool->end; i++) {
        cairn_spring *spring = &pool->springs[i];
        if (spring->flags & CAIRN_SPRING_TURNED) {
            turn_round(spring); /* what was before decides nothing */
        }
        spring->flags &= (uint16_t)~(CAIRN_SPRING_HEAD | CAIRN_SPRING_IN_PATH | CAIRN_SPRING_LEVERS | CAIRN_SPRING_FRAMED);
        if (cairn_spring_is_used(spring)) {
            const cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
            cairn_reach r;
            cairn_spring_measure(spring, a, b, &r);
            cairn_spring_point(spring, a, b, &r);
        }
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        if (cairn_spring_is_used(&pool->springs[i]) && !(pool->springs[i].flags & CAIRN_SPRING_IN_PATH)) {
            make_path(world, i);
        }
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        cairn_spring *spring = &pool->springs[i];
        spring->frame.x = spring->direction_x;
        spring->frame.y = spring->direction_y;
        spring->swing = 0;
        if (spring->flags & CAIRN_SPRING_HEAD) {
            *link = i;
            link = &spring->previous;
        }
    }
    *link = CAIRN_NONE;
}

/* ---- its equations ---- */

/* How an impulse along s changes the velocity along its neighbour t: the share of their common body, of which one begins where the other ends. */
static cairn_factor coupling(const cairn_body *common, const cairn_spring *s, const cairn_spring *t, cairn_share share, cairn_lever js, cairn_lever jt)
{
    cairn_factor linear = cairn_body_is_fixed(common) ? 0
                        : cairn_factor_mul(cairn_factor_from_share(share), cairn_factor_from_share(cairn_spring_cosine(s, t)));
    return -linear - cairn_factor_spin(share, js, jt);
}

/* Eliminate downwards: what each spring takes from the one before (before), its pivot and what it gives to the one behind. */
void cairn_path_factorise(cairn_world *world, cairn_spring *first)
{
    const cairn_spring *previous = NULL;
    first->turned = 0;
    for (cairn_spring *spring = first; spring != NULL;) {
        cairn_spring *next = cairn_spring_behind(world->springs, spring);
        cairn_share yield = spring->flags & CAIRN_SPRING_EXACT ? 0 : spring->yield; /* of an exact one it says another thing, and its equation is not used */
        cairn_factor gain = cairn_factor_mul(cairn_factor_from_share(CAIRN_SHARE(1) - yield), cairn_spring_mass(world, spring));
        cairn_factor pivot = CAIRN_FACTOR(1);
        spring->before = spring->behind = 0;
        if (cairn_spring_is_off_centre(spring)) {
            first->flags |= CAIRN_SPRING_LEVERS;
        }
        if (previous != NULL) {
            spring->before = cairn_factor_mul(gain, coupling(&world->bodies[spring->a], previous, spring, previous->share_b, previous->lever_b, spring->lever_a));
            pivot -= cairn_factor_mul(spring->before, previous->behind);
        }
        pivot = pivot < PIVOT_MIN ? PIVOT_MIN : pivot;
        spring->inverse_pivot = pivot > CAIRN_FACTOR(0.5) ? cairn_factor_from_ratio(cairn_factor_inverse(pivot)) : cairn_factor_reciprocal(pivot);
        if (next != NULL) {
            cairn_factor of_next = coupling(&world->bodies[spring->b], next, spring, next->share_a, next->lever_a, spring->lever_b);
            spring->behind = cairn_factor_mul(cairn_factor_mul(gain, of_next), spring->inverse_pivot);
        }
        previous = spring;
        spring = next;
    }
}

/* ---- the sub-step ---- */

/* A pin's axis, in its lag. */
enum { LEVEL, UPRIGHT, ALONG };

/* x more, within the limit; the velocity before goes along, so that their difference, which is repeated, stays as it is. */
static inline void accelerate(cairn_motion *v, cairn_motion *u, cairn_motion x, cairn_motion limit)
{
    cairn_motion changed = cairn_motion_clamp(*v + x, limit);
    *u += changed - *v;
    *v = changed;
}

void cairn_spring_shift(cairn_body *body, cairn_motion x, cairn_motion y)
{
    accelerate(&body->vx, &body->ux, x, CAIRN_SWEEP_SPEED);
    accelerate(&body->vy, &body->uy, y, CAIRN_SWEEP_SPEED);
}

void cairn_spring_push(cairn_body *body, cairn_motion x, cairn_motion y, cairn_motion turn)
{
    if (cairn_body_is_free_to_shift(body)) {
        cairn_spring_shift(body, cairn_motion_clamp(x, CAIRN_SPRING_IMPULSE), cairn_motion_clamp(y, CAIRN_SPRING_IMPULSE));
    }
    accelerate(&body->w, &body->uw, cairn_motion_clamp(turn, 2 * CAIRN_SPRING_IMPULSE), CAIRN_SWEEP_SPIN);
}

/* Velocity of b relative to a along the spring. */
cairn_motion cairn_spring_speed(const cairn_spring *spring, const cairn_body *a, const cairn_body *b)
{
    cairn_motion u = cairn_motion_along(b->vx - a->vx, b->vy - a->vy, spring->direction_x, spring->direction_y);
    return cairn_motion_add(u, cairn_motion_lever(b->w, spring->lever_b) - cairn_motion_lever(a->w, spring->lever_a));
}

/* D u + B C* */
static cairn_motion demand(const cairn_world *world, cairn_spring *spring, bool again, cairn_turn *turned)
{
    const cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
    cairn_offset length;
    bool on_axis = cairn_spring_is_pin(spring) && spring->lag != ALONG, stays = again && spring->lag == UPRIGHT; /* the axis of the sweep before */
    length = on_axis ? cairn_spring_aim_along(spring, a, b, spring->lag == UPRIGHT, stays) : cairn_spring_aim(spring, a, b, false, turned);
    if (cairn_spring_is_pin(spring)) {
        *turned = 0;
        if (!on_axis) {
            spring->made.pin.strain = cairn_motion_clamp(cairn_motion_from_offset(length), CAIRN_SPRING_DEMAND);
        }
        if (!stays) {
            cairn_spring_map_pin(world, spring);
            *turned = 2 * STALE; /* its factors are of another axis */
        }
    }
    cairn_motion demand = cairn_motion_clamp(cairn_motion_from_offset_wide(length - spring->rest_length, spring->position_gain), CAIRN_SPRING_DEMAND);
    demand = cairn_motion_add(demand, cairn_motion_share(cairn_spring_speed(spring, a, b), spring->velocity_gain));
    return cairn_motion_clamp(cairn_motion_factor(demand, cairn_spring_mass(world, spring)), CAIRN_SPRING_DEMAND);
}

/* The right sides of a path's equations: D u + B C*. How far its springs turned, at most. */
static cairn_turn ask(cairn_world *world, cairn_spring *spring, bool again)
{
    cairn_turn most = 0;
    for (; spring != NULL; spring = cairn_spring_behind(world->springs, spring)) {
        cairn_turn turned;
        cairn_motion asked = demand(world, spring, again, &turned);
        spring->pulled = again ? cairn_spring_ask_more(spring, asked) : asked;
        most = turned > most ? turned : most;
    }
    return most;
}

cairn_motion cairn_spring_ask_more(const cairn_spring *spring, cairn_motion demand)
{
    return cairn_motion_clamp(demand - cairn_motion_share(2 * spring->pulled, spring->yield), CAIRN_SPRING_DEMAND);
}

cairn_motion cairn_spring_answer(const cairn_spring *spring, cairn_motion demand, cairn_motion before)
{
    cairn_motion left = cairn_motion_add(demand, cairn_motion_factor(before, spring->before));
    return -cairn_motion_clamp(cairn_motion_factor(left, spring->inverse_pivot), CAIRN_SPRING_IMPULSE);
}

/* The impulses that satisfy a path's equations: down the path, each from what the one before takes, the last one's being final. */
static cairn_spring *eliminate(const cairn_spring_pool *pool, cairn_spring *spring)
{
    cairn_motion impulse = 0;
    cairn_spring *last = spring;
    for (; spring != NULL; spring = cairn_spring_behind(pool, spring)) {
        impulse = cairn_spring_answer(spring, spring->pulled, impulse);
        spring->pulled = impulse;
        last = spring;
    }
    return last;
}

static void push(cairn_world *world, uint16_t body, cairn_motion impulse, const cairn_spring *spring, cairn_lever lever)
{
    cairn_spring_push(&world->bodies[body], cairn_motion_dir(impulse, spring->direction_x), cairn_motion_dir(impulse, spring->direction_y),
                      cairn_twist(impulse, lever));
}

/* Back up the path: what is behind a spring counts too. */
static void apply(cairn_world *world, const cairn_spring *first, cairn_spring *spring)
{
    cairn_motion impulse = 0;
    for (;; spring = &world->springs->springs[spring->previous]) {
        cairn_motion behind = cairn_motion_clamp(cairn_motion_factor(impulse, spring->behind), CAIRN_SPRING_IMPULSE);
        impulse = cairn_motion_clamp(spring->pulled - behind, CAIRN_SPRING_IMPULSE);
        spring->pulled = cairn_motion_half(-impulse);
        push(world, spring->b, cairn_motion_share(impulse, spring->share_b), spring, spring->lever_b);
        push(world, spring->a, -cairn_motion_share(impulse, spring->share_a), spring, spring->lever_a);
        if (spring == first) {
            return;
        }
    }
}

static void solve(cairn_world *world, cairn_spring *first, bool again)
{
    first->turned += ask(world, first, again);
    if (first->turned > STALE) {
        cairn_path_factorise(world, first);
    }
    apply(world, first, eliminate(world->springs, first));
}

/* The pins of a path pull along this axis from now on. What each has pulled with along the other one is kept for another sweep. */
static void turn_pins(const cairn_world *world, cairn_spring *first, uint8_t axis)
{
    for (cairn_spring *pin = first; pin != NULL; pin = cairn_spring_behind(world->springs, pin)) {
        if (pin->lag == LEVEL) {
            pin->origin_x = pin->pulled;
        } else if (pin->lag == UPRIGHT) {
            pin->origin_y = pin->pulled;
        }
        pin->pulled = axis == LEVEL ? pin->origin_x : axis == UPRIGHT ? pin->origin_y : pin->pulled;
        pin->lag = axis;
    }
}

/*
 * A pull at an end swings the body as a pendulum, by w^2 h^2 = (pull / radius of gyration) (arm / radius of gyration). One axis after the other follows
 * that while it is below about 4; the bound has 3 for the arm. The same of two points so far apart.
 */
#define SWINGS CAIRN_MOTION(4.0 / 3)

static bool is_swung(const cairn_body *body, cairn_motion pull)
{
    return cairn_body_is_dynamic(body) && cairn_body_can_turn(body) && cairn_motion_scale(pull, cairn_body_inverse_gyration(body)) > SWINGS;
}

static bool are_torn(const cairn_world *world, const cairn_spring *pin)
{
    while (pin != NULL && !is_swung(&world->bodies[pin->a], pin->made.pin.strain) && !is_swung(&world->bodies[pin->b], pin->made.pin.strain)) {
        pin = cairn_spring_behind(world->springs, pin);
    }
    return pin != NULL;
}

static cairn_motion larger(cairn_motion strain, cairn_motion half)
{
    cairn_motion pull = half < 0 ? -2 * half : 2 * half; /* at most CAIRN_SPRING_IMPULSE */
    return strain > pull ? strain : pull;
}

/* After a first sweep: how much pulls at the pins of a path. */
static void strain_pins(const cairn_world *world, cairn_spring *pin)
{
    for (; pin != NULL; pin = cairn_spring_behind(world->springs, pin)) {
        pin->made.pin.strain = larger(larger(pin->made.pin.strain, pin->pulled), pin->lag == ALONG ? 0 : pin->origin_x);
    }
}

/*
 * Pins, springs of no rest length, are solved along x and then along y: F = -k (L - L0) u is linear where L0 is 0, and each axis is an equation of
 * its own. Along u, which looks anywhere where two points nearly meet, one sub-step holds them in one direction and the next one in another: planks
 * that were pinned together never came to rest. In another sweep the axes come in the opposite order, as paths do. Pins that are torn apart, or
 * pull so hard that bodies swing by them in a sub-step, pull along u.
 */
static void solve_pins(cairn_world *world, cairn_spring *first, bool again)
{
    if (again ? first->lag == ALONG : are_torn(world, first)) {
        turn_pins(world, first, ALONG);
        solve(world, first, again);
    } else {
        turn_pins(world, first, again ? UPRIGHT : LEVEL);
        solve(world, first, again);
        turn_pins(world, first, again ? LEVEL : UPRIGHT);
        solve(world, first, again);
    }
    if (!again) {
        strain_pins(world, first);
    }
}

void cairn_path_solve(cairn_world *world, cairn_spring *first, bool again)
{
    if (cairn_spring_is_pin(first)) {
        solve_pins(world, first, again);
    } else {
        solve(world, first, again);
    }
}
