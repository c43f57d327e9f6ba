/*
 * The sweeps over the contacts of a step: which way each takes, in which order, and one pass over all of them. The passes over one contact
 * are in sweep_quick.c, for what most contacts are, and in sweep_careful.c, which serves in all cases.
 */
#include "sweep.h"

/* Push-outs beyond this are left to the careful way. */
#define PUSH CAIRN_MOTION(0.125)

/* ---- the ways ---- */

static int path_of(const cairn_world *world, const cairn_arbiter *arbiter)
{
    if (!(arbiter->flags & CAIRN_ARBITER_SOLVED) || (arbiter->block & CAIRN_BLOCK_NUMBER)) {
        return CAIRN_PATH_NONE;
    }
    bool first = arbiter->rows[0].gap > 0, second = cairn_arbiter_has_two(arbiter) && arbiter->rows[CAIRN_LAST_ROW].gap > 0;
    int apart = first && (second || !cairn_arbiter_has_two(arbiter)) ? CAIRN_PATH_APART : 0;
    if (cairn_arbiter_is_sliding(arbiter)) {
        return CAIRN_PATH_SLIDING + apart;
    }
    /* An impact may leave a contact without points: the quick ways take one at least. */
    if (arbiter->count == 0 || (arbiter->flags & CAIRN_ARBITER_CAREFUL) || arbiter->block != 0 || (CAIRN_WITH_FRICTION && arbiter->kinetic_friction > CAIRN_FACTOR(1)) || cairn_world_push_out_limit(world) > PUSH) {
        return CAIRN_PATH_CAREFUL + apart;
    }
    if (!cairn_arbiter_has_two(arbiter)) {
        bool central = !CAIRN_WITH_TURNING || (arbiter->rows[0].lever_a == 0 && arbiter->rows[0].lever_b == 0);
        bool alike = arbiter->share_a == CAIRN_SHARE(0.5) && arbiter->friction_lever_a == -arbiter->friction_lever_b;
        return !central ? CAIRN_PATH_SINGLE : alike ? CAIRN_PATH_EVEN_CENTRAL : CAIRN_PATH_CENTRAL;
    }
    if (first || second) {
        return CAIRN_PATH_SHARED + apart;
    }
    return arbiter->flags & CAIRN_ARBITER_ON_STATIC ? CAIRN_PATH_ON_STATIC : arbiter->share_a == CAIRN_SHARE(0.5) ? CAIRN_PATH_EVEN : CAIRN_PATH_SHARED;
}

uint8_t cairn_arbiter_path_of(const cairn_world *world, const cairn_arbiter *arbiter, unsigned fresh)
{
    unsigned path = (unsigned)path_of(world, arbiter);
    if (path != CAIRN_PATH_NONE && cairn_arbiter_has_two(arbiter)) { /* of one point it makes no difference */
        path |= fresh | cairn_flag_if(!(arbiter->flags & CAIRN_ARBITER_ON_STATIC), CAIRN_PATH_FREE);
    }
    return (uint8_t)path;
}

/*
 * Contacts in the order of their ways, and within each in that of their bodies' places, so that each way is called once a pass. In the
 * order of bodies alone nearly every contact of a mixed heap takes another way than the one before, and calls took 8 % of its
 * step. The ways' own order is the one after which heaps come to rest soonest, see DESIGN.md.
 */
CAIRN_ONCE void arrange(cairn_world *world)
{
    const uint16_t *const end = world->order + world->arbiter_count;
    const cairn_arbiter *const arbiters = world->arbiters;
    uint16_t *const places = world->swept_ends, *const swept = world->swept, place = 0;
    cairn_clear(places, sizeof world->swept_ends);
    for (const uint16_t *at = world->order; at != end; at++) {
        places[arbiters[*at].path & CAIRN_PATH_TURN]++;
    }
    for (int turn = 0; turn <= CAIRN_PATH_TURN; turn++) {
        uint16_t count = places[turn];
        places[turn] = place;
        place = (uint16_t)(place + count);
    }
    for (const uint16_t *at = world->order; at != end; at++) {
        swept[places[arbiters[*at].path & CAIRN_PATH_TURN]++] = *at;
    }
    world->rearranged = false;
}

