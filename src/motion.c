/* The motion of bodies in the step: velocities from forces, poses from displacements, and the limits of both. */
#include "engine.h"

/* True if it was beyond the limit. */
CAIRN_ONCE bool limit(cairn_motion *v, cairn_motion most)
{
    cairn_motion before = *v;
    *v = cairn_motion_clamp(before, most);
    return *v != before;
}

void cairn_body_limit_speed(cairn_world *world, cairn_body *body)
{
    cairn_motion most = cairn_world_most_speed(world);
    bool cut = limit(&body->vx, most);
    cut |= limit(&body->vy, most);
    if (CAIRN_WITH_TURNING) {
        cut |= limit(&body->w, most);
    }
    world->stats.saturations += cut;
}

static cairn_motion magnitude(cairn_motion x) { return x < 0 ? -x : x; }

/*
 * How far the surface can move in this step. It lies at most 2 sqrt(2) radii of gyration from the centre, so 3 w bounds its speed by
 * spin; a circle's has none.
 */
static inline cairn_real way_of(const cairn_world *world, const cairn_body *body)
{
    cairn_motion speed = magnitude(body->vx) + magnitude(body->vy); /* at most 5 * 0.93 m a sub-step in all */
    if (CAIRN_WITH_SLOPES && cairn_body_spin(body) != 0 && !cairn_body_is_round(body)) {
        speed += 3 * magnitude(body->w);
    }
    return cairn_real_above_motion(speed) * cairn_world_substeps(world);
}

cairn_offset cairn_body_reach(const cairn_world *world, const cairn_body *body) { return CAIRN_REACH + cairn_offset_from_real(way_of(world, body)); }

/* More than this in a step, m, is brisk; less is in the margin of every box. */
#define BRISK CAIRN_F(0.00125)

static bool is_long(cairn_real way, const cairn_shape *shape) { return way > BRISK && 4 * way > cairn_shape_inradius(shape); }

bool cairn_body_is_fast(const cairn_world *world, const cairn_body *body) { return is_long(way_of(world, body), body->model->shape); }

/* Do boxes of what is brisk cover a wider sector? Without, they are made anew more often. */
#define HAS_WIDE CAIRN_KEEPS_FACING

/* All angles of the sector in which the body looks, so that what hardly turns keeps its box: a 4096th of a turn, or a 64th for what is brisk. */
static void set_extents(cairn_body *body, bool brisk)
{
    const cairn_shape *shape = body->model->shape;
    cairn_real margin = cairn_real_above_offset(CAIRN_REACH) + BRISK, x, y, wider = 0, higher = 0;
    cairn_unit c, s;
    cairn_body_facing(body, &c, &s);
    cairn_shape_extents(shape, c, s, &x, &y);
    if (CAIRN_WITH_SLOPES && cairn_body_can_turn(body) && !cairn_body_is_round(body)) {
        wider = HAS_WIDE && brisk ? cairn_real_wide_sector(y) : cairn_real_sector(y);
        higher = HAS_WIDE && brisk ? cairn_real_wide_sector(x) : cairn_real_sector(x);
    }
    body->extent_x = cairn_extent_above(x + margin + wider);
    body->extent_y = cairn_extent_above(y + margin + higher);
    if (HAS_WIDE) {
        body->flags = (uint16_t)(brisk ? body->flags | CAIRN_BODY_WIDE : body->flags & ~CAIRN_BODY_WIDE);
    }
}

void cairn_body_refresh_extents(cairn_body *body) { set_extents(body, false); }

void cairn_body_face(cairn_body *body)
{
    if (CAIRN_KEEPS_FACING && !(body->flags & CAIRN_BODY_FACING) && body->dx == 0 && body->dy == 0 && !cairn_body_is_round(body)) {
        cairn_angle_rotation(body->angle, &body->dx, &body->dy);
        body->flags |= CAIRN_BODY_FACING;
    }
}

/* For the search a brisk body's box is wider by its way; so what flies keeps its box. */
static inline void widen(cairn_body *body, cairn_real way)
{
    cairn_extent by = cairn_extent_above(way - BRISK);
    body->extent_x = (cairn_extent)(body->extent_x + by); /* at most 126 m and 10 m */
    body->extent_y = (cairn_extent)(body->extent_y + by);
}

