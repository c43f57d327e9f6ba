/*
 * Heavy bodies on light ones. Sweeping needs about as many passes as the mass ratio before the light body's supports know
 * of the load, and a contact's softness is in proportion to the lighter mass: at 100 to 1 a box sinks in by a centimetre, from 1000 on it is
 * squeezed out. So light bodies with all of their contacts are gathered into blocks, and a block is
 * solved at once, with contacts as stiff as its heaviest body needs.
 */
#include "block.h"

/* Normal impulses decide friction's limits and friction them: so often in turns. */
#define FRICTION_ROUNDS 8
/* What a contact yields in a sub-step under its own impulse, 1 / a2 of the soft contacts; see engine.h. */
#define YIELD cairn_wide_div(cairn_wide_from_int(5502), cairn_wide_from_int(100000))
/* Friction's limits are as they should be within this, m per sub-step of the lightest body. */
#define LIMIT_ERROR CAIRN_MOTION(1e-5)

/* ---- gathering one ---- */

static uint8_t slot_of(cairn_block *block, cairn_body *body)
{
    int i = 0;
    while (i < block->body_count && block->bodies[i].body != body) {
        i++;
    }
    if (i == block->body_count) {
        cairn_block_body *slot = &block->bodies[block->body_count++];
        cairn_clear(slot, sizeof *slot);
        slot->body = body;
    }
    return (uint8_t)i;
}

/* Inverse masses relative to the lightest, and how soft the contacts are with the heaviest. */
static void weigh(cairn_block *block)
{
    cairn_wide lightest = cairn_wide_zero(), heaviest = lightest;
    for (int i = 0; i < block->body_count; i++) {
        cairn_wide mass = cairn_body_mass_of(block->bodies[i].body);
        if (!cairn_wide_is_zero(mass)) {
            lightest = cairn_wide_is_zero(lightest) || cairn_wide_less(mass, lightest) ? mass : lightest;
            heaviest = cairn_wide_less(heaviest, mass) ? mass : heaviest;
        }
    }
    for (int i = 0; i < block->body_count; i++) {
        block->bodies[i].inverse = cairn_wide_div(lightest, cairn_body_mass_of(block->bodies[i].body));
    }
    block->softness = cairn_wide_mul(YIELD, cairn_wide_div(lightest, heaviest));
}

/* From an arbiter's own unit of impulses to the block's. */
CAIRN_ALWAYS_INLINE cairn_wide unit_of(const cairn_block *block, const cairn_block_arbiter *arbiter)
{
    return cairn_wide_add(block->bodies[arbiter->a].inverse, block->bodies[arbiter->b].inverse);
}

/* The rows of an arbiter: its points, then friction. */
static void add_rows(cairn_block *block, const cairn_arbiter *arbiter)
{
    for (int i = 0; i <= arbiter->count; i++) {
        cairn_block_row *row = &block->rows[block->row_count++];
        bool rubs = i == arbiter->count;
        row->arbiter = (uint8_t)block->arbiter_count;
        row->x = rubs ? cairn_dir_negate(arbiter->normal_y) : arbiter->normal_x;
        row->y = rubs ? arbiter->normal_x : arbiter->normal_y;
        row->lever_a = rubs ? arbiter->friction_lever_a : arbiter->rows[i].lever_a;
        row->lever_b = rubs ? arbiter->friction_lever_b : arbiter->rows[i].lever_b;
        row->kind = rubs ? CAIRN_ROW_FRICTION : CAIRN_ROW_RIGID;
        row->limit = rubs ? 0 : CAIRN_PUSH_MAX;
        row->bias = 0;
        row->state = CAIRN_ROW_LOW;
    }
}

static cairn_arbiter *arbiter_of(const cairn_world *world, const cairn_block_arbiter *arbiter) { return cairn_arbiter_at(world, arbiter->place); }

