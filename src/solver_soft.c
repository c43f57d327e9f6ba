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

/* ---- one row ---- */

static cairn_motion pressed(cairn_motion impulse)
{
    return impulse < 0 ? 0 : impulse > CAIRN_IMPULSE_MAX ? CAIRN_IMPULSE_MAX : impulse;
}

/* The same against a velocity that has a distance in it, and hence no bound of its own. */
static cairn_motion pressed_against(cairn_motion impulse, cairn_motion u, cairn_ratio mass)
{
    return pressed(cairn_motion_add(impulse, -cairn_motion_ratio(cairn_motion_clamp(u, CAIRN_MOTION(3.9)), mass)));
}

/* The new impulse of a point that was apart when the step began (u leans by beta d): it may close the gap and no more. */
static cairn_motion biased_apart(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u)
{
    cairn_motion moved = cairn_row_displacement(a, b, arbiter, row), separation = cairn_motion_add(row->gap, moved);
    if (row->feature & CAIRN_ROW_IN_FLIGHT) {
        return 0;
    }
    if (separation > 0) {
        return pressed_against(row->impulse, cairn_motion_add(u, separation - cairn_motion_ratio(moved, CAIRN_SOFT_BETA)), row->mass);
    }
    return pressed_against(row->impulse - cairn_motion_ratio(row->impulse, CAIRN_SOFT_IMPULSE),
                           cairn_motion_add(u, cairn_motion_ratio(row->gap, CAIRN_SOFT_BETA)), row->soft_mass);
}

static cairn_motion relaxed_apart(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u)
{
    cairn_motion separation = cairn_motion_add(row->gap, cairn_row_displacement(a, b, arbiter, row));
    if (row->feature & CAIRN_ROW_IN_FLIGHT) {
        return 0;
    }
    return pressed_against(row->impulse, separation > 0 ? cairn_motion_add(u, separation) : u, row->mass);
}

/* The new impulse of a row in the biased pass: soft, and pushing out. */
static inline cairn_motion biased(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u)
{
    if (row->gap > 0) {
        return biased_apart(a, b, arbiter, row, u);
    }
    return pressed(row->impulse - cairn_motion_ratio(u + row->gap, row->soft_mass) - cairn_motion_ratio(row->impulse - row->load, CAIRN_SOFT_IMPULSE));
}

/* The same in the relax pass: rigid, and without any push. */
static inline cairn_motion relaxed(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u)
{
    if (row->gap > 0) {
        return relaxed_apart(a, b, arbiter, row, u);
    }
    return pressed(row->impulse - cairn_motion_ratio(u, row->mass));
}

/*
 * Coulomb: stick while the whole impulse fits the static cone, else slide at the kinetic one. What slips slower than
 * half of a sub-step's approach is still held at the static limit: the first passes over two points and their friction
 * find only part of it, and a body let go then would never stick again where static friction holds and kinetic does not.
 */
static inline cairn_motion rubbed(const cairn_arbiter *arbiter, cairn_motion u)
{
    cairn_motion pressure = arbiter->rows[0].impulse + (arbiter->count > 1 ? arbiter->rows[1].impulse : 0);
    cairn_motion impulse = arbiter->friction_impulse - cairn_motion_ratio(u + arbiter->pull, arbiter->friction_mass);
    cairn_motion limit = cairn_motion_factor(pressure, arbiter->static_friction);
    if (impulse > limit || -impulse > limit) {
        cairn_motion slow = cairn_motion_half(pressure);
        bool slides = u > slow || -u > slow;
        impulse = cairn_motion_clamp(impulse, slides ? cairn_motion_factor(pressure, arbiter->kinetic_friction) : limit);
    }
    return cairn_motion_clamp(impulse, CAIRN_IMPULSE_MAX);
}

/* ---- one body ---- */

static inline cairn_motion turned(cairn_motion w, cairn_motion impulse, cairn_lever j)
{
    return cairn_motion_clamp(w + cairn_motion_lever(impulse, j), CAIRN_SWEEP_SPIN);
}

