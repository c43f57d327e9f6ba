/*
 * Contacts at rest hold: between the narrow phase and the rows. As long as two bodies have hardly moved to one another, the
 * rows of the step before serve again: the points only follow the bodies' motion. It saves the narrow phase, and
 * where there are two points it is what lets tall stacks stand: levers that follow every lean let a column of soft contacts buckle.
 * There are two more memories then, of what a solver of velocities forgets: a contact that sticks takes back what it
 * slipped, and a load that rests on a point for seconds no longer presses it in.
 *
 * A contact of one point has no past of this kind: its `slip` counts how far the two have moved to one another in any way
 * since its row was made, from less than nothing up to zero, where it ends. How far is allowed bounds what is wrong by then: for a way s and a
 * radius r the normal has turned by s / r at most, and the gap is off by s^2 / 2r. A second point that nears was out of
 * the narrow phase's reach when the row was made, which is five times that way or more.
 */
#include "engine.h"

/* The rows serve while the surfaces have slipped by less than this, */
#define HOLD_SLIP CAIRN_MOTION(0.002)
/* no point is farther apart than this, m, */
#define HOLD_GAP CAIRN_MOTION(0.002)
/* and neither body has turned by more than this. */
#define HOLD_TURN CAIRN_RADIANS(0.005)
/* A row of one point serves for this way at most, in sizes of the smaller body. */
#define HOLD_SHARE CAIRN_RATIO(1.0 / 256)
/* A longer way in a step is no rest; and below it no sum of this file wraps. */
#define HOLD_WAY CAIRN_MOTION(1.0 / 16)
/* Not a slip that a contact may have: all of its past is forgotten. */
#define LET_GO CAIRN_MOTION(1)
/* Share of the resting load that is carried without sinking in. The rest keeps the points pressed together. */
#define CARRIED CAIRN_RATIO(0.875)
/* 1 / beta: from a push-out to a depth. */
#define DEPTH CAIRN_FACTOR(1 / 0.13576)

static cairn_motion magnitude(cairn_motion x) { return x < 0 ? -x : x; }

static bool is_within(cairn_motion x, cairn_motion y, cairn_motion w, cairn_motion limit)
{
    return magnitude(x) <= limit && magnitude(y) <= limit && magnitude(w) <= limit;
}

void cairn_arbiter_let_go(cairn_arbiter *arbiter)
{
    arbiter->slip = LET_GO;
    arbiter->pull = 0;
}

void cairn_arbiter_doubt(cairn_arbiter *arbiter)
{
    if (arbiter->count > 1) {
        arbiter->rows[0].gap = 2 * HOLD_GAP;
    } else {
        cairn_arbiter_let_go(arbiter);
    }
}

/* A circle's radius, a polygon's; the longer side of a box. */
static cairn_real size_of(const cairn_shape *shape) { return shape->size.x > shape->size.y ? shape->size.x : shape->size.y; }

/* How far two bodies that touch in one point may move to one another before their row is made anew. */
static cairn_motion way_of_hold(const cairn_body *a, const cairn_body *b)
{
    cairn_real size_a = size_of(a->model->shape), size_b = size_of(b->model->shape), size = size_a < size_b ? size_a : size_b;
    size = size < CAIRN_F(0.512) ? size : CAIRN_F(0.512); /* HOLD_SLIP, then */
    return cairn_motion_ratio(cairn_motion_from_offset(cairn_offset_from_real(size)), HOLD_SHARE);
}

void cairn_arbiter_take_hold(const cairn_world *world, cairn_arbiter *arbiter)
{
    const cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    if (arbiter->count < 2) {
        arbiter->slip = -way_of_hold(a, b);
        return;
    }
    arbiter->heading_a = cairn_heading_of(a->angle);
    arbiter->heading_b = cairn_heading_of(b->angle);
}

bool cairn_arbiter_holds(const cairn_world *world, const cairn_arbiter *arbiter)
{
    const cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    if ((arbiter->flags & CAIRN_ARBITER_SENSOR) || ((a->flags | b->flags) & (CAIRN_BODY_FAST | CAIRN_BODY_ASLEEP))) {
        return false;
    }
    if (arbiter->count < 2) {
        return arbiter->count == 1 && arbiter->slip < 0;
    }
    return magnitude(arbiter->slip) < HOLD_SLIP && arbiter->rows[0].gap <= HOLD_GAP && arbiter->rows[1].gap <= HOLD_GAP
        && cairn_heading_is_near(arbiter->heading_a, a->angle, HOLD_TURN) && cairn_heading_is_near(arbiter->heading_b, b->angle, HOLD_TURN);
}

/* The motion of b against a in the step, eight times: what is rounded is then small, and no less than zero in the mean. */
typedef struct relative_motion {
    cairn_motion x, y, spin_a, spin_b;
} relative_motion;

static relative_motion motion_of(const cairn_body *a, const cairn_body *b)
{
    relative_motion by;
    by.x = 8 * (b->dx - a->dx);
    by.y = 8 * (b->dy - a->dy);
    by.spin_a = 8 * a->dw;
    by.spin_b = 8 * b->dw;
    return by;
}

static cairn_motion turning(const relative_motion *by, cairn_lever ja, cairn_lever jb)
{
    return cairn_motion_lever(by->spin_b, jb) - cairn_motion_lever(by->spin_a, ja);
}

