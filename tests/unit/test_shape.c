/* Shapes: sizes that are taken and refused, and measures against closed forms. Polygons have a file of their own. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static cairn_mass_data mass;

void setUp(void) { memset(&mass, 0x55, sizeof mass); }
void tearDown(void) {}

static void assert_refused(cairn_status status, const cairn_shape *shape)
{
    cairn_mass_data before;
    memset(&before, 0x55, sizeof before);
    TEST_ASSERT_EQUAL_INT(status, cairn_shape_measure(shape, &mass));
    TEST_ASSERT_EQUAL_MEMORY(&before, &mass, sizeof mass);
}

void test_measure_refuses_null(void)
{
    static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(1));
    cairn_shape kindless = CAIRN_CIRCLE(CAIRN_F(1));
    kindless.kind = NULL;
    assert_refused(CAIRN_ERROR_NULL, NULL);
    assert_refused(CAIRN_ERROR_NULL, &kindless);
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_shape_measure(&ball, NULL));
}

void test_a_circle_has_a_radius_of_1_mm_to_125_m(void)
{
    static const cairn_shape small = CAIRN_CIRCLE(CAIRN_F(0.0009)), smallest = CAIRN_CIRCLE(CAIRN_SHAPE_RADIUS_MIN);
    static const cairn_shape large = CAIRN_CIRCLE(CAIRN_F(125.001)), largest = CAIRN_CIRCLE(CAIRN_SHAPE_RADIUS_MAX);
    static const cairn_shape none = CAIRN_CIRCLE(0), negative = CAIRN_CIRCLE(CAIRN_F(-1));
    assert_refused(CAIRN_ERROR_SHAPE, &small);
    assert_refused(CAIRN_ERROR_SHAPE, &large);
    assert_refused(CAIRN_ERROR_SHAPE, &none);
    assert_refused(CAIRN_ERROR_SHAPE, &negative);
    ASSERT_OK(cairn_shape_measure(&smallest, &mass));
    ASSERT_OK(cairn_shape_measure(&largest, &mass));
}

void test_a_box_has_sides_of_1_mm_at_least_and_corners_within_125_m(void)
{
    static const cairn_shape refused[] = {
        CAIRN_BOX(CAIRN_F(0.0009), CAIRN_F(1)), CAIRN_BOX(CAIRN_F(1), CAIRN_F(0.0009)), CAIRN_BOX(CAIRN_F(-1), CAIRN_F(1)),
        CAIRN_BOX(CAIRN_F(1), CAIRN_F(-1)),     CAIRN_BOX(CAIRN_F(251), CAIRN_F(1)),    CAIRN_BOX(CAIRN_F(1), CAIRN_F(251)),
        CAIRN_BOX(CAIRN_F(250), CAIRN_F(10)),   CAIRN_BOX(CAIRN_F(180), CAIRN_F(180)),
    };
    static const cairn_shape taken[] = {
        CAIRN_BOX(CAIRN_F(0.0010071), CAIRN_F(0.0010071)), CAIRN_BOX(CAIRN_F(249.9), CAIRN_F(0.1)), CAIRN_BOX(CAIRN_F(175), CAIRN_F(175)),
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        assert_refused(CAIRN_ERROR_SHAPE, &refused[i]);
    }
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++) {
        ASSERT_OK(cairn_shape_measure(&taken[i], &mass));
    }
}

void test_a_polygon_needs_its_data(void)
{
    static cairn_polygon blank;
    cairn_shape shape = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
    shape.kind = &cairn_polygon_class;
    assert_refused(CAIRN_ERROR_SHAPE, &shape);
    shape.polygon = &blank;
    blank.count = 2;
    assert_refused(CAIRN_ERROR_SHAPE, &shape);
    blank.count = CAIRN_MAX_VERTICES + 1;
    assert_refused(CAIRN_ERROR_SHAPE, &shape);
}

/* pi r^2; r / sqrt 2 */
void test_a_circle_measures_its_closed_form(void)
{
    static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(1.5)), tiny = CAIRN_CIRCLE(CAIRN_F(0.0078125));
    ASSERT_OK(cairn_shape_measure(&ball, &mass));
    ASSERT_NEAR(LSB, 7.0685835, cairn_wide_to_real(mass.area));
    ASSERT_NEAR(LSB, 1.0606602, cairn_wide_to_real(mass.gyration));
    ASSERT_OK(cairn_shape_measure(&tiny, &mass));
    ASSERT_NEAR(LSB, 1.9174760, cairn_wide_to_real(cairn_wide_mul(mass.area, cairn_wide_from_int(10000))));
    ASSERT_NEAR(LSB, 55.242717, cairn_wide_to_real(cairn_wide_mul(mass.gyration, cairn_wide_from_int(10000))));
}

/* w h; sqrt((w^2 + h^2) / 12) */
void test_a_box_measures_its_closed_form(void)
{
    static const cairn_shape plank = CAIRN_BOX(CAIRN_F(3), CAIRN_F(0.25)), slab = CAIRN_BOX(CAIRN_F(240), CAIRN_F(60));
    ASSERT_OK(cairn_shape_measure(&plank, &mass));
    ASSERT_NEAR(LSB, 0.75, cairn_wide_to_real(mass.area));
    ASSERT_NEAR(LSB, 0.86902723, cairn_wide_to_real(mass.gyration));
    ASSERT_OK(cairn_shape_measure(&slab, &mass));
    ASSERT_NEAR(LSB, 14400, cairn_wide_to_real(mass.area));
    ASSERT_NEAR(LSB, 71.414284, cairn_wide_to_real(mass.gyration));
}

/* Boxes of the broad phase hold the shape at any angle: two long planks side by side and turned alike. */
void test_bounding_boxes_turn_with_the_body(void)
{
    static const cairn_shape plank = CAIRN_BOX(CAIRN_F(4), CAIRN_F(0.2));
    static const cairn_shape probe = CAIRN_CIRCLE(CAIRN_F(0.1));
    cairn_contact contact;
    open_yard(0);
    yard_def def = def_at(&plank, 0, 0);
    def.angle = CAIRN_DEGREES(60);
    cairn_body_id turned_plank = make(&def);
    /* just beyond the end of the plank, 2 m up its axis, and where it would end unturned */
    cairn_body_id at_end = put(&probe, CAIRN_F(1.04), CAIRN_F(1.80)), beside = put(&probe, CAIRN_F(1.9), 0);
    run(1);
    TEST_ASSERT_TRUE(contact_of(turned_plank, at_end, &contact));
    TEST_ASSERT_FALSE(contact_of(turned_plank, beside, &contact));
}

void test_one_shape_serves_any_number_of_bodies(void)
{
    static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
    open_yard(0);
    yard_def light = def_at(&ball, 0, 0), heavy = def_at(&ball, CAIRN_F(3), 0);
    heavy.density = cairn_wide_from_int(100);
    cairn_body_id a = make(&light), b = make(&heavy);
    ASSERT_NEAR(LSB, 0.78539816, cairn_wide_to_real(cairn_body_mass(world, a)));
    ASSERT_NEAR(LSB, 78.539816, cairn_wide_to_real(cairn_body_mass(world, b)));
}