static inline void shift(cairn_body *body, const cairn_arbiter *arbiter, cairn_motion push, cairn_motion rub)
{
    body->vx = cairn_motion_clamp(body->vx + cairn_motion_along(push, -rub, arbiter->normal_x, arbiter->normal_y), CAIRN_SWEEP_SPEED);
    body->vy = cairn_motion_clamp(body->vy + cairn_motion_along(rub, push, arbiter->normal_x, arbiter->normal_y), CAIRN_SWEEP_SPEED);
}

static inline void push(cairn_body *body, const cairn_arbiter *arbiter, cairn_motion push)
{
    body->vx = cairn_motion_clamp(body->vx + cairn_motion_dir(push, arbiter->normal_x), CAIRN_SWEEP_SPEED);
    body->vy = cairn_motion_clamp(body->vy + cairn_motion_dir(push, arbiter->normal_y), CAIRN_SWEEP_SPEED);
}

/* ---- passes over a body on something static: all of the change is its own ---- */

static void biased_on_static(const cairn_body *a, cairn_body *b, cairn_arbiter *arbiter)
{
    cairn_motion linear = cairn_motion_along(b->vx, b->vy, arbiter->normal_x, arbiter->normal_y);
    cairn_motion w = b->w, sum = 0;
    for (int i = 0; i < arbiter->count; i++) {
        cairn_row *row = &arbiter->rows[i];
        cairn_motion impulse = biased(a, b, arbiter, row, linear + cairn_motion_lever(w, row->lever_b));
        cairn_motion change = impulse - row->impulse;
        row->impulse = impulse;
        linear += change;
        w = turned(w, change, row->lever_b);
        sum += change;
    }
    b->w = w;
    push(b, arbiter, sum);
}

static void relax_on_static(const cairn_body *a, cairn_body *b, cairn_arbiter *arbiter)
{
    cairn_motion linear = cairn_motion_along(b->vx, b->vy, arbiter->normal_x, arbiter->normal_y);
    cairn_motion across = cairn_motion_along(b->vy, -b->vx, arbiter->normal_x, arbiter->normal_y);
    cairn_motion w = b->w, sum = 0;
    for (int i = 0; i < arbiter->count; i++) {
        cairn_row *row = &arbiter->rows[i];
        cairn_motion impulse = relaxed(a, b, arbiter, row, linear + cairn_motion_lever(w, row->lever_b));
        cairn_motion change = impulse - row->impulse;
        row->impulse = impulse;
        linear += change;
        w = turned(w, change, row->lever_b);
        sum += change;
    }
    cairn_motion impulse = rubbed(arbiter, across + cairn_motion_lever(w, arbiter->friction_lever_b));
    cairn_motion rub = impulse - arbiter->friction_impulse;
    arbiter->friction_impulse = impulse;
    b->w = turned(w, rub, arbiter->friction_lever_b);
    shift(b, arbiter, sum, rub);
}

/* ---- passes over a pair that moves ---- */

/* What a pass makes of a pair: spins at once, linear velocities at the end. */
typedef struct pair_state {
    cairn_motion linear; /* relative velocity along the normal */
    cairn_motion spin_a, spin_b;
    cairn_motion push_a, push_b; /* the bodies' shares of the impulses so far */
} pair_state;

static inline pair_state load(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter)
{
    pair_state pair;
    pair.linear = cairn_motion_along(b->vx - a->vx, b->vy - a->vy, arbiter->normal_x, arbiter->normal_y);
    pair.spin_a = a->w;
    pair.spin_b = b->w;
    pair.push_a = 0;
    pair.push_b = 0;
    return pair;
}

static inline cairn_motion row_velocity(const pair_state *pair, cairn_motion linear, cairn_lever ja, cairn_lever jb)
{
    return linear + cairn_motion_lever(pair->spin_b, jb) - cairn_motion_lever(pair->spin_a, ja);
}

/* Give a row an impulse; a body of fixed position takes only its turning part. */
static inline void press(pair_state *pair, const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, cairn_row *row, cairn_motion impulse)
{
    cairn_motion change = impulse - row->impulse;
    cairn_motion of_a = cairn_motion_share(change, arbiter->share_a), of_b = cairn_motion_share(change, arbiter->share_b);
    row->impulse = impulse;
    pair->spin_a = turned(pair->spin_a, -of_a, row->lever_a);
    pair->spin_b = turned(pair->spin_b, of_b, row->lever_b);
    if (arbiter->flags & CAIRN_ARBITER_PIVOT) {
        of_a = a->flags & CAIRN_BODY_FIXED_POSITION ? 0 : of_a;
        of_b = b->flags & CAIRN_BODY_FIXED_POSITION ? 0 : of_b;
        pair->linear += of_a + of_b;
    } else {
        pair->linear += change;
    }
    pair->push_a += of_a;
    pair->push_b += of_b;
}

