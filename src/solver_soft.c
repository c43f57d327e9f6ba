/*
 * The sub-stepped soft solver (TGS-soft) in the contact frame. Per step: warm start once; then n times: integrate
 * velocities, a biased pass without friction, move, a relax pass with friction.
 *
 * Units (see DESIGN.md): with h the sub-step, velocities are v h, spins rho w h, impulses lambda h (1/mA + 1/mB), all
 * in metres, so that neither h nor a mass occurs in the passes. During the biased pass bodies hold v + beta d, d being
 * the displacement in this step: that makes the push-out follow the separation without computing it again. Between
 * sub-steps the warm start repeats each body's last velocity change: v' = v + (v - u).
 */
#include "engine.h"
#include <cairn/spring.h>

/* The velocity of b relative to a along a row, the linear part along the normal given. */
static cairn_motion row_velocity(cairn_motion linear, cairn_motion spin_a, cairn_motion spin_b, cairn_lever ja, cairn_lever jb)
{
    return linear + cairn_motion_lever(spin_b, jb) - cairn_motion_lever(spin_a, ja);
}

/* How far the points of a row have come apart in this step. */
static cairn_motion row_displacement(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row)
{
    cairn_offset x = cairn_offset_from_motion(b->dx) - cairn_offset_from_motion(a->dx);
    cairn_offset y = cairn_offset_from_motion(b->dy) - cairn_offset_from_motion(a->dy);
    cairn_offset spin_a = cairn_offset_from_motion(a->dw), spin_b = cairn_offset_from_motion(b->dw);
    return cairn_motion_from_offset(row_velocity(cairn_motion_along(x, y, arbiter->normal_x, arbiter->normal_y), spin_a, spin_b,
                                                 row->lever_a, row->lever_b));
}

/* What a pass makes of the two bodies of an arbiter: they are loaded once and stored once. */
typedef struct pair_state {
    cairn_body *a, *b;
    cairn_motion normal;         /* linear relative velocity along the normal */
    cairn_motion spin_a, spin_b;
    cairn_motion push, rub;      /* impulses given in this pass along normal and tangent */
} pair_state;

static pair_state load(const cairn_world *world, const cairn_arbiter *arbiter)
{
    pair_state pair;
    pair.a = &world->bodies[arbiter->a];
    pair.b = &world->bodies[arbiter->b];
    pair.normal = cairn_motion_along(pair.b->vx - pair.a->vx, pair.b->vy - pair.a->vy, arbiter->normal_x, arbiter->normal_y);
    pair.spin_a = pair.a->w;
    pair.spin_b = pair.b->w;
    pair.push = 0;
    pair.rub = 0;
    return pair;
}

/* What an impulse does to the spins. */
static void turn(pair_state *pair, const cairn_arbiter *arbiter, cairn_motion impulse, cairn_lever ja, cairn_lever jb)
{
    if (arbiter->share_a != 0) {
        pair->spin_a = cairn_motion_clamp(
            pair->spin_a - cairn_motion_lever(cairn_motion_share(impulse, arbiter->share_a), ja), CAIRN_SWEEP_SPIN);
    }
    pair->spin_b = cairn_motion_clamp(
        pair->spin_b + cairn_motion_lever(cairn_motion_share(impulse, arbiter->share_b), jb), CAIRN_SWEEP_SPIN);
}

/* What an impulse along the normal does to the relative velocity. */
static void approach(pair_state *pair, const cairn_arbiter *arbiter, cairn_motion impulse)
{
    if (arbiter->flags & CAIRN_ARBITER_PIVOT) {
        if (!(pair->a->flags & CAIRN_BODY_FIXED_POSITION)) {
            pair->normal += cairn_motion_share(impulse, arbiter->share_a);
        }
        if (!(pair->b->flags & CAIRN_BODY_FIXED_POSITION)) {
            pair->normal += cairn_motion_share(impulse, arbiter->share_b);
        }
    } else {
        pair->normal += impulse;
    }
}

