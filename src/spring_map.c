/*
 * What a sub-step makes of one spring, computed when springs change and, for off-centre anchors, once a step.
 *
 * With u the velocity along a spring, C its elongation, e the effective mass over the reduced mass,
 * b = k h^2 (1/mA + 1/mB) / e and d = c h (1/mA + 1/mB) / e:
 * - an isolated spring (each dynamic end carries one, b below 0.2) follows the exact map of the damped oscillator: an
 *   impulse of e (A u + B C) is taken off, A = 1 - det M and B = 1 + det M - tr M with M = exp((0, 1), (-b, -d));
 * - any other follows implicit Euler: with C* the elongation that the sub-step would end with, e (D u + B C*) is taken
 *   off, B = b / (1 + b + d) and D = d / (1 + b + d), bounded for any stiffness.
 */
#include "spring_solve.h"

/* Beyond this stiffness a spring is a rod: more would only lose bits. */
#define STIFFNESS_MAX cairn_wide_from_int(4096)

/* 1 / e */
static cairn_factor stiffening(const cairn_spring *spring, const cairn_body *a, const cairn_body *b, cairn_lever ja, cairn_lever jb)
{
    cairn_factor k = cairn_factor_from_share((cairn_body_is_free_to_shift(a) ? spring->share_a : 0) + (cairn_body_is_free_to_shift(b) ? spring->share_b : 0));
    return k + cairn_factor_spin(spring->share_a, ja, ja) + cairn_factor_spin(spring->share_b, jb, jb);
}

cairn_factor cairn_spring_mass(const cairn_world *world, const cairn_spring *spring)
{
    if (spring->lever_a == 0 && spring->lever_b == 0) {
        return CAIRN_FACTOR(1);
    }
    cairn_factor inverse = stiffening(spring, &world->bodies[spring->a], &world->bodies[spring->b], spring->lever_a, spring->lever_b);
    return cairn_factor_from_ratio(cairn_factor_inverse(inverse));
}

/* The elements of a matrix, row by row. */
enum { ELEMENTS = 4 };

/* p = p q */
static void multiply(cairn_share *p, const cairn_share *q)
{
    for (int i = 0; i < ELEMENTS; i += 2) {
        cairn_share first = p[i];
        p[i] = cairn_unit_dot(first, p[i + 1], q[0], q[2]);
        p[i + 1] = cairn_unit_dot(first, p[i + 1], q[1], q[3]);
    }
}

/*
 * exp(K) - 1 for K = ((0, w), (-w, -d)) by Taylor's series of K / 2^s and s squarings of 1 + E, s no greater than the series needs: each
 * halving costs w a bit, and with it the frequency. In this scaling (the velocity over w) det E is B and small stiffnesses keep their bits.
 */
static void oscillator(cairn_wide w, cairn_wide d, cairn_share *sum)
{
    enum { HALVINGS_MAX = 8, TERMS = 5 }; /* for d up to 16 */
    int halvings = 0;
    cairn_wide most = cairn_wide_mul(cairn_wide_add(w, d), cairn_wide_from_int(16)); /* K / 2^s is to be below a 16th */
    static const cairn_share inverse[TERMS] = { CAIRN_SHARE(1), CAIRN_SHARE(1.0 / 2), CAIRN_SHARE(1.0 / 3), CAIRN_SHARE(1.0 / 4),
                                                CAIRN_SHARE(1.0 / 5) };
    cairn_share k[ELEMENTS], term[ELEMENTS] = { CAIRN_SHARE(1), 0, 0, CAIRN_SHARE(1) };
    while (halvings < HALVINGS_MAX && cairn_wide_less(cairn_wide_from_int(1 << halvings), most)) {
        halvings++;
    }
    cairn_wide scale = cairn_wide_from_int(1 << halvings);
    k[0] = 0;
    k[1] = cairn_wide_to_share(cairn_wide_div(w, scale));
    k[2] = -k[1];
    k[3] = -cairn_wide_to_share(cairn_wide_div(d, scale));
    cairn_clear(sum, ELEMENTS * sizeof *sum);
    for (int i = 0; i < TERMS; i++) {
        multiply(term, k);
        for (int n = 0; n < ELEMENTS; n++) {
            term[n] = cairn_share_mul(term[n], inverse[i]);
            sum[n] += term[n];
        }
    }
    for (int i = 0; i < halvings; i++) {
        cairn_share square[ELEMENTS];
        cairn_copy(square, sum, sizeof square);
        multiply(square, sum);
        for (int n = 0; n < ELEMENTS; n++) {
            sum[n] += sum[n] + square[n]; /* added first: twice what is -1 and a little more would wrap */
        }
    }
}

static void map_exactly(cairn_spring *spring, cairn_wide b, cairn_wide d)
{
    cairn_share e[ELEMENTS];
    oscillator(cairn_wide_sqrt(b), d, e);
    cairn_wide determinant = cairn_wide_determinant(e[0], e[1], e[2], e[3]);
    spring->velocity_gain = -(e[0] + e[3]) - cairn_wide_to_share(determinant);
    spring->position_gain = determinant;
    spring->yield = spring->velocity_gain + cairn_wide_to_share(cairn_wide_div(determinant, b)) - CAIRN_SHARE(1);
    spring->flags |= CAIRN_SPRING_EXACT;
}

