/* Where springs are: their anchors, lengths, directions and levers, now and at the end of the sub-step. */
#include "spring_solve.h"

/* The arm of an anchor when the body has turned by dw in this step. */
static cairn_offset2 turned_arm(const cairn_body *body, cairn_offset2 anchor, cairn_motion dw)
{
    cairn_unit c, s;
    if (anchor.x == 0 && anchor.y == 0) {
        return anchor;
    }
    cairn_angle_rotation(cairn_angle_add(body->angle, cairn_angle_from_motion(dw, cairn_body_inverse_gyration(body))), &c, &s);
    return cairn_offset2_turned(anchor, c, s);
}

/* The way from one anchor to the other on one axis, saturating: of the bodies before the step, what they have moved by since, and of the arms. */
static cairn_offset way(cairn_real apart, cairn_residue from, cairn_residue to, cairn_offset moved, cairn_offset from_arm,
                        cairn_offset to_arm)
{
    cairn_offset far = cairn_offset_from_real(CAIRN_SPRING_FAR);
    cairn_offset bodies = cairn_real_is_within(apart, CAIRN_SPRING_FAR) ? cairn_coordinate_offset(0, from, apart, to) : apart > 0 ? far : -far;
    return cairn_offset_add(cairn_offset_add(cairn_offset_add(bodies, moved), to_arm), -from_arm);
}

/* How far the first body has moved, or will have moved by the end of this sub-step with the velocity as it is, and then the second. */
static cairn_offset moved(cairn_motion from, cairn_motion from_speed, cairn_motion to, cairn_motion to_speed, bool ahead)
{
    return cairn_offset_from_motion(ahead ? cairn_motion_add(to, to_speed) : to)
         - cairn_offset_from_motion(ahead ? cairn_motion_add(from, from_speed) : from);
}

/* The way from anchor to anchor, and the arms, with the displacements of this step: now, or ahead at the end of this sub-step. */
CAIRN_ONCE cairn_offset2 reach_of(const cairn_spring *spring, const cairn_body *a, const cairn_body *b, bool ahead, cairn_reach *r)
{
    cairn_offset2 p;
    r->arm_a = turned_arm(a, spring->anchor_a, ahead ? cairn_motion_add(a->dw, a->w) : a->dw);
    r->arm_b = turned_arm(b, spring->anchor_b, ahead ? cairn_motion_add(b->dw, b->w) : b->dw);
    /* No sum of these wraps: CAIRN_WORLD_EDGE. */
    p.x = way(b->x - a->x, a->x_residue, b->x_residue, moved(a->dx, a->vx, b->dx, b->vx, ahead), r->arm_a.x, r->arm_b.x);
    p.y = way(b->y - a->y, a->y_residue, b->y_residue, moved(a->dy, a->vy, b->dy, b->vy, ahead), r->arm_a.y, r->arm_b.y);
    return p;
}

void cairn_spring_measure(const cairn_spring *spring, const cairn_body *a, const cairn_body *b, cairn_reach *r)
{
    cairn_offset2 p = reach_of(spring, a, b, false, r);
    r->length = cairn_unit_along(p.x, p.y, &r->x, &r->y);
}

/* (r x n) / rho */
cairn_lever cairn_spring_lever(const cairn_body *body, cairn_offset2 arm, cairn_unit x, cairn_unit y)
{
    if ((arm.x == 0 && arm.y == 0) || !cairn_body_can_turn(body)) {
        return 0;
    }
    return cairn_lever_of(cairn_offset_dot(arm.x, -arm.y, y, x), cairn_body_inverse_gyration(body));
}

void cairn_spring_point(cairn_spring *spring, const cairn_body *a, const cairn_body *b, const cairn_reach *r)
{
    spring->direction_x = cairn_dir_from_unit(r->x);
    spring->direction_y = cairn_dir_from_unit(r->y);
    if (cairn_spring_is_off_centre(spring)) {
        spring->lever_a = cairn_spring_lever(a, r->arm_a, r->x, r->y);
        spring->lever_b = cairn_spring_lever(b, r->arm_b, r->x, r->y);
    }
}

