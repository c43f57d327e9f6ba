/*
 * Pairs whose boxes overlap, in the search for contacts: one that holds is taken as it is, the others get the contact of the
 * narrow phase, if there is one, and its rows.
 */
#include "engine.h"
#include <cairn/spring.h>

/*
 * Bodies farther from one another do not touch, being 125 m in radius at most, and their corners might be out of an
 * offset's range. Only giants at the highest speeds get here.
 */
#define CENTRES_APART_MAX CAIRN_F(256)
#define MAY_BE_FAR (CAIRN_WITH_GIANTS || CAIRN_MAX_POINTS > 1) /* else one is a small circle */

void cairn_body_pose(const cairn_body *body, cairn_offset x, cairn_offset y, cairn_pose *out)
{
    out->shape = body->model->shape;
    out->x = x;
    out->y = y;
    if (CAIRN_WITH_SLOPES || CAIRN_MAX_POINTS > 1) { /* a circle's contact with a box that stands upright does not ask */
        cairn_body_facing(body, &out->c, &out->s);
    }
}

/* The contact seen from the other body. */
static void turn_round(cairn_manifold *manifold)
{
    manifold->normal_x = -manifold->normal_x;
    manifold->normal_y = -manifold->normal_y;
    if (!CAIRN_HAS_PLACES) {
        return;
    }
    int count = CAIRN_MAX_POINTS == 1 ? manifold->count != 0 : manifold->count;
    for (int i = 0; i < count; i++) {
        manifold->points[i].x += manifold->x;
        manifold->points[i].y += manifold->y;
    }
}

void cairn_poses_collide(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out)
{
    const cairn_shape_class *kind_a = a->shape->kind, *kind_b = b->shape->kind;
    if (CAIRN_HAS_PLACES) {
        out->x = b->x - a->x;
        out->y = b->y - a->y;
    }
    if (CAIRN_WITH_CONTINUOUS) {
        out->time = 0;
    }
    if (kind_a->rank <= kind_b->rank) {
        kind_b->collide[CAIRN_MAX_POINTS == 1 ? 0 : kind_a->rank](a, b, margin, out);
    } else {
        out->normal_x = out->normal_y = 0; /* not set where there is no contact */
        kind_a->collide[CAIRN_MAX_POINTS == 1 ? 0 : kind_b->rank](b, a, margin, out);
        turn_round(out);
    }
}

void cairn_bodies_collide(const cairn_body *a, const cairn_body *b, cairn_offset margin, cairn_manifold *out)
{
    cairn_pose pa, pb;
    cairn_body_pose(a, 0, 0, &pa);
    cairn_body_pose(b, cairn_bodies_apart_x(a, b), cairn_bodies_apart_y(a, b), &pb);
    cairn_poses_collide(&pa, &pb, margin, out);
}

bool cairn_bodies_may_meet(const cairn_world *world, const cairn_body *a, const cairn_body *b)
{
    const cairn_body_model *of_a = a->model, *of_b = b->model;
    if (!cairn_body_is_dynamic(a) && !cairn_body_is_dynamic(b)) {
        return false;
    }
    if (!(of_a->layer & of_b->mask) || !(of_b->layer & of_a->mask)) {
        return false;
    }
    return !CAIRN_WITH_SPRINGS || !(a->flags & b->flags & CAIRN_BODY_SPRUNG)
        || !cairn_world_springs(world)->kind->joined(world, (uint16_t)(a - world->bodies), (uint16_t)(b - world->bodies));
}

static bool any_penetrates(const cairn_manifold *manifold)
{
    return manifold->points[0].separation <= 0 || (cairn_points_of(manifold->count) > 1 && manifold->points[1].separation <= 0);
}

/*
 * Corner before corner, neither has a face in front of it and there is no contact. So near, and with so much motion in the step (10 mm), they
 * may be one in the other when it ends.
 */
static bool passes_corner(cairn_offset margin, const cairn_manifold *manifold)
{
    return margin > 4 * CAIRN_REACH && manifold->separation < margin - 2 * CAIRN_REACH;
}

/* Would another contact be found along its way? Not one that is steady for all that is looked along. */
static bool may_slide_past(const cairn_world *world, cairn_offset ways, const cairn_manifold *manifold)
{
    return world->held_back || manifold->steady < CAIRN_LOOK_WAY || manifold->steady < 4 * ways;
}

/* The same during the search, where bodies keep their cosines and sines. */
static inline void face(cairn_body *body, cairn_offset x, cairn_offset y, cairn_pose *out)
{
    if (CAIRN_KEEPS_FACING && !(body->flags & CAIRN_BODY_FACING) && !cairn_body_is_round(body)) {
        cairn_body_face(body);
    }
    cairn_body_pose(body, x, y, out);
}

