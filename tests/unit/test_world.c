/* The world: its memory, its settings, its pools and its clock. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(40), CAIRN_F(1));

void setUp(void) { open_yard(CAIRN_F(-10)); }
void tearDown(void) {}

/* ---- its memory ---- */

static void assert_no_world(cairn_world_storage storage) { TEST_ASSERT_NULL(cairn_world_init(&storage, cairn_vec2_of(0, 0))); }

void test_init_refuses_storage_with_a_missing_part(void)
{
    cairn_world_storage storage = yard;
    TEST_ASSERT_NULL(cairn_world_init(NULL, cairn_vec2_of(0, 0)));
    storage.world = NULL;
    assert_no_world(storage);
    storage = yard;
    storage.bodies = NULL;
    assert_no_world(storage);
    storage = yard;
    storage.arbiters = NULL;
    assert_no_world(storage);
    storage = yard;
    storage.order = NULL;
    assert_no_world(storage);
    storage = yard;
    storage.swept = NULL;
    assert_no_world(storage);
    storage = yard;
    storage.sorted = NULL;
    assert_no_world(storage);
}

void test_init_refuses_capacities_of_zero_and_above_65000(void)
{
    cairn_world_storage storage = yard;
    storage.body_capacity = 0;
    assert_no_world(storage);
    storage.body_capacity = 65001;
    assert_no_world(storage);
    storage = yard;
    storage.arbiter_capacity = 0;
    assert_no_world(storage);
    storage.arbiter_capacity = 65001;
    assert_no_world(storage);
}

void test_init_refuses_a_missing_solver_and_gravity_above_2000(void)
{
    TEST_ASSERT_NULL(cairn_world_init_with(&yard, cairn_vec2_of(0, 0), NULL, NULL));
    TEST_ASSERT_NULL(cairn_world_init(&yard, cairn_vec2_of(CAIRN_F(2001), 0)));
    TEST_ASSERT_NULL(cairn_world_init(&yard, cairn_vec2_of(0, CAIRN_F(-2001))));
    TEST_ASSERT_NOT_NULL(cairn_world_init(&yard, cairn_vec2_of(CAIRN_F(2000), CAIRN_F(-2000))));
}

void test_a_new_world_is_empty(void)
{
    cairn_contact contact;
    int cursor = 0;
    TEST_ASSERT_TRUE(cairn_body_id_is_null(cairn_world_next_body(world, cairn_body_id_null())));
    TEST_ASSERT_FALSE(cairn_world_next_contact(world, &cursor, &contact));
    TEST_ASSERT_EQUAL_INT(CAIRN_OK, cairn_world_error(world));
    TEST_ASSERT_EQUAL_UINT16(0, stats()->bodies);
    run(2);
    TEST_ASSERT_EQUAL_UINT32(2, stats()->steps);
    TEST_ASSERT_EQUAL_UINT16(0, stats()->arbiters);
}

void test_a_world_made_anew_in_the_same_memory_forgets_the_old_one(void)
{
    cairn_body_id old = put(&ball, 0, 0);
    open_yard(0);
    TEST_ASSERT_FALSE(cairn_body_exists(world, old));
    TEST_ASSERT_EQUAL_UINT16(0, stats()->bodies);
}

CAIRN_WORLD(annex, 2, 1);

void test_two_worlds_share_nothing(void)
{
    cairn_world *other = cairn_world_init(&annex, cairn_vec2_of(0, 0));
    cairn_body_id here = put(&ball, 0, 0);
    yard_def def = def_at(&ball, 0, 0);
    cairn_body_id there = make_in(other, &def);
    run(60);
    ASSERT_SAME(0, cairn_body_position(other, there).y);
    ASSERT_NEAR(3 * LSB, -5, y_of(here));
}

void test_world_bytes_are_what_the_declared_memory_takes(void)
{
    TEST_ASSERT_EQUAL_UINT32(sizeof annex_world + sizeof annex_bodies + sizeof annex_arbiters + sizeof annex_order + sizeof annex_swept + sizeof annex_sorted, CAIRN_WORLD_BYTES(2, 1));
}