static void biased_pair(cairn_body *a, cairn_body *b, cairn_arbiter *arbiter)
{
    pair_state pair = load(a, b, arbiter);
    for (int i = 0; i < arbiter->count; i++) {
        cairn_row *row = &arbiter->rows[i];
        press(&pair, a, b, arbiter, row, biased(a, b, arbiter, row, row_velocity(&pair, pair.linear, row->lever_a, row->lever_b)));
    }
    a->w = pair.spin_a;
    b->w = pair.spin_b;
    push(a, arbiter, -pair.push_a);
    push(b, arbiter, pair.push_b);
}

/* Give the friction row an impulse and store the pair. */
static inline void finish_pair(pair_state *pair, cairn_body *a, cairn_body *b, const cairn_arbiter *arbiter, cairn_motion rub)
{
    cairn_motion of_a = cairn_motion_share(rub, arbiter->share_a), of_b = cairn_motion_share(rub, arbiter->share_b);
    a->w = turned(pair->spin_a, -of_a, arbiter->friction_lever_a);
    b->w = turned(pair->spin_b, of_b, arbiter->friction_lever_b);
    if (!(a->flags & CAIRN_BODY_FIXED_POSITION)) {
        shift(a, arbiter, -pair->push_a, -of_a);
    }
    if (!(b->flags & CAIRN_BODY_FIXED_POSITION)) {
        shift(b, arbiter, pair->push_b, of_b);
    }
}

static void relax_pair(cairn_body *a, cairn_body *b, cairn_arbiter *arbiter)
{
    pair_state pair = load(a, b, arbiter);
    cairn_motion across = cairn_motion_along(b->vy - a->vy, a->vx - b->vx, arbiter->normal_x, arbiter->normal_y);
    for (int i = 0; i < arbiter->count; i++) {
        cairn_row *row = &arbiter->rows[i];
        press(&pair, a, b, arbiter, row, relaxed(a, b, arbiter, row, row_velocity(&pair, pair.linear, row->lever_a, row->lever_b)));
    }
    cairn_motion impulse = rubbed(arbiter, row_velocity(&pair, across, arbiter->friction_lever_a, arbiter->friction_lever_b));
    cairn_motion rub = impulse - arbiter->friction_impulse;
    arbiter->friction_impulse = impulse;
    finish_pair(&pair, a, b, arbiter, rub);
}

/* ---- passes over the world ---- */

/* Apply the impulses of the step before. */
static void warm_start(const cairn_world *world, cairn_arbiter *arbiter)
{
    cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    pair_state pair = load(a, b, arbiter);
    for (int i = 0; i < arbiter->count; i++) {
        cairn_row *row = &arbiter->rows[i];
        cairn_motion impulse = row->impulse;
        row->impulse = 0;
        press(&pair, a, b, arbiter, row, impulse);
    }
    finish_pair(&pair, a, b, arbiter, arbiter->friction_impulse);
}

static void biased_pass(const cairn_world *world, cairn_arbiter *arbiter)
{
    cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    if (arbiter->flags & CAIRN_ARBITER_ON_STATIC) {
        biased_on_static(a, b, arbiter);
    } else {
        biased_pair(a, b, arbiter);
    }
}

static void relax_pass(const cairn_world *world, cairn_arbiter *arbiter)
{
    cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    if (arbiter->flags & CAIRN_ARBITER_ON_STATIC) {
        relax_on_static(a, b, arbiter);
    } else {
        relax_pair(a, b, arbiter);
    }
}

