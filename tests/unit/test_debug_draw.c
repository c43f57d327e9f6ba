/* Debug drawing calls back once for each thing there is, with what it is and where. */
#include <cairn/cairn.h>
#include <unity.h>

#include "bodies.h"
#include "test_number.h"

enum { BODIES = 40, ARBITERS = 80, CALLS = 200 };

CAIRN_WORLD(memory, BODIES, ARBITERS);
CAIRN_SPRINGS(spring_memory, 4);
CAIRN_QUADTREE(tree_memory, 64, 64, 256);

#define V(x, y) cairn_vec2_of(CAIRN_F(x), CAIRN_F(y))
#define ERROR 3.1e-5

static const cairn_shape circle = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(4), CAIRN_F(2));
static const cairn_shape floor_shape = CAIRN_BOX(CAIRN_F(20), CAIRN_F(1));

/* What was drawn. */
typedef struct record {
    int circles, polygons, contacts, cells, springs;
    cairn_draw_state states[CALLS];
    cairn_body_id bodies[CALLS];
    cairn_vec2 center, axis, corners[CAIRN_MAX_VERTICES];
    cairn_real radius;
    int corner_count;
    cairn_contact contact;
    int bodies_in_cells, deepest;
    double cell_area;
    cairn_spring_id spring;
    cairn_vec2 a, b;
    cairn_real rest_length;
} record;

static cairn_world *world;
static record drawn;

static void assert_locked(void)
{
    TEST_ASSERT_EQUAL(CAIRN_ERROR_LOCKED, cairn_world_set_gravity(world, V(0, 0)));
}

static void on_circle(void *context, cairn_body_id body, cairn_draw_state state, cairn_vec2 center, cairn_real radius, cairn_vec2 axis)
{
    record *r = (record *)context;
    r->bodies[r->circles + r->polygons] = body;
    r->states[r->circles + r->polygons] = state;
    r->circles++;
    r->center = center;
    r->radius = radius;
    r->axis = axis;
    assert_locked();
}

static void on_polygon(void *context, cairn_body_id body, cairn_draw_state state, const cairn_vec2 *corners, int count)
{
    record *r = (record *)context;
    r->bodies[r->circles + r->polygons] = body;
    r->states[r->circles + r->polygons] = state;
    r->polygons++;
    r->corner_count = count;
    memcpy(r->corners, corners, (size_t)count * sizeof *corners);
    assert_locked();
}

static void on_contact(void *context, const cairn_contact *contact)
{
    record *r = (record *)context;
    r->contacts++;
    r->contact = *contact;
    assert_locked();
}

static void on_cell(void *context, cairn_vec2 lower, cairn_real size, int depth, int bodies)
{
    record *r = (record *)context;
    (void)lower;
    r->cells++;
    r->bodies_in_cells += bodies;
    r->deepest = depth > r->deepest ? depth : r->deepest;
    r->cell_area += number_of_real(size) * number_of_real(size);
    assert_locked();
}

static void on_spring(void *context, cairn_spring_id spring, cairn_vec2 a, cairn_vec2 b, cairn_real rest_length)
{
    record *r = (record *)context;
    r->springs++;
    r->spring = spring;
    r->a = a;
    r->b = b;
    r->rest_length = rest_length;
    assert_locked();
}

static const cairn_debug_draw all = { &drawn, on_circle, on_polygon, on_contact, on_cell, on_spring };
static const cairn_debug_draw nothing = { NULL, NULL, NULL, NULL, NULL, NULL };

void setUp(void)
{
    memset(&drawn, 0, sizeof drawn);
    world = cairn_world_init(&memory, V(0, -10));
}

void tearDown(void) {}

static cairn_body_id put(const cairn_shape *shape, cairn_vec2 position, cairn_angle angle, cairn_body_type type, bool sensor)
{
    yard_def def = def_at(shape, 0, 0);
    def.position = position;
    def.angle = angle;
    def.type = type;
    def.sensor = sensor;
    cairn_body_id id = make_in(world, &def);
    TEST_ASSERT_FALSE(cairn_body_id_is_null(id));
    return id;
}

static void assert_vec2(double x, double y, cairn_vec2 actual)
{
    TEST_ASSERT_DOUBLE_WITHIN(ERROR, x, number_of_real(actual.x));
    TEST_ASSERT_DOUBLE_WITHIN(ERROR, y, number_of_real(actual.y));
}

/* The world is free again afterwards. */
static void assert_unlocked(void) { TEST_ASSERT_EQUAL(CAIRN_OK, cairn_world_set_gravity(world, V(0, -10))); }

/* ---- bodies ---- */

