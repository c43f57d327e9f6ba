/* The all-pairs search: the simplest broad phase, and the quickest for a few dozen bodies. */
#include "engine.h"

static void find_pairs(cairn_world *world)
{
    for (uint16_t i = 0; i < world->body_end; i++) {
        const cairn_body *a = &world->bodies[i];
        if (!(a->flags & CAIRN_BODY_USED)) {
            continue;
        }
        bool idle = !cairn_body_is_active(a);
        for (uint16_t j = (uint16_t)(i + 1); j < world->body_end; j++) {
            const cairn_body *b = &world->bodies[j];
            if (cairn_boxes_overlap(a, b) && (b->flags & CAIRN_BODY_USED) && !(idle && !cairn_body_is_active(b))) {
                cairn_arbiter_pair(world, i, j);
            }
        }
    }
}

const cairn_broad_class cairn_broad_pairs = { find_pairs };
