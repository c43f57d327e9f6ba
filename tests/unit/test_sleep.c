/* Sleep: who falls asleep, who does not, and all that wakes. */
# include "../../src/engine.h"
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(40), CAIRN_F(1));
static const cairn_shape peg = CAIRN_CIRCLE(CAIRN_F(0.05));
CAIRN_SPRINGS(coils, 4);

static cairn_body_id floor_id, low, high, hook;

/* Two boxes, one on the other, asleep. */
void setUp(void)
{
    open_yard(CAIRN_F(-10));
    memset(coils_springs, 0, sizeof coils_springs);
    ASSERT_OK(cairn_springs_enable(world, &coils));
    ASSERT_OK(cairn_sleep_enable(world));
    floor_id = put_static(&ground, 0, CAIRN_F(-0.5));
    low = put(&box, 0, CAIRN_F(0.5));
    high = put(&box, 0, CAIRN_F(1.5));
    run(120);
}
void tearDown(void) {}

static bool awake(cairn_body_id id) { return cairn_body_is_awake(world, id); }

#define ASSERT_BOTH_ASLEEP() \
    do { \
        TEST_ASSERT_FALSE(awake(low)); \
        TEST_ASSERT_FALSE(awake(high)); \
    } while (0)

#define ASSERT_BOTH_AWAKE() \
    do { \
        TEST_ASSERT_TRUE(awake(low)); \
        TEST_ASSERT_TRUE(awake(high)); \
    } while (0)

/* Both were asleep and are awake after the next step, as a group. */
#define ASSERT_WAKES(call) \
    do { \
        ASSERT_BOTH_ASLEEP(); \
        ASSERT_OK(call); \
        run(1); \
        ASSERT_BOTH_AWAKE(); \
    } while (0)

/* ---- falling asleep ---- */

void test_what_rests_for_half_a_second_falls_asleep(void)
{
    ASSERT_BOTH_ASLEEP();
    cairn_body_id id = put(&box, CAIRN_F(5), CAIRN_F(0.5));
    run(25);
    TEST_ASSERT_TRUE(awake(id));
    run(30);
    TEST_ASSERT_FALSE(awake(id));
    ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_velocity(world, id));
}

void test_sleepers_stay_exactly_where_they_are(void)
{
    cairn_vec2 before = cairn_body_position(world, high);
    run(300);
    ASSERT_BOTH_ASLEEP();
    ASSERT_SAME(before.x, x_of(high));
    ASSERT_SAME(before.y, y_of(high));
}

void test_sleepers_are_not_counted_as_awake_and_cost_no_pairs(void)
{
    run(1);
    TEST_ASSERT_EQUAL_UINT16(0, stats()->awake);
    TEST_ASSERT_EQUAL_UINT16(0, stats()->pairs);
    TEST_ASSERT_EQUAL_UINT16(0, stats()->points);
    TEST_ASSERT_EQUAL_UINT16(3, stats()->bodies);
}

void test_contacts_of_sleepers_remain_and_are_no_news(void)
{
    cairn_contact contact;
    run(10);
    TEST_ASSERT_TRUE(contact_of(low, high, &contact));
    TEST_ASSERT_TRUE(contact.touching);
    TEST_ASSERT_FALSE(contact.began);
    TEST_ASSERT_EQUAL_INT(2, contact.count);
    ASSERT_NEAR(0.05 * 10.0 / 480, 10.0 / 480, contact.points[0].impulse);
}

void test_what_moves_does_not_fall_asleep(void)
{
    yard_def def = def_at(&ball, CAIRN_F(-15), CAIRN_F(0.5));
    def.velocity.x = CAIRN_F(0.1);
    def.angular_velocity = CAIRN_F(-0.2);
    cairn_body_id roller = make(&def);
    def = def_at(&ball, CAIRN_F(15), CAIRN_F(0.5));
    def.material = &cairn_material_ice;
    def.angular_velocity = CAIRN_F(20);
    cairn_body_id spinner = make(&def);
    run(90);
    TEST_ASSERT_TRUE(awake(roller));
    TEST_ASSERT_TRUE(awake(spinner));
}

