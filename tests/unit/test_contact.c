/* Contacts as a game sees them: where, how deep, how hard, since when, and whom each body touched. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(40), CAIRN_F(1));
static cairn_body_id floor_id;
static cairn_contact contact;

void setUp(void)
{
    open_yard(CAIRN_F(-10));
    floor_id = put_static(&ground, 0, CAIRN_F(-0.5));
}
void tearDown(void) {}

/* ---- what is refused ---- */

void test_walking_contacts_refuses_null_and_cursors_out_of_range(void)
{
    int cursor = 0, before = -1, behind = 1;
    put(&ball, 0, CAIRN_F(0.5));
    run(1);
    TEST_ASSERT_FALSE(cairn_world_next_contact(NULL, &cursor, &contact));
    TEST_ASSERT_FALSE(cairn_world_next_contact(world, NULL, &contact));
    TEST_ASSERT_FALSE(cairn_world_next_contact(world, &cursor, NULL));
    TEST_ASSERT_FALSE(cairn_world_next_contact(world, &before, &contact));
    TEST_ASSERT_FALSE(cairn_world_next_contact(world, &behind, &contact));
    TEST_ASSERT_EQUAL_INT(0, cursor);
    TEST_ASSERT_TRUE(cairn_world_next_contact(world, &cursor, &contact));
    TEST_ASSERT_EQUAL_INT(1, cursor);
    TEST_ASSERT_FALSE(cairn_world_next_contact(world, &cursor, &contact));
}

void test_walking_the_touched_refuses_null_stale_and_a_cursor_below_zero(void)
{
    int cursor = 0, before = -1;
    cairn_body_id id = put(&ball, 0, CAIRN_F(0.5)), gone = put(&ball, CAIRN_F(9), CAIRN_F(9)), other;
    ASSERT_OK(cairn_body_destroy(world, gone));
    run(1);
    TEST_ASSERT_FALSE(cairn_body_next_touched(NULL, id, &cursor, &other));
    TEST_ASSERT_FALSE(cairn_body_next_touched(world, gone, &cursor, &other));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_STALE, cairn_world_error(world));
    TEST_ASSERT_FALSE(cairn_body_next_touched(world, id, NULL, &other));
    TEST_ASSERT_FALSE(cairn_body_next_touched(world, id, &cursor, NULL));
    TEST_ASSERT_FALSE(cairn_body_next_touched(world, id, &before, &other));
    TEST_ASSERT_TRUE(cairn_body_next_touched(world, id, &cursor, &other));
}

/* ---- where and how hard ---- */

void test_a_box_at_rest_presses_with_its_weight_on_its_two_corners(void)
{
    cairn_body_id id = put(&box, CAIRN_F(3), CAIRN_F(0.5));
    run(120);
    TEST_ASSERT_TRUE(contact_of(floor_id, id, &contact));
    TEST_ASSERT_TRUE(contact.touching);
    TEST_ASSERT_FALSE(contact.sensor);
    TEST_ASSERT_EQUAL_INT(2, contact.count);
    ASSERT_NEAR_VEC2(LSB, 0, 1, contact.normal);
    int left = contact.points[0].position.x < contact.points[1].position.x ? 0 : 1;
    ASSERT_NEAR_VEC2(0.0005, 2.5, 0, contact.points[left].position);
    ASSERT_NEAR_VEC2(0.0005, 3.5, 0, contact.points[1 - left].position);
    for (int i = 0; i < 2; i++) {
        /* m g h / 2 each, h = 1/240 s */
        ASSERT_NEAR(0.02 * 10.0 / 480, 10.0 / 480, contact.points[i].impulse);
        TEST_ASSERT_TRUE(contact.points[i].separation <= 0 && contact.points[i].separation > CAIRN_F(-0.0005));
    }
}

/* In newton seconds whatever the masses: m g h of what lies above. */
void test_the_impulse_of_a_contact_between_two_bodies_is_the_weight_of_the_upper_one(void)
{
    yard_def def = def_at(&ball, 0, CAIRN_F(0.5));
    def.fixed_rotation = true;
    def.density = cairn_wide_from_int(8);
    cairn_body_id low = make(&def);
    def.position.y = CAIRN_F(1.5);
    def.density = cairn_wide_from_int(4);
    cairn_body_id high = make(&def);
    run(240);
    TEST_ASSERT_TRUE(contact_of(low, high, &contact));
    ASSERT_NEAR(0.01 * 0.130900, 0.130900, contact.points[0].impulse); /* pi kg */
    TEST_ASSERT_TRUE(contact_of(low, floor_id, &contact));
    ASSERT_NEAR(0.01 * 0.392699, 0.392699, contact.points[0].impulse); /* 3 pi kg */
}

