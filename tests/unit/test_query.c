/* Rays, points and boxes against closed forms; what a visitor may and may not do. */
#include <cairn/cairn.h>
#include <unity.h>

#include "bodies.h"
#include "test_number.h"

enum { BODIES = 16, ARBITERS = 32 };

CAIRN_WORLD(memory, BODIES, ARBITERS);

#define V(x, y) cairn_vec2_of(CAIRN_F(x), CAIRN_F(y))
#define ALL 0xFFFF

/* Of a point, normal or fraction: a step of Q16.16 for each of two roundings. */
#define ERROR 3.1e-5

static const cairn_shape unit_circle = CAIRN_CIRCLE(CAIRN_F(1));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(4), CAIRN_F(2));
static const cairn_shape square = CAIRN_BOX(CAIRN_F(2), CAIRN_F(2));
static const cairn_shape long_floor = CAIRN_BOX(CAIRN_F(240), CAIRN_F(2));
static const cairn_shape large_circle = CAIRN_CIRCLE(CAIRN_F(125));
static const cairn_shape small_circle = CAIRN_CIRCLE(CAIRN_F(0.009765625));

static cairn_world *world;

void setUp(void) { world = cairn_world_init(&memory, V(0, -10)); }
void tearDown(void) {}

static cairn_body_id put(const cairn_shape *shape, cairn_vec2 position, cairn_angle angle)
{
    yard_def def = def_at(shape, 0, 0);
    def.position = position;
    def.angle = angle;
    cairn_body_id id = make_in(world, &def);
    TEST_ASSERT_FALSE(cairn_body_id_is_null(id));
    return id;
}

static cairn_body_id put_special(const cairn_shape *shape, cairn_vec2 position, cairn_body_type type, uint16_t layer, bool sensor)
{
    yard_def def = def_at(shape, 0, 0);
    def.position = position;
    def.type = type;
    def.layer = layer;
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

static cairn_ray_hit cast(cairn_vec2 start, cairn_vec2 end)
{
    cairn_ray_hit hit;
    memset(&hit, 0x55, sizeof hit);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_ray(world, start, end, ALL, &hit));
    return hit;
}

static void assert_hit(cairn_body_id body, double x, double y, double nx, double ny, double fraction, cairn_ray_hit hit)
{
    TEST_ASSERT_TRUE(cairn_body_id_equal(body, hit.body));
    assert_vec2(x, y, hit.point);
    assert_vec2(nx, ny, hit.normal);
    TEST_ASSERT_DOUBLE_WITHIN(ERROR, fraction, number_of_real(hit.fraction));
}

static void assert_miss(cairn_ray_hit hit)
{
    TEST_ASSERT_TRUE(cairn_body_id_is_null(hit.body));
    assert_vec2(0, 0, hit.point);
    assert_vec2(0, 0, hit.normal);
    TEST_ASSERT_TRUE(hit.fraction == 0);
}

/* ---- rays and circles ---- */

void test_a_ray_through_the_centre_hits_a_circle_head_on(void)
{
    cairn_body_id id = put(&unit_circle, V(3, 1), 0);
    assert_hit(id, 2, 1, -1, 0, 0.2, cast(V(0, 1), V(10, 1)));
    assert_hit(id, 3, 2, 0, 1, 0.4, cast(V(3, 6), V(3, -4)));
}

void test_a_ray_beside_the_centre_hits_a_circle_at_the_chord(void)
{
    cairn_body_id id = put(&unit_circle, V(0, 0), 0);
    assert_hit(id, -0.8, 0.6, -0.8, 0.6, 0.42, cast(V(-5, 0.6), V(5, 0.6)));
    assert_hit(id, 0.6, -0.8, 0.6, -0.8, 0.525, cast(V(0.6, -5), V(0.6, 3)));
}

