/* The engine's debug drawing on a canvas: states look different, layers are told apart. */
#include "debug_view.h"

#include "unity.h"

CAIRN_WORLD(yard, 8, 8);
CAIRN_SPRINGS(ropes, 2);
CAIRN_QUADTREE(tree, 8, 8, 32);

static draw_canvas canvas;
static cairn_world *world;
static const draw_view view = {{0, 0}, 64, 32, 16};
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1)), ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_body_model ground = CAIRN_BODY_MODEL(CAIRN_STATIC, &box, &cairn_material_default);
static const cairn_body_model crate = CAIRN_BODY_MODEL(CAIRN_DYNAMIC, &box, &cairn_material_default);
static const cairn_body_model marble = CAIRN_BODY_MODEL(CAIRN_DYNAMIC, &ball, &cairn_material_default);

void setUp(void)
{
    draw_clear(&canvas, 0);
    world = cairn_world_init(&yard, cairn_vec2_of(0, CAIRN_F(-10)));
}

static void show(unsigned shown)
{
    const draw_layers layers = {shown, 0, 0};
    draw_world(&canvas, &view, world, &layers);
}

static int lit(void)
{
    int count = 0;
    for (int y = 0; y < DRAW_HEIGHT; y++)
        for (int x = 0; x < DRAW_WIDTH; x++)
            count += draw_get(&canvas, x, y) != 0;
    return count;
}

void test_the_view_puts_the_world_where_it_says(void)
{
    const draw_point p = draw_view_point(&view, cairn_vec2_of(CAIRN_F(1), CAIRN_F(0.5)));
    TEST_ASSERT_EQUAL((64 + 16) * DRAW_SUB, p.x);
    TEST_ASSERT_EQUAL((32 - 8) * DRAW_SUB, p.y);
}

void test_states_look_different(void)
{
    (void)cairn_body_create(world, &ground, cairn_vec2_of(CAIRN_F(-2), 0), 0);
    (void)cairn_body_create(world, &crate, cairn_vec2_of(0, 0), 0);
    (void)cairn_body_create(world, &marble, cairn_vec2_of(CAIRN_F(2), 0), 0);
    show(DRAW_LAYER_SHAPES);
    TEST_ASSERT_NOT_EQUAL(draw_get(&canvas, 32, 32), draw_get(&canvas, 64, 32));
    TEST_ASSERT_NOT_EQUAL(draw_get(&canvas, 24, 32), draw_get(&canvas, 56, 32));
    TEST_ASSERT_EQUAL(15, draw_get(&canvas, 100, 32)); /* the mark of the marble, along x */
    TEST_ASSERT_NOT_EQUAL(15, draw_get(&canvas, 92, 32));
}

void test_no_layer_draws_nothing(void)
{
    (void)cairn_body_create(world, &crate, cairn_vec2_of(0, 0), 0);
    show(0);
    TEST_ASSERT_EQUAL(0, lit());
}

void test_contacts_have_their_own_layer(void)
{
    (void)cairn_body_create(world, &ground, cairn_vec2_of(0, 0), 0);
    (void)cairn_body_create(world, &crate, cairn_vec2_of(0, CAIRN_F(0.999)), 0);
    (void)cairn_world_step(world);
    show(DRAW_LAYER_CONTACTS);
    TEST_ASSERT_EQUAL(15, draw_get(&canvas, 56, 24));
    TEST_ASSERT_TRUE(lit() > 10 && lit() < 60);
}

void test_cells_and_springs_have_theirs(void)
{
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_springs_enable(world, &ropes));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_quadtree_enable(world, &tree, cairn_vec2_of(0, 0), 2, 3));
    const cairn_body_id a = cairn_body_create(world, &crate, cairn_vec2_of(CAIRN_F(-1), 0), 0);
    const cairn_body_id b = cairn_body_create(world, &crate, cairn_vec2_of(CAIRN_F(1.5), 0), 0);
    cairn_spring_def def = cairn_spring_def_default(a, b);
    def.stiffness = cairn_wide_from_int(10);
    TEST_ASSERT_FALSE(cairn_spring_id_is_null(cairn_spring_create(world, &def)));
    (void)cairn_world_step(world);
    show(DRAW_LAYER_SPRINGS);
    TEST_ASSERT_NOT_EQUAL(0, draw_get(&canvas, 66, 32));
    draw_clear(&canvas, 0);
    show(DRAW_LAYER_CELLS);
    TEST_ASSERT_TRUE(lit() > 30);
}

void test_a_layer_is_switched_only_after_select_was_held(void)
{
    draw_layers layers = {0, 0, 0};
    for (int i = 0; i < 5; i++)
        TEST_ASSERT_FALSE(draw_layers_step(&layers, CAIRN_BUTTON_SELECT));
    TEST_ASSERT_FALSE(draw_layers_step(&layers, CAIRN_BUTTON_SELECT | CAIRN_BUTTON_UP));
    for (int i = 0; i < 20; i++)
        TEST_ASSERT_FALSE(draw_layers_step(&layers, CAIRN_BUTTON_SELECT));
    TEST_ASSERT_TRUE(draw_layers_step(&layers, CAIRN_BUTTON_SELECT | CAIRN_BUTTON_DOWN));
    TEST_ASSERT_EQUAL(DRAW_LAYER_SPRINGS, layers.shown);
    TEST_ASSERT_FALSE(draw_layers_step(&layers, CAIRN_BUTTON_SELECT | CAIRN_BUTTON_DOWN));
    TEST_ASSERT_FALSE(draw_layers_step(&layers, 0));
    TEST_ASSERT_FALSE(draw_layers_step(&layers, CAIRN_BUTTON_UP));
}