/* A kinematic press from above: the impulse is told also where the first body is the one that moves. */
void test_points_are_those_of_the_present_poses(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, 0)));
    cairn_body_id id = put_moving(&ball, 0, CAIRN_F(0.503), CAIRN_F(0.6), 0);
    run(1);
    TEST_ASSERT_TRUE(contact_of(floor_id, id, &contact));
    ASSERT_NEAR_VEC2(0.0005, 0.01, 0.0015, contact.points[0].position);
    ASSERT_NEAR(2 * LSB, 0.003, contact.points[0].separation);
    ASSERT_SAME(0, contact.points[0].impulse);
}

/* ---- since when ---- */

void test_bodies_that_are_merely_near_do_not_touch(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, 0)));
    cairn_body_id id = put(&ball, 0, CAIRN_F(0.503)), other;
    int cursor = 0;
    run(3);
    TEST_ASSERT_TRUE(contact_of(floor_id, id, &contact));
    TEST_ASSERT_FALSE(contact.touching);
    TEST_ASSERT_FALSE(contact.began);
    TEST_ASSERT_FALSE(cairn_body_next_touched(world, id, &cursor, &other));
}

void test_a_contact_begins_once_lasts_and_ends(void)
{
    cairn_body_id id = put(&ball, 0, CAIRN_F(0.6));
    int began = 0;
    for (int i = 0; i < 60; i++) {
        run(1);
        bool here = contact_of(floor_id, id, &contact);
        if (here && contact.began) {
            TEST_ASSERT_TRUE(contact.touching);
            began++;
        }
        TEST_ASSERT_TRUE(began == 0 || (here && contact.touching));
    }
    TEST_ASSERT_EQUAL_INT(1, began);
    ASSERT_OK(cairn_body_set_velocity(world, id, at(0, CAIRN_F(3))));
    run(10);
    TEST_ASSERT_FALSE(contact_of(floor_id, id, &contact));
}

/* Falling 1 m and rebounding in full: it hits the floor at 0.447 s, 1.342 s and 2.236 s. */
void test_each_bounce_is_a_contact_that_begins(void)
{
    static const cairn_material rubber = CAIRN_MATERIAL_BOUNCING(0, 0, 1, 0);
    yard_def def = def_at(&ball, 0, CAIRN_F(1.5));
    def.material = &rubber;
    cairn_body_id id = make(&def);
    int began = 0;
    for (int i = 0; i < 150; i++) {
        run(1);
        began += contact_of(floor_id, id, &contact) && contact.began;
    }
    TEST_ASSERT_EQUAL_INT(3, began);
}

/* ---- whom each body touched ---- */

void test_a_body_lists_whom_it_touched(void)
{
    cairn_body_id low = put(&box, 0, CAIRN_F(0.5)), high = put(&box, 0, CAIRN_F(1.5)), beside = put(&box, CAIRN_F(5), CAIRN_F(0.5)), other;
    run(10);
    int cursor = 0;
    TEST_ASSERT_TRUE(cairn_body_next_touched(world, low, &cursor, &other));
    TEST_ASSERT_TRUE(same(other, floor_id));
    TEST_ASSERT_TRUE(cairn_body_next_touched(world, low, &cursor, &other));
    TEST_ASSERT_TRUE(same(other, high));
    TEST_ASSERT_FALSE(cairn_body_next_touched(world, low, &cursor, &other));
    cursor = 0;
    TEST_ASSERT_TRUE(cairn_body_next_touched(world, high, &cursor, &other));
    TEST_ASSERT_TRUE(same(other, low));
    TEST_ASSERT_FALSE(cairn_body_next_touched(world, high, &cursor, &other));
    int met = 0;
    cursor = 0;
    while (cairn_body_next_touched(world, floor_id, &cursor, &other)) {
        TEST_ASSERT_TRUE(same(other, low) || same(other, beside));
        met++;
    }
    TEST_ASSERT_EQUAL_INT(2, met);
}
