/* The motion of bodies in the step: velocities from forces, poses from displacements, and the limits of both. */
#include "engine.h"

void cairn_body_limit_speed(cairn_world *world, cairn_body *body)
{
    cairn_motion vx = cairn_motion_clamp(body->vx, world->speed_limit), vy = cairn_motion_clamp(body->vy, world->speed_limit);
    cairn_motion w = cairn_motion_clamp(body->w, world->spin_limit);
    if (vx != body->vx || vy != body->vy || w != body->w) {
        world->stats.saturations++;
        body->vx = vx;
        body->vy = vy;
        body->w = w;
    }
}

static cairn_motion magnitude(cairn_motion x) { return x < 0 ? -x : x; }

/*
 * How far the surface can move in this step. It lies at most 2 sqrt(2) radii of gyration from the centre, so 3 w bounds its speed by
 * spin; a circle's has none.
 */
static cairn_offset way_of(const cairn_world *world, const cairn_body *body)
{
    cairn_offset speed = cairn_offset_from_motion(magnitude(body->vx)) + cairn_offset_from_motion(magnitude(body->vy));
    if (body->model->shape->kind->outline != NULL) {
        speed += 3 * cairn_offset_from_motion(magnitude(body->w));
    }
    return speed * world->substeps;
}

cairn_offset cairn_body_reach(const cairn_world *world, const cairn_body *body) { return CAIRN_REACH + way_of(world, body); }

/* More than this in a step is in the margin of a body's box; less is in that of every box. */
#define BRISK (CAIRN_REACH / 4)

static bool is_long(cairn_offset way, const cairn_shape *shape)
{
    return way > BRISK && 4 * way > cairn_offset_from_real(shape->kind->inradius(shape));
}

bool cairn_body_is_fast(const cairn_world *world, const cairn_body *body) { return is_long(way_of(world, body), body->model->shape); }

/* Those of all angles of the sector in which it looks: what hardly turns keeps them. */
static void set_extents(cairn_body *body, cairn_offset way)
{
    const cairn_shape *shape = body->model->shape;
    cairn_real margin = cairn_real_above_offset(CAIRN_REACH + (way > BRISK ? way : BRISK)), x, y;
    cairn_unit c, s;
    cairn_body_facing(body, &c, &s);
    shape->kind->extents(shape, c, s, &x, &y);
    bool turns = cairn_body_can_turn(body) && !cairn_body_is_round(body);
    body->extent_x = cairn_extent_above(x + margin + (turns ? cairn_real_sector(y) : 0));
    body->extent_y = cairn_extent_above(y + margin + (turns ? cairn_real_sector(x) : 0));
    body->flags = (uint16_t)(way > BRISK ? body->flags | CAIRN_BODY_WIDE : body->flags & ~CAIRN_BODY_WIDE);
}

void cairn_body_refresh_extents(const cairn_world *world, cairn_body *body) { set_extents(body, way_of(world, body)); }

void cairn_body_face(cairn_body *body)
{
    if (!(body->flags & CAIRN_BODY_FACING) && body->dx == 0 && body->dy == 0 && !cairn_body_is_round(body)) {
        cairn_angle_rotation(body->angle, &body->dx, &body->dy);
        body->flags |= CAIRN_BODY_FACING;
    }
}

void cairn_bodies_look_ahead(cairn_world *world)
{
    const cairn_body *end = world->bodies + world->body_end;
    bool watches = world->continuous != NULL;
    world->stats.awake = 0;
    world->fast = 0;
    for (cairn_body *body = world->bodies; body != end; body++) {
        if (!cairn_body_is_active(body)) {
            continue;
        }
        cairn_offset way = way_of(world, body);
        body->dw = way;
        if (way > BRISK || (body->flags & CAIRN_BODY_WIDE) || body->extent_x == 0) {
            cairn_body_face(body);
            set_extents(body, way);
        }
        body->flags &= (uint16_t)~CAIRN_BODY_FAST;
        if (watches && is_long(way, body->model->shape)) {
            body->flags |= CAIRN_BODY_FAST;
            world->fast++;
        }
        world->stats.awake++;
    }
}

void cairn_bodies_end_search(cairn_world *world)
{
    const cairn_body *end = world->bodies + world->body_end;
    for (cairn_body *body = world->bodies; body != end; body++) {
        if (body->flags & CAIRN_BODY_USED) {
            body->dx = body->dy = body->dw = 0;
            body->flags &= (uint16_t)~CAIRN_BODY_FACING;
        }
    }
    world->held_back = false;
}

