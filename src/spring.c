/*
 * Springs, solved once in every sub-step after the velocities are integrated; velocities in sub-step units.
 *
 * With u the velocity along the spring, C its elongation, e the effective mass over the reduced mass,
 * b = k h^2 (1/mA + 1/mB) / e and d = c h (1/mA + 1/mB) / e, an impulse of e (A u + B C) is taken off:
 * - an isolated spring (each dynamic end carries one, b below 0.2) by the exact map of the damped oscillator,
 *   A = 1 - det M and B = 1 + det M - tr M with M = exp((0, 1), (-b, -d));
 * - any other by implicit Euler, A = (d + b) / (1 + d + b) and B = b / (1 + d + b), bounded for any stiffness.
 * The impulse is kept out of the warm start (it goes into u as well as v): an unconverged network must not be repeated.
 */
#include "engine.h"
#include <cairn/spring.h>

enum { USED = 1, NO_CONTACT = 2, FRESH = 4, EXACT = 8 };

/* Beyond this stiffness a spring is a rod: more would only lose bits. */
#define STIFFNESS_MAX cairn_wide_from_int(4096)

/* ---- ids and the pool ---- */

static bool holds(const cairn_world *world, cairn_spring_id id)
{
    if (world == NULL || world->springs == NULL || id.index == 0 || id.index > world->springs->end) {
        return false;
    }
    const cairn_spring *spring = &world->springs->springs[id.index - 1];
    return (spring->flags & USED) && spring->generation == id.generation;
}

static cairn_spring *find(cairn_world *world, cairn_spring_id id, cairn_status *status)
{
    if (world == NULL) {
        *status = CAIRN_ERROR_NULL;
        return NULL;
    }
    if (!holds(world, id)) {
        *status = cairn_fail(world, CAIRN_ERROR_STALE);
        return NULL;
    }
    *status = CAIRN_OK;
    return &world->springs->springs[id.index - 1];
}

static cairn_spring *find_to_change(cairn_world *world, cairn_spring_id id, cairn_status *status)
{
    cairn_spring *spring = find(world, id, status);
    if (spring != NULL && world->locked) {
        *status = cairn_fail(world, CAIRN_ERROR_LOCKED);
        return NULL;
    }
    return spring;
}

bool cairn_spring_exists(const cairn_world *world, cairn_spring_id id) { return holds(world, id); }

static cairn_spring_id id_of(const cairn_world *world, uint16_t place)
{
    cairn_spring_id id;
    id.index = (uint16_t)(place + 1);
    id.generation = world->springs->springs[place].generation;
    return id;
}

cairn_spring_id cairn_world_next_spring(const cairn_world *world, cairn_spring_id id)
{
    if (world != NULL && world->springs != NULL) {
        for (uint16_t i = id.index; i < world->springs->end; i++) {
            if (world->springs->springs[i].flags & USED) {
                return id_of(world, i);
            }
        }
    }
    return cairn_spring_id_null();
}

/* ---- geometry ---- */

typedef struct reach {
    cairn_offset2 arm_a, arm_b; /* from the centres of mass, in the world */
    cairn_unit x, y;            /* direction from the anchor of a to that of b */
    cairn_offset length;
} reach;

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

/* Where the spring is, displacements of this step included (they are zero between steps for what this serves). */
static void measure(const cairn_spring *spring, const cairn_body *a, const cairn_body *b, reach *r)
{
    r->arm_a = moved_arm(a, spring->anchor_a.x, spring->anchor_a.y);
    r->arm_b = moved_arm(b, spring->anchor_b.x, spring->anchor_b.y);
    cairn_offset x = cairn_coordinate_offset(a->x, a->x_residue, b->x, b->x_residue) + cairn_offset_from_motion(b->dx)
                   - cairn_offset_from_motion(a->dx);
    cairn_offset y = cairn_coordinate_offset(a->y, a->y_residue, b->y, b->y_residue) + cairn_offset_from_motion(b->dy)
                   - cairn_offset_from_motion(a->dy);
    r->length = cairn_unit_along(x + r->arm_b.x - r->arm_a.x, y + r->arm_b.y - r->arm_a.y, &r->x, &r->y);
}

/* (r x n) / rho */
static cairn_lever lever_of(const cairn_body *body, cairn_offset2 arm, const reach *r)
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
    spring->flags |= EXACT;
}

