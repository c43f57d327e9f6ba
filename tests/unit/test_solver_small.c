/* The small solver: what it does right, how well, and what it does not have. */
#include <cairn/quadtree.h>
#include <cairn/sleep.h>
#include <cairn/solver.h>

# include "../support/hard_solvers.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape beam = CAIRN_BOX(CAIRN_F(2), CAIRN_F(0.2));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(60), CAIRN_F(1));
static const cairn_shape wall = CAIRN_BOX(CAIRN_F(1), CAIRN_F(20));
static const cairn_material elastic = CAIRN_MATERIAL_BOUNCING(0, 0, 1, 0);
static const cairn_material half = CAIRN_MATERIAL_BOUNCING(0, 0, 0.5, 0);
static const cairn_material smooth = CAIRN_MATERIAL(0, 0);
CAIRN_SPRINGS(coils, 2);
CAIRN_QUADTREE(tree, 16, 16, 64);
CAIRN_BLOCKS(blocks);

static void open_small(cairn_real gravity)
{
    open_yard(gravity);
    ASSERT_OK(cairn_world_use_small_solver(world, 10));
}

void setUp(void) { open_small(CAIRN_F(-10)); }
void tearDown(void) {}

static cairn_body_id put_floor(void) { return put_static(&ground, 0, CAIRN_F(-0.5)); }

static cairn_body_id put_of(const cairn_shape *shape, const cairn_material *material, cairn_real x, cairn_real y)
{
    yard_def def = def_at(shape, x, y);
    def.material = material;
    return make(&def);
}

static cairn_body_id throw_of(const cairn_shape *shape, const cairn_material *material, cairn_real x, cairn_real y, cairn_vec2 velocity)
{
    cairn_body_id id = put_of(shape, material, x, y);
    ASSERT_OK(cairn_body_set_velocity(world, id, velocity));
    return id;
}

/* ---- choosing it ---- */

void test_passes_outside_of_1_to_100_are_refused(void)
{
    open_yard(0);
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_world_use_small_solver(NULL, 10));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_use_small_solver(world, 0));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_use_small_solver(world, -1));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_use_small_solver(world, 101));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_use_small_solver(world, 266));
    ASSERT_OK(cairn_world_use_small_solver(world, 1));
    ASSERT_OK(cairn_world_use_small_solver(world, 100));
}

static cairn_status status_in_query;

static bool choose(void *context, cairn_body_id id)
{
    (void)context;
    (void)id;
    status_in_query = cairn_world_use_small_solver(world, 10);
    return false;
}

void test_it_is_not_chosen_inside_of_a_callback(void)
{
    open_yard(0);
    put(&ball, 0, 0);
    status_in_query = CAIRN_OK;
    (void)cairn_query_point(world, at(0, 0), 0xFFFF, choose, NULL);
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_LOCKED, status_in_query);
}

/* What is not deeper than the slop of 1 cm is not pushed out. */
static void has_its_settings(void)
{
    ASSERT_NEAR(0.1, 48.9, cairn_world_speed_limit(world)); /* 0.93 m / 1.14 a step */
    put_static(&ground, 0, CAIRN_F(-0.5));
    cairn_body_id id = put(&box, 0, CAIRN_F(0.495));
    run(60);
    ASSERT_NEAR(0.0005, 0.495, y_of(id));
    ASSERT_OK(cairn_world_set_slop(world, 0));
    run(60);
    ASSERT_NEAR(0.001, 0.5, y_of(id));
}

void test_choosing_it_gives_one_substep_and_a_slop(void) { has_its_settings(); }

void test_a_world_may_be_made_with_it(void)
{
    world = cairn_world_init_with(&yard, at(0, CAIRN_F(-10)), &cairn_solver_small, NULL);
    TEST_ASSERT_NOT_NULL(world);
    has_its_settings();
}

void test_it_has_no_more_substeps_than_one(void)
{
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_world_set_substeps(world, 2));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_world_set_substeps(world, 16));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_substeps(world, 0));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_set_substeps(world, 17));
    ASSERT_OK(cairn_world_set_substeps(world, 1));
    ASSERT_OK(cairn_world_use_slides_solver(world, 10));
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_world_set_substeps(world, 4));
    ASSERT_OK(cairn_world_set_substeps(world, 1));
    open_yard(0);
    ASSERT_OK(cairn_world_set_substeps(world, 4));
}

