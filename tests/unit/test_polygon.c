/* Convex polygons: what is refused, and measures against closed forms and an independent computation in double. */
#include <cairn/cairn.h>
#include <unity.h>

#include "test_number.h"

#ifdef __arm__
#define RANDOM_POLYGONS 500
#else
#define RANDOM_POLYGONS 20000
#endif

#define P(x, y) { CAIRN_F(x), CAIRN_F(y) }
#define COUNT(points) ((int)(sizeof(points) / sizeof((points)[0])))

/* Of an area or a squared radius of gyration, relative: some forty roundings of 2^-32, of any sign. */
#define MEASURE_ERROR 2e-9
/* Of a coordinate in m: half a step of Q10.22, and what 250 m leave of a 32-bit mantissa. */
#define PLACE_ERROR(size) (1.3e-7 + (size) * 1.5e-9)

static cairn_polygon polygon;

void setUp(void) { memset(&polygon, 0x55, sizeof polygon); }
void tearDown(void) {}

/* ---- an independent measure: the shoelace sums about the first corner, in double ---- */

typedef struct measure {
    double area, x, y, gyration_squared;
} measure;

static measure measured(const double *x, const double *y, int count)
{
    measure m = { 0, 0, 0, 0 };
    double second = 0;
    for (int i = 0; i < count; i++) {
        int j = (i + 1) % count;
        double ax = x[i] - x[0], ay = y[i] - y[0], bx = x[j] - x[0], by = y[j] - y[0];
        double cross = ax * by - ay * bx;
        m.area += cross / 2;
        m.x += cross * (ax + bx) / 6;
        m.y += cross * (ay + by) / 6;
        second += cross * (ax * ax + ax * bx + bx * bx + ay * ay + ay * by + by * by) / 12;
    }
    m.x /= m.area;
    m.y /= m.area;
    m.gyration_squared = second / m.area - m.x * m.x - m.y * m.y;
    m.x += x[0];
    m.y += y[0];
    return m;
}

static double gyration_squared(const cairn_mass_data *mass)
{
    double gyration = number_of_wide(mass->gyration);
    return gyration * gyration;
}

static void assert_close(double expected, double actual, double relative)
{
    TEST_ASSERT_DOUBLE_WITHIN(relative * expected, expected, actual);
}

/* The polygon's corners where its points were given. */
static void corners_of(const cairn_polygon *p, double *x, double *y)
{
    for (int i = 0; i < p->count; i++) {
        x[i] = number_of_offset(p->vertex[i].x) + number_of_offset(p->centroid.x);
        y[i] = number_of_offset(p->vertex[i].y) + number_of_offset(p->centroid.y);
    }
}

/* All that must hold of any polygon the engine accepts. */
static void assert_sound(const cairn_polygon *p)
{
    double x[CAIRN_MAX_VERTICES], y[CAIRN_MAX_VERTICES], size = number_of_real(p->shape.size.x), farthest = 0;
    corners_of(p, x, y);
    measure m = measured(x, y, p->count);
    TEST_ASSERT_TRUE(m.area > 0);
    assert_close(m.area, number_of_wide(p->mass.area), MEASURE_ERROR);
    /* About the centroid that it has, which is rounded, and about which it turns. */
    double off_x = m.x - number_of_offset(p->centroid.x), off_y = m.y - number_of_offset(p->centroid.y);
    assert_close(m.gyration_squared + off_x * off_x + off_y * off_y, gyration_squared(&p->mass), MEASURE_ERROR);
    TEST_ASSERT_DOUBLE_WITHIN(PLACE_ERROR(size), m.x, number_of_offset(p->centroid.x));
    TEST_ASSERT_DOUBLE_WITHIN(PLACE_ERROR(size), m.y, number_of_offset(p->centroid.y));
    for (int i = 0; i < p->count; i++) {
        int j = (i + 1) % p->count;
        double nx = number_of_unit(p->normal[i].x), ny = number_of_unit(p->normal[i].y);
        double vx = number_of_offset(p->vertex[i].x), vy = number_of_offset(p->vertex[i].y);
        double away = vx * vx + vy * vy, edge = (x[j] - x[i]) * (x[j] - x[i]) + (y[j] - y[i]) * (y[j] - y[i]);
        double along = (x[j] - x[i]) * nx + (y[j] - y[i]) * ny;
        farthest = away > farthest ? away : farthest;
        TEST_ASSERT_DOUBLE_WITHIN(1e-8, 1, nx * nx + ny * ny);
        TEST_ASSERT_DOUBLE_WITHIN(1e-17 * edge + 1e-30, 0, along * along); /* 3e-9 rad: square to its edge */
        TEST_ASSERT_TRUE(nx * vx + ny * vy > 0);                           /* outward: the centroid lies behind it */
    }
    TEST_ASSERT_TRUE(size * size >= farthest * (1 - 1e-12));
    TEST_ASSERT_TRUE((size - 2.0 / 65536) * (size - 2.0 / 65536) <= farthest);
}