/* ---- null ---- */

void test_null_worlds_are_refused(void)
{
    cairn_contact contact;
    int cursor = 0;
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_world_step(NULL));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_world_error(NULL));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_world_set_gravity(NULL, cairn_vec2_of(0, 0)));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_world_set_rate(NULL, CAIRN_F(60)));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_world_set_substeps(NULL, 4));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_world_set_slop(NULL, 0));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_world_set_push_out(NULL, CAIRN_F(3)));
    TEST_ASSERT_NULL(cairn_world_get_stats(NULL));
    ASSERT_SAME(0, cairn_world_speed_limit(NULL));
    TEST_ASSERT_TRUE(cairn_body_id_is_null(cairn_world_next_body(NULL, cairn_body_id_null())));
    TEST_ASSERT_FALSE(cairn_world_next_contact(NULL, &cursor, &contact));
    TEST_ASSERT_EQUAL_UINT32(0, cairn_world_hash(NULL));
}

/* ---- settings ---- */

void test_gravity_above_2000_is_refused(void)
{
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_gravity(world, cairn_vec2_of(CAIRN_F(2000.5), 0)));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_gravity(world, cairn_vec2_of(CAIRN_F(-2000.5), 0)));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_gravity(world, cairn_vec2_of(0, CAIRN_F(2000.5))));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_gravity(world, cairn_vec2_of(0, CAIRN_F(-2000.5))));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_gravity(world, cairn_vec2_of(0, CAIRN_F(-32768))));
    ASSERT_OK(cairn_world_set_gravity(world, cairn_vec2_of(CAIRN_F(-2000), CAIRN_F(2000))));
}

void test_rates_outside_of_10_to_2000_are_refused(void)
{
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_rate(world, CAIRN_F(9.99)));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_rate(world, CAIRN_F(2000.01)));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_rate(world, CAIRN_F(-60)));
    ASSERT_OK(cairn_world_set_rate(world, CAIRN_F(10)));
    ASSERT_OK(cairn_world_set_rate(world, CAIRN_F(2000)));
}

void test_substeps_outside_of_1_to_16_are_refused(void)
{
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_substeps(world, 0));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_substeps(world, 17));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_substeps(world, -4));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_substeps(world, 260));
    ASSERT_OK(cairn_world_set_substeps(world, 1));
    ASSERT_OK(cairn_world_set_substeps(world, 16));
}

void test_slops_outside_of_0_to_10_cm_are_refused(void)
{
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_slop(world, CAIRN_F(-0.001)));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_slop(world, CAIRN_F(0.101)));
    ASSERT_OK(cairn_world_set_slop(world, 0));
    ASSERT_OK(cairn_world_set_slop(world, CAIRN_F(0.1)));
}

void test_push_out_speeds_outside_of_0_to_100_are_refused(void)
{
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_push_out(world, CAIRN_F(-0.1)));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_push_out(world, CAIRN_F(100.1)));
    ASSERT_OK(cairn_world_set_push_out(world, 0));
    ASSERT_OK(cairn_world_set_push_out(world, CAIRN_F(100)));
}

void test_the_error_is_that_of_the_last_failed_call_and_is_told_once(void)
{
    cairn_world_set_substeps(world, 0);
    cairn_body_destroy(world, cairn_body_id_null());
    ASSERT_OK(cairn_world_set_substeps(world, 4)); /* a success does not hide it */
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_STALE, cairn_world_error(world));
    TEST_ASSERT_EQUAL_INT(CAIRN_OK, cairn_world_error(world));
}

/* ---- time ---- */

/* x = v t, y = u t - g t^2 / 2: the engine's parabola is exact but for the rounding of 60 steps. */
void test_a_projectile_follows_the_parabola(void)
{
    cairn_body_id id = put_moving(&ball, 0, 0, CAIRN_F(3), CAIRN_F(7));
    run(60);
    ASSERT_NEAR_VEC2(2 * LSB, 3, 2, cairn_body_position(world, id));
    ASSERT_NEAR_VEC2(4 * LSB, 3, -3, cairn_body_velocity(world, id));
}

