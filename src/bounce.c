/*
 * Restitution: an impact phase at the start of each sub-step. A contact that will close in this sub-step is solved as
 * the impact that it is: at its own time t, with its own speed, by Newton's law u+ = -e u-. Doing it in the sweeps
 * instead stops the body early and rebounds with the speed of the step's start, which loses energy at every bounce.
 *
 * The impulse changes the whole sub-step's motion, so the part of it before t is taken back from the displacement.
 */
#include "engine.h"

#define PASSES 16
/* What rounding may add to a separation, m: so near at the end of the sub-step, and the sweeps would stop the body. */
#define CLOSE CAIRN_MOTION(2e-6)

typedef struct impact {
    cairn_arbiter *arbiter;
    cairn_body *a, *b;
    cairn_factor restitution;
    cairn_factor norm; /* the rounded normal's own square */
    cairn_motion closing[2]; /* speed at the moment of the impact; 0: this point does not take part */
    cairn_motion rest[2];    /* way to go until then */
    cairn_unit time;         /* of the sub-step */
} impact;

static cairn_motion row_velocity(const cairn_body *a, const cairn_body *b, cairn_dir nx, cairn_dir ny, cairn_lever ja, cairn_lever jb)
{
    return cairn_motion_along(b->vx - a->vx, b->vy - a->vy, nx, ny) + cairn_motion_lever(b->w, jb) - cairn_motion_lever(a->w, ja);
}

static cairn_motion row_displacement(const impact *i, const cairn_row *row)
{
    cairn_offset x = cairn_offset_from_motion(i->b->dx) - cairn_offset_from_motion(i->a->dx);
    cairn_offset y = cairn_offset_from_motion(i->b->dy) - cairn_offset_from_motion(i->a->dy);
    return cairn_motion_from_offset(cairn_motion_along(x, y, i->arbiter->normal_x, i->arbiter->normal_y)
                                    + cairn_motion_lever(cairn_offset_from_motion(i->b->dw), row->lever_b)
                                    - cairn_motion_lever(cairn_offset_from_motion(i->a->dw), row->lever_a));
}

static void mix(impact *i, cairn_real *threshold)
{
    const cairn_material *a = i->a->material, *b = i->b->material;
    i->restitution = a->restitution > b->restitution ? a->restitution : b->restitution;
    *threshold = a->restitution == 0 ? b->threshold : b->restitution == 0 || a->threshold < b->threshold ? a->threshold : b->threshold;
}

static cairn_factor coupling(const cairn_arbiter *arbiter, cairn_factor linear, cairn_lever ja, cairn_lever ka, cairn_lever jb, cairn_lever kb)
{
    return linear + cairn_factor_spin(arbiter->share_a, ja, ka) + cairn_factor_spin(arbiter->share_b, jb, kb);
}

static cairn_factor linear_part(const impact *i)
{
    cairn_share share = (i->a->flags & CAIRN_BODY_FIXED_POSITION ? 0 : i->arbiter->share_a)
                      + (i->b->flags & CAIRN_BODY_FIXED_POSITION ? 0 : i->arbiter->share_b);
    return cairn_factor_mul(cairn_factor_from_share(share), i->norm);
}

/* Gravity's pull along the approach; nothing where both fall alike. */
static cairn_motion gravity_along(const cairn_world *world, const impact *i)
{
    const cairn_arbiter *arbiter = i->arbiter;
    if (cairn_body_is_dynamic(i->a) || i->b->flags & CAIRN_BODY_FIXED_POSITION) {
        return 0;
    }
    cairn_motion g = cairn_motion_along(world->gravity_x.whole, world->gravity_y.whole, arbiter->normal_x, arbiter->normal_y);
    return -cairn_motion_factor(g, cairn_factor_from_real(i->b->gravity_scale));
}