/* ---- closed forms ---- */

void test_a_triangle_has_half_base_times_height_and_its_centroid_at_a_third(void)
{
    static const cairn_vec2 points[] = { P(0, 0), P(3, 0), P(0, 6) };
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init(&polygon, points, COUNT(points)));
    TEST_ASSERT_EQUAL(3, polygon.count);
    assert_close(9, number_of_wide(polygon.mass.area), MEASURE_ERROR);
    TEST_ASSERT_DOUBLE_WITHIN(PLACE_ERROR(6), 1, number_of_offset(polygon.centroid.x));
    TEST_ASSERT_DOUBLE_WITHIN(PLACE_ERROR(6), 2, number_of_offset(polygon.centroid.y));
    assert_close((3 * 3 + 6 * 6) / 18.0, gyration_squared(&polygon.mass), MEASURE_ERROR); /* (b^2 + h^2) / 18 for a right one */
    assert_sound(&polygon);
}

static void assert_equals_box(cairn_real width, cairn_real height)
{
    cairn_shape box = CAIRN_BOX(0, 0);
    cairn_real w = cairn_real_half(width), h = cairn_real_half(height);
    cairn_vec2 points[4] = { { -w, -h }, { w, -h }, { w, h }, { -w, h } };
    cairn_mass_data of_box, of_polygon;
    box.size = cairn_vec2_of(width, height);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init(&polygon, points, 4));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_shape_measure(&box, &of_box));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_shape_measure(&polygon.shape, &of_polygon));
    assert_close(number_of_wide(of_box.area), number_of_wide(of_polygon.area), MEASURE_ERROR);
    assert_close(number_of_wide(of_box.gyration), number_of_wide(of_polygon.gyration), MEASURE_ERROR);
    TEST_ASSERT_TRUE(polygon.centroid.x == 0);
    TEST_ASSERT_TRUE(polygon.centroid.y == 0);
    assert_sound(&polygon);
}

void test_a_box_as_a_polygon_measures_what_the_box_measures(void)
{
    assert_equals_box(CAIRN_F(1), CAIRN_F(1));
    assert_equals_box(CAIRN_F(2), CAIRN_F(0.5));
    assert_equals_box(CAIRN_F(0.0078125), CAIRN_F(0.015625));
    assert_equals_box(CAIRN_F(240), CAIRN_F(0.5));
    assert_equals_box(CAIRN_F(175), CAIRN_F(175));
}

void test_a_box_has_one_twelfth_of_its_squared_sides_and_not_a_third(void)
{
    static const cairn_vec2 points[] = { P(-2, -1), P(2, -1), P(2, 1), P(-2, 1) };
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init(&polygon, points, COUNT(points)));
    assert_close(8, number_of_wide(polygon.mass.area), MEASURE_ERROR);
    assert_close((4 * 4 + 2 * 2) / 12.0, gyration_squared(&polygon.mass), MEASURE_ERROR);
}

