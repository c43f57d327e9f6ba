/*
 * Restitution: an impact phase at the start of each sub-step. A contact that will close in this sub-step is solved as
 * the impact that it is: at its own time t and place, with its own speed, by Newton's law u+ = -e u-. Doing it in the
 * sweeps instead stops the body early and rebounds with the speed of the step's start, which loses energy at every bounce.
 *
 * The rows of the step's start tell roughly when; the narrow phase at the poses of that moment then gives normal, levers
 * and the exact time. An impulse with levers of one moment and positions of another would falsify angular momentum.
 * The impulse changes the whole sub-step's motion, so the part of it before t is taken back from the displacement.
 */
#include "engine.h"

#define PASSES 16
/* How often the normal impulses are repeated after friction. */
#define RUBS 12
/* What rounding may add to a separation, m: so near at the end of the sub-step, and the sweeps would stop the body. */
#define CLOSE CAIRN_MOTION(2e-6)
/* How often the time of an impact is corrected, until the points are as near as this to one another. */
#define LOOKS 8
#define MET CAIRN_MOTION(2e-5)
/* A pair that turns by more than this in a sub-step, m at the radius of gyration, is looked at again while so near. */
#define TURNING CAIRN_OFFSET(0.001)
#define NEAR CAIRN_OFFSET(0.05)
/* Bodies that lie deeper than this in one another when they hit are moved apart. Less is left: it costs angular momentum. */
#define DEEP CAIRN_MOTION(0.005)
/* How far apart the narrow phase still finds a contact: more than it is wrong about the time. */
#define SIGHT CAIRN_OFFSET(0.5)
/* The gap of a pair that touched and was thrown apart within the step: above zero, so that its separation counts. */
#define JUST_APART CAIRN_MOTION(4e-9)

/* The sum of a pair's impulses as the warm start repeats them: on b, and the turning of each. */
typedef struct repeated {
    cairn_motion x, y, turn_a, turn_b;
} repeated;

typedef struct impact {
    cairn_arbiter *arbiter;
    cairn_body *a, *b;
    cairn_factor restitution;
    cairn_factor norm;       /* the rounded normal's own square */
    cairn_motion rest;       /* what closes slower does not rebound: the threshold, or what gravity gives in a sub-step */
    cairn_motion gx, gy;     /* gravity's change of the relative velocity in a sub-step; nothing where both fall alike */
    cairn_motion closing[2]; /* speed at the moment of the impact; 0: this point does not take part */
    cairn_motion px, py;     /* sum of the impulses on b */
    cairn_motion depth;      /* of the point that hits, at that moment */
    cairn_offset x, y;       /* how far b had moved to a in this step when the rows were looked at */
    cairn_unit time;         /* in sub-steps from this one's start; may lie a little beyond its end */
    bool adopted;            /* the rows were made within the step, by a look ahead or by the impact itself; those before held: */
    repeated before;
    int substep;
} impact;

static cairn_motion velocity_along(const impact *i, cairn_dir nx, cairn_dir ny, cairn_lever ja, cairn_lever jb)
{
    return cairn_motion_along(i->b->vx - i->a->vx, i->b->vy - i->a->vy, nx, ny) + cairn_motion_lever(i->b->w, jb) - cairn_motion_lever(i->a->w, ja);
}

static cairn_motion row_velocity(const impact *i, const cairn_row *row)
{
    return velocity_along(i, i->arbiter->normal_x, i->arbiter->normal_y, row->lever_a, row->lever_b);
}

static void mix(impact *i, const cairn_world *world)
{
    const cairn_material *a = i->a->model->material, *b = i->b->model->material;
    cairn_real threshold = a->bounce == NULL ? b->threshold : b->bounce == NULL || a->threshold < b->threshold ? a->threshold : b->threshold;
    i->restitution = a->restitution > b->restitution ? a->restitution : b->restitution;
    i->rest = cairn_motion_from_real(threshold, world->substep);
}

static cairn_motion size_of(cairn_motion x) { return x < 0 ? -x : x; }