void test_a_ray_that_ends_before_or_starts_behind_a_circle_misses_it(void)
{
    put(&unit_circle, V(0, 0), 0);
    assert_miss(cast(V(-5, 0), V(-1.01, 0)));
    assert_miss(cast(V(1.01, 0), V(5, 0)));
    assert_miss(cast(V(-5, 1.01), V(5, 1.01)));
    assert_miss(cast(V(-2, 0.5), V(0.5, -2.0))); /* through the box about it, past the corner */
}

void test_a_ray_that_starts_inside_hits_at_once_and_has_no_normal(void)
{
    cairn_body_id ball = put(&unit_circle, V(0, 0), 0), crate = put(&box, V(10, 0), CAIRN_DEGREES(30));
    assert_hit(ball, 0.5, 0.25, 0, 0, 0, cast(V(0.5, 0.25), V(5, 0)));
    assert_hit(crate, 10.5, 0.25, 0, 0, 0, cast(V(10.5, 0.25), V(20, 0)));
}

/* ---- rays and polygons ---- */

void test_a_ray_hits_a_box_at_its_face(void)
{
    cairn_body_id id = put(&box, V(0, 0), 0);
    assert_hit(id, -2, 0.5, -1, 0, 0.3, cast(V(-5, 0.5), V(5, 0.5)));
    assert_hit(id, 2, 0.5, 1, 0, 0.3, cast(V(5, 0.5), V(-5, 0.5)));
    assert_hit(id, 1, 1, 0, 1, 0.4, cast(V(1, 5), V(1, -5)));
    assert_hit(id, 1.5, 1, 0, 1, 0.5, cast(V(2.5, 2), V(0.5, 0)));
}

void test_a_ray_hits_a_turned_box_at_its_turned_face(void)
{
    double half = 0.70710678118654752;
    cairn_body_id id = put(&square, V(0, 0), CAIRN_DEGREES(45));
    assert_hit(id, -1.4142135623730951 + 0.5, 0.5, -half, half, (5 - 1.4142135623730951 + 0.5) / 10, cast(V(-5, 0.5), V(5, 0.5)));
    assert_miss(cast(V(-5, 1.42), V(5, 1.42)));
    assert_miss(cast(V(0.8, 3), V(3, 0.8)));
}

void test_a_ray_hits_a_polygon_where_its_points_were_given(void)
{
    static const cairn_vec2 points[] = { { 0, 0 }, { CAIRN_F(3), 0 }, { 0, CAIRN_F(3) } };
    cairn_polygon triangle;
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init(&triangle, points, 3));
    cairn_body_id id = put(&triangle.shape, V(10, 20), CAIRN_DEGREES(90));
    double half = 0.70710678118654752;
    assert_hit(id, 9, 20, 0, -1, 0.5, cast(V(9, 19), V(9, 21)));
    assert_hit(id, 8, 21, -half, half, 0.5, cast(V(7, 22), V(9, 20)));
    assert_miss(cast(V(7.9, 23), V(7.9, 21)));
}

void test_a_ray_at_the_end_of_a_long_floor_is_exact(void)
{
    cairn_body_id floor = put_special(&long_floor, V(0, -1), CAIRN_STATIC, 1, false);
    assert_hit(floor, 119, 0, 0, 1, 1.0 / 3, cast(V(119, 1), V(119, -2)));
    assert_hit(floor, 120, -1, 1, 0, 245.0 / 250, cast(V(365, -1), V(115, -1)));
    assert_miss(cast(V(121, 1), V(360, -2)));
}

void test_a_ray_hits_the_largest_and_the_smallest_circle(void)
{
    cairn_body_id large = put_special(&large_circle, V(0, 0), CAIRN_STATIC, 1, false);
    cairn_body_id small = put(&small_circle, V(0, 300), 0);
    assert_hit(large, 75, 100, 0.6, 0.8, 0.4, cast(V(105, 140), V(30, 40)));
    assert_hit(small, 0.005859375, 300.0078125, 0.6, 0.8, 0.5, cast(V(0.01171875, 300.015625), V(0, 300)));
    assert_hit(small, 0, 300.009765625, 0, 1, 0.99990234375, cast(V(0, 400), V(0, 300)));
}

