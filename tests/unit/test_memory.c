/* What a world takes of RAM: what the macros say is what they declare, and on a 32-bit core what the README says, in numbers. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */
#include <cairn/spring_mesh.h>

/* C99 has no _Static_assert: an array of less than one place is no type. */
#define HOLDS(name, condition) typedef char name[(condition) ? 1 : -1]
#define HOLDS_ON_32_BITS(name, condition) HOLDS(name, sizeof(void *) != 4 || (condition))

CAIRN_WORLD(shed, 1, 1);
CAIRN_WORLD(field, 33, 65);
CAIRN_SPRINGS(ropes, 7);
CAIRN_QUADTREE(trees, 33, 9, 70);
CAIRN_BLOCKS(heavies);
CAIRN_SPRING_MESHES(nets, 5, 9, 81);

#define WORLD_TAKES(name) \
    (sizeof name##_world + sizeof name##_bodies + sizeof name##_arbiters + sizeof name##_order + sizeof name##_swept + sizeof name##_sorted)

HOLDS(the_smallest_world, CAIRN_WORLD_BYTES(1, 1) == WORLD_TAKES(shed));
HOLDS(a_world, CAIRN_WORLD_BYTES(33, 65) == WORLD_TAKES(field));
HOLDS(springs, CAIRN_SPRINGS_BYTES(7) == sizeof ropes_pool + sizeof ropes_springs);
HOLDS(a_quadtree, CAIRN_QUADTREE_BYTES(33, 9, 70) == sizeof trees_tree + sizeof trees_boxes + sizeof trees_cells + sizeof trees_entries);
HOLDS(blocks, CAIRN_BLOCKS_BYTES == sizeof heavies);
HOLDS(meshes, CAIRN_SPRING_MESHES_BYTES(5, 9, 81)
                  == sizeof nets_mesh + sizeof nets_parts + sizeof nets_nodes + sizeof nets_rows + sizeof nets_links + sizeof nets_entries);

HOLDS_ON_32_BITS(a_world_in_bytes, CAIRN_WORLD_BYTES(33, 65) == 216 + 74 * 33 + 84 * 65);
HOLDS_ON_32_BITS(a_game_of_balls_and_walls, CAIRN_WORLD_BYTES(16, 16) == 2744);
HOLDS_ON_32_BITS(springs_in_bytes, CAIRN_SPRINGS_BYTES(7) == 24 + 156 * 7);
HOLDS_ON_32_BITS(a_quadtree_in_bytes, CAIRN_QUADTREE_BYTES(33, 9, 70) == 36 + 8 * 33 + 6 * 9 + 4 * 70);
HOLDS_ON_32_BITS(blocks_in_bytes, CAIRN_BLOCKS_BYTES == 2352);
HOLDS_ON_32_BITS(meshes_in_bytes, CAIRN_SPRING_MESHES_BYTES(5, 9, 81) == 44 + 120 * 5 + 40 * 9 + 4 * 81);

void setUp(void) { open_yard(CAIRN_F(-10)); }
void tearDown(void) {}

/* Nothing beside what was declared is used: each pool is full with as many as it was declared for. */
void test_a_world_holds_as_many_bodies_as_were_paid_for(void)
{
    static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.1));
    const cairn_body_model model = cairn_body_model_default(&ball);
    cairn_world *small = cairn_world_init(&shed, at(0, 0));
    TEST_ASSERT_NOT_NULL(small);
    TEST_ASSERT_FALSE(cairn_body_id_is_null(cairn_body_create(small, &model, at(0, 0), 0)));
    TEST_ASSERT_TRUE(cairn_body_id_is_null(cairn_body_create(small, &model, at(0, 0), 0)));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_FULL, cairn_world_error(small));
}

void test_all_that_is_declared_beside_a_world_is_taken(void)
{
    cairn_world *large = cairn_world_init(&field, at(0, 0));
    TEST_ASSERT_NOT_NULL(large);
    ASSERT_OK(cairn_springs_enable(large, &ropes));
    ASSERT_OK(cairn_meshes_enable(large, &nets));
    ASSERT_OK(cairn_quadtree_enable(large, &trees, at(0, 0), 6, 6));
    ASSERT_OK(cairn_blocks_enable(large, &heavies));
    ASSERT_OK(cairn_world_step(large));
}