/* What gravity does to the pair. No sum of a step's can wrap: g k / 2 of at most 15 sub-steps stays below 4 m, and g k below 8. */
static void weigh(impact *i, const cairn_world *world)
{
    cairn_motion g = cairn_motion_add(size_of(world->gravity_x.whole), size_of(world->gravity_y.whole));
    i->rest = g > i->rest ? g : i->rest;
    i->gx = i->gy = 0;
    if (!cairn_body_is_dynamic(i->a) && !(i->b->flags & CAIRN_BODY_FIXED_POSITION)) {
        cairn_factor scale = cairn_factor_from_real(i->b->model->gravity_scale);
        i->gx = cairn_motion_clamp(cairn_motion_factor(world->gravity_x.whole, scale), CAIRN_MOTION(0.35));
        i->gy = cairn_motion_clamp(cairn_motion_factor(world->gravity_y.whole, scale), CAIRN_MOTION(0.35));
    }
}

/* Gravity's pull along the approach. */
static cairn_motion pull(const impact *i) { return -cairn_motion_along(i->gx, i->gy, i->arbiter->normal_x, i->arbiter->normal_y); }

/* ---- what the sweeps hold of the pair ---- */

/* What the impulses that the rows hold do to the two. */
static repeated repeated_of(const impact *i)
{
    const cairn_arbiter *arbiter = i->arbiter;
    cairn_motion rub = arbiter->friction_impulse, of_a = cairn_motion_share(rub, arbiter->share_a);
    repeated sum = { 0, 0, 0, 0 };
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
    if (!(body->flags & CAIRN_BODY_FIXED_POSITION)) {
        body->ux = cairn_motion_add(body->ux, -x);
        body->uy = cairn_motion_add(body->uy, -y);
    }
    body->uw = cairn_motion_add(body->uw, -turn);
}

/* Between sub-steps velocity changes are repeated, v + (v - u), and with them the rows' impulses: have that follow a change of these. */
static void repeat_anew(const impact *i, const repeated *before)
{
    if (i->substep == 0 || cairn_arbiter_is_sliding(i->arbiter)) { /* the warm start reads the rows themselves */
        return;
    }
    repeated now = repeated_of(i);
    cairn_motion x = cairn_motion_add(now.x, -before->x), y = cairn_motion_add(now.y, -before->y);
    cairn_motion ax = cairn_motion_share(x, i->arbiter->share_a), ay = cairn_motion_share(y, i->arbiter->share_a);
    if (i->arbiter->share_a != 0) {
        repeat(i->a, -ax, -ay, cairn_motion_add(before->turn_a, -now.turn_a));
    }
    repeat(i->b, x - ax, y - ay, cairn_motion_add(now.turn_b, -before->turn_b));
}