static void for_each_solved(cairn_world *world, void (*pass)(const cairn_world *world, cairn_arbiter *arbiter))
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if ((arbiter->flags & CAIRN_ARBITER_SOLVED) && !(arbiter->block & CAIRN_BLOCK_NUMBER)) {
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

/* Take what the pair's impulses did to a body out of the change that is to be repeated. */
static void forget(cairn_body *body, const cairn_arbiter *arbiter, cairn_share share, const cairn_lever lever[2], cairn_lever friction_lever)
{
    cairn_motion push = 0, turn, rub = cairn_motion_share(arbiter->friction_impulse, share), most = CAIRN_MOTION(3.9);
    turn = cairn_motion_lever(rub, friction_lever);
    for (int i = 0; i < arbiter->count; i++) {
        cairn_motion part = cairn_motion_share(arbiter->rows[i].impulse, share);
        push += part;
        turn = cairn_motion_add(turn, cairn_motion_lever(part, lever[i]));
    }
    if (!(body->flags & CAIRN_BODY_FIXED_POSITION)) {
        body->ux = cairn_motion_clamp(cairn_motion_add(body->ux, cairn_motion_along(push, -rub, arbiter->normal_x, arbiter->normal_y)), most);
        body->uy = cairn_motion_clamp(cairn_motion_add(body->uy, cairn_motion_along(rub, push, arbiter->normal_x, arbiter->normal_y)), most);
    }
    body->uw = cairn_motion_clamp(cairn_motion_add(body->uw, turn), most);
}

/* Whether the last change once more leads beyond the limit of speed. */
static bool repeats_too_fast(const cairn_world *world, const cairn_body *body)
{
    cairn_motion x = 2 * body->vx - body->ux, y = 2 * body->vy - body->uy, w = 2 * body->w - body->uw, limit = world->speed_limit;
    return x != cairn_motion_clamp(x, limit) || y != cairn_motion_clamp(y, limit) || w != cairn_motion_clamp(w, world->spin_limit);
}

/*
 * An impulse that stopped something in flight need not be repeated, and the passes take it back; but not where one of two opposite
 * changes is cut by the limit of speed.
 */
static void land(const cairn_world *world, cairn_arbiter *arbiter)
{
    cairn_row *rows = arbiter->rows;
    bool flew = cairn_row_came_flying(&rows[0]) && (arbiter->count < 2 || cairn_row_came_flying(&rows[1]));
    bool presses = rows[0].impulse != 0 || (arbiter->count > 1 && rows[1].impulse != 0);
    if (flew && presses && (repeats_too_fast(world, &world->bodies[arbiter->a]) || repeats_too_fast(world, &world->bodies[arbiter->b]))) {
        cairn_lever lever_a[2] = { rows[0].lever_a, rows[1].lever_a }, lever_b[2] = { rows[0].lever_b, rows[1].lever_b };
        forget(&world->bodies[arbiter->a], arbiter, -arbiter->share_a, lever_a, arbiter->friction_lever_a);
        forget(&world->bodies[arbiter->b], arbiter, arbiter->share_b, lever_b, arbiter->friction_lever_b);
        rows[0].impulse = rows[1].impulse = arbiter->friction_impulse = 0;
        arbiter->flags |= CAIRN_ARBITER_TOUCHING;
    }
}

static void solve(cairn_world *world)
{
    cairn_motion last_gx = 0, last_gy = 0;
    if (world->springs != NULL) {
        world->springs->kind->prepare(world);
    }
    if (world->uneven && world->block != NULL) {
        world->block->find(world);
    }
    for (int k = 0; k < world->substeps; k++) {
        if (world->bounce != NULL) {
            world->bounce->impact(world, k);
        }
        cairn_motion gx = cairn_diffuse(&world->gravity_x), gy = cairn_diffuse(&world->gravity_y);
        if (k == 0) {
            cairn_bodies_start(world, gx, gy);
            for_each_solved(world, warm_start);
            if (world->blocks != 0) {
                world->block->warm_start(world);
            }
        } else {
            if (world->fast != 0) {
                for_each_solved(world, land);
            }
            cairn_bodies_repeat(world, gx - last_gx, gy - last_gy);
        }
        last_gx = gx;
        last_gy = gy;
        if (world->springs != NULL) {
            world->springs->kind->substep(world, k);
        }
        lean(world);
        for_each_solved(world, biased_pass);
        if (world->blocks != 0) {
            world->block->biased_pass(world);
        }
        advance(world);
        for_each_solved(world, relax_pass);
        if (world->blocks != 0) {
            world->block->relax_pass(world);
        }
    }
}

const cairn_solver_class cairn_solver_soft = { solve };
