/*
 * By how much two bodies that hit one another rebound: Newton's law u+ = -e u- along the normal, Coulomb's along the surface, at the moment and
 * with the levers that bounce_meet.c found. The impulse changes the whole sub-step's motion, so the part of it before that moment is taken back from the
 * displacement.
 */
#include "bounce.h"

/* How often the normal impulses are repeated after friction. */
#define RUBS 12

static cairn_factor coupling(const cairn_arbiter *arbiter, cairn_factor linear, cairn_lever ja, cairn_lever ka, cairn_lever jb, cairn_lever kb)
{
    return linear + cairn_factor_spin(arbiter->share_a, ja, ka) + cairn_factor_spin(cairn_arbiter_share_b(arbiter), jb, kb);
}

static cairn_factor linear_part(const cairn_impact *i)
{
    cairn_share share = (cairn_body_is_fixed(i->a) ? 0 : i->arbiter->share_a)
                      + (cairn_body_is_fixed(i->b) ? 0 : cairn_arbiter_share_b(i->arbiter));
    return cairn_factor_mul(cairn_factor_from_share(share), i->norm);
}

/* The impulses along the normal after which each hitting point leaves with -e times its approach: K L = (1 + e) v. */
static void resolve(const cairn_impact *i, cairn_motion *first, cairn_motion *second)
{
    const cairn_arbiter *arbiter = i->arbiter;
    const cairn_row *p = &arbiter->rows[0], *q = &arbiter->rows[CAIRN_LAST_ROW];
    cairn_factor linear = linear_part(i), gain = CAIRN_FACTOR(1) + i->restitution;
    cairn_motion bp = cairn_motion_factor(i->closing[0], gain), bq = cairn_arbiter_has_two(arbiter) ? cairn_motion_factor(i->closing[1], gain) : 0;
    cairn_factor pp = coupling(arbiter, linear, p->lever_a, p->lever_a, p->lever_b, p->lever_b);
    *first = *second = 0;
    if (bq == 0) {
        *first = pp > 0 ? cairn_motion_divide(bp, pp) : 0;
        return;
    }
    cairn_factor qq = coupling(arbiter, linear, q->lever_a, q->lever_a, q->lever_b, q->lever_b);
    if (bp == 0) {
        *second = qq > 0 ? cairn_motion_divide(bq, qq) : 0;
        return;
    }
    cairn_factor pq = coupling(arbiter, linear, p->lever_a, q->lever_a, p->lever_b, q->lever_b);
    cairn_factor determinant = cairn_factor_mul(pp, qq) - cairn_factor_mul(pq, pq);
    bool apart = determinant > cairn_factor_mul(cairn_factor_mul(pp, qq), CAIRN_FACTOR(1.0 / 64));
    if (apart) {
        *first = cairn_motion_divide(cairn_motion_add(cairn_motion_factor(bp, qq), -cairn_motion_factor(bq, pq)), determinant);
        *second = cairn_motion_divide(cairn_motion_add(cairn_motion_factor(bq, pp), -cairn_motion_factor(bp, pq)), determinant);
    }
    if (!apart || *first < 0 || *second < 0) {
        *first = i->closing[0] >= i->closing[1] && pp > 0 ? cairn_motion_divide(bp, pp) : 0;
        *second = *first == 0 && qq > 0 ? cairn_motion_divide(bq, qq) : 0;
    }
}

static void apply(cairn_body *body, cairn_motion px, cairn_motion py, cairn_motion spin)
{
    if (!cairn_body_is_fixed(body)) {
        body->vx = cairn_motion_clamp(cairn_motion_add(body->vx, px), CAIRN_SWEEP_SPEED);
        body->vy = cairn_motion_clamp(cairn_motion_add(body->vy, py), CAIRN_SWEEP_SPEED);
    }
    body->w = cairn_motion_clamp(cairn_motion_add(body->w, spin), CAIRN_SWEEP_SPIN);
}

/* An impulse along (nx, ny) with these levers on both bodies. */
static void strike(cairn_impact *i, cairn_motion impulse, cairn_dir nx, cairn_dir ny, cairn_lever ja, cairn_lever jb)
{
    cairn_motion a = -cairn_motion_share(impulse, i->arbiter->share_a), b = cairn_motion_share(impulse, cairn_arbiter_share_b(i->arbiter));
    if (i->arbiter->share_a != 0) {
        apply(i->a, cairn_motion_dir(a, nx), cairn_motion_dir(a, ny), cairn_twist(a, ja));
    }
    apply(i->b, cairn_motion_dir(b, nx), cairn_motion_dir(b, ny), cairn_twist(b, jb));
    i->px = cairn_motion_add(i->px, cairn_motion_dir(impulse, nx));
    i->py = cairn_motion_add(i->py, cairn_motion_dir(impulse, ny));
}

