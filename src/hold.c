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
/* no point is farther apart than this, */
#define HOLD_GAP CAIRN_MOTION(0.01)
/* and neither body has turned by more than this. */
#define HOLD_TURN CAIRN_RADIANS(0.005)
/* A row of one point serves for this way at most, in sizes of the smaller body. */
#define HOLD_SHARE CAIRN_RATIO(1.0 / 256)
/* A longer way in a step is no rest; and below it no sum of this file wraps. */
#define HOLD_WAY CAIRN_MOTION(1.0 / 16)
/* What is pushed out by more in a sub-step is looked at anew. */
#define HOLD_PUSH CAIRN_MOTION(0.125)
/* Bounds how far turning moves a surface, in ways of the radius of gyration: it lies within 2 sqrt(2) of these. */
#define SWEPT 3
/* Share of the resting load that is carried without sinking in. The rest keeps the points pressed together. */
#define CARRIED CAIRN_RATIO(0.875)
/* 1 / beta: from a push-out to a depth. */
#define DEPTH CAIRN_FACTOR(1 / CAIRN_SOFT_BETA_NUMBER)

static cairn_motion magnitude(cairn_motion x) { return x < 0 ? -x : x; }

void cairn_arbiter_let_go(cairn_arbiter *arbiter) { arbiter->slip = CAIRN_LET_GO; }

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
    if (!CAIRN_WITH_HOLD) {
        return;
    }
    bool alone = !(arbiter->block & CAIRN_BLOCK_NUMBER);
    if (!cairn_arbiter_has_two(arbiter)) {
        arbiter->slip = -way_of_hold(a, b);
        if (alone) {
            arbiter->past.swept.a = cairn_body_is_round(a) ? 0 : SWEPT;
            arbiter->past.swept.b = cairn_body_is_round(b) ? 0 : SWEPT;
        }
    } else if (alone) {
        arbiter->past.heading.a = cairn_heading_of(a->angle);
        arbiter->past.heading.b = cairn_heading_of(b->angle);
    }
}

/* Whether all of the motion of two bodies is below a limit; near it, by less than half, it may say no. */
static bool is_below(cairn_motion xa, cairn_motion ya, cairn_motion wa, cairn_motion xb, cairn_motion yb, cairn_motion wb, cairn_motion limit)
{
    cairn_size size = cairn_size_with(cairn_size_with(cairn_size_of(xa), ya), wa);
    return cairn_size_is_below(cairn_size_with(cairn_size_with(cairn_size_with(size, xb), yb), wb), limit);
}

/* The motion of b against a in the step. */
typedef struct relative_motion {
    cairn_motion x, y, spin_a, spin_b;
} relative_motion;

/*
 * False if that is no rest. Both bodies together may go as fast as they like: no displacement is beyond 7 m (world.c), so a difference that wraps is
 * not short.
 */
static inline bool find_motion(const cairn_body *a, const cairn_body *b, relative_motion *by, bool turns)
{
    by->x = cairn_motion_apart(a->dx, b->dx, 0);
    by->y = cairn_motion_apart(a->dy, b->dy, 0);
    by->spin_a = turns ? a->dw : 0;
    by->spin_b = turns ? b->dw : 0;
    if (CAIRN_KNOWS_SQUARES) {
        cairn_size sum = cairn_squares_with(cairn_squares_with(0, by->x), by->y);
        if (cairn_squares_are_below(turns ? cairn_squares_with(cairn_squares_with(sum, by->spin_a), by->spin_b) : sum, HOLD_WAY)) {
            return true;
        }
        cairn_forget();
    }
    cairn_size size = cairn_size_with(cairn_size_of(by->x), by->y);
    return cairn_size_is_below(turns ? cairn_size_with(cairn_size_with(size, by->spin_a), by->spin_b) : size, HOLD_WAY);
}

