/* The smallest game: a marble falls. */
#include <cairn/cairn.h>

CAIRN_WORLD(yard, 2, 2);

static const cairn_shape circle = CAIRN_CIRCLE(CAIRN_F(0.25));
static const cairn_body_model marble = CAIRN_BODY_MODEL(CAIRN_DYNAMIC, &circle, &cairn_material_default);

int main(void)
{
    cairn_world *world = cairn_world_init(&yard, cairn_vec2_of(0, CAIRN_F(-10)));
    const cairn_body_id body = cairn_body_create(world, &marble, cairn_vec2_of(0, 0), 0);
    for (int step = 0; step < 60; step++)
        (void)cairn_world_step(world);
    return cairn_body_position(world, body).y < CAIRN_F(-4) ? 0 : 1;
}
