/*
 * Restitution: an impact phase at the start of each sub-step. A contact that will close in this sub-step is solved as
 * the impact that it is: at its own time t and place, with its own speed, by Newton's law u+ = -e u-. Doing it in the
 * sweeps instead stops the body early and rebounds with the speed of the step's start, which loses energy at every bounce.
 */
#include "bounce.h"

#define PASSES 16
/* At most half of CAIRN_IMPACT_TURNING. */
#define CALM CAIRN_MOTION(0.0004)

/* What the pairs of one sub-step share. */
typedef struct phase {
    int substep;
    cairn_motion gravity;  /* what it adds to a speed in a step, at most */
    cairn_motion calm;     /* slower bodies have no impact */
    cairn_real threshold;  /* the last one that was asked for, and what it is here: */
    cairn_motion rest;
} phase;

static cairn_motion size_of(cairn_motion x) { return x < 0 ? -x : x; }

/*
 * A calm pair has no part of a velocity, and no spin, above a ninth of what gravity adds in a sub-step: what closes by less than all of that rests, and
 * |u| is at most 2 sqrt(2) times the greatest part of either velocity and of either spin, 8.5 of them in all.
 */
static phase phase_of(const cairn_world *world, int substep)
{
    phase p;
    p.substep = substep;
    cairn_motion gravity = cairn_motion_add(size_of(world->gravity_x.whole), size_of(world->gravity_y.whole));
    p.calm = cairn_motion_ratio(gravity, CAIRN_RATIO(1.0 / 9));
    p.gravity = p.rest = cairn_motion_clamp(gravity, CAIRN_MOTION(0.35)) * cairn_world_substeps(world); /* below 6 m */
    p.calm = p.calm < CALM ? p.calm : CALM;
    p.threshold = 0;
    return p;
}

/* What closes slower does not rebound: the threshold, or what gravity gives in a step: piles whose every touch is an impact never settle, and sink. */
static cairn_motion rest_at(const cairn_world *world, phase *p, cairn_real threshold)
{
    if (!CAIRN_WITH_QUICK_WAYS || threshold != p->threshold) { /* few games have more than one */
        cairn_motion rest = cairn_motion_from_real(threshold, cairn_world_substep(world));
        p->threshold = threshold;
        p->rest = rest > p->gravity ? rest : p->gravity;
    }
    return p->rest;
}

CAIRN_ONCE void mix(cairn_impact *i, const cairn_world *world, phase *p)
{
    const cairn_material *a = i->body[0]->model->material, *b = i->body[1]->model->material;
    cairn_real threshold = a->bounce == NULL ? b->threshold : b->bounce == NULL || a->threshold < b->threshold ? a->threshold : b->threshold;
    i->restitution = a->restitution > b->restitution ? a->restitution : b->restitution;
    i->rest = rest_at(world, p, threshold);
}

static cairn_motion pull_on(const cairn_body *body, cairn_motion gravity)
{
    gravity = CAIRN_WITH_GRAVITY_SCALE ? cairn_motion_factor(gravity, cairn_factor_from_real(body->model->gravity_scale)) : gravity;
    return cairn_motion_clamp(gravity, CAIRN_MOTION(0.35));
}

/* What gravity does to the pair. No sum of a step's can wrap: g k / 2 of at most 15 sub-steps stays below 4 m, and g k below 8. */
static void weigh(cairn_impact *i, const cairn_world *world)
{
    const cairn_body *b = i->body[1];
    i->gx = i->gy = 0;
    if (!cairn_body_is_dynamic(i->body[0]) && !cairn_body_is_fixed(b)) {
        i->gx = pull_on(b, world->gravity_x.whole);
        i->gy = pull_on(b, world->gravity_y.whole);
    }
}

static void begin(cairn_impact *i, const cairn_world *world, cairn_arbiter *arbiter, phase *p)
{
    i->arbiter = arbiter;
    i->body[0] = &world->bodies[arbiter->a];
    i->body[1] = &world->bodies[arbiter->b];
    i->adopted = i->changed = false;
    i->lean = 0;
    i->substep = p->substep;
    mix(i, world, p);
    weigh(i, world);
}

static bool is_in_flight(const cairn_arbiter *arbiter) { return ((arbiter->rows[0].feature | arbiter->rows[CAIRN_LAST_ROW].feature) & CAIRN_ROW_IN_FLIGHT) != 0; }

