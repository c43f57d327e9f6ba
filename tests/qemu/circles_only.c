/* A game of circles and nothing else, run and read by its symbols: no other feature may be linked with it. */
#include <cairn/cairn.h>

#include "cairn_port.h"

enum { STEPS = 60, FELL = 0, STAYED = 1 };

CAIRN_WORLD(yard, 4, 6);

static const cairn_shape circle = CAIRN_CIRCLE(CAIRN_F(0.25));
static const cairn_body_model marble = CAIRN_BODY_MODEL(CAIRN_DYNAMIC, &circle, &cairn_material_default);

int main(void)
{
    cairn_port_init();
    cairn_world *world = cairn_world_init_with(&yard, cairn_vec2_of(0, CAIRN_F(-10)), &cairn_solver_soft, NULL);
    const cairn_body_id body = cairn_body_create(world, &marble, cairn_vec2_of(0, CAIRN_F(10)), 0);
    for (int step = 0; step < STEPS; step++)
        (void)cairn_world_step(world);
    return cairn_body_position(world, body).y < CAIRN_F(6) ? FELL : STAYED;
}