void test_a_game_may_change_to_it_in_the_middle(void)
{
    open_yard(CAIRN_F(-10));
    put_floor();
    cairn_real before[4];
    cairn_body_id ids[4], thrown = put_moving(&ball, CAIRN_F(9), CAIRN_F(9), CAIRN_F(2), 0);
    for (int i = 0; i < 4; i++) {
        ids[i] = put(&box, 0, CAIRN_F(0.5) + CAIRN_F(1) * i);
    }
    run(30);
    for (int i = 0; i < 4; i++) {
        before[i] = y_of(ids[i]);
    }
    ASSERT_OK(cairn_world_use_small_solver(world, 10));
    ASSERT_NEAR_VEC2(4 * LSB, 2, -5, cairn_body_velocity(world, thrown));
    run(1);
    for (int i = 0; i < 4; i++) { /* with the impulses that it has: it does not begin anew */
        ASSERT_NEAR(0.0002, 0, y_of(ids[i]) - before[i]);
        ASSERT_NEAR(0.005, 0, vy_of(ids[i]));
    }
    run(120);
    for (int i = 0; i < 4; i++) {
        ASSERT_NEAR(0.02, 0.5 + i, y_of(ids[i]));
    }
}

void test_it_and_the_slides_may_take_turns(void)
{
    put_floor();
    cairn_body_id id = put(&box, 0, CAIRN_F(0.5)), above = put(&box, 0, CAIRN_F(1.5));
    for (int i = 0; i < 20; i++) {
        ASSERT_OK(i % 2 == 0 ? cairn_world_use_slides_solver(world, 10) : cairn_world_use_small_solver(world, 10));
        run(7);
        ASSERT_NEAR(0.03, 0.5, y_of(id));
        ASSERT_NEAR(0.04, 1.5, y_of(above));
    }
}

/* 1000 to 1: a block of the soft solver. */
void test_it_finds_no_blocks_left(void)
{
    open_yard(CAIRN_F(-10));
    ASSERT_OK(cairn_blocks_enable(world, &blocks));
    put_floor();
    cairn_body_id light = put(&box, 0, CAIRN_F(0.5));
    yard_def def = def_at(&box, 0, CAIRN_F(1.5));
    def.density = cairn_wide_from_int(1000);
    make(&def);
    run(30);
    TEST_ASSERT_TRUE(world->blocks > 0);
    ASSERT_OK(cairn_world_use_small_solver(world, 100));
    TEST_ASSERT_EQUAL_UINT(0, world->blocks);
    run(1);
    TEST_ASSERT_EQUAL_UINT(0, world->blocks);
    ASSERT_NEAR(0.05, 0.5, y_of(light));
}

/* ---- motion, contacts and friction ---- */

void test_a_projectile_flies_its_parabola(void)
{
    cairn_body_id id = put_moving(&ball, 0, 0, CAIRN_F(3), CAIRN_F(7));
    run(60);
    ASSERT_NEAR_VEC2(4 * LSB, 3, 2, cairn_body_position(world, id));
}

void test_gravity_is_scaled_by_the_model(void)
{
    cairn_body_id id = put(&ball, 0, 0), still = put(&ball, CAIRN_F(3), 0);
    ASSERT_OK(set_gravity_scale(id, CAIRN_F(-0.5)));
    ASSERT_OK(set_gravity_scale(still, 0));
    run(60);
    ASSERT_NEAR(8 * LSB, 2.5, y_of(id));
    ASSERT_SAME(0, y_of(still));
}

void test_a_box_stands(void)
{
    put_floor();
    cairn_body_id id = put(&box, 0, CAIRN_F(0.5));
    run(600);
    ASSERT_NEAR(0.001, 0.5, y_of(id));
    ASSERT_NEAR(0.0005, 0, x_of(id));
    ASSERT_NEAR(0.0005, 0, turned(id));
}

