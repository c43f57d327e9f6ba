/*
 * Continuous collision, for bodies that move by more than a quarter of their size in a step.
 *
 * Before the solver: two bodies that will meet are given the contact of the moment in which they meet, found by
 * conservative advancement along the separating axis (Mirtich). Its rows close at the right time with the right normal and levers, so that
 * restitution and sliding come out as they should, and a body that will miss gets no contact at all.
 * After the solver: a displacement that would carry a body's core, a disc of nine tenths of its inner radius, into another body is cut
 * to what the two do together. That catches whatever the step did not foresee, as a third body behind a bounce.
 */
#include "engine.h"

#define ADVANCES 24
/* A distance that counts as touching, */
#define HIT CAIRN_OFFSET(0.00025)
/* and one from which a contact's normal may be told. */
#define NEAR CAIRN_OFFSET(0.006)
/* Turning near another body is followed in parts of the step. */
#define TURN CAIRN_UNIT(1.0 / 16)
/* Far beyond any motion of a step. */
#define ANY_DISTANCE CAIRN_OFFSET(100)

/* Where a body goes in this step. */
typedef struct course {
    const cairn_body *body;
    cairn_offset x, y;   /* at the start, relative to the first body's start */
    cairn_offset dx, dy; /* in the step */
    cairn_angle turn;
    cairn_offset sweep;  /* bound on how far turning moves any of its surface */
} course;

CAIRN_ONCE cairn_offset magnitude(cairn_offset x) { return x < 0 ? -x : x; }

/* Surfaces lie within 2 sqrt(2) radii of gyration of the centre; a circle's does not move by turning. */
static cairn_offset sweep_of(const cairn_body *body, cairn_motion w)
{
    return cairn_body_is_round(body) ? 0 : 3 * magnitude(cairn_offset_from_motion(w));
}

/* The angle by which it turns; none for what is round. */
static cairn_angle turn_of(const cairn_body *body, cairn_motion w)
{
    return cairn_body_is_round(body) ? 0 : cairn_angle_from_motion(w, cairn_body_inverse_gyration(body));
}

/* By the velocities of the step's start; a spin beyond the limit will be cut to it. */
static course ahead(const cairn_world *world, const cairn_body *body, cairn_offset x, cairn_offset y)
{
    cairn_motion w = cairn_motion_clamp(body->w, cairn_world_most_speed(world));
    course c;
    c.body = body;
    c.x = x;
    c.y = y;
    c.dx = cairn_offset_from_motion(cairn_motion_add(body->vx, cairn_body_held_x(body))) * cairn_world_substeps(world);
    c.dy = cairn_offset_from_motion(cairn_motion_add(body->vy, cairn_body_held_y(body))) * cairn_world_substeps(world);
    c.turn = turn_of(body, w * cairn_world_substeps(world));
    c.sweep = sweep_of(body, w) * cairn_world_substeps(world);
    return c;
}

static cairn_pose pose_at(const course *c, cairn_unit time)
{
    cairn_pose pose;
    pose.shape = c->body->model->shape;
    pose.x = c->x + cairn_offset_mul(c->dx, time);
    pose.y = c->y + cairn_offset_mul(c->dy, time);
    if (c->turn == 0) {
        cairn_body_facing(c->body, &pose.c, &pose.s);
    } else {
        cairn_angle_rotation(cairn_angle_add(c->body->angle, cairn_angle_part(c->turn, time)), &pose.c, &pose.s);
    }
    return pose;
}

/* What holds where the narrow phase finds nothing: it sets no normal for shapes beyond any distance. */
CAIRN_ONCE void expect_nothing(cairn_manifold *out)
{
    out->normal_x = out->normal_y = 0;
    out->separation = ANY_DISTANCE;
}

/* The two where they are at a time of the step. */
static void look(const course *a, const course *b, cairn_unit time, cairn_manifold *out)
{
    cairn_pose pa = pose_at(a, time), pb = pose_at(b, time);
    expect_nothing(out);
    cairn_poses_collide(&pa, &pb, ANY_DISTANCE, out);
    out->time = time;
}

/* The part of the step in which `way` is covered at this speed; all of it if that is too slow. */
CAIRN_ONCE cairn_unit time_for(cairn_offset way, cairn_offset speed)
{
    return speed > way ? cairn_offset_fraction(way, speed) : CAIRN_UNIT(1);
}

/* How fast the two come nearer going straight, in a step. */
static cairn_offset straight_speed(const course *a, const course *b, const cairn_manifold *at)
{
    return -cairn_offset_dot(b->dx - a->dx, b->dy - a->dy, at->normal_x, at->normal_y);
}

