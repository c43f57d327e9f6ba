/*
 * The passes over a contact in all its cases: points that are apart, bodies of fixed position, any mass ratio, any lever,
 * any speed. Every value is cut to what its sums have room for. With the quick ways of sweep_quick.c it gets what they leave, a few contacts
 * in a scene; without them all of it, and gives what they would to the last bit: it rounds where they do, and cuts where they cut.
 */
#include "sweep.h"

/* ---- one row ---- */

static cairn_motion pressed(cairn_motion impulse) { return cairn_motion_above_zero(impulse, CAIRN_IMPULSE_MAX); }

/* The impulse less mass times a velocity that may have a distance in it, and hence no bound of its own. */
static cairn_motion less(cairn_motion impulse, cairn_motion u, cairn_ratio mass)
{
    return cairn_motion_add(impulse, -cairn_motion_by_mass(cairn_motion_clamp(u, CAIRN_MOTION(3.9)), mass));
}

static cairn_motion softened(const cairn_row *row, cairn_motion u, cairn_motion load)
{
    return pressed(cairn_softened(cairn_motion_clamp(less(row->impulse, u, row->mass), CAIRN_MOTION(5)), load));
}

/* The new impulse of a point that was apart when the step began (u leans by beta d): it may close the gap and no more. */
cairn_motion cairn_biased_apart(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u)
{
    cairn_motion moved = cairn_row_displacement(a, b, arbiter, row), separation = cairn_motion_add(row->gap, moved);
    if (cairn_row_is_in_flight(row)) {
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
    if (cairn_row_is_in_flight(row)) {
        return 0;
    }
    return pressed(less(row->impulse, separation > 0 ? cairn_motion_add(u, separation) : u, row->mass));
}

/*
 * Coulomb: stick while the whole impulse fits the static cone, else slide at the kinetic one. What slips slower than
 * half of a sub-step's approach is still held at the static limit: the first passes over two points and their friction
 * find only part of it, and a body let go then would never stick again where static friction holds and kinetic does not.
 */
cairn_motion cairn_arbiter_rub(const cairn_world *world, const cairn_arbiter *arbiter, cairn_motion u, cairn_motion impulse)
{
    cairn_motion pressure = cairn_arbiter_pressure(arbiter);
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

/* Within a cone that is a little narrower than the kinetic one; of friction that the quick ways know. */
static bool sticks_for_sure(const cairn_arbiter *arbiter, cairn_motion impulse)
{
    cairn_motion within = cairn_motion_factor_below(cairn_arbiter_pressure(arbiter), arbiter->kinetic_friction);
    return impulse <= within && -impulse <= within;
}

/* ---- a pair ---- */

/* What a pass makes of a pair: spins at once, linear velocities at the end. */
typedef struct pair_state {
    cairn_body *a, *b;
    cairn_motion linear, before; /* relative velocity along the normal, and as it was */
    cairn_motion most;           /* by which an impulse may change that may add energy */
    cairn_fine push_a, push_b;   /* the bodies' shares of the impulses so far */
} pair_state;

static void limit_spins(const pair_state *pair)
{
    if (CAIRN_WITH_TURNING) {
        pair->a->w = cairn_motion_clamp(pair->a->w, CAIRN_SWEEP_SPIN);
        pair->b->w = cairn_motion_clamp(pair->b->w, CAIRN_SWEEP_SPIN);
    }
}

static void limit_speed(cairn_body *body)
{
    body->vx = cairn_motion_clamp(body->vx, CAIRN_SWEEP_SPEED);
    body->vy = cairn_motion_clamp(body->vy, CAIRN_SWEEP_SPEED);
}

static pair_state pair_of(const cairn_world *world, const cairn_arbiter *arbiter)
{
    pair_state pair;
    pair.a = &world->bodies[arbiter->a];
    pair.b = &world->bodies[arbiter->b];
    limit_speed(pair.a);
    limit_speed(pair.b);
    pair.linear = pair.before = cairn_motion_along(pair.b->vx - pair.a->vx, pair.b->vy - pair.a->vy, arbiter->normal_x, arbiter->normal_y);
    pair.push_a = pair.push_b = 0;
    pair.most = CAIRN_IMPULSE_MAX;
    return pair;
}

/* Through the centres of both bodies: their spins take no part in it but by friction. */
static bool is_central(const cairn_arbiter *arbiter) { return cairn_arbiter_turn(arbiter) == CAIRN_PATH_CENTRAL; }

/* Would a quick way have taken the contact in this pass? With them nothing of the kind comes here. */
static bool goes_quick(const pair_state *pair, const cairn_arbiter *arbiter, bool with_spins)
{
    return !CAIRN_WITH_QUICK_WAYS && cairn_arbiter_turn(arbiter) > CAIRN_PATH_SLIDING && cairn_is_calm(pair->a, pair->b, CAIRN_PATH_SHARED, with_spins);
}

static cairn_motion velocity(const pair_state *pair, cairn_motion linear, cairn_lever ja, cairn_lever jb)
{
    if (!CAIRN_WITH_TURNING) {
        return linear;
    }
    if (cairn_lever_is_short(ja) && cairn_lever_is_short(jb)) {
        return cairn_motion_add_levers(linear, pair->b->w, jb, -pair->a->w, ja);
    }
    /* Levers that an impact has made long: up to 4 times 0.93 each, and 5.1 of the linear part with the impulses. */
    return cairn_motion_add(cairn_motion_add(linear, cairn_motion_lever(pair->b->w, jb)), -cairn_motion_lever(pair->a->w, ja));
}

static void turn(cairn_body *body, cairn_motion by, const cairn_arbiter *arbiter)
{
    cairn_motion before = body->w;
    body->w = cairn_motion_clamp(before + by, CAIRN_SWEEP_SPIN);
    if (cairn_arbiter_is_sliding(arbiter)) {
        body->uw = cairn_motion_add(body->uw, body->w - before);
    }
}

/* What two parts of an impulse do to the spins. Of balls that are alike they change alike, to the last bit. */
static void turn_both(const pair_state *pair, const cairn_arbiter *arbiter, cairn_fine of_a, cairn_fine of_b, cairn_lever ja, cairn_lever jb)
{
    if (!CAIRN_WITH_TURNING) {
        return;
    }
    cairn_motion by = cairn_fine_lever(of_b, jb);
    turn(pair->a, arbiter->path & CAIRN_PATH_ALIKE ? by : -cairn_fine_lever(of_a, ja), arbiter);
    turn(pair->b, by, arbiter);
}

/* What a takes of an impulse. Where all that moves is of one mass, that is half of it or none. */
static cairn_fine part_of_a(const cairn_arbiter *arbiter, cairn_motion change)
{
    if (!CAIRN_WITH_MASSES) {
        return arbiter->share_a != 0 ? cairn_fine_half(change) : 0;
    }
    return cairn_fine_share(change, arbiter->share_a);
}

/* Give a row an impulse; a body of fixed position takes only its turning part. */
static void press(pair_state *pair, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion change)
{
    cairn_fine of_a = part_of_a(arbiter, change), of_b = cairn_fine_of(change) - of_a;
    if (!is_central(arbiter)) {
        turn_both(pair, arbiter, of_a, of_b, row->lever_a, row->lever_b);
    }
    of_a = cairn_body_is_fixed(pair->a) ? 0 : of_a;
    of_b = cairn_body_is_fixed(pair->b) ? 0 : of_b;
    pair->linear += cairn_motion_from_fine(of_a + of_b);
    pair->push_a = cairn_fine_add(pair->push_a, of_a);
    pair->push_b = cairn_fine_add(pair->push_b, of_b);
}

/* The new impulse of a row whose velocity is u. */
typedef cairn_motion row_rule(const pair_state *pair, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u);

/* Soft, and pushing out. */
static cairn_motion biased(const pair_state *pair, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u)
{
    return row->gap > 0 ? cairn_biased_apart(pair->a, pair->b, arbiter, row, u) : softened(row, cairn_motion_add(u, row->gap), row->load);
}

/* Rigid, and without any push. */
static cairn_motion relaxed(const pair_state *pair, const cairn_arbiter *arbiter, const cairn_row *row, cairn_motion u)
{
    return row->gap > 0 ? cairn_relaxed_apart(pair->a, pair->b, arbiter, row, u) : pressed(less(row->impulse, u, row->mass));
}

static void press_rows(pair_state *pair, cairn_arbiter *arbiter, row_rule *rule, bool from_last)
{
    int count = cairn_arbiter_points(arbiter);
    for (int i = 0; i < count; i++) {
        cairn_row *row = &arbiter->rows[from_last ? count - 1 - i : i];
        cairn_motion change = rule(pair, arbiter, row, velocity(pair, pair->linear, row->lever_a, row->lever_b)) - row->impulse;
        change = row->gap > 0 ? cairn_motion_clamp(change, pair->most) : change;
        row->impulse += change;
        press(pair, arbiter, row, change);
    }
}

static void shift(cairn_body *body, cairn_motion x, cairn_motion y)
{
    if (!cairn_body_is_fixed(body)) {
        body->vx = cairn_motion_clamp(body->vx + x, CAIRN_SWEEP_SPEED);
        body->vy = cairn_motion_clamp(body->vy + y, CAIRN_SWEEP_SPEED);
    }
}

/* Along the normal, or back: the product is rounded first. */
CAIRN_ONCE void push_along(cairn_body *body, cairn_fine push, cairn_dir nx, cairn_dir ny, int sign)
{
    shift(body, sign * cairn_fine_dir(push, nx), sign * cairn_fine_dir(push, ny));
}

/* A share of a change of the velocity to one another: of what slides, which has one point or two, with what is cut off carried. */
static void shift_sliding(cairn_body *body, cairn_share share, cairn_motion x, cairn_motion y)
{
    cairn_motion before_x = body->vx, before_y = body->vy;
    shift(body, cairn_motion_share_carried(x, share, &body->vx_carry), cairn_motion_share_carried(y, share, &body->vy_carry));
    body->ux = cairn_motion_add(body->ux, body->vx - before_x);
    body->uy = cairn_motion_add(body->uy, body->vy - before_y);
}

/* Give the bodies the linear parts of all impulses of a pass, of which friction's are these. */
static void shift_pair(const pair_state *pair, const cairn_arbiter *arbiter, cairn_motion rub, cairn_fine rub_a, cairn_fine rub_b)
{
    cairn_dir nx = arbiter->normal_x, ny = arbiter->normal_y;
    if (cairn_arbiter_is_sliding(arbiter)) {
        cairn_motion push = pair->linear - pair->before;
        cairn_motion x = cairn_motion_along(push, -rub, nx, ny), y = cairn_motion_along(rub, push, nx, ny);
        shift_sliding(pair->a, arbiter->share_a, -x, -y);
        shift_sliding(pair->b, cairn_arbiter_share_b(arbiter), x, y);
    } else if (!CAIRN_WITH_FRICTION) {
        push_along(pair->a, pair->push_a, nx, ny, -1);
        push_along(pair->b, pair->push_b, nx, ny, 1);
    } else {
        shift(pair->a, -cairn_fine_along(pair->push_a, -rub_a, nx, ny), -cairn_fine_along(rub_a, pair->push_a, nx, ny));
        shift(pair->b, cairn_fine_along(pair->push_b, -rub_b, nx, ny), cairn_fine_along(rub_b, pair->push_b, nx, ny));
    }
}

/* Give the friction row an impulse, and the bodies their linear parts of all. */
static void finish(const pair_state *pair, const cairn_arbiter *arbiter, cairn_motion rub)
{
    if (!CAIRN_WITH_FRICTION) {
        shift_pair(pair, arbiter, 0, 0, 0);
        return;
    }
    cairn_fine of_a = part_of_a(arbiter, rub), of_b = cairn_fine_of(rub) - of_a;
    turn_both(pair, arbiter, of_a, of_b, arbiter->friction_lever_a, arbiter->friction_lever_b);
    shift_pair(pair, arbiter, rub, of_a, of_b);
}

/* The first of the arbiter's rows is all there is. */
void cairn_push_alone(const cairn_world *world, cairn_arbiter *arbiter, cairn_pass pass)
{
    pair_state pair = pair_of(world, arbiter);
    bool quick = goes_quick(&pair, arbiter, false);
    cairn_row *row = &arbiter->rows[0];
    cairn_motion change = row->impulse;
    if (pass != CAIRN_WARM_START) { /* which gives all of it again */
        change = (pass == CAIRN_BIASED ? biased(&pair, arbiter, row, pair.linear) : relaxed(&pair, arbiter, row, pair.linear)) - row->impulse;
        if (row->gap > 0) {
            cairn_motion most = pass == CAIRN_BIASED ? CAIRN_CLOSED : CAIRN_GIVEN;
            change = cairn_motion_clamp(change, quick ? most : CAIRN_IMPULSE_MAX);
        }
        row->impulse += change;
    }
    pair.push_a = part_of_a(arbiter, change);
    pair.push_b = cairn_fine_of(change) - pair.push_a;
    shift_pair(&pair, arbiter, 0, 0, 0);
}

void cairn_careful_warm_start(const cairn_world *world, cairn_arbiter *arbiter, bool from_last)
{
    (void)from_last; /* given at once, in whichever order */
    if (CAIRN_IS_PUSH_ALONE) {
        cairn_push_alone(world, arbiter, CAIRN_WARM_START);
        return;
    }
    pair_state pair = pair_of(world, arbiter);
    limit_spins(&pair);
    int count = cairn_arbiter_points(arbiter);
    for (int i = 0; i < count; i++) {
        press(&pair, arbiter, &arbiter->rows[i], arbiter->rows[i].impulse);
    }
    finish(&pair, arbiter, cairn_motion_clamp(arbiter->friction_impulse, CAIRN_IMPULSE_MAX));
}

void cairn_careful_biased_pass(const cairn_world *world, cairn_arbiter *arbiter, bool from_last)
{
    if (CAIRN_IS_PUSH_ALONE) {
        cairn_push_alone(world, arbiter, CAIRN_BIASED);
        return;
    }
    pair_state pair = pair_of(world, arbiter);
    if (!is_central(arbiter)) {
        limit_spins(&pair);
    }
    pair.most = goes_quick(&pair, arbiter, !is_central(arbiter)) ? CAIRN_CLOSED : CAIRN_IMPULSE_MAX;
    press_rows(&pair, arbiter, biased, from_last);
    shift_pair(&pair, arbiter, 0, 0, 0);
}

/* Friction's impulse, where it slipped at `across` without the spins; returns its change. */
static cairn_motion rub(const pair_state *pair, const cairn_world *world, cairn_arbiter *arbiter, cairn_motion across)
{
    cairn_motion u = velocity(pair, across, arbiter->friction_lever_a, arbiter->friction_lever_b);
    cairn_motion pull = !cairn_arbiter_has_two(arbiter) ? 0 : cairn_arbiter_pull(world, arbiter);
    cairn_motion old = arbiter->friction_impulse, change = less(old, u + pull, arbiter->friction_mass) - old;
    if (pair->most != CAIRN_GIVEN || !sticks_for_sure(arbiter, old + change)) {
        change = cairn_motion_clamp(cairn_arbiter_rub(world, arbiter, u, old + change) - old, pair->most);
    }
    arbiter->friction_impulse = old + change;
    return change;
}

void cairn_careful_relax_pass(const cairn_world *world, cairn_arbiter *arbiter, bool from_last)
{
    if (CAIRN_IS_PUSH_ALONE) {
        cairn_push_alone(world, arbiter, CAIRN_RELAX);
        return;
    }
    pair_state pair = pair_of(world, arbiter);
    const cairn_body *a = pair.a, *b = pair.b;
    cairn_motion across = 0;
    if (CAIRN_WITH_FRICTION) {
        across = cairn_motion_along(b->vy - a->vy, a->vx - b->vx, arbiter->normal_x, arbiter->normal_y);
    }
    pair.most = goes_quick(&pair, arbiter, true) ? CAIRN_GIVEN : CAIRN_IMPULSE_MAX;
    limit_spins(&pair);
    press_rows(&pair, arbiter, relaxed, from_last);
    finish(&pair, arbiter, CAIRN_WITH_FRICTION ? rub(&pair, world, arbiter, across) : 0);
}
