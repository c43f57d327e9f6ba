/* The world: its settings, and the step that calls the stages in their order. */
#include "engine.h"
#include <cairn/spring.h>

/* More than the greatest speed in a sub-step makes no difference, and sums of it would not be bounded. */
static cairn_diffused gravity_of(const cairn_world *world, cairn_real gravity, cairn_wide squared)
{
    cairn_diffused g = cairn_diffused_of(gravity, squared);
    g.whole = cairn_motion_clamp(g.whole, world->speed_limit);
    return g;
}

/* At most 0.035 m a sub-step, or 0.56 m a step of a solver without them: the limit of speed is higher. */
CAIRN_ONCE cairn_diffused first_gravity(cairn_real gravity)
{
    const cairn_wide squared = CAIRN_WIDE_SCALED(2443359174.0 / 4294967296, CAIRN_WITH_SOFT_SOLVER ? -15 : -11);
    return cairn_diffused_of_short(gravity, squared);
}

/* Powers of what the sub-step decides, of which its square is returned. */
static cairn_wide derive_any(cairn_world *world)
{
    cairn_wide per_second = cairn_wide_mul(cairn_wide_from_real(world->rate), cairn_wide_from_int(world->substeps));
    world->inverse_substep = per_second;
    world->substep = cairn_wide_inverse(per_second);
    world->rest_limit = cairn_motion_from_real(CAIRN_REST_SPEED, world->substep);
    world->rest_damping = cairn_ratio_from_wide(cairn_wide_inverse(cairn_wide_from_real(world->rate)));
    world->stick = cairn_ratio_from_wide(cairn_wide_inverse(cairn_wide_from_int(CAIRN_STICK_STEPS * world->substeps)));
    world->push_out_limit = cairn_motion_from_real(world->push_out, world->substep);
    /*
     * Within the biased pass a body holds v + beta d with d up to n v; that must stay below CAIRN_SWEEP_SPEED, and d
     * within its format.
     */
    static const cairn_wide most = CAIRN_SWEEP_SPEED_WIDE;
    cairn_wide lean = cairn_wide_of(64 + CAIRN_SOFT_BETA_64THS * world->substeps, -6); /* 1 + beta n */
    world->speed_limit = cairn_wide_to_motion(cairn_wide_div(most, lean));
    return cairn_wide_mul(world->substep, world->substep);
}

/* Call after any change of rate, sub-steps, gravity or push-out. */
static void derive(cairn_world *world)
{
    if (!CAIRN_WITH_SETTINGS) {
        world->gravity_x = first_gravity(world->gravity.x);
        world->gravity_y = first_gravity(world->gravity.y);
        return;
    }
    cairn_wide squared = derive_any(world);
    world->gravity_x = gravity_of(world, world->gravity.x, squared);
    world->gravity_y = gravity_of(world, world->gravity.y, squared);
}

/* Velocities and impulses are kept in sub-step units: bring them to a new sub-step. */
static void rescale(cairn_world *world, cairn_wide old)
{
    cairn_wide factor = cairn_wide_div(world->substep, old), squared = cairn_wide_mul(factor, factor);
    for (uint16_t i = 0; i < world->body_end; i++) {
        cairn_body *body = &world->bodies[i];
        body->vx = cairn_motion_scale(body->vx, factor);
        body->vy = cairn_motion_scale(body->vy, factor);
        body->w = cairn_motion_scale(body->w, factor);
        body->ux = cairn_motion_scale(body->ux, squared);
        body->uy = cairn_motion_scale(body->uy, squared);
        body->uw = cairn_motion_scale(body->uw, squared);
        cairn_body_limit_speed(world, body);
    }
    cairn_arbiters_scale_impulses(world, squared);
    if (cairn_world_springs(world) != NULL) {
        cairn_world_springs(world)->changed = true;
    }
}