/* Of a point, or of friction behind the last of them. */
static cairn_motion *impulse_of(cairn_arbiter *arbiter, int i) { return i == arbiter->count ? &arbiter->friction_impulse : &arbiter->rows[i].impulse; }

/* From the arbiters' impulses. */
static void load_impulses(const cairn_world *world, cairn_block *block)
{
    cairn_block_row *row = block->rows;
    for (int n = 0; n < block->arbiter_count; n++) {
        cairn_arbiter *arbiter = arbiter_of(world, &block->arbiters[n]);
        cairn_wide per_unit = cairn_wide_inverse(unit_of(block, &block->arbiters[n]));
        for (int i = 0; i <= arbiter->count; i++, row++) {
            row->impulse = cairn_push_scale(cairn_push_shift(cairn_push_from_motion(*impulse_of(arbiter, i)), arbiter->past.block.exponent), per_unit);
        }
    }
}

/* False if it has outgrown its room: the impact phase may find another point within a step. */
static bool gather(cairn_world *world, uint8_t number, cairn_block *block)
{
    block->row_count = block->body_count = block->arbiter_count = 0;
    block->current = block->factors.valid = false;
    block->factors.count = 0;
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        const cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        if (cairn_block_of(arbiter) == number) {
            if (block->row_count + arbiter->count + 1 > CAIRN_BLOCK_ROWS) {
                return false;
            }
            cairn_block_arbiter *slot = &block->arbiters[block->arbiter_count];
            slot->place = place;
            slot->a = slot_of(block, &world->bodies[arbiter->a]);
            slot->b = slot_of(block, &world->bodies[arbiter->b]);
            add_rows(block, arbiter);
            block->arbiter_count++;
        }
    }
    weigh(block);
    load_impulses(world, block);
    return true;
}

/* ---- and back ---- */

/* The rows behind the arbiter's. */
static const cairn_block_row *store_impulses(const cairn_block_row *row, cairn_arbiter *arbiter, cairn_wide unit)
{
    cairn_push impulses[3];
    int exponent = 0;
    for (int i = 0; i <= arbiter->count; i++, row++) {
        impulses[i] = cairn_push_scale(row->impulse, unit);
        int excess = cairn_push_excess(impulses[i]);
        exponent = excess > exponent ? excess : exponent;
    }
    for (int i = 0; i <= arbiter->count; i++) {
        *impulse_of(arbiter, i) = cairn_motion_from_push(cairn_push_shift(impulses[i], -exponent));
    }
    arbiter->past.block.exponent = (uint8_t)exponent;
    return row;
}

CAIRN_ONCE cairn_motion speed_of(cairn_push v, cairn_motion limit) { return cairn_motion_clamp(cairn_motion_from_push(v), limit); }

static void store(cairn_world *world, cairn_block *block)
{
    const cairn_block_row *row = block->rows;
    cairn_block_evaluate(block);
    for (const cairn_block_body *from = block->bodies; from != block->bodies + block->body_count; from++) {
        if (cairn_body_is_dynamic(from->body)) {
            from->body->vx = speed_of(from->vx, CAIRN_SWEEP_SPEED);
            from->body->vy = speed_of(from->vy, CAIRN_SWEEP_SPEED);
            from->body->w = speed_of(from->vw, CAIRN_SWEEP_SPIN);
        }
    }
    for (int i = 0; i < block->arbiter_count; i++) {
        row = store_impulses(row, arbiter_of(world, &block->arbiters[i]), unit_of(block, &block->arbiters[i]));
    }
}

/* ---- passes ---- */

CAIRN_ONCE cairn_push magnitude(cairn_push x) { return x < 0 ? -x : x; }

static void clear_impulses(cairn_block *block)
{
    for (cairn_block_row *row = block->rows; row != block->rows + block->row_count; row++) {
        cairn_block_press(block, row, -row->impulse);
    }
}

