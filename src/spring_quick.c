/*
 * Paths whose springs go from centre to centre, the quick way. Each spring has a frame, its direction and length where they were last
 * computed; as long as its bodies have moved by little since, a 64th of its length at most, its elongation and its direction follow from
 * what they moved by, with no root and no division. When one spring has left its frame all of the path get new ones, and the path
 * new factors.
 *
 * The solution is that of spring_path.c, with what depends on directions only multiplied beforehand: half of what a spring pulls with,
 * the impulse's opposite, is pull C* + drag u, less take (that of the one before), less give (that of the one behind). It is one half because
 * that is what each of two bodies of one mass gets, and because a gain is then below 1.
 */
#include "spring_solve.h"

/* Springs that are stretched by more are solved with care, m: what a gain is multiplied by stays below 4. */
#define STRETCH_MAX CAIRN_STRETCH(3)
/* Half a pull for which the gains serve: every sum of products is then below 8. */
#define HALF_MAX CAIRN_MOTION(1)
/* A body slower than this is shifted without a look at the limits. */
#define SLOW CAIRN_MOTION(0.5)

/* ---- frames ---- */

static void set_flag(cairn_spring *spring, unsigned flag, bool set)
{
    spring->flags = (uint16_t)((spring->flags & ~flag) | cairn_flag_if(set, flag));
}

void cairn_path_look(cairn_world *world, cairn_spring *first)
{
    bool simple = true;
    for (const cairn_spring *spring = first; spring != NULL; spring = cairn_spring_behind(world->springs, spring)) {
        simple = simple && (spring->flags & (CAIRN_SPRING_PLAIN | CAIRN_SPRING_EXACT)) == CAIRN_SPRING_PLAIN;
    }
    set_flag(first, CAIRN_SPRING_SIMPLE, simple);
}

typedef struct place {
    cairn_motion x, y;
} place;

/* How far a body will have moved in this step at the end of the sub-step, with its velocity as it is; below 7.8 m, see world.c. */
static inline place way_of(const cairn_body *body)
{
    place p;
    p.x = body->dx + body->vx;
    p.y = body->dy + body->vy;
    return p;
}

/* Where it lay at the end of the sub-step before: its direction, without a frame. */
static void leave_frame(cairn_spring *spring)
{
    cairn_dir x = cairn_frame_x(&spring->frame, spring->swing), y = cairn_frame_y(&spring->frame, spring->swing);
    spring->frame.x = x;
    spring->frame.y = y;
    spring->swing = 0;
}

/* A frame where the spring will be at the end of the sub-step. False if it is too long, too short or stretched too far. */
static bool make_frame(const cairn_world *world, cairn_spring *spring)
{
    const cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
    place from = way_of(a), to = way_of(b);
    cairn_unit x, y;
    leave_frame(spring);
    cairn_dir from_x = spring->frame.x, from_y = spring->frame.y;
    spring->made.frame.x = b->x - a->x + cairn_real_below_motion(to.x) - cairn_real_below_motion(from.x);
    spring->made.frame.y = b->y - a->y + cairn_real_below_motion(to.y) - cairn_real_below_motion(from.y);
    if (!cairn_real_is_within(spring->made.frame.x, CAIRN_F(16)) || !cairn_real_is_within(spring->made.frame.y, CAIRN_F(16))) {
        return false;
    }
    cairn_offset length = cairn_unit_along(cairn_offset_from_real(spring->made.frame.x), cairn_offset_from_real(spring->made.frame.y), &x, &y);
    cairn_frame frame;
    if (!cairn_frame_set(&frame, x, y, length)) {
        return false;
    }
    spring->frame = frame;
    spring->elongation = cairn_stretch_from_offset(length - spring->rest_length);
    spring->direction_x = frame.x;
    spring->direction_y = frame.y;
    if (cairn_dir_turn(from_x, from_y, frame.x, frame.y) < CAIRN_SPRING_FAST) {
        spring->swing = (cairn_swing)cairn_frame_tilt(&frame, from_x, from_y);
    }
    return cairn_stretch_clamp(spring->elongation, STRETCH_MAX) == spring->elongation;
}

/* Where the step began, as seen from where the frame was made; false if that is too far. */
static inline bool follow(cairn_spring *spring, const cairn_body *a, const cairn_body *b)
{
    cairn_real x = b->x - a->x - spring->made.frame.x, y = b->y - a->y - spring->made.frame.y;
    spring->origin_x = cairn_motion_between(x, a->x_residue, b->x_residue);
    spring->origin_y = cairn_motion_between(y, a->y_residue, b->y_residue);
    return cairn_frame_holds_well(&spring->frame, x, y);
}