/* ---- passing by ---- */

/* An overlap this small is slid over: bodies at rest on one another lie that deep in one another. */
#define GRAZE CAIRN_OFFSET(0.002)
/* Nearing by less in a step is no motion against the other one. */
#define CREEP CAIRN_OFFSET(0.00002)
#define LOOKS 4

static cairn_offset larger(cairn_offset x, cairn_offset y) { return magnitude(x) > magnitude(y) ? magnitude(x) : magnitude(y); }

static cairn_offset least_radius(const cairn_body *a, const cairn_body *b)
{
    cairn_real ra = cairn_shape_inradius(a->model->shape), rb = cairn_shape_inradius(b->model->shape);
    return cairn_offset_from_real(ra < rb ? ra : rb);
}

/*
 * Two surfaces side by side, as the tiles of a floor, have corners between them that are no obstacle to what slides over
 * them. But before that is over the second one, the axis that separates the two most is the direction in which it slides.
 * So look on along the way: as long as the overlap is no more than what is slid over, the contact is the one seen later.
 * a and b are the poses at the time of the contact (b is moved), (x, y) the way of b against a from then on, which takes `span` of a step.
 */
static void look_beyond(const cairn_pose *a, cairn_pose *b, cairn_offset x, cairn_offset y, cairn_unit span, cairn_offset margin,
                        cairn_manifold *out)
{
    cairn_manifold then;
    cairn_offset from_x = b->x, from_y = b->y, separation = out->separation;
    cairn_unit time = 0;
    cairn_offset opposed = -cairn_offset_dot(x, y, out->normal_x, out->normal_y), closing = opposed;
    for (int i = 0; i < LOOKS && closing > CREEP && time != CAIRN_UNIT(1); i++) {
        cairn_unit part = time_for(separation + 2 * GRAZE, closing), rest = CAIRN_UNIT(1) - time;
        time += part < rest ? part : rest;
        b->x = from_x + cairn_offset_mul(x, time);
        b->y = from_y + cairn_offset_mul(y, time);
        expect_nothing(&then);
        cairn_poses_collide(a, b, margin, &then);
        if (then.count == 0 || then.separation < -GRAZE) {
            return;
        }
        separation = then.separation;
        closing = -cairn_offset_dot(x, y, then.normal_x, then.normal_y);
        if (closing < opposed - opposed / 4) {
            cairn_unit later = cairn_offset_mul(span, time), met = out->time;
            cairn_copy(out, &then, sizeof then);
            out->time = met < CAIRN_UNIT(1.9) - later ? met + later : CAIRN_UNIT(1.9);
        }
    }
}

/* What two bodies do in this step. */
typedef enum outcome { OUTCOME_MISS, OUTCOME_NEAR, OUTCOME_TOUCH } outcome;

/*
 * Advance until the two touch. Neither going straight nor turning may cover more than the
 * distance; but beside a body that turns, the bound on turning gives ever smaller parts, so that near it, and
 * late, turning is followed in parts of TURN instead: a corner then grazes unseen by w^2 TURN^2 r / 8, 0.1 mm at 60 rad/s and 0.15 m.
 * `out` holds the contact as it was seen last before they touched, for a corner that is in already may have the wrong normal.
 * What is near the other one when the step ends has its contact too, for the forces that are not foreseen.
 */
CAIRN_APART outcome find_meeting(const course *a, const course *b, cairn_manifold *out)
{
    cairn_unit time = 0;
    bool near = false;
    for (int i = 0; i < ADVANCES; i++) {
        cairn_manifold now;
        look(a, b, time, &now);
        bool touches = now.separation <= HIT && now.count > 0, was_near = near;
        near = now.separation <= NEAR && now.count > 0;
        if (near && !(touches && was_near)) {
            cairn_copy(out, &now, sizeof now);
        }
        if (touches) {
            return OUTCOME_TOUCH;
        }
        cairn_offset straight = straight_speed(a, b, &now), way = now.separation > 2 * HIT ? now.separation - HIT : HIT;
        cairn_unit part = time_for(way, straight + a->sweep + b->sweep), rest = CAIRN_UNIT(1) - time;
        if (rest == 0 || (part >= rest && !near)) {
            return near ? OUTCOME_NEAR : OUTCOME_MISS;
        }
        if (part < TURN && (near || i >= ADVANCES / 3)) {
            part = time_for(way, straight);
            part = part < TURN ? part : TURN;
        }
        time += part < rest ? part : rest;
    }
    return near ? OUTCOME_NEAR : OUTCOME_MISS;
}