void test_a_circle_is_drawn_with_an_axis_that_turns(void)
{
    put(&circle, V(1, 2), CAIRN_DEGREES(30), CAIRN_DYNAMIC, false);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_bodies(world, &all));
    TEST_ASSERT_EQUAL(1, drawn.circles);
    TEST_ASSERT_EQUAL(0, drawn.polygons);
    assert_vec2(1, 2, drawn.center);
    assert_vec2(0.86602540378443865, 0.5, drawn.axis);
    TEST_ASSERT_TRUE(drawn.radius == CAIRN_F(0.5));
    assert_unlocked();
}

void test_a_turned_box_is_drawn_with_its_corners(void)
{
    put(&box, V(10, 20), CAIRN_DEGREES(90), CAIRN_DYNAMIC, false);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_bodies(world, &all));
    TEST_ASSERT_EQUAL(1, drawn.polygons);
    TEST_ASSERT_EQUAL(4, drawn.corner_count);
    assert_vec2(11, 22, drawn.corners[0]); /* (2, -1) by a quarter turn is (1, 2); corners go on counter-clockwise */
    assert_vec2(9, 22, drawn.corners[1]);
    assert_vec2(9, 18, drawn.corners[2]);
    assert_vec2(11, 18, drawn.corners[3]);
}

void test_a_polygon_is_drawn_where_its_points_were_given(void)
{
    static const cairn_vec2 points[] = { { 0, 0 }, { CAIRN_F(3), 0 }, { 0, CAIRN_F(3) } };
    cairn_polygon triangle;
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init(&triangle, points, 3));
    put(&triangle.shape, V(100, 50), 0, CAIRN_DYNAMIC, false);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_bodies(world, &all));
    TEST_ASSERT_EQUAL(3, drawn.corner_count);
    assert_vec2(100, 50, drawn.corners[0]);
    assert_vec2(103, 50, drawn.corners[1]);
    assert_vec2(100, 53, drawn.corners[2]);
}

void test_bodies_are_drawn_in_the_order_of_the_pool_by_their_state(void)
{
    cairn_body_id ids[6];
    ids[0] = put(&floor_shape, V(0, -0.5), 0, CAIRN_STATIC, false);
    ids[1] = put(&circle, V(0, 0.5), 0, CAIRN_DYNAMIC, false);
    ids[2] = put(&circle, V(30, 5), 0, CAIRN_KINEMATIC, false);
    ids[3] = put(&box, V(-30, 5), 0, CAIRN_STATIC, true);
    ids[4] = put(&circle, V(5, 5), 0, CAIRN_DYNAMIC, false);
    ids[5] = put(&circle, V(0, 1000), 0, CAIRN_DYNAMIC, false);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_body_destroy(world, ids[4]));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_sleep_enable(world));
    for (int i = 0; i < 60; i++) {
        cairn_world_step(world);
    }
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_bodies(world, &all));
    TEST_ASSERT_EQUAL(3, drawn.circles);
    TEST_ASSERT_EQUAL(2, drawn.polygons);
    TEST_ASSERT_TRUE(cairn_body_id_equal(ids[0], drawn.bodies[0]));
    TEST_ASSERT_TRUE(cairn_body_id_equal(ids[1], drawn.bodies[1]));
    TEST_ASSERT_TRUE(cairn_body_id_equal(ids[2], drawn.bodies[2]));
    TEST_ASSERT_TRUE(cairn_body_id_equal(ids[3], drawn.bodies[3]));
    TEST_ASSERT_TRUE(cairn_body_id_equal(ids[5], drawn.bodies[4]));
    TEST_ASSERT_EQUAL(CAIRN_DRAW_STATIC, drawn.states[0]);
    TEST_ASSERT_EQUAL(CAIRN_DRAW_ASLEEP, drawn.states[1]);
    TEST_ASSERT_EQUAL(CAIRN_DRAW_KINEMATIC, drawn.states[2]);
    TEST_ASSERT_EQUAL(CAIRN_DRAW_SENSOR, drawn.states[3]);
    TEST_ASSERT_EQUAL(CAIRN_DRAW_DYNAMIC, drawn.states[4]);
}

/* ---- contacts ---- */

void test_each_contact_is_drawn_once(void)
{
    cairn_body_id floor = put(&floor_shape, V(0, -0.5), 0, CAIRN_STATIC, false);
    cairn_body_id crate = put(&box, V(0, 1), 0, CAIRN_DYNAMIC, false);
    put(&circle, V(5, 0.5), 0, CAIRN_DYNAMIC, false);
    put(&circle, V(8, 9), 0, CAIRN_DYNAMIC, false);
    cairn_world_step(world);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_contacts(world, &all));
    TEST_ASSERT_EQUAL(2, drawn.contacts);
    cairn_world_step(world);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_body_set_transform(world, crate, V(0, 1), 0));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_contacts(world, &all));
    TEST_ASSERT_EQUAL(3, drawn.contacts); /* the teleported crate has left its contact */
    TEST_ASSERT_TRUE(cairn_body_id_equal(floor, drawn.contact.a));
    assert_vec2(0, 1, drawn.contact.normal);
    TEST_ASSERT_EQUAL(1, drawn.contact.count);
    TEST_ASSERT_TRUE(drawn.contact.touching);
    assert_unlocked();
}