/* Slow at the top of a throw is not at rest. */
void test_a_ball_at_the_top_of_its_way_does_not_fall_asleep(void)
{
    cairn_body_id id = put_moving(&ball, CAIRN_F(9), CAIRN_F(2), 0, CAIRN_F(5));
    run(30);
    TEST_ASSERT_TRUE(awake(id));
    run(20);
    TEST_ASSERT_TRUE(y_of(id) < CAIRN_F(3.3));
}

void test_a_group_sleeps_only_as_a_whole(void)
{
    ASSERT_OK(cairn_body_wake(world, high));
    cairn_body_id rolling = put_moving(&ball, CAIRN_F(-0.2), CAIRN_F(2.5), CAIRN_F(0.05), 0);
    for (int i = 0; i < 30; i++) {
        run(1);
        if (awake(rolling)) {
            ASSERT_BOTH_AWAKE();
        }
    }
}

/* ---- waking ---- */

void test_wake_wakes_the_group(void) { ASSERT_WAKES(cairn_body_wake(world, high)); }
void test_an_impulse_wakes_the_group(void) { ASSERT_WAKES(cairn_body_apply_impulse(world, high, at(0, CAIRN_F(0.1)))); }
void test_an_impulse_at_a_point_wakes_the_group(void) { ASSERT_WAKES(cairn_body_apply_impulse_at(world, low, at(CAIRN_F(0.1), 0), at(0, 0))); }
void test_an_angular_impulse_wakes_the_group(void) { ASSERT_WAKES(cairn_body_apply_angular_impulse(world, high, CAIRN_F(0.01))); }
void test_a_force_wakes_the_group(void) { ASSERT_WAKES(cairn_body_apply_force(world, high, at(CAIRN_F(1), 0))); }
void test_a_torque_wakes_the_group(void) { ASSERT_WAKES(cairn_body_apply_torque(world, low, CAIRN_F(1))); }
void test_a_velocity_wakes_the_group(void) { ASSERT_WAKES(cairn_body_set_velocity(world, high, at(CAIRN_F(0.1), 0))); }
void test_a_spin_wakes_the_group(void) { ASSERT_WAKES(cairn_body_set_angular_velocity(world, high, CAIRN_F(0.1))); }
void test_a_gravity_scale_wakes_the_group(void) { ASSERT_WAKES(set_gravity_scale(high, 0)); }
void test_a_new_material_wakes_the_group(void) { ASSERT_WAKES(set_material(low, &cairn_material_ice)); }
void test_a_new_material_of_the_floor_wakes_what_lies_on_it(void) { ASSERT_WAKES(set_material(floor_id, &cairn_material_ice)); }
void test_new_layers_wake_the_group(void) { ASSERT_WAKES(set_layers(high, 1, 0xFFFF)); }
void test_new_gravity_wakes_all(void) { ASSERT_WAKES(cairn_world_set_gravity(world, at(0, CAIRN_F(-5)))); }

void test_disabling_sleep_wakes_all_for_good(void)
{
    ASSERT_WAKES(cairn_sleep_disable(world));
    run(120);
    ASSERT_BOTH_AWAKE();
}

void test_a_hit_wakes_the_group(void)
{
    put_moving(&ball, CAIRN_F(-5), CAIRN_F(1.5), CAIRN_F(8), CAIRN_F(2));
    run(20);
    ASSERT_BOTH_ASLEEP();
    run(20);
    ASSERT_BOTH_AWAKE();
    TEST_ASSERT_TRUE(x_of(high) > CAIRN_F(0.01));
}