static void meet(const cairn_world *world, const cairn_body *a, const cairn_body *b, cairn_manifold *out)
{
    course ca = ahead(world, a, 0, 0);
    course cb = ahead(world, b, cairn_bodies_apart_x(a, b),
                      cairn_bodies_apart_y(a, b));
    outcome found = find_meeting(&ca, &cb, out);
    if (found == OUTCOME_MISS) {
        out->count = 0;
        return;
    }
    if (cairn_body_is_sensing(a) || cairn_body_is_sensing(b)) {
        if (found == OUTCOME_TOUCH) {
            out->points[0].separation = 0; /* it counts as touching: a sensor must not miss what flies through */
        }
        return;
    }
    if (out->separation >= -GRAZE) {
        cairn_offset reach = cairn_offset_half(least_radius(a, b)), x = cb.dx - ca.dx, y = cb.dy - ca.dy, size = larger(x, y);
        cairn_unit span = size > reach ? cairn_offset_fraction(reach, size) : CAIRN_UNIT(1);
        cairn_pose pa = pose_at(&ca, out->time), pb = pose_at(&cb, out->time);
        look_beyond(&pa, &pb, cairn_offset_mul(x, span), cairn_offset_mul(y, span), span, ANY_DISTANCE, out);
    }
}

/* What holds b back against a, without the part along their own contact's normal: that contact is in question itself. */
static cairn_offset2 held_back(const cairn_body *a, const cairn_body *b, const cairn_manifold *contact)
{
    cairn_offset2 by;
    by.x = cairn_offset_from_motion(cairn_body_held_x(b) - cairn_body_held_x(a));
    by.y = cairn_offset_from_motion(cairn_body_held_y(b) - cairn_body_held_y(a));
    if (by.x != 0 || by.y != 0) {
        cairn_offset own = cairn_offset_dot(by.x, by.y, contact->normal_x, contact->normal_y);
        by.x -= cairn_offset_mul(own, contact->normal_x);
        by.y -= cairn_offset_mul(own, contact->normal_y);
    }
    return by;
}

/* The way to look along: two steps' motion, for a corner is felt a step before it is passed, and at least 4 GRAZE; see CAIRN_LOOK_WAY. */
#define DOUBLINGS 7

/*
 * Too broad a contact to be slid past, where the way (x, y) goes straight against it within a quarter. What would be slid over instead is a
 * face with a normal m along which the two near one another by less than 3/4 of that, so its angle to n has a sine of 0.49 at least.
 * The points of both surfaces lie within the contact's gap of one another, and are `broad` apart across n: along m the two
 * overlap by at least broad / 2 - gap now, by broad / 2 - gap - way later, and it is no face to slide over if that is more than GRAZE.
 */
static bool is_broad(const cairn_manifold *contact, cairn_offset closing, cairn_offset across)
{
    if (contact->count < 2) {
        return false;
    }
    const cairn_manifold_point *p = &contact->points[0], *q = &contact->points[1];
    cairn_offset broad = magnitude(cairn_offset_dot(q->y - p->y, p->x - q->x, contact->normal_x, contact->normal_y));
    cairn_offset gap = larger(p->separation, q->separation);
    return across <= closing / 4 && cairn_offset_half(broad) > GRAZE + gap + closing + across;
}

/*
 * Nor is what a circle of radius r touches, where it hardly slides. Let d be r and the gap: the way from the surface's nearest point to the
 * centre, which changes by no more than the bodies move to one another, at most |w|. So the normal turns by an angle of sine |w| / d at most, which
 * is below 1/4, and along it the two still near one another by 0.968 of what they do now, less than |w| / d of what they go across: that is above the 3/4 from
 * which on another contact is taken, if the latter is at most 1/5.
 */
static bool is_round(cairn_offset d, cairn_offset way, cairn_offset closing, cairn_offset across)
{
    return way < d / 4 && cairn_offset_cross(closing, 5 * across, way, d) > 0;
}

/* The radius of the circle, if one of the two is one. */
static cairn_offset round_of(const cairn_body *a, const cairn_body *b)
{
    cairn_real ra = cairn_body_is_round(a) ? a->model->shape->size.x : 0, rb = cairn_body_is_round(b) ? b->model->shape->size.x : 0;
    return cairn_offset_from_real(ra > rb ? ra : rb);
}