void cairn_sweep_arrange(cairn_world *world)
{
    if (CAIRN_HAS_WAYS && world->rearranged) {
        arrange(world);
    }
}

void cairn_sweep_choose_again(cairn_world *world)
{
    bool any_slides = false;
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        cairn_arbiter *arbiter = cairn_arbiter_at(world, place);
        arbiter->path = cairn_arbiter_path_of(world, arbiter, arbiter->path & CAIRN_PATH_FRESH);
        any_slides = any_slides || cairn_arbiter_is_sliding(arbiter);
    }
    world->slides = any_slides;
    world->rearranged = true;
}

/* Where the quick ways are left out: as each of them asks. */
static bool may_be_far(const cairn_arbiter *arbiter)
{
    bool by_flag = cairn_arbiter_has_two(arbiter) || (arbiter->path & CAIRN_PATH_TURN) < CAIRN_PATH_CENTRAL;
    return by_flag ? (arbiter->path & CAIRN_PATH_APART) != 0 : arbiter->rows[0].gap > 0;
}

/*
 * One pass over all contacts, each by its path. The two points of a contact take turns in coming first, from sub-step to sub-step:
 * those with one of the flags from_last begin with the last. What comes first takes more of what both are to stop: were it always
 * the same one, all boxes of a column that settles would begin to turn the same way. Held rows keep their order in the biased
 * pass, where turns would leave a wide pyramid breathing for ever, and on something static, where they come to rest sooner.
 */
static void sweep(cairn_world *world, cairn_way *const quick[], cairn_careful_pass *careful, cairn_pass pass, unsigned from_last)
{
    const uint16_t *at = CAIRN_HAS_WAYS ? world->swept + world->swept_ends[CAIRN_PATH_NONE] : world->order;
    const uint16_t *const end = CAIRN_HAS_WAYS ? world->swept + world->swept_ends[CAIRN_PATH_TURN] : at + world->arbiter_count;
    cairn_arbiter *const arbiters = world->arbiters;
    while (at != end) {
        cairn_arbiter *arbiter = &arbiters[*at];
        unsigned path = arbiter->path;
        bool begins_with_last = CAIRN_MAX_POINTS > 1 && (path & from_last) != 0;
        if (CAIRN_WITH_QUICK_WAYS) {
            at = quick[path & CAIRN_PATH_ALIKE ? 0 : path & CAIRN_PATH_TURN](world, at, end, begins_with_last);
        } else {
            at++;
            if (CAIRN_IS_PUSH_ALONE && !CAIRN_WITH_SHORTCUTS) {
                cairn_push_alone(world, arbiter, pass);
            } else if (!CAIRN_WITH_SHORTCUTS || !may_be_far(arbiter) || !cairn_is_far(&world->bodies[arbiter->a], &world->bodies[arbiter->b], arbiter)) {
                careful(world, arbiter, begins_with_last);
            }
        }
    }
}

#define QUICK(ways) (CAIRN_WITH_QUICK_WAYS ? (ways) : NULL)

void cairn_sweep_warm_start(cairn_world *world) { sweep(world, QUICK(cairn_warm_start_ways), cairn_careful_warm_start, CAIRN_WARM_START, CAIRN_PATH_FRESH); }
void cairn_sweep_biased(cairn_world *world, int substep)
{
    sweep(world, QUICK(cairn_biased_ways), cairn_careful_biased_pass, CAIRN_BIASED, substep & 1 ? CAIRN_PATH_FRESH : 0u);
}
void cairn_sweep_relax(cairn_world *world, int substep)
{
    sweep(world, QUICK(cairn_relax_ways), cairn_careful_relax_pass, CAIRN_RELAX, substep & 1 ? CAIRN_PATH_FRESH | CAIRN_PATH_FREE : 0u);
}
