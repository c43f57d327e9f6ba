/*
 * Sequential impulses over the whole step: k passes with accumulated clamping and Baumgarte's bias, restitution as a bias of its own. It is the slides'
 * scheme (cairn_solver_slides), and the small one (cairn_solver_small) besides, which begins with the impulses of the step before and lets nothing
 * in flight come nearer in a step than it is. Rows are those of the soft solver, with h = dt; of the corrections to the motion that come with that
 * solver (motion.c, hold.c, slide.c) there are none, so that a build can do without them.
 */
#include "engine.h"
#include <cairn/block.h>
#include <cairn/spring.h>

/* What impulses may change by when passes end: 2^-23 m a step, 7e-6 m/s. */
#define SOLVED CAIRN_MOTION(1.0 / 8388608)

/* A row: the line that it acts along, and how it turns the two bodies. */
typedef struct line {
    const cairn_arbiter *arbiter;
    cairn_body *body[2];
    cairn_dir x, y;
    cairn_lever lever[2];
    cairn_size changed; /* by how much impulses have in this pass */
} line;

CAIRN_ONCE void set_line(line *l, const cairn_world *world, const cairn_arbiter *arbiter)
{
    l->arbiter = arbiter;
    l->body[0] = &world->bodies[arbiter->a];
    l->body[1] = &world->bodies[arbiter->b];
    l->x = arbiter->normal_x;
    l->y = arbiter->normal_y;
}

static void take_levers(line *l, const cairn_row *row)
{
    l->lever[0] = row->lever_a;
    l->lever[1] = row->lever_b;
}

/* Of b against a along it; at most 7.9 m. */
CAIRN_ONCE cairn_motion velocity(const line *l)
{
    const cairn_body *a = l->body[0], *b = l->body[1];
    cairn_motion u = cairn_motion_along(b->vx - a->vx, b->vy - a->vy, l->x, l->y);
    return CAIRN_WITH_TURNING ? u + cairn_motion_lever(b->w, l->lever[1]) - cairn_motion_lever(a->w, l->lever[0]) : u;
}

CAIRN_ONCE void push(const line *l, int side, cairn_motion by)
{
    cairn_body *body = l->body[side];
    if (CAIRN_WITH_TURNING) {
        body->w = cairn_motion_clamp(body->w + cairn_motion_lever(by, l->lever[side]), CAIRN_SWEEP_SPIN);
    }
    if (!cairn_body_is_fixed(body)) {
        body->vx = cairn_motion_clamp(body->vx + cairn_motion_dir(by, l->x), CAIRN_SWEEP_SPEED);
        body->vy = cairn_motion_clamp(body->vy + cairn_motion_dir(by, l->y), CAIRN_SWEEP_SPEED);
    }
}

/* The row's accumulated impulse becomes this one. */
CAIRN_ONCE void press(line *l, cairn_motion *impulse, cairn_motion to)
{
    cairn_motion change = to - *impulse;
    *impulse = to;
    if (change == 0) {
        return;
    }
    l->changed = cairn_size_with(l->changed, change);
    push(l, 0, -cairn_motion_share(change, l->arbiter->share_a));
    push(l, 1, cairn_motion_share(change, cairn_arbiter_share_b(l->arbiter)));
}

/* With what it would stop a velocity. Beside pivots masses are up to 2, and there is room for that of what is not out of all bounds. */
static cairn_motion stopping(cairn_motion impulse, cairn_motion u, cairn_ratio mass)
{
    if (CAIRN_WITH_FIXED_POSITION && mass > CAIRN_RATIO(1)) {
        u = cairn_motion_clamp(u, CAIRN_MOTION(3.9));
    }
    return cairn_motion_add(impulse, -cairn_motion_ratio(u, mass));
}

/* Within Coulomb's cone: what is beyond the static one slides by the kinetic one. */
static cairn_motion rubbing(const cairn_world *world, const cairn_arbiter *arbiter, cairn_motion impulse)
{
    cairn_motion pressure = cairn_arbiter_pressure(arbiter);
    if (!cairn_motion_is_within(impulse, cairn_motion_factor(pressure, cairn_arbiter_static_friction(world, arbiter)))) {
        impulse = cairn_motion_clamp(impulse, cairn_motion_factor(pressure, arbiter->kinetic_friction));
    }
    return cairn_motion_clamp(impulse, CAIRN_IMPULSE_MAX);
}

