/* Springs: their pool and what the game may ask of them. How they pull is spring_solve.c's. */
#include "spring_solve.h"

/* m; a little less than an offset reaches. */
#define REST_LENGTH_MAX CAIRN_F(500)

/* ---- ids and the pool ---- */

static bool holds(const cairn_world *world, cairn_spring_id id)
{
    if (world == NULL || world->springs == NULL || id.index == 0 || id.index > world->springs->end) {
        return false;
    }
    const cairn_spring *spring = &world->springs->springs[id.index - 1];
    return (spring->flags & CAIRN_SPRING_USED) && spring->generation == id.generation;
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
            if (world->springs->springs[i].flags & CAIRN_SPRING_USED) {
                return id_of(world, i);
            }
        }
    }
    return cairn_spring_id_null();
}

/* ---- what the other stages ask ---- */

static bool is_between(const cairn_spring *spring, uint16_t a, uint16_t b)
{
    return (spring->flags & (CAIRN_SPRING_USED | CAIRN_SPRING_NO_CONTACT)) == (CAIRN_SPRING_USED | CAIRN_SPRING_NO_CONTACT)
        && ((spring->a == a && spring->b == b) || (spring->a == b && spring->b == a));
}

/* Pairs are asked for before the springs that have changed are sorted. */
static bool joined(const cairn_world *world, uint16_t a, uint16_t b)
{
    const cairn_spring_pool *pool = world->springs;
    uint16_t i = pool->changed ? 0 : cairn_spring_first_at(pool, a);
    while (i < pool->end && !is_between(&pool->springs[i], a, b)) {
        i = pool->changed ? (uint16_t)(i + 1) : cairn_spring_next_at(pool, a, i);
    }
    return i < pool->end;
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

static bool ends_at(const cairn_spring *spring, uint16_t body) { return (spring->flags & CAIRN_SPRING_USED) && (spring->a == body || spring->b == body); }

static void remove_body(cairn_world *world, uint16_t body)
{
    for (uint16_t i = 0; i < world->springs->end; i++) {
        cairn_spring *spring = &world->springs->springs[i];
        if (ends_at(spring, body)) {
            release(world, spring);
        }
    }
}

static void wake(cairn_world *world, uint16_t body)
{
    for (uint16_t i = 0; i < world->springs->end; i++) {
        const cairn_spring *spring = &world->springs->springs[i];
        if (ends_at(spring, body)) {
            cairn_body_wake_up(world, &world->bodies[spring->a == body ? spring->b : spring->a]);
        }
    }
}

static void link(cairn_world *world, void (*visit)(cairn_world *world, uint16_t a, uint16_t b))
{
    for (uint16_t i = 0; i < world->springs->end; i++) {
        const cairn_spring *spring = &world->springs->springs[i];
        if (spring->flags & CAIRN_SPRING_USED) {
            visit(world, spring->a, spring->b);
        }
    }
}

static const cairn_spring_class class_of_springs = { cairn_springs_prepare, cairn_springs_substep, joined, remove_body, wake, link };

/* ---- for the game ---- */

cairn_status cairn_springs_enable(cairn_world *world, const cairn_spring_storage *storage)
{
    if (world == NULL || storage == NULL || storage->pool == NULL || storage->springs == NULL) {
        return world == NULL ? CAIRN_ERROR_NULL : cairn_fail(world, CAIRN_ERROR_NULL);
    }
    if (world->locked) {
        return cairn_fail(world, CAIRN_ERROR_LOCKED);
    }
    if (!CAIRN_WITH_SPRINGS) {
        return cairn_fail(world, CAIRN_ERROR_KIND);
    }
    if (world->springs != NULL || storage->capacity == 0 || storage->capacity > 65000) {
        return cairn_fail(world, world->springs != NULL ? CAIRN_ERROR_KIND : CAIRN_ERROR_RANGE);
    }
    cairn_spring_pool *pool = storage->pool;
    pool->kind = &class_of_springs;
    pool->springs = storage->springs;
    pool->capacity = storage->capacity;
    pool->end = 0;
    pool->first = CAIRN_NONE;
    pool->mask = 0;
    pool->changed = true;
    pool->entangled = false;
    pool->mesh = NULL;
    world->springs = pool;
    return CAIRN_OK;
}

static bool is_amount_valid(cairn_wide amount) { return !cairn_wide_less(cairn_wide_from_int(1000000000), amount); }

/* As a spring keeps it; what is less than 2^-64 is nothing. */
static cairn_packed kept(cairn_wide amount)
{
    return cairn_wide_pack(cairn_wide_less(amount, cairn_wide_of(1, -64)) ? cairn_wide_zero() : amount);
}

static cairn_spring *take_place(cairn_spring_pool *pool)
{
    uint16_t place = 0;
    while (place < pool->end && (pool->springs[place].flags & CAIRN_SPRING_USED)) {
        place++;
    }
    if (place == pool->capacity) {
        return NULL;
    }
    uint16_t generation = place < pool->end ? pool->springs[place].generation : 1;
    pool->end = place == pool->end ? (uint16_t)(place + 1) : pool->end;
    cairn_clear(&pool->springs[place], sizeof *pool->springs);
    pool->springs[place].generation = generation;
    return &pool->springs[place];
}

static bool is_anchor_near(cairn_vec2 anchor)
{
    return cairn_real_is_within(anchor.x, CAIRN_SHAPE_RADIUS_MAX) && cairn_real_is_within(anchor.y, CAIRN_SHAPE_RADIUS_MAX);
}

static cairn_status check(cairn_world *world, const cairn_spring_def *def)
{
    if (def == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (world->locked) {
        return CAIRN_ERROR_LOCKED;
    }
    if (cairn_world_springs(world) == NULL) {
        return CAIRN_ERROR_KIND;
    }
    if (cairn_body_find(world, def->a) == NULL || cairn_body_find(world, def->b) == NULL) {
        return CAIRN_ERROR_STALE;
    }
    if (cairn_body_id_equal(def->a, def->b) || def->rest_length > REST_LENGTH_MAX || !is_amount_valid(def->stiffness)
        || !is_amount_valid(def->damping) || !is_anchor_near(def->anchor_a) || !is_anchor_near(def->anchor_b)) {
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
    if (body->model->shape->polygon != NULL) {
        result.x -= body->model->shape->polygon->centroid.x;
        result.y -= body->model->shape->polygon->centroid.y;
    }
    return result;
}

static bool is_centre(cairn_offset2 anchor) { return anchor.x == 0 && anchor.y == 0; }

/* Between steps: what bodies still know of the last one's displacements is done. */
static void measure(const cairn_world *world, const cairn_spring *spring, cairn_reach *r)
{
    cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
    a->dx = a->dy = a->dw = b->dx = b->dy = b->dw = 0;
    cairn_spring_measure(spring, a, b, r);
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
    spring->a = (uint16_t)(def->a.index - 1);
    spring->b = (uint16_t)(def->b.index - 1);
    spring->flags = (uint16_t)(CAIRN_SPRING_USED | CAIRN_SPRING_FRESH | (def->no_contact ? CAIRN_SPRING_NO_CONTACT : 0));
    spring->anchor_a = anchor_of(a, def->anchor_a);
    spring->anchor_b = anchor_of(b, def->anchor_b);
    if (!is_centre(spring->anchor_a) || !is_centre(spring->anchor_b)) {
        spring->flags |= CAIRN_SPRING_OFF_CENTRE;
    }
    spring->stiffness = kept(def->stiffness);
    spring->damping = kept(def->damping);
    cairn_reach r;
    measure(world, spring, &r);
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
    cairn_reach r;
    if (spring == NULL) {
        return 0;
    }
    measure(world, spring, &r);
    return cairn_real_from_offset(r.length);
}

cairn_status cairn_spring_set(cairn_world *world, cairn_spring_id id, cairn_real rest_length, cairn_wide stiffness, cairn_wide damping)
{
    cairn_status status;
    cairn_spring *spring = find_to_change(world, id, &status);
    if (spring == NULL) {
        return status;
    }
    if (rest_length < 0 || rest_length > REST_LENGTH_MAX || !is_amount_valid(stiffness) || !is_amount_valid(damping)) {
        return cairn_fail(world, CAIRN_ERROR_RANGE);
    }
    spring->rest_length = cairn_offset_from_real(rest_length);
    spring->stiffness = kept(stiffness);
    spring->damping = kept(damping);
    world->springs->changed = true;
    cairn_body_wake_up(world, &world->bodies[spring->a]);
    cairn_body_wake_up(world, &world->bodies[spring->b]);
    return CAIRN_OK;
}

cairn_status cairn_spring_anchors(cairn_world *world, cairn_spring_id id, cairn_vec2 *a, cairn_vec2 *b)
{
    cairn_status status;
    const cairn_spring *spring = find(world, id, &status);
    cairn_reach r;
    if (spring == NULL) {
        return status;
    }
    if (a == NULL || b == NULL) {
        return cairn_fail(world, CAIRN_ERROR_NULL);
    }
    measure(world, spring, &r);
    bool turned = (spring->flags & CAIRN_SPRING_TURNED) != 0;
    *(turned ? b : a) = cairn_body_point(&world->bodies[spring->a], r.arm_a.x, r.arm_a.y);
    *(turned ? a : b) = cairn_body_point(&world->bodies[spring->b], r.arm_b.x, r.arm_b.y);
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
    cairn_wide mass = cairn_bodies_reduced_mass(a, b);
    cairn_wide omega = cairn_wide_mul(cairn_wide_mul(cairn_wide_from_int(2), CAIRN_WIDE_PI), cairn_wide_from_real(frequency));
    cairn_wide impedance = cairn_wide_mul(mass, omega);
    def->stiffness = cairn_wide_mul(impedance, omega);
    def->damping = cairn_wide_mul(cairn_wide_mul(cairn_wide_from_int(2), cairn_wide_from_real(damping_ratio)), impedance);
    return CAIRN_OK;
}
