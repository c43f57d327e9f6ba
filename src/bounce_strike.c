/*
 * By how much two bodies that hit one another rebound: Newton's law u+ = -e u- along the normal, Coulomb's along the surface, at the moment and
 * with the levers that bounce_meet.c found. The impulse changes the whole sub-step's motion, so the part of it before that moment is taken back from the
 * displacement.
 */
#include "bounce.h"

/* How often the normal impulses are repeated after friction. */
#define RUBS 12

/* What is b's is a's with the other sign. */
static cairn_motion on_side(cairn_motion x, int side) { return x * (2 * side - 1); }

/* How much an impulse with the one levers changes the velocity of the point with the other ones. */
static cairn_factor coupling(const cairn_impact *i, const cairn_lever *j, const cairn_lever *k)
{
    return i->linear + cairn_factor_spin(i->share[0], j[0], k[0]) + cairn_factor_spin(i->share[1], j[1], k[1]);
}

static cairn_factor linear_part(const cairn_impact *i)
{
    const cairn_arbiter *arbiter = i->arbiter;
    cairn_share share = (cairn_body_is_fixed(i->body[0]) ? 0 : i->share[0]) + (cairn_body_is_fixed(i->body[1]) ? 0 : i->share[1]);
    return cairn_factor_mul(cairn_factor_from_share(share), cairn_factor_square(arbiter->normal_x, arbiter->normal_y));
}

/* What changes a point's velocity by so much if it is hit alone. */
static cairn_motion alone(cairn_motion change, cairn_factor coupled) { return coupled > 0 ? cairn_motion_divide(change, coupled) : 0; }

/* (a p - b q) / r */
static cairn_motion cramer(cairn_motion a, cairn_factor p, cairn_motion b, cairn_factor q, cairn_factor r)
{
    return cairn_motion_divide(cairn_motion_add(cairn_motion_factor(a, p), -cairn_motion_factor(b, q)), r);
}