/* The classes and the settings of the start, as far as the build has others. */
static void begin_with(cairn_world *world, const cairn_solver_class *solver, const cairn_continuous_class *continuous)
{
    if (CAIRN_SOLVER_COUNT > 1) {
        world->solver = solver;
    }
    if (CAIRN_WITH_CONTINUOUS) {
        world->continuous = continuous;
    }
    if (CAIRN_WITH_QUADTREE) {
        world->broad = &cairn_broad_pairs;
    }
    if (CAIRN_WITH_SETTINGS) {
        world->rate = CAIRN_F(60);
        world->push_out = CAIRN_F(3);
        world->passes = CAIRN_FIRST_PASSES;
        world->substeps = cairn_world_is_soft(world) ? 4 : 1;
    }
    if (!cairn_world_is_soft(world)) {
        world->slop = CAIRN_HARD_SLOP;
    }
}

static bool is_gravity_valid(cairn_vec2 gravity)
{
    return cairn_real_is_within(gravity.x, CAIRN_F(2000)) && cairn_real_is_within(gravity.y, CAIRN_F(2000));
}

cairn_world *cairn_world_init_with(const cairn_world_storage *storage, cairn_vec2 gravity, const cairn_solver_class *solver,
                                   const cairn_continuous_class *continuous)
{
    if (storage == NULL || storage->world == NULL || storage->bodies == NULL || storage->arbiters == NULL || storage->order == NULL
        || storage->swept == NULL || storage->sorted == NULL || solver == NULL || storage->body_capacity == 0 || storage->arbiter_capacity == 0
        || storage->body_capacity > 65000 || storage->arbiter_capacity > 65000 || (!CAIRN_WITH_CONTINUOUS && continuous != NULL)
        || !cairn_solver_is_known(solver)) {
        return NULL;
    }
    cairn_world *world = storage->world;
    cairn_clear(world, sizeof *world);
    world->bodies = storage->bodies;
    world->arbiters = storage->arbiters;
    world->order = storage->order;
    if (CAIRN_HAS_WAYS) {
        world->swept = storage->swept;
    }
    if (CAIRN_WITH_SORT) {
        world->sorted = storage->sorted;
    }
    world->body_capacity = storage->body_capacity;
    world->body_free = CAIRN_NONE;
    world->arbiter_capacity = storage->arbiter_capacity;
    if (CAIRN_WITH_SHORTCUTS) {
        world->first_found = CAIRN_NONE;
        world->expected = &world->first_found;
    }
    for (uint16_t i = 0; i < world->arbiter_capacity; i++) {
        world->order[i] = i;
    }
    begin_with(world, solver, continuous);
    if (!is_gravity_valid(gravity)) {
        cairn_fail(world, CAIRN_ERROR_RANGE);
        return NULL;
    }
    world->gravity = gravity;
    derive(world);
    return world;
}

static void find_pairs(cairn_world *world)
{
    uint32_t dropped = world->stats.dropped;
    cairn_world_broad(world)->find_pairs(world);
    if (cairn_world_sleep(world) != NULL && cairn_world_sleep(world)->wake(world)) {
        world->stats.pairs = 0;
        world->stats.looked = 0;
        world->stats.dropped = dropped;
        cairn_world_broad(world)->find_pairs(world); /* what woke has pairs of its own */
    }
}

/* Nothing moved in the step before, and nothing has woken since: nothing will happen. */
static bool is_all_asleep(const cairn_world *world)
{
    if (cairn_world_sleep(world) == NULL || world->stats.awake != 0) {
        return false;
    }
    for (uint16_t i = 0; i < world->body_end; i++) {
        if (cairn_body_is_stirring(&world->bodies[i])) {
            return false;
        }
    }
    return true;
}