CAIRN_APART void collide_facing(cairn_body *a, cairn_body *b, cairn_offset margin, cairn_manifold *manifold)
{
    if (!CAIRN_KEEPS_FACING) {
        cairn_bodies_collide(a, b, margin, manifold);
        return;
    }
    cairn_pose pa, pb;
    face(a, 0, 0, &pa);
    face(b, cairn_bodies_apart_x(a, b), cairn_bodies_apart_y(a, b), &pb);
    cairn_poses_collide(&pa, &pb, margin, manifold);
}

/* How far a body's surface lies from its centre of mass, at most. A box's corner: sqrt(1 + t^2) <= 1 + t / 2 for t in [0, 1]. */
static cairn_real radius_of(const cairn_body *body)
{
    cairn_vec2 size = body->model->shape->size;
    return size.y == 0 ? size.x : cairn_real_half(size.x > size.y ? size.x + cairn_real_half(size.y) : size.y + cairn_real_half(size.x));
}

/* What is round does not come as near as that in the narrow phase either: there it only saves time. */
#define MAY_BE_BEYOND (CAIRN_WITH_SOFT_SOLVER && (CAIRN_WITH_SHORTCUTS || CAIRN_MAX_POINTS > 1))

/* Boxes meet at their corners, where most bodies have none: those are farther apart than the discs around them. */
CAIRN_APART bool are_beyond(const cairn_body *a, const cairn_body *b)
{
    cairn_real margin = cairn_real_above_offset(2 * CAIRN_REACH) + cairn_body_way(a) + cairn_body_way(b);
    return cairn_real_is_longer(a->x - b->x, a->y - b->y, radius_of(a) + radius_of(b) + margin);
}

/*
 * What the two will do in this step. What is held back may be taken along by something faster, beyond the way that the search allows for: such
 * a contact would be found or not by whether the arbiter is the one expected here, and the order of pairs may not tell.
 */
static void foresee(const cairn_world *world, const cairn_body *a, const cairn_body *b, cairn_manifold *manifold)
{
    manifold->count = 0;
    if (!world->held_back || !are_beyond(a, b)) {
        cairn_world_continuous(world)->meet(world, a, b, manifold);
    }
}

/* The contact of two bodies in this step. */
static void look(const cairn_world *world, cairn_body *a, cairn_body *b, cairn_manifold *manifold)
{
    if (CAIRN_WITH_CONTINUOUS && ((a->flags | b->flags) & CAIRN_BODY_FAST)) {
        cairn_body_face(a);
        cairn_body_face(b);
        foresee(world, a, b, manifold);
        return;
    }
    cairn_offset ways = cairn_offset_from_real(cairn_body_way(a) + cairn_body_way(b)), margin = 2 * CAIRN_REACH + ways;
    manifold->separation = margin; /* where the narrow phase finds them farther apart it says nothing */
    collide_facing(a, b, margin, manifold);
    if (cairn_world_continuous(world) == NULL) {
        return;
    }
    if (manifold->count != 0) {
        if (may_slide_past(world, ways, manifold)) {
            cairn_world_continuous(world)->slide(world, a, b, margin, manifold);
        }
    } else if (passes_corner(margin, manifold)) {
        foresee(world, a, b, manifold);
    }
}

/* What an arbiter is in this step, from here on; what it was in the one before is kept. */
static inline void renew(cairn_world *world, cairn_arbiter *arbiter, bool touches)
{
    unsigned flags = arbiter->flags;
    if (!CAIRN_WITH_SLEEP || !(flags & CAIRN_ARBITER_FRESH)) { /* else it was found before something woke, too */
        unsigned touched = cairn_flag_if((flags & CAIRN_ARBITER_TOUCHING) != 0, CAIRN_ARBITER_TOUCHED);
        flags = (flags & ~(unsigned)(CAIRN_ARBITER_TOUCHING | CAIRN_ARBITER_TOUCHED | CAIRN_ARBITER_SOLVED)) | touched;
        world->fresh++;
    }
    arbiter->flags = (uint8_t)(flags | CAIRN_ARBITER_FRESH | cairn_flag_if(touches, CAIRN_ARBITER_TOUCHING));
}

static bool may_look(const cairn_world *world, const cairn_body *a, const cairn_body *b)
{
    return (!MAY_BE_FAR || (cairn_real_is_within(a->x - b->x, CENTRES_APART_MAX) && cairn_real_is_within(a->y - b->y, CENTRES_APART_MAX)))
        && cairn_bodies_may_meet(world, a, b);
}

/* With two points a manifold and their rows lie deep on the stack; with one the compiler may inline meet(), which takes less flash. */
#if CAIRN_MAX_POINTS > 1
#define MEET_APART CAIRN_APART
#else
#define MEET_APART static
#endif

