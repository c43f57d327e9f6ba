/*
 * Springs in the step, solved once in every sub-step after the velocities are integrated; sub-step units throughout.
 *
 * With u the velocity along a spring, C its elongation, e the effective mass over the reduced mass,
 * b = k h^2 (1/mA + 1/mB) / e and d = c h (1/mA + 1/mB) / e, an impulse of e (A u + B C) is taken off:
 * - an isolated spring (each dynamic end carries one, b below 0.2) by the exact map of the damped oscillator,
 *   A = 1 - det M and B = 1 + det M - tr M with M = exp((0, 1), (-b, -d));
 * - any other by implicit Euler, A = (d + b) / (1 + d + b) and B = b / (1 + d + b), bounded for any stiffness.
 *
 * A network is cut into paths, from spring to spring as straight as it goes (a rope is one path, a curtain its rows and columns). The
 * springs of a path are solved together: their equations are tridiagonal, as each shares bodies with the one before
 * and the one behind. Path after path is Gauss and Seidel's scheme over lines. Solving spring by spring instead lets a rope hang far too long.
 *
 * The impulses are kept out of the warm start (they go into u as well as v): an unconverged network must not be repeated.
 */
#include "spring_solve.h"

/* Beyond this stiffness a spring is a rod: more would only lose bits. */
#define STIFFNESS_MAX cairn_wide_from_int(4096)
/* A path goes on through a spring that turns by less than 72 degrees. */
#define STRAIGHT CAIRN_UNIT(0.3)
/* Least pivot of a path's equations. */
#define PIVOT_MIN CAIRN_FACTOR(0.0009765625)

/* ---- geometry ---- */

static cairn_offset2 arm_of(cairn_offset x, cairn_offset y, cairn_unit c, cairn_unit s)
{
    cairn_offset2 arm;
    arm.x = cairn_offset_dot(x, -y, c, s);
    arm.y = cairn_offset_dot(x, y, s, c);
    return arm;
}

/* The arm of an anchor when the body has moved by its displacement in this step. */
static cairn_offset2 moved_arm(const cairn_body *body, cairn_offset x, cairn_offset y)
{
    cairn_unit c = body->cosine, s = body->sine;
    if (x == 0 && y == 0) {
        cairn_offset2 none;
        none.x = none.y = 0;
        return none;
    }
    if (body->dw != 0) {
        cairn_angle_rotation(cairn_angle_add(body->angle, cairn_angle_from_motion(body->dw, body->inverse_gyration)), &c, &s);
    }
    return arm_of(x, y, c, s);
}

/* The farthest that bodies may be apart on one axis, m; beyond it a spring pulls as if they were so near. */
#define FAR CAIRN_F(500)

/* The way from one anchor to the other on one axis, saturating. */
static cairn_offset way(cairn_real from, cairn_residue from_residue, cairn_real to, cairn_residue to_residue, cairn_offset moved,
                        cairn_offset from_arm, cairn_offset to_arm)
{
    cairn_real apart = cairn_real_sub(to, from);
    cairn_offset bodies = cairn_real_is_within(apart, FAR) ? cairn_coordinate_offset(from, from_residue, to, to_residue)
                        : apart > 0 ? cairn_offset_from_real(FAR) : -cairn_offset_from_real(FAR);
    return cairn_offset_add(cairn_offset_add(cairn_offset_add(bodies, moved), to_arm), -from_arm);
}

/* Where the spring is, displacements of this step included. */
void cairn_spring_measure(const cairn_spring *spring, const cairn_body *a, const cairn_body *b, cairn_reach *r)
{
    r->arm_a = moved_arm(a, spring->anchor_a.x, spring->anchor_a.y);
    r->arm_b = moved_arm(b, spring->anchor_b.x, spring->anchor_b.y);
    cairn_offset moved_x = cairn_offset_from_motion(b->dx) - cairn_offset_from_motion(a->dx);
    cairn_offset moved_y = cairn_offset_from_motion(b->dy) - cairn_offset_from_motion(a->dy);
    cairn_offset x = way(a->x, a->x_residue, b->x, b->x_residue, moved_x, r->arm_a.x, r->arm_b.x);
    cairn_offset y = way(a->y, a->y_residue, b->y, b->y_residue, moved_y, r->arm_a.y, r->arm_b.y);
    r->length = cairn_unit_along(x, y, &r->x, &r->y);
}