/* area = n/2 r^2 sin(2 pi / n), squared gyration = r^2 (2 + cos(2 pi / n)) / 6 */
static void assert_regular(int sides, cairn_real radius, double sine, double cosine)
{
    double r = number_of_real(radius), corner = 3e-7 / r; /* a corner is within 1 step of Q10.22 of its place */
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init_regular(&polygon, sides, radius));
    TEST_ASSERT_EQUAL(sides, polygon.count);
    assert_close(sides / 2.0 * r * r * sine, number_of_wide(polygon.mass.area), MEASURE_ERROR + 2 * corner);
    assert_close(r * r * (2 + cosine) / 6, gyration_squared(&polygon.mass), MEASURE_ERROR + 2 * corner);
    TEST_ASSERT_TRUE(polygon.centroid.x == 0);
    TEST_ASSERT_TRUE(polygon.centroid.y == 0);
    TEST_ASSERT_DOUBLE_WITHIN(3e-7, r, number_of_offset(polygon.vertex[0].x));
    TEST_ASSERT_DOUBLE_WITHIN(3e-7, 0, number_of_offset(polygon.vertex[0].y));
    assert_sound(&polygon);
}

void test_regular_polygons_have_the_closed_forms(void)
{
    static const cairn_real radii[] = { CAIRN_F(0.01), CAIRN_F(0.5), CAIRN_F(3), CAIRN_F(100) };
    for (int i = 0; i < COUNT(radii); i++) {
        assert_regular(3, radii[i], 0.86602540378443865, -0.5);
        assert_regular(4, radii[i], 1, 0);
        assert_regular(5, radii[i], 0.95105651629515357, 0.30901699437494742);
        assert_regular(6, radii[i], 0.86602540378443865, 0.5);
        assert_regular(7, radii[i], 0.78183148246802981, 0.62348980185873353);
        assert_regular(8, radii[i], 0.70710678118654752, 0.70710678118654752);
    }
}

/* ---- random polygons ---- */

static int random_points(uint32_t *seed, double size, cairn_vec2 *points)
{
    int count = random_between(seed, 3, CAIRN_MAX_VERTICES);
    cairn_vec2 middle = cairn_vec2_of(random_real(seed, -size, size), random_real(seed, -size, size));
    for (int i = 0; i < count; i++) {
        points[i].x = middle.x + random_real(seed, -size, size);
        points[i].y = middle.y + random_real(seed, -size, size);
    }
    return count;
}

/* How far outside of the polygon a point lies, m. */
static double outside_by(const cairn_polygon *p, double px, double py)
{
    double most = -1e9;
    for (int i = 0; i < p->count; i++) {
        double x = px - number_of_offset(p->vertex[i].x) - number_of_offset(p->centroid.x);
        double y = py - number_of_offset(p->vertex[i].y) - number_of_offset(p->centroid.y);
        double out = x * number_of_unit(p->normal[i].x) + y * number_of_unit(p->normal[i].y);
        most = out > most ? out : most;
    }
    return most;
}

static bool is_corner_among(double x, double y, const cairn_vec2 *points, int count)
{
    for (int i = 0; i < count; i++) {
        double dx = x - number_of_real(points[i].x), dy = y - number_of_real(points[i].y);
        if (dx * dx + dy * dy < 1e-20) {
            return true;
        }
    }
    return false;
}

void test_hulls_of_random_points_are_sound_hold_all_points_and_take_their_corners_from_them(void)
{
    static const double sizes[] = { 0.01, 0.1, 1, 10, 40 };
    uint32_t seed = 7;
    int made = 0;
    for (int n = 0; n < RANDOM_POLYGONS; n++) {
        cairn_vec2 points[CAIRN_MAX_VERTICES];
        double x[CAIRN_MAX_VERTICES], y[CAIRN_MAX_VERTICES];
        int count = random_points(&seed, sizes[n % 5], points);
        cairn_status status = cairn_polygon_init_hull(&polygon, points, count);
        TEST_ASSERT_TRUE(status == CAIRN_OK || status == CAIRN_ERROR_SHAPE); /* thin ones */
        if (status != CAIRN_OK) {
            continue;
        }
        made++;
        assert_sound(&polygon);
        for (int i = 0; i < count; i++) {
            /* A flat corner is left out: 0.03 mm, and a few of them in a row. */
            TEST_ASSERT_TRUE(outside_by(&polygon, number_of_real(points[i].x), number_of_real(points[i].y)) < 1e-4);
        }
        corners_of(&polygon, x, y);
        for (int i = 0; i < polygon.count; i++) {
            TEST_ASSERT_TRUE(is_corner_among(x[i], y[i], points, count));
        }
    }
    TEST_ASSERT_TRUE(made > RANDOM_POLYGONS * 9 / 10);
}