void test_a_stack_of_fifteen_stands(void)
{
    cairn_body_id ids[15];
    put_floor();
    for (int i = 0; i < 15; i++) {
        ids[i] = put(&box, 0, CAIRN_F(0.5) + CAIRN_F(1) * i);
    }
    run(1200);
    for (int i = 0; i < 15; i++) {
        ASSERT_NEAR(0.02, 0, x_of(ids[i]));
        ASSERT_NEAR(0.15, 0.5 + i, y_of(ids[i])); /* a slop of 1 cm for each contact below */
    }
}

void test_momentum_is_conserved(void)
{
    open_small(0);
    cairn_body_id a = put_moving(&box, CAIRN_F(-2), CAIRN_F(0.3), CAIRN_F(5), 0), b = put_moving(&box, CAIRN_F(2), 0, CAIRN_F(-1), CAIRN_F(0.5));
    run(120);
    ASSERT_NEAR(8 * LSB, 4, vx_of(a) + vx_of(b));
    ASSERT_NEAR(8 * LSB, 0.5, vy_of(a) + vy_of(b));
    TEST_ASSERT_TRUE(vx_of(b) > vx_of(a) - CAIRN_F(0.001));
}

/* Of 1 to 0.09 of its mass, without rebound, 0.6 m before a step of 0.67. Given once more in the next step, the impulse would send the light one off at twice the velocity, beyond the limit. */
void test_what_stops_an_impact_is_given_once(void)
{
    static const cairn_shape pebble = CAIRN_CIRCLE(CAIRN_F(0.15));
    open_small(0);
    cairn_body_id heavy = put_moving(&ball, CAIRN_F(-2.58), 0, CAIRN_F(40), 0), light = put(&pebble, 0, 0);
    run(10);
    ASSERT_NEAR(0.01, 40 / 1.09, vx_of(heavy));
    ASSERT_NEAR(0.01, 40 / 1.09, vx_of(light));
    TEST_ASSERT_EQUAL_UINT32(0, stats()->saturations);
}

void test_an_elastic_ball_hands_its_velocity_on(void)
{
    open_small(0);
    cairn_body_id a = throw_of(&ball, &elastic, CAIRN_F(-2), 0, at(CAIRN_F(3), 0)), b = put_of(&ball, &smooth, CAIRN_F(0), 0);
    run(60);
    ASSERT_NEAR(4 * LSB, 0, vx_of(a));
    ASSERT_NEAR(4 * LSB, 3, vx_of(b));
}

void test_friction_holds_below_the_static_angle_and_slides_above(void)
{
    yard_def def = def_on_slope(CAIRN_DEGREES(15));
    cairn_body_id id = make(&def);
    run(300);
    ASSERT_NEAR(0.005, 0, x_of(id) - def.position.x);
    ASSERT_OK(set_material(id, &smooth));
    ASSERT_OK(cairn_body_set_transform(world, id, def.position, def.angle));
    ASSERT_OK(cairn_body_set_velocity(world, id, at(0, 0)));
    run(60);
    ASSERT_NEAR(0.003, -1.2708, x_of(id) - def.position.x); /* g sin 15 cos 15 / 2, and Euler's half step of it */
}

void test_kinetic_friction_slows_by_its_coefficient(void)
{
    put_floor();
    cairn_body_id id = put_moving(&box, 0, CAIRN_F(0.5), CAIRN_F(6), 0);
    run(60);
    ASSERT_NEAR(0.02, 2, vx_of(id)); /* 0.4 g for a second */
}

void test_overlapping_bodies_part(void)
{
    open_small(0);
    cairn_body_id a = put(&ball, 0, 0), b = put(&ball, CAIRN_F(0.7), 0);
    run(60);
    TEST_ASSERT_TRUE(x_of(b) - x_of(a) > CAIRN_F(0.98));
    TEST_ASSERT_TRUE(vx_of(b) - vx_of(a) <= CAIRN_F(3)); /* Baumgarte's: they keep what pushes them out */
}

void test_a_platform_carries_a_box(void)
{
    yard_def def = def_at(&beam, 0, CAIRN_F(-0.1));
    def.type = CAIRN_KINEMATIC;
    def.velocity = at(CAIRN_F(0.5), CAIRN_F(0.25));
    make(&def);
    cairn_body_id id = put(&box, 0, CAIRN_F(0.5));
    ASSERT_OK(cairn_body_set_velocity(world, id, def.velocity));
    run(240);
    ASSERT_NEAR_VEC2(0.02, 2, 1.5, cairn_body_position(world, id));
}