/* With the velocity h g off in its last digit, 40 m/s would be 12 mm off (numerics, formats of dt and h). */
void test_a_fast_projectile_lands_where_it_should(void)
{
    cairn_body_id id = put_moving(&ball, 0, 0, CAIRN_F(40), CAIRN_F(40));
    run(120);
    ASSERT_NEAR_VEC2(4 * LSB, 80, 60, cairn_body_position(world, id));
}

/* g h^2 is far below the last bit of a velocity here; the residual is carried. */
void test_very_weak_gravity_still_pulls_right(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, cairn_vec2_of(CAIRN_F(0.001), CAIRN_F(-0.0005))));
    cairn_body_id id = put(&ball, 0, 0);
    run(600);
    ASSERT_NEAR_VEC2(0.0005, 0.05, -0.025, cairn_body_position(world, id));
}

void test_the_rate_decides_how_much_time_a_step_takes(void)
{
    ASSERT_OK(cairn_world_set_rate(world, CAIRN_F(100)));
    cairn_body_id id = put_moving(&ball, 0, 0, CAIRN_F(2), 0);
    run(100);
    ASSERT_NEAR_VEC2(4 * LSB, 2, -5, cairn_body_position(world, id));
}

void test_a_parabola_is_the_same_for_any_number_of_substeps(void)
{
    for (int substeps = 1; substeps <= 16; substeps++) {
        open_yard(CAIRN_F(-10));
        ASSERT_OK(cairn_world_set_substeps(world, substeps));
        cairn_body_id id = put_moving(&ball, 0, 0, CAIRN_F(3), CAIRN_F(7));
        run(60);
        ASSERT_NEAR_VEC2(4 * LSB, 3, 2, cairn_body_position(world, id));
    }
}

void test_a_new_rate_keeps_velocities_and_spins(void)
{
    yard_def def = def_at(&box, 0, 0);
    def.velocity = cairn_vec2_of(CAIRN_F(5), CAIRN_F(-3));
    def.angular_velocity = CAIRN_F(2);
    cairn_body_id id = make(&def);
    ASSERT_OK(cairn_world_set_rate(world, CAIRN_F(250)));
    ASSERT_NEAR_VEC2(2 * LSB, 5, -3, cairn_body_velocity(world, id));
    ASSERT_NEAR(2 * LSB, 2, spin_of(id));
}

void test_a_new_number_of_substeps_keeps_velocities_and_spins(void)
{
    yard_def def = def_at(&box, 0, 0);
    def.velocity = cairn_vec2_of(CAIRN_F(5), CAIRN_F(-3));
    def.angular_velocity = CAIRN_F(2);
    cairn_body_id id = make(&def);
    ASSERT_OK(cairn_world_set_substeps(world, 1));
    ASSERT_OK(cairn_world_set_substeps(world, 16));
    ASSERT_NEAR_VEC2(4 * LSB, 5, -3, cairn_body_velocity(world, id));
    ASSERT_NEAR(4 * LSB, 2, spin_of(id));
}

/* A force that waits for the next step is a force, whatever the step: F / (m rate). */
void test_a_new_rate_keeps_forces_that_wait(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, cairn_vec2_of(0, 0)));
    cairn_body_id id = put(&box, 0, 0);
    ASSERT_OK(cairn_body_apply_force(world, id, cairn_vec2_of(CAIRN_F(120), 0)));
    ASSERT_OK(cairn_world_set_rate(world, CAIRN_F(120)));
    run(1);
    ASSERT_NEAR(8 * LSB, 1, vx_of(id));
}

/* Warm impulses carry over: the box that rests neither hops nor sinks when the sub-step changes. */
void test_new_settings_of_time_do_not_shake_what_rests(void)
{
    put_static(&ground, 0, CAIRN_F(-0.5));
    cairn_body_id low = put(&box, 0, CAIRN_F(0.5)), high = put(&box, 0, CAIRN_F(1.5));
    run(60);
    cairn_real rested = y_of(high);
    static const int substeps[] = { 8, 2, 16, 4 };
    for (int i = 0; i < 4; i++) {
        ASSERT_OK(cairn_world_set_substeps(world, substeps[i]));
        ASSERT_OK(cairn_world_set_rate(world, i & 1 ? CAIRN_F(60) : CAIRN_F(90)));
        run(1);
        ASSERT_NEAR(0.01, 0, vy_of(low)); /* a step's gravity is 0.17 m/s */
        ASSERT_NEAR(0.01, 0, vy_of(high));
    }
    ASSERT_NEAR(0.002, 0, y_of(high) - rested);
}

