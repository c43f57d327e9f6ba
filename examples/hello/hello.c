/* The example of the README: a crate falls on a floor, in 20 lines. */
#include <cairn/cairn.h>

#include "cairn_port.h"
#include "cairn_print.h"

CAIRN_WORLD(yard, 16, 32); /* bodies, arbiters: all the memory there is */

static const cairn_shape floor_shape = CAIRN_BOX(CAIRN_F(20), CAIRN_F(1)); /* in flash */
static const cairn_shape crate_shape = CAIRN_BOX(CAIRN_F(0.5), CAIRN_F(0.5));
static const cairn_body_model ground = CAIRN_BODY_MODEL(CAIRN_STATIC, &floor_shape, &cairn_material_default);
static const cairn_body_model crate = CAIRN_BODY_MODEL(CAIRN_DYNAMIC, &crate_shape, &cairn_material_default);

int main(void)
{
    cairn_port_init();
    cairn_world *world = cairn_world_init(&yard, cairn_vec2_of(0, CAIRN_F(-10)));

    cairn_body_create(world, &ground, cairn_vec2_of(0, CAIRN_F(-0.5)), 0);
    cairn_body_id id = cairn_body_create(world, &crate, cairn_vec2_of(0, CAIRN_F(4)), 0);

    for (int step = 0; step < 120; step++) {
        cairn_world_step(world); /* 1/60 s */
    }
    cairn_print_text("the crate lies at a height of ");
    cairn_print_i32(cairn_real_floor(1000 * cairn_body_position(world, id).y)); /* as Q16.16: for less than 32 m */
    cairn_print_text(" mm\n");
    cairn_print_flush();
    cairn_port_exit(cairn_world_get_stats(world)->dropped == 0 ? 0 : 1);
    return 0;
}
