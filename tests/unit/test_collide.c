/*
 * The narrow phase against closed forms. Poses are given by hand, so that nothing but the geometry is tested; the last
 * part puts bodies into a world to show that the order of the two does not matter.
 */
# include "../../src/engine.h" /* the space keeps these out of the generated runner, which lies elsewhere */
# include "../support/yard.h"
# include "../support/test_number.h"

/* Half a step of Q10.22 for each of a few roundings. */
#define FINE 2e-6
#define REACH CAIRN_OFFSET(0.01)

#ifdef CAIRN_DOUBLE
#define ASSERT_OFFSET(within, expected, actual) TEST_ASSERT_DOUBLE_WITHIN(within, expected, actual)
#define ASSERT_UNIT(expected, actual) TEST_ASSERT_DOUBLE_WITHIN(1e-8, expected, actual)
#else
#define ASSERT_OFFSET(within, expected, actual) TEST_ASSERT_INT32_WITHIN(CAIRN_OFFSET(within), CAIRN_OFFSET(expected), actual)
#define ASSERT_UNIT(expected, actual) TEST_ASSERT_INT32_WITHIN(CAIRN_UNIT(1e-8), CAIRN_UNIT(expected), actual)
#endif

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape disc = CAIRN_CIRCLE(CAIRN_F(1));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape slab = CAIRN_BOX(CAIRN_F(4), CAIRN_F(1));
static cairn_polygon square, slab4, triangle, octagon; /* square and slab4: the box and the slab as polygons */
static cairn_manifold m;

void setUp(void)
{
    static const cairn_vec2 of_square[] = { { CAIRN_F(0.5), CAIRN_F(-0.5) }, { CAIRN_F(0.5), CAIRN_F(0.5) }, { CAIRN_F(-0.5), CAIRN_F(0.5) }, { CAIRN_F(-0.5), CAIRN_F(-0.5) } };
    static const cairn_vec2 of_slab[] = { { CAIRN_F(2), CAIRN_F(-0.5) }, { CAIRN_F(2), CAIRN_F(0.5) }, { CAIRN_F(-2), CAIRN_F(0.5) }, { CAIRN_F(-2), CAIRN_F(-0.5) } };
    static const cairn_vec2 of_triangle[] = { { CAIRN_F(0), CAIRN_F(-2) }, { CAIRN_F(3), CAIRN_F(1) }, { CAIRN_F(-3), CAIRN_F(1) } };
    ASSERT_OK(cairn_polygon_init(&square, of_square, 4));
    ASSERT_OK(cairn_polygon_init(&slab4, of_slab, 4));
    ASSERT_OK(cairn_polygon_init(&triangle, of_triangle, 3));
    ASSERT_OK(cairn_polygon_init_regular(&octagon, 8, CAIRN_F(1)));
    memset(&m, 0x55, sizeof m);
}
void tearDown(void) {}

static cairn_pose pose(const cairn_shape *shape, cairn_offset x, cairn_offset y, cairn_angle angle)
{
    cairn_pose p;
    p.shape = shape;
    p.x = x;
    p.y = y;
    cairn_angle_rotation(angle, &p.c, &p.s);
    return p;
}

/* By the code that serves these two kinds; a polygon before a box has none of its own, as the engine turns the pair round. */
static void collide(const cairn_pose *a, const cairn_pose *b)
{
    if (a->shape->kind->rank <= b->shape->kind->rank) {
        b->shape->kind->collide[a->shape->kind->rank](a, b, REACH, &m);
    } else {
        cairn_collide_polygons(a, b, REACH, &m);
    }
}

/* The first at the origin, the second turned and placed: plain numbers of metres and degrees. */
#define COLLIDE(first, second, x, y, degrees) \
    do { \
        cairn_pose pose_a = pose(first, 0, 0, 0), pose_b = pose(second, CAIRN_OFFSET(x), CAIRN_OFFSET(y), CAIRN_DEGREES(degrees)); \
        collide(&pose_a, &pose_b); \
    } while (0)

#define ASSERT_NORMAL(x, y) \
    do { \
        ASSERT_UNIT(x, m.normal_x); \
        ASSERT_UNIT(y, m.normal_y); \
    } while (0)