/* ---- limits ---- */

void test_speeds_above_the_limit_are_cut_to_it_and_counted(void)
{
    cairn_real limit = cairn_world_speed_limit(world);
    cairn_body_id id = put(&ball, 0, 0);
    TEST_ASSERT_EQUAL_UINT32(0, stats()->saturations);
    ASSERT_OK(cairn_body_set_velocity(world, id, cairn_vec2_of(CAIRN_F(-30000), CAIRN_F(1))));
    TEST_ASSERT_EQUAL_UINT32(1, stats()->saturations);
    ASSERT_SAME(-limit, vx_of(id));
    ASSERT_NEAR(LSB, 1, vy_of(id));
    ASSERT_OK(cairn_body_set_angular_velocity(world, id, CAIRN_F(30000)));
    TEST_ASSERT_EQUAL_UINT32(2, stats()->saturations);
    TEST_ASSERT_TRUE(spin_of(id) > CAIRN_F(100) && spin_of(id) < CAIRN_F(1000));
    ASSERT_OK(cairn_body_apply_impulse(world, id, cairn_vec2_of(0, CAIRN_F(32000))));
    ASSERT_SAME(limit, vy_of(id));
    TEST_ASSERT_EQUAL_UINT32(3, stats()->saturations);
}

/* The limit is metres per sub-step: more steps and sub-steps allow more. At 60 Hz a game needs 100 m/s at least. */
void test_the_speed_limit_grows_with_rate_and_substeps(void)
{
    cairn_real before = cairn_world_speed_limit(world);
    TEST_ASSERT_TRUE(before > CAIRN_F(100));
    ASSERT_OK(cairn_world_set_rate(world, CAIRN_F(120)));
    cairn_real doubled = cairn_world_speed_limit(world);
    ASSERT_NEAR(4 * LSB, 0, doubled - 2 * before);
    ASSERT_OK(cairn_world_set_substeps(world, 8));
    TEST_ASSERT_TRUE(cairn_world_speed_limit(world) > doubled);
}

void test_falling_for_ever_meets_the_speed_limit_and_does_not_wrap(void)
{
    ASSERT_OK(cairn_world_set_gravity(world, cairn_vec2_of(0, CAIRN_F(-2000))));
    cairn_body_id id = put(&ball, 0, 0);
    cairn_real last = 0;
    for (int i = 0; i < 120; i++) {
        run(1);
        TEST_ASSERT_TRUE(y_of(id) < last);
        last = y_of(id);
    }
    TEST_ASSERT_TRUE(size_of(vy_of(id) + cairn_world_speed_limit(world)) <= CAIRN_F(34)); /* a step's gravity */
    TEST_ASSERT_TRUE(stats()->saturations > 0);
}

void test_the_edge_of_the_world_stops_bodies_and_counts(void)
{
    cairn_body_id id = put_moving(&ball, CAIRN_F(15999.5), CAIRN_F(-15999.9), CAIRN_F(120), 0);
    run(10);
    ASSERT_NEAR_VEC2(LSB, 16000, -16000, cairn_body_position(world, id));
    ASSERT_NEAR(LSB, 0, vx_of(id));
    TEST_ASSERT_TRUE(stats()->saturations > 0);
    ASSERT_OK(cairn_body_set_velocity(world, id, cairn_vec2_of(CAIRN_F(-60), CAIRN_F(60))));
    run(1);
    ASSERT_NEAR_VEC2(0.01, 15999, -15999, cairn_body_position(world, id)); /* and lets them go */
}

/* ---- pools ---- */