/* (r x n) / rho */
static cairn_lever lever_of(const cairn_body *body, cairn_offset2 arm, const cairn_reach *r)
{
    if ((arm.x == 0 && arm.y == 0) || cairn_wide_is_zero(body->inverse_gyration)) {
        return 0;
    }
    return cairn_lever_of(cairn_offset_dot(arm.x, -arm.y, r->y, r->x), body->inverse_gyration);
}

static bool is_free_to_shift(const cairn_body *body) { return cairn_body_is_dynamic(body) && !(body->flags & CAIRN_BODY_FIXED_POSITION); }

/* 1 / e */
static cairn_factor stiffening(const cairn_spring *spring, const cairn_body *a, const cairn_body *b, cairn_lever ja, cairn_lever jb)
{
    cairn_factor k = cairn_factor_from_share((is_free_to_shift(a) ? spring->share_a : 0) + (is_free_to_shift(b) ? spring->share_b : 0));
    return k + cairn_factor_spin(spring->share_a, ja, ja) + cairn_factor_spin(spring->share_b, jb, jb);
}

/* ---- the map of a sub-step ---- */

typedef struct matrix {
    cairn_share a, b, c, d;
} matrix;

static matrix product(matrix p, matrix q)
{
    matrix r;
    r.a = cairn_unit_dot(p.a, p.b, q.a, q.c);
    r.b = cairn_unit_dot(p.a, p.b, q.b, q.d);
    r.c = cairn_unit_dot(p.c, p.d, q.a, q.c);
    r.d = cairn_unit_dot(p.c, p.d, q.b, q.d);
    return r;
}

/*
 * exp(K) - 1 for K = ((0, w), (-w, -d)) by Taylor's series of K / 2^s and s squarings of 1 + E. In this scaling (the
 * velocity over w) det E is B and small stiffnesses keep their bits.
 */
static matrix oscillator(cairn_share w, cairn_share d_over_16)
{
    enum { HALVINGS = 8, TERMS = 5 };
    static const cairn_share inverse[TERMS] = { CAIRN_SHARE(1), CAIRN_SHARE(1.0 / 2), CAIRN_SHARE(1.0 / 3), CAIRN_SHARE(1.0 / 4),
                                                CAIRN_SHARE(1.0 / 5) };
    matrix k, term, sum;
    k.a = 0;
    k.b = cairn_share_shift(w, HALVINGS);
    k.c = -k.b;
    k.d = -cairn_share_shift(d_over_16, HALVINGS - 4);
    term = k;
    sum = k;
    for (int i = 1; i < TERMS; i++) {
        term = product(term, k);
        term.a = cairn_share_mul(term.a, inverse[i]);
        term.b = cairn_share_mul(term.b, inverse[i]);
        term.c = cairn_share_mul(term.c, inverse[i]);
        term.d = cairn_share_mul(term.d, inverse[i]);
        sum.a += term.a;
        sum.b += term.b;
        sum.c += term.c;
        sum.d += term.d;
    }
    for (int i = 0; i < HALVINGS; i++) {
        matrix square = product(sum, sum);
        sum.a = 2 * sum.a + square.a;
        sum.b = 2 * sum.b + square.b;
        sum.c = 2 * sum.c + square.c;
        sum.d = 2 * sum.d + square.d;
    }
    return sum;
}

