/* The soft solver: conservation laws, stacks, rest, rolling, mass ratios and settings. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape plank = CAIRN_BOX(CAIRN_F(2), CAIRN_F(0.5));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(60), CAIRN_F(1));
static const cairn_material smooth = CAIRN_MATERIAL(0, 0);

void setUp(void) { open_yard(CAIRN_F(-10)); }
void tearDown(void) {}

static void put_floor(void) { put_static(&ground, 0, CAIRN_F(-0.5)); }

/* ---- conservation ---- */

typedef struct totals {
    cairn_real px, py, spin; /* momentum, and angular momentum about the origin */
} totals;

static totals measure(void)
{
    totals t = { 0, 0, 0 };
    for (cairn_body_id id = cairn_world_next_body(world, cairn_body_id_null()); !cairn_body_id_is_null(id); id = cairn_world_next_body(world, id)) {
        cairn_real m = cairn_wide_to_real(cairn_body_mass(world, id)), inertia = cairn_wide_to_real(cairn_body_inertia(world, id));
        cairn_vec2 v = cairn_body_velocity(world, id), x = cairn_body_center(world, id);
        cairn_real px = cairn_real_mul(m, v.x), py = cairn_real_mul(m, v.y);
        t.px += px;
        t.py += py;
        t.spin += cairn_real_mul(x.x, py) - cairn_real_mul(x.y, px) + cairn_real_mul(inertia, spin_of(id));
    }
    return t;
}

/* The bound is a few last bits of the numbers that a game reads, times the bodies. */
void test_momentum_is_conserved_in_collisions_in_empty_space(void)
{
    open_yard(0);
    put_moving(&box, CAIRN_F(-3), CAIRN_F(0.2), CAIRN_F(5), 0);
    put_moving(&plank, CAIRN_F(3), 0, CAIRN_F(-2), CAIRN_F(0.5));
    put_moving(&ball, 0, CAIRN_F(-3), 0, CAIRN_F(4));
    put_moving(&ball, CAIRN_F(0.3), CAIRN_F(3), 0, CAIRN_F(-4));
    totals before = measure();
    run(180);
    totals after = measure();
    ASSERT_NEAR(16 * LSB, 0, after.px - before.px);
    ASSERT_NEAR(16 * LSB, 0, after.py - before.py);
}

/*
 * Friction acts at the height at which the bodies were when the step began: the error is within the way of a step times
 * the friction impulse, 5 m/s / rate * 0.5 * 2.5 N s, and goes with the step.
 */
static void assert_angular_momentum_is_conserved(cairn_real rate, cairn_real bound)
{
    open_yard(0);
    ASSERT_OK(cairn_world_set_rate(world, rate));
    put_moving(&box, CAIRN_F(-2), CAIRN_F(0.4), CAIRN_F(5), 0);
    cairn_body_id plank_id = put(&plank, CAIRN_F(2), CAIRN_F(-0.2));
    totals before = measure();
    run((int)cairn_real_floor(rate));
    totals after = measure();
    TEST_ASSERT_TRUE(size_of(after.spin - before.spin) <= bound);
    TEST_ASSERT_TRUE(size_of(spin_of(plank_id)) > CAIRN_F(0.1)); /* it was indeed hit off its centre */
}

void test_angular_momentum_is_conserved_in_an_off_centre_collision(void)
{
    assert_angular_momentum_is_conserved(CAIRN_F(60), CAIRN_F(0.1));
    assert_angular_momentum_is_conserved(CAIRN_F(600), CAIRN_F(0.01));
}

/* v = m u / (m + M) */
void test_without_restitution_two_bodies_go_on_together(void)
{
    open_yard(0);
    yard_def def = def_at(&ball, CAIRN_F(2), 0);
    def.density = cairn_wide_from_int(3);
    cairn_body_id heavy = make(&def), light = put_moving(&ball, 0, 0, CAIRN_F(8), 0);
    run(60);
    ASSERT_NEAR_VEC2(0.001, 2, 0, cairn_body_velocity(world, heavy));
    ASSERT_NEAR_VEC2(0.001, 2, 0, cairn_body_velocity(world, light));
}

