/* Sensors report contacts and do not push. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(40), CAIRN_F(1));
static cairn_contact contact;

void setUp(void) { open_yard(CAIRN_F(-10)); }
void tearDown(void) {}

static cairn_body_id put_sensor(const cairn_shape *shape, cairn_real x, cairn_real y, cairn_body_type type)
{
    yard_def def = def_at(shape, x, y);
    def.type = type;
    def.sensor = true;
    return make(&def);
}

void test_a_ball_falls_through_a_sensor_as_through_air(void)
{
    put_sensor(&box, 0, CAIRN_F(-2), CAIRN_STATIC);
    cairn_body_id id = put(&ball, 0, 0);
    run(60);
    ASSERT_NEAR(2 * LSB, -5, y_of(id));
    ASSERT_NEAR(LSB, 0, spin_of(id));
}

/* The box is entered 1 m and left 3 m further down: at 0.447 s and 0.775 s. Each is seen in the step after it. */
void test_a_sensor_tells_when_a_body_enters_and_when_it_leaves(void)
{
    cairn_body_id sensor = put_sensor(&box, 0, CAIRN_F(-2), CAIRN_STATIC), id = put(&ball, 0, 0);
    int first = 0, last = 0, began = 0;
    for (int step = 1; step <= 60; step++) {
        run(1);
        if (contact_of(sensor, id, &contact) && contact.touching) {
            TEST_ASSERT_TRUE(contact.sensor);
            first = first == 0 ? step : first;
            last = step;
            began += contact.began;
        }
    }
    TEST_ASSERT_EQUAL_INT(1, began);
    TEST_ASSERT_INT_WITHIN(1, 28, first);
    TEST_ASSERT_INT_WITHIN(1, 47, last);
}

void test_what_a_sensor_touches_is_listed_and_presses_with_nothing(void)
{
    cairn_body_id sensor = put_sensor(&box, 0, 0, CAIRN_STATIC), id = put(&ball, 0, CAIRN_F(0.2)), other;
    int cursor = 0;
    run(1);
    TEST_ASSERT_TRUE(cairn_body_next_touched(world, sensor, &cursor, &other));
    TEST_ASSERT_TRUE(same(other, id));
    TEST_ASSERT_TRUE(contact_of(sensor, id, &contact));
    TEST_ASSERT_EQUAL_INT(1, contact.count);
    ASSERT_SAME(0, contact.points[0].impulse);
    TEST_ASSERT_EQUAL_UINT16(1, stats()->arbiters);
    TEST_ASSERT_EQUAL_UINT16(0, stats()->points); /* points are those that push */
}

void test_a_dynamic_sensor_falls_through_the_floor_and_reports_it(void)
{
    cairn_body_id floor_id = put_static(&ground, 0, CAIRN_F(-1.5)), sensor = put_sensor(&ball, 0, 0, CAIRN_DYNAMIC);
    bool touched = false;
    for (int i = 0; i < 60; i++) {
        run(1);
        touched = touched || are_touching(floor_id, sensor);
    }
    TEST_ASSERT_TRUE(touched);
    ASSERT_NEAR(2 * LSB, -5, y_of(sensor));
}

void test_a_moving_kinematic_sensor_sweeps_over_bodies_without_moving_them(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, 0)));
    cairn_body_id sensor = put_sensor(&box, CAIRN_F(-3), 0, CAIRN_KINEMATIC), id = put(&ball, 0, 0);
    ASSERT_OK(cairn_body_set_velocity(world, sensor, at(CAIRN_F(6), 0)));
    int steps = 0;
    for (int i = 0; i < 60; i++) {
        run(1);
        steps += are_touching(sensor, id);
    }
    TEST_ASSERT_INT_WITHIN(1, 20, steps); /* 2 m of overlap at 6 m/s */
    ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_position(world, id));
}

void test_sensors_report_one_another(void)
{
    cairn_body_id a = put_sensor(&box, 0, 0, CAIRN_STATIC), b = put_sensor(&ball, 0, CAIRN_F(0.3), CAIRN_DYNAMIC);
    run(1);
    TEST_ASSERT_TRUE(are_touching(a, b));
}

void test_a_sensor_obeys_layers(void)
{
    yard_def def = def_at(&box, 0, 0);
    def.type = CAIRN_STATIC;
    def.sensor = true;
    def.mask = 2;
    cairn_body_id sensor = make(&def), id = put(&ball, 0, 0);
    run(1);
    TEST_ASSERT_FALSE(contact_of(sensor, id, &contact));
    ASSERT_OK(set_layers(id, 2, 0xFFFF));
    run(1);
    TEST_ASSERT_TRUE(are_touching(sensor, id));
}

/* A box at rest that a sensor holds falls asleep all the same, and stays reported. */
void test_a_sensor_keeps_nothing_awake_and_wakes_nothing(void)
{
    ASSERT_OK(cairn_sleep_enable(world));
    put_static(&ground, 0, CAIRN_F(-0.5));
    cairn_body_id id = put(&box, 0, CAIRN_F(0.5)), sensor = put_sensor(&box, 0, CAIRN_F(0.7), CAIRN_STATIC);
    run(120);
    TEST_ASSERT_FALSE(cairn_body_is_awake(world, id));
    TEST_ASSERT_TRUE(are_touching(sensor, id));
    cairn_body_id passing = put_sensor(&ball, 0, CAIRN_F(3), CAIRN_DYNAMIC);
    run(60);
    TEST_ASSERT_FALSE(cairn_body_is_awake(world, id));
    TEST_ASSERT_TRUE(y_of(passing) < CAIRN_F(-1));
}
