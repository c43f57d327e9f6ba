/*
 * When and where two bodies hit one another. The rows of the step's start tell roughly when; the narrow phase at the poses of that moment then
 * gives normal, levers and the exact time. An impulse with levers of one moment and positions of another would falsify angular momentum.
 */
#include "bounce.h"

/* What rounding may add to a separation, m: so near at the end of the sub-step, and the sweeps would stop the body. */
#define CLOSE CAIRN_MOTION(2e-6)
/* How often the time of an impact is corrected, until the points are as near as this to one another. */
#define LOOKS 8
#define MET CAIRN_MOTION(2e-5)
/* What turns is looked at again while so near. */
#define NEAR CAIRN_OFFSET(0.05)
/* How far apart the narrow phase still finds a contact: more than it is wrong about the time. */
#define SIGHT CAIRN_OFFSET(0.5)
/* The gap of a pair that touched and was thrown apart within the step: above zero, so that its separation counts. */
#define JUST_APART CAIRN_MOTION(4e-9)

static cairn_motion size_of(cairn_motion x) { return x < 0 ? -x : x; }

/* ---- what the sweeps hold of the pair ---- */

/* What the impulses that the rows hold do to the two. */
static cairn_repeated repeated_of(const cairn_impact *i)
{
    const cairn_arbiter *arbiter = i->arbiter;
    cairn_motion rub = arbiter->friction_impulse, of_a = cairn_motion_share(rub, arbiter->share_a);
    cairn_repeated sum = { 0, 0, 0, 0 };
    if (rub != 0) {
        sum.x = -cairn_motion_dir(rub, arbiter->normal_y);
        sum.y = cairn_motion_dir(rub, arbiter->normal_x);
        sum.turn_a = cairn_motion_lever(of_a, arbiter->friction_lever_a);
        sum.turn_b = cairn_motion_lever(rub - of_a, arbiter->friction_lever_b);
    }
    for (int k = 0; k < arbiter->count; k++) {
        const cairn_row *row = &arbiter->rows[k];
        if (row->impulse != 0) {
            of_a = cairn_motion_share(row->impulse, arbiter->share_a);
            sum.x += cairn_motion_dir(row->impulse, arbiter->normal_x);
            sum.y += cairn_motion_dir(row->impulse, arbiter->normal_y);
            sum.turn_a = cairn_motion_add(sum.turn_a, cairn_motion_lever(of_a, row->lever_a));
            sum.turn_b = cairn_motion_add(sum.turn_b, cairn_motion_lever(row->impulse - of_a, row->lever_b));
        }
    }
    return sum;
}

/* Adds to what is repeated, v - u, of a body. */
static void repeat(cairn_body *body, cairn_motion x, cairn_motion y, cairn_motion turn)
{
    if (!cairn_body_is_fixed(body)) {
        body->ux = cairn_motion_before(body->ux, -x);
        body->uy = cairn_motion_before(body->uy, -y);
    }
    body->uw = cairn_motion_before(body->uw, -turn);
}

/* Between sub-steps velocity changes are repeated, v + (v - u), and with them the rows' impulses: have that follow a change of these. */
static void repeat_anew(const cairn_impact *i, const cairn_repeated *before)
{
    if (i->substep == 0 || cairn_arbiter_is_sliding(i->arbiter)) { /* the warm start reads the rows themselves */
        return;
    }
    cairn_repeated now = repeated_of(i);
    cairn_motion x = cairn_motion_add(now.x, -before->x), y = cairn_motion_add(now.y, -before->y);
    cairn_motion ax = cairn_motion_share(x, i->arbiter->share_a), ay = cairn_motion_share(y, i->arbiter->share_a);
    if (i->arbiter->share_a != 0) {
        repeat(i->a, -ax, -ay, cairn_motion_add(before->turn_a, -now.turn_a));
    }
    repeat(i->b, x - ax, y - ay, cairn_motion_add(now.turn_b, -before->turn_b));
}