/* No energy comes from nowhere: boxes thrown together in empty space never have more than at first. */
void test_collisions_do_not_gain_energy(void)
{
    cairn_body_id ids[6];
    open_yard(0);
    for (int i = 0; i < 6; i++) {
        yard_def def = def_at(&box, CAIRN_F(1.5) * (i - 3), CAIRN_F(0.2) * (i & 1));
        def.velocity = at(CAIRN_F(-1) * (i - 3), CAIRN_F(0.5));
        def.angular_velocity = CAIRN_F(0.5) * (i - 2);
        ids[i] = make(&def);
    }
    cairn_real last = 0;
    for (int step = 0; step < 240; step++) {
        cairn_real energy = 0;
        for (int i = 0; i < 6; i++) {
            cairn_vec2 v = cairn_body_velocity(world, ids[i]);
            cairn_real w = spin_of(ids[i]);
            energy += cairn_real_mul(v.x, v.x) + cairn_real_mul(v.y, v.y) + cairn_real_mul(w, w) / 6;
        }
        TEST_ASSERT_TRUE(step == 0 || energy <= last + CAIRN_F(0.02)); /* a thousandth of the 22 J at first */
        last = step == 0 || energy < last ? energy : last;
        run(1);
    }
}

/* ---- rest ---- */

/*
 * Soft contacts give way: by h^2 F / 2 m under a force F, with m the reduced mass of the pair. For a box on the floor
 * that is g h^2 / 2 = 0.087 mm at h = 1/240 s. Of a load that rests for seconds an eighth goes on pressing, see hold.c.
 */
void test_a_resting_box_sinks_in_by_a_tenth_of_a_millimetre(void)
{
    put_floor();
    cairn_body_id id = put(&box, 0, CAIRN_F(0.5));
    run(10);
    ASSERT_NEAR(0.00002, 0.5 - 0.000087, y_of(id));
    run(590);
    ASSERT_NEAR(0.00002, 0.5 - 0.000011, y_of(id));
    ASSERT_NEAR(LSB, 0, x_of(id));
    ASSERT_NEAR(2 * LSB, 0, vy_of(id));
    ASSERT_NEAR(2 * LSB, 0, spin_of(id));
}

void test_rest_is_rest(void)
{
    put_floor();
    cairn_body_id low = put(&box, CAIRN_F(0.1), CAIRN_F(0.5)), high = put(&plank, CAIRN_F(-0.2), CAIRN_F(1.25));
    run(600);
    cairn_vec2 low_before = cairn_body_position(world, low), high_before = cairn_body_position(world, high);
    cairn_angle angle_before = cairn_body_angle(world, high);
    run(300);
    cairn_vec2 low_after = cairn_body_position(world, low), high_after = cairn_body_position(world, high);
    ASSERT_NEAR(LSB, 0, low_after.x - low_before.x);
    ASSERT_NEAR(LSB, 0, low_after.y - low_before.y);
    ASSERT_NEAR(LSB, 0, high_after.x - high_before.x);
    ASSERT_NEAR(LSB, 0, high_after.y - high_before.y);
    ASSERT_NEAR(2 * LSB, 0, cairn_angle_radians(cairn_body_angle(world, high)) - cairn_angle_radians(angle_before));
}

static void assert_stack_stands(int boxes, int steps, cairn_real height, cairn_real sink)
{
    cairn_body_id ids[12];
    put_floor();
    for (int i = 0; i < boxes; i++) {
        ids[i] = put(&box, 0, CAIRN_F(0.5) + height * i);
    }
    run(steps);
    for (int i = 0; i < boxes; i++) {
        ASSERT_NEAR(0.01, 0, x_of(ids[i]));
        TEST_ASSERT_TRUE(size_of(y_of(ids[i]) - CAIRN_F(0.5) - CAIRN_F(1) * i) <= sink);
        ASSERT_NEAR(0.01, 0, turned(ids[i]));
    }
}

/* The lowest contact carries ten boxes, the next one nine with half the reduced mass, and so on: 100 g h^2 / 2. */
#define TEN_SINK CAIRN_F(0.0091)

void test_a_stack_of_ten_stands(void) { assert_stack_stands(10, 600, CAIRN_F(1), TEN_SINK); }

void test_a_stack_of_ten_that_is_dropped_box_by_box_comes_to_stand(void) { assert_stack_stands(10, 600, CAIRN_F(1.02), TEN_SINK); }

/* 9 g h^2 / 2, and 0.2 mm for what is still settling */
void test_a_small_stack_stands_with_any_number_of_substeps(void)
{
    for (int substeps = 1; substeps <= 16; substeps++) {
        open_yard(CAIRN_F(-10));
        ASSERT_OK(cairn_world_set_substeps(world, substeps));
        assert_stack_stands(3, 120, CAIRN_F(1), CAIRN_F(0.0126) / (substeps * substeps) + CAIRN_F(0.0002));
    }
}

