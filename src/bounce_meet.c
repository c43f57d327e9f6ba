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

static void add(cairn_repeated *sum, cairn_motion impulse, cairn_share share_a, cairn_lever ja, cairn_lever jb)
{
    cairn_motion of_a = cairn_motion_share(impulse, share_a);
    sum->turn_a = cairn_motion_add(sum->turn_a, cairn_motion_lever(of_a, ja));
    sum->turn_b = cairn_motion_add(sum->turn_b, cairn_motion_lever(impulse - of_a, jb));
}

/* What the impulses that the rows hold do to the two. */
CAIRN_ONCE void sum_repeated(const cairn_arbiter *arbiter, cairn_repeated *sum)
{
    cairn_motion rub = arbiter->friction_impulse;
    sum->x = -cairn_motion_dir(rub, arbiter->normal_y);
    sum->y = cairn_motion_dir(rub, arbiter->normal_x);
    sum->turn_a = sum->turn_b = 0;
    add(sum, rub, arbiter->share_a, arbiter->friction_lever_a, arbiter->friction_lever_b);
    for (int k = 0; k < arbiter->count; k++) {
        const cairn_row *row = &arbiter->rows[k];
        sum->x += cairn_motion_dir(row->impulse, arbiter->normal_x);
        sum->y += cairn_motion_dir(row->impulse, arbiter->normal_y);
        add(sum, row->impulse, arbiter->share_a, row->lever_a, row->lever_b);
    }
}

void cairn_body_repeat_less(cairn_body *body, cairn_motion x, cairn_motion y, cairn_motion turn)
{
    if (!cairn_body_is_fixed(body)) {
        body->ux = cairn_motion_before(body->ux, x);
        body->uy = cairn_motion_before(body->uy, y);
    }
    body->uw = cairn_motion_before(body->uw, turn);
}

/* Between sub-steps velocity changes are repeated, v + (v - u), and with them the rows' impulses: have that follow a change of these. */
static void repeat_anew(const cairn_impact *i, const cairn_repeated *before)
{
    const cairn_arbiter *arbiter = i->arbiter;
    if (i->substep == 0 || cairn_arbiter_is_sliding(arbiter)) { /* the warm start reads the rows themselves */
        return;
    }
    cairn_repeated now;
    sum_repeated(arbiter, &now);
    cairn_motion x = cairn_motion_add(now.x, -before->x), y = cairn_motion_add(now.y, -before->y);
    cairn_motion ax = cairn_motion_share(x, arbiter->share_a), ay = cairn_motion_share(y, arbiter->share_a);
    if (arbiter->share_a != 0) {
        cairn_body_repeat_less(i->body[0], ax, ay, cairn_motion_add(now.turn_a, -before->turn_a));
    }
    cairn_body_repeat_less(i->body[1], ax - x, ay - y, cairn_motion_add(before->turn_b, -now.turn_b));
}

/* An impact ends a contact: what held it until then is not to be repeated. */
static void forget_row(const cairn_impact *i, cairn_row *row)
{
    if (row->impulse == 0) {
        return;
    }
    cairn_repeated before;
    sum_repeated(i->arbiter, &before);
    row->impulse = 0;
    if (!i->adopted) {
        repeat_anew(i, &before);
    }
}

/* ---- when and where ---- */

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
CAIRN_ONCE cairn_course course_at(const cairn_impact *i, cairn_unit time, bool of_sweeps)
{
    const cairn_body *a = i->body[0], *b = i->body[1];
    cairn_course c;
    c.x = way(b->dx, of_sweeps ? b->vx + i->gx : b->vx, time) - way(a->dx, a->vx, time) + (of_sweeps ? 0 : fall(i, i->gx, time));
    c.y = way(b->dy, of_sweeps ? b->vy + i->gy : b->vy, time) - way(a->dy, a->vy, time) + (of_sweeps ? 0 : fall(i, i->gy, time));
    c.turn_a = way(a->dw, a->w, time);
    c.turn_b = way(b->dw, b->w, time);
    return c;
}
static cairn_course course_until(const cairn_impact *i, cairn_unit time) { return course_at(i, time, false); }
static cairn_course course_of_sweeps(const cairn_impact *i) { return course_at(i, CAIRN_UNIT(1), true); }