/* One pass over a contact. The one before all others only gives the bodies what it has kept from the step before. */
static void solve_contact(cairn_world *world, cairn_arbiter *arbiter, line *l, int k)
{
    bool starts = k == cairn_world_passes(world);
    set_line(l, world, arbiter);
    for (int i = 0; i < cairn_arbiter_points(arbiter); i++) {
        cairn_row *row = &arbiter->rows[(i ^ k) & (cairn_arbiter_points(arbiter) - 1)];
        cairn_motion to = cairn_world_starts_warm(world) ? row->impulse : 0;
        take_levers(l, row);
        if (starts) {
            row->impulse = 0;
        } else if (row->gap <= 0 || cairn_world_starts_warm(world)) {
            to = stopping(row->impulse, cairn_motion_add(velocity(l), row->gap), row->mass);
            to = cairn_motion_above_zero(to, CAIRN_IMPULSE_MAX);
        }
        press(l, &row->impulse, to);
    }
    if (CAIRN_WITH_FRICTION) {
        cairn_motion to = cairn_world_starts_warm(world) ? arbiter->friction_impulse : 0;
        l->x = cairn_dir_negate(arbiter->normal_y);
        l->y = arbiter->normal_x;
        l->lever[0] = arbiter->friction_lever_a;
        l->lever[1] = arbiter->friction_lever_b;
        if (starts) {
            arbiter->friction_impulse = 0;
        } else {
            to = rubbing(world, arbiter, stopping(arbiter->friction_impulse, velocity(l), arbiter->friction_mass));
        }
        press(l, &arbiter->friction_impulse, to);
    }
}

/* All contacts once. False if they are solved: no impulse has changed by more than rounding does. */
static bool pass(cairn_world *world, int k)
{
    line l;
    l.changed = 0;
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (arbiter->flags & CAIRN_ARBITER_SOLVED) {
            solve_contact(world, arbiter, &l, k);
        }
    }
    return !cairn_size_is_below(l.changed, SOLVED);
}

static cairn_motion magnitude(cairn_motion x) { return x < 0 ? -x : x; }

/* What gravity gives a body along it in a step. */
static cairn_motion pull_of(const cairn_world *world, const cairn_body *body, const line *l)
{
    return cairn_motion_along(cairn_body_gravity(world, world->gravity_x.whole, body), cairn_body_gravity(world, world->gravity_y.whole, body), l->x, l->y);
}

/* Does the pair rebound from an approach at u? By the smaller threshold of those of its materials that bounce. */
static bool rebounds(const cairn_world *world, const cairn_material *a, const cairn_material *b, cairn_motion u)
{
    cairn_real threshold = a->restitution == 0 ? b->threshold : b->restitution == 0 || a->threshold < b->threshold ? a->threshold : b->threshold;
    threshold = threshold > CAIRN_F(500) ? CAIRN_F(500) : threshold; /* more than anything moves by, and there is room for it */
    return (a->restitution != 0 || b->restitution != 0)
        && -u > cairn_motion_from_offset(cairn_motion_ratio(cairn_offset_from_real(threshold), cairn_world_rest_damping(world))); /* of a second */
}

/*
 * An approach at u, faster than rest. If the two touch in this step it is an impact: by Newton's law the velocity after it is to be -e times u, and the
 * impulse is not given once more as the next step's first guess.
 */