/* Which points of the pair hit in this sub-step, how fast, and when the first one does. */
static bool detect(const cairn_world *world, impact *i, int substep)
{
    cairn_arbiter *arbiter = i->arbiter;
    cairn_real limit;
    bool hits = false;
    mix(i, &limit);
    cairn_motion threshold = cairn_motion_from_real(limit, world->substep), gravity = gravity_along(world, i);
    i->time = CAIRN_UNIT(1);
    for (int k = 0; k < arbiter->count; k++) {
        cairn_row *row = &arbiter->rows[k];
        cairn_motion u = row_velocity(i->a, i->b, arbiter->normal_x, arbiter->normal_y, row->lever_a, row->lever_b);
        i->closing[k] = 0;
        if (u >= -threshold) {
            continue;
        }
        /* A pair that touched may have come apart by another impact in this sub-step: then it meets only after that. */
        cairn_motion separation = cairn_motion_add(row->gap > 0 ? row->gap : 0, row_displacement(i, row));
        if (row->gap > 0 || separation > 0) {
            if (row->gap <= 0) {
                row->gap = CAIRN_MOTION(1e-8);
            }
            if (cairn_motion_add(separation, u - gravity) > CLOSE) {
                continue;
            }
            separation = cairn_motion_add(separation, cairn_motion_half(gravity * substep));
        }
        separation = separation < 0 ? 0 : separation;
        cairn_motion closing = cairn_motion_closing(u, gravity, separation);
        if (closing > gravity) { /* slower than a sub-step's fall is rest, whatever the threshold */
            i->closing[k] = closing;
            cairn_unit time = cairn_motion_fraction(separation, cairn_motion_half(cairn_motion_add(closing, -u)));
            i->time = time < i->time ? time : i->time;
            hits = true;
        }
    }
    return hits;
}

/* The impulses along the normal after which each hitting point leaves with -e times its approach: K L = (1 + e) v. */
static void resolve(const impact *i, cairn_motion *first, cairn_motion *second)
{
    const cairn_arbiter *arbiter = i->arbiter;
    const cairn_row *p = &arbiter->rows[0], *q = &arbiter->rows[1];
    cairn_factor linear = linear_part(i), gain = CAIRN_FACTOR(1) + i->restitution;
    cairn_motion bp = cairn_motion_factor(i->closing[0], gain), bq = arbiter->count > 1 ? cairn_motion_factor(i->closing[1], gain) : 0;
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
    if (determinant > CAIRN_FACTOR(0.001)) {
        *first = cairn_motion_divide(cairn_motion_add(cairn_motion_factor(bp, qq), -cairn_motion_factor(bq, pq)), determinant);
        *second = cairn_motion_divide(cairn_motion_add(cairn_motion_factor(bq, pp), -cairn_motion_factor(bp, pq)), determinant);
    }
    if (determinant <= CAIRN_FACTOR(0.001) || *first < 0 || *second < 0) {
        *first = i->closing[0] >= i->closing[1] && pp > 0 ? cairn_motion_divide(bp, pp) : 0;
        *second = *first == 0 && qq > 0 ? cairn_motion_divide(bq, qq) : 0;
    }
}

static void apply(cairn_body *body, cairn_motion px, cairn_motion py, cairn_motion spin)
{
    if (!(body->flags & CAIRN_BODY_FIXED_POSITION)) {
        body->vx = cairn_motion_clamp(cairn_motion_add(body->vx, px), CAIRN_SWEEP_SPEED);
        body->vy = cairn_motion_clamp(cairn_motion_add(body->vy, py), CAIRN_SWEEP_SPEED);
    }
    body->w = cairn_motion_clamp(cairn_motion_add(body->w, spin), CAIRN_SWEEP_SPIN);
}

/* An impulse along (nx, ny) with these levers on both bodies. */
static void strike(impact *i, cairn_motion impulse, cairn_dir nx, cairn_dir ny, cairn_lever ja, cairn_lever jb)
{
    cairn_motion a = -cairn_motion_share(impulse, i->arbiter->share_a), b = cairn_motion_share(impulse, i->arbiter->share_b);
    if (i->arbiter->share_a != 0) {
        apply(i->a, cairn_motion_dir(a, nx), cairn_motion_dir(a, ny), cairn_twist(a, ja));
    }
    apply(i->b, cairn_motion_dir(b, nx), cairn_motion_dir(b, ny), cairn_twist(b, jb));
}