/* An impact ends a contact: what held it until then is not to be repeated. */
static void forget_row(const cairn_impact *i, cairn_row *row)
{
    if (row->impulse == 0) {
        return;
    }
    cairn_repeated before = repeated_of(i);
    row->impulse = 0;
    if (!i->adopted) {
        repeat_anew(i, &before);
    }
}

/* ---- when and where ---- */

/* How the two have moved in this step: centre against centre, and each by turning. */
typedef struct course {
    cairn_offset x, y, turn_a, turn_b;
} course;

static cairn_offset way(cairn_motion d, cairn_motion v, cairn_unit time)
{
    return cairn_offset_from_motion(cairn_motion_add(d, cairn_motion_unit(v, time)));
}

/* Gravity's part of the true way: symplectic Euler has gone g k / 2 too far until this sub-step, see motion.c. */
static cairn_offset fall(const cairn_impact *i, cairn_motion g, cairn_unit time)
{
    return cairn_offset_from_motion(cairn_motion_half(cairn_motion_unit(cairn_motion_unit(g, time), time) - g * i->substep));
}

/* Until a time of this sub-step; or, at its end, as the sweeps will see it: half a sub-step's fall farther down for each so far. */
CAIRN_ONCE course course_at(const cairn_impact *i, cairn_unit time, bool of_sweeps)
{
    const cairn_body *a = i->a, *b = i->b;
    course c;
    c.x = way(b->dx, of_sweeps ? b->vx + i->gx : b->vx, time) - way(a->dx, a->vx, time) + (of_sweeps ? 0 : fall(i, i->gx, time));
    c.y = way(b->dy, of_sweeps ? b->vy + i->gy : b->vy, time) - way(a->dy, a->vy, time) + (of_sweeps ? 0 : fall(i, i->gy, time));
    c.turn_a = way(a->dw, a->w, time);
    c.turn_b = way(b->dw, b->w, time);
    return c;
}
static course course_until(const cairn_impact *i, cairn_unit time) { return course_at(i, time, false); }
static course course_so_far(const cairn_impact *i) { return course_at(i, 0, false); }
static course course_of_sweeps(const cairn_impact *i) { return course_at(i, CAIRN_UNIT(1), true); }

/* How far a course has opened a row. */
static cairn_motion opened(const cairn_impact *i, const cairn_row *row, const course *c)
{
    return cairn_motion_from_offset(cairn_motion_along(c->x, c->y, i->arbiter->normal_x, i->arbiter->normal_y)
                                    + cairn_motion_lever(c->turn_b, row->lever_b) - cairn_motion_lever(c->turn_a, row->lever_a));
}

static cairn_pose turned(const cairn_body *body, cairn_offset turn)
{
    cairn_pose pose;
    pose.shape = body->model->shape;
    pose.x = pose.y = 0;
    pose.c = CAIRN_UNIT(1);
    pose.s = 0;
    if (!cairn_body_is_round(body)) {
        cairn_angle by = cairn_angle_from_motion(cairn_motion_from_offset(turn), cairn_body_inverse_gyration(body));
        cairn_angle_rotation(cairn_angle_add(body->angle, by), &pose.c, &pose.s);
    }
    return pose;
}

static void contact_after(const cairn_impact *i, const course *c, cairn_manifold *out)
{
    cairn_pose a = turned(i->a, c->turn_a), b = turned(i->b, c->turn_b);
    b.x = cairn_bodies_apart_x(i->a, i->b) + c->x;
    b.y = cairn_bodies_apart_y(i->a, i->b) + c->y;
    cairn_poses_collide(&a, &b, SIGHT, out);
}

