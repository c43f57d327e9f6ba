/*
 * The passes over a contact in all its cases: points that are apart, bodies of fixed position, any mass ratio, any lever,
 * any speed. What the quick ones of sweep.c leave, a few contacts in a scene. Every value is cut to what its sums have room for.
 */
#include "sweep.h"

/* ---- one row ---- */

static cairn_motion pressed(cairn_motion impulse) { return cairn_motion_above_zero(impulse, CAIRN_IMPULSE_MAX); }

/* The impulse less mass times a velocity that may have a distance in it, and hence no bound of its own. */
static cairn_motion less(cairn_motion impulse, cairn_motion u, cairn_ratio mass)
{
    return cairn_motion_add(impulse, -cairn_motion_ratio(cairn_motion_clamp(u, CAIRN_MOTION(3.9)), mass));
}

static cairn_motion softened(const cairn_row *row, cairn_motion u, cairn_motion load)
{
    return pressed(cairn_softened(cairn_motion_clamp(less(row->impulse, u, row->mass), CAIRN_MOTION(5)), load));
}

/* The new impulse of a point that was apart when the step began (u leans by beta d): it may close the gap and no more. */
cairn_motion cairn_biased_apart(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u)
{
    cairn_motion moved = cairn_row_displacement(a, b, arbiter, row), separation = cairn_motion_add(row->gap, moved);
    if (row->feature & CAIRN_ROW_IN_FLIGHT) {
        return 0;
    }
    if (separation > 0) {
        return pressed(less(row->impulse, cairn_motion_add(u, separation - cairn_motion_ratio(moved, CAIRN_SOFT_BETA)), row->mass));
    }
    return softened(row, cairn_motion_add(u, cairn_motion_ratio(row->gap, CAIRN_SOFT_BETA)), 0);
}

cairn_motion cairn_relaxed_apart(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u)
{
    cairn_motion separation = cairn_motion_add(row->gap, cairn_row_displacement(a, b, arbiter, row));
    if (row->feature & CAIRN_ROW_IN_FLIGHT) {
        return 0;
    }
    return pressed(less(row->impulse, separation > 0 ? cairn_motion_add(u, separation) : u, row->mass));
}

/* The new impulse of a row in the biased pass: soft, and pushing out. */
static cairn_motion biased(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u)
{
    if (row->gap > 0) {
        return cairn_biased_apart(a, b, arbiter, row, u);
    }
    return softened(row, cairn_motion_add(u, row->gap), row->load);
}

/* The same in the relax pass: rigid, and without any push. */
static cairn_motion relaxed(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u)
{
    if (row->gap > 0) {
        return cairn_relaxed_apart(a, b, arbiter, row, u);
    }
    return pressed(less(row->impulse, u, row->mass));
}

/*
 * Coulomb: stick while the whole impulse fits the static cone, else slide at the kinetic one. What slips slower than
 * half of a sub-step's approach is still held at the static limit: the first passes over two points and their friction
 * find only part of it, and a body let go then would never stick again where static friction holds and kinetic does not.
 */
cairn_motion cairn_arbiter_rub(const cairn_world *world, const cairn_arbiter *arbiter, cairn_motion u, cairn_motion impulse)
{
    cairn_motion pressure = arbiter->rows[0].impulse + (cairn_arbiter_has_two(arbiter) ? arbiter->rows[CAIRN_LAST_ROW].impulse : 0);
    cairn_motion kinetic = cairn_motion_factor(pressure, arbiter->kinetic_friction);
    if (impulse > kinetic || -impulse > kinetic) {
        cairn_motion limit = cairn_motion_factor(pressure, cairn_arbiter_static_friction(world, arbiter));
        if (impulse > limit || -impulse > limit) {
            cairn_motion slow = cairn_motion_half(pressure);
            impulse = cairn_motion_clamp(impulse, u > slow || -u > slow ? kinetic : limit);
        }
    }
    return cairn_motion_clamp(impulse, CAIRN_IMPULSE_MAX);
}