/* ---- restitution ---- */

static cairn_real top_of(cairn_body_id id)
{
    while (vy_of(id) <= 0) {
        run(1);
    }
    while (vy_of(id) > 0) {
        run(1);
    }
    return y_of(id);
}

void test_an_elastic_ball_keeps_its_height(void)
{
    put_floor();
    cairn_body_id id = put_of(&ball, &elastic, 0, CAIRN_F(5.5));
    for (int i = 0; i < 10; i++) {
        ASSERT_NEAR(0.05, 5.5, top_of(id)); /* 1 % */
    }
}

void test_a_ball_of_half_the_restitution_rises_to_a_quarter(void)
{
    put_floor();
    cairn_body_id id = put_of(&ball, &half, 0, CAIRN_F(8.5));
    ASSERT_NEAR(0.15, 2.5, top_of(id));
    ASSERT_NEAR(0.1, 1, top_of(id));
}

/* 1 m/s, and a ball falls with 2 m/s from 20 cm. */
void test_what_closes_slower_than_the_threshold_does_not_rebound(void)
{
    static const cairn_material first = CAIRN_MATERIAL_BOUNCING(0, 0, 0.8, 1.9), second = CAIRN_MATERIAL_BOUNCING(0, 0, 0.8, 2.1);
    put_floor();
    cairn_body_id bounces = put_of(&ball, &first, 0, CAIRN_F(0.7)), rests = put_of(&ball, &second, CAIRN_F(3), CAIRN_F(0.7));
    run(12);
    cairn_real high = 0, low = 0;
    for (int i = 0; i < 30; i++) {
        run(1);
        high = vy_of(bounces) > high ? vy_of(bounces) : high;
        low = vy_of(rests) > low ? vy_of(rests) : low;
    }
    ASSERT_NEAR(0.3, 1.5, high);
    ASSERT_NEAR(0.01, 0, low);
}

void test_no_threshold_is_too_high(void)
{
    static const cairn_material high[] = { CAIRN_MATERIAL_BOUNCING(0, 0, 1, 500), CAIRN_MATERIAL_BOUNCING(0, 0, 1, 520), CAIRN_MATERIAL_BOUNCING(0, 0, 1, 1030),
                                           CAIRN_MATERIAL_BOUNCING(0, 0, 1, 30000) };
    cairn_body_id ids[4];
    put_floor();
    for (int i = 0; i < 4; i++) {
        ids[i] = throw_of(&ball, &high[i], CAIRN_F(2) * i, CAIRN_F(1), at(0, CAIRN_F(-10)));
    }
    ASSERT_OK(cairn_world_set_rate(world, CAIRN_F(10)));
    for (int i = 0; i < 40; i++) {
        run(1);
        TEST_ASSERT_TRUE(y_of(ids[i % 4]) < CAIRN_F(0.6));
    }
}

/* Gravity does not pull at it. */
void test_what_does_not_fall_rebounds_as_fast_as_it_came(void)
{
    put_floor();
    cairn_body_id id = throw_of(&ball, &elastic, 0, CAIRN_F(2), at(0, CAIRN_F(-3)));
    ASSERT_OK(set_gravity_scale(id, 0));
    run(60);
    ASSERT_NEAR(4 * LSB, 3, vy_of(id));
}

void test_a_rebound_is_not_repeated_in_the_next_step(void)
{
    open_small(0);
    put_floor();
    cairn_body_id id = throw_of(&ball, &half, 0, CAIRN_F(1), at(0, CAIRN_F(-8)));
    for (int i = 0; i < 20; i++) {
        run(1);
        TEST_ASSERT_TRUE(vy_of(id) < CAIRN_F(4.001));
    }
    ASSERT_NEAR(4 * LSB, 4, vy_of(id));
}