void test_a_ray_far_from_the_origin_is_as_good_as_at_it(void)
{
    cairn_body_id id = put(&unit_circle, V(15990, -15990), 0);
    assert_hit(id, 15989.2, -15989.4, -0.8, 0.6, 0.42, cast(V(15985, -15989.4), V(15995, -15989.4)));
}

void test_a_ray_of_no_length_is_a_point(void)
{
    cairn_body_id ball = put(&unit_circle, V(0, 0), 0), crate = put(&box, V(10, 0), 0);
    assert_hit(ball, 0.5, 0, 0, 0, 0, cast(V(0.5, 0), V(0.5, 0)));
    assert_hit(crate, 11, 0.5, 0, 0, 0, cast(V(11, 0.5), V(11, 0.5)));
    assert_miss(cast(V(0.8, 0.8), V(0.8, 0.8)));
    assert_miss(cast(V(12.5, 0), V(12.5, 0)));
    assert_miss(cast(V(12, 1.2), V(12, 1.2)));
}

void test_the_closest_of_many_is_found_whatever_their_order(void)
{
    put(&unit_circle, V(9, 0), 0);
    cairn_body_id near = put(&unit_circle, V(3, 0), 0);
    put(&unit_circle, V(6, 0), 0);
    assert_hit(near, 2, 0, -1, 0, 0.1, cast(V(0, 0), V(20, 0)));
}

void test_the_closest_ray_passes_sensors_and_other_layers(void)
{
    cairn_ray_hit hit;
    put_special(&unit_circle, V(3, 0), CAIRN_DYNAMIC, 1, true);
    put_special(&unit_circle, V(6, 0), CAIRN_DYNAMIC, 2, false);
    cairn_body_id wanted = put_special(&unit_circle, V(9, 0), CAIRN_KINEMATIC, 5, false);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_ray(world, V(0, 0), V(20, 0), 4, &hit));
    assert_hit(wanted, 8, 0, -1, 0, 0.4, hit);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_ray(world, V(0, 0), V(20, 0), 8, &hit));
    assert_miss(hit);
}

void test_a_destroyed_body_is_not_hit(void)
{
    cairn_body_id id = put(&unit_circle, V(0, 0), 0);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_body_destroy(world, id));
    assert_miss(cast(V(-5, 0), V(5, 0)));
}

void test_a_sleeping_body_is_hit(void)
{
    cairn_body_id id = put(&unit_circle, V(0, 1), 0);
    put_special(&long_floor, V(0, -1), CAIRN_STATIC, 1, false);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_sleep_enable(world));
    for (int i = 0; i < 60; i++) {
        cairn_world_step(world);
    }
    TEST_ASSERT_FALSE(cairn_body_is_awake(world, id));
    cairn_ray_hit hit = cast(V(0, 10), V(0, 0));
    TEST_ASSERT_TRUE(cairn_body_id_equal(id, hit.body));
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 2, number_of_real(hit.point.y));
    TEST_ASSERT_FALSE(cairn_body_is_awake(world, id));
}

/* ---- visitors ---- */

typedef struct visits {
    int count, most;
    cairn_body_id bodies[BODIES];
    double fractions[BODIES];
} visits;

static bool note_hit(void *context, const cairn_ray_hit *hit)
{
    visits *seen = (visits *)context;
    seen->fractions[seen->count] = number_of_real(hit->fraction);
    seen->bodies[seen->count++] = hit->body;
    return seen->count < seen->most;
}

static bool note_body(void *context, cairn_body_id body)
{
    visits *seen = (visits *)context;
    seen->bodies[seen->count++] = body;
    return seen->count < seen->most;
}

static visits none_of(int most)
{
    visits seen;
    memset(&seen, 0, sizeof seen);
    seen.most = most;
    return seen;
}