/* b or d: stiffness (damping) in sub-step units. */
static cairn_wide in_substeps(const cairn_spring *spring, const cairn_body *a, const cairn_body *b, cairn_wide amount, cairn_wide power)
{
    cairn_wide inverse = cairn_wide_add(spring->share_a != 0 ? cairn_wide_div(cairn_wide_from_int(1), a->mass) : cairn_wide_from_int(0),
                                        spring->share_b != 0 ? cairn_wide_div(cairn_wide_from_int(1), b->mass) : cairn_wide_from_int(0));
    return cairn_wide_mul(cairn_wide_mul(amount, power), inverse);
}

static void map_exactly(cairn_spring *spring, cairn_wide b, cairn_wide d)
{
    matrix e = oscillator(cairn_wide_to_share(cairn_wide_sqrt(b)), cairn_wide_to_share(cairn_wide_div(d, cairn_wide_from_int(16))));
    cairn_wide determinant = cairn_wide_determinant(e.a, e.b, e.c, e.d);
    spring->velocity_gain = -(e.a + e.d) - cairn_wide_to_share(determinant);
    spring->position_gain = determinant;
    spring->gravity_gain = spring->velocity_gain + cairn_wide_to_share(cairn_wide_div(determinant, b)) - CAIRN_SHARE(1);
    spring->flags |= CAIRN_SPRING_EXACT;
}

static void map_implicitly(cairn_spring *spring, cairn_wide b, cairn_wide d)
{
    cairn_wide sum = cairn_wide_add(b, d), whole = cairn_wide_add(cairn_wide_from_int(1), sum);
    spring->velocity_gain = cairn_wide_to_share(cairn_wide_div(sum, whole));
    spring->position_gain = cairn_wide_div(b, whole);
    spring->gravity_gain = 0;
    spring->flags &= (uint8_t)~CAIRN_SPRING_EXACT;
}

static void make_map(const cairn_world *world, cairn_spring *spring)
{
    const cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
    bool moves_a = cairn_body_is_dynamic(a), moves_b = cairn_body_is_dynamic(b);
    spring->share_a = !moves_a ? 0 : !moves_b ? CAIRN_SHARE(1)
                    : cairn_wide_to_share(cairn_wide_div(b->mass, cairn_wide_add(a->mass, b->mass)));
    spring->share_b = moves_b ? CAIRN_SHARE(1) - spring->share_a : 0;
    cairn_wide stiffness = in_substeps(spring, a, b, spring->stiffness, cairn_wide_mul(world->substep, world->substep));
    cairn_wide damping = in_substeps(spring, a, b, spring->damping, world->substep);
    if (spring->anchor_a.x != 0 || spring->anchor_a.y != 0 || spring->anchor_b.x != 0 || spring->anchor_b.y != 0) {
        cairn_reach r;
        cairn_spring_measure(spring, a, b, &r);
        cairn_wide over_e = cairn_wide_from_factor(stiffening(spring, a, b, lever_of(a, r.arm_a, &r), lever_of(b, r.arm_b, &r)));
        stiffness = cairn_wide_mul(stiffness, over_e);
        damping = cairn_wide_mul(damping, over_e);
    }
    bool alone = !(moves_a && (a->flags & CAIRN_BODY_SPRINGS)) && !(moves_b && (b->flags & CAIRN_BODY_SPRINGS));
    bool soft = cairn_wide_less(stiffness, cairn_wide_div(cairn_wide_from_int(1), cairn_wide_from_int(5)))
             && cairn_wide_less(damping, cairn_wide_from_int(16));
    if (alone && soft && !cairn_wide_is_zero(stiffness)) {
        map_exactly(spring, stiffness, damping);
    } else {
        map_implicitly(spring, cairn_wide_less(STIFFNESS_MAX, stiffness) ? STIFFNESS_MAX : stiffness,
                       cairn_wide_less(STIFFNESS_MAX, damping) ? STIFFNESS_MAX : damping);
    }
}

static bool is_used(const cairn_spring *spring) { return (spring->flags & CAIRN_SPRING_USED) != 0; }