/* The same where the direction is that of two offsets, each rounded. */
#define ASSERT_DIRECTION(x, y) \
    do { \
        ASSERT_OFFSET(FINE, x, cairn_offset_mul(CAIRN_OFFSET(1), m.normal_x)); \
        ASSERT_OFFSET(FINE, y, cairn_offset_mul(CAIRN_OFFSET(1), m.normal_y)); \
    } while (0)

#define ASSERT_POINT(i, at_x, at_y, distance) \
    do { \
        ASSERT_OFFSET(FINE, at_x, m.points[i].x); \
        ASSERT_OFFSET(FINE, at_y, m.points[i].y); \
        ASSERT_OFFSET(FINE, distance, m.points[i].separation); \
    } while (0)

/* ---- circles ---- */

void test_circles_beyond_reach_have_no_contact_on_any_side(void)
{
    COLLIDE(&ball, &disc, 1.52, 0, 0);
    TEST_ASSERT_EQUAL_INT(0, m.count);
    COLLIDE(&ball, &disc, -1.52, 0, 0);
    TEST_ASSERT_EQUAL_INT(0, m.count);
    COLLIDE(&ball, &disc, 0, 1.52, 0);
    TEST_ASSERT_EQUAL_INT(0, m.count);
    COLLIDE(&ball, &disc, 0, -1.52, 0);
    TEST_ASSERT_EQUAL_INT(0, m.count);
    COLLIDE(&ball, &disc, 1.2, 1.2, 0); /* their boxes overlap */
    TEST_ASSERT_EQUAL_INT(0, m.count);
}

void test_circles_within_reach_but_apart_have_a_positive_separation(void)
{
    COLLIDE(&ball, &disc, 0, 1.508, 0);
    TEST_ASSERT_EQUAL_INT(1, m.count);
    ASSERT_NORMAL(0, 1);
    ASSERT_POINT(0, 0, 0.504, 0.008);
}

/* 3-4-5: the centres are 1.25 apart, the overlap 0.25, the point half way between the surfaces. */
void test_circles_that_overlap_tell_depth_normal_and_the_point_between(void)
{
    COLLIDE(&ball, &disc, 0.75, -1, 0);
    TEST_ASSERT_EQUAL_INT(1, m.count);
    ASSERT_NORMAL(0.6, -0.8);
    ASSERT_POINT(0, 0.375 * 0.6, 0.375 * -0.8, -0.25);
}

void test_concentric_circles_are_pushed_apart_along_x(void)
{
    COLLIDE(&ball, &disc, 0, 0, 0);
    TEST_ASSERT_EQUAL_INT(1, m.count);
    ASSERT_NORMAL(1, 0);
    ASSERT_OFFSET(FINE, -1.5, m.points[0].separation);
}

/* ---- circle and polygon ---- */

/* The same for the box, told by two numbers, and for its polygon. */
static const cairn_shape *as_box_or_polygon(int i) { return i == 0 ? &box : &square.shape; }

void test_a_circle_on_each_face_of_a_box_touches_along_the_face_normal(void)
{
    for (int i = 0; i < 2; i++) {
        const cairn_shape *shape = as_box_or_polygon(i);
        COLLIDE(&ball, shape, 0.9, 0.2, 0); /* the box lies to the right: its left face is met */
        TEST_ASSERT_EQUAL_INT(1, m.count);
        ASSERT_NORMAL(1, 0);
        ASSERT_POINT(0, 0.45, 0, -0.1);
        COLLIDE(&ball, shape, -0.9, 0.2, 0);
        ASSERT_NORMAL(-1, 0);
        ASSERT_POINT(0, -0.45, 0, -0.1);
        COLLIDE(&ball, shape, 0.3, 0.9, 0);
        ASSERT_NORMAL(0, 1);
        ASSERT_POINT(0, 0, 0.45, -0.1);
        COLLIDE(&ball, shape, 0.3, -0.9, 0);
        ASSERT_NORMAL(0, -1);
        ASSERT_POINT(0, 0, -0.45, -0.1);
    }
}