/* Makes the contact after a course the pair's rows. The impulses of points that persist act along these from now on. */
static void adopt(cairn_world *world, cairn_impact *i, const course *c, const cairn_manifold *contact)
{
    cairn_arbiter *arbiter = i->arbiter;
    i->changed = true;
    if (!i->adopted) {
        i->adopted = true;
        i->before = repeated_of(i);
    }
    if (contact->count == 0) { /* they pass by one another */
        arbiter->count = 0;
        arbiter->friction_impulse = 0;
        return;
    }
    uint8_t path = arbiter->path;
    cairn_arbiter_prepare(world, arbiter, contact);
    if (cairn_body_is_round(i->a) || cairn_body_is_round(i->b)) { /* two polygons stay together more often, and gained nothing */
        i->lean = cairn_dir_lean(contact->normal_x, contact->normal_y, arbiter->normal_x, arbiter->normal_y);
    }
    if (i->substep != 0) {
        arbiter->path = path; /* whether its impulses are repeated with the bodies' changes does not alter within a step */
    }
    i->x = c->x;
    i->y = c->y;
    for (int k = 0; k < arbiter->count; k++) {
        cairn_row *row = &arbiter->rows[k];
        cairn_motion separation = cairn_motion_from_offset(contact->points[k].separation);
        cairn_motion gap = cairn_motion_add(separation, -opened(i, row, c)); /* at the step's start */
        if (gap > 0 || separation >= -CAIRN_IMPACT_DEEP) { /* what lies deeper is pushed out as ever */
            row->gap = gap > 0 ? gap : JUST_APART;
        }
    }
}

/* How far turning moves the surface, m at the radius of gyration; a circle's does not move by it. */
static cairn_offset turning_of(const cairn_body *body) { return cairn_body_is_round(body) ? 0 : size_of(cairn_offset_from_motion(body->w)); }

/*
 * Rows are straight and a turning body's surface is not: a pair that turns while near gets those of where it will be
 * at the end of this sub-step, which also show a corner that was beside the other's face until now.
 */
void cairn_impact_refresh(cairn_world *world, cairn_impact *i)
{
    cairn_manifold contact;
    if (turning_of(i->a) + turning_of(i->b) < CAIRN_IMPACT_TURNING) {
        return;
    }
    course end = course_until(i, CAIRN_UNIT(1));
    contact_after(i, &end, &contact);
    /* Beyond the other's middle it would be pushed out at the far side. */
    bool passes = contact.count > 0
               && cairn_unit_dot(contact.normal_x, contact.normal_y, cairn_unit_from_dir(i->arbiter->normal_x), cairn_unit_from_dir(i->arbiter->normal_y)) <= 0;
    if (contact.count > 0 && !passes && size_of(contact.separation) < NEAR) {
        adopt(world, i, &end, &contact);
    }
}

/* part / whole, below 2 */
CAIRN_ONCE cairn_unit time_of(cairn_motion part, cairn_motion whole)
{
    cairn_unit half = cairn_motion_fraction(cairn_motion_half(part), whole);
    return 2 * (half < CAIRN_UNIT(0.99) ? half : CAIRN_UNIT(0.99));
}

/* Does any point close faster than what is no impact? What leaves as fast is in flight. */
static bool any_closes(const cairn_impact *i)
{
    bool any = false;
    for (int k = 0; k < i->arbiter->count; k++) {
        cairn_row *row = &i->arbiter->rows[k];
        cairn_motion u = cairn_impact_row_velocity(i, row);
        row->feature = (uint16_t)((row->feature & ~CAIRN_ROW_IN_FLIGHT) | cairn_flag_if(u > i->rest, CAIRN_ROW_IN_FLIGHT));
        any = any || u < -i->rest;
    }
    return any;
}

/*
 * Do the rows as they are say that some point hits in this sub-step? About when the first one does. What the sweeps
 * would stop counts, even where the true impact lies a moment later.
 */