void test_a_stack_leans_on_any_axis_that_gravity_has(void)
{
    open_yard(0);
    ASSERT_OK(cairn_world_set_gravity(world, at(CAIRN_F(10), 0)));
    yard_def def = def_at(&ground, CAIRN_F(3), 0);
    def.type = CAIRN_STATIC;
    def.angle = CAIRN_DEGREES(90);
    make(&def);
    cairn_body_id low = put(&box, CAIRN_F(2), 0), high = put(&box, CAIRN_F(1), 0);
    run(300);
    ASSERT_NEAR_VEC2(0.001, 2, 0, cairn_body_position(world, low));
    ASSERT_NEAR_VEC2(0.001, 1, 0, cairn_body_position(world, high));
}

/* ---- mass ratios ---- */

static void assert_two_rest(int low_density, int high_density, int steps, cairn_real sink)
{
    put_floor();
    yard_def def = def_at(&box, 0, CAIRN_F(0.5));
    def.density = cairn_wide_from_int(low_density);
    cairn_body_id low = make(&def);
    def.position.y = CAIRN_F(1.5);
    def.density = cairn_wide_from_int(high_density);
    cairn_body_id high = make(&def);
    run(steps);
    ASSERT_NEAR(0.01, 0, x_of(low));
    ASSERT_NEAR(0.01, 0, x_of(high));
    TEST_ASSERT_TRUE(size_of(y_of(low) - CAIRN_F(0.5)) <= sink);
    TEST_ASSERT_TRUE(size_of(y_of(high) - CAIRN_F(1.5)) <= sink);
}

/* h^2 F / 2 m of both contacts: (11 + 10 * 1.1) and (101 + 100 * 1.01) times g h^2 / 2, and a tenth. */
void test_a_heavy_box_lies_on_a_light_one(void) { assert_two_rest(1, 10, 300, CAIRN_F(0.0021)); }
void test_a_box_a_hundred_times_as_heavy_lies_on_a_light_one(void) { assert_two_rest(1, 100, 600, CAIRN_F(0.0193)); }
void test_a_light_box_lies_on_a_heavy_one(void) { assert_two_rest(10000, 1, 300, CAIRN_F(0.0002)); }

/* ---- penetration ---- */

/* Two boxes in nearly one place part no faster than the push-out speed, and part. */
void test_overlapping_bodies_are_pushed_apart_at_the_push_out_speed_at_most(void)
{
    open_yard(0);
    ASSERT_OK(cairn_world_set_push_out(world, CAIRN_F(1)));
    cairn_body_id a = put(&ball, 0, 0), b = put(&ball, CAIRN_F(0.25), 0);
    cairn_real last = x_of(b) - x_of(a);
    for (int i = 0; i < 120; i++) {
        run(1);
        cairn_real apart = x_of(b) - x_of(a);
        TEST_ASSERT_TRUE(apart >= last);
        TEST_ASSERT_TRUE(apart - last <= CAIRN_F(1.01 / 60));
        last = apart;
    }
    ASSERT_NEAR(0.001, 1, last); /* 0.75 m take 0.75 s at the most, then nothing is left to push */
    ASSERT_NEAR(0.001, 0, vx_of(b));
}

void test_without_push_out_an_overlap_stays_as_it_is(void)
{
    open_yard(0);
    ASSERT_OK(cairn_world_set_push_out(world, 0));
    cairn_body_id a = put(&ball, 0, 0), b = put(&ball, CAIRN_F(0.5), 0);
    run(60);
    ASSERT_NEAR(LSB, 0, x_of(a));
    ASSERT_NEAR(LSB, 0.5, x_of(b));
}

void test_a_slop_leaves_that_much_penetration(void)
{
    ASSERT_OK(cairn_world_set_slop(world, CAIRN_F(0.02)));
    put_floor();
    cairn_body_id sunk = put(&ball, 0, CAIRN_F(0.45)), flat = put(&ball, CAIRN_F(3), CAIRN_F(0.49));
    run(120);
    ASSERT_NEAR(0.001, 0.48, y_of(sunk));
    TEST_ASSERT_TRUE(y_of(flat) <= CAIRN_F(0.4901) && y_of(flat) >= CAIRN_F(0.479));
}