void test_every_hit_is_visited_in_the_order_of_the_pool_sensors_included(void)
{
    cairn_body_id far = put(&unit_circle, V(9, 0), 0);
    put(&unit_circle, V(5, 5), 0);
    cairn_body_id sensor = put_special(&unit_circle, V(3, 0), CAIRN_DYNAMIC, 1, true);
    visits seen = none_of(BODIES);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_ray_all(world, V(0, 0), V(20, 0), ALL, note_hit, &seen));
    TEST_ASSERT_EQUAL(2, seen.count);
    TEST_ASSERT_TRUE(cairn_body_id_equal(far, seen.bodies[0]));
    TEST_ASSERT_TRUE(cairn_body_id_equal(sensor, seen.bodies[1]));
    TEST_ASSERT_DOUBLE_WITHIN(ERROR, 0.4, seen.fractions[0]);
    TEST_ASSERT_DOUBLE_WITHIN(ERROR, 0.1, seen.fractions[1]);
}

void test_a_visitor_that_returns_false_is_not_called_again(void)
{
    for (int i = 0; i < 5; i++) {
        put(&unit_circle, V(0, 0), 0);
    }
    visits seen = none_of(2);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_ray_all(world, V(-5, 0), V(5, 0), ALL, note_hit, &seen));
    TEST_ASSERT_EQUAL(2, seen.count);
    seen = none_of(3);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_point(world, V(0, 0), ALL, note_body, &seen));
    TEST_ASSERT_EQUAL(3, seen.count);
    seen = none_of(1);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_box(world, V(0, 0), V(1, 1), ALL, note_body, &seen));
    TEST_ASSERT_EQUAL(1, seen.count);
}

static bool change_all(void *context, cairn_body_id body)
{
    int *calls = (int *)context;
    yard_def def = def_at(&unit_circle, 0, 0);
    visits seen = none_of(BODIES);
    (*calls)++;
    /* A question from inside is answered, and does not unlock. */
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_point(world, V(0, 0), ALL, note_body, &seen));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_ray_all(world, V(0, 0), V(1, 0), ALL, note_hit, &seen));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_LOCKED, cairn_body_destroy(world, body));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_LOCKED, cairn_body_set_velocity(world, body, V(1, 0)));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_LOCKED, cairn_world_step(world));
    TEST_ASSERT_TRUE(cairn_body_id_is_null(make_in(world, &def)));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_LOCKED, cairn_world_error(world));
    return true;
}

static bool change_all_at_hit(void *context, const cairn_ray_hit *hit) { return change_all(context, hit->body); }

void test_a_visitor_may_ask_but_not_change_the_world(void)
{
    int calls = 0;
    cairn_body_id id = put(&unit_circle, V(0, 0), 0);
    uint32_t hash = cairn_world_hash(world);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_point(world, V(0, 0), ALL, change_all, &calls));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_box(world, V(0, 0), V(1, 1), ALL, change_all, &calls));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_ray_all(world, V(0, 0), V(1, 1), ALL, change_all_at_hit, &calls));
    TEST_ASSERT_EQUAL(3, calls);
    TEST_ASSERT_EQUAL_HEX32(hash, cairn_world_hash(world));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_body_destroy(world, id));
}

/* ---- points and boxes ---- */

static int count_at(cairn_vec2 point)
{
    visits seen = none_of(BODIES);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_point(world, point, ALL, note_body, &seen));
    return seen.count;
}

static int count_in(cairn_vec2 lower, cairn_vec2 upper)
{
    visits seen = none_of(BODIES);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_box(world, lower, upper, ALL, note_body, &seen));
    return seen.count;
}

void test_a_circle_holds_the_points_within_its_radius(void)
{
    put(&unit_circle, V(5, 5), 0);
    TEST_ASSERT_EQUAL(1, count_at(V(5, 5)));
    TEST_ASSERT_EQUAL(1, count_at(V(6, 5)));
    TEST_ASSERT_EQUAL(1, count_at(V(5.7, 5.7)));
    TEST_ASSERT_EQUAL(0, count_at(V(5.72, 5.72)));
    TEST_ASSERT_EQUAL(0, count_at(V(6.001, 5)));
}