static inline void narrow(cairn_body *body)
{
    cairn_extent by = cairn_extent_above(cairn_body_way(body) - BRISK);
    body->extent_x = (cairn_extent)(body->extent_x - by);
    body->extent_y = (cairn_extent)(body->extent_y - by);
}

void cairn_bodies_look_ahead(cairn_world *world)
{
    const cairn_body *end = world->bodies + world->body_end;
    bool watches = cairn_world_continuous(world) != NULL;
    if (CAIRN_WITH_CONTINUOUS) {
        world->fast = 0;
    }
    if (CAIRN_WITH_SHORTCUTS) {
        world->coasted = false;
    }
    unsigned awake = 0;
    for (cairn_body *body = world->bodies; body != end; body++) {
        if (!cairn_body_is_active(body)) {
            continue;
        }
        cairn_real way = way_of(world, body);
        bool brisk = way > BRISK;
        body->dx = body->dy = 0;
        body->dw = way;
        if (CAIRN_WITH_CONTINUOUS) {
            body->flags &= (uint16_t)~CAIRN_BODY_FAST;
        }
        if (CAIRN_WITH_SLOPES && (body->extent_x == 0 || (HAS_WIDE && !brisk && (body->flags & CAIRN_BODY_WIDE)))) {
            cairn_body_face(body);
            set_extents(body, brisk);
        }
        if (brisk) {
            widen(body, way);
            if (watches && is_long(way, body->model->shape)) {
                body->flags |= CAIRN_BODY_FAST;
                world->fast++;
            }
        }
        awake += way != 0 || cairn_body_is_dynamic(body) ? 1u : 0u; /* not what stands still by itself */
    }
    world->stats.awake = (uint16_t)awake;
}

void cairn_bodies_end_search(cairn_world *world)
{
    const cairn_body *end = world->bodies + world->body_end;
    for (cairn_body *body = world->bodies; body != end; body++) {
        if (body->flags & CAIRN_BODY_USED) {
            if (cairn_body_way(body) > BRISK) {
                narrow(body);
            }
            body->dw = 0;
            if (CAIRN_KEEPS_FACING || CAIRN_WITH_CONTINUOUS) { /* else they are */
                body->dx = body->dy = 0;
                body->flags &= (uint16_t)~CAIRN_BODY_FACING;
            }
        }
    }
    if (CAIRN_WITH_CONTINUOUS) {
        world->held_back = false;
    }
}

/* 1 / (1 + c dt) off the velocity once a step: implicit, so any damping is stable. */
static cairn_motion damped(const cairn_world *world, cairn_motion v, cairn_real damping)
{
    if (damping == 0 || v == 0) {
        return v;
    }
    cairn_wide c_dt = cairn_wide_div(cairn_wide_from_real(damping), cairn_wide_from_real(cairn_world_rate(world)));
    return cairn_motion_scale(v, cairn_wide_inverse(cairn_wide_add(cairn_wide_from_int(1), c_dt)));
}

cairn_motion cairn_body_scaled_gravity(const cairn_world *world, cairn_motion gravity, const cairn_body *body)
{
    if (cairn_body_is_fixed(body)) {
        return 0;
    }
    return cairn_motion_clamp(cairn_motion_factor(gravity, cairn_factor_from_real(body->model->gravity_scale)), cairn_world_most_speed(world));
}

static inline void spin_up(cairn_body *body, cairn_motion by)
{
    if (CAIRN_WITH_TURNING) {
        body->w = cairn_motion_add(body->w, by);
    }
}

