/*
 * The slides' scheme: k passes of sequential impulses over the whole step with accumulated clamping and Baumgarte's
 * bias; nothing is kept from the step before. It uses the rows of the soft solver, with h = dt.
 */
#include "engine.h"
#include <cairn/block.h>
#include <cairn/solver.h>
#include <cairn/spring.h>

/* Baumgarte's beta is 0.2 a step; rows hold the push-out for CAIRN_SOFT_BETA. */
#define BAUMGARTE CAIRN_RATIO(0.2 / CAIRN_SOFT_BETA_NUMBER)

static void apply(cairn_world *world, const cairn_arbiter *arbiter, cairn_motion px, cairn_motion py, cairn_motion impulse,
                  cairn_lever ja, cairn_lever jb)
{
    cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    if (arbiter->share_a != 0) {
        a->w = cairn_motion_clamp(a->w - cairn_motion_lever(cairn_motion_share(impulse, arbiter->share_a), ja), CAIRN_SWEEP_SPIN);
        if (!cairn_body_is_fixed(a)) {
            a->vx = cairn_motion_clamp(a->vx - cairn_motion_share(px, arbiter->share_a), CAIRN_SWEEP_SPEED);
            a->vy = cairn_motion_clamp(a->vy - cairn_motion_share(py, arbiter->share_a), CAIRN_SWEEP_SPEED);
        }
    }
    b->w = cairn_motion_clamp(b->w + cairn_motion_lever(cairn_motion_share(impulse, cairn_arbiter_share_b(arbiter)), jb), CAIRN_SWEEP_SPIN);
    if (!cairn_body_is_fixed(b)) {
        b->vx = cairn_motion_clamp(b->vx + cairn_motion_share(px, cairn_arbiter_share_b(arbiter)), CAIRN_SWEEP_SPEED);
        b->vy = cairn_motion_clamp(b->vy + cairn_motion_share(py, cairn_arbiter_share_b(arbiter)), CAIRN_SWEEP_SPEED);
    }
}

static cairn_motion velocity(const cairn_world *world, const cairn_arbiter *arbiter, cairn_dir nx, cairn_dir ny, cairn_lever ja, cairn_lever jb)
{
    const cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    return cairn_motion_along(b->vx - a->vx, b->vy - a->vy, nx, ny) + cairn_motion_lever(b->w, jb) - cairn_motion_lever(a->w, ja);
}

static void push(cairn_world *world, cairn_arbiter *arbiter, cairn_row *row)
{
    cairn_dir nx = arbiter->normal_x, ny = arbiter->normal_y;
    if (row->gap > 0) {
        return;
    }
    cairn_motion target = velocity(world, arbiter, nx, ny, row->lever_a, row->lever_b) + cairn_motion_ratio(row->gap, BAUMGARTE);
    cairn_motion impulse = row->impulse - cairn_motion_ratio(target, row->mass);
    impulse = impulse < 0 ? 0 : impulse > CAIRN_IMPULSE_MAX ? CAIRN_IMPULSE_MAX : impulse;
    cairn_motion change = impulse - row->impulse;
    row->impulse = impulse;
    apply(world, arbiter, cairn_motion_dir(change, nx), cairn_motion_dir(change, ny), change, row->lever_a, row->lever_b);
}

static void rub(cairn_world *world, cairn_arbiter *arbiter)
{
    cairn_dir tx = cairn_dir_negate(arbiter->normal_y), ty = arbiter->normal_x;
    cairn_motion pressure = cairn_arbiter_pressure(arbiter);
    cairn_motion u = velocity(world, arbiter, tx, ty, arbiter->friction_lever_a, arbiter->friction_lever_b);
    cairn_motion impulse = arbiter->friction_impulse - cairn_motion_ratio(u, arbiter->friction_mass);
    cairn_motion limit = cairn_motion_factor(pressure, cairn_arbiter_static_friction(world, arbiter));
    if (impulse > limit || -impulse > limit) {
        impulse = cairn_motion_clamp(impulse, cairn_motion_factor(pressure, arbiter->kinetic_friction));
    }
    impulse = cairn_motion_clamp(impulse, CAIRN_IMPULSE_MAX);
    cairn_motion change = impulse - arbiter->friction_impulse;
    arbiter->friction_impulse = impulse;
    apply(world, arbiter, cairn_motion_dir(change, tx), cairn_motion_dir(change, ty), change, arbiter->friction_lever_a,
          arbiter->friction_lever_b);
}

static void forget(cairn_arbiter *arbiter)
{
    arbiter->rows[0].impulse = 0;
    arbiter->rows[CAIRN_LAST_ROW].impulse = 0;
    arbiter->friction_impulse = 0;
}

static void pass(cairn_world *world, bool first)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (!(arbiter->flags & CAIRN_ARBITER_SOLVED)) {
            continue;
        }
        if (first) {
            forget(arbiter);
        }
        for (int i = 0; i < arbiter->count; i++) {
            push(world, arbiter, &arbiter->rows[i]);
        }
        rub(world, arbiter);
    }
}

static void start(cairn_world *world)
{
    cairn_motion gx = cairn_diffuse(&world->gravity_x), gy = cairn_diffuse(&world->gravity_y);
    for (uint16_t i = 0; i < world->body_end; i++) {
        if (cairn_body_is_active(&world->bodies[i])) {
            world->bodies[i].flags |= CAIRN_BODY_GOES | CAIRN_BODY_UNSTEADY;
            cairn_body_start(world, &world->bodies[i], gx, gy);
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
            body->dx += body->vx;
            body->dy += body->vy;
            body->dw += body->w;
        }
    }
}

static void solve(cairn_world *world)
{
    if (cairn_world_springs(world) != NULL) {
        cairn_world_springs(world)->kind->prepare(world);
    }
    if (cairn_world_bounce(world) != NULL) {
        cairn_world_bounce(world)->impact(world, 0);
    }
    start(world);
    if (cairn_world_springs(world) != NULL) {
        cairn_world_springs(world)->kind->substep(world, 0);
    }
    for (int k = 0; k < world->passes; k++) {
        pass(world, k == 0);
    }
    advance(world);
}

const cairn_solver_class cairn_solver_slides = { solve };

cairn_status cairn_world_use_slides_solver(cairn_world *world, int passes)
{
    if (world == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (world->locked) {
        return cairn_fail(world, CAIRN_ERROR_LOCKED);
    }
    if (!CAIRN_WITH_SLIDES_SOLVER) {
        return cairn_fail(world, CAIRN_ERROR_KIND);
    }
    if (passes < 1 || passes > 100) {
        return cairn_fail(world, CAIRN_ERROR_RANGE);
    }
    if (cairn_world_block(world) != NULL) {
        cairn_world_block(world)->kind->release(world); /* their impulses have exponents of their own */
    }
    world->solver = &cairn_solver_slides;
    world->passes = (uint8_t)passes;
    cairn_world_set_slop(world, CAIRN_F(0.01));
    return cairn_world_set_substeps(world, 1);
}