/* The gap of a row as rows.c has it, after the points have come apart by an eighth of this. */
static void open_gap(cairn_row *row, cairn_motion eightfold)
{
    bool was_apart = row->gap > 0;
    row->gap += cairn_motion_eighth(was_apart ? eightfold : cairn_motion_ratio(eightfold, CAIRN_SOFT_BETA));
    if (was_apart && row->gap < 0) {
        row->gap = cairn_motion_ratio(row->gap, CAIRN_SOFT_BETA);
    } else if (!was_apart && row->gap > 0) {
        row->gap = cairn_motion_factor(row->gap, DEPTH);
    }
}

/* Faster than twice the speed up to which bodies may come to rest? */
static bool is_fast(const cairn_world *world, cairn_motion way) { return magnitude(way) > 2 * world->rest_limit * world->substeps; }

/*
 * What slides at a speed beyond rest forgets where it stuck, until it sticks again: it stays where it comes to a stop. What sticks
 * and gives way slowly, as contacts do while a pile settles, remembers up to HOLD_SLIP and is pulled back.
 */
static void slip_by(const cairn_world *world, cairn_arbiter *arbiter, cairn_motion way)
{
    cairn_motion limit = cairn_motion_factor(arbiter->rows[0].impulse + arbiter->rows[1].impulse, arbiter->kinetic_friction);
    bool slips = magnitude(arbiter->friction_impulse) >= limit;
    if (slips && (is_fast(world, way) || arbiter->slip == LET_GO)) {
        cairn_arbiter_let_go(arbiter);
        return;
    }
    cairn_motion before = arbiter->slip == LET_GO ? 0 : arbiter->slip;
    arbiter->slip = cairn_motion_clamp(before + way, HOLD_SLIP);
    arbiter->pull = cairn_motion_ratio(arbiter->slip, world->stick);
}

/* The load follows the impulse with a time constant of two seconds up to CARRIED of it, and never exceeds it. */
static void settle(const cairn_world *world, cairn_row *row, bool at_rest)
{
    if (at_rest && row->load < cairn_motion_ratio(row->impulse, CARRIED)) {
        row->load += cairn_motion_half(cairn_motion_half(cairn_motion_ratio(row->impulse - row->load, world->rest_damping)));
    }
    if (row->load > row->impulse) {
        row->load = row->impulse;
    }
}

/* Bounds how far turning has moved a surface: it lies within 2 sqrt(2) radii of gyration of the centre. A circle's does not move. */
static cairn_motion swept(const cairn_body *body)
{
    return body->model->shape->kind->outline == NULL ? 0 : 3 * magnitude(body->dw);
}

static void follow_one(cairn_arbiter *arbiter, const cairn_body *a, const cairn_body *b)
{
    cairn_row *row = &arbiter->rows[0];
    relative_motion by = motion_of(a, b);
    arbiter->pull = 0;
    row->load = 0;
    if (arbiter->slip < 0) {
        arbiter->slip += magnitude(b->dx - a->dx) + magnitude(b->dy - a->dy) + swept(a) + swept(b);
    }
    if (arbiter->slip < 0) { /* else the gap stays what it was when the step began, which tells what came in flight */
        open_gap(row, cairn_motion_along(by.x, by.y, arbiter->normal_x, arbiter->normal_y) + turning(&by, row->lever_a, row->lever_b));
    }
}

void cairn_arbiter_follow(const cairn_world *world, cairn_arbiter *arbiter)
{
    const cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    bool two = arbiter->count > 1;
    bool others = (arbiter->block & CAIRN_BLOCK_NUMBER) != 0 || (arbiter->rows[0].feature & CAIRN_ROW_IN_FLIGHT)
               || (two && (arbiter->rows[1].feature & CAIRN_ROW_IN_FLIGHT));
    if (arbiter->count == 0 || others || world->slop != 0 || !is_within(a->dx, a->dy, a->dw, HOLD_WAY) || !is_within(b->dx, b->dy, b->dw, HOLD_WAY)
        || arbiter->rows[0].gap <= -world->push_out_limit || (two && arbiter->rows[1].gap <= -world->push_out_limit)) {
        cairn_arbiter_let_go(arbiter); /* blocks and impacts have their own ways */
        arbiter->rows[0].load = arbiter->rows[1].load = 0;
        return;
    }
    if (!two) {
        follow_one(arbiter, a, b);
        return;
    }
    bool at_rest = is_within(a->vx, a->vy, a->w, world->rest_limit) && is_within(b->vx, b->vy, b->w, world->rest_limit);
    relative_motion by = motion_of(a, b);
    cairn_motion apart = cairn_motion_along(by.x, by.y, arbiter->normal_x, arbiter->normal_y);
    cairn_motion across = cairn_motion_along(by.y, -by.x, arbiter->normal_x, arbiter->normal_y);
    for (int i = 0; i < 2; i++) {
        cairn_row *row = &arbiter->rows[i];
        cairn_motion eightfold = apart + turning(&by, row->lever_a, row->lever_b);
        if (is_fast(world, cairn_motion_eighth(eightfold))) {
            arbiter->heading_a = cairn_heading_away(arbiter->heading_a); /* a blow: the shapes are to be looked at */
        }
        open_gap(row, eightfold);
        settle(world, row, at_rest);
    }
    slip_by(world, arbiter, cairn_motion_eighth(across + turning(&by, arbiter->friction_lever_a, arbiter->friction_lever_b)));
}