/* An impact ends a contact: what held it until then is not to be repeated. */
static void forget_row(const impact *i, cairn_row *row)
{
    if (row->impulse == 0) {
        return;
    }
    repeated before = repeated_of(i);
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
static cairn_offset fall(const impact *i, cairn_motion g, cairn_unit time)
{
    return cairn_offset_from_motion(cairn_motion_half(cairn_motion_unit(cairn_motion_unit(g, time), time) - g * i->substep));
}

static course course_until(const impact *i, cairn_unit time)
{
    const cairn_body *a = i->a, *b = i->b;
    course c;
    c.x = way(b->dx, b->vx, time) - way(a->dx, a->vx, time) + fall(i, i->gx, time);
    c.y = way(b->dy, b->vy, time) - way(a->dy, a->vy, time) + fall(i, i->gy, time);
    c.turn_a = way(a->dw, a->w, time);
    c.turn_b = way(b->dw, b->w, time);
    return c;
}

/* As the sweeps will see it at the end of this sub-step: half a sub-step's fall farther down for each so far. */
static course course_of_sweeps(const impact *i)
{
    const cairn_body *a = i->a, *b = i->b;
    course c;
    c.x = way(b->dx, b->vx + i->gx, CAIRN_UNIT(1)) - way(a->dx, a->vx, CAIRN_UNIT(1));
    c.y = way(b->dy, b->vy + i->gy, CAIRN_UNIT(1)) - way(a->dy, a->vy, CAIRN_UNIT(1));
    c.turn_a = way(a->dw, a->w, CAIRN_UNIT(1));
    c.turn_b = way(b->dw, b->w, CAIRN_UNIT(1));
    return c;
}

/* How far a course has opened a row. */
static cairn_motion opened(const impact *i, const cairn_row *row, const course *c)
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

static void contact_after(const impact *i, const course *c, cairn_manifold *out)
{
    cairn_pose a = turned(i->a, c->turn_a), b = turned(i->b, c->turn_b);
    b.x = cairn_bodies_apart_x(i->a, i->b) + c->x;
    b.y = cairn_bodies_apart_y(i->a, i->b) + c->y;
    cairn_poses_collide(&a, &b, SIGHT, out);
}

/* Makes the contact after a course the pair's rows. The impulses of points that persist act along these from now on. */
static void adopt(cairn_world *world, impact *i, const course *c, const cairn_manifold *contact)
{
    cairn_arbiter *arbiter = i->arbiter;
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
    if (i->substep != 0) {
        arbiter->path = path; /* whether its impulses are repeated with the bodies' changes does not alter within a step */
    }
    i->x = c->x;
    i->y = c->y;
    for (int k = 0; k < arbiter->count; k++) {
        cairn_row *row = &arbiter->rows[k];
        cairn_motion separation = cairn_motion_from_offset(contact->points[k].separation);
        cairn_motion gap = cairn_motion_add(separation, -opened(i, row, c)); /* at the step's start */
        if (gap > 0 || separation >= -DEEP) { /* what lies deeper is pushed out as ever */
            row->gap = gap > 0 ? gap : JUST_APART;
        }
    }
}

/*
 * Rows are straight and a turning body's surface is not: a pair that turns while near gets those of where it will be
 * at the end of this sub-step, which also show a corner that was beside the other's face until now.
 */
static void refresh(cairn_world *world, impact *i)
{
    cairn_manifold contact;
    if (size_of(cairn_offset_from_motion(i->a->w)) + size_of(cairn_offset_from_motion(i->b->w)) < TURNING) {
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
static cairn_unit time_of(cairn_motion part, cairn_motion whole)
{
    cairn_unit half = cairn_motion_fraction(cairn_motion_half(part), whole);
    return 2 * (half < CAIRN_UNIT(0.99) ? half : CAIRN_UNIT(0.99));
}

/*
 * Do the rows as they are say that some point hits in this sub-step? About when the first one does. What the sweeps
 * would stop counts, even where the true impact lies a moment later.
 */
static bool foresee(impact *i)
{
    cairn_arbiter *arbiter = i->arbiter;
    cairn_motion gravity = pull(i);
    course now = course_until(i, 0), end = course_of_sweeps(i);
    bool hits = false;
    i->time = CAIRN_UNIT(1.98);
    for (int k = 0; k < arbiter->count; k++) {
        cairn_row *row = &arbiter->rows[k];
        cairn_motion u = row_velocity(i, row), separation = opened(i, row, &now);
        row->feature &= (uint16_t)~CAIRN_ROW_IN_FLIGHT;
        if (u >= -i->rest) {
            row->feature |= (uint16_t)cairn_flag_if(u > i->rest, CAIRN_ROW_IN_FLIGHT);
            continue;
        }
        /* A pair that touched may have come apart by another impact in this step: then it meets only after that. */
        if (row->gap <= 0 && separation > cairn_motion_half(gravity * i->substep)) {
            row->gap = JUST_APART;
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
static int measure(impact *i, const cairn_manifold *contact, const course *c)
{
    cairn_arbiter *arbiter = i->arbiter;
    cairn_motion gravity = pull(i);
    course end = course_of_sweeps(i);
    int first = -1;
    for (int k = 0; k < arbiter->count; k++) {
        cairn_row *row = &arbiter->rows[k];
        cairn_motion closing = cairn_motion_unit(gravity, i->time) - row_velocity(i, row);
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
static bool meet(cairn_world *world, impact *i)
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

/* ---- by how much ---- */

static cairn_factor coupling(const cairn_arbiter *arbiter, cairn_factor linear, cairn_lever ja, cairn_lever ka, cairn_lever jb, cairn_lever kb)
{
    return linear + cairn_factor_spin(arbiter->share_a, ja, ka) + cairn_factor_spin(cairn_arbiter_share_b(arbiter), jb, kb);
}

static cairn_factor linear_part(const impact *i)
{
    cairn_share share = (i->a->flags & CAIRN_BODY_FIXED_POSITION ? 0 : i->arbiter->share_a)
                      + (i->b->flags & CAIRN_BODY_FIXED_POSITION ? 0 : cairn_arbiter_share_b(i->arbiter));
    return cairn_factor_mul(cairn_factor_from_share(share), i->norm);
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
    if (!(body->flags & CAIRN_BODY_FIXED_POSITION)) {
        body->vx = cairn_motion_clamp(cairn_motion_add(body->vx, px), CAIRN_SWEEP_SPEED);
        body->vy = cairn_motion_clamp(cairn_motion_add(body->vy, py), CAIRN_SWEEP_SPEED);
    }
    body->w = cairn_motion_clamp(cairn_motion_add(body->w, spin), CAIRN_SWEEP_SPIN);
}

/* An impulse along (nx, ny) with these levers on both bodies. */
static void strike(impact *i, cairn_motion impulse, cairn_dir nx, cairn_dir ny, cairn_lever ja, cairn_lever jb)
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
static void rub(const cairn_world *world, impact *i, cairn_motion pressure)
{
    cairn_arbiter *arbiter = i->arbiter;
    cairn_dir tx = cairn_dir_negate(arbiter->normal_y), ty = arbiter->normal_x;
    cairn_lever ja = arbiter->friction_lever_a, jb = arbiter->friction_lever_b;
    cairn_motion impulse = -cairn_motion_ratio(velocity_along(i, tx, ty, ja, jb), arbiter->friction_mass);
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
    if (share != 0 && !(body->flags & CAIRN_BODY_FIXED_POSITION)) {
        body->vx = cairn_motion_clamp(cairn_motion_add(before.x, cairn_motion_share_carried(px, share, &body->vx_carry)), CAIRN_SWEEP_SPEED);
        body->vy = cairn_motion_clamp(cairn_motion_add(before.y, cairn_motion_share_carried(py, share, &body->vy_carry)), CAIRN_SWEEP_SPEED);
    }
}

/* The change is not to be repeated by the warm start, and acts only after the impact's time. */
static void settle(cairn_world *world, cairn_body *body, velocity before, cairn_unit time, int substep)
{
    /* What the sub-steps to come may add to a displacement must fit, too. */
    cairn_motion room = CAIRN_MOTION(7.99) - world->speed_limit * (world->substeps - substep);
    cairn_body_limit_speed(world, body);
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

static void shove(cairn_body *body, cairn_motion by, cairn_dir nx, cairn_dir ny)
{
    if (!(body->flags & CAIRN_BODY_FIXED_POSITION)) {
        body->dx = cairn_motion_add(body->dx, cairn_motion_dir(by, nx));
        body->dy = cairn_motion_add(body->dy, cairn_motion_dir(by, ny));
    }
}

/* Bodies that lie in one another when they hit are moved apart by half of that. By place and not by speed, which would be energy. */
static void part(const cairn_world *world, impact *i)
{
    const cairn_arbiter *arbiter = i->arbiter;
    cairn_motion depth = i->depth - cairn_motion_from_offset(cairn_offset_from_real(world->slop)) - DEEP;
    if (depth <= 0) {
        return;
    }
    depth = cairn_motion_half(depth) < world->push_out_limit ? cairn_motion_half(depth) : world->push_out_limit;
    if (arbiter->share_a != 0) {
        shove(i->a, -cairn_motion_share(depth, arbiter->share_a), arbiter->normal_x, arbiter->normal_y);
    }
    shove(i->b, cairn_motion_share(depth, cairn_arbiter_share_b(arbiter)), arbiter->normal_x, arbiter->normal_y);
}

/* What an impact has made faster may need the watch over fast bodies, which was set at the step's start. */
static void hasten(cairn_world *world, cairn_body *body)
{
    if (world->continuous == NULL || !cairn_body_is_dynamic(body) || !cairn_body_is_fast(world, body)) {
        return;
    }
    body->flags |= CAIRN_BODY_FAST;
    world->fast++;
}

static impact impact_of(const cairn_world *world, cairn_arbiter *arbiter, int substep)
{
    impact i;
    i.arbiter = arbiter;
    i.a = &world->bodies[arbiter->a];
    i.b = &world->bodies[arbiter->b];
    i.px = i.py = 0;
    i.x = i.y = 0;
    i.adopted = false;
    i.substep = substep;
    mix(&i, world);
    weigh(&i, world);
    return i;
}

static bool may_bounce(const cairn_arbiter *arbiter)
{
    return (arbiter->flags & (CAIRN_ARBITER_SOLVED | CAIRN_ARBITER_BOUNCY)) == (CAIRN_ARBITER_SOLVED | CAIRN_ARBITER_BOUNCY);
}

/* Does one of the two hit another body before that? Then this impact may never be: a ball on the joint of two tiles. */
static bool is_forestalled(cairn_world *world, const impact *i)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        const cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
        bool shared = b == i->b || b == i->a || (a == i->a && cairn_body_is_dynamic(a)) || a == i->b;
        if (arbiter != i->arbiter && shared && may_bounce(arbiter)) {
            impact other = impact_of(world, arbiter, i->substep);
            if (foresee(&other) && other.time < i->time) {
                return true;
            }
        }
    }
    return false;
}

/* Which of the points that hit still close: friction may have turned the bodies back on them. */
static bool still_closes(impact *i)
{
    bool any = false;
    for (int k = 0; k < i->arbiter->count; k++) {
        if (i->closing[k] > 0) {
            cairn_motion closing = cairn_motion_unit(pull(i), i->time) - row_velocity(i, &i->arbiter->rows[k]);
            i->closing[k] = closing > i->rest ? closing : 0;
            any = any || closing > i->rest;
        }
    }
    return any;
}

/* All impulses of the impact, at one moment and one place. */
static void exchange(const cairn_world *world, impact *i)
{
    const cairn_arbiter *arbiter = i->arbiter;
    bool closes = true;
    for (int n = 0; n < RUBS && closes; n++) {
        cairn_motion first, second;
        resolve(i, &first, &second);
        strike(i, first, arbiter->normal_x, arbiter->normal_y, arbiter->rows[0].lever_a, arbiter->rows[0].lever_b);
        strike(i, second, arbiter->normal_x, arbiter->normal_y, arbiter->rows[1].lever_a, arbiter->rows[1].lever_b);
        rub(world, i, cairn_motion_add(first, second));
        closes = still_closes(i);
    }
}

/* The impact, and what follows from it. */
static void rebound(cairn_world *world, impact *i)
{
    cairn_arbiter *arbiter = i->arbiter;
    velocity a = velocity_of(i->a), b = velocity_of(i->b);
    i->norm = cairn_factor_square(arbiter->normal_x, arbiter->normal_y);
    exchange(world, i);
    sum_up(i->a, a, -i->px, -i->py, arbiter->share_a);
    sum_up(i->b, b, i->px, i->py, cairn_arbiter_share_b(arbiter));
    settle(world, i->a, a, i->time, i->substep);
    settle(world, i->b, b, i->time, i->substep);
    part(world, i);
    hasten(world, i->a);
    hasten(world, i->b);
    arbiter->flags |= CAIRN_ARBITER_TOUCHING;
}

/* Hands rows that were made within the step to the sweeps: their levers are those of another moment than the displacements, see slide.c. */
static void hand_back(impact *i)
{
    cairn_body *a = i->a, *b = i->b;
    if (cairn_arbiter_may_slide(a, b)) {
        cairn_arbiter_slide(a, b, i->arbiter, cairn_offset_from_motion(b->dx) - cairn_offset_from_motion(a->dx) - i->x,
                            cairn_offset_from_motion(b->dy) - cairn_offset_from_motion(a->dy) - i->y);
    }
    repeat_anew(i, &i->before);
}

/* Looks for an impact of the two in this sub-step, and solves it; true if there is one, or will be after another one. */
static bool collide(cairn_world *world, cairn_arbiter *arbiter, int substep, bool waits)
{
    impact i = impact_of(world, arbiter, substep);
    bool hits = false;
    refresh(world, &i);
    if (foresee(&i)) {
        bool first = !waits || !is_forestalled(world, &i);
        hits = !first || meet(world, &i);
        if (first && hits) {
            rebound(world, &i);
        }
    }
    if (i.adopted) {
        hand_back(&i);
    }
    return hits;
}

static void impact_phase(cairn_world *world, int substep)
{
    bool any = true;
    for (int pass = 0; pass < PASSES && any; pass++) {
        any = false;
        for (uint16_t place = 0; place < world->arbiter_count; place++) {
            uint16_t at = (uint16_t)(pass & 1 ? world->arbiter_count - 1 - place : place);
            cairn_arbiter *arbiter = cairn_arbiter_at(world, at);
            if (may_bounce(arbiter)) {
                any = collide(world, arbiter, substep, pass < PASSES / 2) || any;
            }
        }
    }
}

const cairn_bounce_class cairn_bounce = { impact_phase };