/* The corners of a hull as points, moved. */
static void take_corners(const cairn_polygon *p, cairn_vec2 by, cairn_vec2 *points)
{
    for (int i = 0; i < p->count; i++) {
        points[i].x = cairn_real_from_offset(p->vertex[i].x + p->centroid.x) + by.x;
        points[i].y = cairn_real_from_offset(p->vertex[i].y + p->centroid.y) + by.y;
    }
}

void test_measures_do_not_depend_on_place_or_direction(void)
{
    uint32_t seed = 11;
    for (int n = 0; n < RANDOM_POLYGONS / 10; n++) {
        cairn_vec2 points[CAIRN_MAX_VERTICES], reversed[CAIRN_MAX_VERTICES];
        cairn_polygon first, moved, turned;
        if (cairn_polygon_init_hull(&polygon, points, random_points(&seed, 1, points)) != CAIRN_OK) {
            continue;
        }
        take_corners(&polygon, cairn_vec2_of(0, 0), points);
        TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init(&first, points, polygon.count));
        reversed[0] = points[0]; /* the same first corner, the other way round */
        for (int i = 1; i < polygon.count; i++) {
            reversed[i] = points[polygon.count - i];
        }
        TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init(&turned, reversed, polygon.count));
        take_corners(&polygon, cairn_vec2_of(CAIRN_F(100), CAIRN_F(-70)), points);
        TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init(&moved, points, polygon.count));
#ifdef CAIRN_DOUBLE
        assert_close(number_of_wide(first.mass.area), number_of_wide(moved.mass.area), 1e-12);
        assert_close(number_of_wide(first.mass.gyration), number_of_wide(moved.mass.gyration), 1e-12);
#else
        TEST_ASSERT_EQUAL_MEMORY(&first.mass, &moved.mass, sizeof first.mass);
        TEST_ASSERT_EQUAL_MEMORY(first.vertex, moved.vertex, sizeof first.vertex);
        TEST_ASSERT_EQUAL_MEMORY(first.normal, moved.normal, sizeof first.normal);
#endif
        TEST_ASSERT_EQUAL_MEMORY(&first.mass, &turned.mass, sizeof first.mass);
        TEST_ASSERT_EQUAL_MEMORY(first.vertex, turned.vertex, sizeof first.vertex);
        TEST_ASSERT_EQUAL_MEMORY(first.normal, turned.normal, sizeof first.normal);
    }
}

/* ---- what is refused ---- */

static void assert_refused(cairn_status expected, const cairn_vec2 *points, int count)
{
    cairn_polygon before;
    memset(&before, 0x55, sizeof before);
    TEST_ASSERT_EQUAL(expected, cairn_polygon_init(&polygon, points, count));
    TEST_ASSERT_EQUAL_MEMORY(&before, &polygon, sizeof polygon);
}

void test_a_concave_polygon_is_refused(void)
{
    static const cairn_vec2 dart[] = { P(0, 0), P(2, 1), P(0, 2), P(0.5, 1) };
    static const cairn_vec2 dart_back[] = { P(0.5, 1), P(0, 2), P(2, 1), P(0, 0) };
    assert_refused(CAIRN_ERROR_SHAPE, dart, COUNT(dart));
    assert_refused(CAIRN_ERROR_SHAPE, dart_back, COUNT(dart_back));
}

void test_a_self_crossing_polygon_is_refused_even_if_it_only_turns_left(void)
{
    static const cairn_vec2 bow[] = { P(0, 0), P(1, 1), P(1, 0), P(0, 1) };
    static const cairn_vec2 pentagram[] = { P(0, 1), P(-0.588, -0.809), P(0.951, 0.309), P(-0.951, 0.309), P(0.588, -0.809) };
    static const cairn_vec2 twice_round[] = { P(0, 0), P(4, 0), P(4, 4), P(0.5, 0.25), P(3.5, 0.25), P(3.5, 3) };
    assert_refused(CAIRN_ERROR_SHAPE, bow, COUNT(bow));
    assert_refused(CAIRN_ERROR_SHAPE, pentagram, COUNT(pentagram));
    assert_refused(CAIRN_ERROR_SHAPE, twice_round, COUNT(twice_round));
}