void cairn_body_start(cairn_world *world, cairn_body *body, cairn_motion gx, cairn_motion gy)
{
    cairn_motion fx = body->ux, fy = body->uy, fw = body->uw;
    if (CAIRN_WITH_DAMPING && !(body->flags & CAIRN_BODY_PLAIN)) {
        body->vx = damped(world, body->vx, body->model->damping);
        body->vy = damped(world, body->vy, body->model->damping);
        if (CAIRN_WITH_TURNING) {
            body->w = damped(world, body->w, body->model->angular_damping);
        }
    }
    body->ux = body->vx;
    body->uy = body->vy;
    if (CAIRN_WITH_TURNING) {
        body->uw = body->w;
    }
    if (body->flags & CAIRN_BODY_PLAIN) {
        body->vx = cairn_motion_add(body->vx + gx, fx);
        body->vy = cairn_motion_add(body->vy + gy, fy);
        spin_up(body, fw);
    } else if (CAIRN_HAS_ODD_BODIES && cairn_body_is_dynamic(body)) {
        body->vx = cairn_motion_add(body->vx + cairn_body_scaled_gravity(world, gx, body), fx);
        body->vy = cairn_motion_add(body->vy + cairn_body_scaled_gravity(world, gy, body), fy);
        spin_up(body, fw);
    }
    if (!CAIRN_WITH_SHORTCUTS || !cairn_motions_are_within(body->vx, body->vy, cairn_body_spin(body), CAIRN_SURELY_SLOW)) {
        cairn_body_limit_speed(world, body);
    }
}

/*
 * Rest. Two rules of the engine, stated openly: (1) a body that stands on two points of one contact, slips nowhere and
 * is slower than CAIRN_REST_SPEED loses its velocity with a time constant of one second: it ends the slow sway of tall
 * stacks, which double precision has as well. What is round stands on one point, and rolls to rest from a quarter of that speed,
 * 12 mm/s: it stays on what leans by 0.002 rad; (2) a body held by contacts whose velocity and displacement are below
 * what the formats can keep straight (DEAD_SPEED) does not move at all.
 */
#define DEAD_SPEED CAIRN_MOTION(6.0e-8)
/* Impulses below the last bit of Q4.28 are rounding in double and hold nothing: a body that glides along a wall is in free fall. */
#define LEAST_PUSH CAIRN_MOTION(3.7e-9)

static bool is_within(cairn_motion x, cairn_motion y, cairn_motion w, cairn_motion limit)
{
    return cairn_motion_is_within(x, limit) && cairn_motion_is_within(y, limit) && cairn_motion_is_within(w, limit);
}

static inline bool is_still(const cairn_world *world, const cairn_body *body)
{
    return is_within(body->vx, body->vy, cairn_body_spin(body), DEAD_SPEED)
        && is_within(body->dx, body->dy, cairn_body_turned(body), 2 * DEAD_SPEED * cairn_world_substeps(world));
}

bool cairn_body_is_under_way(const cairn_world *world, const cairn_body *body)
{
    return !is_within(body->vx, body->vy, cairn_body_spin(body), cairn_motion_shifted(cairn_world_rest_limit(world), 2));
}

bool cairn_body_is_still(const cairn_world *world, const cairn_body *body) { return is_still(world, body); }

static void calm(const cairn_world *world, cairn_body *body)
{
    unsigned state = body->flags & (CAIRN_BODY_UNSTEADY | CAIRN_BODY_GRIPS | CAIRN_BODY_HELD);
    bool stands = CAIRN_WITH_FRICTION && state == (CAIRN_BODY_GRIPS | CAIRN_BODY_HELD); /* without friction all slips */
    bool rolls = CAIRN_WITH_FRICTION && state == (CAIRN_BODY_UNSTEADY | CAIRN_BODY_GRIPS | CAIRN_BODY_HELD) && cairn_body_is_round(body);
    if ((stands || rolls) && is_within(body->vx, body->vy, cairn_body_spin(body), rolls ? cairn_motion_shifted(cairn_world_rest_limit(world), 2) : cairn_world_rest_limit(world))) {
        body->vx -= cairn_motion_ratio(body->vx, cairn_world_rest_damping(world));
        body->vy -= cairn_motion_ratio(body->vy, cairn_world_rest_damping(world));
        if (CAIRN_WITH_TURNING) {
            body->w -= cairn_motion_ratio(body->w, cairn_world_rest_damping(world));
        }
    }
    if (!((CAIRN_WITH_BLOCKS || CAIRN_WITH_SLEEP) && (body->flags & CAIRN_BODY_RESTLESS)) && is_still(world, body)) {
        body->vx = body->vy = 0;
        body->dx = body->dy = 0;
        if (CAIRN_WITH_TURNING) {
            body->w = body->dw = 0;
        }
    }
}