/* The corner is at (0.29, 0.39) from the centre of the circle, in each of the four directions. */
void test_a_circle_beyond_the_end_of_a_face_touches_the_corner(void)
{
    for (int i = 0; i < 2; i++) {
        const cairn_shape *shape = as_box_or_polygon(i);
        COLLIDE(&ball, shape, 0.79, 0.89, 0);
        TEST_ASSERT_EQUAL_INT(1, m.count);
        ASSERT_OFFSET(FINE, -0.5 + 0.4860041, m.points[0].separation); /* |(0.29, 0.39)| */
        ASSERT_DIRECTION(0.5967028, 0.8024623);
        COLLIDE(&ball, shape, -0.79, 0.89, 0);
        ASSERT_DIRECTION(-0.5967028, 0.8024623);
        COLLIDE(&ball, shape, 0.79, -0.89, 0);
        ASSERT_DIRECTION(0.5967028, -0.8024623);
        COLLIDE(&ball, shape, -0.79, -0.89, 0);
        ASSERT_DIRECTION(-0.5967028, -0.8024623);
    }
}

void test_a_circle_near_a_face_but_beyond_reach_of_its_corner_has_no_contact(void)
{
    COLLIDE(&ball, &box, 0.88, 0.88, 0); /* 0.38 from both faces' lines, 0.537 from the corner */
    TEST_ASSERT_EQUAL_INT(0, m.count);
    COLLIDE(&ball, &box, 1.02, 0, 0);
    TEST_ASSERT_EQUAL_INT(0, m.count);
    COLLIDE(&ball, &box, 1.008, 0, 0);
    TEST_ASSERT_EQUAL_INT(1, m.count);
    ASSERT_POINT(0, 0.504, 0, 0.008);
}

void test_a_circle_whose_centre_is_inside_leaves_by_the_nearest_face(void)
{
    COLLIDE(&ball, &box, -0.3, 0.1, 0); /* its centre is 0.2 from the right face */
    TEST_ASSERT_EQUAL_INT(1, m.count);
    ASSERT_NORMAL(-1, 0);
    ASSERT_POINT(0, -(0.5 - 0.35), 0, -0.7);
    COLLIDE(&ball, &box, 0.5, 0, 0); /* on the face */
    ASSERT_NORMAL(1, 0);
    ASSERT_POINT(0, 0.25, 0, -0.5);
}

void test_a_circle_on_a_turned_box_touches_along_the_turned_normal(void)
{
    COLLIDE(&ball, &slab, -0.9 * 0.5, 0.9 * 0.8660254, 30); /* 0.9 along the slab's y axis: its lower face is met */
    TEST_ASSERT_EQUAL_INT(1, m.count);
    ASSERT_NORMAL(-0.5, 0.8660254);
    ASSERT_POINT(0, -0.45 * 0.5, 0.45 * 0.8660254, -0.1);
}

void test_a_circle_on_an_off_centre_triangle_touches_its_slanted_face(void)
{
    /* the face from (3, 1) to (-3, 1) is the upper one; its middle is 1 above the centroid */
    COLLIDE(&ball, &triangle.shape, 0, -1.4, 0);
    ASSERT_NORMAL(0, -1);
    ASSERT_POINT(0, 0, -0.45, -0.1);
    /* the face to the lower right has the normal (1, -1) / sqrt 2 and is sqrt 2 from the centroid */
    COLLIDE(&ball, &triangle.shape, -1.31414214, 1.31414214, 0);
    ASSERT_NORMAL(-0.70710678, 0.70710678);
    ASSERT_OFFSET(FINE, 1.8584776 - 1.41421356 - 0.5, m.points[0].separation);
}

void test_contacts_of_a_circle_are_named_by_the_face_or_corner(void)
{
    COLLIDE(&ball, &box, 0.9, 0.2, 0);
    uint16_t face = m.points[0].feature;
    COLLIDE(&ball, &box, 0.95, -0.2, 1);
    TEST_ASSERT_EQUAL_UINT16(face, m.points[0].feature);
    COLLIDE(&ball, &box, 0, 0.9, 0);
    TEST_ASSERT_NOT_EQUAL(face, m.points[0].feature);
    COLLIDE(&ball, &box, 0.79, 0.89, 0);
    uint16_t corner = m.points[0].feature;
    TEST_ASSERT_NOT_EQUAL(face, corner);
    COLLIDE(&ball, &box, 0.80, 0.88, 1);
    TEST_ASSERT_EQUAL_UINT16(corner, m.points[0].feature);
}

/* ---- polygons ---- */