/* How far a row has opened in this step. */
CAIRN_ONCE cairn_motion moved(const cairn_world *world, const cairn_arbiter *arbiter, const cairn_block_row *row)
{
    return cairn_displacement_along(&world->bodies[arbiter->a], &world->bodies[arbiter->b], row->x, row->y, row->lever_a, row->lever_b);
}

/*
 * Bodies hold v + beta d while the pass is biased, so a touching point's push-out follows its separation, and friction has its share of what they lean
 * by: their slip in this step is not to be undone. A point that is apart may close its gap and no more.
 */
static void start_point(const cairn_world *world, const cairn_arbiter *arbiter, const cairn_row *from, cairn_block_row *row, bool biased)
{
    row->state = row->impulse > 0 ? CAIRN_ROW_FREE : CAIRN_ROW_LOW;
    if (biased) {
        row->kind = CAIRN_ROW_SOFT;
        row->bias = from->gap;
    }
    if (from->gap > 0) {
        cairn_motion by = moved(world, arbiter, row), separation = cairn_motion_add(from->gap, by);
        bool apart = separation > 0;
        row->kind = apart ? CAIRN_ROW_RIGID : row->kind;
        if (biased) {
            row->bias = apart ? cairn_motion_add(separation, -cairn_motion_ratio(by, CAIRN_SOFT_BETA)) : cairn_motion_ratio(from->gap, CAIRN_SOFT_BETA);
        } else {
            row->bias = apart ? separation : 0;
        }
        if (cairn_row_is_in_flight(from)) {
            row->state = CAIRN_ROW_LOW; /* the impact phase's */
            row->limit = 0;
        }
    }
}

static void start_rows(const cairn_world *world, cairn_block *block, bool biased)
{
    const cairn_row *from = NULL;
    for (int i = 0; i < block->row_count; i++) {
        cairn_block_row *row = &block->rows[i];
        const cairn_arbiter *arbiter = arbiter_of(world, &block->arbiters[row->arbiter]);
        if (row->kind == CAIRN_ROW_FRICTION) {
            row->state = CAIRN_ROW_FREE;
            row->limit = CAIRN_PUSH_MAX;
            row->bias = biased ? -cairn_motion_ratio(moved(world, arbiter, row), CAIRN_SOFT_BETA) : 0;
            from = NULL;
        } else {
            from = from == NULL ? arbiter->rows : from + 1;
            start_point(world, arbiter, from, row, biased);
        }
        cairn_block_scale_row(block, i);
    }
}

/* Friction's limits from the pressure that there is. True if they are other than before. */
static bool limit_friction(const cairn_world *world, cairn_block *block)
{
    bool changed = false;
    cairn_push pressure = 0;
    for (cairn_block_row *row = block->rows; row != block->rows + block->row_count; row++) {
        if (row->kind != CAIRN_ROW_FRICTION) {
            pressure += row->impulse;
            continue;
        }
        const cairn_arbiter *arbiter = arbiter_of(world, &block->arbiters[row->arbiter]);
        bool slides = magnitude(row->residual) > cairn_push_half(pressure);
        cairn_push old = row->limit;
        row->limit = cairn_push_factor(pressure, slides ? arbiter->kinetic_friction : cairn_arbiter_static_friction(world, arbiter));
        pressure = 0;
        if (row->state == CAIRN_ROW_FREE && magnitude(row->impulse) > row->limit) {
            row->state = (uint8_t)(row->impulse > row->limit ? CAIRN_ROW_HIGH : CAIRN_ROW_LOW);
            changed = true;
        } else if (row->state != CAIRN_ROW_FREE) {
            changed = changed || magnitude(row->limit - old) > LIMIT_ERROR;
        }
    }
    return changed;
}

/* The greatest size of these. */
CAIRN_ONCE cairn_push greatest(cairn_push most, cairn_push x, cairn_push y, cairn_push w)
{
    cairn_push sizes[3] = { magnitude(x), magnitude(y), magnitude(w) };
    for (int i = 0; i < 3; i++) {
        most = sizes[i] > most ? sizes[i] : most;
    }
    return most;
}

