/*
 * From a manifold to the rows of the constraint system, in the contact frame: n the normal, t = (-n.y, n.x). A point
 * at (height along n, arm along t) from a centre has r x n = -arm and r x t = height, so no anchor is stored.
 */
#include "engine.h"

static cairn_motion magnitude(cairn_motion x) { return x < 0 ? -x : x; }

/* Whether bodies at their limits of speed leave the sweeps' sums room for a mass above 1; one of them is a pivot. */
static bool has_room(cairn_ratio mass, cairn_lever ja, cairn_lever jb)
{
    cairn_motion u = CAIRN_MOTION(1.32) + magnitude(cairn_motion_lever(CAIRN_SWEEP_SPIN, ja)) + magnitude(cairn_motion_lever(CAIRN_SWEEP_SPIN, jb));
    return cairn_motion_ratio(cairn_motion_half(u), mass) <= CAIRN_MOTION(2.75);
}

/* 1 / (J M^-1 J^T) of a row, times (1/mA + 1/mB). Where there is no room for all of it, it takes more passes. */
static cairn_ratio effective_mass(const cairn_arbiter *arbiter, cairn_factor linear, cairn_lever ja, cairn_lever jb)
{
    if (ja == 0 && jb == 0 && linear == CAIRN_FACTOR(1)) {
        return CAIRN_RATIO(1); /* circles */
    }
    cairn_ratio mass = cairn_factor_inverse(linear + cairn_factor_spin(arbiter->share_a, ja, ja) + cairn_factor_spin(cairn_arbiter_share_b(arbiter), jb, jb));
    return !CAIRN_WITH_FIXED_POSITION || mass <= CAIRN_RATIO(1) || has_room(mass, ja, jb) ? mass : CAIRN_RATIO(1);
}

cairn_lever cairn_body_lever(const cairn_body *body, cairn_offset arm)
{
    bool turns = cairn_body_can_turn(body);
    return turns ? cairn_lever_of(arm, cairn_body_inverse_gyration(body)) : 0;
}

/* The separation as the solver uses it: where positive itself, else the push-out per sub-step. */
static cairn_motion gap_of(const cairn_world *world, cairn_offset separation)
{
    if (separation > 0) {
        return cairn_motion_clamp(cairn_motion_from_offset(separation), CAIRN_MOTION(7)); /* hold.c may add a little */
    }
    cairn_offset beyond = separation + cairn_offset_from_real(world->slop);
    if (beyond >= 0) {
        return 0;
    }
    cairn_motion push = cairn_motion_ratio(cairn_motion_from_offset(beyond), cairn_world_is_soft(world) ? CAIRN_SOFT_BETA : CAIRN_RATIO(0.2)); /* Baumgarte's */
    cairn_motion most = -cairn_world_push_out_limit(world);
    return push < most ? most : push;
}

/* The impulses of a point that persists stay with it; false if it does not. */
static bool keep_impulse(cairn_arbiter *arbiter, const cairn_manifold *manifold)
{
    cairn_row *row = &arbiter->rows[0];
    bool kept = arbiter->count != 0 && row->feature == manifold->points[0].feature && !cairn_row_came_flying(row);
    row->feature = manifold->points[0].feature;
    if (!kept) {
        row->impulse = 0;
        if (CAIRN_WITH_HOLD) {
            row->load = 0;
        }
    }
    return kept;
}

/* The same where there may be two. */
static bool keep_impulses_of_two(cairn_arbiter *arbiter, const cairn_manifold *manifold)
{
    cairn_row old[2] = { arbiter->rows[0], arbiter->rows[CAIRN_LAST_ROW] };
    int old_count = arbiter->count;
    bool kept = false;
    for (int i = 0; i < cairn_points_of(manifold->count); i++) {
        cairn_row *row = &arbiter->rows[i];
        row->feature = manifold->points[i].feature;
        row->impulse = 0;
        if (CAIRN_WITH_HOLD) {
            row->load = 0;
        }
        for (int j = 0; j < old_count; j++) {
            if (old[j].feature == row->feature && !cairn_row_came_flying(&old[j])) {
                row->impulse = old[j].impulse;
                if (CAIRN_WITH_HOLD) {
                    row->load = old[j].load;
                }
                kept = true;
            }
        }
    }
    return kept;
}