void test_coinciding_corners_are_refused(void)
{
    static const cairn_vec2 twice[] = { P(0, 0), P(1, 0), P(1, 0), P(0, 1) };
    static const cairn_vec2 point[] = { P(1, 1), P(1, 1), P(1, 1) };
    static const cairn_vec2 ends[] = { P(0, 0), P(1, 0), P(0, 1), P(0, 0) };
    assert_refused(CAIRN_ERROR_SHAPE, twice, COUNT(twice));
    assert_refused(CAIRN_ERROR_SHAPE, point, COUNT(point));
    assert_refused(CAIRN_ERROR_SHAPE, ends, COUNT(ends));
}

void test_collinear_corners_are_refused_also_where_rounding_bends_them(void)
{
    static const cairn_vec2 line[] = { P(0, 0), P(1, 1), P(2, 2) };
    static const cairn_vec2 side[] = { P(0, 0), P(1, 0), P(2, 0), P(1, 1) };
    static const cairn_vec2 rounded[] = { P(0, 0), P(0.1, 0.05), P(0.2, 0.1), P(0.05, 1) };
    static const cairn_vec2 back[] = { P(0, 0), P(2, 0), P(1, 0), P(1, 1) };
    assert_refused(CAIRN_ERROR_SHAPE, line, COUNT(line));
    assert_refused(CAIRN_ERROR_SHAPE, side, COUNT(side));
    assert_refused(CAIRN_ERROR_SHAPE, rounded, COUNT(rounded));
    assert_refused(CAIRN_ERROR_SHAPE, back, COUNT(back));
}

void test_a_polygon_thinner_than_a_millimetre_is_refused(void)
{
    static const cairn_vec2 thin[] = { P(0, 0), P(1, 0), P(1, 0.0009), P(0, 0.0009) };
    static const cairn_vec2 enough[] = { P(0, 0), P(1, 0), P(1, 0.001), P(0, 0.001) };
    static const cairn_vec2 slanted[] = { P(0, 0), P(1, 1), P(1, 1.0012), P(0, 0.0012) };
    assert_refused(CAIRN_ERROR_SHAPE, thin, COUNT(thin));
    assert_refused(CAIRN_ERROR_SHAPE, slanted, COUNT(slanted));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init(&polygon, enough, COUNT(enough)));
    assert_sound(&polygon);
}

void test_points_farther_than_125_metres_are_refused(void)
{
    static const cairn_vec2 far[] = { P(0, 0), P(126, 0), P(0, 1) };
    static const cairn_vec2 corner[] = { P(0, 0), P(100, 100), P(0, 1) };
    static const cairn_vec2 edge[] = { { CAIRN_REAL_MAX, CAIRN_REAL_MAX }, { -CAIRN_REAL_MAX, CAIRN_REAL_MAX }, P(0, 1) };
    static const cairn_vec2 far_from_centroid[] = { P(-124, 0), P(124, -10), P(124, 10) };
    static const cairn_vec2 largest[] = { P(-124, 0), P(0, -124), P(124, 0), P(0, 124) };
    assert_refused(CAIRN_ERROR_SHAPE, far, COUNT(far));
    assert_refused(CAIRN_ERROR_SHAPE, corner, COUNT(corner));
    assert_refused(CAIRN_ERROR_SHAPE, edge, COUNT(edge));
    assert_refused(CAIRN_ERROR_SHAPE, far_from_centroid, COUNT(far_from_centroid));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init(&polygon, largest, COUNT(largest)));
    assert_sound(&polygon);
}

void test_too_few_and_too_many_points_are_out_of_range(void)
{
    static const cairn_vec2 points[2 * CAIRN_MAX_VERTICES + 1] = { P(0, 0), P(1, 0), P(0, 1) };
    assert_refused(CAIRN_ERROR_RANGE, points, 2);
    assert_refused(CAIRN_ERROR_RANGE, points, -1);
    assert_refused(CAIRN_ERROR_RANGE, points, CAIRN_MAX_VERTICES + 1);
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_polygon_init_hull(&polygon, points, 2));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_polygon_init_hull(&polygon, points, 2 * CAIRN_MAX_VERTICES + 1));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_polygon_init_regular(&polygon, 2, CAIRN_F(1)));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_polygon_init_regular(&polygon, CAIRN_MAX_VERTICES + 1, CAIRN_F(1)));
}