cairn_status cairn_world_step(cairn_world *world)
{
    if (world == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (world->locked) {
        return cairn_fail(world, CAIRN_ERROR_LOCKED);
    }
    world->stats.steps++;
    world->stats.pairs = 0;
    world->stats.points = 0;
    world->stats.looked = 0;
    world->stats.solved = 0;
    world->stats.moved = 0;
    if (is_all_asleep(world)) {
        return CAIRN_OK;
    }
    if (cairn_world_sleep(world) != NULL) {
        cairn_world_sleep(world)->wake(world);
    }
    cairn_bodies_look_ahead(world);
    cairn_arbiters_begin(world);
    find_pairs(world);
    if (CAIRN_WITH_SHORTCUTS) {
        cairn_arbiters_rouse(world);
    }
    cairn_bodies_end_search(world);
    cairn_arbiters_sweep(world);
    world->stats.arbiters = world->arbiter_count;
    if (world->stats.awake != 0) {
        cairn_world_solver(world)->solve(world);
    }
    if (cairn_world_fast(world) != 0) {
        cairn_world_continuous(world)->clip(world);
    }
    cairn_bodies_finish(world);
    if (cairn_world_sleep(world) != NULL) {
        cairn_world_sleep(world)->settle(world);
    }
    return CAIRN_OK;
}

cairn_status cairn_world_error(cairn_world *world)
{
    if (world == NULL) {
        return CAIRN_ERROR_NULL;
    }
    cairn_status status = (cairn_status)world->error;
    world->error = CAIRN_OK;
    return status;
}

const cairn_world_stats *cairn_world_get_stats(const cairn_world *world) { return world == NULL ? NULL : &world->stats; }

/* ---- settings ---- */

static cairn_status may_set(cairn_world *world, bool in_range)
{
    if (world == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (world->locked) {
        return cairn_fail(world, CAIRN_ERROR_LOCKED);
    }
    return in_range ? CAIRN_OK : cairn_fail(world, CAIRN_ERROR_RANGE);
}

/* The same for what some builds cannot change, unless it is as it was. */
static cairn_status may_change(cairn_world *world, bool in_range, bool as_before)
{
    cairn_status status = may_set(world, in_range);
    return status == CAIRN_OK && !CAIRN_WITH_SETTINGS && !as_before ? cairn_fail(world, CAIRN_ERROR_KIND) : status;
}

cairn_status cairn_world_set_gravity(cairn_world *world, cairn_vec2 gravity)
{
    cairn_status status = may_set(world, is_gravity_valid(gravity));
    if (status == CAIRN_OK) {
        world->gravity = gravity;
        derive(world);
        for (uint16_t i = 0; CAIRN_WITH_SLEEP && i < world->body_end; i++) {
            cairn_body_wake_up(world, &world->bodies[i]);
        }
    }
    return status;
}

cairn_status cairn_world_set_rate(cairn_world *world, cairn_real steps_per_second)
{
    cairn_status status = may_change(world, steps_per_second >= CAIRN_F(10) && steps_per_second <= CAIRN_F(2000), steps_per_second == CAIRN_F(60));
    if (CAIRN_WITH_SETTINGS && status == CAIRN_OK) {
        cairn_wide old = world->substep;
        world->rate = steps_per_second;
        derive(world);
        rescale(world, old);
    }
    return status;
}

cairn_status cairn_world_set_substeps(cairn_world *world, int substeps)
{
    cairn_status status = may_change(world, substeps >= 1 && substeps <= 16, substeps == CAIRN_FIRST_SUBSTEPS);
    if (status == CAIRN_OK && substeps > 1 && !cairn_world_is_soft(world)) {
        return cairn_fail(world, CAIRN_ERROR_KIND);
    }
    if (CAIRN_WITH_SETTINGS && status == CAIRN_OK) {
        cairn_wide old = world->substep;
        world->substeps = (uint8_t)substeps;
        derive(world);
        rescale(world, old);
    }
    return status;
}

cairn_status cairn_world_set_slop(cairn_world *world, cairn_real slop)
{
    cairn_status status = may_set(world, slop >= 0 && slop <= CAIRN_F(0.1));
    if (status == CAIRN_OK) {
        world->slop = slop;
    }
    return status;
}

cairn_status cairn_world_set_push_out(cairn_world *world, cairn_real speed)
{
    cairn_status status = may_change(world, speed >= 0 && speed <= CAIRN_F(100), speed == CAIRN_F(3));
    if (CAIRN_WITH_SETTINGS && status == CAIRN_OK) {
        world->push_out = speed;
        derive(world);
    }
    return status;
}

cairn_real cairn_world_speed_limit(const cairn_world *world)
{
    return world == NULL ? 0 : cairn_real_from_motion(cairn_world_most_speed(world), cairn_world_inverse_substep(world));
}