static void map_implicitly(cairn_spring *spring, cairn_wide b, cairn_wide d)
{
    cairn_wide whole = cairn_wide_add(cairn_wide_from_int(1), cairn_wide_add(b, d));
    spring->velocity_gain = cairn_wide_to_share(cairn_wide_div(d, whole));
    spring->position_gain = cairn_wide_div(b, whole);
    spring->yield = cairn_wide_to_share(cairn_wide_inverse(whole));
    spring->flags &= (uint16_t)~CAIRN_SPRING_EXACT;
}

static cairn_wide bounded(cairn_wide stiffness) { return cairn_wide_less(STIFFNESS_MAX, stiffness) ? STIFFNESS_MAX : stiffness; }

bool cairn_spring_is_alone(const cairn_body *a, const cairn_body *b)
{
    return !(cairn_body_is_dynamic(a) && (a->flags & CAIRN_BODY_SPRINGS)) && !(cairn_body_is_dynamic(b) && (b->flags & CAIRN_BODY_SPRINGS));
}

/* Most springs of a network are as the one before them, and making a map takes thousands of instructions. */
bool cairn_spring_map_as(const cairn_world *world, cairn_spring *spring, const cairn_spring *model)
{
    const cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
    const cairn_body *model_a = &world->bodies[model->a], *model_b = &world->bodies[model->b];
    if (!(spring->flags & model->flags & CAIRN_SPRING_PLAIN) || spring->stiffness != model->stiffness || spring->damping != model->damping
        || a->model != model_a->model || b->model != model_b->model
        || cairn_spring_is_alone(a, b) != cairn_spring_is_alone(model_a, model_b)) {
        return false;
    }
    spring->share_a = model->share_a;
    spring->share_b = model->share_b;
    spring->velocity_gain = model->velocity_gain;
    spring->yield = model->yield;
    spring->position_gain = model->position_gain;
    spring->flags = (uint16_t)((spring->flags & ~(unsigned)CAIRN_SPRING_EXACT) | (model->flags & CAIRN_SPRING_EXACT));
    return true;
}

void cairn_spring_map_pin(const cairn_world *world, cairn_spring *pin)
{
    const cairn_body *a = &world->bodies[pin->a], *b = &world->bodies[pin->b];
    cairn_wide over_e = cairn_wide_from_factor(stiffening(pin, a, b, pin->lever_a, pin->lever_b));
    cairn_wide stiffness = cairn_wide_mul(cairn_wide_unpack(pin->made.pin.stiffness), over_e);
    cairn_wide damping = cairn_wide_mul(cairn_wide_unpack(pin->made.pin.damping), over_e);
    map_implicitly(pin, bounded(stiffness), bounded(damping));
}

void cairn_spring_map(const cairn_world *world, cairn_spring *spring)
{
    const cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
    bool moves_a = cairn_body_is_dynamic(a), moves_b = cairn_body_is_dynamic(b);
    spring->share_a = !moves_a ? 0 : !moves_b ? CAIRN_SHARE(1) : cairn_bodies_share(a, b);
    spring->share_b = moves_b ? CAIRN_SHARE(1) - spring->share_a : 0;
    /* Where neither moves the mass is 0, and so are these. */
    cairn_wide mass = cairn_bodies_reduced_mass(a, b), h = cairn_world_substep(world);
    cairn_wide stiffness = cairn_wide_div(cairn_wide_mul(cairn_wide_unpack(spring->stiffness), cairn_wide_mul(h, h)), mass);
    cairn_wide damping = cairn_wide_div(cairn_wide_mul(cairn_wide_unpack(spring->damping), h), mass);
    if (cairn_spring_is_pin(spring)) {
        spring->made.pin.stiffness = cairn_wide_pack(stiffness);
        spring->made.pin.damping = cairn_wide_pack(damping);
        spring->made.pin.strain = 0;
        cairn_spring_map_pin(world, spring);
        return;
    }
    if (cairn_spring_is_off_centre(spring)) {
        cairn_reach r;
        cairn_spring_measure(spring, a, b, &r);
        cairn_wide over_e = cairn_wide_from_factor(stiffening(spring, a, b, cairn_spring_lever(a, r.arm_a, r.x, r.y), cairn_spring_lever(b, r.arm_b, r.x, r.y)));
        stiffness = cairn_wide_mul(stiffness, over_e);
        damping = cairn_wide_mul(damping, over_e);
    }
    bool alone = cairn_spring_is_alone(a, b);
    bool soft = cairn_wide_less(stiffness, cairn_wide_inverse(cairn_wide_from_int(5)))
             && cairn_wide_less(damping, cairn_wide_from_int(16));
    if (alone && soft && !cairn_wide_is_zero(stiffness)) {
        map_exactly(spring, stiffness, damping);
    } else {
        map_implicitly(spring, bounded(stiffness), bounded(damping));
    }
}
