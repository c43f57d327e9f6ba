/* A floor, and what stands on it in every build whose only solver is the small one. */
#ifndef SMALL_YARD_H
#define SMALL_YARD_H

#include <cairn/quadtree.h>
#include <cairn/sleep.h>

#include "../support/yard.h"

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5)), crate = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1)), floor_shape = CAIRN_BOX(CAIRN_F(40), CAIRN_F(1));
static const cairn_material rubber = CAIRN_MATERIAL_BOUNCING(0, 0, 0.5, 0);
CAIRN_SPRINGS(coils, 2);
CAIRN_QUADTREE(tree, 16, 16, 64);
CAIRN_BLOCKS(blocks);

static inline void open_floor(void)
{
    open_yard(CAIRN_F(-10));
    put_static(&floor_shape, 0, CAIRN_F(-0.5));
}

static inline void assert_other_solvers_are_refused(void)
{
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_world_use_slides_solver(world, 10));
    keep_yard();
    TEST_ASSERT_NULL(cairn_world_init_with(&yard, at(0, 0), &cairn_solver_soft, NULL));
    TEST_ASSERT_NULL(cairn_world_init_with(&yard, at(0, 0), &cairn_solver_slides, NULL));
    assert_yard_kept();
}

static inline void assert_a_stack_stands(void)
{
    cairn_body_id ids[8];
    for (int i = 0; i < 8; i++) {
        ids[i] = put(&crate, CAIRN_F(0.05 * (i % 2)), CAIRN_F(0.5 + i));
    }
    run(900);
    for (int i = 0; i < 8; i++) {
        ASSERT_NEAR(0.03, 0.05 * (i % 2), x_of(ids[i]));
        ASSERT_NEAR(0.08, 0.5 + i, y_of(ids[i]));
    }
}

#endif