/* m u (1 + e), of a ball of pi / 4 kg */
void test_a_game_reads_the_impulse_of_a_rebound(void)
{
    open_small(0);
    cairn_body_id below = put_floor(), id = throw_of(&ball, &half, 0, CAIRN_F(0.499), at(0, CAIRN_F(-8)));
    cairn_contact contact;
    run(1);
    TEST_ASSERT_TRUE(contact_of(below, id, &contact));
    TEST_ASSERT_TRUE(contact.touching);
    TEST_ASSERT_EQUAL_INT(1, contact.count);
    ASSERT_NEAR(0.01, 9.4248, contact.points[0].impulse);
}

/* ---- fast bodies ---- */

/* What would get there within the step comes no nearer than to the surface. */
void test_a_fast_ball_does_not_sink_into_a_wall(void)
{
    open_small(0);
    put_static(&wall, CAIRN_F(5), 0);
    cairn_body_id id = throw_of(&ball, &smooth, 0, 0, at(CAIRN_F(20), 0));
    cairn_real far = 0;
    for (int i = 0; i < 60; i++) {
        run(1);
        far = x_of(id) > far ? x_of(id) : far;
    }
    TEST_ASSERT_TRUE(far < CAIRN_F(4.01));
    TEST_ASSERT_TRUE(far > CAIRN_F(3.99));
}

void test_a_fast_box_that_turns_stays_above_the_floor(void)
{
    put_floor();
    yard_def def = def_at(&box, 0, CAIRN_F(4));
    def.angle = CAIRN_DEGREES(30);
    def.velocity = at(CAIRN_F(3), CAIRN_F(-30));
    def.angular_velocity = CAIRN_F(5);
    cairn_body_id id = make(&def);
    for (int i = 0; i < 240; i++) {
        run(1);
        TEST_ASSERT_TRUE(y_of(id) > CAIRN_F(0.45));
    }
    ASSERT_NEAR(0.01, 0.5, y_of(id));
}

/* ---- features ---- */

void test_sensors_report_and_do_not_push(void) { assert_sensors_report_and_do_not_push(); }

void test_a_ball_turns_a_flipper_by_the_law_of_angular_momentum(void) { assert_a_ball_turns_a_flipper(open_small); }

void test_a_spring_sags_by_the_weight_over_the_stiffness(void) { assert_a_spring_sags_by_the_weight_over_the_stiffness(&coils); }

void test_what_rests_falls_asleep_and_wakes(void)
{
    ASSERT_OK(cairn_sleep_enable(world));
    put_floor();
    cairn_body_id ids[3];
    for (int i = 0; i < 3; i++) {
        ids[i] = put(&box, 0, CAIRN_F(0.5) + CAIRN_F(1) * i);
    }
    run(240);
    TEST_ASSERT_EQUAL_UINT(0, stats()->awake);
    cairn_real y = y_of(ids[2]);
    run(60);
    ASSERT_SAME(y, y_of(ids[2]));
    put_moving(&ball, 0, CAIRN_F(5), 0, CAIRN_F(-3));
    run(40);
    TEST_ASSERT_TRUE(cairn_body_is_awake(world, ids[0]));
    for (int i = 0; i < 3; i++) {
        ASSERT_NEAR(0.03, 0.5 + i, y_of(ids[i]));
    }
}

/* The bits do not depend on how pairs are found. */
void test_the_quadtree_gives_the_same(void)
{
    cairn_vec2 place[2][8];
    for (int by_tree = 0; by_tree < 2; by_tree++) {
        open_small(CAIRN_F(-10));
        if (by_tree) {
            ASSERT_OK(cairn_quadtree_enable(world, &tree, at(0, 0), 6, 6));
        }
        cairn_body_id ids[8];
        put_floor();
        for (int i = 0; i < 8; i++) {
            ids[i] = put_of(i % 2 ? &ball : &box, i % 3 ? &cairn_material_default : &half, CAIRN_F(0.3) * (i % 4), CAIRN_F(1) + CAIRN_F(1.2) * i);
        }
        run(240);
        for (int i = 0; i < 8; i++) {
            place[by_tree][i] = cairn_body_position(world, ids[i]);
        }
    }
    for (int i = 0; i < 8; i++) {
        ASSERT_SAME(place[0][i].x, place[1][i].x);
        ASSERT_SAME(place[0][i].y, place[1][i].y);
    }
}