/* The gains are below 1 where the inverse pivot is below 2; else the spring is solved with care. */
static bool make_gains(cairn_spring *spring)
{
    cairn_factor take = cairn_factor_mul(spring->before, spring->inverse_pivot);
    bool mild = spring->inverse_pivot <= CAIRN_FACTOR(1.9999) && take <= CAIRN_FACTOR(1) && -take <= CAIRN_FACTOR(1);
    spring->pull = cairn_gain_zero();
    spring->drag = cairn_gain_zero();
    if (mild) {
        spring->pull = cairn_gain_times_half(cairn_gain_from_wide(spring->position_gain), spring->inverse_pivot);
        spring->drag = cairn_gain_times_half(cairn_gain_from_share(spring->velocity_gain), spring->inverse_pivot);
    }
    spring->take = cairn_part_from_factor(mild ? take : 0);
    spring->keep = cairn_ratio_from_factor(mild ? cairn_factor_mul(cairn_factor_from_share(spring->yield), spring->inverse_pivot) : 0);
    bool fits = spring->behind <= CAIRN_FACTOR(1.99) && -spring->behind <= CAIRN_FACTOR(1.99);
    spring->give = cairn_ratio_from_factor(fits ? spring->behind : 0);
    return fits;
}

/* New frames for all of a path; false if it has to be solved with care. */
static bool renew(cairn_world *world, cairn_spring *first)
{
    const cairn_spring_pool *pool = world->springs;
    bool framed = true;
    for (cairn_spring *spring = first; spring != NULL && framed; spring = cairn_spring_behind(pool, spring)) {
        framed = make_frame(world, spring);
    }
    if (framed) {
        cairn_path_factorise(world, first);
    }
    for (cairn_spring *spring = first; spring != NULL && framed; spring = cairn_spring_behind(pool, spring)) {
        framed = make_gains(spring);
        follow(spring, &world->bodies[spring->a], &world->bodies[spring->b]);
    }
    for (cairn_spring *spring = first; spring != NULL && !framed; spring = cairn_spring_behind(pool, spring)) {
        leave_frame(spring);
    }
    set_flag(first, CAIRN_SPRING_FRAMED, framed);
    return framed;
}

bool cairn_path_follow(cairn_world *world, cairn_spring *first)
{
    bool holds = (first->flags & CAIRN_SPRING_FRAMED) != 0;
    if (!(first->flags & CAIRN_SPRING_SIMPLE)) {
        return false;
    }
    const cairn_body *a = &world->bodies[first->a];
    for (cairn_spring *spring = first; spring != NULL; spring = cairn_spring_behind(world->springs, spring)) {
        const cairn_body *b = &world->bodies[spring->b];
        holds = follow(spring, a, b) && holds;
        spring->lag = cairn_frame_is_passed(&spring->frame, 2 * spring->pulled) ? CAIRN_LAG_NONE : CAIRN_LAG_QUARTER;
        a = b;
    }
    return holds || renew(world, first);
}

/* ---- the sub-step ---- */

/* Half of the pull, whatever the gains and the springs are. */
static cairn_motion half_with_care(const cairn_spring *spring, const cairn_body *a, const cairn_body *b, cairn_stretch elongation, cairn_motion half,
                                   bool again)
{
    cairn_motion demand = cairn_motion_scale(cairn_motion_from_stretch(elongation), spring->position_gain);
    demand = cairn_motion_clamp(cairn_motion_clamp(demand, CAIRN_SPRING_DEMAND) + cairn_motion_share(cairn_spring_speed(spring, a, b), spring->velocity_gain),
                                CAIRN_SPRING_DEMAND);
    if (again) {
        demand = cairn_spring_ask_more(spring, demand);
    }
    return cairn_motion_half(-cairn_spring_answer(spring, demand, -2 * half));
}

/* Whether the frames of a path will do for this sub-step. */
static bool frames_hold(const cairn_world *world, const cairn_spring *spring)
{
    for (; spring != NULL; spring = cairn_spring_behind(world->springs, spring)) {
        place from = way_of(&world->bodies[spring->a]), to = way_of(&world->bodies[spring->b]);
        if (!cairn_frame_holds(&spring->frame, cairn_motion_apart(from.x, to.x, spring->origin_x), cairn_motion_apart(from.y, to.y, spring->origin_y))) {
            return false;
        }
    }
    return true;
}

/*
 * Down the path: where each spring will be, which way it pushes, and what it pulls with but for what is behind it. The path's last spring, or
 * null if one has left its frame: *outside.
 */
