// A game in C++: every initialiser and declaration of the headers, and one function of each.
#include <cairn/cairn.h>

namespace {

CAIRN_WORLD(yard, 8, 16);
CAIRN_SPRINGS(ropes, 4);
CAIRN_SPRING_MESHES(meshes, 4, 4, 64);
CAIRN_QUADTREE(tree, 8, 8, 32);
CAIRN_BLOCKS(blocks);

constexpr auto memory = CAIRN_WORLD_BYTES(8, 16) + CAIRN_SPRINGS_BYTES(4) + CAIRN_SPRING_MESHES_BYTES(4, 4, 64)
                               + CAIRN_QUADTREE_BYTES(8, 8, 32) + CAIRN_BLOCKS_BYTES;
static_assert(memory > 0, "all sizes are constants");

constexpr cairn_material rubber = CAIRN_MATERIAL(1.2, 1.0);
constexpr cairn_material flubber = CAIRN_MATERIAL_BOUNCING(0.5, 0.4, 0.9, 0.5);
constexpr cairn_shape box = CAIRN_BOX(CAIRN_F(20), CAIRN_F(1));
constexpr cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.25));
constexpr cairn_body_model ground = CAIRN_BODY_MODEL(CAIRN_STATIC, &box, &rubber);
constexpr cairn_body_model marble = CAIRN_BODY_MODEL(CAIRN_DYNAMIC, &ball, &flubber);
cairn_polygon wedge;
int drawn;

bool enable(cairn_world *world)
{
    return cairn_springs_enable(world, &ropes) == CAIRN_OK && cairn_meshes_enable(world, &meshes) == CAIRN_OK
           && cairn_quadtree_enable(world, &tree, cairn_vec2_of(0, 0), 6, 5) == CAIRN_OK
           && cairn_blocks_enable(world, &blocks) == CAIRN_OK && cairn_sleep_enable(world) == CAIRN_OK;
}

// The functions of numbers are C's, too.
bool numbers()
{
    return cairn_real_sqrt(CAIRN_F(4)) == CAIRN_F(2) && cairn_real_divide(CAIRN_F(1), CAIRN_F(2)) == CAIRN_F(0.5)
           && cairn_real_length(CAIRN_F(3), CAIRN_F(4)) == CAIRN_F(5)
           && cairn_angle_of(0, CAIRN_F(1)) == CAIRN_DEGREES(0) && CAIRN_RADIANS(0) == 0;
}

} // namespace

int main()
{
    cairn_world *world = cairn_world_init(&yard, cairn_vec2_of(0, CAIRN_F(-10)));
    const cairn_vec2 corners[] = {{0, 0}, {CAIRN_F(1), 0}, {0, CAIRN_F(1)}};
    if (!enable(world) || !numbers() || cairn_polygon_init(&wedge, corners, 3) != CAIRN_OK)
        return 1;
    cairn_body_model model = cairn_body_model_default(&wedge.shape);
    model.density = CAIRN_DENSITY(7.8);
    cairn_body_create(world, &ground, cairn_vec2_of(0, CAIRN_F(-0.5)), CAIRN_DEGREES(180));
    const cairn_body_id a = cairn_body_create(world, &marble, cairn_vec2_of(0, CAIRN_F(3)), CAIRN_RADIANS(1));
    const cairn_body_id b = cairn_body_create(world, &model, cairn_vec2_of(CAIRN_F(1), CAIRN_F(3)), 0);
    cairn_spring_def rope = cairn_spring_def_default(a, b);
    rope.stiffness = cairn_wide_from_int(100);
    rope.damping = cairn_wide_from_real(CAIRN_F(0.5));
    if (cairn_spring_id_is_null(cairn_spring_create(world, &rope)))
        return 2;
    for (int step = 0; step < 60; step++)
        (void)cairn_world_step(world);
    cairn_debug_draw draw = {};
    draw.circle = [](void *, cairn_body_id, cairn_draw_state, cairn_vec2, cairn_real, cairn_vec2) { drawn++; };
    cairn_ray_hit hit;
    if (cairn_query_ray(world, cairn_vec2_of(CAIRN_F(9), CAIRN_F(9)), cairn_vec2_of(CAIRN_F(9), CAIRN_F(-9)), 0xFFFF, &hit) != CAIRN_OK)
        return 3;
    if (cairn_debug_draw_bodies(world, &draw) != CAIRN_OK || drawn != 1 || hit.body.index != 1)
        return 4;
    return cairn_body_position(world, a).y < CAIRN_F(2.9) ? 0 : 5;
}
