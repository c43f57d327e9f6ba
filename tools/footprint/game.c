/*
 * A tiny game of one feature set, linked to be weighed and read by its symbols (tools/cairn footprint), never run: it calls
 * what creates or enables each feature that is named by a WITH_ of 1, and steps. The sets are in CMakeLists.txt beside this.
 * Without any, it is what an image is without Cairn.
 */
#include <cairn/cairn.h>

#if WITH_BALLS || WITH_BOXES

CAIRN_WORLD(yard, BODIES, ARBITERS);

#if WITH_CONTINUOUS
static const cairn_continuous_class *const continuous = &cairn_continuous;
#else
static const cairn_continuous_class *const continuous = NULL;
#endif
#if WITH_SLIDES
static const cairn_solver_class *const solver = &cairn_solver_slides;
#elif WITH_SMALL
static const cairn_solver_class *const solver = &cairn_solver_small;
#else
static const cairn_solver_class *const solver = &cairn_solver_soft;
#endif

#if WITH_RESTITUTION
static const cairn_material rubber = CAIRN_MATERIAL_BOUNCING(0.9, 0.7, 0.8, 0.5);
#elif CAIRN_WITH_FRICTION
static const cairn_material rubber = CAIRN_MATERIAL(0.9, 0.7);
#else
static const cairn_material rubber = CAIRN_MATERIAL(0, 0);
#endif
#if CAIRN_WITH_FRICTION
#define STONE cairn_material_default
#else
#define STONE rubber
#endif
#if WITH_BALLS
static const cairn_shape ball_shape = CAIRN_CIRCLE(CAIRN_F(0.25));
#else
static const cairn_shape ball_shape = CAIRN_BOX(CAIRN_F(0.5), CAIRN_F(0.5));
#endif
static const cairn_body_model ball = {
    .shape = &ball_shape, .material = &rubber, .type = CAIRN_DYNAMIC, .density = CAIRN_DENSITY(1), .gravity_scale = CAIRN_F(1), .layer = 1, .mask = 0xFFFF,
    .fixed_rotation = !CAIRN_WITH_TURNING,
};

#if WITH_WALLS || WITH_BOXES
static const cairn_shape wall_shape = CAIRN_BOX(CAIRN_F(20), CAIRN_F(1));
#else
static const cairn_shape wall_shape = CAIRN_CIRCLE(CAIRN_F(10));
#endif
static const cairn_body_model wall = CAIRN_BODY_MODEL(CAIRN_STATIC, &wall_shape, &STONE);

#if WITH_BOXES
static const cairn_shape crate_shape = CAIRN_BOX(CAIRN_F(1), CAIRN_F(0.5));
static const cairn_body_model crate = CAIRN_BODY_MODEL(CAIRN_DYNAMIC, &crate_shape, &STONE);
#endif
#if WITH_POLYGONS || WITH_HULLS
static cairn_polygon stone;
static const cairn_body_model stone_model = CAIRN_BODY_MODEL(CAIRN_DYNAMIC, &stone.shape, &STONE);
#endif
#if WITH_QUERIES
static bool see(void *context, cairn_body_id id)
{
    (void)context;
    return !cairn_body_id_is_null(id);
}
#endif
#if WITH_DRAWING
cairn_debug_draw draw __attribute__((used)); /* as if the game put its functions there: else the compiler sees that it does not */
#endif
#if WITH_SPRINGS
CAIRN_SPRINGS(ropes, 8);
#endif
#if WITH_MESHES
CAIRN_SPRING_MESHES(nets, 8, 8, 64);
#endif
#if WITH_BLOCKS
CAIRN_BLOCKS(heavies);
#endif
#if WITH_QUADTREE
CAIRN_QUADTREE(tree, BODIES, BODIES, 4 * BODIES);
#endif