/* The impulses along the normal after which each hitting point leaves with -e times its approach: K L = (1 + e) v. */
static void resolve(const cairn_impact *i, const cairn_line *line, cairn_motion *impulse)
{
    const cairn_lever *p = line[0].lever, *q = line[1].lever;
    cairn_factor gain = CAIRN_FACTOR(1) + i->restitution, pp = coupling(i, p, p);
    cairn_motion bp = cairn_motion_factor(i->closing[0], gain);
    impulse[0] = alone(bp, pp);
    impulse[1] = 0;
    if (!cairn_arbiter_has_two(i->arbiter) || i->closing[1] == 0) {
        return;
    }
    cairn_motion bq = cairn_motion_factor(i->closing[1], gain);
    cairn_factor qq = coupling(i, q, q);
    if (bp != 0) {
        cairn_factor pq = coupling(i, p, q), both = cairn_factor_mul(pp, qq), determinant = both - cairn_factor_mul(pq, pq);
        if (determinant > cairn_factor_mul(both, CAIRN_FACTOR(1.0 / 64))) {
            cairn_motion first = cramer(bp, qq, bq, pq, determinant), second = cramer(bq, pp, bp, pq, determinant);
            if (first >= 0 && second >= 0) {
                impulse[0] = first;
                impulse[1] = second;
                return;
            }
        }
    }
    if (bp < bq || impulse[0] == 0) {
        impulse[0] = 0;
        impulse[1] = alone(bq, qq);
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

/* An impulse on both bodies. */
static void strike(cairn_impact *i, cairn_motion impulse, const cairn_line *line)
{
    for (int side = 0; side < 2; side++) {
        cairn_share share = i->share[side];
        if (share != 0) {
            cairn_motion by = on_side(cairn_motion_share(impulse, share), side);
            apply(i->body[side], cairn_motion_dir(by, line->x), cairn_motion_dir(by, line->y), cairn_twist(by, line->lever[side]));
        }
    }
    i->px = cairn_motion_add(i->px, cairn_motion_dir(impulse, line->x));
    i->py = cairn_motion_add(i->py, cairn_motion_dir(impulse, line->y));
}

/* Coulomb friction of the impact, from the velocity after the normal impulse. */
static void rub(const cairn_world *world, cairn_impact *i, cairn_motion pressure)
{
    const cairn_arbiter *arbiter = i->arbiter;
    cairn_line line;
    line.x = cairn_dir_negate(arbiter->normal_y);
    line.y = arbiter->normal_x;
    line.lever[0] = arbiter->friction_lever_a;
    line.lever[1] = arbiter->friction_lever_b;
    cairn_motion impulse = -cairn_motion_ratio(cairn_impact_velocity(i, &line), arbiter->friction_mass);
    cairn_motion limit = cairn_motion_factor(pressure, cairn_arbiter_static_friction(world, arbiter));
    if (impulse > limit || -impulse > limit) {
        impulse = cairn_motion_clamp(impulse, cairn_motion_factor(pressure, arbiter->kinetic_friction));
    }
    strike(i, impulse, &line);
}

CAIRN_ONCE cairn_velocity velocity_of(const cairn_body *body)
{
    cairn_velocity v;
    v.x = body->vx;
    v.y = body->vy;
    v.w = body->w;
    return v;
}

/*
 * The velocity after all of the impact's impulses, from their sum: rounded once, and what is cut off is carried to the next
 * impact. A unit of Q4.28 is 9e-7 m/s; of a body 1e5 times as heavy as the one that hits it at 5 m/s that is 1 % of the momentum.
 */
static void sum_up(const cairn_impact *i, int side, const cairn_velocity *before)
{
    cairn_body *body = i->body[side];
    cairn_share share = i->share[side];
    body->vx = before->x;
    body->vy = before->y;
    if (share != 0 && !cairn_body_is_fixed(body)) {
        cairn_motion x = cairn_motion_share_carried(on_side(i->px, side), share, &body->vx_carry);
        cairn_motion y = cairn_motion_share_carried(on_side(i->py, side), share, &body->vy_carry);
        body->vx = cairn_motion_add(body->vx, x);
        body->vy = cairn_motion_add(body->vy, y);
    }
}

/* What acts only after the impact's time is taken from a displacement. */
static cairn_motion taken_back(cairn_motion d, cairn_motion change, cairn_unit time, cairn_motion room)
{
    return cairn_motion_clamp(cairn_motion_add(d, -cairn_motion_unit(change, time)), room);
}

/* The change is not to be repeated by the warm start, and acts only after the impact's time. */
static void settle(cairn_world *world, const cairn_impact *i, cairn_body *body, const cairn_velocity *before)
{
    /* What the sub-steps to come may add to a displacement must fit, too. */
    cairn_motion room = CAIRN_MOTION(7.99) - cairn_world_most_speed(world) * (cairn_world_substeps(world) - i->substep);
    cairn_body_limit_speed(world, body);
    cairn_motion x = cairn_motion_add(body->vx, -before->x), y = cairn_motion_add(body->vy, -before->y), w = cairn_motion_add(body->w, -before->w);
    if (i->substep > 0) {
        cairn_body_repeat_less(body, x, y, w);
    }
    body->dx = taken_back(body->dx, x, i->time, room);
    body->dy = taken_back(body->dy, y, i->time, room);
    body->dw = taken_back(body->dw, w, i->time, room);
}

/* Bodies that lie in one another when they hit are moved apart by half of that. By place and not by speed, which would be energy. */
static void part(const cairn_world *world, const cairn_impact *i, int side)
{
    const cairn_arbiter *arbiter = i->arbiter;
    cairn_motion depth = cairn_motion_half(i->depth - cairn_motion_from_offset(cairn_offset_from_real(world->slop)) - CAIRN_IMPACT_DEEP);
    depth = cairn_motion_above_zero(depth, cairn_world_push_out_limit(world));
    cairn_body *body = i->body[side];
    cairn_motion by = on_side(cairn_motion_share(depth, i->share[side]), side);
    if (by != 0 && !cairn_body_is_fixed(body)) {
        body->dx = cairn_motion_add(body->dx, cairn_motion_dir(by, arbiter->normal_x));
        body->dy = cairn_motion_add(body->dy, cairn_motion_dir(by, arbiter->normal_y));
    }
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
static bool still_closes(cairn_impact *i, const cairn_line *line)
{
    bool any = false;
    for (int k = 0; k < i->arbiter->count; k++) {
        if (i->closing[k] > 0) {
            i->closing[k] = cairn_impact_closing(i, &line[k]);
            any = any || i->closing[k] > 0;
        }
    }
    return any;
}

/* All impulses of the impact, at one moment and one place. */
static void exchange(const cairn_world *world, cairn_impact *i)
{
    cairn_line line[2];
    cairn_motion impulse[2];
    bool closes = true;
    line[0] = cairn_impact_line(i, 0);
    line[1] = cairn_impact_line(i, CAIRN_LAST_ROW);
    for (int n = 0; n < RUBS && closes; n++) {
        resolve(i, line, impulse);
        for (int k = 0; k < i->arbiter->count; k++) {
            strike(i, impulse[k], &line[k]);
        }
        rub(world, i, cairn_motion_add(impulse[0], impulse[1]));
        closes = still_closes(i, line);
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
    cairn_body *a = i->body[0], *b = i->body[1];
    cairn_motion along = cairn_motion_along(b->vy - a->vy, a->vx - b->vx, i->arbiter->normal_x, i->arbiter->normal_y);
    for (int k = 0; k < i->arbiter->count; k++) {
        if (i->closing[k] > 0) {
            i->closing[k] = cairn_motion_add(i->closing[k], -cairn_motion_lean(along, i->lean));
        }
    }
    turn(&a->vx, &a->vy, (cairn_lean)-i->lean);
    turn(&b->vx, &b->vy, (cairn_lean)-i->lean);
}

/* The impact, and what follows from it. */
void cairn_impact_rebound(cairn_world *world, cairn_impact *i)
{
    cairn_velocity before[2];
    before[0] = velocity_of(i->body[0]);
    before[1] = velocity_of(i->body[1]);
    i->px = i->py = 0;
    i->share[0] = i->arbiter->share_a;
    i->share[1] = cairn_arbiter_share_b(i->arbiter);
    i->linear = linear_part(i);
    face_normal(i);
    exchange(world, i);
    turn(&i->px, &i->py, i->lean);
    for (int side = 0; side < 2; side++) {
        sum_up(i, side, &before[side]);
        settle(world, i, i->body[side], &before[side]);
        part(world, i, side);
        hasten(world, i->body[side]);
    }
    i->arbiter->flags |= CAIRN_ARBITER_TOUCHING;
}