/* Which bodies carry a spring, more than one, one that takes away contact. */
static void count_ends(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    for (uint16_t i = 0; i < world->body_end; i++) {
        world->bodies[i].flags &= (uint16_t)~(CAIRN_BODY_SPRING | CAIRN_BODY_SPRINGS | CAIRN_BODY_SPRUNG);
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        const cairn_spring *spring = &pool->springs[i];
        if (!is_used(spring)) {
            continue;
        }
        cairn_body *ends[2] = { &world->bodies[spring->a], &world->bodies[spring->b] };
        for (int k = 0; k < 2; k++) {
            unsigned more = ends[k]->flags & CAIRN_BODY_SPRING ? CAIRN_BODY_SPRINGS : CAIRN_BODY_SPRING;
            unsigned sprung = cairn_flag_if((spring->flags & CAIRN_SPRING_NO_CONTACT) != 0, CAIRN_BODY_SPRUNG);
            ends[k]->flags = (uint16_t)(ends[k]->flags | more | sprung);
        }
    }
}

static bool turns_with_pose(const cairn_spring *spring)
{
    return spring->anchor_a.x != 0 || spring->anchor_a.y != 0 || spring->anchor_b.x != 0 || spring->anchor_b.y != 0;
}

/* ---- paths ---- */

static uint16_t start_of(const cairn_spring *spring) { return spring->flags & CAIRN_SPRING_BACKWARDS ? spring->b : spring->a; }
static uint16_t end_of(const cairn_spring *spring) { return spring->flags & CAIRN_SPRING_BACKWARDS ? spring->a : spring->b; }

static cairn_unit cosine(const cairn_spring *s, const cairn_spring *t)
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
        if (!is_used(other) || (other->flags & CAIRN_SPRING_IN_PATH) || (other->a != body && other->b != body)) {
            continue;
        }
        bool backwards = at_end ? other->b == body : other->a == body;
        cairn_unit c = cosine(spring, other);
        c = backwards != ((spring->flags & CAIRN_SPRING_BACKWARDS) != 0) ? -c : c;
        if (c > straightest) {
            straightest = c;
            best = i;
            best_backwards = backwards;
        }
    }
    if (best != CAIRN_NONE) {
        pool->springs[best].flags |= (uint8_t)(CAIRN_SPRING_IN_PATH | cairn_flag_if(best_backwards, CAIRN_SPRING_BACKWARDS));
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

static void refresh_direction(cairn_spring *spring, const cairn_body *a, const cairn_body *b, cairn_reach *r)
{
    cairn_spring_measure(spring, a, b, r);
    spring->direction_x = cairn_dir_from_unit(r->x);
    spring->direction_y = cairn_dir_from_unit(r->y);
    spring->lever_a = lever_of(a, r->arm_a, r);
    spring->lever_b = lever_of(b, r->arm_b, r);
}

static void make_paths(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    for (uint16_t i = 0; i < pool->end; i++) {
        cairn_spring *spring = &pool->springs[i];
        spring->flags &= (uint8_t)~(CAIRN_SPRING_HEAD | CAIRN_SPRING_IN_PATH | CAIRN_SPRING_BACKWARDS);
        if (is_used(spring)) {
            cairn_reach r;
            refresh_direction(spring, &world->bodies[spring->a], &world->bodies[spring->b], &r);
        }
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        if (is_used(&pool->springs[i]) && !(pool->springs[i].flags & CAIRN_SPRING_IN_PATH)) {
            make_path(world, i);
        }
    }
}

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
                        : cairn_factor_mul(cairn_factor_from_share(share), cairn_factor_from_share(cosine(s, t)));
    cairn_factor whole = linear + cairn_factor_spin(share, js, jt);
    return (s->a == body) == (t->a == body) ? whole : -whole;
}