/* Coulomb friction of the impact, from the velocity after the normal impulse. */
static void rub(const cairn_world *world, cairn_impact *i, cairn_motion pressure)
{
    cairn_arbiter *arbiter = i->arbiter;
    cairn_dir tx = cairn_dir_negate(arbiter->normal_y), ty = arbiter->normal_x;
    cairn_lever ja = arbiter->friction_lever_a, jb = arbiter->friction_lever_b;
    cairn_motion impulse = -cairn_motion_ratio(cairn_impact_velocity(i, tx, ty, ja, jb), arbiter->friction_mass);
    cairn_motion limit = cairn_motion_factor(pressure, cairn_arbiter_static_friction(world, arbiter));
    if (impulse > limit || -impulse > limit) {
        impulse = cairn_motion_clamp(impulse, cairn_motion_factor(pressure, arbiter->kinetic_friction));
    }
    strike(i, impulse, tx, ty, ja, jb);
}

typedef struct velocity {
    cairn_motion x, y, w;
} velocity;

static velocity velocity_of(const cairn_body *body)
{
    velocity v;
    v.x = body->vx;
    v.y = body->vy;
    v.w = body->w;
    return v;
}

/*
 * The velocity after all of the impact's impulses, from their sum: rounded once, and what is cut off is carried to the next
 * impact. A unit of Q4.28 is 9e-7 m/s; of a body 1e5 times as heavy as the one that hits it at 5 m/s that is 1 % of the momentum.
 */
static void sum_up(cairn_body *body, velocity before, cairn_motion px, cairn_motion py, cairn_share share)
{
    if (share != 0 && !cairn_body_is_fixed(body)) {
        body->vx = cairn_motion_clamp(cairn_motion_add(before.x, cairn_motion_share_carried(px, share, &body->vx_carry)), CAIRN_SWEEP_SPEED);
        body->vy = cairn_motion_clamp(cairn_motion_add(before.y, cairn_motion_share_carried(py, share, &body->vy_carry)), CAIRN_SWEEP_SPEED);
    }
}

/* The change is not to be repeated by the warm start, and acts only after the impact's time. */
static void settle(cairn_world *world, cairn_body *body, velocity before, cairn_unit time, int substep)
{
    /* What the sub-steps to come may add to a displacement must fit, too. */
    cairn_motion room = CAIRN_MOTION(7.99) - cairn_world_most_speed(world) * (cairn_world_substeps(world) - substep);
    cairn_body_limit_speed(world, body);
    cairn_motion x = cairn_motion_add(body->vx, -before.x), y = cairn_motion_add(body->vy, -before.y), w = cairn_motion_add(body->w, -before.w);
    if (substep > 0) {
        body->ux = cairn_motion_before(body->ux, x);
        body->uy = cairn_motion_before(body->uy, y);
        body->uw = cairn_motion_before(body->uw, w);
    }
    body->dx = cairn_motion_clamp(cairn_motion_add(body->dx, -cairn_motion_unit(x, time)), room);
    body->dy = cairn_motion_clamp(cairn_motion_add(body->dy, -cairn_motion_unit(y, time)), room);
    body->dw = cairn_motion_clamp(cairn_motion_add(body->dw, -cairn_motion_unit(w, time)), room);
}

static void shove(cairn_body *body, cairn_motion by, cairn_dir nx, cairn_dir ny)
{
    if (!cairn_body_is_fixed(body)) {
        body->dx = cairn_motion_add(body->dx, cairn_motion_dir(by, nx));
        body->dy = cairn_motion_add(body->dy, cairn_motion_dir(by, ny));
    }
}

/* Bodies that lie in one another when they hit are moved apart by half of that. By place and not by speed, which would be energy. */
static void part(const cairn_world *world, cairn_impact *i)
{
    const cairn_arbiter *arbiter = i->arbiter;
    cairn_motion depth = i->depth - cairn_motion_from_offset(cairn_offset_from_real(world->slop)) - CAIRN_IMPACT_DEEP;
    if (depth <= 0) {
        return;
    }
    depth = cairn_motion_half(depth) < cairn_world_push_out_limit(world) ? cairn_motion_half(depth) : cairn_world_push_out_limit(world);
    if (arbiter->share_a != 0) {
        shove(i->a, -cairn_motion_share(depth, arbiter->share_a), arbiter->normal_x, arbiter->normal_y);
    }
    shove(i->b, cairn_motion_share(depth, cairn_arbiter_share_b(arbiter)), arbiter->normal_x, arbiter->normal_y);
}