/* ---- rolling ---- */

/* From sliding to rolling: friction takes a third of a disc's speed, v = 2/3 v0 and w = -v / r. */
void test_a_sliding_disc_comes_to_roll_at_two_thirds_of_its_speed(void)
{
    put_floor();
    cairn_body_id id = put_moving(&ball, CAIRN_F(-20), CAIRN_F(0.5), CAIRN_F(3), 0);
    run(120);
    ASSERT_NEAR(0.002 * 2, 2, vx_of(id));
    ASSERT_NEAR(0.002 * 4, -4, spin_of(id));
}

/* g sin / (1 + I / m r^2) = 2/3 g sin 10 = 1.157655; w r = v */
void test_a_disc_rolls_down_a_slope_with_two_thirds_of_the_acceleration(void)
{
    yard_def def = def_at(&ground, 0, 0);
    def.type = CAIRN_STATIC;
    def.angle = CAIRN_DEGREES(-10);
    make(&def);
    cairn_body_id id = put(&ball, CAIRN_F(0.173648), CAIRN_F(0.984808)); /* 1 m along the normal */
    run(120);
    cairn_vec2 v = cairn_body_velocity(world, id);
    ASSERT_NEAR(0.002 * 2.315309, 2.315309, cairn_real_length(v.x, v.y));
    ASSERT_NEAR(0.002 * 4.630618, -4.630618, spin_of(id));
}

void test_a_rolling_disc_goes_on_rolling(void)
{
    put_floor();
    yard_def def = def_at(&ball, CAIRN_F(-10), CAIRN_F(0.5));
    def.velocity.x = CAIRN_F(2);
    def.angular_velocity = CAIRN_F(-4);
    cairn_body_id id = make(&def);
    run(240);
    ASSERT_NEAR(0.002, -2, x_of(id));
    ASSERT_NEAR(0.001, 2, vx_of(id));
}

void test_a_spinning_disc_on_ice_without_friction_keeps_spinning(void)
{
    put_floor();
    yard_def def = def_at(&ball, 0, CAIRN_F(0.5));
    def.angular_velocity = CAIRN_F(10);
    def.material = &smooth;
    cairn_body_id id = make(&def);
    run(120);
    ASSERT_NEAR(2 * LSB, 10, spin_of(id));
    ASSERT_NEAR(LSB, 0, x_of(id));
}

/* ---- balance ---- */

/* A plank over an edge tips if its centre is beyond it, and stays if it is not. */
void test_a_plank_over_an_edge_stays_or_tips_by_where_its_centre_is(void)
{
    cairn_body_id table = put_static(&box, 0, 0);
    (void)table;
    cairn_body_id stays = put(&plank, CAIRN_F(0.4), CAIRN_F(0.75));
    run(180);
    ASSERT_NEAR(0.002, 0, turned(stays));
    ASSERT_OK(cairn_body_destroy(world, stays));
    cairn_body_id tips = put(&plank, CAIRN_F(0.6), CAIRN_F(0.75));
    run(60);
    TEST_ASSERT_TRUE(turned(tips) < CAIRN_F(-0.2));
}

/* A corner dropped on the floor: the box falls flat and lies. */
void test_a_tilted_box_falls_flat(void)
{
    put_floor();
    yard_def def = def_at(&box, 0, CAIRN_F(1));
    def.angle = CAIRN_DEGREES(30);
    cairn_body_id id = make(&def);
    run(240);
    ASSERT_NEAR(0.001, 0, turned(id));
    ASSERT_NEAR(0.001, 0.5, y_of(id));
}

/* ---- pivots ---- */

/* Equal weights at equal distance on a see-saw balance; half the distance with the double weight as well. */
void test_a_see_saw_balances_by_the_law_of_the_lever(void)
{
    static const cairn_shape beam = CAIRN_BOX(CAIRN_F(6), CAIRN_F(0.2));
    yard_def def = def_at(&beam, 0, 0);
    def.fixed_position = true;
    def.density = cairn_wide_from_int(10);
    cairn_body_id see_saw = make(&def);
    def = def_at(&ball, CAIRN_F(2), CAIRN_F(0.6));
    def.fixed_rotation = true;
    make(&def);
    def.position.x = CAIRN_F(-1);
    def.density = cairn_wide_from_int(2);
    make(&def);
    run(60);
    ASSERT_NEAR(0.002, 0, turned(see_saw));
    ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_position(world, see_saw));
}