/* Does the contact give way at the limit of friction? */
static inline bool slips(const cairn_arbiter *arbiter, cairn_motion pressure)
{
    return magnitude(arbiter->friction_impulse) >= cairn_motion_factor(pressure, arbiter->kinetic_friction);
}

/*
 * A slope's normal is off by its last bit, 3e-5 rad, and nothing takes back what its impulses do along the slope. So what slides or rolls on something
 * static gets what they lacked in this step, products' roundings with it. What is at rest needs none: friction holds it.
 */
CAIRN_APART void straighten_push(const cairn_world *world, const cairn_arbiter *arbiter)
{
    cairn_body *b = &world->bodies[arbiter->b];
    cairn_motion pressure = cairn_arbiter_pressure(arbiter);
    if ((slips(arbiter, pressure) || cairn_body_is_under_way(world, b)) && !(arbiter->block & CAIRN_BLOCK_NUMBER)
        && !cairn_body_is_fixed(b)) {
        cairn_motion_add_lack(&b->vx, &b->vy, pressure, arbiter->friction_impulse, arbiter->normal_x, arbiter->normal_y, (cairn_lean)arbiter->friction_lever_a,
                              cairn_world_substeps(world), world->stats.steps);
    }
}

/* A contact that pushes acted on its bodies. */
static inline void mark_rest(cairn_body *a, cairn_body *b, const cairn_arbiter *arbiter, cairn_motion first, cairn_motion second)
{
    unsigned kept = ~0u;
    if (CAIRN_WITH_SOFT_SOLVER && CAIRN_WITH_FRICTION) {
        kept = ~(cairn_flag_if(slips(arbiter, first + second), CAIRN_BODY_GRIPS) | cairn_flag_if(first > 0 && second > 0, CAIRN_BODY_UNSTEADY));
    }
    if (!(arbiter->flags & CAIRN_ARBITER_ON_STATIC)) {
        a->flags = (uint16_t)((a->flags & kept) | CAIRN_BODY_HELD);
    }
    b->flags = (uint16_t)((b->flags & kept) | CAIRN_BODY_HELD);
}

/* Which bodies a contact acted on, and which pairs touched. */
static void mark_held(cairn_world *world)
{
    const uint16_t *end = world->order + world->arbiter_count;
    cairn_arbiter *arbiters = world->arbiters;
    cairn_body *bodies = world->bodies;
    unsigned points = 0, solved = 0;
    bool soft = cairn_world_is_soft(world);
    for (const uint16_t *at = world->order; at != end; at++) {
        cairn_arbiter *arbiter = &arbiters[*at];
        unsigned flags = arbiter->flags;
        if (!CAIRN_WITH_HOLD || !soft) { /* else hold.c does it */
            arbiter->flags = (uint8_t)(flags &= ~(unsigned)CAIRN_ARBITER_FRESH);
        }
        if ((CAIRN_WITH_SENSORS || CAIRN_WITH_SLEEP || CAIRN_WITH_SHORTCUTS) && !(flags & CAIRN_ARBITER_SOLVED)) {
            continue;
        }
        cairn_motion first = arbiter->rows[0].impulse, second = cairn_arbiter_has_two(arbiter) ? arbiter->rows[CAIRN_LAST_ROW].impulse : 0;
        points += arbiter->count;
        solved++;
        if (first >= LEAST_PUSH || second >= LEAST_PUSH) {
            arbiter->flags = (uint8_t)(flags | CAIRN_ARBITER_TOUCHING);
            mark_rest(&bodies[arbiter->a], &bodies[arbiter->b], arbiter, first, second);
            if (soft && CAIRN_WITH_SLOPES && (flags & CAIRN_ARBITER_ON_STATIC) && arbiter->friction_lever_a != 0) {
                straighten_push(world, arbiter);
            }
        }
    }
    world->stats.points = (uint16_t)points;
    world->stats.solved = (uint16_t)solved;
}

/* Stop a coordinate at the edge of the world: its displacement is then not what it was to be. */
static void stop_at_edge(cairn_world *world, cairn_real *x, cairn_residue *residue, cairn_motion *v, cairn_motion *by)
{
    if (!cairn_real_is_within(*x, CAIRN_WORLD_EDGE)) {
        *x = *x > 0 ? CAIRN_WORLD_EDGE : -CAIRN_WORLD_EDGE;
        *residue = cairn_residue_zero();
        *v = 0;
        *by = CAIRN_MOTION(1);
        world->stats.saturations++;
    }
}