/* ---- cells ---- */

void test_leaves_of_the_quadtree_tile_its_square(void)
{
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_cells(world, &all));
    TEST_ASSERT_EQUAL(0, drawn.cells); /* no tree, no cells */
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_quadtree_enable(world, &tree_memory, V(0, 0), 5, 4));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_cells(world, &all));
    TEST_ASSERT_EQUAL(1, drawn.cells); /* before the first step: the root alone */
    memset(&drawn, 0, sizeof drawn);
    for (int i = 0; i < 36; i++) {
        put(&circle, cairn_vec2_of(cairn_real_from_int(i % 6 * 2 + 1), cairn_real_from_int(i / 6 * 2 + 1)), 0, CAIRN_DYNAMIC, false);
    }
    cairn_world_step(world);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_cells(world, &all));
    TEST_ASSERT_EQUAL((cairn_world_get_stats(world)->tree_cells - 1) / 4 * 3 + 1, drawn.cells); /* each split turns one leaf to four */
    TEST_ASSERT_TRUE(drawn.cells > 4);
    TEST_ASSERT_TRUE(drawn.deepest >= 2);
    TEST_ASSERT_TRUE(drawn.deepest <= 4);
    TEST_ASSERT_EQUAL(cairn_world_get_stats(world)->tree_entries, drawn.bodies_in_cells);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 32 * 32, drawn.cell_area);
    assert_unlocked();
}

/* ---- springs ---- */

void test_each_spring_is_drawn_from_anchor_to_anchor(void)
{
    cairn_body_id a = put(&box, V(0, 0), 0, CAIRN_STATIC, false), b = put(&circle, V(10, 0), CAIRN_DEGREES(90), CAIRN_DYNAMIC, false);
    cairn_spring_def def = cairn_spring_def_default(a, b);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_springs(world, &all)); /* a world without springs */
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_springs_enable(world, &spring_memory));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_springs(world, &all));
    TEST_ASSERT_EQUAL(0, drawn.springs);
    def.anchor_a = V(2, 1);
    def.anchor_b = V(0.25, 0);
    def.rest_length = CAIRN_F(7.5);
    def.stiffness = cairn_wide_from_int(10);
    cairn_spring_id first = cairn_spring_create(world, &def), second = cairn_spring_create(world, &def);
    TEST_ASSERT_FALSE(cairn_spring_id_is_null(second));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_springs(world, &all));
    TEST_ASSERT_EQUAL(2, drawn.springs);
    TEST_ASSERT_EQUAL(second.index, drawn.spring.index);
    assert_vec2(2, 1, drawn.a);
    assert_vec2(10, 0.25, drawn.b);
    TEST_ASSERT_DOUBLE_WITHIN(ERROR, 7.5, number_of_real(drawn.rest_length));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_spring_destroy(world, second));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_springs(world, &all));
    TEST_ASSERT_EQUAL(3, drawn.springs);
    TEST_ASSERT_EQUAL(first.index, drawn.spring.index);
    assert_unlocked();
}

/* ---- callbacks may be missing, arguments may not ---- */

void test_missing_callbacks_are_passed_over(void)
{
    cairn_body_id a = put(&floor_shape, V(0, -0.5), 0, CAIRN_STATIC, false), b = put(&circle, V(0, 0.5), 0, CAIRN_DYNAMIC, false);
    cairn_spring_def def = cairn_spring_def_default(a, b);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_springs_enable(world, &spring_memory));
    TEST_ASSERT_FALSE(cairn_spring_id_is_null(cairn_spring_create(world, &def)));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_quadtree_enable(world, &tree_memory, V(0, 0), 5, 4));
    cairn_world_step(world);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_bodies(world, &nothing));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_contacts(world, &nothing));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_cells(world, &nothing));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_debug_draw_springs(world, &nothing));
    assert_unlocked();
}

void test_null_is_refused(void)
{
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_debug_draw_bodies(NULL, &all));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_debug_draw_bodies(world, NULL));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_debug_draw_contacts(NULL, &all));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_debug_draw_contacts(world, NULL));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_debug_draw_cells(NULL, &all));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_debug_draw_cells(world, NULL));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_debug_draw_springs(NULL, &all));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_debug_draw_springs(world, NULL));
}