/* ---- a pair ---- */

/* What a pass makes of a pair: spins at once, linear velocities at the end. */
typedef struct pair_state {
    cairn_body *a, *b;
    cairn_motion linear; /* relative velocity along the normal */
    cairn_motion push_a, push_b; /* the bodies' shares of the impulses so far */
} pair_state;

static void limit_sweep(cairn_body *body)
{
    body->vx = cairn_motion_clamp(body->vx, CAIRN_SWEEP_SPEED);
    body->vy = cairn_motion_clamp(body->vy, CAIRN_SWEEP_SPEED);
    body->w = cairn_motion_clamp(body->w, CAIRN_SWEEP_SPIN);
}

static pair_state pair_of(const cairn_world *world, const cairn_arbiter *arbiter)
{
    pair_state pair;
    pair.a = &world->bodies[arbiter->a];
    pair.b = &world->bodies[arbiter->b];
    limit_sweep(pair.a);
    limit_sweep(pair.b);
    pair.linear = cairn_motion_along(pair.b->vx - pair.a->vx, pair.b->vy - pair.a->vy, arbiter->normal_x, arbiter->normal_y);
    pair.push_a = pair.push_b = 0;
    return pair;
}

static cairn_motion velocity(const pair_state *pair, cairn_motion linear, cairn_lever ja, cairn_lever jb)
{
    return linear + cairn_motion_lever(pair->b->w, jb) - cairn_motion_lever(pair->a->w, ja);
}

static void turn(cairn_body *body, cairn_motion impulse, cairn_lever j, const cairn_arbiter *arbiter)
{
    cairn_motion before = body->w;
    body->w = cairn_motion_clamp(before + cairn_motion_lever(impulse, j), CAIRN_SWEEP_SPIN);
    if (cairn_arbiter_is_sliding(arbiter)) {
        body->uw = cairn_motion_add(body->uw, body->w - before);
    }
}

/* Give a row an impulse; a body of fixed position takes only its turning part. */
static void press(pair_state *pair, const cairn_arbiter *arbiter, cairn_row *row, cairn_motion impulse)
{
    cairn_motion change = impulse - row->impulse;
    cairn_motion of_a = cairn_motion_share(change, arbiter->share_a), of_b = change - of_a;
    row->impulse = impulse;
    turn(pair->a, -of_a, row->lever_a, arbiter);
    turn(pair->b, of_b, row->lever_b, arbiter);
    of_a = cairn_body_is_fixed(pair->a) ? 0 : of_a;
    of_b = cairn_body_is_fixed(pair->b) ? 0 : of_b;
    pair->linear += of_a + of_b;
    pair->push_a += of_a;
    pair->push_b += of_b;
}

static void shift(cairn_body *body, const cairn_arbiter *arbiter, cairn_motion push, cairn_motion rub)
{
    if (!cairn_body_is_fixed(body)) {
        body->vx = cairn_motion_clamp(body->vx + cairn_motion_along(push, -rub, arbiter->normal_x, arbiter->normal_y), CAIRN_SWEEP_SPEED);
        body->vy = cairn_motion_clamp(body->vy + cairn_motion_along(rub, push, arbiter->normal_x, arbiter->normal_y), CAIRN_SWEEP_SPEED);
    }
}

/* A share of a change of the velocity to one another: of what slides, which has one point or two, with what is cut off carried. */
static void shift_sliding(cairn_body *body, cairn_share share, cairn_motion x, cairn_motion y)
{
    cairn_motion before_x = body->vx, before_y = body->vy;
    body->vx = cairn_motion_clamp(before_x + cairn_motion_share_carried(x, share, &body->vx_carry), CAIRN_SWEEP_SPEED);
    body->vy = cairn_motion_clamp(before_y + cairn_motion_share_carried(y, share, &body->vy_carry), CAIRN_SWEEP_SPEED);
    body->ux = cairn_motion_add(body->ux, body->vx - before_x);
    body->uy = cairn_motion_add(body->uy, body->vy - before_y);
}