/* Both kinds of box, in all four mixtures. */
static const cairn_shape *lower_of(int i) { return i & 1 ? &slab4.shape : &slab; }
static const cairn_shape *upper_of(int i) { return i & 2 ? &square.shape : &box; }

/* Which of the two points lies to the left. */
static int left_point(void) { return m.points[0].x < m.points[1].x ? 0 : 1; }

void test_a_box_flat_on_a_slab_has_two_points_at_its_corners(void)
{
    for (int i = 0; i < 4; i++) {
        COLLIDE(lower_of(i), upper_of(i), 1, 0.95, 0);
        TEST_ASSERT_EQUAL_INT(2, m.count);
        ASSERT_NORMAL(0, 1);
        int left = left_point();
        ASSERT_POINT(left, 0.5, 0.475, -0.05);
        ASSERT_POINT(1 - left, 1.5, 0.475, -0.05);
    }
}

void test_a_box_over_the_end_of_a_slab_is_clipped_at_the_end(void)
{
    for (int i = 0; i < 4; i++) {
        COLLIDE(lower_of(i), upper_of(i), 2.25, 0.95, 0);
        TEST_ASSERT_EQUAL_INT(2, m.count);
        int left = left_point();
        ASSERT_POINT(left, 1.75, 0.475, -0.05);
        ASSERT_POINT(1 - left, 2, 0.475, -0.05);
        COLLIDE(lower_of(i), upper_of(i), -2.25, 0.95, 0);
        TEST_ASSERT_EQUAL_INT(2, m.count);
        left = left_point();
        ASSERT_POINT(left, -2, 0.475, -0.05);
        ASSERT_POINT(1 - left, -1.75, 0.475, -0.05);
    }
}

/* The lowest corner of the turned box is sqrt(1/2) below its centre. */
void test_a_box_on_its_corner_has_one_point(void)
{
    for (int i = 0; i < 4; i++) {
        COLLIDE(lower_of(i), upper_of(i), 0.3, 1.15, 45);
        TEST_ASSERT_EQUAL_INT(1, m.count);
        ASSERT_NORMAL(0, 1);
        ASSERT_POINT(0, 0.3, 0.5 + (0.65 - 0.70710678) / 2, 0.65 - 0.70710678);
    }
}

/* Standing on its corner upside down: now the second body has the flat face, and the normal still goes from a to b. */
void test_a_flat_face_on_a_corner_has_one_point_too(void)
{
    for (int i = 0; i < 4; i++) {
        const cairn_shape *flat = lower_of(i), *turned = upper_of(i);
        cairn_pose a = pose(turned, 0, 0, CAIRN_DEGREES(45)), b = pose(flat, CAIRN_OFFSET(0.3), CAIRN_OFFSET(1.15), 0);
        collide(&a, &b);
        TEST_ASSERT_EQUAL_INT(1, m.count);
        ASSERT_NORMAL(0, 1);
        ASSERT_POINT(0, 0, 0.65 + (0.70710678 - 0.65) / 2, 0.65 - 0.70710678);
    }
}

/* By 10 degrees: the lower corner is 0.5 (cos 10 + sin 10) = 0.5792280 below the centre, the other one out of reach. */
void test_a_tilted_box_has_only_the_corners_within_reach(void)
{
    COLLIDE(&slab, &box, 0, 1.05, 10);
    TEST_ASSERT_EQUAL_INT(1, m.count);
    ASSERT_OFFSET(FINE, 0.55 - 0.5792280, m.points[0].separation);
    COLLIDE(&slab, &box, 0, 1.0, 0.5); /* both corners are within 1 cm */
    TEST_ASSERT_EQUAL_INT(2, m.count);
}

void test_separated_polygons_have_no_contact_whoever_has_the_separating_axis(void)
{
    for (int i = 0; i < 4; i++) {
        COLLIDE(lower_of(i), upper_of(i), 0, 1.02, 0);
        TEST_ASSERT_EQUAL_INT(0, m.count);
        COLLIDE(lower_of(i), upper_of(i), 2.48, 0.9, 45); /* off the corner: the turned box's face separates */
        TEST_ASSERT_EQUAL_INT(0, m.count);
        COLLIDE(lower_of(i), upper_of(i), -2.52, 0, 0);
        TEST_ASSERT_EQUAL_INT(0, m.count);
    }
}