static void shift(cairn_body *body, const cairn_arbiter *arbiter, cairn_motion push, cairn_motion rub)
{
    if (!(body->flags & CAIRN_BODY_FIXED_POSITION)) {
        body->vx = cairn_motion_clamp(body->vx + cairn_motion_along(push, -rub, arbiter->normal_x, arbiter->normal_y), CAIRN_SWEEP_SPEED);
        body->vy = cairn_motion_clamp(body->vy + cairn_motion_along(rub, push, arbiter->normal_x, arbiter->normal_y), CAIRN_SWEEP_SPEED);
    }
}

static void store(const pair_state *pair, const cairn_arbiter *arbiter)
{
    if (arbiter->share_a != 0) {
        pair->a->w = pair->spin_a;
        shift(pair->a, arbiter, -cairn_motion_share(pair->push, arbiter->share_a), -cairn_motion_share(pair->rub, arbiter->share_a));
    }
    pair->b->w = pair->spin_b;
    shift(pair->b, arbiter, cairn_motion_share(pair->push, arbiter->share_b), cairn_motion_share(pair->rub, arbiter->share_b));
}

/* Replace a row's accumulated impulse, kept between zero and the limit, and apply the difference. */
static void push(pair_state *pair, const cairn_arbiter *arbiter, cairn_row *row, cairn_motion impulse)
{
    impulse = impulse < 0 ? 0 : impulse > CAIRN_IMPULSE_MAX ? CAIRN_IMPULSE_MAX : impulse;
    cairn_motion change = impulse - row->impulse;
    row->impulse = impulse;
    pair->push += change;
    approach(pair, arbiter, change);
    turn(pair, arbiter, change, row->lever_a, row->lever_b);
}

static void warm_start(const cairn_world *world, cairn_arbiter *arbiter)
{
    pair_state pair = load(world, arbiter);
    for (int i = 0; i < arbiter->count; i++) {
        pair.push += arbiter->rows[i].impulse;
        turn(&pair, arbiter, arbiter->rows[i].impulse, arbiter->rows[i].lever_a, arbiter->rows[i].lever_b);
    }
    pair.rub = arbiter->friction_impulse;
    turn(&pair, arbiter, pair.rub, arbiter->friction_lever_a, arbiter->friction_lever_b);
    store(&pair, arbiter);
}

/* A point that left with its restitution in this step: the impact phase has placed it, nothing is to be added. */
static bool is_rebounding(const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion velocity)
{
    return (arbiter->flags & CAIRN_ARBITER_BOUNCY) && row->impulse == 0 && velocity > 0;
}

static void biased_pass(const cairn_world *world, cairn_arbiter *arbiter)
{
    pair_state pair = load(world, arbiter);
    for (int i = 0; i < arbiter->count; i++) {
        cairn_row *row = &arbiter->rows[i];
        cairn_motion u = row_velocity(pair.normal, pair.spin_a, pair.spin_b, row->lever_a, row->lever_b);
        if (row->gap > 0) {
            cairn_motion moved = row_displacement(pair.a, pair.b, arbiter, row);
            cairn_motion separation = cairn_motion_add(row->gap, moved);
            if (is_rebounding(arbiter, row, u - cairn_motion_ratio(moved, CAIRN_SOFT_BETA))) {
                continue;
            }
            if (separation > 0) { /* may close the gap and no more */
                u = cairn_motion_add(u, separation - cairn_motion_ratio(moved, CAIRN_SOFT_BETA));
                push(&pair, arbiter, row, row->impulse - cairn_motion_ratio(u, row->mass));
                continue;
            }
            u += cairn_motion_ratio(row->gap, CAIRN_SOFT_BETA);
        } else {
            u += row->gap;
        }
        push(&pair, arbiter, row,
             row->impulse - cairn_motion_ratio(u, row->soft_mass) - cairn_motion_ratio(row->impulse, CAIRN_SOFT_IMPULSE));
    }
    store(&pair, arbiter);
}

