/* Pins: springs of no rest length, which hold two points together. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape plank = CAIRN_BOX(CAIRN_F(1), CAIRN_F(0.25));
static const cairn_shape peg = CAIRN_CIRCLE(CAIRN_F(0.1));
CAIRN_SPRINGS(coils, 12);
CAIRN_SPRING_MESHES(nets, 12, 12, 600);

static cairn_body_id planks[8], hook;
static cairn_spring_id pins[9];

void setUp(void)
{
    open_yard(CAIRN_F(-10));
    memset(coils_springs, 0, sizeof coils_springs);
    ASSERT_OK(cairn_springs_enable(world, &coils));
}
void tearDown(void) {}

static cairn_spring_id pin(cairn_body_id a, cairn_body_id b, cairn_vec2 at_a, cairn_vec2 at_b, int32_t stiffness, int32_t damping)
{
    cairn_spring_def def = cairn_spring_def_default(a, b);
    def.anchor_a = at_a;
    def.anchor_b = at_b;
    def.rest_length = 0;
    def.stiffness = cairn_wide_from_int(stiffness);
    def.damping = cairn_wide_from_int(damping);
    def.no_contact = true;
    const cairn_spring_id id = cairn_spring_create(world, &def);
    TEST_ASSERT_FALSE(cairn_spring_id_is_null(id));
    return id;
}

/* Planks in a row from a hook at the origin on, each pinned to the one before. */
static void hang(int count, int32_t stiffness, int32_t damping)
{
    cairn_vec2 end = at(0, 0);
    cairn_body_id last = hook = put_static(&peg, 0, 0);
    for (int i = 0; i < count; i++) {
        planks[i] = put(&plank, CAIRN_F(i) + CAIRN_F(0.5), 0);
        pins[i] = pin(last, planks[i], end, at(CAIRN_F(-0.5), 0), stiffness, damping);
        last = planks[i];
        end = at(CAIRN_F(0.5), 0);
    }
}

static void hang_up_the_end(int count, cairn_real x, int32_t stiffness, int32_t damping)
{
    cairn_body_id other = put_static(&peg, x, 0);
    pins[count] = pin(planks[count - 1], other, at(CAIRN_F(0.5), 0), at(0, 0), stiffness, damping);
}

static cairn_real widest_gap(int count)
{
    cairn_real widest = 0;
    for (int i = 0; i < count; i++) {
        const cairn_real gap = cairn_spring_length(world, pins[i]);
        widest = gap > widest ? gap : widest;
    }
    return widest;
}

static cairn_real fastest_spin(int count)
{
    cairn_real fastest = 0;
    for (int i = 0; i < count; i++) {
        const cairn_real spin = size_of(spin_of(planks[i]));
        fastest = spin > fastest ? spin : fastest;
    }
    return fastest;
}

/* Along the line between two points that nearly meet they never did: a plank spun at 2 to 20 rad/s for ever. */
void test_a_bridge_of_pinned_planks_comes_to_rest(void)
{
    hang(8, 1000000, 1000);
    hang_up_the_end(8, CAIRN_F(7.9), 1000000, 1000);
    run(900);
    TEST_ASSERT_TRUE(fastest_spin(8) < CAIRN_F(0.02));
    TEST_ASSERT_TRUE(widest_gap(9) < CAIRN_F(0.01));
    TEST_ASSERT_TRUE(y_of(planks[3]) < CAIRN_F(-0.3));
    ASSERT_NEAR(0.02, 0, y_of(planks[3]) - y_of(planks[4])); /* it hangs evenly */
}

/* A rod of 1 m about its end has w^2 = 3 g / 2 L (1 + (0.25 / 1)^2 / 4): it never gets higher than it began, and holds on. */
void test_a_pinned_plank_swings_about_its_end(void)
{
    hang(1, 1000000, 0);
    cairn_real lowest = 0;
    for (int i = 0; i < 300; i++) {
        run(1);
        TEST_ASSERT_TRUE(y_of(planks[0]) < CAIRN_F(0.002));
        TEST_ASSERT_TRUE(widest_gap(1) < CAIRN_F(0.001));
        lowest = y_of(planks[0]) < lowest ? y_of(planks[0]) : lowest;
    }
    ASSERT_NEAR(0.002, -0.5, lowest);
}