/* Is it known of a contact that a look along the way (x, y) finds no other one? */
static bool is_settled(const cairn_body *a, const cairn_body *b, cairn_offset x, cairn_offset y, const cairn_manifold *contact)
{
    cairn_offset way = magnitude(x) + magnitude(y);
    if (way < contact->steady) {
        return true;
    }
    cairn_unit nx = contact->normal_x, ny = contact->normal_y;
    cairn_offset closing = -cairn_offset_dot(x, y, nx, ny), across = magnitude(cairn_offset_dot(y, -x, nx, ny));
    return is_broad(contact, closing, across) || is_round(round_of(a, b) + contact->separation, way, closing, across);
}

/* The contact of two slower bodies: not with a corner that one of them slides past. */
static void slide(const cairn_world *world, const cairn_body *a, const cairn_body *b, cairn_offset margin, cairn_manifold *out)
{
    cairn_offset x = cairn_offset_from_motion(b->vx - a->vx), y = cairn_offset_from_motion(b->vy - a->vy);
    if (world->held_back) {
        cairn_offset2 held = held_back(a, b, out);
        x += held.x;
        y += held.y;
    }
    x *= cairn_world_substeps(world);
    y *= cairn_world_substeps(world);
    if (larger(x, y) <= CREEP || out->separation < -GRAZE || cairn_offset_dot(x, y, out->normal_x, out->normal_y) > -CREEP) {
        return;
    }
    for (int i = 0; i < DOUBLINGS && (i == 0 || larger(x, y) < 4 * GRAZE); i++) {
        x *= 2;
        y *= 2;
    }
    if (CAIRN_WITH_QUICK_WAYS && is_settled(a, b, x, y, out)) {
        return;
    }
    cairn_pose pa, pb;
    cairn_body_pose(a, 0, 0, &pa);
    cairn_body_pose(b, out->x, out->y, &pb);
    look_beyond(&pa, &pb, x, y, CAIRN_UNIT(1.9), margin, out);
}

/* ---- after the solver ---- */

/* By the displacements that the solver arrived at. */
static course behind(const cairn_body *body, cairn_offset x, cairn_offset y)
{
    course c;
    c.body = body;
    c.x = x;
    c.y = y;
    c.dx = cairn_offset_from_motion(body->dx);
    c.dy = cairn_offset_from_motion(body->dy);
    c.turn = turn_of(body, body->dw);
    c.sweep = sweep_of(body, body->dw);
    return c;
}

/* The distance of a point at (0, 0) from a shape; negative inside. */
static void approach_point(const cairn_pose *obstacle, cairn_manifold *out)
{
    cairn_shape point;
    cairn_pose at;
    point.kind = NULL; /* only its radius is asked for */
    point.size = cairn_vec2_of(0, 0);
    point.polygon = NULL;
    at.shape = &point;
    at.x = at.y = 0;
    at.c = CAIRN_UNIT(1);
    at.s = 0;
    expect_nothing(out);
    obstacle->shape->kind->collide[0](&at, obstacle, ANY_DISTANCE, out);
}

/* How far the nearest point of the obstacle's surface comes nearer in the whole step, as it moves now. */
static cairn_offset approach_of(const course *path, const course *obstacle, const cairn_pose *pose, const cairn_manifold *contact)
{
    cairn_unit nx = contact->normal_x, ny = contact->normal_y;
    cairn_offset away = cairn_offset_dot(obstacle->dx - path->dx, obstacle->dy - path->dy, nx, ny);
    if (obstacle->sweep != 0) {
        cairn_offset arm = cairn_offset_dot(contact->points[0].x - pose->x, contact->points[0].y - pose->y, ny, -nx);
        away += cairn_motion_lever(cairn_offset_from_motion(obstacle->body->dw), cairn_lever_of(arm, cairn_body_inverse_gyration(obstacle->body)));
    }
    return -away;
}