static inline void move(cairn_world *world, cairn_body *body)
{
    cairn_residue rx = body->x_residue, ry = body->y_residue;
    cairn_coordinate_move(&body->x, &rx, body->dx);
    cairn_coordinate_move(&body->y, &ry, body->dy);
    if (CAIRN_SMALL || !cairn_real_is_within(body->x, CAIRN_WORLD_EDGE) || !cairn_real_is_within(body->y, CAIRN_WORLD_EDGE)) {
        stop_at_edge(world, &body->x, &rx, &body->vx, &body->dx);
        stop_at_edge(world, &body->y, &ry, &body->vy, &body->dy);
    }
    body->x_residue = rx & CAIRN_RESIDUE_BITS;
    body->y_residue = ry & CAIRN_RESIDUE_BITS;
    if (cairn_body_turned(body) != 0) {
        cairn_angle before = body->angle;
        body->angle = cairn_angle_add(before, cairn_angle_from_motion(body->dw, cairn_body_inverse_gyration(body)));
        if (CAIRN_WITH_SLOPES && !cairn_angle_is_in_sector(before, body->angle) && !cairn_body_is_round(body)
            && !(HAS_WIDE && (body->flags & CAIRN_BODY_WIDE) && cairn_angle_is_in_wide_sector(before, body->angle))) {
            body->extent_x = 0;
        }
    }
}

void cairn_body_move(cairn_world *world, cairn_body *body) { move(world, body); }

/*
 * Symplectic Euler goes half a sub-step's gravity too far in every sub-step. Where nothing but gravity acted, taking
 * that back gives the parabola exactly.
 */
static void straighten(const cairn_world *world, cairn_body *body)
{
    cairn_motion gx = cairn_body_gravity(world, world->gravity_x.whole, body), gy = cairn_body_gravity(world, world->gravity_y.whole, body);
    body->dx -= cairn_motion_half(gx * cairn_world_substeps(world));
    body->dy -= cairn_motion_half(gy * cairn_world_substeps(world));
}

/* What took part in the sub-steps. */
static inline void finish(cairn_world *world, cairn_body *body)
{
    if (cairn_body_is_dynamic(body)) {
        if (!(body->flags & (CAIRN_BODY_HELD | CAIRN_BODY_SPRING))) {
            straighten(world, body);
        } else if (cairn_world_is_soft(world)) {
            calm(world, body);
        }
    }
    if (CAIRN_WITH_SOFT_SOLVER /* whose sweeps have a wider limit of their own */
        && (!CAIRN_WITH_SHORTCUTS || !cairn_motions_are_within(body->vx, body->vy, cairn_body_spin(body), CAIRN_SURELY_SLOW))) {
        cairn_body_limit_speed(world, body);
    }
    body->flags &= (uint16_t)~(CAIRN_ASKS_WHO_MET ? CAIRN_BODY_HELD | CAIRN_BODY_UNSTEADY | CAIRN_BODY_GRIPS | CAIRN_BODY_RESTLESS : CAIRN_BODY_HELD);
    move(world, body);
    body->uy = 0;
    if (CAIRN_WITH_TURNING) {
        body->uw = 0;
    }
}

void cairn_bodies_finish(cairn_world *world)
{
    mark_held(world);
    const cairn_body *end = world->bodies + world->body_end;
    for (cairn_body *body = world->bodies; body != end;) {
        cairn_body *next = body + 1;
        if (CAIRN_ASKS_WHO_MET ? (body->flags & (CAIRN_BODY_GOES | CAIRN_BODY_HELD)) != 0 : cairn_body_goes(body)) {
            finish(world, body);
        } else if (CAIRN_WITH_SHORTCUTS && world->coasted) {
            next = cairn_body_skip(world, body);
        } else if (CAIRN_COASTS && cairn_body_is_active(body)) { /* else all that moves goes */
            cairn_body_move(world, body);
        }
        body->ux = 0;
        body = next;
    }
    if (CAIRN_WITH_HOLD && cairn_world_is_soft(world)) {
        cairn_arbiters_follow(world);
    }
}