/* Undamped and soft enough for the exact map, which turned its direction and gained tenfold energy. */
void test_a_soft_pin_off_the_centre_gains_no_energy(void)
{
    hang(1, 300, 0);
    for (int i = 0; i < 1200; i++) {
        run(1);
        TEST_ASSERT_TRUE(widest_gap(1) < CAIRN_F(0.2));
        TEST_ASSERT_TRUE(y_of(planks[0]) < CAIRN_F(0.05));
    }
}

/* F = -k d along both axes: 0.25 kg at 10 m/s^2 on 100 N/m. */
void test_a_soft_pin_sags_as_its_stiffness_says(void)
{
    hook = put_static(&peg, 0, 0);
    planks[0] = put(&plank, CAIRN_F(-0.5), 0);
    pins[0] = pin(planks[0], hook, at(CAIRN_F(0.5), 0), at(0, 0), 100, 5);
    pins[1] = pin(planks[0], put_static(&peg, CAIRN_F(-1), 0), at(CAIRN_F(-0.5), 0), at(0, 0), 100, 5);
    run(600);
    ASSERT_NEAR(0.0002, -0.0125, y_of(planks[0]));
}

/* Two bodies and nothing else: what a pin does to one it does to the other. */
void test_pins_keep_momentum(void)
{
    open_yard(0);
    memset(coils_springs, 0, sizeof coils_springs);
    ASSERT_OK(cairn_springs_enable(world, &coils));
    planks[0] = put_moving(&plank, 0, 0, CAIRN_F(1), CAIRN_F(2));
    planks[1] = put_moving(&plank, CAIRN_F(1), 0, CAIRN_F(-1), CAIRN_F(-1));
    pins[0] = pin(planks[0], planks[1], at(CAIRN_F(0.5), 0), at(CAIRN_F(-0.5), 0), 100000, 100);
    run(120);
    ASSERT_NEAR(0.0005, 0, vx_of(planks[0]) + vx_of(planks[1]));
    ASSERT_NEAR(0.0005, 1, vy_of(planks[0]) + vy_of(planks[1]));
    TEST_ASSERT_TRUE(widest_gap(1) < CAIRN_F(0.002));
}

/* A chain that is a metre too short, drawn by 1e5 N: it flaps about where it is. */
void test_pins_that_are_torn_apart_stay_bounded(void)
{
    hang(6, 1000000, 100);
    hang_up_the_end(6, CAIRN_F(7), 1000000, 100);
    for (int i = 0; i < 300; i++) {
        run(1);
        for (int k = 0; k < 6; k++) {
            TEST_ASSERT_TRUE(size_of(x_of(planks[k]) - CAIRN_F(3.5)) < CAIRN_F(5) && size_of(y_of(planks[k])) < CAIRN_F(3));
        }
    }
}

/* Networks with pins are no meshes, which pull along lines. */
void test_pins_are_pins_where_meshes_are_enabled(void)
{
    cairn_real with[2];
    for (int i = 0; i < 2; i++) {
        setUp();
        if (i == 1) {
            ASSERT_OK(cairn_meshes_enable(world, &nets));
        }
        hang(3, 1000000, 1000);
        cairn_spring_def brace = cairn_spring_def_default(planks[0], planks[2]);
        brace.stiffness = cairn_wide_from_int(1000);
        TEST_ASSERT_FALSE(cairn_spring_id_is_null(cairn_spring_create(world, &brace)));
        run(120);
        with[i] = y_of(planks[2]);
        TEST_ASSERT_TRUE(widest_gap(3) < CAIRN_F(0.02));
    }
    ASSERT_SAME(with[0], with[1]);
}

/* A spring may become a pin, and be one no more. */
void test_set_makes_a_pin_of_a_spring_and_a_spring_of_a_pin(void)
{
    hang(2, 10000, 300);
    ASSERT_OK(cairn_spring_set(world, pins[1], CAIRN_F(0.5), cairn_wide_from_int(10000), cairn_wide_from_int(300)));
    run(600);
    ASSERT_NEAR(0.01, 0.5, cairn_spring_length(world, pins[1]));
    ASSERT_OK(cairn_spring_set(world, pins[1], 0, cairn_wide_from_int(10000), cairn_wide_from_int(300)));
    run(600);
    TEST_ASSERT_TRUE(cairn_spring_length(world, pins[1]) < CAIRN_F(0.001));
}