/* How far two surfaces come apart, eight times: what is rounded is then small, and no less than zero in the mean. */
static inline cairn_motion straight(const relative_motion *by, cairn_dir x, cairn_dir y) { return cairn_motion_along(8 * by->x, 8 * by->y, x, y); }
static inline cairn_motion turning(const relative_motion *by, cairn_lever ja, cairn_lever jb)
{
    return cairn_motion_lever(8 * by->spin_b, jb) - cairn_motion_lever(8 * by->spin_a, ja);
}

/* The gap of a row as rows.c has it, after the points have come apart by an eighth of this. */
static inline void open_gap(cairn_row *row, cairn_motion eightfold)
{
    cairn_motion gap = row->gap;
    if (gap > 0) {
        gap += cairn_motion_eighth(eightfold);
        row->gap = gap < 0 ? cairn_motion_ratio(gap, CAIRN_SOFT_BETA) : gap;
    } else {
        gap += cairn_motion_eighth(cairn_motion_ratio(eightfold, CAIRN_SOFT_BETA));
        row->gap = gap > 0 ? cairn_motion_factor(gap, DEPTH) : gap;
    }
}

/* Does the contact give way at the limit of friction? */
static bool slips(const cairn_arbiter *arbiter)
{
    cairn_motion pressure = arbiter->rows[0].impulse + arbiter->rows[CAIRN_LAST_ROW].impulse;
    return magnitude(arbiter->friction_impulse) >= cairn_motion_factor(pressure, arbiter->kinetic_friction);
}

/*
 * What slides at a speed beyond rest forgets where it stuck, until it sticks again: it stays where it comes to a stop. What sticks
 * and gives way slowly, as contacts do while a pile settles, remembers up to HOLD_SLIP and is pulled back.
 */
static void slip_by(cairn_arbiter *arbiter, cairn_motion way, bool fast)
{
    if ((fast || arbiter->slip == CAIRN_LET_GO) && slips(arbiter)) {
        cairn_arbiter_let_go(arbiter);
        return;
    }
    cairn_motion before = arbiter->slip >= CAIRN_LET_GO ? 0 : arbiter->slip;
    arbiter->slip = cairn_motion_clamp(before + way, HOLD_SLIP);
}

/*
 * What hangs in the air holds too, as long as the two do not near one another: crates that fall together. Its slip then counts from the
 * step in which the row was made, and from LET_GO's double, so that nothing is taken back of it.
 */
#define ALOFT CAIRN_MOTION(2)
/* Not farther apart than this, m. */
#define ALOFT_GAP CAIRN_MOTION(1)

static bool is_aloft(const cairn_arbiter *arbiter) { return arbiter->slip > CAIRN_LET_GO + HOLD_SLIP; }

static void drift_by(cairn_arbiter *arbiter, cairn_motion way)
{
    cairn_motion before = is_aloft(arbiter) ? arbiter->slip - ALOFT : arbiter->slip == CAIRN_LET_GO ? 0 : arbiter->slip;
    arbiter->slip = ALOFT + cairn_motion_clamp(before + way, HOLD_SLIP);
}

/* The load follows the impulse with a time constant of four seconds up to CARRIED of it, and never exceeds it. */
static void settle(const cairn_world *world, cairn_row *row)
{
    if (row->load < cairn_motion_ratio(row->impulse, CARRIED)) {
        row->load += cairn_motion_ratio(row->impulse - row->load, cairn_world_rest_damping(world));
    }
}

/* In every fourth step, another one for the next body. */
static void settle_in_turn(const cairn_world *world, cairn_arbiter *arbiter, const cairn_body *a, const cairn_body *b)
{
    if (((world->stats.steps + arbiter->b) & 3u) == 0
        && is_below(a->vx, a->vy, a->w, b->vx, b->vy, b->w, cairn_world_rest_limit(world))) {
        settle(world, &arbiter->rows[0]);
        settle(world, &arbiter->rows[CAIRN_LAST_ROW]);
    }
}

static void forget(cairn_arbiter *arbiter)
{
    cairn_arbiter_let_go(arbiter);
    arbiter->rows[0].load = 0;
    arbiter->rows[CAIRN_LAST_ROW].load = 0;
}