/* The hit is felt in full in the step in which it comes, as if the sleepers had been awake. */
void test_a_hit_on_a_sleeper_is_as_hard_as_on_one_awake(void)
{
    cairn_real speed[2];
    for (int i = 0; i < 2; i++) {
        open_yard(0);
        if (i == 1) {
            ASSERT_OK(cairn_sleep_enable(world));
        }
        cairn_body_id still = put(&ball, 0, 0);
        run(60);
        TEST_ASSERT_EQUAL_INT(i == 0, awake(still));
        put_moving(&ball, CAIRN_F(-3), 0, CAIRN_F(6), 0);
        run(60);
        speed[i] = vx_of(still);
    }
    ASSERT_NEAR(0.001, 3, speed[0]);
    ASSERT_SAME(speed[0], speed[1]);
}

void test_removing_what_a_sleeper_lies_on_wakes_it(void)
{
    ASSERT_OK(cairn_body_destroy(world, low));
    run(1);
    TEST_ASSERT_TRUE(awake(high));
    run(30);
    TEST_ASSERT_TRUE(y_of(high) < CAIRN_F(1));
}

void test_removing_the_floor_wakes_what_lies_on_it(void)
{
    ASSERT_OK(cairn_body_destroy(world, floor_id));
    run(30);
    ASSERT_BOTH_AWAKE();
    TEST_ASSERT_TRUE(y_of(low) < CAIRN_F(-0.5));
}

void test_teleporting_a_body_wakes_what_it_touched(void)
{
    ASSERT_OK(cairn_body_set_transform(world, low, at(CAIRN_F(10), CAIRN_F(5)), 0));
    run(1);
    ASSERT_BOTH_AWAKE();
}

void test_teleporting_the_floor_away_wakes_what_lay_on_it(void)
{
    ASSERT_WAKES(cairn_body_set_transform(world, floor_id, at(0, CAIRN_F(-9)), 0));
}

/* A static body that is put into a sleeper touches it: it must not stay buried. */
void test_a_static_body_put_into_a_sleeper_wakes_it(void)
{
    cairn_body_id stone = put_static(&box, CAIRN_F(9), CAIRN_F(5));
    run(1);
    ASSERT_BOTH_ASLEEP();
    ASSERT_OK(cairn_body_set_transform(world, stone, at(CAIRN_F(-0.8), CAIRN_F(1.5)), 0));
    run(2);
    ASSERT_BOTH_AWAKE();
    run(60);
    TEST_ASSERT_TRUE(x_of(high) > CAIRN_F(0.15)); /* it is pushed out of the stone */
}

void test_a_static_body_made_inside_of_a_sleeper_wakes_it(void)
{
    put_static(&box, CAIRN_F(-0.8), CAIRN_F(1.5));
    run(2);
    ASSERT_BOTH_AWAKE();
}

void test_a_moving_platform_keeps_awake_and_wakes(void)
{
    yard_def def = def_at(&box, CAIRN_F(10), CAIRN_F(3));
    def.type = CAIRN_KINEMATIC;
    cairn_body_id platform = make(&def), rider = put(&box, CAIRN_F(10), CAIRN_F(4));
    run(90);
    TEST_ASSERT_FALSE(awake(rider)); /* it stands still */
    ASSERT_OK(cairn_body_set_velocity(world, platform, at(0, CAIRN_F(0.01))));
    run(1);
    TEST_ASSERT_TRUE(awake(rider));
    run(120);
    TEST_ASSERT_TRUE(awake(rider)); /* slower than what counts as rest, and yet carried */
    ASSERT_NEAR(0.0005, 0.01, vy_of(rider));
    ASSERT_OK(cairn_body_set_velocity(world, platform, at(0, 0)));
    run(90);
    TEST_ASSERT_FALSE(awake(rider));
}

/* So does one that moves sideways or turns only. */
void test_a_platform_that_stands_still_is_not_awake_and_costs_no_pairs(void)
{
    yard_def def = def_at(&box, CAIRN_F(0.2), CAIRN_F(2.6));
    def.type = CAIRN_KINEMATIC;
    cairn_body_id platform = make(&def);
    run(90);
    ASSERT_BOTH_ASLEEP();
    TEST_ASSERT_EQUAL(0, cairn_world_get_stats(world)->awake);
    TEST_ASSERT_EQUAL(0, cairn_world_get_stats(world)->pairs);
    ASSERT_OK(cairn_body_set_velocity(world, platform, at(0, CAIRN_F(-0.5))));
    run(30);
    TEST_ASSERT_TRUE(awake(high));
}