static void fill_bodies(cairn_body_id *ids)
{
    for (int i = 0; i < YARD_BODIES; i++) {
        ids[i] = put(&ball, CAIRN_F(2) * i, 0);
    }
}

void test_a_full_body_pool_refuses_and_changes_nothing(void)
{
    cairn_body_id ids[YARD_BODIES];
    yard_def def = def_at(&ball, 0, 0);
    fill_bodies(ids);
    TEST_ASSERT_EQUAL_UINT16(YARD_BODIES, stats()->bodies);
    ASSERT_REFUSED_ID(CAIRN_ERROR_FULL, make_in(world, &def));
    ASSERT_OK(cairn_body_destroy(world, ids[5]));
    TEST_ASSERT_EQUAL_UINT16(YARD_BODIES - 1, stats()->bodies);
    cairn_body_id again = make(&def);
    TEST_ASSERT_EQUAL_UINT16(ids[5].index, again.index);
    ASSERT_REFUSED_ID(CAIRN_ERROR_FULL, make_in(world, &def));
}

void test_an_id_is_stale_after_destroy_and_after_the_place_is_used_again(void)
{
    cairn_body_id first = put(&ball, 0, 0);
    ASSERT_OK(cairn_body_destroy(world, first));
    TEST_ASSERT_FALSE(cairn_body_exists(world, first));
    ASSERT_REFUSED(CAIRN_ERROR_STALE, cairn_body_destroy(world, first));
    cairn_body_id second = put(&ball, 0, 0);
    TEST_ASSERT_EQUAL_UINT16(first.index, second.index);
    TEST_ASSERT_TRUE(cairn_body_exists(world, second));
    TEST_ASSERT_FALSE(cairn_body_exists(world, first));
    TEST_ASSERT_FALSE(same(first, second));
    ASSERT_REFUSED(CAIRN_ERROR_STALE, cairn_body_destroy(world, first));
}

void test_ids_that_never_were_are_stale(void)
{
    cairn_body_id id = put(&ball, 0, 0);
    TEST_ASSERT_FALSE(cairn_body_exists(world, cairn_body_id_null()));
    TEST_ASSERT_FALSE(cairn_body_exists(NULL, id));
    id.index = 2;
    TEST_ASSERT_FALSE(cairn_body_exists(world, id));
    id.index = 65535;
    TEST_ASSERT_FALSE(cairn_body_exists(world, id));
}

/* After 65535 uses of a place its generations begin again, and never with that of the null id. */
void test_generations_wrap_round_zero(void)
{
    yard_def def = def_at(&ball, 0, 0);
    cairn_body_id first = make(&def), id = first;
    for (int32_t i = 0; i < 65535; i++) {
        cairn_body_destroy(world, id);
        id = make_in(world, &def);
        if (id.generation == 0 || id.index != first.index) {
            TEST_FAIL_MESSAGE("generation 0");
        }
    }
    TEST_ASSERT_TRUE(same(first, id));
    TEST_ASSERT_EQUAL_UINT16(1, stats()->bodies);
}

void test_bodies_are_walked_in_the_order_of_the_pool_without_the_destroyed(void)
{
    cairn_body_id ids[YARD_BODIES];
    fill_bodies(ids);
    ASSERT_OK(cairn_body_destroy(world, ids[0]));
    ASSERT_OK(cairn_body_destroy(world, ids[7]));
    ASSERT_OK(cairn_body_destroy(world, ids[YARD_BODIES - 1]));
    cairn_body_id id = cairn_body_id_null();
    for (int i = 1; i < YARD_BODIES - 1; i++) {
        if (i != 7) {
            id = cairn_world_next_body(world, id);
            TEST_ASSERT_TRUE(same(ids[i], id));
        }
    }
    TEST_ASSERT_TRUE(cairn_body_id_is_null(cairn_world_next_body(world, id)));
}

CAIRN_WORLD(tight, 8, 2);