/* Corner to corner within reach of both faces' lines, yet beside both faces: clipping leaves nothing or the corner. */
void test_corner_to_corner_gives_at_most_one_point_near_the_corners(void)
{
    COLLIDE(&slab, &box, 2.505, 1.005, 0);
    TEST_ASSERT_TRUE(m.count <= 1);
    COLLIDE(&slab4.shape, &square.shape, 2.505, 1.005, 0);
    TEST_ASSERT_TRUE(m.count <= 1);
    COLLIDE(&slab4.shape, &square.shape, -2.505, 1.005, 0);
    TEST_ASSERT_TRUE(m.count <= 1);
}

/* Two boxes in nearly one place: out by the shortest way, by nearly a whole side. */
void test_deep_overlap_gives_the_axis_of_least_depth(void)
{
    for (int i = 0; i < 2; i++) {
        const cairn_shape *shape = as_box_or_polygon(i);
        COLLIDE(shape, shape, 0.25, 0.125, 0);
        TEST_ASSERT_EQUAL_INT(2, m.count);
        ASSERT_NORMAL(1, 0);
        ASSERT_OFFSET(FINE, -0.75, m.points[0].separation);
        ASSERT_OFFSET(FINE, -0.75, m.points[1].separation);
        COLLIDE(shape, shape, 0.125, -0.25, 0);
        ASSERT_NORMAL(0, -1);
        ASSERT_OFFSET(FINE, -0.75, m.points[0].separation);
    }
}

void test_a_triangle_on_its_tip_has_one_point(void)
{
    /* its tip is 2 below the centroid */
    COLLIDE(&slab, &triangle.shape, 0.5, 2.45, 0);
    TEST_ASSERT_EQUAL_INT(1, m.count);
    ASSERT_NORMAL(0, 1);
    ASSERT_POINT(0, 0.5, 0.475, -0.05);
}

/* Octagons side by side: whatever their turn, never more than two points, and never deeper than they overlap. */
void test_two_points_are_the_most(void)
{
    for (int turn = 0; turn < 24; turn++) {
        cairn_pose a = pose(&octagon.shape, 0, 0, 0);
        cairn_pose b = pose(&octagon.shape, CAIRN_OFFSET(1.8), CAIRN_OFFSET(0.1), cairn_angle_of_turn(turn, 24));
        cairn_collide_polygons(&a, &b, REACH, &m);
        TEST_ASSERT_TRUE(m.count == 1 || m.count == 2);
        for (int i = 0; i < m.count; i++) {
            TEST_ASSERT_TRUE(m.points[i].separation > CAIRN_OFFSET(-0.2) && m.points[i].separation <= REACH);
        }
        TEST_ASSERT_TRUE(m.normal_x > CAIRN_UNIT(0.8));
    }
}

/* ---- names of points ---- */

void test_points_keep_their_names_while_a_box_slides_and_rocks(void)
{
    for (int i = 0; i < 4; i++) {
        COLLIDE(lower_of(i), upper_of(i), 0, 0.99, 0);
        uint16_t first = m.points[0].feature, second = m.points[1].feature;
        TEST_ASSERT_NOT_EQUAL(first, second);
        COLLIDE(lower_of(i), upper_of(i), 0.4, 0.995, 0.3);
        TEST_ASSERT_EQUAL_INT(2, m.count);
        TEST_ASSERT_EQUAL_UINT16(first, m.points[0].feature);
        TEST_ASSERT_EQUAL_UINT16(second, m.points[1].feature);
        COLLIDE(lower_of(i), upper_of(i), -0.4, 0.995, -0.3);
        TEST_ASSERT_EQUAL_UINT16(first, m.points[0].feature);
        TEST_ASSERT_EQUAL_UINT16(second, m.points[1].feature);
    }
}

/* Is there a point of this name near this place? */
static bool has_point(uint16_t feature, cairn_offset x)
{
    for (int i = 0; i < m.count; i++) {
        cairn_offset away = m.points[i].x - x;
        if (m.points[i].feature == feature && away < CAIRN_OFFSET(0.05) && -away < CAIRN_OFFSET(0.05)) {
            return true;
        }
    }
    return false;
}

