/* Arbiters: one for each pair that is near, kept from step to step, gone with its bodies. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(40), CAIRN_F(1));
static cairn_contact contact;

void setUp(void) { open_yard(CAIRN_F(-10)); }
void tearDown(void) {}

static int contacts(void)
{
    int cursor = 0, count = 0;
    while (cairn_world_next_contact(world, &cursor, &contact)) {
        count++;
    }
    return count;
}

void test_what_cannot_move_comes_first_in_a_pair(void)
{
    cairn_body_id id = put(&ball, 0, CAIRN_F(0.5)), ground_id = put_static(&ground, 0, CAIRN_F(-0.5));
    yard_def def = def_at(&box, CAIRN_F(0.9), CAIRN_F(0.5));
    def.type = CAIRN_KINEMATIC;
    cairn_body_id wall = make(&def);
    run(1);
    TEST_ASSERT_TRUE(contact_of(id, ground_id, &contact));
    TEST_ASSERT_TRUE(same(contact.a, ground_id));
    ASSERT_NEAR_VEC2(LSB, 0, 1, contact.normal);
    TEST_ASSERT_TRUE(contact_of(id, wall, &contact));
    TEST_ASSERT_TRUE(same(contact.a, wall));
    ASSERT_NEAR_VEC2(LSB, -1, 0, contact.normal);
}

void test_of_two_that_move_the_one_made_first_comes_first(void)
{
    cairn_body_id first = put(&box, 0, 0), second = put(&ball, CAIRN_F(0.9), 0);
    run(1);
    TEST_ASSERT_TRUE(contact_of(first, second, &contact));
    TEST_ASSERT_TRUE(same(contact.a, first));
    ASSERT_NEAR_VEC2(LSB, 1, 0, contact.normal);
}

/* The order of the pair in the pool says nothing to physics: a ball and a box that meet head on share their speed. */
void test_ball_and_box_exchange_the_same_impulse_in_both_orders(void)
{
    for (int order = 0; order < 2; order++) {
        open_yard(0);
        cairn_body_id id, moving;
        if (order == 0) {
            id = put(&box, CAIRN_F(2), 0);
            moving = put_moving(&ball, 0, 0, CAIRN_F(4), 0);
        } else {
            moving = put_moving(&ball, 0, 0, CAIRN_F(4), 0);
            id = put(&box, CAIRN_F(2), 0);
        }
        run(30);
        /* v = 4 m / (m + M), m = pi / 4, M = 1 */
        ASSERT_NEAR_VEC2(0.001, 1.759603, 0, cairn_body_velocity(world, id));
        ASSERT_NEAR_VEC2(0.001, 1.759603, 0, cairn_body_velocity(world, moving));
        ASSERT_NEAR(0.001, 0, spin_of(id));
    }
}

void test_an_arbiter_is_forgotten_when_its_bodies_part(void)
{
    put_static(&ground, 0, CAIRN_F(-0.5));
    cairn_body_id id = put(&ball, 0, CAIRN_F(0.5));
    run(5);
    TEST_ASSERT_EQUAL_INT(1, contacts());
    ASSERT_OK(cairn_body_set_velocity(world, id, at(0, CAIRN_F(5))));
    run(5);
    TEST_ASSERT_EQUAL_INT(0, contacts());
    TEST_ASSERT_EQUAL_UINT16(0, stats()->arbiters);
}

void test_destroying_a_body_takes_its_arbiters_at_once(void)
{
    put_static(&ground, 0, CAIRN_F(-0.5));
    cairn_body_id low = put(&box, 0, CAIRN_F(0.5)), high = put(&box, 0, CAIRN_F(1.5));
    put(&box, CAIRN_F(4), CAIRN_F(0.5));
    run(5);
    TEST_ASSERT_EQUAL_INT(3, contacts());
    ASSERT_OK(cairn_body_destroy(world, low));
    TEST_ASSERT_EQUAL_INT(1, contacts());
    run(20);
    TEST_ASSERT_TRUE(vy_of(high) < CAIRN_F(-3)); /* it falls: 20 steps of gravity, 3.33 m/s */
}