CAIRN_ONCE void strike(const cairn_world *world, const line *l, cairn_row *row, cairn_motion u)
{
    const cairn_material *a = l->body[0]->model->material, *b = l->body[1]->model->material;
    cairn_motion pull = pull_of(world, l->body[1], l) - (cairn_body_is_dynamic(l->body[0]) ? pull_of(world, l->body[0], l) : 0);
    if (cairn_motion_add(row->gap, cairn_motion_add(u, pull)) > 0) {
        return;
    }
    row->feature |= CAIRN_ROW_IN_FLIGHT;
    if (CAIRN_WITH_BOUNCE && rebounds(world, a, b, u)) {
        cairn_factor restitution = a->restitution > b->restitution ? a->restitution : b->restitution;
        cairn_motion bias = cairn_motion_add(cairn_motion_factor(u, restitution), -pull);
        row->gap = row->gap < bias ? row->gap : bias;
    }
}

static void find_impacts(cairn_world *world)
{
    cairn_motion rest = cairn_motion_add(magnitude(world->gravity_x.whole), magnitude(world->gravity_y.whole)); /* what gravity gives in a step */
    line l;
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        set_line(&l, world, arbiter);
        for (int i = 0; (arbiter->flags & CAIRN_ARBITER_SOLVED) && i < arbiter->count; i++) {
            take_levers(&l, &arbiter->rows[i]);
            cairn_motion u = velocity(&l);
            if (u < -rest) {
                strike(world, &l, &arbiter->rows[i], u);
            }
        }
    }
}

static void start(cairn_world *world)
{
    cairn_motion gx = cairn_diffuse(&world->gravity_x), gy = cairn_diffuse(&world->gravity_y);
    for (uint16_t i = 0; i < world->body_end; i++) {
        cairn_body *body = &world->bodies[i];
        if (cairn_body_is_active(body)) {
            if (CAIRN_ASKS_WHO_MET) {
                body->flags |= CAIRN_BODY_GOES;
            }
            cairn_body_start(world, body, gx, gy);
            world->stats.moved++;
        }
    }
}

static void advance(cairn_world *world)
{
    for (uint16_t i = 0; i < world->body_end; i++) {
        cairn_body *body = &world->bodies[i];
        if (cairn_body_is_active(body)) {
            cairn_body_limit_speed(world, body);
            body->dx = body->vx;
            body->dy = body->vy;
            if (CAIRN_WITH_TURNING) {
                body->dw = body->w;
            }
        }
    }
}

static void solve(cairn_world *world)
{
    if (cairn_world_springs(world) != NULL) {
        cairn_world_springs(world)->kind->prepare(world);
    }
    find_impacts(world);
    start(world);
    if (cairn_world_springs(world) != NULL) {
        cairn_world_springs(world)->kind->substep(world, 0);
    }
    int k = cairn_world_passes(world);
    pass(world, k);
    while (k != 0 && pass(world, --k)) {
    }
    advance(world);
}

const cairn_solver_class cairn_solver_slides = { solve, CAIRN_SOLVER_SLIDES };
const cairn_solver_class cairn_solver_small = { solve, CAIRN_SOLVER_SMALL };

static cairn_status use(cairn_world *world, const cairn_solver_class *solver, int passes)
{
    if (world == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (world->locked) {
        return cairn_fail(world, CAIRN_ERROR_LOCKED);
    }
    if (!cairn_solver_is_known(solver)) {
        return cairn_fail(world, CAIRN_ERROR_KIND);
    }
    if (passes < 1 || passes > 100) {
        return cairn_fail(world, CAIRN_ERROR_RANGE);
    }
    if (!CAIRN_WITH_SETTINGS && passes != CAIRN_FIRST_PASSES) {
        return cairn_fail(world, CAIRN_ERROR_KIND);
    }
    if (cairn_world_block(world) != NULL) {
        cairn_world_block(world)->kind->release(world); /* their impulses have exponents of their own */
    }
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter_doubt(cairn_arbiter_at(world, place)); /* rows of the soft solver do not serve */
    }
    cairn_world_set_substeps(world, 1);
    world->solver = solver;
    world->passes = (uint8_t)passes;
    return cairn_world_set_slop(world, CAIRN_HARD_SLOP);
}

cairn_status cairn_world_use_slides_solver(cairn_world *world, int passes)
{
    return use(world, &cairn_solver_slides, passes);
}

cairn_status cairn_world_use_small_solver(cairn_world *world, int passes)
{
    return use(world, &cairn_solver_small, passes);
}