void test_null_is_refused(void)
{
    static const cairn_vec2 points[] = { P(0, 0), P(1, 0), P(0, 1) };
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_polygon_init(NULL, points, 3));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_polygon_init(&polygon, NULL, 3));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_polygon_init_hull(NULL, points, 3));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_polygon_init_hull(&polygon, NULL, 3));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_polygon_init_regular(NULL, 3, CAIRN_F(1)));
}

void test_regular_polygons_outside_of_the_sizes_are_refused(void)
{
    TEST_ASSERT_EQUAL(CAIRN_ERROR_SHAPE, cairn_polygon_init_regular(&polygon, 5, 0));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_SHAPE, cairn_polygon_init_regular(&polygon, 5, CAIRN_F(-1)));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_SHAPE, cairn_polygon_init_regular(&polygon, 5, CAIRN_F(0.0005)));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_SHAPE, cairn_polygon_init_regular(&polygon, 5, CAIRN_F(125.5)));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init_regular(&polygon, 5, CAIRN_F(0.001)));
    assert_sound(&polygon);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init_regular(&polygon, 8, CAIRN_F(124)));
    assert_sound(&polygon);
}

/* ---- hulls ---- */

void test_the_hull_leaves_out_inner_double_and_flat_points(void)
{
    static const cairn_vec2 points[] = { P(0, 0), P(1, 1), P(2, 0),   P(2, 2),    P(0, 2),   P(1, 0),  P(2, 2),
                                         P(0, 0), P(0, 1), P(1, 0.5), P(1.3, 2), P(0.1, 0), P(0.2, 0) };
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init_hull(&polygon, points, COUNT(points)));
    TEST_ASSERT_EQUAL(4, polygon.count);
    assert_close(4, number_of_wide(polygon.mass.area), MEASURE_ERROR);
    assert_sound(&polygon);
}

void test_the_hull_takes_as_many_points_as_twice_the_corners(void)
{
    cairn_vec2 points[2 * CAIRN_MAX_VERTICES];
    for (int i = 0; i < 2 * CAIRN_MAX_VERTICES; i++) {
        int x = i < 4 ? i : 0; /* a parabola, then the middle of it again and again */
        points[i] = cairn_vec2_of(cairn_real_from_int(x), cairn_real_from_int(x * x));
    }
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_polygon_init_hull(&polygon, points, 2 * CAIRN_MAX_VERTICES));
    TEST_ASSERT_EQUAL(4, polygon.count);
    assert_sound(&polygon);
}

void test_a_hull_of_too_many_corners_or_without_area_is_refused(void)
{
    cairn_vec2 points[2 * CAIRN_MAX_VERTICES];
    for (int i = 0; i < 2 * CAIRN_MAX_VERTICES; i++) {
        points[i] = cairn_vec2_of(cairn_real_from_int(i - 8), cairn_real_from_int((i - 8) * (i - 8)));
    }
    TEST_ASSERT_EQUAL(CAIRN_ERROR_SHAPE, cairn_polygon_init_hull(&polygon, points, 2 * CAIRN_MAX_VERTICES));
    for (int i = 0; i < 2 * CAIRN_MAX_VERTICES; i++) {
        points[i].y = points[i].x;
    }
    TEST_ASSERT_EQUAL(CAIRN_ERROR_SHAPE, cairn_polygon_init_hull(&polygon, points, 2 * CAIRN_MAX_VERTICES));
    for (int i = 0; i < 2 * CAIRN_MAX_VERTICES; i++) {
        points[i] = points[0];
    }
    TEST_ASSERT_EQUAL(CAIRN_ERROR_SHAPE, cairn_polygon_init_hull(&polygon, points, 2 * CAIRN_MAX_VERTICES));
    points[0].x = CAIRN_F(300);
    TEST_ASSERT_EQUAL(CAIRN_ERROR_SHAPE, cairn_polygon_init_hull(&polygon, points, 2 * CAIRN_MAX_VERTICES));
}
