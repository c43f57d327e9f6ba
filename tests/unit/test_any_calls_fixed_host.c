/*
 * Any calls in any order with any numbers: nothing undefined (the sanitizers' builds look), nothing beyond its limits, no body lost, and the
 * same calls give the same world, however pairs are found. `tools/cairn fuzz` plays more worlds than the test does: CAIRN_FUZZ_WORLDS from
 * CAIRN_FUZZ_SEED on, each told before it is played.
 */
# include "../support/any_world.h" /* the space keeps it out of the generated runner, which lies elsewhere */

#include <stdio.h>
#include <stdlib.h>
#include <unity.h>

enum { WORLDS = 200 };

void setUp(void) {}
void tearDown(void) {}

/* ---- what is asked ---- */

static int found;

static bool on_body(void *context, cairn_body_id id)
{
    (void)context;
    found++;
    TEST_ASSERT_TRUE(cairn_body_exists(world, id));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_LOCKED, cairn_body_destroy(world, id));
    return found % 4 != 0; /* not by chance: who is found first is nobody's business */
}

static bool on_hit(void *context, const cairn_ray_hit *hit)
{
    TEST_ASSERT_TRUE(hit->fraction >= 0 && hit->fraction <= CAIRN_F(1));
    return on_body(context, hit->body);
}

static void on_circle(void *context, cairn_body_id body, cairn_draw_state state, cairn_vec2 center, cairn_real radius, cairn_vec2 axis)
{
    (void)context;
    (void)state;
    (void)center;
    (void)axis;
    TEST_ASSERT_TRUE(cairn_body_exists(world, body) && radius > 0);
}

static void on_polygon(void *context, cairn_body_id body, cairn_draw_state state, const cairn_vec2 *corners, int count)
{
    (void)context;
    (void)state;
    (void)corners;
    TEST_ASSERT_TRUE(cairn_body_exists(world, body) && count >= 3 && count <= CAIRN_MAX_VERTICES);
}

static void ask(void)
{
    static const cairn_debug_draw draw = { NULL, on_circle, on_polygon, NULL, NULL, NULL };
    cairn_ray_hit hit;
    cairn_contact contact;
    cairn_body_id touched, id = any_body();
    const cairn_vec2 one = any_place(CAIRN_F(5)), other = any_place(CAIRN_F(5));
    const uint16_t mask = (uint16_t)arith_random_bits(&any_r);
    cairn_vec2 corner;
    int cursor = 0;
    switch (below(11)) {
    case 0: (void)cairn_query_ray(world, one, other, mask, &hit); break;
    case 1: (void)cairn_query_ray_all(world, one, other, mask, on_hit, NULL); break;
    case 2: (void)cairn_query_point(world, one, mask, on_body, NULL); break;
    case 3: (void)cairn_query_box(world, one, other, mask, on_body, NULL); break;
    case 4:
        while (cairn_world_next_contact(world, &cursor, &contact)) {
            TEST_ASSERT_TRUE(cairn_body_exists(world, contact.a) && cairn_body_exists(world, contact.b));
        }
        break;
    case 5:
        while (cairn_body_next_touched(world, id, &cursor, &touched)) {
            TEST_ASSERT_TRUE(cairn_body_exists(world, touched));
        }
        break;
    case 6: (void)cairn_debug_draw_bodies(world, &draw); break;
    case 7:
        (void)cairn_debug_draw_contacts(world, &draw);
        (void)cairn_debug_draw_cells(world, &draw);
        (void)cairn_debug_draw_springs(world, &draw);
        break;
    case 8:
        (void)cairn_body_velocity_at(world, id, one);
        (void)cairn_body_to_local(world, id, cairn_body_to_world(world, id, one));
        (void)cairn_body_mass(world, id);
        (void)cairn_body_inertia(world, id);
        break;
    case 9: (void)cairn_spring_anchors(world, any_spring(), &corner, &corner); break;
    default: (void)cairn_spring_length(world, any_spring()); break;
    }
}

/* ---- what is changed ---- */

/* One in a few as fast as anything may be. */
static cairn_vec2 any_velocity(void)
{
    return vector(one_in(6) ? cairn_world_speed_limit(world) : any.speed);
}

static void move_body(cairn_body_id id)
{
    const cairn_vec2 place = one_in(3) ? cairn_body_position(world, any_body()) : any_place(CAIRN_F(4));
    const cairn_angle angle = any_angle();
    (void)cairn_body_set_transform(world, id, place, angle);
}

static void change_body(void)
{
    const cairn_body_id id = any_body();
    switch (below(10)) {
    case 0: move_body(id); break;
    case 1: (void)cairn_body_set_velocity(world, id, any_velocity()); break;
    case 2: (void)cairn_body_set_angular_velocity(world, id, number(-any.speed, any.speed)); break;
    case 3:
    case 4: (void)cairn_body_set_model(world, id, model_for(id)); break;
    case 5: (void)cairn_body_wake(world, id); break;
    case 6: (void)cairn_body_apply_force_at(world, id, vector(CAIRN_F(100)), any_place(CAIRN_F(4))); break;
    case 7: (void)cairn_body_apply_torque(world, id, number(CAIRN_F(-100), CAIRN_F(100))); break;
    case 8: (void)cairn_body_apply_impulse_at(world, id, vector(CAIRN_F(10)), any_place(CAIRN_F(4))); break;
    default: (void)cairn_body_apply_angular_impulse(world, id, number(CAIRN_F(-10), CAIRN_F(10))); break;
    }
}

static void change_spring(void)
{
    switch (below(4)) {
    case 0: (void)cairn_spring_destroy(world, any_spring()); break;
    case 1: (void)cairn_spring_set(world, any_spring(), length(0, CAIRN_F(3)), any_amount(), any_amount()); break;
    default: (void)any_bond(any_body(), any_body()); break;
    }
}