int main(void)
{
    cairn_world *world = cairn_world_init_with(&yard, cairn_vec2_of(0, CAIRN_F(-10)), solver, continuous);
    cairn_body_create(world, &wall, cairn_vec2_of(0, 0), 0);
    cairn_body_id id = cairn_body_create(world, &ball, cairn_vec2_of(0, CAIRN_F(3)), 0);
#if WITH_BOXES
    cairn_body_create(world, &crate, cairn_vec2_of(CAIRN_F(2), CAIRN_F(3)), 0);
#endif
#if WITH_POLYGONS
    cairn_polygon_init_regular(&stone, 5, CAIRN_F(0.5));
#endif
#if WITH_HULLS
    static const cairn_vec2 points[3] = { { 0, 0 }, { CAIRN_F(1), 0 }, { 0, CAIRN_F(1) } };
    cairn_polygon_init(&stone, points, 3);
    cairn_polygon_init_hull(&stone, points, 3);
#endif
#if WITH_POLYGONS || WITH_HULLS
    cairn_body_create(world, &stone_model, cairn_vec2_of(CAIRN_F(4), CAIRN_F(3)), 0);
#endif
#if WITH_SPRINGS
    cairn_springs_enable(world, &ropes);
    cairn_spring_def rope = cairn_spring_def_default(id, id);
    cairn_spring_tune(world, &rope, CAIRN_F(2), CAIRN_F(0.5));
    cairn_spring_destroy(world, cairn_spring_create(world, &rope));
#endif
#if WITH_MESHES
    cairn_meshes_enable(world, &nets);
#endif
#if WITH_BLOCKS
    cairn_blocks_enable(world, &heavies);
#endif
#if WITH_QUADTREE
    cairn_quadtree_enable(world, &tree, cairn_vec2_of(0, 0), 6, 6);
#endif
#if WITH_SLEEP
    cairn_sleep_enable(world);
#endif
    while (cairn_body_position(world, id).y > 0) {
        cairn_world_step(world);
#if WITH_CONTACTS
        cairn_contact contact;
        for (int cursor = 0; cairn_world_next_contact(world, &cursor, &contact);) {
        }
#endif
#if WITH_FORCES
        cairn_body_apply_force_at(world, id, cairn_vec2_of(1, 0), cairn_vec2_of(0, 1));
        cairn_body_apply_torque(world, id, 1);
        cairn_body_apply_impulse_at(world, id, cairn_vec2_of(1, 0), cairn_vec2_of(0, 1));
        cairn_body_apply_angular_impulse(world, id, 1);
#endif
#if WITH_CHANGES
        cairn_body_set_velocity(world, id, cairn_body_velocity(world, id));
        cairn_body_set_angular_velocity(world, id, cairn_body_angular_velocity(world, id));
        cairn_body_set_transform(world, id, cairn_body_to_world(world, id, cairn_vec2_of(0, 0)), cairn_body_angle(world, id));
        cairn_body_set_model(world, id, cairn_body_get_model(world, id));
        cairn_body_destroy(world, id);
        cairn_world_set_rate(world, CAIRN_F(30));
#endif
#if WITH_QUERIES
        cairn_ray_hit hit;
        cairn_query_ray(world, cairn_vec2_of(0, 0), cairn_vec2_of(0, CAIRN_F(9)), 1, &hit);
        cairn_query_point(world, cairn_vec2_of(0, 0), 1, see, NULL);
        cairn_query_box(world, cairn_vec2_of(0, 0), cairn_vec2_of(1, 1), 1, see, NULL);
#endif
#if WITH_DRAWING
        cairn_debug_draw_bodies(world, &draw);
        cairn_debug_draw_contacts(world, &draw);
#if WITH_QUADTREE
        cairn_debug_draw_cells(world, &draw);
#endif
#if WITH_SPRINGS
        cairn_debug_draw_springs(world, &draw);
#endif
#endif
#if WITH_HASH
        if (cairn_world_hash(world) == 0) {
            break;
        }
#endif
    }
    return 0;
}

#else

int main(void)
{
    return 0;
}

#endif
