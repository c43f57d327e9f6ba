/*
 * Boxes, balls and polygons that turn, rub and bounce, of unequal masses, under the small solver: what every build that has it knows. It prints the
 * world's hash now and then, which a build with all features and those without the soft solver must have in common (same_bits.cmake). With MORE 1
 * there is all else that a build without the soft solver may have.
 */
#include <cairn/cairn.h>
#include <cairn/quadtree.h>
#include <cairn/sleep.h>
#include <cairn/spring.h>
#include <stdio.h>

enum { THINGS = 24, STEPS = 600, EACH = 50 };

CAIRN_WORLD(yard, 32, 128);

static const cairn_material rough = CAIRN_MATERIAL(0.6, 0.5), rubber = CAIRN_MATERIAL_BOUNCING(0.8, 0.7, 0.7, 0.3),
                            slick = CAIRN_MATERIAL_BOUNCING(0, 0, 1, 0), dull = CAIRN_MATERIAL_BOUNCING(0.3, 0.2, 0.4, 4);
static const cairn_material *const materials[] = { &rough, &rubber, &slick, &dull, &cairn_material_default };
static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.3)), crate = CAIRN_BOX(CAIRN_F(0.6), CAIRN_F(0.6)), plank = CAIRN_BOX(CAIRN_F(1.5), CAIRN_F(0.2)),
                         floor_shape = CAIRN_BOX(CAIRN_F(12), CAIRN_F(1)), post_shape = CAIRN_BOX(CAIRN_F(0.5), CAIRN_F(30)),
                         slide_shape = CAIRN_BOX(CAIRN_F(3), CAIRN_F(0.3));

static cairn_body_model models[THINGS], ground, post, slide, lift;

#if MORE
CAIRN_SPRINGS(ropes, 8);
CAIRN_QUADTREE(tree, 32, 40, 400);

static cairn_status have_more(cairn_world *world, int turn)
{
    cairn_status status = cairn_springs_enable(world, &ropes);
    status = status == CAIRN_OK && turn % 2 == 1 ? cairn_quadtree_enable(world, &tree, cairn_vec2_of(0, CAIRN_F(5)), 5, 5) : status;
    return status == CAIRN_OK && turn > 1 ? cairn_sleep_enable(world) : status;
}

static void make_odd(cairn_body_model *model, int i)
{
    model->gravity_scale = i % 6 == 1 ? CAIRN_F(0.5) : i == 9 ? CAIRN_F(-0.1) : CAIRN_F(1);
    model->damping = i % 5 == 2 ? CAIRN_F(0.4) : 0;
    model->angular_damping = i % 7 == 3 ? CAIRN_F(2) : 0;
    model->fixed_position = i == 8;
    model->sensor = i == 13;
}

static void tie(cairn_world *world, cairn_body_id a, cairn_body_id b, int i)
{
    cairn_spring_def def = cairn_spring_def_default(a, b);
    def.stiffness = cairn_wide_from_int(30 * i);
    def.damping = cairn_wide_from_int(i);
    def.no_contact = i % 2 == 0;
    (void)cairn_spring_create(world, &def);
}
#define WATCH &cairn_continuous
#else
static cairn_status have_more(const cairn_world *world, int turn) { return (void)world, (void)turn, CAIRN_OK; }
static void make_odd(const cairn_body_model *model, int i) { (void)model, (void)i; }
static void tie(const cairn_world *world, cairn_body_id a, cairn_body_id b, int i) { (void)world, (void)a, (void)b, (void)i; }
#define WATCH NULL
#endif

static int play(cairn_vec2 gravity, int turn)
{
    cairn_polygon wedge, stone;
    cairn_world *world = cairn_world_init_with(&yard, gravity, &cairn_solver_small, WATCH);
    cairn_body_id before = cairn_body_id_null();
    if (world == NULL || cairn_polygon_init_regular(&wedge, 3, CAIRN_F(0.45)) != CAIRN_OK || cairn_polygon_init_regular(&stone, 7, CAIRN_F(0.4)) != CAIRN_OK) {
        return 1;
    }
    if (have_more(world, turn) != CAIRN_OK) {
        return 1;
    }
    const cairn_shape *const shapes[] = { &ball, &crate, &wedge.shape, &plank, &stone.shape };
    cairn_body_create(world, &ground, cairn_vec2_of(0, CAIRN_F(-0.5)), 0);
    cairn_body_create(world, &post, cairn_vec2_of(CAIRN_F(-4.5), CAIRN_F(10)), 0);
    cairn_body_create(world, &post, cairn_vec2_of(CAIRN_F(4.5), CAIRN_F(10)), 0);
    cairn_body_create(world, &slide, cairn_vec2_of(CAIRN_F(-3), CAIRN_F(2)), CAIRN_DEGREES(-25));
    cairn_body_id lifted = cairn_body_create(world, &lift, cairn_vec2_of(CAIRN_F(2), CAIRN_F(1)), 0);
    for (int i = 0; i < THINGS; i++) {
        models[i] = cairn_body_model_default(shapes[(i + turn) % 5]);
        models[i].material = materials[(i * 2 + turn) % 5];
        models[i].density = i % 3 == 0 ? cairn_wide_from_int(1) : cairn_wide_from_real(i % 3 == 1 ? CAIRN_F(0.1) : CAIRN_F(20));
        models[i].fixed_rotation = i == 7;
        make_odd(&models[i], i);
        cairn_body_id id = cairn_body_create(world, &models[i], cairn_vec2_of(CAIRN_F(-3) + i % 5 * CAIRN_F(1.5) + i * 700, CAIRN_F(3.5) + i / 5 * CAIRN_F(1.1)),
                                             CAIRN_DEGREES(17) * (i % 10));
        (void)cairn_body_set_velocity(world, id, cairn_vec2_of(CAIRN_F(0.7) * (i % 7 - 3), i == 11 ? CAIRN_F(-60) : CAIRN_F(0.5) * (i % 3)));
        (void)cairn_body_set_angular_velocity(world, id, CAIRN_F(0.9) * (i % 5 - 2));
        if (i % 4 == 1) {
            tie(world, before, id, i);
        }
        before = id;
    }
    for (int step = 0; step < STEPS; step++) {
        (void)cairn_body_set_velocity(world, lifted, cairn_vec2_of(0, step % 120 < 60 ? CAIRN_F(0.6) : CAIRN_F(-0.6)));
        if (cairn_world_step(world) != CAIRN_OK) {
            return 1;
        }
        if (step % EACH == EACH - 1) {
            const cairn_world_stats *stats = cairn_world_get_stats(world);
            printf("%d %08lx %u %u %lu\n", step + 1, (unsigned long)cairn_world_hash(world), stats->arbiters, stats->points, (unsigned long)stats->saturations);
        }
    }
    return cairn_world_error(world) == CAIRN_OK ? 0 : 1;
}

int main(void)
{
    static const cairn_vec2 gravities[] = { { CAIRN_F(0), CAIRN_F(-10) }, { CAIRN_F(0.5), CAIRN_F(-9.81) }, { CAIRN_F(-3.3), CAIRN_F(-1.62) }, { CAIRN_F(1), CAIRN_F(-24.79) } };
    const cairn_body_model still = CAIRN_BODY_MODEL(CAIRN_STATIC, &floor_shape, &rough);
    ground = post = slide = still;
    post.shape = &post_shape;
    post.material = &slick;
    slide.shape = &slide_shape;
    lift = slide;
    lift.type = CAIRN_KINEMATIC;
    for (int i = 0; i < 4; i++) {
        if (play(gravities[i], i) != 0) {
            return 1;
        }
    }
    return 0;
}