/* Impacts have their own ways; what is deeper than the push-out tells has no known gap. */
static inline bool is_known(const cairn_row *row, cairn_motion deepest) { return !cairn_row_is_in_flight(row) && row->gap > deepest; }

/* Of contacts of one point. True if the row may serve again; else the gap stays what it was when the step began, which tells what came in flight. */
CAIRN_APART bool follow_one(cairn_arbiter *arbiter, const cairn_body *a, const cairn_body *b, cairn_motion deepest)
{
    cairn_row *row = &arbiter->rows[0];
    relative_motion by;
    row->load = 0;
    bool turns = arbiter->past.swept.a != 0 || arbiter->past.swept.b != 0; /* not two circles */
    if (arbiter->slip >= 0 || !is_known(row, deepest) || !find_motion(a, b, &by, turns)) {
        return false;
    }
    cairn_motion slip = arbiter->slip + magnitude(by.x) + magnitude(by.y), turned = 0;
    if (turns) {
        slip += arbiter->past.swept.a * magnitude(by.spin_a) + arbiter->past.swept.b * magnitude(by.spin_b);
        turned = turning(&by, row->lever_a, row->lever_b);
    }
    arbiter->slip = slip;
    if (slip >= 0) {
        return false;
    }
    open_gap(row, straight(&by, arbiter->normal_x, arbiter->normal_y) + turned);
    return true;
}

/* Of two. */
CAIRN_APART bool follow_two(const cairn_world *world, cairn_arbiter *arbiter, const cairn_body *a, const cairn_body *b, cairn_motion deepest)
{
    relative_motion by;
    if (!is_known(&arbiter->rows[0], deepest) || !is_known(&arbiter->rows[CAIRN_LAST_ROW], deepest) || !find_motion(a, b, &by, true)) {
        forget(arbiter);
        return false;
    }
    /* Twice the speed up to which bodies may come to rest is fast. */
    cairn_motion fast = 16 * cairn_world_rest_limit(world) * cairn_world_substeps(world);
    cairn_motion apart = straight(&by, arbiter->normal_x, arbiter->normal_y);
    cairn_motion across = cairn_motion_along(8 * by.y, -8 * by.x, arbiter->normal_x, arbiter->normal_y)
                        + turning(&by, arbiter->friction_lever_a, arbiter->friction_lever_b);
    bool struck = false, doubtful = false, near = arbiter->friction_impulse != 0;
    for (cairn_row *row = arbiter->rows; row != arbiter->rows + CAIRN_MAX_POINTS; row++) {
        cairn_motion eightfold = apart + turning(&by, row->lever_a, row->lever_b);
        open_gap(row, eightfold);
        near = near || row->impulse != 0 || row->gap <= 0 || row->gap <= -cairn_motion_half(eightfold); /* will touch within four steps */
        struck = struck || magnitude(eightfold) > fast;
        doubtful = doubtful || row->gap > HOLD_GAP; /* open */
        row->load = row->load < row->impulse ? row->load : row->impulse;
    }
    if (!near) {
        drift_by(arbiter, cairn_motion_eighth(across));
        doubtful = magnitude(arbiter->slip - ALOFT) >= HOLD_SLIP || arbiter->rows[0].gap > ALOFT_GAP || arbiter->rows[CAIRN_LAST_ROW].gap > ALOFT_GAP;
    } else {
        slip_by(arbiter, cairn_motion_eighth(across), magnitude(across) > fast);
        doubtful = doubtful || magnitude(arbiter->slip) >= HOLD_SLIP;
        settle_in_turn(world, arbiter, a, b);
    }
    arbiter->path = struck ? CAIRN_PATH_FRESH : 0; /* its points take turns again */
    return !doubtful && cairn_heading_is_near(arbiter->past.heading.a, a->angle, HOLD_TURN)
        && cairn_heading_is_near(arbiter->past.heading.b, b->angle, HOLD_TURN);
}