/* Coulomb friction of the impact, from the velocity after the normal impulse. */
static void rub(impact *i, cairn_motion pressure)
{
    cairn_arbiter *arbiter = i->arbiter;
    cairn_dir tx = cairn_dir_negate(arbiter->normal_y), ty = arbiter->normal_x;
    cairn_lever ja = arbiter->friction_lever_a, jb = arbiter->friction_lever_b;
    cairn_motion impulse = -cairn_motion_ratio(row_velocity(i->a, i->b, tx, ty, ja, jb), arbiter->friction_mass);
    cairn_motion limit = cairn_motion_factor(pressure, arbiter->static_friction);
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

/* The change is not to be repeated by the warm start, and acts only after the impact's time. */
static void settle(const cairn_world *world, cairn_body *body, velocity before, cairn_unit time, int substep)
{
    /* What the sub-steps to come may add to a displacement must fit, too. */
    cairn_motion room = CAIRN_MOTION(7.99) - world->speed_limit * (world->substeps - substep);
    cairn_motion x = body->vx - before.x, y = body->vy - before.y, w = body->w - before.w;
    if (substep > 0) {
        body->ux += x;
        body->uy += y;
        body->uw += w;
    }
    body->dx = cairn_motion_clamp(cairn_motion_add(body->dx, -cairn_motion_unit(x, time)), room);
    body->dy = cairn_motion_clamp(cairn_motion_add(body->dy, -cairn_motion_unit(y, time)), room);
    body->dw = cairn_motion_clamp(cairn_motion_add(body->dw, -cairn_motion_unit(w, time)), room);
}

static bool collide(cairn_world *world, cairn_arbiter *arbiter, int substep)
{
    impact i;
    cairn_motion first, second;
    i.arbiter = arbiter;
    i.a = &world->bodies[arbiter->a];
    i.b = &world->bodies[arbiter->b];
    i.norm = cairn_factor_square(arbiter->normal_x, arbiter->normal_y);
    if (!detect(world, &i, substep)) {
        return false;
    }
    velocity a = velocity_of(i.a), b = velocity_of(i.b);
    resolve(&i, &first, &second);
    strike(&i, first, arbiter->normal_x, arbiter->normal_y, arbiter->rows[0].lever_a, arbiter->rows[0].lever_b);
    strike(&i, second, arbiter->normal_x, arbiter->normal_y, arbiter->rows[1].lever_a, arbiter->rows[1].lever_b);
    rub(&i, cairn_motion_add(first, second));
    settle(world, i.a, a, i.time, substep);
    settle(world, i.b, b, i.time, substep);
    arbiter->flags |= CAIRN_ARBITER_TOUCHING;
    arbiter->rows[0].impulse = 0;
    arbiter->rows[1].impulse = 0;
    arbiter->friction_impulse = 0;
    return true;
}

static void impact_phase(cairn_world *world, int substep)
{
    bool any = true;
    for (int pass = 0; pass < PASSES && any; pass++) {
        any = false;
        for (uint16_t place = 0; place < world->arbiter_count; place++) {
            uint16_t at = (uint16_t)(pass & 1 ? world->arbiter_count - 1 - place : place);
            cairn_arbiter *arbiter = cairn_arbiter_at(world, at);
            if ((arbiter->flags & (CAIRN_ARBITER_SOLVED | CAIRN_ARBITER_BOUNCY)) == (CAIRN_ARBITER_SOLVED | CAIRN_ARBITER_BOUNCY)) {
                any = collide(world, arbiter, substep) || any;
            }
        }
    }
}

const cairn_bounce_class cairn_bounce = { impact_phase };