/* The linear parts of all impulses of a pass. */
static void shift_pair(const pair_state *pair, const cairn_arbiter *arbiter, cairn_motion rub_a, cairn_motion rub_b)
{
    if (cairn_arbiter_is_sliding(arbiter)) {
        cairn_motion push = pair->push_a + pair->push_b, rub = rub_a + rub_b;
        cairn_motion x = cairn_motion_along(push, -rub, arbiter->normal_x, arbiter->normal_y);
        cairn_motion y = cairn_motion_along(rub, push, arbiter->normal_x, arbiter->normal_y);
        shift_sliding(pair->a, arbiter->share_a, -x, -y);
        shift_sliding(pair->b, CAIRN_SHARE(1) - arbiter->share_a, x, y);
    } else {
        shift(pair->a, arbiter, -pair->push_a, -rub_a);
        shift(pair->b, arbiter, pair->push_b, rub_b);
    }
}

/* Give the friction row an impulse, and the bodies their linear parts of all. */
static void finish(const pair_state *pair, const cairn_arbiter *arbiter, cairn_motion rub)
{
    cairn_motion of_a = cairn_motion_share(rub, arbiter->share_a), of_b = rub - of_a;
    turn(pair->a, -of_a, arbiter->friction_lever_a, arbiter);
    turn(pair->b, of_b, arbiter->friction_lever_b, arbiter);
    shift_pair(pair, arbiter, of_a, of_b);
}

void cairn_careful_warm_start(const cairn_world *world, cairn_arbiter *arbiter, bool from_last)
{
    pair_state pair = pair_of(world, arbiter);
    for (int i = 0; i < arbiter->count; i++) {
        cairn_row *row = &arbiter->rows[from_last ? arbiter->count - 1 - i : i];
        cairn_motion impulse = row->impulse;
        row->impulse = 0;
        press(&pair, arbiter, row, impulse);
    }
    finish(&pair, arbiter, arbiter->friction_impulse);
}

void cairn_careful_biased_pass(const cairn_world *world, cairn_arbiter *arbiter, bool from_last)
{
    pair_state pair = pair_of(world, arbiter);
    for (int i = 0; i < arbiter->count; i++) {
        cairn_row *row = &arbiter->rows[from_last ? arbiter->count - 1 - i : i];
        press(&pair, arbiter, row, biased(pair.a, pair.b, arbiter, row, velocity(&pair, pair.linear, row->lever_a, row->lever_b)));
    }
    shift_pair(&pair, arbiter, 0, 0);
}

void cairn_careful_relax_pass(const cairn_world *world, cairn_arbiter *arbiter, bool from_last)
{
    pair_state pair = pair_of(world, arbiter);
    const cairn_body *a = pair.a, *b = pair.b;
    cairn_motion across = cairn_motion_along(b->vy - a->vy, a->vx - b->vx, arbiter->normal_x, arbiter->normal_y);
    for (int i = 0; i < arbiter->count; i++) {
        cairn_row *row = &arbiter->rows[from_last ? arbiter->count - 1 - i : i];
        press(&pair, arbiter, row, relaxed(a, b, arbiter, row, velocity(&pair, pair.linear, row->lever_a, row->lever_b)));
    }
    cairn_motion u = velocity(&pair, across, arbiter->friction_lever_a, arbiter->friction_lever_b);
    cairn_motion pull = !cairn_arbiter_has_two(arbiter) ? 0 : cairn_arbiter_pull(world, arbiter);
    cairn_motion impulse = cairn_arbiter_rub(world, arbiter, u, less(arbiter->friction_impulse, u + pull, arbiter->friction_mass));
    cairn_motion rub = impulse - arbiter->friction_impulse;
    arbiter->friction_impulse = impulse;
    finish(&pair, arbiter, rub);
}