/* A new body in the place of a destroyed one inherits no impulse of it. */
void test_a_body_in_a_place_used_again_starts_from_nothing(void)
{
    put_static(&ground, 0, CAIRN_F(-0.5));
    yard_def def = def_at(&box, 0, CAIRN_F(0.5));
    def.density = cairn_wide_from_int(1000);
    cairn_body_id heavy = make(&def);
    run(60);
    ASSERT_OK(cairn_body_destroy(world, heavy));
    cairn_body_id light = put(&box, 0, CAIRN_F(0.5));
    run(1);
    ASSERT_NEAR(0.01, 0, vy_of(light));
    ASSERT_NEAR(0.001, 0.5, y_of(light));
}

/* Where an arbiter was is a guess of where the next pair's is: a freed one that was of the same bodies must not be taken for it. */
void test_a_pair_that_parts_and_meets_again_is_found_in_a_pool_with_free_places(void)
{
    put_static(&ground, 0, CAIRN_F(-0.5));
    cairn_body_id ids[3];
    for (int i = 0; i < 3; i++) {
        ids[i] = put(&ball, CAIRN_F(2) * i, CAIRN_F(0.5));
    }
    for (int round = 0; round < 6; round++) {
        cairn_body_id gone = ids[round % 3];
        run(2);
        TEST_ASSERT_EQUAL_INT(3, contacts());
        ASSERT_OK(cairn_body_set_transform(world, gone, at(CAIRN_F(-10), CAIRN_F(20)), 0));
        run(1);
        TEST_ASSERT_EQUAL_INT(2, contacts());
        ASSERT_OK(cairn_body_set_transform(world, gone, at(CAIRN_F(2) * (round % 3), CAIRN_F(0.5)), 0));
        ASSERT_OK(cairn_body_set_velocity(world, gone, at(0, 0)));
    }
    run(60);
    TEST_ASSERT_EQUAL_INT(3, contacts());
    for (int i = 0; i < 3; i++) {
        ASSERT_NEAR(0.001, 0.5, y_of(ids[i]));
    }
}

/* Warm starting: a resting contact has its whole impulse from the step before, so that nothing sinks and rises. */
void test_impulses_are_kept_from_step_to_step(void)
{
    cairn_body_id ground_id = put_static(&ground, 0, CAIRN_F(-0.5)), id = put(&box, 0, CAIRN_F(0.5));
    run(120);
    for (int i = 0; i < 30; i++) {
        TEST_ASSERT_TRUE(contact_of(ground_id, id, &contact));
        cairn_real sum = contact.points[0].impulse + contact.points[1].impulse;
        ASSERT_NEAR(0.005 * 10.0 / 240, 10.0 / 240, sum);
        ASSERT_NEAR(0.0005, 0, vy_of(id));
        run(1);
    }
}

/* Contacts stay in the order of their bodies' places, however the bodies came and went. */
void test_contacts_are_walked_in_the_order_of_their_bodies(void)
{
    cairn_body_id ids[6];
    put_static(&ground, 0, CAIRN_F(-0.5));
    for (int i = 0; i < 6; i++) {
        ids[i] = put(&box, CAIRN_F(1.001) * i, CAIRN_F(0.5));
    }
    run(2);
    ASSERT_OK(cairn_body_destroy(world, ids[2]));
    ASSERT_OK(cairn_body_destroy(world, ids[1]));
    run(1);
    put(&box, CAIRN_F(1.001) * 2, CAIRN_F(0.5));
    put(&box, CAIRN_F(1.001), CAIRN_F(0.5));
    run(2);
    int cursor = 0;
    uint32_t last = 0;
    while (cairn_world_next_contact(world, &cursor, &contact)) {
        uint32_t key = (uint32_t)contact.a.index << 16 | contact.b.index;
        TEST_ASSERT_TRUE(key > last);
        last = key;
    }
    TEST_ASSERT_EQUAL_INT(11, cursor);
}