void test_any_motion_of_a_platform_keeps_awake(void)
{
    static const cairn_vec2 speeds[] = { { CAIRN_F(0.02), 0 }, { 0, 0 } };
    for (int i = 0; i < 2; i++) {
        yard_def def = def_at(&ground, CAIRN_F(100) * (i + 1), CAIRN_F(3));
        def.type = CAIRN_KINEMATIC;
        def.velocity = speeds[i];
        def.angular_velocity = i == 1 ? CAIRN_F(0.001) : 0;
        make(&def);
        cairn_body_id rider = put(&box, CAIRN_F(100) * (i + 1), CAIRN_F(4));
        run(120);
        TEST_ASSERT_TRUE(awake(rider));
    }
}

/* ---- springs ---- */

/* Hang a ball by a spring beside the boxes, and let it fall asleep. */
static cairn_body_id hang(cairn_spring_id *spring)
{
    hook = put_static(&peg, CAIRN_F(5), CAIRN_F(6));
    cairn_body_id load = put(&ball, CAIRN_F(5), CAIRN_F(4));
    cairn_spring_def def = cairn_spring_def_default(hook, load);
    def.stiffness = cairn_wide_from_int(100);
    def.damping = cairn_wide_from_int(20);
    *spring = cairn_spring_create(world, &def);
    run(240);
    TEST_ASSERT_FALSE(awake(load));
    return load;
}

void test_what_hangs_still_on_a_spring_falls_asleep(void)
{
    cairn_spring_id spring;
    cairn_body_id load = hang(&spring);
    ASSERT_NEAR(0.001, 4 - 0.0785398, y_of(load)); /* m g / k */
}

/* Drawn along by a spring, slower than what counts as rest: whichever end of the spring it is. */
void test_what_hangs_on_a_moving_platform_stays_awake(void)
{
    for (int i = 0; i < 2; i++) {
        yard_def lift = def_at(&peg, CAIRN_F(20) * (i + 1), CAIRN_F(6));
        lift.type = CAIRN_KINEMATIC;
        lift.velocity.y = CAIRN_F(0.01);
        hook = make(&lift);
        cairn_body_id load = put(&ball, CAIRN_F(20) * (i + 1), CAIRN_F(4));
        cairn_spring_def def = cairn_spring_def_default(i == 0 ? hook : load, i == 0 ? load : hook);
        def.stiffness = cairn_wide_from_int(100);
        def.damping = cairn_wide_from_int(20);
        cairn_spring_create(world, &def);
        run(120);
        for (int k = 0; k < 120; k++) {
            run(1);
            TEST_ASSERT_TRUE(awake(load)); /* in every step: not asleep and woken again */
        }
    }
}

void test_changing_a_spring_wakes_its_ends(void)
{
    cairn_spring_id spring;
    cairn_body_id load = hang(&spring);
    ASSERT_OK(cairn_spring_set(world, spring, CAIRN_F(1), cairn_wide_from_int(100), cairn_wide_from_int(20)));
    run(1);
    TEST_ASSERT_TRUE(awake(load));
}

void test_destroying_a_spring_wakes_its_ends(void)
{
    cairn_spring_id spring;
    cairn_body_id load = hang(&spring);
    ASSERT_OK(cairn_spring_destroy(world, spring));
    run(10);
    TEST_ASSERT_TRUE(awake(load));
}

void test_a_new_spring_wakes_its_ends(void)
{
    cairn_spring_def def = cairn_spring_def_default(floor_id, high);
    ASSERT_BOTH_ASLEEP();
    cairn_spring_create(world, &def);
    run(1);
    ASSERT_BOTH_AWAKE();
}