void test_a_turned_box_holds_the_points_between_its_sides(void)
{
    put(&box, V(0, 0), CAIRN_DEGREES(90)); /* 2 wide, 4 high */
    TEST_ASSERT_EQUAL(1, count_at(V(0, 1.99)));
    TEST_ASSERT_EQUAL(1, count_at(V(0.99, -1.99)));
    TEST_ASSERT_EQUAL(0, count_at(V(1.01, 0)));
    TEST_ASSERT_EQUAL(0, count_at(V(0, 2.01)));
}

void test_a_large_turned_box_does_not_hold_the_corners_of_its_bounding_box(void)
{
    static const cairn_shape large = CAIRN_BOX(CAIRN_F(175), CAIRN_F(175));
    put_special(&large, V(0, 0), CAIRN_STATIC, 1, false);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_body_set_transform(world, cairn_world_next_body(world, cairn_body_id_null()), V(0, 0), CAIRN_DEGREES(45)));
    TEST_ASSERT_EQUAL(1, count_at(V(61.5, 61.5)));
    TEST_ASSERT_EQUAL(0, count_at(V(62.25, 62.25)));
    TEST_ASSERT_EQUAL(0, count_at(V(123.5, 123.5)));
    TEST_ASSERT_EQUAL(0, count_at(V(-123.5, 123.5)));
    TEST_ASSERT_EQUAL(0, count_in(V(100, 100), V(16000, 16000)));
    TEST_ASSERT_EQUAL(1, count_in(V(61.5, 61.5), V(16000, 16000)));
}

void test_points_and_boxes_are_filtered_by_mask(void)
{
    visits seen = none_of(BODIES);
    put_special(&unit_circle, V(0, 0), CAIRN_DYNAMIC, 1, false);
    cairn_body_id wanted = put_special(&unit_circle, V(0, 0), CAIRN_STATIC, 6, true);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_point(world, V(0, 0), 2, note_body, &seen));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_query_box(world, V(0, 0), V(1, 1), 4, note_body, &seen));
    TEST_ASSERT_EQUAL(2, seen.count);
    TEST_ASSERT_TRUE(cairn_body_id_equal(wanted, seen.bodies[0]));
    TEST_ASSERT_TRUE(cairn_body_id_equal(wanted, seen.bodies[1]));
}

void test_a_box_overlaps_a_circle_at_side_and_corner(void)
{
    put(&unit_circle, V(0, 0), 0);
    TEST_ASSERT_EQUAL(1, count_in(V(-5, -5), V(5, 5)));
    TEST_ASSERT_EQUAL(1, count_in(V(-0.1, -0.1), V(0.1, 0.1)));
    TEST_ASSERT_EQUAL(1, count_in(V(0.99, -1), V(2, 1)));
    TEST_ASSERT_EQUAL(0, count_in(V(1.01, -1), V(2, 1)));
    TEST_ASSERT_EQUAL(1, count_in(V(0.7, 0.7), V(2, 2)));
    TEST_ASSERT_EQUAL(0, count_in(V(0.72, 0.72), V(2, 2)));
}

void test_a_box_overlaps_a_turned_box_and_passes_its_corners(void)
{
    put(&square, V(0, 0), CAIRN_DEGREES(45)); /* reaches 1.414 along the axes */
    TEST_ASSERT_EQUAL(1, count_in(V(1.4, -1), V(2, 1)));
    TEST_ASSERT_EQUAL(0, count_in(V(1.43, -1), V(2, 1)));
    TEST_ASSERT_EQUAL(1, count_in(V(0.7, 0.7), V(1, 1)));
    TEST_ASSERT_EQUAL(0, count_in(V(0.72, 0.72), V(1, 1)));
    TEST_ASSERT_EQUAL(0, count_in(V(-1, -1), V(-0.72, -0.72)));
    TEST_ASSERT_EQUAL(1, count_in(V(-0.1, -0.1), V(0.1, 0.1)));
}

