/* The state hash: all that decides the future, and nothing else. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(40), CAIRN_F(1));

void setUp(void) { open_yard(CAIRN_F(-10)); }
void tearDown(void) {}

static uint32_t hash_of_a_fall(cairn_real height)
{
    open_yard(CAIRN_F(-10));
    put_static(&ground, 0, CAIRN_F(-0.5));
    put(&box, CAIRN_F(0.25), height);
    put(&ball, 0, CAIRN_F(2.5));
    run(60);
    return cairn_world_hash(world);
}

void test_equal_histories_have_equal_hashes_and_the_last_bit_of_a_start_shows(void)
{
    uint32_t hash = hash_of_a_fall(CAIRN_F(1));
    TEST_ASSERT_EQUAL_HEX32(hash, hash_of_a_fall(CAIRN_F(1)));
    TEST_ASSERT_NOT_EQUAL(hash, hash_of_a_fall(CAIRN_F(1) + 1));
}

void test_the_hash_sees_every_part_of_a_pose_and_a_motion(void)
{
    cairn_body_id id = put(&ball, 0, 0);
    uint32_t last = cairn_world_hash(world);
    for (int i = 0; i < 5; i++) {
        cairn_vec2 place = cairn_vec2_of(i >= 0 ? 1 : 0, i >= 1 ? 1 : 0), speed = cairn_vec2_of(i >= 3 ? 64 : 0, 0);
        ASSERT_OK(cairn_body_set_transform(world, id, place, i >= 2 ? 1 : 0));
        ASSERT_OK(cairn_body_set_velocity(world, id, speed));
        ASSERT_OK(cairn_body_set_angular_velocity(world, id, i >= 4 ? 64 : 0));
        TEST_ASSERT_NOT_EQUAL(last, cairn_world_hash(world));
        last = cairn_world_hash(world);
    }
}

/* What sleeps does not change, to the last bit. */
void test_the_hash_of_a_sleeping_world_stays(void)
{
    ASSERT_OK(cairn_sleep_enable(world));
    put_static(&ground, 0, CAIRN_F(-0.5));
    put(&box, 0, CAIRN_F(0.5));
    put(&ball, CAIRN_F(3), CAIRN_F(0.5));
    run(120);
    cairn_body_id id = cairn_world_next_body(world, cairn_body_id_null());
    while (!cairn_body_id_is_null(id)) {
        TEST_ASSERT_FALSE(cairn_body_is_awake(world, id));
        id = cairn_world_next_body(world, id);
    }
    uint32_t hash = cairn_world_hash(world);
    run(60);
    TEST_ASSERT_EQUAL_HEX32(hash, cairn_world_hash(world));
}