/* Look at a pair, whose arbiter is null if there is none yet. */
MEET_APART void meet(cairn_world *world, cairn_arbiter *arbiter, uint16_t a, uint16_t b)
{
    cairn_body *body_a = &world->bodies[a], *body_b = &world->bodies[b];
    cairn_manifold manifold;
    if (!may_look(world, body_a, body_b)) {
        return;
    }
    world->stats.looked++;
    look(world, body_a, body_b, &manifold);
    if (manifold.count == 0) {
        return;
    }
    if (arbiter == NULL) {
        arbiter = cairn_arbiter_insert(world, a, b);
        if (arbiter == NULL) {
            return;
        }
    }
    unsigned before = arbiter->path;
    cairn_arbiter_prepare(world, arbiter, &manifold);
    renew(world, arbiter, any_penetrates(&manifold));
    /* What sleeps wakes, if at all, before the next search. */
    if (!(CAIRN_WITH_SENSORS && (arbiter->flags & CAIRN_ARBITER_SENSOR)) && !(CAIRN_WITH_SLEEP && ((body_a->flags | body_b->flags) & CAIRN_BODY_ASLEEP))) {
        if (CAIRN_WITH_SHORTCUTS && cairn_world_is_soft(world) && arbiter->friction_impulse == 0
            && !((body_a->flags | body_b->flags) & CAIRN_BODY_MET) && cairn_arbiter_idle(world, arbiter, CAIRN_PATH_FRESH)) {
            cairn_arbiter_take_turn(world, before, arbiter->path);
            return;
        }
        cairn_arbiter_engage(world, arbiter, body_a, body_b);
    }
    if (CAIRN_HAS_WAYS) {
        arbiter->path = cairn_world_is_soft(world) ? cairn_arbiter_path_of(world, arbiter, CAIRN_PATH_FRESH) : CAIRN_PATH_NONE;
        cairn_arbiter_take_turn(world, before, arbiter->path);
    }
    world->slides = world->slides || cairn_arbiter_is_sliding(arbiter);
}

/* The arbiter of the pair, if it is the one that was found after the last one in the step before: it mostly is. */
static inline cairn_arbiter *expected(cairn_world *world, uint16_t a, uint16_t b)
{
    if (CAIRN_WITH_SHORTCUTS && *world->expected != CAIRN_NONE) {
        cairn_arbiter *arbiter = &world->arbiters[*world->expected];
        if (arbiter->a == a ? arbiter->b == b : arbiter->a == b && arbiter->b == a) { /* what is free again is of no body */
            world->expected = &arbiter->after;
            return arbiter;
        }
    }
    return NULL;
}

/*
 * Rows that hold, of points that hang in the air. The discs lie no farther apart than the points: what is beyond is forgotten, as it is where
 * it is not the one expected here, for the order of pairs may not tell.
 */
CAIRN_APART void keep_aloft(cairn_world *world, cairn_arbiter *arbiter, cairn_body *a, cairn_body *b)
{
    if (arbiter->rows[0].gap > CAIRN_MOTION(0.005) && are_beyond(a, b)) {
        return;
    }
    renew(world, arbiter, cairn_arbiter_has_two(arbiter) && !(arbiter->path & CAIRN_PATH_APART));
    if (!CAIRN_WITH_SHORTCUTS || arbiter->friction_impulse != 0 || (((a->flags | b->flags) & CAIRN_BODY_MET) && !cairn_arbiter_idles(arbiter))) {
        cairn_arbiter_engage(world, arbiter, a, b);
    } else {
        cairn_arbiter_engage_unless_idle(world, arbiter);
    }
}

/* Rows that hold. What touches is no idle one: see follow() in hold.c. */
static inline void keep(cairn_world *world, cairn_arbiter *arbiter, cairn_body *a, cairn_body *b)
{
    if (arbiter->rows[0].gap > 0) {
        keep_aloft(world, arbiter, a, b);
        return;
    }
    renew(world, arbiter, true);
    cairn_arbiter_engage(world, arbiter, a, b);
}

/* The body that does not move, else the one with the lower place, comes first. */
static inline bool are_in_order(const cairn_world *world, uint16_t a, uint16_t b)
{
    bool a_moves = cairn_body_is_dynamic(&world->bodies[a]), b_moves = cairn_body_is_dynamic(&world->bodies[b]);
    return a_moves ? b_moves && a < b : b_moves || a < b;
}

void cairn_arbiter_pair(cairn_world *world, uint16_t a, uint16_t b)
{
    world->stats.pairs++;
    cairn_arbiter *arbiter = expected(world, a, b);
    if (arbiter != NULL) {
        a = arbiter->a;
        b = arbiter->b;
    } else if (!are_in_order(world, a, b)) {
        uint16_t swap = a;
        a = b;
        b = swap;
    }
    cairn_body *body_a = &world->bodies[a], *body_b = &world->bodies[b];
    if (arbiter == NULL) {
        if (MAY_BE_BEYOND && cairn_world_is_soft(world) && are_beyond(body_a, body_b)) {
            return;
        }
        arbiter = CAIRN_LOOKS_FIRST ? NULL : cairn_arbiter_search(world, a, b);
    }
    if (arbiter != NULL && cairn_arbiter_holds(arbiter, body_a, body_b)) {
        keep(world, arbiter, body_a, body_b);
    } else {
        meet(world, arbiter, a, b);
    }
}