/* Three balls over a floor with room for two contacts: the third falls through, the others lie. */
void test_a_full_arbiter_pool_drops_contacts_counts_them_and_keeps_the_rest(void)
{
    world = cairn_world_init(&tight, cairn_vec2_of(0, CAIRN_F(-10)));
    put_static(&ground, 0, CAIRN_F(-0.5));
    cairn_body_id balls[3];
    for (int i = 0; i < 3; i++) {
        balls[i] = put(&ball, CAIRN_F(3) * i, CAIRN_F(0.5));
    }
    run(30);
    TEST_ASSERT_EQUAL_UINT16(2, stats()->arbiters);
    TEST_ASSERT_TRUE(stats()->dropped > 0);
    ASSERT_NEAR(0.002, 0.5, y_of(balls[0]));
    ASSERT_NEAR(0.002, 0.5, y_of(balls[1]));
    TEST_ASSERT_TRUE(y_of(balls[2]) < CAIRN_F(0));
    /* a place that becomes free is used again */
    uint32_t dropped = stats()->dropped;
    ASSERT_OK(cairn_body_destroy(world, balls[0]));
    ASSERT_OK(cairn_body_set_transform(world, balls[2], cairn_vec2_of(CAIRN_F(6), CAIRN_F(0.5)), 0));
    ASSERT_OK(cairn_body_set_velocity(world, balls[2], cairn_vec2_of(0, 0)));
    run(30);
    TEST_ASSERT_EQUAL_UINT32(dropped, stats()->dropped);
    ASSERT_NEAR(0.002, 0.5, y_of(balls[2]));
}

void test_statistics_count_pairs_arbiters_and_points(void)
{
    put_static(&ground, 0, CAIRN_F(-0.5));
    put(&box, 0, CAIRN_F(0.5));
    put(&ball, CAIRN_F(3), CAIRN_F(0.5));
    put(&ball, CAIRN_F(3), CAIRN_F(8));
    run(2);
    TEST_ASSERT_EQUAL_UINT16(4, stats()->bodies);
    TEST_ASSERT_EQUAL_UINT16(3, stats()->awake);
    TEST_ASSERT_EQUAL_UINT16(2, stats()->pairs);
    TEST_ASSERT_EQUAL_UINT16(2, stats()->arbiters);
    TEST_ASSERT_EQUAL_UINT16(3, stats()->points); /* two of the box, one of the ball */
    TEST_ASSERT_EQUAL_UINT16(0, stats()->springs);
    TEST_ASSERT_EQUAL_UINT32(0, stats()->dropped);
    TEST_ASSERT_EQUAL_UINT32(0, stats()->saturations);
}

/* ---- what a step left out, as its statistics tell ---- */

void test_what_meets_nothing_takes_no_part_in_the_sub_steps(void)
{
    put(&box, 0, CAIRN_F(5));
    run(3);
    TEST_ASSERT_EQUAL_UINT16(1, stats()->awake);
    TEST_ASSERT_EQUAL_UINT16(0, stats()->moved);
    TEST_ASSERT_EQUAL_UINT16(0, stats()->looked);
}

void test_what_rests_is_solved_but_not_looked_at(void)
{
    put_static(&ground, 0, CAIRN_F(-0.5));
    put(&box, 0, CAIRN_F(0.5));
    run(1);
    TEST_ASSERT_EQUAL_UINT16(1, stats()->looked);
    run(60);
    TEST_ASSERT_EQUAL_UINT16(1, stats()->pairs);
    TEST_ASSERT_EQUAL_UINT16(0, stats()->looked);
    TEST_ASSERT_EQUAL_UINT16(1, stats()->solved);
    TEST_ASSERT_EQUAL_UINT16(1, stats()->moved);
}

void test_what_sleeps_costs_nothing(void)
{
    ASSERT_OK(cairn_sleep_enable(world));
    put_static(&ground, 0, CAIRN_F(-0.5));
    put(&box, 0, CAIRN_F(0.5));
    run(180);
    TEST_ASSERT_EQUAL_UINT16(0, stats()->awake);
    TEST_ASSERT_EQUAL_UINT16(0, stats()->looked);
    TEST_ASSERT_EQUAL_UINT16(0, stats()->solved);
    TEST_ASSERT_EQUAL_UINT16(0, stats()->moved);
}