static void map_implicitly(cairn_spring *spring, cairn_wide b, cairn_wide d)
{
    cairn_wide sum = cairn_wide_add(b, d), whole = cairn_wide_add(cairn_wide_from_int(1), sum);
    spring->velocity_gain = cairn_wide_to_share(cairn_wide_div(sum, whole));
    spring->position_gain = cairn_wide_div(b, whole);
    spring->gravity_gain = 0;
    spring->flags &= (uint8_t)~EXACT;
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
        reach r;
        measure(spring, a, b, &r);
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

/* Which bodies carry a spring, more than one, one that takes away contact. */
static void count_ends(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    for (uint16_t i = 0; i < world->body_end; i++) {
        world->bodies[i].flags &= (uint16_t)~(CAIRN_BODY_SPRING | CAIRN_BODY_SPRINGS | CAIRN_BODY_SPRUNG);
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        const cairn_spring *spring = &pool->springs[i];
        if (!(spring->flags & USED)) {
            continue;
        }
        cairn_body *ends[2] = { &world->bodies[spring->a], &world->bodies[spring->b] };
        for (int k = 0; k < 2; k++) {
            unsigned more = ends[k]->flags & CAIRN_BODY_SPRING ? CAIRN_BODY_SPRINGS : CAIRN_BODY_SPRING;
            unsigned sprung = cairn_flag_if((spring->flags & NO_CONTACT) != 0, CAIRN_BODY_SPRUNG);
            ends[k]->flags = (uint16_t)(ends[k]->flags | more | sprung);
        }
    }
}

static bool turns_with_pose(const cairn_spring *spring)
{
    return spring->anchor_a.x != 0 || spring->anchor_a.y != 0 || spring->anchor_b.x != 0 || spring->anchor_b.y != 0;
}

static void prepare(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    if (pool->changed) {
        count_ends(world);
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        cairn_spring *spring = &pool->springs[i];
        if ((spring->flags & USED) && (pool->changed || turns_with_pose(spring))) {
            make_map(world, spring);
        }
    }
    pool->changed = false;
}

/* ---- the sub-step ---- */

static void pull(cairn_body *body, const reach *r, cairn_motion impulse, cairn_lever lever)
{
    if (is_free_to_shift(body)) {
        cairn_motion x = cairn_motion_unit(impulse, r->x), y = cairn_motion_unit(impulse, r->y);
        body->vx = cairn_motion_clamp(cairn_motion_add(body->vx, x), CAIRN_SWEEP_SPEED);
        body->vy = cairn_motion_clamp(cairn_motion_add(body->vy, y), CAIRN_SWEEP_SPEED);
        body->ux = cairn_motion_clamp(cairn_motion_add(body->ux, x), CAIRN_SWEEP_SPEED);
        body->uy = cairn_motion_clamp(cairn_motion_add(body->uy, y), CAIRN_SWEEP_SPEED);
    }
    cairn_motion turn = cairn_motion_lever(impulse, lever);
    body->w = cairn_motion_clamp(cairn_motion_add(body->w, turn), CAIRN_SWEEP_SPIN);
    body->uw = cairn_motion_clamp(cairn_motion_add(body->uw, turn), CAIRN_SWEEP_SPIN);
}

static cairn_motion along(const reach *r, cairn_motion x, cairn_motion y)
{
    return cairn_motion_add(cairn_motion_unit(x, r->x), cairn_motion_unit(y, r->y));
}

/* The relative acceleration by gravity alone, along the spring. */
static cairn_motion gravity_along(const cairn_world *world, const cairn_spring *spring, const cairn_body *a, const cairn_body *b, const reach *r)
{
    cairn_motion g = along(r, world->gravity_x.whole, world->gravity_y.whole);
    cairn_motion of_a = spring->share_a == 0 ? 0 : cairn_motion_factor(g, cairn_factor_from_real(a->gravity_scale));
    cairn_motion of_b = spring->share_b == 0 ? 0 : cairn_motion_factor(g, cairn_factor_from_real(b->gravity_scale));
    return of_b - of_a;
}

static void solve_spring(cairn_world *world, cairn_spring *spring)
{
    cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
    reach r;
    measure(spring, a, b, &r);
    cairn_lever ja = lever_of(a, r.arm_a, &r), jb = lever_of(b, r.arm_b, &r);
    cairn_motion velocity = cairn_motion_add(along(&r, b->vx - a->vx, b->vy - a->vy),
                                             cairn_motion_lever(b->w, jb) - cairn_motion_lever(a->w, ja));
    cairn_motion impulse = -cairn_motion_add(cairn_motion_share(velocity, spring->velocity_gain),
                                             cairn_motion_from_offset_wide(r.length - spring->rest_length, spring->position_gain));
    if (spring->flags & EXACT) {
        cairn_motion gravity = gravity_along(world, spring, a, b, &r);
        impulse = cairn_motion_add(impulse, cairn_motion_share(gravity, spring->gravity_gain));
        if (spring->flags & FRESH) {
            /* Velocities are those of the middle of a sub-step from now on: half a kick leads there. */
            impulse = cairn_motion_half(impulse - gravity);
        }
    }
    if (ja != 0 || jb != 0) {
        impulse = cairn_motion_ratio(impulse, cairn_factor_inverse(stiffening(spring, a, b, ja, jb)));
    }
    spring->flags &= (uint8_t)~FRESH;
    a->flags |= CAIRN_BODY_HELD;
    b->flags |= CAIRN_BODY_HELD;
    pull(a, &r, -cairn_motion_share(impulse, spring->share_a), ja);
    pull(b, &r, cairn_motion_share(impulse, spring->share_b), jb);
}

static void substep(cairn_world *world, int k)
{
    cairn_spring_pool *pool = world->springs;
    (void)k;
    for (uint16_t i = 0; i < pool->end; i++) {
        cairn_spring *spring = &pool->springs[i];
        if ((spring->flags & USED) && (cairn_body_is_active(&world->bodies[spring->a]) || cairn_body_is_active(&world->bodies[spring->b]))) {
            solve_spring(world, spring);
        }
    }
}

/* ---- what the other stages ask ---- */

static bool joined(const cairn_world *world, uint16_t a, uint16_t b)
{
    const cairn_spring_pool *pool = world->springs;
    for (uint16_t i = 0; i < pool->end; i++) {
        const cairn_spring *spring = &pool->springs[i];
        if ((spring->flags & (USED | NO_CONTACT)) == (USED | NO_CONTACT)
            && ((spring->a == a && spring->b == b) || (spring->a == b && spring->b == a))) {
            return true;
        }
    }
    return false;
}

static void release(cairn_world *world, cairn_spring *spring)
{
    cairn_body_wake_up(world, &world->bodies[spring->a]);
    cairn_body_wake_up(world, &world->bodies[spring->b]);
    spring->flags = 0;
    spring->generation = (uint16_t)(spring->generation == UINT16_MAX ? 1 : spring->generation + 1);
    world->stats.springs--;
    world->springs->changed = true;
}

static void remove_body(cairn_world *world, uint16_t body)
{
    for (uint16_t i = 0; i < world->springs->end; i++) {
        cairn_spring *spring = &world->springs->springs[i];
        if ((spring->flags & USED) && (spring->a == body || spring->b == body)) {
            release(world, spring);
        }
    }
}

static void link(cairn_world *world, void (*visit)(cairn_world *world, uint16_t a, uint16_t b))
{
    for (uint16_t i = 0; i < world->springs->end; i++) {
        const cairn_spring *spring = &world->springs->springs[i];
        if (spring->flags & USED) {
            visit(world, spring->a, spring->b);
        }
    }
}

static const cairn_spring_class class_of_springs = { prepare, substep, joined, remove_body, link };

/* ---- for the game ---- */

cairn_status cairn_springs_enable(cairn_world *world, const cairn_spring_storage *storage)
{
    if (world == NULL || storage == NULL || storage->pool == NULL || storage->springs == NULL) {
        return world == NULL ? CAIRN_ERROR_NULL : cairn_fail(world, CAIRN_ERROR_NULL);
    }
    if (world->springs != NULL || storage->capacity == 0 || storage->capacity > 65000) {
        return cairn_fail(world, world->springs != NULL ? CAIRN_ERROR_KIND : CAIRN_ERROR_RANGE);
    }
    cairn_spring_pool *pool = storage->pool;
    pool->kind = &class_of_springs;
    pool->springs = storage->springs;
    pool->capacity = storage->capacity;
    pool->end = 0;
    pool->changed = true;
    world->springs = pool;
    return CAIRN_OK;
}

static bool is_amount_valid(cairn_wide amount) { return !cairn_wide_less(cairn_wide_from_int(1000000000), amount); }

static cairn_spring *take_place(cairn_spring_pool *pool)
{
    uint16_t place = 0;
    while (place < pool->end && (pool->springs[place].flags & USED)) {
        place++;
    }
    if (place == pool->capacity) {
        return NULL;
    }
    uint16_t generation = place < pool->end ? pool->springs[place].generation : 1;
    pool->end = place == pool->end ? (uint16_t)(place + 1) : pool->end;
    memset(&pool->springs[place], 0, sizeof *pool->springs);
    pool->springs[place].generation = generation;
    return &pool->springs[place];
}

static cairn_status check(cairn_world *world, const cairn_spring_def *def)
{
    if (def == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (world->locked) {
        return CAIRN_ERROR_LOCKED;
    }
    if (world->springs == NULL) {
        return CAIRN_ERROR_KIND;
    }
    if (cairn_body_find(world, def->a) == NULL || cairn_body_find(world, def->b) == NULL) {
        return CAIRN_ERROR_STALE;
    }
    cairn_real far = CAIRN_SHAPE_RADIUS_MAX;
    if (cairn_body_id_equal(def->a, def->b) || def->rest_length > 2 * far || !is_amount_valid(def->stiffness)
        || !is_amount_valid(def->damping) || def->anchor_a.x > far || def->anchor_a.x < -far || def->anchor_a.y > far
        || def->anchor_a.y < -far || def->anchor_b.x > far || def->anchor_b.x < -far || def->anchor_b.y > far || def->anchor_b.y < -far) {
        return CAIRN_ERROR_RANGE;
    }
    return CAIRN_OK;
}

/* An anchor relative to the centre of mass. */
static cairn_offset2 anchor_of(const cairn_body *body, cairn_vec2 anchor)
{
    cairn_offset2 result;
    result.x = cairn_offset_from_real(anchor.x);
    result.y = cairn_offset_from_real(anchor.y);
    if (body->shape->polygon != NULL) {
        result.x -= body->shape->polygon->centroid.x;
        result.y -= body->shape->polygon->centroid.y;
    }
    return result;
}

static void measure_at_rest(const cairn_world *world, const cairn_spring *spring, reach *r)
{
    cairn_body a = world->bodies[spring->a], b = world->bodies[spring->b];
    a.dx = a.dy = a.dw = 0;
    b.dx = b.dy = b.dw = 0;
    measure(spring, &a, &b, r);
}

cairn_spring_id cairn_spring_create(cairn_world *world, const cairn_spring_def *def)
{
    if (world == NULL) {
        return cairn_spring_id_null();
    }
    cairn_status status = check(world, def);
    cairn_spring *spring = status == CAIRN_OK ? take_place(world->springs) : NULL;
    if (spring == NULL) {
        cairn_fail(world, status == CAIRN_OK ? CAIRN_ERROR_FULL : status);
        return cairn_spring_id_null();
    }
    cairn_body *a = cairn_body_find(world, def->a), *b = cairn_body_find(world, def->b);
    cairn_offset2 anchor_a = anchor_of(a, def->anchor_a), anchor_b = anchor_of(b, def->anchor_b);
    spring->a = (uint16_t)(def->a.index - 1);
    spring->b = (uint16_t)(def->b.index - 1);
    spring->flags = (uint8_t)(USED | FRESH | (def->no_contact ? NO_CONTACT : 0));
    spring->anchor_a.x = anchor_a.x;
    spring->anchor_a.y = anchor_a.y;
    spring->anchor_b.x = anchor_b.x;
    spring->anchor_b.y = anchor_b.y;
    spring->stiffness = def->stiffness;
    spring->damping = def->damping;
    reach r;
    measure_at_rest(world, spring, &r);
    spring->rest_length = def->rest_length < 0 ? r.length : cairn_offset_from_real(def->rest_length);
    if (def->no_contact) {
        a->flags |= CAIRN_BODY_SPRUNG;
        b->flags |= CAIRN_BODY_SPRUNG;
    }
    cairn_body_wake_up(world, a);
    cairn_body_wake_up(world, b);
    world->springs->changed = true;
    world->stats.springs++;
    return id_of(world, (uint16_t)(spring - world->springs->springs));
}

cairn_status cairn_spring_destroy(cairn_world *world, cairn_spring_id id)
{
    cairn_status status;
    cairn_spring *spring = find_to_change(world, id, &status);
    if (spring != NULL) {
        release(world, spring);
    }
    return status;
}

cairn_real cairn_spring_length(cairn_world *world, cairn_spring_id id)
{
    cairn_status status;
    const cairn_spring *spring = find(world, id, &status);
    reach r;
    if (spring == NULL) {
        return 0;
    }
    measure_at_rest(world, spring, &r);
    return cairn_real_from_offset(r.length);
}

cairn_status cairn_spring_set(cairn_world *world, cairn_spring_id id, cairn_real rest_length, cairn_wide stiffness, cairn_wide damping)
{
    cairn_status status;
    cairn_spring *spring = find_to_change(world, id, &status);
    if (spring == NULL) {
        return status;
    }
    if (rest_length < 0 || rest_length > 2 * CAIRN_SHAPE_RADIUS_MAX || !is_amount_valid(stiffness) || !is_amount_valid(damping)) {
        return cairn_fail(world, CAIRN_ERROR_RANGE);
    }
    spring->rest_length = cairn_offset_from_real(rest_length);
    spring->stiffness = stiffness;
    spring->damping = damping;
    world->springs->changed = true;
    cairn_body_wake_up(world, &world->bodies[spring->a]);
    cairn_body_wake_up(world, &world->bodies[spring->b]);
    return CAIRN_OK;
}

static cairn_vec2 anchor_at(const cairn_body *body, cairn_offset2 arm)
{
    cairn_real x = body->x, y = body->y;
    cairn_residue rx = body->x_residue, ry = body->y_residue;
    cairn_coordinate_shift(&x, &rx, arm.x);
    cairn_coordinate_shift(&y, &ry, arm.y);
    return cairn_vec2_of(cairn_coordinate_round(x, rx), cairn_coordinate_round(y, ry));
}

cairn_status cairn_spring_anchors(cairn_world *world, cairn_spring_id id, cairn_vec2 *a, cairn_vec2 *b)
{
    cairn_status status;
    const cairn_spring *spring = find(world, id, &status);
    reach r;
    if (spring == NULL) {
        return status;
    }
    if (a == NULL || b == NULL) {
        return cairn_fail(world, CAIRN_ERROR_NULL);
    }
    measure_at_rest(world, spring, &r);
    *a = anchor_at(&world->bodies[spring->a], r.arm_a);
    *b = anchor_at(&world->bodies[spring->b], r.arm_b);
    return CAIRN_OK;
}

/* k = m (2 pi f)^2, c = 2 zeta m (2 pi f), with m the reduced mass */
cairn_status cairn_spring_tune(cairn_world *world, cairn_spring_def *def, cairn_real frequency, cairn_real damping_ratio)
{
    if (world == NULL || def == NULL) {
        return world == NULL ? CAIRN_ERROR_NULL : cairn_fail(world, CAIRN_ERROR_NULL);
    }
    const cairn_body *a = cairn_body_find(world, def->a), *b = cairn_body_find(world, def->b);
    if (a == NULL || b == NULL) {
        return CAIRN_ERROR_STALE;
    }
    if (frequency <= 0 || frequency > CAIRN_F(1000) || damping_ratio < 0 || damping_ratio > CAIRN_F(100)) {
        return cairn_fail(world, CAIRN_ERROR_RANGE);
    }
    if (!cairn_body_is_dynamic(a) && !cairn_body_is_dynamic(b)) {
        return cairn_fail(world, CAIRN_ERROR_KIND);
    }
    cairn_wide mass = !cairn_body_is_dynamic(a) ? b->mass : !cairn_body_is_dynamic(b) ? a->mass
                    : cairn_wide_div(cairn_wide_mul(a->mass, b->mass), cairn_wide_add(a->mass, b->mass));
    cairn_wide omega = cairn_wide_mul(cairn_wide_mul(cairn_wide_from_int(2), CAIRN_WIDE_PI), cairn_wide_from_real(frequency));
    cairn_wide impedance = cairn_wide_mul(mass, omega);
    def->stiffness = cairn_wide_mul(impedance, omega);
    def->damping = cairn_wide_mul(cairn_wide_mul(cairn_wide_from_int(2), cairn_wide_from_real(damping_ratio)), impedance);
    return CAIRN_OK;
}