/* How far a course has opened a row. */
CAIRN_ONCE cairn_motion opened(const cairn_line *line, const cairn_course *c)
{
    return cairn_motion_from_offset(cairn_motion_along(c->x, c->y, line->x, line->y) + cairn_motion_lever(c->turn_b, line->lever[1])
                                    - cairn_motion_lever(c->turn_a, line->lever[0]));
}

/* A body's pose when it has turned and, from the place where it was, moved. */
CAIRN_ONCE void turn(const cairn_body *body, cairn_offset turn, cairn_pose *pose)
{
    pose->shape = body->model->shape;
    pose->x = pose->y = 0;
    pose->c = CAIRN_UNIT(1);
    pose->s = 0;
    if (!cairn_body_is_round(body)) {
        cairn_angle by = cairn_angle_from_motion(cairn_motion_from_offset(turn), cairn_body_inverse_gyration(body));
        cairn_angle_rotation(cairn_angle_add(body->angle, by), &pose->c, &pose->s);
    }
}

/* The contact at a time of this sub-step, after the course until then. */
static void look(cairn_impact *i, cairn_unit time, cairn_manifold *out)
{
    const cairn_body *a = i->body[0], *b = i->body[1];
    cairn_pose pa, pb;
    i->course = course_until(i, time);
    turn(a, i->course.turn_a, &pa);
    turn(b, i->course.turn_b, &pb);
    pb.x = cairn_bodies_apart_x(a, b) + i->course.x;
    pb.y = cairn_bodies_apart_y(a, b) + i->course.y;
    cairn_poses_collide(&pa, &pb, SIGHT, out);
}