/* After a look at a pair: what flies, and the sweeps' way of a contact whose rows may be others now. */
static void take_note(cairn_world *world, const cairn_impact *i)
{
    cairn_arbiter *arbiter = i->arbiter;
    world->in_flight = world->in_flight || is_in_flight(arbiter);
    if (i->changed) {
        unsigned before = arbiter->path;
        arbiter->path = cairn_arbiter_path_of(world, arbiter, before & CAIRN_PATH_FRESH);
        cairn_arbiter_take_turn(world, before, arbiter->path);
        world->slides = world->slides || cairn_arbiter_is_sliding(arbiter);
    }
}

static bool may_bounce(const cairn_arbiter *arbiter)
{
    return (arbiter->flags & (CAIRN_ARBITER_SOLVED | CAIRN_ARBITER_BOUNCY)) == (CAIRN_ARBITER_SOLVED | CAIRN_ARBITER_BOUNCY);
}

CAIRN_SHARED cairn_size size_with(cairn_size size, const cairn_body *body)
{
    return cairn_size_with(cairn_size_with(cairn_size_with(size, body->vx), body->vy), body->w);
}

static bool is_calm(const cairn_world *world, const cairn_arbiter *arbiter, cairn_motion calm)
{
    const cairn_body *a = &world->bodies[arbiter->a], *b = &world->bodies[arbiter->b];
    return cairn_size_is_below(size_with(size_with(0, a), b), calm) && !is_in_flight(arbiter);
}

/* The same for all pairs at once, as in a pile at rest. */
CAIRN_APART bool is_all_calm(const cairn_world *world, cairn_motion calm)
{
    const cairn_body *end = world->bodies + world->body_end;
    cairn_size size = 0;
    for (const cairn_body *body = world->bodies; body != end; body++) {
        size = cairn_body_is_active(body) ? size_with(size, body) : size;
    }
    return !world->in_flight && cairn_size_is_below(size, calm);
}

/* Does one of the two hit another body before that? Then this impact may never be: a ball on the joint of two tiles. */
CAIRN_APART bool is_forestalled(cairn_world *world, const cairn_impact *i, phase *p)
{
    const uint16_t a = i->arbiter->a, b = i->arbiter->b;
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        bool shared = arbiter->b == b || arbiter->b == a || arbiter->a == b || (arbiter->a == a && cairn_body_is_dynamic(i->body[0]));
        if (arbiter != i->arbiter && shared && may_bounce(arbiter)) {
            cairn_impact other;
            begin(&other, world, arbiter, p);
            bool hits = cairn_impact_foresee(&other);
            take_note(world, &other);
            if (hits && other.time < i->time) {
                return true;
            }
        }
    }
    return false;
}

/* Looks for an impact of the two in this sub-step, and solves it; true if there is one, or will be after another one. */
CAIRN_ONCE bool collide(cairn_world *world, cairn_arbiter *arbiter, phase *p, bool waits)
{
    cairn_impact i;
    bool hits = false;
    begin(&i, world, arbiter, p);
    cairn_impact_refresh(world, &i);
    if (cairn_impact_foresee(&i)) {
        bool first = !waits || !is_forestalled(world, &i, p);
        hits = !first || cairn_impact_meet(world, &i);
        if (first && hits) {
            cairn_impact_rebound(world, &i);
        }
    }
    if (i.adopted) {
        cairn_impact_hand_back(&i);
    }
    take_note(world, &i);
    return hits;
}

static void impact_phase(cairn_world *world, int substep)
{
    phase p = phase_of(world, substep);
    const cairn_motion calm = p.calm;
    bool any = !CAIRN_WITH_QUICK_WAYS || !is_all_calm(world, calm);
    if (any) {
        world->in_flight = false;
    }
    for (int pass = 0; pass < PASSES && any; pass++) {
        any = false;
        for (uint16_t place = 0; place < world->arbiter_count; place++) {
            uint16_t at = (uint16_t)(pass & 1 ? world->arbiter_count - 1 - place : place);
            cairn_arbiter *arbiter = cairn_arbiter_at(world, at);
            if (may_bounce(arbiter) && !is_calm(world, arbiter, calm)) {
                any = collide(world, arbiter, &p, pass < PASSES / 2) || any;
            }
        }
    }
}

const cairn_bounce_class cairn_bounce = { impact_phase };