/*
 * Both bodies are pulled at the point half way between the anchors, so that no pull turns them both: along one axis it is not in line with the way
 * from anchor to anchor. What does not move may be pulled anywhere.
 */
cairn_offset cairn_spring_aim_along(cairn_spring *spring, const cairn_body *a, const cairn_body *b, bool upright, bool stays)
{
    cairn_reach r;
    cairn_offset2 p = reach_of(spring, a, b, true, &r);
    cairn_offset gap = upright ? p.y : p.x;
    if (stays) {
        return gap;
    }
    cairn_offset apart = cairn_offset_add(p.x < 0 ? -p.x : p.x, p.y < 0 ? -p.y : p.y);
    spring->made.pin.strain = cairn_motion_clamp(cairn_motion_from_offset(apart), CAIRN_SPRING_DEMAND);
    if (cairn_body_is_dynamic(a) && cairn_body_is_dynamic(b)) {
        r.arm_a.x += cairn_offset_half(p.x);
        r.arm_a.y += cairn_offset_half(p.y);
        r.arm_b.x -= cairn_offset_half(p.x);
        r.arm_b.y -= cairn_offset_half(p.y);
    }
    r.x = upright ? 0 : CAIRN_UNIT(1);
    r.y = upright ? CAIRN_UNIT(1) : 0;
    cairn_spring_point(spring, a, b, &r);
    return gap;
}

/* The greater size of the two, at most a quarter. */
static cairn_unit greater(cairn_unit a, cairn_unit b)
{
    a = a < 0 ? -a : a;
    b = b < 0 ? -b : b;
    a = a > b ? a : b;
    return a < CAIRN_UNIT(0.25) ? a : CAIRN_UNIT(0.25);
}

/* A change of a lever, over 4. */
static cairn_unit quarter_of(cairn_lever from, cairn_lever to) { return cairn_motion_lever(CAIRN_UNIT(0.125), to) * 2 - cairn_motion_lever(CAIRN_UNIT(0.125), from) * 2; }

/* The spring will end the sub-step along (x, y): its length there, and which way it pushes. */
static cairn_offset face(cairn_spring *spring, cairn_offset2 p, bool ahead, cairn_turn *turned)
{
    cairn_unit x, y;
    cairn_offset length = cairn_unit_along(p.x, p.y, &x, &y);
    cairn_dir from_x = spring->frame.x, from_y = spring->frame.y, to_x = cairn_dir_from_unit(x), to_y = cairn_dir_from_unit(y);
    *turned = cairn_dir_turn(from_x, from_y, to_x, to_y);
    spring->frame.x = to_x;
    spring->frame.y = to_y;
    if (!ahead && *turned < CAIRN_SPRING_FAST && !cairn_spring_is_taut(spring, length)) {
        to_x = cairn_dir_towards(from_x, to_x);
        to_y = cairn_dir_towards(from_y, to_y);
    }
    spring->direction_x = to_x;
    spring->direction_y = to_y;
    return length;
}

cairn_offset cairn_spring_aim(cairn_spring *spring, const cairn_body *a, const cairn_body *b, bool ahead, cairn_turn *turned)
{
    cairn_reach r;
    cairn_offset2 p = reach_of(spring, a, b, true, &r);
    cairn_offset length = face(spring, p, ahead, turned);
    if (cairn_spring_is_off_centre(spring)) {
        cairn_unit x = cairn_unit_from_dir(spring->direction_x), y = cairn_unit_from_dir(spring->direction_y);
        cairn_lever lever_a = cairn_spring_lever(a, r.arm_a, x, y), lever_b = cairn_spring_lever(b, r.arm_b, x, y);
        cairn_unit swung = greater(quarter_of(spring->lever_a, lever_a), quarter_of(spring->lever_b, lever_b));
        cairn_turn turn = 4 * cairn_turn_from_unit(swung);
        spring->lever_a = lever_a;
        spring->lever_b = lever_b;
        *turned = *turned > turn ? *turned : turn;
    }
    return length;
}
