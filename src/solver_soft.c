/*
 * The sub-stepped soft solver (TGS-soft) in the contact frame. Per step: warm start once; then n times: integrate
 * velocities, a biased pass without friction, move, a relax pass with friction.
 *
 * Units (see DESIGN.md): with h the sub-step, velocities are v h, spins rho w h, impulses lambda h (1/mA + 1/mB), all
 * in metres, so that neither h nor a mass occurs in the passes. During the biased pass bodies hold v + beta d, d being
 * the displacement in this step: that makes the push-out follow the separation without computing it again. Between
 * sub-steps the warm start repeats each body's last velocity change: v' = v + (v - u).
 */
#include "sweep.h"
#include <cairn/block.h>
#include <cairn/spring.h>

/* Only contacts ask how far it has moved: what hangs on springs alone need not lean. */
static inline bool may_lean(const cairn_body *body) { return (!CAIRN_WITH_SPRINGS && !CAIRN_WITH_SHORTCUTS) || (body->flags & CAIRN_BODY_MET) != 0; }

static inline void lean(cairn_body *body)
{
    body->vx += cairn_soft_lean(body->dx);
    body->vy += cairn_soft_lean(body->dy);
    if (CAIRN_WITH_TURNING) {
        body->w += cairn_soft_lean(body->dw);
    }
}

/* Enter the biased pass: v + beta d. */
static void lean_all(cairn_world *world)
{
    const cairn_body *end = world->bodies + world->body_end;
    for (cairn_body *body = world->bodies; body != end; body++) {
        if ((body->flags & (CAIRN_BODY_GOES | CAIRN_BODY_MET)) == (CAIRN_BODY_GOES | CAIRN_BODY_MET)) {
            lean(body);
        }
    }
}

static inline void put(cairn_body *body, cairn_motion vx, cairn_motion vy, cairn_motion w)
{
    body->vx = vx;
    body->vy = vy;
    if (CAIRN_WITH_TURNING) {
        body->w = w;
    }
}

/* A further sub-step's velocities, with this change of gravity: the last change once more. Where no spring is to come first, bodies lean at once. */
CAIRN_APART void repeat_all(cairn_world *world, cairn_motion gx, cairn_motion gy)
{
    const cairn_body *end = world->bodies + world->body_end;
    bool leans = cairn_world_springs(world) == NULL;
    unsigned falls_anew = gx != 0 || gy != 0 ? CAIRN_BODY_PLAIN : 0; /* by a last bit now and then */
    for (cairn_body *body = world->bodies; body != end;) {
        unsigned flags = body->flags;
        if (!cairn_body_goes(body)) {
            body = cairn_body_skip(world, body);
            continue;
        }
        cairn_motion ux = body->ux, uy = body->uy, vx = body->vx, vy = body->vy, w = cairn_body_spin(body);
        if (flags & falls_anew) {
            ux -= gx;
            uy -= gy;
        }
        body->ux = vx;
        body->uy = vy;
        vx = 2 * vx - ux;
        vy = 2 * vy - uy;
        if (CAIRN_WITH_TURNING) {
            cairn_motion uw = body->uw;
            body->uw = w;
            w = 2 * w - uw;
        }
        if (leans) { /* three times the limit at most, which the sweeps have room for, and cut again when it moves */
            vx += cairn_soft_lean(body->dx);
            vy += cairn_soft_lean(body->dy);
            w += cairn_soft_lean(cairn_body_turned(body));
        }
        put(body, vx, vy, w);
        if (!leans && !cairn_motions_are_within(vx, vy, w, CAIRN_SURELY_SLOW)) {
            cairn_body_limit_speed(world, body);
        }
        body++;
    }
}

/* Leave the biased pass, and move by the sub-step. */
CAIRN_APART void advance(cairn_world *world)
{
    const cairn_body *end = world->bodies + world->body_end;
    for (cairn_body *body = world->bodies; body != end;) {
        if (!cairn_body_goes(body)) {
            body = cairn_body_skip(world, body);
            continue;
        }
        cairn_motion vx = body->vx, vy = body->vy, w = cairn_body_spin(body);
        if (may_lean(body)) {
            vx -= cairn_soft_lean(body->dx);
            vy -= cairn_soft_lean(body->dy);
            w -= cairn_soft_lean(cairn_body_turned(body));
            put(body, vx, vy, w);
        }
        if (!CAIRN_WITH_SHORTCUTS || !cairn_motions_are_within(vx, vy, w, CAIRN_SURELY_SLOW)) {
            cairn_body_limit_speed(world, body);
            vx = body->vx;
            vy = body->vy;
            w = cairn_body_spin(body);
        }
        body->dx += vx;
        body->dy += vy;
        if (CAIRN_WITH_TURNING) {
            body->dw += w;
        }
        body++;
    }
}

/* What gravity alone does to a velocity and a displacement in all sub-steps. */
typedef struct fall {
    cairn_motion vx, vy, dx, dy;
    bool is_slow; /* changes a velocity by less than the limit of speed: n times either fits in the format */
} fall;

static fall fall_of(const cairn_world *world)
{
    cairn_diffused gx = world->gravity_x, gy = world->gravity_y;
    cairn_motion limit = cairn_world_most_speed(world);
    fall f;
    f.vx = f.vy = f.dx = f.dy = 0;
    f.is_slow = CAIRN_COASTS && cairn_motion_is_within(gx.whole, limit) && cairn_motion_is_within(gy.whole, limit)
             && cairn_motion_is_within(gx.whole * cairn_world_substeps(world), limit) && cairn_motion_is_within(gy.whole * cairn_world_substeps(world), limit);
    for (int k = 0; f.is_slow && k < cairn_world_substeps(world); k++) {
        f.vx += cairn_diffuse(&gx);
        f.vy += cairn_diffuse(&gy);
        f.dx += f.vx;
        f.dy += f.vy;
    }
    if (f.is_slow) { /* the parabola exactly, as motion.c straightens it */
        f.dx -= cairn_motion_half(world->gravity_x.whole * cairn_world_substeps(world));
        f.dy -= cairn_motion_half(world->gravity_y.whole * cairn_world_substeps(world));
    }
    return f;
}