/* Coulomb: stick while the whole impulse fits the static cone, else slide at the kinetic one. */
static void rub(pair_state *pair, cairn_arbiter *arbiter, cairn_motion linear)
{
    cairn_motion pressure = arbiter->rows[0].impulse + (arbiter->count > 1 ? arbiter->rows[1].impulse : 0);
    cairn_motion u = row_velocity(linear, pair->spin_a, pair->spin_b, arbiter->friction_lever_a, arbiter->friction_lever_b);
    cairn_motion impulse = arbiter->friction_impulse - cairn_motion_ratio(u, arbiter->friction_mass);
    cairn_motion limit = cairn_motion_factor(pressure, arbiter->static_friction);
    if (impulse > limit || -impulse > limit) {
        impulse = cairn_motion_clamp(impulse, cairn_motion_factor(pressure, arbiter->kinetic_friction));
    }
    impulse = cairn_motion_clamp(impulse, CAIRN_IMPULSE_MAX);
    cairn_motion change = impulse - arbiter->friction_impulse;
    arbiter->friction_impulse = impulse;
    pair->rub = change;
    turn(pair, arbiter, change, arbiter->friction_lever_a, arbiter->friction_lever_b);
}

static void relax_pass(const cairn_world *world, cairn_arbiter *arbiter)
{
    pair_state pair = load(world, arbiter);
    cairn_motion tangent = cairn_motion_along(pair.b->vy - pair.a->vy, pair.a->vx - pair.b->vx, arbiter->normal_x, arbiter->normal_y);
    for (int i = 0; i < arbiter->count; i++) {
        cairn_row *row = &arbiter->rows[i];
        cairn_motion u = row_velocity(pair.normal, pair.spin_a, pair.spin_b, row->lever_a, row->lever_b);
        if (row->gap > 0) {
            cairn_motion separation = cairn_motion_add(row->gap, row_displacement(pair.a, pair.b, arbiter, row));
            if (separation > 0 && (arbiter->flags & CAIRN_ARBITER_BOUNCY) && row->impulse == 0) {
                continue;
            }
            u = separation > 0 ? cairn_motion_add(u, separation) : u;
        }
        push(&pair, arbiter, row, row->impulse - cairn_motion_ratio(u, row->mass));
    }
    rub(&pair, arbiter, tangent);
    store(&pair, arbiter);
}

static void for_each_solved(cairn_world *world, void (*pass)(const cairn_world *world, cairn_arbiter *arbiter))
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (arbiter->flags & CAIRN_ARBITER_SOLVED) {
            pass(world, arbiter);
        }
    }
}

/* Enter the biased pass: v + beta d. */
static void lean(cairn_world *world)
{
    for (uint16_t i = 0; i < world->body_end; i++) {
        cairn_body *body = &world->bodies[i];
        if (cairn_body_is_active(body)) {
            body->vx += cairn_motion_ratio(body->dx, CAIRN_SOFT_BETA);
            body->vy += cairn_motion_ratio(body->dy, CAIRN_SOFT_BETA);
            body->w += cairn_motion_ratio(body->dw, CAIRN_SOFT_BETA);
        }
    }
}

/* Leave it, and move by the sub-step. */
static void advance(cairn_world *world)
{
    for (uint16_t i = 0; i < world->body_end; i++) {
        cairn_body *body = &world->bodies[i];
        if (cairn_body_is_active(body)) {
            body->vx -= cairn_motion_ratio(body->dx, CAIRN_SOFT_BETA);
            body->vy -= cairn_motion_ratio(body->dy, CAIRN_SOFT_BETA);
            body->w -= cairn_motion_ratio(body->dw, CAIRN_SOFT_BETA);
            cairn_body_limit_speed(world, body);
            body->dx += body->vx;
            body->dy += body->vy;
            body->dw += body->w;
        }
    }
}

static void solve(cairn_world *world)
{
    cairn_motion last_gx = 0, last_gy = 0;
    if (world->springs != NULL) {
        world->springs->kind->prepare(world);
    }
    for (int k = 0; k < world->substeps; k++) {
        if (world->bounce != NULL) {
            world->bounce->impact(world, k);
        }
        cairn_motion gx = cairn_diffuse(&world->gravity_x), gy = cairn_diffuse(&world->gravity_y);
        if (k == 0) {
            cairn_bodies_start(world, gx, gy);
            for_each_solved(world, warm_start);
        } else {
            cairn_bodies_repeat(world, gx - last_gx, gy - last_gy);
        }
        last_gx = gx;
        last_gy = gy;
        if (world->springs != NULL) {
            world->springs->kind->substep(world, k);
        }
        lean(world);
        for_each_solved(world, biased_pass);
        advance(world);
        for_each_solved(world, relax_pass);
    }
}

const cairn_solver_class cairn_solver_soft = { solve };