/* 1 / (1 + c dt) off the velocity once a step: implicit, so any damping is stable. */
static cairn_motion damped(const cairn_world *world, cairn_motion v, cairn_real damping)
{
    if (damping == 0 || v == 0) {
        return v;
    }
    cairn_wide c_dt = cairn_wide_div(cairn_wide_from_real(damping), cairn_wide_from_real(world->rate));
    return cairn_motion_scale(v, cairn_wide_div(cairn_wide_from_int(1), cairn_wide_add(cairn_wide_from_int(1), c_dt)));
}

static cairn_motion scaled(cairn_motion gravity, const cairn_body *body)
{
    if (body->flags & CAIRN_BODY_FIXED_POSITION) {
        return 0;
    }
    return cairn_motion_factor(gravity, cairn_factor_from_real(body->model->gravity_scale));
}

void cairn_body_start(cairn_world *world, cairn_body *body, cairn_motion gx, cairn_motion gy)
{
    cairn_motion fx = body->ux, fy = body->uy, fw = body->uw;
    if (!(body->flags & CAIRN_BODY_PLAIN)) {
        body->vx = damped(world, body->vx, body->model->damping);
        body->vy = damped(world, body->vy, body->model->damping);
        body->w = damped(world, body->w, body->model->angular_damping);
    }
    body->ux = body->vx;
    body->uy = body->vy;
    body->uw = body->w;
    if (body->flags & CAIRN_BODY_PLAIN) {
        body->vx = cairn_motion_add(body->vx + gx, fx);
        body->vy = cairn_motion_add(body->vy + gy, fy);
        body->w = cairn_motion_add(body->w, fw);
    } else if (cairn_body_is_dynamic(body)) {
        body->vx = cairn_motion_add(body->vx + scaled(gx, body), fx);
        body->vy = cairn_motion_add(body->vy + scaled(gy, body), fy);
        body->w = cairn_motion_add(body->w, fw);
    }
    cairn_body_limit_speed(world, body);
}

/*
 * Rest. Two rules of the engine, stated openly: (1) a body that stands on two points of one contact, slips nowhere and
 * is slower than CAIRN_REST_SPEED loses its velocity with a time constant of one second: it ends the slow sway of tall
 * stacks, which double precision has as well; (2) a body held by contacts whose velocity and displacement are below
 * what the formats can keep straight (DEAD_SPEED) does not move at all.
 */
#define DEAD_SPEED CAIRN_MOTION(6.0e-8)
/* Impulses below the last bit of Q4.28 are rounding in double and hold nothing: a body that glides along a wall is in free fall. */
#define LEAST_PUSH CAIRN_MOTION(3.7e-9)

static void mark_rest(cairn_world *world, const cairn_arbiter *arbiter)
{
    cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    bool on_two = arbiter->count > 1 && arbiter->rows[0].impulse > 0 && arbiter->rows[1].impulse > 0;
    cairn_motion limit = cairn_motion_factor(arbiter->rows[0].impulse + (arbiter->count > 1 ? arbiter->rows[1].impulse : 0),
                                             arbiter->kinetic_friction);
    bool slips = magnitude(arbiter->friction_impulse) >= limit;
    unsigned marks = CAIRN_BODY_HELD | cairn_flag_if(slips, CAIRN_BODY_SLIPPING) | cairn_flag_if(on_two, CAIRN_BODY_STEADY);
    a->flags = (uint16_t)(a->flags | marks);
    b->flags = (uint16_t)(b->flags | marks);
}

static bool is_within(cairn_motion x, cairn_motion y, cairn_motion w, cairn_motion limit)
{
    return magnitude(x) <= limit && magnitude(y) <= limit && magnitude(w) <= limit;
}

static inline bool is_still(const cairn_world *world, const cairn_body *body)
{
    return is_within(body->vx, body->vy, body->w, DEAD_SPEED)
        && is_within(body->dx, body->dy, body->dw, 2 * DEAD_SPEED * world->substeps);
}

bool cairn_body_is_still(const cairn_world *world, const cairn_body *body) { return is_still(world, body); }