/* All sub-steps at once, where nothing but gravity acts: the same sums. False if something else does. */
static bool coast(const cairn_world *world, cairn_body *body, const fall *f)
{
    cairn_motion vx = body->vx + f->vx, vy = body->vy + f->vy;
    if (!CAIRN_COASTS || !f->is_slow || !(body->flags & CAIRN_BODY_PLAIN) || body->ux != 0 || body->uy != 0 || body->uw != 0
        || !cairn_motion_is_within(vx, cairn_world_most_speed(world)) || !cairn_motion_is_within(vy, cairn_world_most_speed(world))) {
        return false;
    }
    body->dx = body->vx * cairn_world_substeps(world) + f->dx;
    body->dy = body->vy * cairn_world_substeps(world) + f->dy;
    body->dw = body->w * cairn_world_substeps(world);
    body->vx = vx;
    body->vy = vy;
    return true;
}

/* Does the body take part in the sub-steps? If not it has coasted, or does not move at all. */
static bool goes(const cairn_world *world, cairn_body *body, const fall *f)
{
    if (!cairn_body_is_active(body)) {
        return false;
    }
    if (!CAIRN_ASKS_WHO_MET || (body->flags & (CAIRN_BODY_MET | CAIRN_BODY_SPRING))) {
        return true;
    }
    if (coast(world, body, f)) {
        return false;
    }
    body->flags |= CAIRN_BODY_MET;
    return true;
}

/* The first sub-step's velocities. Of bodies that do not take part one after the other, the first tells where the next is that does. */
CAIRN_APART void start(cairn_world *world, const fall *f, cairn_motion gx, cairn_motion gy)
{
    const cairn_body *end = world->bodies + world->body_end;
    cairn_body *idle = NULL;
    unsigned moved = 0;
    bool coasts = CAIRN_WITH_SHORTCUTS && cairn_world_fast(world) == 0 && cairn_world_bounce(world) == NULL; /* else continuous.c may have to look at all ways */
    if (CAIRN_WITH_SHORTCUTS) {
        world->coasted = coasts;
    }
    for (cairn_body *body = world->bodies; body != end; body++) {
        if (goes(world, body, f)) {
            if (CAIRN_WITH_SHORTCUTS && idle != NULL) {
                idle->ux = (cairn_motion)(body - world->bodies);
                idle = NULL;
            }
            if (CAIRN_ASKS_WHO_MET) {
                body->flags |= CAIRN_BODY_GOES;
            }
            cairn_body_start(world, body, gx, gy);
            moved++;
            continue;
        }
        if (coasts && cairn_body_is_active(body)) {
            cairn_body_move(world, body);
        }
        if (CAIRN_WITH_SHORTCUTS && idle == NULL && !(body->flags & (CAIRN_BODY_MET | CAIRN_BODY_SPRING))) {
            idle = body;
        }
    }
    if (idle != NULL) {
        idle->ux = (cairn_motion)world->body_end;
    }
    world->stats.moved = (uint16_t)moved;
}

static void solve(cairn_world *world)
{
    cairn_motion last_gx = 0, last_gy = 0;
    const fall f = fall_of(world);
    if (cairn_world_springs(world) != NULL) {
        cairn_world_springs(world)->kind->prepare(world);
    }
    if (world->uneven && cairn_world_block(world) != NULL) {
        cairn_world_block(world)->kind->find(world);
        cairn_sweep_choose_again(world);
    }
    for (int k = 0; k < cairn_world_substeps(world); k++) {
        if (cairn_world_bounce(world) != NULL) {
            cairn_world_bounce(world)->impact(world, k);
        }
        if (k == 0 || cairn_world_bounce(world) != NULL) {
            cairn_sweep_arrange(world);
        }
        cairn_motion gx = cairn_diffuse(&world->gravity_x), gy = cairn_diffuse(&world->gravity_y);
        if (k == 0) {
            start(world, &f, gx, gy);
            cairn_sweep_warm_start(world);
            if (cairn_world_blocks(world) != 0) {
                cairn_world_block(world)->kind->warm_start(world);
            }
        } else {
            if (cairn_world_fast(world) != 0) {
                cairn_world_continuous(world)->land(world);
            }
            repeat_all(world, gx - last_gx, gy - last_gy);
            if (cairn_world_slides(world)) {
                cairn_sweep_push_sliding(world);
            }
        }
        last_gx = gx;
        last_gy = gy;
        if (cairn_world_springs(world) != NULL) {
            cairn_world_springs(world)->kind->substep(world, k);
        }
        if (k == 0 ? cairn_world_bounce(world) != NULL : cairn_world_springs(world) != NULL) { /* without impacts nothing has moved yet */
            lean_all(world);
        }
        cairn_sweep_biased(world, k);
        if (cairn_world_blocks(world) != 0) {
            cairn_world_block(world)->kind->biased_pass(world);
        }
        advance(world);
        if (cairn_world_slides(world)) {
            cairn_sweep_slide(world);
        }
        cairn_sweep_relax(world, k);
        if (cairn_world_blocks(world) != 0) {
            cairn_world_block(world)->kind->relax_pass(world);
        }
    }
}

const cairn_solver_class cairn_solver_soft = { solve, CAIRN_SOLVER_SOFT };
