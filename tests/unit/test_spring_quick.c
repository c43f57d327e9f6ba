/* Paths of plain springs: what they do where their frames serve, where they do not, and where bodies are moved by hand. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape bead = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1)); /* 1 kg */
static const cairn_shape mote = CAIRN_BOX(CAIRN_F(0.1), CAIRN_F(0.1)); /* 10 g */
static const cairn_shape peg = CAIRN_CIRCLE(CAIRN_F(0.05));

CAIRN_SPRINGS(coils, 8);

static cairn_body_id wall, links[4];
static cairn_spring_id ids[4];

void setUp(void)
{
    open_yard(CAIRN_F(-10));
    memset(coils_springs, 0, sizeof coils_springs);
    ASSERT_OK(cairn_springs_enable(world, &coils));
    wall = put_static(&peg, 0, 0);
}
void tearDown(void) {}

/* A rope of so many links that hang from the wall, in m below one another, their springs at rest. */
static void hang(int count, cairn_real apart, int32_t stiffness, int32_t damping)
{
    for (int i = 0; i < count; i++) {
        links[i] = put(&bead, 0, -(i + 1) * apart);
        ASSERT_OK(set_layers(links[i], 1, 0));
        cairn_spring_def def = cairn_spring_def_default(i == 0 ? wall : links[i - 1], links[i]);
        def.stiffness = cairn_wide_from_int(stiffness);
        def.damping = cairn_wide_from_int(damping);
        ids[i] = cairn_spring_create(world, &def);
        TEST_ASSERT_FALSE(cairn_spring_id_is_null(ids[i]));
    }
}

/* Each spring carries the links below it, whatever its length: frames are for 4 mm to 16 m, and for a stretch of 3 m. */
static void expect_sags(double apart, int32_t stiffness, int32_t damping, double bound)
{
    hang(3, CAIRN_F(apart), stiffness, damping);
    run(2000);
    for (int i = 0; i < 3; i++) {
        ASSERT_NEAR(bound, apart + 10.0 * (3 - i) / stiffness, cairn_spring_length(world, ids[i]));
    }
}
void test_a_rope_of_springs_of_1_m_sags_by_the_weight_each_carries(void) { expect_sags(1, 500, 20, 0.0002); }
void test_a_rope_of_springs_longer_than_a_frame_sags_alike(void) { expect_sags(20, 500, 20, 0.0002); }
void test_a_rope_of_springs_shorter_than_a_frame_sags_alike(void) { expect_sags(0.001, 50000, 200, 0.0002); }
void test_a_rope_that_is_stretched_beyond_the_gains_sags_alike(void) { expect_sags(1, 5, 5, 0.002); }

/* Once round in two seconds, through many frames: it keeps its length and its speed. */
void test_a_rope_that_whirls_keeps_its_length(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, 0)));
    hang(2, CAIRN_F(1), 10000, 0);
    ASSERT_OK(cairn_body_set_velocity(world, links[0], at(CAIRN_F(3.14159), 0)));
    ASSERT_OK(cairn_body_set_velocity(world, links[1], at(CAIRN_F(6.28318), 0)));
    for (int i = 0; i < 120; i++) {
        run(1);
        ASSERT_NEAR(0.02, 1, cairn_spring_length(world, ids[0]));
        ASSERT_NEAR(0.02, 1, cairn_spring_length(world, ids[1]));
    }
    ASSERT_NEAR_VEC2(0.3, 0, -2, cairn_body_position(world, links[1]));
}

/* What the game moves is pulled from where it is: also by just as much as the frame's motions wrap at. */
void test_a_link_that_was_moved_by_hand_is_pulled_back_from_there(void)
{
    static const cairn_real far[] = { CAIRN_F(0.5), CAIRN_F(16), CAIRN_F(-32), CAIRN_F(1000) };
    for (int i = 0; i < 4; i++) {
        setUp();
        ASSERT_OK(cairn_world_set_gravity(world, at(0, 0)));
        hang(2, CAIRN_F(1), 100, 10);
        run(5);
        ASSERT_NEAR(0.001, 0, vx_of(links[1]));
        ASSERT_OK(cairn_body_set_transform(world, links[1], at(far[i], CAIRN_F(-2)), 0));
        run(1);
        TEST_ASSERT_TRUE(far[i] > 0 ? vx_of(links[1]) < -CAIRN_F(0.05) : vx_of(links[1]) > CAIRN_F(0.05));
        run(1200);
        ASSERT_NEAR(2, 1, cairn_spring_length(world, ids[1]));
    }
}

/* A link that is struck hard, by more than the gains hold, pulls its neighbours along, and none of them faster than itself. */
void test_a_link_that_is_struck_takes_its_rope_along(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, at(0, 0)));
    hang(3, CAIRN_F(1), 1000000, 0);
    ASSERT_OK(cairn_body_set_velocity(world, links[2], at(0, CAIRN_F(-120))));
    run(1);
    TEST_ASSERT_TRUE(size_of(vy_of(links[0])) < CAIRN_F(120) && size_of(vy_of(links[1])) < CAIRN_F(120));
    run(600);
    for (int i = 0; i < 3; i++) {
        ASSERT_NEAR(0.3, 1, cairn_spring_length(world, ids[i]));
    }
}

/* Between heavy links a light one has hardly a say: the factors of such a path are large, and it is solved with care. */
void test_a_light_link_between_heavy_ones_passes_the_weight_on(void)
{
    hang(1, CAIRN_F(1), 5000, 50);
    links[1] = put(&mote, 0, CAIRN_F(-2));
    links[2] = put(&bead, 0, CAIRN_F(-3));
    for (int i = 1; i < 3; i++) {
        cairn_spring_def def = cairn_spring_def_default(links[i - 1], links[i]);
        def.stiffness = cairn_wide_from_int(5000);
        def.damping = cairn_wide_from_int(50);
        ids[i] = cairn_spring_create(world, &def);
    }
    run(900);
    ASSERT_NEAR(0.0002, 1 + 20.1 / 5000, cairn_spring_length(world, ids[0]));
    ASSERT_NEAR(0.0002, 1 + 10.1 / 5000, cairn_spring_length(world, ids[1]));
    ASSERT_NEAR(0.0002, 1 + 10.0 / 5000, cairn_spring_length(world, ids[2]));
}