static void calm(const cairn_world *world, cairn_body *body)
{
    if ((body->flags & (CAIRN_BODY_STEADY | CAIRN_BODY_SLIPPING)) == CAIRN_BODY_STEADY
        && is_within(body->vx, body->vy, body->w, world->rest_limit)) {
        body->vx -= cairn_motion_ratio(body->vx, world->rest_damping);
        body->vy -= cairn_motion_ratio(body->vy, world->rest_damping);
        body->w -= cairn_motion_ratio(body->w, world->rest_damping);
    }
    if (!(body->flags & CAIRN_BODY_RESTLESS) && is_still(world, body)) {
        body->vx = body->vy = body->w = 0;
        body->dx = body->dy = body->dw = 0;
    }
}

/* Which bodies a contact acted on, and which pairs touched. */
static void mark_held(cairn_world *world)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (!(arbiter->flags & CAIRN_ARBITER_SOLVED)) {
            continue;
        }
        world->stats.points = (uint16_t)(world->stats.points + arbiter->count);
        if (arbiter->rows[0].impulse >= LEAST_PUSH || (arbiter->count > 1 && arbiter->rows[1].impulse >= LEAST_PUSH)) {
            arbiter->flags |= CAIRN_ARBITER_TOUCHING;
            mark_rest(world, arbiter);
        }
    }
}

/* Stop a coordinate at the edge of the world: its displacement is then not what it was to be. */
static cairn_residue move_coordinate(cairn_world *world, cairn_real *x, cairn_residue residue, cairn_motion *v, cairn_motion *by)
{
    cairn_coordinate_move(x, &residue, *by);
    if (*x > CAIRN_WORLD_EDGE || *x < -CAIRN_WORLD_EDGE) {
        *x = *x > 0 ? CAIRN_WORLD_EDGE : -CAIRN_WORLD_EDGE;
        residue = cairn_residue_zero();
        *v = 0;
        *by = CAIRN_MOTION(1);
        world->stats.saturations++;
    }
    return residue;
}

/*
 * Symplectic Euler goes half a sub-step's gravity too far in every sub-step. Where nothing but gravity acted, taking
 * that back gives the parabola exactly.
 */
static void straighten(const cairn_world *world, cairn_body *body)
{
    cairn_motion gx = world->gravity_x.whole, gy = world->gravity_y.whole;
    if (!(body->flags & CAIRN_BODY_PLAIN)) {
        gx = scaled(gx, body);
        gy = scaled(gy, body);
    }
    body->dx -= cairn_motion_half(gx * world->substeps);
    body->dy -= cairn_motion_half(gy * world->substeps);
}

void cairn_bodies_finish(cairn_world *world)
{
    mark_held(world);
    const cairn_body *end = world->bodies + world->body_end;
    for (cairn_body *body = world->bodies; body != end; body++) {
        if (!cairn_body_is_active(body)) {
            continue;
        }
        if (cairn_body_is_dynamic(body) && !(body->flags & (CAIRN_BODY_HELD | CAIRN_BODY_SPRING))) {
            straighten(world, body);
        } else if (cairn_body_is_dynamic(body)) {
            calm(world, body);
        }
        if (!is_within(body->vx, body->vy, body->w, world->speed_limit)) { /* the sweeps' own limit is a wider one */
            cairn_body_limit_speed(world, body);
        }
        body->flags &= (uint16_t)~(CAIRN_BODY_HELD | CAIRN_BODY_STEADY | CAIRN_BODY_SLIPPING | CAIRN_BODY_RESTLESS);
        body->x_residue = move_coordinate(world, &body->x, body->x_residue, &body->vx, &body->dx) & CAIRN_RESIDUE_BITS;
        body->y_residue = move_coordinate(world, &body->y, body->y_residue, &body->vy, &body->dy) & CAIRN_RESIDUE_BITS;
        if (body->dw != 0) {
            cairn_angle before = body->angle;
            body->angle = cairn_angle_add(before, cairn_angle_from_motion(body->dw, cairn_body_inverse_gyration(body)));
            if (!cairn_angle_is_in_sector(before, body->angle) && !cairn_body_is_round(body)) {
                body->extent_x = 0;
            }
        }
        body->ux = body->uy = body->uw = 0;
    }
    cairn_arbiters_follow(world);
    for (uint16_t i = 0; i < world->body_end; i++) { /* now, since the impact phase comes before the next start */
        cairn_body *body = &world->bodies[i];
        if (body->flags & CAIRN_BODY_USED) {
            body->dx = body->dy = body->dw = 0;
        }
    }
}