/* Makes the contact that was looked at the pair's rows. The impulses of points that persist act along these from now on. */
static void adopt(cairn_world *world, cairn_impact *i, const cairn_manifold *contact)
{
    cairn_arbiter *arbiter = i->arbiter;
    i->changed = true;
    if (!i->adopted) {
        i->adopted = true;
        sum_repeated(arbiter, &i->before);
    }
    if (contact->count == 0) { /* they pass by one another */
        arbiter->count = 0;
        arbiter->friction_impulse = 0;
        return;
    }
    uint8_t path = arbiter->path;
    cairn_arbiter_prepare(world, arbiter, contact);
    if (cairn_body_is_round(i->body[0]) || cairn_body_is_round(i->body[1])) { /* two polygons stay together more often, and gained nothing */
        i->lean = cairn_dir_lean(contact->normal_x, contact->normal_y, arbiter->normal_x, arbiter->normal_y);
    }
    if (i->substep != 0) {
        arbiter->path = path; /* whether its impulses are repeated with the bodies' changes does not alter within a step */
    }
    for (int k = 0; k < arbiter->count; k++) {
        cairn_row *row = &arbiter->rows[k];
        cairn_motion separation = cairn_motion_from_offset(contact->points[k].separation);
        cairn_line line = cairn_impact_line(i, k);
        cairn_motion gap = cairn_motion_add(separation, -opened(&line, &i->course)); /* at the step's start */
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
    if (turning_of(i->body[0]) + turning_of(i->body[1]) < CAIRN_IMPACT_TURNING) {
        return;
    }
    look(i, CAIRN_UNIT(1), &contact);
    /* Beyond the other's middle it would be pushed out at the far side. */
    bool passes = contact.count > 0
               && cairn_unit_dot(contact.normal_x, contact.normal_y, cairn_unit_from_dir(i->arbiter->normal_x), cairn_unit_from_dir(i->arbiter->normal_y)) <= 0;
    if (contact.count > 0 && !passes && size_of(contact.separation) < NEAR) {
        adopt(world, i, &contact);
    }
}

/* part / whole, below 2 */
CAIRN_ONCE cairn_unit time_of(cairn_motion part, cairn_motion whole)
{
    cairn_unit half = cairn_motion_fraction(cairn_motion_half(part), whole);
    return 2 * (half < CAIRN_UNIT(0.99) ? half : CAIRN_UNIT(0.99));
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
    for (int k = 0; k < arbiter->count; k++) {
        cairn_row *row = &arbiter->rows[k];
        cairn_line line = cairn_impact_line(i, k);
        cairn_motion u = cairn_impact_velocity(i, &line);
        row->feature = (uint16_t)((row->feature & ~CAIRN_ROW_IN_FLIGHT) | cairn_flag_if(u > i->rest, CAIRN_ROW_IN_FLIGHT)); /* leaves so fast that it flies */
        if (u >= -i->rest) { /* no impact */
            continue;
        }
        cairn_motion gravity = cairn_impact_pull(i);
        cairn_course now = course_until(i, 0), end = course_of_sweeps(i);
        cairn_motion separation = opened(&line, &now);
        /* A pair that touched may have come apart by another impact in this step: then it meets only after that. */
        if (row->gap <= 0 && separation > cairn_motion_half(gravity * i->substep)) {
            row->gap = JUST_APART;
            i->changed = true;
        }
        if (row->gap > 0 && cairn_motion_add(row->gap, opened(&line, &end)) > CLOSE) {
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

cairn_motion cairn_impact_closing(const cairn_impact *i, const cairn_line *line)
{
    cairn_motion closing = cairn_motion_unit(cairn_impact_pull(i), i->time) - cairn_impact_velocity(i, line);
    return closing > i->rest ? closing : 0;
}

/* The first point to hit by the contact that was looked at, or -1 if none does in this sub-step. */
static int measure(cairn_impact *i, const cairn_manifold *contact)
{
    cairn_arbiter *arbiter = i->arbiter;
    cairn_course end = course_of_sweeps(i);
    int first = -1;
    for (int k = 0; k < arbiter->count; k++) {
        cairn_row *row = &arbiter->rows[k];
        cairn_line line = cairn_impact_line(i, k);
        cairn_motion start = cairn_motion_add(cairn_motion_from_offset(contact->points[k].separation), -opened(&line, &i->course));
        i->closing[k] = cairn_impact_closing(i, &line);
        if (i->closing[k] == 0) {
            continue;
        }
        if (cairn_motion_add(start, opened(&line, &end)) > 2 * CLOSE) {
            row->feature |= CAIRN_ROW_IN_FLIGHT;
            i->closing[k] = 0;
        } else if (first < 0 || contact->points[k].separation < contact->points[first].separation) {
            first = k;
        }
    }
    return first;
}

/* Finds the contact at the moment of the impact, and the moment exactly; false if the two miss in this sub-step. */
bool cairn_impact_meet(cairn_world *world, cairn_impact *i)
{
    for (int look_no = 0; look_no < LOOKS; look_no++) {
        cairn_manifold contact;
        look(i, i->time, &contact);
        adopt(world, i, &contact);
        int first = measure(i, &contact);
        if (first < 0) {
            return false;
        }
        i->depth = -cairn_motion_from_offset(contact.points[first].separation);
        cairn_unit by = time_of(size_of(i->depth), i->closing[first]);
        cairn_unit time = cairn_motion_above_zero(cairn_motion_add(i->time, i->depth > 0 ? -by : by), CAIRN_UNIT(1.98));
        if (time == i->time || look_no == LOOKS - 1 || size_of(i->depth) <= MET) {
            break;
        }
        i->time = time;
    }
    return true;
}

/* Hands rows that were made within the step to the sweeps: their levers are those of another moment than the displacements, see slide.c. */
void cairn_impact_hand_back(cairn_impact *i)
{
    const cairn_body *a = i->body[0], *b = i->body[1];
    if (cairn_arbiter_may_slide(a, b)) {
        cairn_course now = course_at(i, 0, true);
        cairn_arbiter_slide(a, b, i->arbiter, now.x - i->course.x, now.y - i->course.y);
        cairn_arbiter_mark_careful(i->arbiter, a, b);
    }
    repeat_anew(i, &i->before);
}