void test_a_box_beside_a_lopsided_polygon_is_outside_though_within_its_symmetric_bounds(void)
{
    static const cairn_vec2 points[] = { { 0, 0 }, { CAIRN_F(3), 0 }, { 0, CAIRN_F(3) } };
    cairn_polygon triangle;
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init(&triangle, points, 3));
    put(&triangle.shape, V(0, 0), 0);
    TEST_ASSERT_EQUAL(0, count_in(V(-0.9, 0.5), V(-0.1, 1))); /* left of it */
    TEST_ASSERT_EQUAL(0, count_in(V(0.5, -0.9), V(1, -0.1))); /* below */
    TEST_ASSERT_EQUAL(1, count_in(V(-0.9, 0.5), V(0.1, 1)));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_body_set_transform(world, cairn_world_next_body(world, cairn_body_id_null()), V(0, 0), CAIRN_DEGREES(180)));
    TEST_ASSERT_EQUAL(0, count_in(V(0.1, -1), V(0.9, -0.5))); /* right of it */
    TEST_ASSERT_EQUAL(0, count_in(V(-1, 0.1), V(-0.5, 0.9))); /* above */
}

void test_a_box_may_be_as_large_as_the_world_or_a_point(void)
{
    put(&unit_circle, V(-15990, 15990), 0);
    put(&box, V(15990, -15990), CAIRN_DEGREES(10));
    put_special(&long_floor, V(0, 0), CAIRN_STATIC, 1, false);
    cairn_vec2 lower = cairn_vec2_of(-CAIRN_REAL_MAX, -CAIRN_REAL_MAX), upper = cairn_vec2_of(CAIRN_REAL_MAX, CAIRN_REAL_MAX);
    TEST_ASSERT_EQUAL(3, count_in(lower, upper));
    TEST_ASSERT_EQUAL(2, count_in(lower, V(0, 16000)));
    TEST_ASSERT_EQUAL(1, count_in(V(119, 0), V(119, 0)));
    TEST_ASSERT_EQUAL(0, count_in(V(121, 0), V(121, 0)));
}

/* ---- what is refused ---- */

void test_bad_arguments_are_refused_and_visit_nothing(void)
{
    visits seen = none_of(BODIES);
    cairn_ray_hit hit = { { 7, 7 }, { 0, 0 }, { 0, 0 }, 0 };
    put(&unit_circle, V(0, 0), 0);
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_query_ray(NULL, V(0, 0), V(1, 0), ALL, &hit));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_query_ray(world, V(0, 0), V(1, 0), ALL, NULL));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_query_ray(world, V(0, 0), V(251, 0), ALL, &hit));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_query_ray(world, V(-20000, 0), V(20000, 0), ALL, &hit));
    TEST_ASSERT_EQUAL(7, hit.body.index);
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_query_ray_all(NULL, V(0, 0), V(1, 0), ALL, note_hit, &seen));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_query_ray_all(world, V(0, 0), V(1, 0), ALL, NULL, &seen));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_query_ray_all(world, V(0, 0), V(0, 251), ALL, note_hit, &seen));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_query_point(NULL, V(0, 0), ALL, note_body, &seen));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_query_point(world, V(0, 0), ALL, NULL, &seen));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_query_box(NULL, V(0, 0), V(1, 1), ALL, note_body, &seen));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_query_box(world, V(0, 0), V(1, 1), ALL, NULL, &seen));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_query_box(world, V(1, 0), V(0, 1), ALL, note_body, &seen));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_query_box(world, V(0, 1), V(1, 0), ALL, note_body, &seen));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_world_error(world));
    TEST_ASSERT_EQUAL(0, seen.count);
}