/* How far into the step the core comes before it touches the other body; 1 if it does not. */
CAIRN_ONCE cairn_unit core_time(const cairn_body *fast, const cairn_body *other)
{
    course path = behind(fast, 0, 0);
    course obstacle = behind(other, cairn_bodies_apart_x(fast, other),
                             cairn_bodies_apart_y(fast, other));
    cairn_offset core = cairn_offset_from_real(cairn_shape_inradius(fast->model->shape));
    cairn_unit time = 0;
    for (int i = 0; i < ADVANCES; i++) {
        cairn_manifold contact;
        cairn_pose pose = pose_at(&obstacle, time);
        pose.x -= cairn_offset_mul(path.dx, time);
        pose.y -= cairn_offset_mul(path.dy, time);
        approach_point(&pose, &contact);
        if (i == 0) { /* nine tenths of the inner radius, or of the distance of a body that is pressed in further */
            core = contact.separation < core ? contact.separation : core;
            core = cairn_offset_mul(core, CAIRN_UNIT(0.9));
        }
        if (core <= 0) {
            return CAIRN_UNIT(1); /* its centre is inside already: the solver pushes it out */
        }
        cairn_offset way = contact.separation - core;
        if (way <= HIT) {
            cairn_offset more = cairn_offset_mul(approach_of(&path, &obstacle, &pose, &contact), CAIRN_UNIT(1) - time);
            return more > HIT ? time : CAIRN_UNIT(1);
        }
        cairn_offset closing = obstacle.sweep - cairn_offset_dot(obstacle.dx - path.dx, obstacle.dy - path.dy, contact.normal_x, contact.normal_y);
        if (closing <= 0 || way >= cairn_offset_mul(closing, CAIRN_UNIT(1) - time)) {
            return CAIRN_UNIT(1);
        }
        time += cairn_offset_fraction(way, closing);
    }
    return time;
}

/* What two displacements have in common. */
static cairn_motion common(cairn_motion a, cairn_motion b)
{
    if ((a > 0) != (b > 0)) {
        return 0;
    }
    return magnitude(a) < magnitude(b) ? a : b;
}

/*
 * From this time on the two do only what they do together. Neither is moved any farther than it would have been, so that nothing is pushed
 * through a third one.
 */
static void cut_short(cairn_body *fast, cairn_body *other, cairn_unit time)
{
    cairn_motion x = common(fast->dx, other->dx), y = common(fast->dy, other->dy);
    fast->dx = x + cairn_motion_unit(fast->dx - x, time);
    fast->dy = y + cairn_motion_unit(fast->dy - y, time);
    if (cairn_body_is_dynamic(other)) { /* else it would go on over the body that waits for it */
        other->dx = x + cairn_motion_unit(other->dx - x, time);
        other->dy = y + cairn_motion_unit(other->dy - y, time);
        other->dw = cairn_motion_unit(other->dw, time);
    }
}

/* How far any of a body's surface has come in this step along either axis. */
static cairn_real swept(const cairn_body *body)
{
    cairn_motion x = magnitude(body->dx), y = magnitude(body->dy);
    return cairn_real_above_motion(x > y ? x : y) + (cairn_body_is_round(body) ? 0 : 3 * cairn_real_above_motion(magnitude(body->dw)));
}

CAIRN_ONCE cairn_real swept_most(const cairn_world *world)
{
    const cairn_body *end = world->bodies + world->body_end;
    cairn_real most = 0;
    for (const cairn_body *body = world->bodies; body != end; body++) {
        cairn_real by = cairn_body_is_active(body) ? swept(body) : 0;
        most = by > most ? by : most;
    }
    return most;
}

/* most: how far any other body has come. */
CAIRN_ONCE bool clip_body(cairn_world *world, cairn_body *fast, cairn_real most)
{
    const cairn_body *end = world->bodies + world->body_end;
    cairn_body *nearest = NULL;
    cairn_unit time = CAIRN_UNIT(1);
    cairn_real way = swept(fast) + most;
    for (cairn_body *other = world->bodies; other != end; other++) {
        if (cairn_boxes_are_near(fast, other, way) && other != fast && (other->flags & CAIRN_BODY_USED) && !other->model->sensor
            && cairn_bodies_may_meet(world, fast, other)) {
            cairn_unit until = core_time(fast, other);
            if (until < time) {
                time = until;
                nearest = other;
            }
        }
    }
    if (nearest == NULL) {
        return false;
    }
    cut_short(fast, nearest, time);
    return true;
}

/*
 * Again as long as anything is cut: what stops short may stand in the way of what was looked at before it, and in a heap that is shot at
 * one stops the next. Each cut only shortens, so that this ends: of 24 000 steps of light heaps shot at 306 needed more than two sweeps, 2 more than eight.
 */
#define SWEEPS 8

static void clip(cairn_world *world)
{
    const cairn_body *end = world->bodies + world->body_end;
    cairn_real most = swept_most(world);
    bool again = true;
    for (int sweep = 0; sweep < SWEEPS && again; sweep++) {
        again = false;
        for (cairn_body *body = world->bodies; body != end; body++) {
            if ((body->flags & CAIRN_BODY_FAST) && !body->model->sensor && cairn_body_is_dynamic(body) && cairn_body_is_active(body)) {
                again = clip_body(world, body, most) || again;
            }
        }
    }
}

const cairn_continuous_class cairn_continuous = { meet, slide, clip, cairn_arbiters_hold_back, cairn_arbiters_land };