/* Hand the impulses of points that persist to their new rows. */
static void keep_impulses(cairn_arbiter *arbiter, const cairn_manifold *manifold)
{
    int old_count = arbiter->count;
    bool kept = CAIRN_MAX_POINTS == 1 ? keep_impulse(arbiter, manifold) : keep_impulses_of_two(arbiter, manifold);
    if (CAIRN_WITH_FRICTION && !kept) {
        arbiter->friction_impulse = 0;
    }
    if (CAIRN_WITH_HOLD && (!kept || old_count < 2 || arbiter->slip > CAIRN_LET_GO)) {
        arbiter->slip = 0; /* of one point it means something else, and in the air */
    }
    arbiter->count = (uint8_t)manifold->count;
}

void cairn_arbiter_mark_careful(cairn_arbiter *arbiter, const cairn_body *a, const cairn_body *b)
{
    if (!CAIRN_HAS_WAYS) {
        return;
    }
    bool careful = cairn_bodies_are_fixed(a, b) || !cairn_lever_is_short(arbiter->friction_lever_a)
                || !cairn_lever_is_short(arbiter->friction_lever_b);
    for (int i = 0; i < cairn_points_of(arbiter->count); i++) {
        careful = careful || !cairn_lever_is_short(arbiter->rows[i].lever_a) || !cairn_lever_is_short(arbiter->rows[i].lever_b);
    }
    arbiter->flags = (uint8_t)((arbiter->flags & ~(unsigned)CAIRN_ARBITER_CAREFUL) | cairn_flag_if(careful, CAIRN_ARBITER_CAREFUL));
}

/* How much nearer the points of a row come until the time of a meeting: the separation now is so much larger. */
static cairn_offset way_until(const cairn_world *world, const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter,
                              const cairn_row *row, cairn_unit time)
{
    if (!CAIRN_WITH_CONTINUOUS || time == 0) {
        return 0;
    }
    cairn_motion u = cairn_motion_along(b->vx - a->vx, b->vy - a->vy, arbiter->normal_x, arbiter->normal_y)
                   + cairn_motion_lever(b->w, row->lever_b) - cairn_motion_lever(a->w, row->lever_a);
    return u < 0 ? cairn_offset_mul(cairn_offset_from_motion(-u) * cairn_world_substeps(world), time) : 0;
}

/* A way at this speed from the step's start until then. */
static cairn_offset until(cairn_motion v, const cairn_world *world, cairn_unit time)
{
    return cairn_offset_mul(cairn_offset_from_motion(v) * cairn_world_substeps(world), time);
}

/*
 * What slides or rolls over something static goes by its normal and its lever all the way, and half a last bit of them is 3e-5 of gravity's pull
 * and of a roll: a disc was 0.5 mm off after two seconds on a slope. Rounded in turn they are right in the mean. What rests, flies or bounces
 * gets the nearest.
 */
static bool passes_over(const cairn_world *world, const cairn_arbiter *arbiter, const cairn_body *b, const cairn_manifold *manifold)
{
    return cairn_world_is_soft(world) && CAIRN_WITH_SLOPES && arbiter->block == 0
        && (arbiter->flags & (CAIRN_ARBITER_ON_STATIC | CAIRN_ARBITER_BOUNCY)) == CAIRN_ARBITER_ON_STATIC
        && (!CAIRN_WITH_CONTINUOUS || manifold->time == 0)
        && cairn_body_is_under_way(world, b);
}

