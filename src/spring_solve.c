/*
 * Springs in the step, solved once in every sub-step after the velocities are integrated; sub-step units throughout. A
 * spring alone follows its exact map (here), networks are solved by paths (spring_path.c).
 *
 * The impulses are kept out of the warm start (they go into u as well as v): an unconverged network must not be repeated.
 */
#include "spring_solve.h"
#include <cairn/spring_mesh.h>

/* ---- the step ---- */

/* Which bodies carry a spring, more than one, one that takes away contact. */
static void count_ends(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    for (uint16_t i = 0; i < world->body_end; i++) {
        world->bodies[i].flags &= (uint16_t)~(CAIRN_BODY_SPRING | CAIRN_BODY_SPRINGS | CAIRN_BODY_SPRUNG);
    }
    for (uint16_t i = 0; i < pool->end; i++) {
        const cairn_spring *spring = &pool->springs[i];
        if (!cairn_spring_is_used(spring)) {
            continue;
        }
        cairn_body *ends[2] = { &world->bodies[spring->a], &world->bodies[spring->b] };
        for (int k = 0; k < 2; k++) {
            unsigned more = ends[k]->flags & CAIRN_BODY_SPRING ? CAIRN_BODY_SPRINGS : CAIRN_BODY_SPRING;
            unsigned sprung = cairn_flag_if((spring->flags & CAIRN_SPRING_NO_CONTACT) != 0, CAIRN_BODY_SPRUNG);
            ends[k]->flags = (uint16_t)(ends[k]->flags | more | sprung);
        }
    }
}

/* Is a spring the first of a path that is solved by itself? */
static bool leads(const cairn_spring_pool *pool, const cairn_spring *spring)
{
    return (spring->flags & CAIRN_SPRING_HEAD) && !(pool->springs[spring->network].flags & CAIRN_SPRING_MESHED);
}

/* Whether a spring goes from centre to centre of bodies that may shift, or are at rest. */
static bool is_plain(const cairn_world *world, const cairn_spring *spring)
{
    unsigned flags = world->bodies[spring->a].flags | world->bodies[spring->b].flags;
    return !(flags & CAIRN_BODY_FIXED_POSITION) && !cairn_spring_is_off_centre(spring) && !cairn_spring_is_pin(spring);
}

/* From centre to centre, a spring of no rest length alone has the exact map: what is not along it needs no pull. */
static void find_pins(const cairn_world *world)
{
    const cairn_spring_pool *pool = world->springs;
    for (cairn_spring *spring = pool->springs; spring != pool->springs + pool->end; spring++) {
        bool pin = cairn_spring_is_used(spring) && spring->rest_length == 0
                && (cairn_spring_is_off_centre(spring) || !cairn_spring_is_alone(&world->bodies[spring->a], &world->bodies[spring->b]));
        spring->flags = (uint16_t)((spring->flags & ~(unsigned)CAIRN_SPRING_PIN) | cairn_flag_if(pin, CAIRN_SPRING_PIN));
    }
}

/* When springs have changed: which belong together, and what a sub-step makes of each. */
static void sort(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    const cairn_spring *last = NULL;
    count_ends(world);
    if (CAIRN_WITH_PINS) {
        find_pins(world);
    }
    cairn_spring_find_ends(pool);
    cairn_spring_paths(world);
    cairn_spring_networks(world);
    for (uint16_t i = 0; i < pool->end; i++) {
        cairn_spring *spring = &pool->springs[i];
        if (cairn_spring_is_used(spring)) {
            spring->flags = (uint16_t)((spring->flags & ~(unsigned)CAIRN_SPRING_PLAIN) | cairn_flag_if(is_plain(world, spring), CAIRN_SPRING_PLAIN));
            if (!CAIRN_WITH_QUICK_WAYS || last == NULL || !cairn_spring_map_as(world, spring, last)) {
                cairn_spring_map(world, spring);
            }
            last = spring;
        }
    }
}

/* What of a path's springs and equations depends on where they are. */
static void prepare_path(cairn_world *world, cairn_spring *first, bool changed)
{
    if (cairn_spring_is_pin(first)) {
        return; /* in each sub-step anew */
    }
    if (CAIRN_WITH_QUICK_SPRINGS && changed) {
        cairn_path_look(world, first);
    }
    bool quick = CAIRN_WITH_QUICK_SPRINGS && cairn_path_follow(world, first);
    if (!quick && (changed || first->flags & CAIRN_SPRING_LEVERS)) {
        for (cairn_spring *spring = first; spring != NULL; spring = cairn_spring_behind(world->springs, spring)) {
            if (!changed && cairn_spring_is_off_centre(spring)) {
                cairn_spring_map(world, spring);
            }
        }
        cairn_path_factorise(world, first);
    }
}