/* Whether a body is much faster than any was before this sub-step: no collision without restitution does that. */
static bool is_implausible(const cairn_world *world, cairn_block *block)
{
    cairn_push before = 0, after = 0;
    cairn_push fall = magnitude(cairn_push_from_motion(world->gravity_x.whole)) + magnitude(cairn_push_from_motion(world->gravity_y.whole));
    cairn_block_evaluate(block);
    for (const cairn_block_body *at = block->bodies; at != block->bodies + block->body_count; at++) {
        before = greatest(before, cairn_push_from_motion(at->body->ux), cairn_push_from_motion(at->body->uy), cairn_push_from_motion(at->body->uw));
        after = greatest(after, at->vx, at->vy, at->vw);
    }
    return after > 2 * before + 4 * fall + cairn_push_from_motion(cairn_world_push_out_limit(world));
}

/* Impulses that would have thrown the bodies are none. */
static void finish(cairn_world *world, cairn_block *block)
{
    if (is_implausible(world, block)) {
        clear_impulses(block);
    }
    store(world, block);
}

/* What the contacts' new directions make of the impulses may be anything: then the block starts from zero. */
static void warm_start_block(cairn_world *world, cairn_block *block)
{
    for (cairn_block_row *row = block->rows; row != block->rows + block->row_count; row++) {
        cairn_push impulse = row->impulse;
        row->impulse = 0;
        cairn_block_press(block, row, impulse);
    }
    finish(world, block);
}

static void solve(cairn_world *world, cairn_block *block, bool biased)
{
    bool settled = false;
    start_rows(world, block, biased);
    cairn_block_evaluate(block);
    for (int i = 0; i < FRICTION_ROUNDS && !settled; i++) {
        if (!cairn_block_settle(block)) {
            break;
        }
        settled = !limit_friction(world, block);
    }
    finish(world, block);
}

static void biased_block(cairn_world *world, cairn_block *block) { solve(world, block, true); }

/*
 * The rule of rest holds for all of a block or for none: stopping a light body a little before its balance would leave
 * the one above it sliding along for ever.
 */
static void rest_together(const cairn_world *world, const cairn_block *block)
{
    bool still = true;
    for (int i = 0; i < block->body_count; i++) {
        const cairn_body *body = block->bodies[i].body;
        still = still && (!cairn_body_is_dynamic(body) || cairn_body_is_still(world, body));
    }
    for (int i = 0; i < block->body_count && !still; i++) {
        block->bodies[i].body->flags |= CAIRN_BODY_RESTLESS;
    }
}

static void relax_block(cairn_world *world, cairn_block *block)
{
    solve(world, block, false);
    rest_together(world, block);
}

static void for_each_block(cairn_world *world, void (*pass)(cairn_world *world, cairn_block *block))
{
    for (uint8_t number = 1; number <= world->blocks; number++) {
        if (gather(world, number, world->block)) {
            pass(world, world->block);
        } else {
            cairn_block_dissolve(world, number);
        }
    }
}

static void warm_start(cairn_world *world) { for_each_block(world, warm_start_block); }
static void biased_pass(cairn_world *world) { for_each_block(world, biased_block); }
static void relax_pass(cairn_world *world) { for_each_block(world, relax_block); }

static const cairn_block_class block_class = { cairn_block_find, warm_start, biased_pass, relax_pass, cairn_block_release };

cairn_status cairn_blocks_enable(cairn_world *world, cairn_block *memory)
{
    if (world == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (memory == NULL || world->locked) {
        return cairn_fail(world, memory == NULL ? CAIRN_ERROR_NULL : CAIRN_ERROR_LOCKED);
    }
    if (!CAIRN_WITH_BLOCKS) {
        return cairn_fail(world, CAIRN_ERROR_KIND);
    }
    cairn_clear(memory, sizeof *memory);
    memory->kind = &block_class;
    world->block = memory;
    return CAIRN_OK;
}