static cairn_spring *descend(const cairn_world *world, cairn_spring *first, bool again, const cairn_spring **outside)
{
    cairn_spring *springs = world->springs->springs;
    const cairn_body *bodies = world->bodies, *a = &bodies[first->a];
    place from = way_of(a);
    cairn_motion half = 0;
    for (cairn_spring *spring = first;; spring = &springs[spring->next]) {
        const cairn_body *b = &bodies[spring->b];
        place to = way_of(b);
        cairn_motion x = cairn_motion_apart(from.x, to.x, spring->origin_x), y = cairn_motion_apart(from.y, to.y, spring->origin_y);
        if (!cairn_frame_holds(&spring->frame, x, y)) {
            *outside = spring;
            return NULL;
        }
        cairn_tilt tilt, was = spring->swing;
        cairn_stretch elongation = spring->elongation + cairn_frame_stretch(&spring->frame, x, y, &tilt);
        cairn_motion before = half;
        spring->swung = (cairn_swing)was;
        spring->swing = (cairn_swing)tilt;
        tilt = cairn_tilt_towards(was, tilt, spring->lag);
        cairn_dir push_x = cairn_frame_x(&spring->frame, tilt), push_y = cairn_frame_y(&spring->frame, tilt);
        spring->direction_x = push_x;
        spring->direction_y = push_y;
        half = cairn_motion_gain(elongation, spring->pull) - cairn_motion_part(half, spring->take);
        if (!cairn_gain_is_zero(spring->drag)) {
            half += cairn_motion_gain(cairn_stretch_along(b->vx - a->vx, b->vy - a->vy, push_x, push_y), spring->drag);
        }
        if (again) {
            half -= cairn_motion_ratio(spring->pulled, spring->keep);
        }
        if (cairn_gain_is_zero(spring->pull) || !cairn_size_is_below(cairn_size_of(half), HALF_MAX)) {
            half = half_with_care(spring, a, b, elongation, before, again);
        }
        spring->pulled = half;
        if (spring->next == CAIRN_NONE) {
            return spring;
        }
        a = b;
        from = to;
    }
}

static inline void shift(cairn_body *body, cairn_motion x, cairn_motion y)
{
    cairn_motion vx = body->vx + x, vy = body->vy + y;
    if (!CAIRN_SMALL && cairn_size_is_below(cairn_size_with(cairn_size_of(vx), vy), SLOW)) {
        body->vx = vx;
        body->vy = vy;
        body->ux += x;
        body->uy += y;
    } else {
        cairn_spring_shift(body, x, y);
    }
}

/* Back up the path: what is behind a spring counts too. Each body gets the pushes of both of its springs at once. */
static void ascend(const cairn_world *world, const cairn_spring *first, cairn_spring *last)
{
    cairn_spring *springs = world->springs->springs;
    cairn_body *bodies = world->bodies;
    cairn_motion half = 0;
    place behind;
    behind.x = behind.y = 0;
    for (cairn_spring *spring = last;; spring = &springs[spring->previous]) {
        half = cairn_motion_clamp(spring->pulled - cairn_motion_ratio(half, spring->give), CAIRN_SPRING_IMPULSE / 2);
        spring->pulled = half;
        place pull;
        pull.x = cairn_motion_dir(half, spring->direction_x);
        pull.y = cairn_motion_dir(half, spring->direction_y);
        if (spring->share_b == CAIRN_SHARE(0.5)) {
            shift(&bodies[spring->b], behind.x - pull.x, behind.y - pull.y);
            behind = pull;
        } else {
            shift(&bodies[spring->b], behind.x - cairn_motion_share(2 * pull.x, spring->share_b),
                  behind.y - cairn_motion_share(2 * pull.y, spring->share_b));
            behind.x = cairn_motion_share(2 * pull.x, spring->share_a);
            behind.y = cairn_motion_share(2 * pull.y, spring->share_a);
        }
        if (spring == first) {
            break;
        }
    }
    if (first->share_a != 0) {
        shift(&bodies[first->a], behind.x, behind.y);
    }
}

/* A path that is left half way down forgets what it pulled with, which another sweep has to know. */
void cairn_path_solve_quickly(cairn_world *world, cairn_spring *first, bool again)
{
    cairn_spring *last = NULL;
    const cairn_spring *outside = first;
    if (!again || frames_hold(world, first)) {
        last = descend(world, first, again, &outside);
    }
    if (last == NULL) {
        for (cairn_spring *spring = first; spring != outside; spring = &world->springs->springs[spring->next]) {
            spring->swing = spring->swung;
        }
        last = renew(world, first) ? descend(world, first, again, &outside) : NULL;
    }
    if (last == NULL) {
        cairn_path_solve(world, first, again);
    } else {
        ascend(world, first, last);
    }
}