/* A spring joins what it links to one group: the sleeper wakes with the one that is pushed. */
void test_a_spring_carries_the_waking_over(void)
{
    cairn_body_id far = put(&box, CAIRN_F(10), CAIRN_F(0.5));
    cairn_spring_def def = cairn_spring_def_default(low, far);
    def.stiffness = cairn_wide_from_int(10);
    cairn_spring_create(world, &def);
    run(120);
    ASSERT_BOTH_ASLEEP();
    TEST_ASSERT_FALSE(awake(far));
    ASSERT_OK(cairn_body_apply_impulse(world, far, at(0, CAIRN_F(1))));
    run(1);
    ASSERT_BOTH_AWAKE();
}

/* Two that sleep have no links for the search for groups: what it took for theirs led to body 0, and from there along the list of free places. */
void test_a_spring_between_sleepers_is_no_way_to_the_free_places(void)
{
    open_yard(CAIRN_F(-10));
    memset(coils_springs, 0, sizeof coils_springs);
    ASSERT_OK(cairn_springs_enable(world, &coils));
    ASSERT_OK(cairn_sleep_enable(world));
    cairn_body_id first = put(&ball, CAIRN_F(-9), CAIRN_F(0.5)), second = put(&ball, CAIRN_F(-6), CAIRN_F(0.5));
    put_static(&ground, 0, CAIRN_F(-0.5));
    low = put(&box, 0, CAIRN_F(0.5));
    high = put(&box, CAIRN_F(2), CAIRN_F(0.5));
    cairn_spring_def def = cairn_spring_def_default(low, high);
    def.stiffness = cairn_wide_from_int(10);
    cairn_spring_create(world, &def);
    run(120);
    ASSERT_BOTH_ASLEEP();
    put_moving(&ball, CAIRN_F(-3), CAIRN_F(9), 0, CAIRN_F(5)); /* keeps the world at work */
    ASSERT_OK(cairn_body_destroy(world, second));
    ASSERT_OK(cairn_body_destroy(world, first));
    run(10);
    ASSERT_BOTH_ASLEEP();
    TEST_ASSERT_EQUAL_UINT16(first.index, put(&ball, CAIRN_F(-9), CAIRN_F(5)).index); /* the places are free one after the other, as they were */
    TEST_ASSERT_EQUAL_UINT16(second.index, put(&ball, CAIRN_F(-6), CAIRN_F(5)).index);
}

/* A lamp hangs on a platform that stands still, beside a ball that rolls and keeps the world at work. */
static cairn_body_id hang_on_platform(cairn_real damping)
{
    yard_def def = def_at(&peg, CAIRN_F(5), CAIRN_F(6));
    def.type = CAIRN_KINEMATIC;
    hook = make(&def);
    cairn_body_id load = put(&ball, CAIRN_F(5), CAIRN_F(3.9214602)); /* m g / k below the spring's rest */
    cairn_spring_def spring = cairn_spring_def_default(hook, load);
    spring.rest_length = CAIRN_F(2);
    spring.stiffness = cairn_wide_from_int(100);
    spring.damping = cairn_wide_from_real(damping);
    TEST_ASSERT_FALSE(cairn_spring_id_is_null(cairn_spring_create(world, &spring)));
    def = def_at(&ball, CAIRN_F(-18), CAIRN_F(0.5));
    def.velocity.x = CAIRN_F(1);
    def.angular_velocity = CAIRN_F(-2);
    make(&def);
    run(240);
    TEST_ASSERT_FALSE(awake(load));
    return load;
}

/* A platform that stands still wakes nothing, and is awake all the same: its springs once drove what slept on them to 16 m/s, which it had when it woke. */
void test_a_sleeper_on_a_spring_gains_no_speed(void)
{
    static const cairn_real damping[] = { CAIRN_F(5), CAIRN_F(20) }; /* the exact map, and the implicit one */
    for (int i = 0; i < 2; i++) {
        setUp();
        cairn_body_id load = hang_on_platform(damping[i]);
        ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_velocity(world, load));
        run(60);
        TEST_ASSERT_FALSE(awake(load));
        ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_velocity(world, load));
        ASSERT_OK(cairn_body_wake(world, load));
        run(60);
        ASSERT_NEAR(0.01, 3.9214602, y_of(load));
    }
}