static uint8_t other_path(cairn_world *world, const cairn_arbiter *arbiter, uint8_t before)
{
    uint8_t path = cairn_arbiter_path_of(world, arbiter, 0);
    cairn_arbiter_take_turn(world, before, path);
    return path;
}

/* The way of the next step's sweeps, after this one's: mostly the same. Of one point, and of two. */
static inline uint8_t next_path_of_one(cairn_world *world, const cairn_arbiter *arbiter, uint8_t before)
{
    return (before & CAIRN_PATH_WAY) < CAIRN_PATH_CENTRAL ? other_path(world, arbiter, before) : before;
}

static inline uint8_t next_path_of_two(cairn_world *world, const cairn_arbiter *arbiter, uint8_t before)
{
    int way = before & CAIRN_PATH_WAY;
    bool apart = arbiter->rows[0].gap > 0 || arbiter->rows[CAIRN_LAST_ROW].gap > 0;
    return !apart && (way == CAIRN_PATH_EVEN || way == CAIRN_PATH_ON_STATIC) ? before : other_path(world, arbiter, before);
}

static inline void follow(cairn_world *world, cairn_arbiter *arbiter, const cairn_body *a, const cairn_body *b, cairn_motion deepest)
{
    uint8_t before = arbiter->path & (uint8_t)~(unsigned)CAIRN_PATH_FRESH, path = before | CAIRN_PATH_DOUBTED;
    if (arbiter->count == 0 || (arbiter->block & CAIRN_BLOCK_NUMBER)) { /* blocks have their own ways */
        forget(arbiter);
    } else if (!cairn_arbiter_has_two(arbiter)) {
        if (follow_one(arbiter, a, b, deepest)) {
            path = next_path_of_one(world, arbiter, before);
        }
    } else if (follow_two(world, arbiter, a, b, deepest)) {
        path = (uint8_t)(arbiter->path | next_path_of_two(world, arbiter, before));
    }
    arbiter->path = path;
}

/* What was idle and still hangs in the air may be so again, which the next step will tell; what touches is looked at anew. */
CAIRN_APART void follow_idle(const cairn_world *world, cairn_arbiter *arbiter, const cairn_body *a, const cairn_body *b, cairn_motion deepest)
{
    bool two = cairn_arbiter_has_two(arbiter), serves = two ? follow_two(world, arbiter, a, b, deepest) : follow_one(arbiter, a, b, deepest);
    unsigned turns = two ? arbiter->path & CAIRN_PATH_FRESH : 0; /* of its points, as follow_two() says */
    unsigned apart = cairn_flag_if(two && arbiter->rows[CAIRN_LAST_ROW].gap > 0, CAIRN_PATH_APART);
    arbiter->path = (uint8_t)(serves && arbiter->rows[0].gap > 0 ? CAIRN_PATH_IDLE | turns | apart : CAIRN_PATH_NONE);
}

void cairn_arbiters_follow(cairn_world *world)
{
    /* With an allowed penetration no gap is known. */
    const cairn_motion deepest = world->slop != 0 ? CAIRN_MOTION(7) : cairn_world_push_out_limit(world) < HOLD_PUSH ? -cairn_world_push_out_limit(world) : -HOLD_PUSH;
    const uint16_t *end = world->order + world->arbiter_count;
    cairn_arbiter *arbiters = world->arbiters;
    const cairn_body *bodies = world->bodies;
    for (const uint16_t *at = world->order; at != end; at++) {
        cairn_arbiter *arbiter = &arbiters[*at];
        unsigned flags = arbiter->flags;
        arbiter->flags = (uint8_t)(flags & ~(unsigned)CAIRN_ARBITER_FRESH);
        if (flags & CAIRN_ARBITER_SOLVED) {
            follow(world, arbiter, &bodies[arbiter->a], &bodies[arbiter->b], deepest);
        } else if (cairn_arbiter_idles(arbiter)) {
            follow_idle(world, arbiter, &bodies[arbiter->a], &bodies[arbiter->b], deepest);
        }
    }
}