/* Rocking on one another, now the lower, now the upper face is the reference: the points keep their names. */
void test_points_keep_their_names_when_the_reference_face_changes(void)
{
    for (int i = 0; i < 2; i++) {
        const cairn_shape *shape = as_box_or_polygon(i);
        COLLIDE(shape, shape, 0, 0.995, 0);
        cairn_manifold before = m;
        /* a tilt about a corner of the lower box: the face of the upper box separates more */
        cairn_pose a = pose(shape, 0, 0, CAIRN_DEGREES(-0.4)), b = pose(shape, CAIRN_OFFSET(0.25), CAIRN_OFFSET(1.0), 0);
        collide(&a, &b);
        TEST_ASSERT_EQUAL_INT(2, m.count);
        for (int k = 0; k < 2; k++) {
            TEST_ASSERT_TRUE(has_point(before.points[k].feature, m.points[k].x));
        }
    }
}

/* ---- boxes by their own code and as polygons ---- */

static cairn_offset random_offset(uint32_t *seed, int32_t thousandths)
{
#ifdef CAIRN_DOUBLE
    return random_between(seed, -thousandths, thousandths) / 1000.0;
#else
    return random_between(seed, -thousandths, thousandths) * 4194 ;
#endif
}

/* To the same bits, where faces tie as well: on the axes and the diagonals, and turned by eighths. */
void test_boxes_collide_as_their_polygons_do(void)
{
    uint32_t seed = 5;
    int contacts = 0;
    for (int n = 0; n < 20000; n++) {
        int turns = n & 1 ? 8 : 1000;
        cairn_angle turn_a = cairn_angle_of_turn(random_between(&seed, 0, turns - 1), turns), turn_b = cairn_angle_of_turn(random_between(&seed, 0, turns - 1), turns);
        cairn_offset x = random_offset(&seed, 2200), y = n % 5 == 0 ? x : n % 5 == 1 ? 0 : random_offset(&seed, 2200);
        cairn_pose a = pose(n & 2 ? &box : &slab, 0, 0, turn_a), b = pose(&box, n % 7 == 0 ? 0 : n % 7 == 1 ? -x : x, y, turn_b);
        cairn_pose a4 = a, b4 = b;
        cairn_manifold m4;
        a4.shape = n & 2 ? &square.shape : &slab4.shape;
        b4.shape = &square.shape;
        memset(&m4, 0x55, sizeof m4);
        memset(&m, 0x55, sizeof m);
        cairn_collide_boxes(&a, &b, REACH, &m);
        cairn_collide_polygons(&a4, &b4, REACH, &m4);
#ifdef CAIRN_DOUBLE
        continue; /* the polygons' corners and normals are off by a last bit there, and ties fall otherwise */
#endif
        TEST_ASSERT_EQUAL_INT(m4.count, m.count);
        contacts += m.count != 0;
        for (int i = 0; i < m.count; i++) {
            ASSERT_SAME(m4.normal_x, m.normal_x);
            ASSERT_SAME(m4.normal_y, m.normal_y);
            ASSERT_SAME(m4.separation, m.separation);
            TEST_ASSERT_EQUAL_UINT16(m4.points[i].feature, m.points[i].feature);
            ASSERT_SAME(m4.points[i].x, m.points[i].x);
            ASSERT_SAME(m4.points[i].y, m.points[i].y);
            ASSERT_SAME(m4.points[i].separation, m.points[i].separation);
        }
    }
#ifndef CAIRN_DOUBLE
    TEST_ASSERT_TRUE(contacts > 5000);
#endif
}

/* ---- how far the normal holds ---- */

/* By its length along both axes, which is less than `steady`. */
static void move_by_less(cairn_pose *p, cairn_offset steady, uint32_t *seed)
{
    int32_t part = random_between(seed, 0, 999), sign = random_between(seed, 0, 3);
    cairn_offset x = steady / 1000 * part, y = steady / 1000 * (999 - part);
    p->x += sign & 1 ? x : -x;
    p->y += sign & 2 ? y : -y;
}

static int count_steady(const cairn_shape *first, const cairn_shape *second, int32_t apart)
{
    uint32_t seed = 7;
    int steady = 0;
    for (int i = 0; i < 2000; i++) {
        cairn_pose a = pose(first, 0, 0, cairn_angle_of_turn(random_between(&seed, 0, 359), 360));
        cairn_pose b = pose(second, random_offset(&seed, apart), random_offset(&seed, apart), cairn_angle_of_turn(random_between(&seed, 0, 359), 360));
        collide(&a, &b);
        if (m.count != 0 && m.steady > 0) {
            cairn_manifold before = m;
            steady++;
            move_by_less(&b, before.steady, &seed);
            collide(&a, &b);
            TEST_ASSERT_TRUE(m.count == 0 || (m.normal_x == before.normal_x && m.normal_y == before.normal_y));
        }
    }
    return steady;
}