static cairn_real any_rate(void)
{
    static const cairn_real rates[] = { CAIRN_F(10), CAIRN_F(30), CAIRN_F(60), CAIRN_F(120), CAIRN_F(600), CAIRN_F(2000) };
    return one_in(2) ? rates[below(6)] : number(CAIRN_F(10), CAIRN_F(250));
}

/* What is mostly asked for when a world is opened, in the middle of it. */
static void enable(void)
{
    switch (below(7)) {
    case 0: (void)cairn_springs_enable(world, any.wide ? &any_many : &any_few); break;
    case 1: (void)cairn_meshes_enable(world, any.wide ? &any_large_nets : &any_nets); break;
    case 2: find_pairs_by_tree(); break;
    case 3: (void)cairn_blocks_enable(world, &any_blocks); break;
    case 4: (void)cairn_world_use_slides_solver(world, (int)below(20)); break;
    case 5: (void)cairn_world_use_small_solver(world, (int)below(20)); break;
    default: (void)cairn_sleep_enable(world); break;
    }
}

static void change_world(void)
{
    switch (below(8)) {
    case 0: (void)cairn_world_set_gravity(world, one_in(3) ? cairn_vec2_of(0, 0) : vector(one_in(6) ? CAIRN_F(2000) : CAIRN_F(20))); break;
    case 1: (void)cairn_world_set_rate(world, any_rate()); break;
    case 2: (void)cairn_world_set_substeps(world, (int)below(18)); break;
    case 3: (void)cairn_world_set_slop(world, number(0, CAIRN_F(0.02))); break;
    case 4: (void)cairn_world_set_push_out(world, number(0, CAIRN_F(10))); break;
    case 5: enable(); break;
    default: (void)(one_in(2) ? cairn_sleep_enable(world) : cairn_sleep_disable(world)); break;
    }
}

/* ---- what holds ---- */

static cairn_real size_of(cairn_real x) { return x < 0 ? -x : x; }

static void check_body(cairn_body_id id)
{
    const cairn_real limit = CAIRN_F(16384), fastest = cairn_world_speed_limit(world) + CAIRN_F(0.01);
    const cairn_vec2 center = cairn_body_center(world, id), velocity = cairn_body_velocity(world, id);
    TEST_ASSERT_TRUE(size_of(center.x) <= limit && size_of(center.y) <= limit);
    TEST_ASSERT_TRUE(size_of(velocity.x) <= fastest && size_of(velocity.y) <= fastest);
    if (!cairn_body_is_awake(world, id)) {
        TEST_ASSERT_TRUE(velocity.x == 0 && velocity.y == 0 && cairn_body_angular_velocity(world, id) == 0);
    }
}

static void check(void)
{
    int count = 0;
    cairn_body_id id = cairn_world_next_body(world, cairn_body_id_null());
    for (; !cairn_body_id_is_null(id) && count <= ANY_BODIES; id = cairn_world_next_body(world, id)) {
        check_body(id);
        count++;
    }
    const cairn_world_stats *stats = cairn_world_get_stats(world);
    TEST_ASSERT_EQUAL_INT(stats->bodies, count);
    TEST_ASSERT_TRUE(stats->arbiters <= ANY_ARBITERS && stats->springs <= ANY_SPRINGS);
}

/* ---- the play ---- */

static void run(void)
{
    for (uint32_t steps = below((uint32_t)any.longest) + 1; steps > 0; steps--) {
        TEST_ASSERT_EQUAL_INT(CAIRN_OK, cairn_world_step(world));
        check();
    }
}

static void call(void)
{
    const uint32_t choice = below(100);
    if (choice < 45) {
        run();
    } else if (choice < 57) {
        build();
    } else if (choice < 61) {
        (void)cairn_body_destroy(world, any_body());
    } else if (choice < 76) {
        change_body();
    } else if (choice < 86) {
        change_spring();
    } else if (choice < 91) {
        change_world();
    } else {
        ask();
    }
    check();
}

static uint32_t played(uint32_t seed, bool tree)
{
    choose_manner(seed);
    any.tree = tree;
    open_any_world();
    for (int k = 0; k < any.calls; k++) {
        call();
    }
    return cairn_world_hash(world);
}

/* A number that tools/cairn fuzz hands over. */
static uint32_t told(const char *name, uint32_t otherwise)
{
    const char *text = getenv(name);
    return text == NULL ? otherwise : (uint32_t)strtoul(text, NULL, 10);
}

void test_any_calls_in_any_order_leave_a_sound_world_and_always_the_same_one(void)
{
    const bool fuzzed = getenv("CAIRN_FUZZ_WORLDS") != NULL;
    const uint32_t first = told("CAIRN_FUZZ_SEED", 1), worlds = told("CAIRN_FUZZ_WORLDS", WORLDS);
    uint32_t alive = 0;
    for (uint32_t k = 0; k < worlds; k++) {
        if (fuzzed) {
            printf("world %lu\n", (unsigned long)(first + k));
            (void)fflush(stdout);
        }
        const uint32_t hash = played(first + k, true);
        const bool complete = cairn_world_get_stats(world)->dropped == 0;
        alive += cairn_world_get_stats(world)->steps > 50 && cairn_world_get_stats(world)->bodies > 3;
        TEST_ASSERT_EQUAL_HEX32(hash, played(first + k, !complete)); /* which contact is dropped is up to the order in which they are found */
    }
    TEST_ASSERT_TRUE(fuzzed || (alive > worlds / 2 && found > 0)); /* the worlds are not mostly empty */
}
