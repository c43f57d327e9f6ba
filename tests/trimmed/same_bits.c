/*
 * Balls of one kind, or boxes where CRATES is 1, that neither rub nor turn fall among upright boxes: what every build of Cairn knows. It prints the
 * world's hash now and then, which a build with all features and one with less must have in common (same_bits.cmake).
 */
#include <cairn/cairn.h>
#include <stdio.h>

enum { BALLS = 12, STEPS = 600, EACH = 60 };

CAIRN_WORLD(yard, 16, 48);

static const cairn_material slick = CAIRN_MATERIAL(0, 0);
#if CRATES
static const cairn_shape ball_shape = CAIRN_BOX(CAIRN_F(0.6), CAIRN_F(0.5));
#else
static const cairn_shape ball_shape = CAIRN_CIRCLE(CAIRN_F(0.3));
#endif
static const cairn_shape floor_shape = CAIRN_BOX(CAIRN_F(8), CAIRN_F(1)), post_shape = CAIRN_BOX(CAIRN_F(0.5), CAIRN_F(9));
static const cairn_body_model ground = CAIRN_BODY_MODEL(CAIRN_STATIC, &floor_shape, &slick), post = CAIRN_BODY_MODEL(CAIRN_STATIC, &post_shape, &slick);

int main(void)
{
    cairn_body_model ball = CAIRN_BODY_MODEL(CAIRN_DYNAMIC, &ball_shape, &slick);
    cairn_world *world = cairn_world_init_with(&yard, cairn_vec2_of(CAIRN_F(0.5), CAIRN_F(-10)), &cairn_solver_soft, NULL);
    ball.fixed_rotation = true;
    cairn_body_create(world, &ground, cairn_vec2_of(0, CAIRN_F(-0.5)), 0);
    cairn_body_create(world, &post, cairn_vec2_of(CAIRN_F(-3.5), CAIRN_F(4)), 0);
    cairn_body_create(world, &post, cairn_vec2_of(CAIRN_F(3.5), CAIRN_F(4)), 0);
    for (int i = 0; i < BALLS; i++) {
        cairn_body_create(world, &ball, cairn_vec2_of(CAIRN_F(-2.5) + i % 4 * CAIRN_F(1.4), CAIRN_F(1) + i * CAIRN_F(0.7)), 0);
    }
    for (int step = 0; step < STEPS; step++) {
        if (cairn_world_step(world) != CAIRN_OK) {
            return 1;
        }
        if (step % EACH == EACH - 1) {
            printf("%d %08lx\n", step + 1, (unsigned long)cairn_world_hash(world));
        }
    }
    return cairn_world_error(world) == CAIRN_OK ? 0 : 1;
}