void test_moved_by_less_than_it_is_steady_for_a_contact_keeps_its_normal(void)
{
    TEST_ASSERT_GREATER_THAN_INT(200, count_steady(&octagon.shape, &octagon.shape, 2000));
    TEST_ASSERT_GREATER_THAN_INT(200, count_steady(&triangle.shape, &square.shape, 2500));
    TEST_ASSERT_GREATER_THAN_INT(200, count_steady(&slab4.shape, &triangle.shape, 2500));
    TEST_ASSERT_GREATER_THAN_INT(200, count_steady(&ball, &octagon.shape, 1500));
    TEST_ASSERT_GREATER_THAN_INT(200, count_steady(&disc, &slab, 2500));
}

/* ---- both orders of a pair ---- */

static void assert_contact(const cairn_shape *first, const cairn_shape *second)
{
    cairn_contact contact;
    open_yard(0);
    cairn_body_id a = put(first, CAIRN_F(5), CAIRN_F(3)), b = put(second, CAIRN_F(5), CAIRN_F(3.99));
    run(1);
    TEST_ASSERT_TRUE(contact_of(a, b, &contact));
    TEST_ASSERT_TRUE(same(contact.a, a));
    ASSERT_NEAR_VEC2(LSB, 0, 1, contact.normal);
    for (int i = 0; i < contact.count; i++) {
        ASSERT_NEAR(0.001, 3.495, contact.points[i].position.y);
    }
}

void test_the_normal_goes_from_the_first_body_to_the_second_whatever_their_shapes(void)
{
    const cairn_shape *shapes[] = { &ball, &box, &square.shape };
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            assert_contact(shapes[i], shapes[k]);
        }
    }
}

void test_a_circle_meets_a_box_as_it_does_the_same_polygon(void)
{
    uint32_t seed = 7;
    for (int i = 0; i < 20000; i++) {
        /* Some on the lines where two faces are as near, or a coordinate is zero. */
        cairn_offset x = random_offset(&seed, 3000), y = i % 5 == 0 ? x : i % 5 == 1 ? 0 : random_offset(&seed, 1500);
        cairn_angle angle = i % 3 == 0 ? cairn_angle_of_turn(i % 4, 4) : cairn_angle_of_turn(random_between(&seed, 0, 999), 1000);
        cairn_pose a = pose(i & 1 ? &ball : &disc, i % 7 == 0 ? -x : x, i % 11 == 0 ? -y : y, 0);
        cairn_pose b = pose(i & 2 ? &box : &slab, 0, 0, i % 4 == 3 ? 0 : angle), c = b;
        cairn_manifold of_box, of_polygon;
        c.shape = i & 2 ? &square.shape : &slab4.shape;
        memset(&of_box, 0x55, sizeof of_box);
        memcpy(&of_polygon, &of_box, sizeof of_box);
        cairn_collide_circle_box(&a, &b, REACH, &of_box);
        cairn_collide_circle_polygon(&a, &c, REACH, &of_polygon);
#ifdef CAIRN_DOUBLE
        continue; /* the polygons' corners and normals are off by a last bit there, and ties fall otherwise */
#endif
        TEST_ASSERT_EQUAL_INT(of_polygon.count, of_box.count);
        if (of_box.count != 0) {
            ASSERT_SAME(of_polygon.normal_x, of_box.normal_x);
            ASSERT_SAME(of_polygon.normal_y, of_box.normal_y);
            ASSERT_SAME(of_polygon.separation, of_box.separation);
            ASSERT_SAME(of_polygon.points[0].x, of_box.points[0].x);
            ASSERT_SAME(of_polygon.points[0].y, of_box.points[0].y);
            ASSERT_SAME(of_polygon.points[0].separation, of_box.points[0].separation);
            TEST_ASSERT_EQUAL_UINT16(of_polygon.points[0].feature, of_box.points[0].feature);
            ASSERT_SAME(of_polygon.steady, of_box.steady);
        }
    }
}