void cairn_springs_prepare(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    bool changed = pool->changed;
    pool->changed = false;
    if (changed) {
        sort(world);
    }
    if (changed || (world->stats.steps & 7u) == 0) {
        bool more = cairn_spring_entangle(world);
        if (pool->mesh != NULL && (changed || more)) {
            pool->mesh->kind->make(world);
        }
    }
    for (uint16_t i = pool->first; i != CAIRN_NONE; i = pool->springs[i].previous) {
        cairn_spring *spring = &pool->springs[i];
        if (leads(pool, spring) && (changed || cairn_spring_is_active(world, spring))) {
            prepare_path(world, spring, changed);
        }
    }
}

/* ---- the sub-step ---- */

CAIRN_ONCE cairn_motion along(const cairn_reach *r, cairn_motion x, cairn_motion y)
{
    return cairn_motion_add(cairn_motion_unit(x, r->x), cairn_motion_unit(y, r->y));
}

/* The relative acceleration by gravity alone, along the spring. */
static cairn_motion gravity_along(const cairn_world *world, const cairn_spring *spring, const cairn_reach *r)
{
    const cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
    cairn_motion g = along(r, world->gravity_x.whole, world->gravity_y.whole);
    cairn_motion of_a = spring->share_a == 0 ? 0 : cairn_motion_factor(g, cairn_factor_from_real(a->model->gravity_scale));
    cairn_motion of_b = spring->share_b == 0 ? 0 : cairn_motion_factor(g, cairn_factor_from_real(b->model->gravity_scale));
    return cairn_motion_add(of_b, -of_a);
}

CAIRN_ONCE void push(cairn_body *body, const cairn_reach *r, cairn_motion impulse, cairn_lever lever)
{
    cairn_spring_push(body, cairn_motion_unit(impulse, r->x), cairn_motion_unit(impulse, r->y), cairn_twist(impulse, lever));
}

/* An isolated spring by the exact map, with all the bits of its direction. */
CAIRN_ONCE void solve_exactly(cairn_world *world, cairn_spring *spring)
{
    cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
    cairn_reach r;
    cairn_spring_measure(spring, a, b, &r);
    cairn_spring_point(spring, a, b, &r);
    cairn_motion gravity = gravity_along(world, spring, &r);
    cairn_motion turning = cairn_motion_lever(b->w, spring->lever_b) - cairn_motion_lever(a->w, spring->lever_a);
    cairn_motion u = cairn_motion_add(along(&r, b->vx - a->vx, b->vy - a->vy), turning);
    cairn_motion demand = cairn_motion_add(cairn_motion_share(u, spring->velocity_gain),
                                           cairn_motion_from_offset_wide(r.length - spring->rest_length, spring->position_gain));
    cairn_motion impulse = cairn_motion_add(-demand, cairn_motion_share(gravity, spring->yield));
    if (spring->flags & CAIRN_SPRING_FRESH) {
        /* Velocities are those of the middle of a sub-step from now on: half a kick leads there. */
        impulse = cairn_motion_half(cairn_motion_add(impulse, -gravity));
        spring->flags &= (uint16_t)~CAIRN_SPRING_FRESH;
    }
    impulse = cairn_motion_factor(impulse, cairn_spring_mass(world, spring));
    cairn_motion of_a = -cairn_motion_share(impulse, spring->share_a), of_b = cairn_motion_share(impulse, spring->share_b);
    push(a, &r, of_a, spring->lever_a);
    push(b, &r, of_b, spring->lever_b);
}

static void solve_path(cairn_world *world, cairn_spring *first, bool again)
{
    if (CAIRN_WITH_QUICK_SPRINGS && (first->flags & CAIRN_SPRING_FRAMED)) {
        cairn_path_solve_quickly(world, first, again);
    } else {
        cairn_path_solve(world, first, again);
    }
}

/*
 * Path after path; entangled networks and those with pins a second time, in the opposite order. In one order only, what a sweep leaves undone
 * may turn the error as well as shrink it, and feeds oscillations (a wheel of 1e5 N/m flies apart). There and back,
 * the sweep is symmetric: in the stiff limit v' = T (v + x) - x, x' = x + v' with T's eigenvalues t real, in [0, 1], so
 * that each mode changes by a factor of modulus sqrt(t): bounded for any stiffness and shape.
 */
void cairn_springs_substep(cairn_world *world, int substep)
{
    cairn_spring_pool *pool = world->springs;
    if (pool->mesh != NULL) {
        pool->mesh->kind->solve(world, substep);
    }
    for (uint16_t i = pool->first; i != CAIRN_NONE; i = pool->springs[i].previous) {
        cairn_spring *spring = &pool->springs[i];
        if (!leads(pool, spring) || !cairn_spring_is_active(world, spring)) {
            continue;
        }
        if (spring->flags & CAIRN_SPRING_EXACT) {
            solve_exactly(world, spring);
        } else {
            solve_path(world, spring, false);
        }
    }
    for (uint16_t i = pool->end; pool->entangled && i > 0; i--) {
        cairn_spring *spring = &pool->springs[i - 1];
        if (leads(pool, spring) && (pool->springs[spring->network].flags & (CAIRN_SPRING_ENTANGLED | CAIRN_SPRING_PINNED)) && cairn_spring_is_active(world, spring)) {
            solve_path(world, spring, true);
        }
    }
}