void cairn_arbiter_prepare(cairn_world *world, cairn_arbiter *arbiter, const cairn_manifold *manifold)
{
    const cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    cairn_unit nx = manifold->normal_x, ny = manifold->normal_y;
    cairn_offset b_height = !CAIRN_HAS_PLACES ? 0 : cairn_offset_dot(manifold->x, manifold->y, nx, ny);
    cairn_offset b_arm = !CAIRN_HAS_PLACES ? 0 : cairn_offset_dot(manifold->x, manifold->y, -ny, nx);
    cairn_factor linear = cairn_factor_from_share((cairn_body_is_fixed(a) ? 0 : arbiter->share_a)
                                                  + (cairn_body_is_fixed(b) ? 0 : cairn_arbiter_share_b(arbiter)));

    keep_impulses(arbiter, manifold);
    bool passes = passes_over(world, arbiter, b, manifold);
    arbiter->normal_x = passes ? cairn_dir_in_turn(nx, world->stats.steps) : cairn_dir_from_unit(nx);
    arbiter->normal_y = passes ? cairn_dir_in_turn(ny, world->stats.steps) : cairn_dir_from_unit(ny);
    cairn_offset height = 0, apart = 0;
    for (int i = 0; i < cairn_points_of(manifold->count); i++) {
        const cairn_manifold_point *point = &manifold->points[i];
        cairn_row *row = &arbiter->rows[i];
        cairn_offset arm = CAIRN_HAS_PLACES ? cairn_offset_dot(point->x, point->y, -ny, nx) : 0; /* of nothing that turns */
        cairn_offset here = CAIRN_HAS_PLACES ? cairn_offset_dot(point->x, point->y, nx, ny) : 0;
        height = i == 0 ? here : height + cairn_offset_half(here - height);
        apart = i == 0 || point->separation < apart ? point->separation : apart;
        if (CAIRN_WITH_TURNING) {
            row->lever_a = cairn_body_lever(a, -arm);
            row->lever_b = cairn_body_lever(b, b_arm - arm);
        }
        row->gap = gap_of(world, point->separation + way_until(world, a, b, arbiter, row, manifold->time));
        if (CAIRN_WITH_TURNING || CAIRN_WITH_FIXED_POSITION || CAIRN_HAS_WAYS) { /* else nobody asks: it is 1 */
            row->mass = effective_mass(arbiter, linear, row->lever_a, row->lever_b);
        }
    }
    /* Friction acts where the surfaces meet: each body's own, as long as they are apart. */
    cairn_offset to_surface = apart > 0 ? cairn_offset_half(apart) : 0;
    if (CAIRN_WITH_TURNING || CAIRN_WITH_SLOPES) {
        arbiter->friction_lever_a = cairn_body_lever(a, height - to_surface);
        arbiter->friction_lever_b = cairn_body_lever(b, height + to_surface - b_height);
    }
    if (passes && cairn_body_is_round(b) && !cairn_motion_is_within(b->w, 4 * cairn_world_rest_limit(world))) {
        arbiter->friction_lever_b = cairn_lever_in_turn(height + to_surface - b_height, cairn_body_inverse_gyration(b), world->stats.steps);
    }
    if (CAIRN_WITH_FRICTION) {
        arbiter->friction_mass = effective_mass(arbiter, linear, arbiter->friction_lever_a, arbiter->friction_lever_b);
    }
    if (CAIRN_HAS_WAYS) {
        arbiter->path &= CAIRN_PATH_FRESH;
    }
    if (cairn_world_is_soft(world) && cairn_arbiter_slips_past(a, b, arbiter)) {
        arbiter->path |= CAIRN_PATH_SLIDING;
        if (CAIRN_WITH_CONTINUOUS && manifold->time != 0) {
            cairn_arbiter_slide(a, b, arbiter, -until(b->vx - a->vx, world, manifold->time), -until(b->vy - a->vy, world, manifold->time));
        }
    }
    cairn_arbiter_mark_careful(arbiter, a, b);
    if (cairn_world_is_soft(world) && CAIRN_WITH_SLOPES && (arbiter->flags & CAIRN_ARBITER_ON_STATIC)) {
        arbiter->friction_lever_a = cairn_dir_lean(nx, ny, arbiter->normal_x, arbiter->normal_y);
    }
    if (cairn_world_is_soft(world)) {
        cairn_arbiter_take_hold(world, arbiter);
    }
}