/* What an impact has made faster may need the watch over fast bodies, which was set at the step's start. */
static void hasten(cairn_world *world, cairn_body *body)
{
    if (cairn_world_continuous(world) == NULL || !cairn_body_is_dynamic(body) || !cairn_body_is_fast(world, body)) {
        return;
    }
    body->flags |= CAIRN_BODY_FAST;
    world->fast++;
}

/* Which of the points that hit still close: friction may have turned the bodies back on them. */
static bool still_closes(cairn_impact *i)
{
    bool any = false;
    for (int k = 0; k < i->arbiter->count; k++) {
        if (i->closing[k] > 0) {
            cairn_motion closing = cairn_motion_unit(cairn_impact_pull(i), i->time) - cairn_impact_row_velocity(i, &i->arbiter->rows[k]);
            i->closing[k] = closing > i->rest ? closing : 0;
            any = any || closing > i->rest;
        }
    }
    return any;
}

/* All impulses of the impact, at one moment and one place. */
static void exchange(const cairn_world *world, cairn_impact *i)
{
    const cairn_arbiter *arbiter = i->arbiter;
    bool closes = true;
    for (int n = 0; n < RUBS && closes; n++) {
        cairn_motion first, second;
        resolve(i, &first, &second);
        strike(i, first, arbiter->normal_x, arbiter->normal_y, arbiter->rows[0].lever_a, arbiter->rows[0].lever_b);
        strike(i, second, arbiter->normal_x, arbiter->normal_y, arbiter->rows[CAIRN_LAST_ROW].lever_a, arbiter->rows[CAIRN_LAST_ROW].lever_b);
        rub(world, i, cairn_motion_add(first, second));
        closes = still_closes(i);
    }
}

/* A vector turned by the small angle. */
static void turn(cairn_motion *x, cairn_motion *y, cairn_lean angle)
{
    cairn_motion was = *x;
    *x = cairn_motion_add(was, -cairn_motion_lean(*y, angle));
    *y = cairn_motion_add(*y, cairn_motion_lean(was, angle));
}

/*
 * The rounded normal is up to 4e-5 rad off, and so would be the whole impulse: 0.3 mm/s at a blow of 8 m/s. Seen turned by as much, with the velocities, it is the
 * exact one.
 */
static void face_normal(cairn_impact *i)
{
    const cairn_arbiter *arbiter = i->arbiter;
    cairn_motion along = cairn_motion_along(i->b->vy - i->a->vy, i->a->vx - i->b->vx, arbiter->normal_x, arbiter->normal_y);
    for (int k = 0; k < arbiter->count; k++) {
        if (i->closing[k] > 0) {
            i->closing[k] = cairn_motion_add(i->closing[k], -cairn_motion_lean(along, i->lean));
        }
    }
    turn(&i->a->vx, &i->a->vy, (cairn_lean)-i->lean);
    turn(&i->b->vx, &i->b->vy, (cairn_lean)-i->lean);
}

static void face_back(cairn_impact *i, velocity a, velocity b)
{
    turn(&i->px, &i->py, i->lean);
    i->a->vx = a.x;
    i->a->vy = a.y;
    i->b->vx = b.x;
    i->b->vy = b.y;
}

/* The impact, and what follows from it. */
void cairn_impact_rebound(cairn_world *world, cairn_impact *i)
{
    cairn_arbiter *arbiter = i->arbiter;
    velocity a = velocity_of(i->a), b = velocity_of(i->b);
    i->norm = cairn_factor_square(arbiter->normal_x, arbiter->normal_y);
    face_normal(i);
    exchange(world, i);
    face_back(i, a, b);
    sum_up(i->a, a, -i->px, -i->py, arbiter->share_a);
    sum_up(i->b, b, i->px, i->py, cairn_arbiter_share_b(arbiter));
    settle(world, i->a, a, i->time, i->substep);
    settle(world, i->b, b, i->time, i->substep);
    part(world, i);
    hasten(world, i->a);
    hasten(world, i->b);
    arbiter->flags |= CAIRN_ARBITER_TOUCHING;
}