void test_a_platform_that_sets_out_wakes_what_hangs_on_it(void)
{
    cairn_body_id load = hang_on_platform(CAIRN_F(20));
    ASSERT_OK(cairn_body_set_velocity(world, hook, at(CAIRN_F(0.01), 0)));
    run(1);
    TEST_ASSERT_TRUE(awake(load));
}

/* Nothing is left of what held it where it is: whoever drags a hook by its place expects the load to follow. */
void test_putting_a_hook_elsewhere_wakes_what_hangs_on_it(void)
{
    cairn_spring_id spring;
    for (int i = 0; i < 2; i++) {
        setUp();
        cairn_body_id load = i == 0 ? hang(&spring) : hang_on_platform(CAIRN_F(20));
        ASSERT_OK(cairn_body_set_transform(world, hook, at(CAIRN_F(6), CAIRN_F(6)), 0));
        run(60);
        TEST_ASSERT_TRUE(x_of(load) > CAIRN_F(5.2));
    }
}

/*
 * Walks over the bodies skip those that do nothing by a place that the first of them keeps in ux. What a spring or a contact holds
 * keeps none there, since these add to ux.
 */
void test_walks_over_bodies_take_no_push_for_a_place(void)
{
    cairn_body *body = &yard_bodies[1];
    body->ux = 5;
    TEST_ASSERT_EQUAL_PTR(CAIRN_WITH_SHORTCUTS ? &yard_bodies[5] : body + 1, cairn_body_skip(world, body));
    body->flags |= CAIRN_BODY_SPRING;
    TEST_ASSERT_EQUAL_PTR(body + 1, cairn_body_skip(world, body));
    body->flags = (uint16_t)((body->flags & ~(unsigned)CAIRN_BODY_SPRING) | CAIRN_BODY_MET);
    TEST_ASSERT_EQUAL_PTR(body + 1, cairn_body_skip(world, body));
}

/* ---- refusals ---- */

void test_sleep_enable_and_disable_refuse_null(void)
{
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_sleep_enable(NULL));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_sleep_disable(NULL));
}

/* ---- counts ---- */

/* In the step in which sleepers wake, pairs are sought twice; the statistics count them once. */
void test_pairs_are_counted_once_in_a_step_that_wakes(void)
{
    put_moving(&ball, CAIRN_F(-1.05), CAIRN_F(1.7), CAIRN_F(4), 0);
    run(1);
    ASSERT_BOTH_AWAKE();
    TEST_ASSERT_EQUAL_UINT16(3, stats()->pairs); /* floor and low, low and high, high and the ball */
}

CAIRN_WORLD(tight, 6, 2);

/* Two balls hit a sleeper in one step, and there is room for the contact of one of them: one is lost, not one a search. */
void test_lost_contacts_are_counted_once_in_a_step_that_wakes(void)
{
    world = cairn_world_init(&tight, at(0, CAIRN_F(-10)));
    ASSERT_OK(cairn_sleep_enable(world));
    put_static(&ground, 0, CAIRN_F(-0.5));
    cairn_body_id id = put(&box, 0, CAIRN_F(0.5));
    run(120);
    TEST_ASSERT_FALSE(awake(id));
    put_moving(&ball, CAIRN_F(-1.01), CAIRN_F(0.8), CAIRN_F(1), 0);
    put_moving(&ball, CAIRN_F(1.01), CAIRN_F(0.8), CAIRN_F(-1), 0);
    run(1);
    TEST_ASSERT_TRUE(awake(id));
    TEST_ASSERT_EQUAL_UINT32(1, stats()->dropped);
}