bool cairn_impact_foresee(cairn_impact *i)
{
    cairn_arbiter *arbiter = i->arbiter;
    bool hits = false;
    i->time = CAIRN_UNIT(1.98);
    if (!any_closes(i)) {
        return false;
    }
    cairn_motion gravity = cairn_impact_pull(i);
    course now = course_so_far(i), end = course_of_sweeps(i);
    for (int k = 0; k < arbiter->count; k++) {
        cairn_row *row = &arbiter->rows[k];
        cairn_motion u = cairn_impact_row_velocity(i, row), separation = opened(i, row, &now);
        if (u >= -i->rest) {
            continue;
        }
        /* A pair that touched may have come apart by another impact in this step: then it meets only after that. */
        if (row->gap <= 0 && separation > cairn_motion_half(gravity * i->substep)) {
            row->gap = JUST_APART;
            i->changed = true;
        }
        if (row->gap > 0 && cairn_motion_add(row->gap, opened(i, row, &end)) > CLOSE) {
            forget_row(i, row);
            row->feature |= CAIRN_ROW_IN_FLIGHT;
            continue;
        }
        separation = row->gap > 0 ? cairn_motion_add(row->gap, separation) : 0;
        separation = separation > 0 ? separation : 0;
        cairn_motion closing = cairn_motion_closing(u, gravity, separation);
        if (closing > i->rest) {
            cairn_unit time = time_of(separation, cairn_motion_half(cairn_motion_add(closing, -u)));
            i->time = time < i->time ? time : i->time;
            hits = true;
        }
    }
    return hits;
}

/* The first point to hit by the contact after this course, or -1 if none does in this sub-step. */
static int measure(cairn_impact *i, const cairn_manifold *contact, const course *c)
{
    cairn_arbiter *arbiter = i->arbiter;
    cairn_motion gravity = cairn_impact_pull(i);
    course end = course_of_sweeps(i);
    int first = -1;
    for (int k = 0; k < arbiter->count; k++) {
        cairn_row *row = &arbiter->rows[k];
        cairn_motion closing = cairn_motion_unit(gravity, i->time) - cairn_impact_row_velocity(i, row);
        cairn_motion start = cairn_motion_add(cairn_motion_from_offset(contact->points[k].separation), -opened(i, row, c));
        i->closing[k] = 0;
        if (closing <= i->rest) {
            continue;
        }
        if (cairn_motion_add(start, opened(i, row, &end)) > 2 * CLOSE) {
            row->feature |= CAIRN_ROW_IN_FLIGHT;
        } else {
            i->closing[k] = closing;
            first = first < 0 || contact->points[k].separation < contact->points[first].separation ? k : first;
        }
    }
    return first;
}

/* Finds the contact at the moment of the impact, and the moment exactly; false if the two miss in this sub-step. */
bool cairn_impact_meet(cairn_world *world, cairn_impact *i)
{
    for (int look = 0; look < LOOKS; look++) {
        cairn_manifold contact;
        course c = course_until(i, i->time);
        contact_after(i, &c, &contact);
        adopt(world, i, &c, &contact);
        int first = measure(i, &contact, &c);
        if (first < 0) {
            return false;
        }
        cairn_motion to_go = cairn_motion_from_offset(contact.points[first].separation);
        i->depth = -to_go;
        cairn_unit by = time_of(to_go < 0 ? -to_go : to_go, i->closing[first]);
        if (to_go < 0) {
            by = by < i->time ? -by : -i->time;
        } else if (by > CAIRN_UNIT(1.98) - i->time) {
            by = CAIRN_UNIT(1.98) - i->time;
        }
        if (by == 0 || look == LOOKS - 1 || (to_go <= MET && -to_go <= MET)) {
            break;
        }
        i->time += by;
    }
    return true;
}

/* Hands rows that were made within the step to the sweeps: their levers are those of another moment than the displacements, see slide.c. */
void cairn_impact_hand_back(cairn_impact *i)
{
    cairn_body *a = i->a, *b = i->b;
    if (cairn_arbiter_may_slide(a, b)) {
        cairn_arbiter_slide(a, b, i->arbiter, cairn_offset_from_motion(b->dx) - cairn_offset_from_motion(a->dx) - i->x,
                            cairn_offset_from_motion(b->dy) - cairn_offset_from_motion(a->dy) - i->y);
        cairn_arbiter_mark_careful(i->arbiter, a, b);
    }
    repeat_anew(i, &i->before);
}