/* e: the effective mass over the reduced one */
static cairn_factor mass_of(const cairn_world *world, const cairn_spring *spring)
{
    if (spring->lever_a == 0 && spring->lever_b == 0) {
        return CAIRN_FACTOR(1);
    }
    cairn_factor inverse = stiffening(spring, &world->bodies[spring->a], &world->bodies[spring->b], spring->lever_a, spring->lever_b);
    return cairn_factor_from_ratio(cairn_factor_inverse(inverse));
}

/* Eliminate downwards: what each spring takes from the one before (before), its pivot and what it gives to the one behind. */
static void factorise(cairn_world *world, uint16_t head)
{
    cairn_spring_pool *pool = world->springs;
    const cairn_spring *previous = NULL;
    for (uint16_t i = head; i != CAIRN_NONE; i = pool->springs[i].next) {
        cairn_spring *spring = &pool->springs[i];
        cairn_factor gain = cairn_factor_mul(cairn_factor_from_share(spring->velocity_gain), mass_of(world, spring));
        cairn_factor pivot = CAIRN_FACTOR(1);
        spring->before = 0;
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

static bool is_active(const cairn_world *world, const cairn_spring *spring)
{
    return cairn_body_is_active(&world->bodies[spring->a]) || cairn_body_is_active(&world->bodies[spring->b]);
}

void cairn_springs_prepare(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    bool changed = pool->changed;
    pool->changed = false;
    if (changed) {
        count_ends(world);
        make_paths(world);
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        cairn_spring *spring = &pool->springs[i];
        if (is_used(spring) && (changed || (turns_with_pose(spring) && is_active(world, spring)))) {
            make_map(world, spring);
        }
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        cairn_spring *spring = &pool->springs[i];
        if ((spring->flags & CAIRN_SPRING_HEAD) && is_active(world, spring)) {
            factorise(world, i);
        }
    }
}

/* ---- the sub-step ---- */

/* Add a velocity change to a body, and to the velocity that the warm start compares with. */
static void push(cairn_body *body, cairn_motion x, cairn_motion y, cairn_motion turn)
{
    if (is_free_to_shift(body)) {
        body->vx = cairn_motion_clamp(cairn_motion_add(body->vx, x), CAIRN_SWEEP_SPEED);
        body->vy = cairn_motion_clamp(cairn_motion_add(body->vy, y), CAIRN_SWEEP_SPEED);
        body->ux = cairn_motion_clamp(cairn_motion_add(body->ux, x), CAIRN_SWEEP_SPEED);
        body->uy = cairn_motion_clamp(cairn_motion_add(body->uy, y), CAIRN_SWEEP_SPEED);
    }
    if (turn != 0) {
        body->w = cairn_motion_clamp(cairn_motion_add(body->w, turn), CAIRN_SWEEP_SPIN);
        body->uw = cairn_motion_clamp(cairn_motion_add(body->uw, turn), CAIRN_SWEEP_SPIN);
    }
    body->flags |= CAIRN_BODY_HELD;
}

/* -(A u + B C), u the velocity of b relative to a along the spring but for the turning part */
static cairn_motion demand(const cairn_spring *spring, const cairn_body *a, const cairn_body *b, cairn_motion u, cairn_offset length)
{
    cairn_motion turning = cairn_motion_lever(b->w, spring->lever_b) - cairn_motion_lever(a->w, spring->lever_a);
    return -cairn_motion_add(cairn_motion_share(cairn_motion_add(u, turning), spring->velocity_gain),
                             cairn_motion_from_offset_wide(length - spring->rest_length, spring->position_gain));
}

/* The springs of a path, together. */
static void solve_path(cairn_world *world, uint16_t head)
{
    cairn_spring_pool *pool = world->springs;
    cairn_motion impulse = 0;
    uint16_t last = CAIRN_NONE;
    for (uint16_t i = head; i != CAIRN_NONE; i = pool->springs[i].next) {
        cairn_spring *spring = &pool->springs[i];
        const cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
        cairn_reach r;
        refresh_direction(spring, a, b, &r);
        cairn_motion u = cairn_motion_along(b->vx - a->vx, b->vy - a->vy, spring->direction_x, spring->direction_y);
        cairn_motion right = cairn_motion_factor(demand(spring, a, b, u, r.length), mass_of(world, spring));
        impulse = cairn_motion_factor(cairn_motion_add(right, -cairn_motion_factor(impulse, spring->before)), spring->inverse_pivot);
        spring->impulse = impulse;
        spring->previous = last;
        last = i;
    }
    impulse = 0;
    for (uint16_t i = last; i != CAIRN_NONE; i = pool->springs[i].previous) {
        cairn_spring *spring = &pool->springs[i];
        impulse = cairn_motion_add(spring->impulse, -cairn_motion_factor(impulse, spring->behind));
        cairn_motion of_a = -cairn_motion_share(impulse, spring->share_a), of_b = cairn_motion_share(impulse, spring->share_b);
        push(&world->bodies[spring->a], cairn_motion_dir(of_a, spring->direction_x), cairn_motion_dir(of_a, spring->direction_y),
             cairn_twist(of_a, spring->lever_a));
        push(&world->bodies[spring->b], cairn_motion_dir(of_b, spring->direction_x), cairn_motion_dir(of_b, spring->direction_y),
             cairn_twist(of_b, spring->lever_b));
    }
}

static cairn_motion along(const cairn_reach *r, cairn_motion x, cairn_motion y)
{
    return cairn_motion_add(cairn_motion_unit(x, r->x), cairn_motion_unit(y, r->y));
}

/* The relative acceleration by gravity alone, along the spring. */
static cairn_motion gravity_along(const cairn_world *world, const cairn_spring *spring, const cairn_reach *r)
{
    const cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
    cairn_motion g = along(r, world->gravity_x.whole, world->gravity_y.whole);
    cairn_motion of_a = spring->share_a == 0 ? 0 : cairn_motion_factor(g, cairn_factor_from_real(a->gravity_scale));
    cairn_motion of_b = spring->share_b == 0 ? 0 : cairn_motion_factor(g, cairn_factor_from_real(b->gravity_scale));
    return of_b - of_a;
}

/* An isolated spring by the exact map, with all the bits of its direction. */
static void solve_exactly(cairn_world *world, cairn_spring *spring)
{
    cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
    cairn_reach r;
    refresh_direction(spring, a, b, &r);
    cairn_motion gravity = gravity_along(world, spring, &r);
    cairn_motion impulse = cairn_motion_add(demand(spring, a, b, along(&r, b->vx - a->vx, b->vy - a->vy), r.length),
                                            cairn_motion_share(gravity, spring->gravity_gain));
    if (spring->flags & CAIRN_SPRING_FRESH) {
        /* Velocities are those of the middle of a sub-step from now on: half a kick leads there. */
        impulse = cairn_motion_half(impulse - gravity);
        spring->flags &= (uint8_t)~CAIRN_SPRING_FRESH;
    }
    impulse = cairn_motion_factor(impulse, mass_of(world, spring));
    cairn_motion of_a = -cairn_motion_share(impulse, spring->share_a), of_b = cairn_motion_share(impulse, spring->share_b);
    push(a, cairn_motion_unit(of_a, r.x), cairn_motion_unit(of_a, r.y), cairn_twist(of_a, spring->lever_a));
    push(b, cairn_motion_unit(of_b, r.x), cairn_motion_unit(of_b, r.y), cairn_twist(of_b, spring->lever_b));
}

void cairn_springs_substep(cairn_world *world, int substep)
{
    cairn_spring_pool *pool = world->springs;
    (void)substep;
    for (uint16_t i = 0; i < pool->end; i++) {
        cairn_spring *spring = &pool->springs[i];
        if (!(spring->flags & CAIRN_SPRING_HEAD) || !is_active(world, spring)) {
            continue;
        }
        if (spring->flags & CAIRN_SPRING_EXACT) {
            solve_exactly(world, spring);
        } else {
            solve_path(world, i);
        }
    }
}
