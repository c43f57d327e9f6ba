/*
 * Any calls in any order with any numbers: nothing undefined (the sanitizers' builds look), nothing beyond its limits, no body lost, and the
 * same calls give the same world. Pools are small, so that they are full most of the time. Ids are live, stale or never made.
 */
# include "../support/arith_random.h" /* the space keeps it out of the generated runner, which lies elsewhere */

#include <cairn/cairn.h>
#include <unity.h>

enum {
    WORLDS = 400,
    CALLS = 250,
    BODIES = 12,
    ARBITERS = 24,
    SPRINGS = 8,
    POLYGONS = 6,
    MODELS = 32,
    IDS = 32 /* more than ever live */
};

CAIRN_WORLD(yard, BODIES, ARBITERS);
CAIRN_SPRINGS(coils, SPRINGS);
CAIRN_SPRING_MESHES(nets, 6, SPRINGS, 60);
CAIRN_QUADTREE(tree, BODIES, 9, 40);
CAIRN_BLOCKS(blocks);

static cairn_world *world;
static arith_random r;
static cairn_shape shapes[8];
static cairn_polygon polygons[POLYGONS];
static int polygon_count;
static cairn_material materials[6];
static cairn_body_model models[MODELS];
static cairn_body_id ids[IDS];
static cairn_spring_id spring_ids[IDS];

void setUp(void) {}
void tearDown(void) {}

/* ---- arguments ---- */

static uint32_t below(uint32_t count) { return arith_random_bits(&r) % count; }
static bool one_in(uint32_t count) { return below(count) == 0; }
static cairn_real between(cairn_real low, cairn_real high) { return low + (cairn_real)below((uint32_t)(high - low) + 1); }
/* What a game would say, and now and then what none should. */
static cairn_real number(cairn_real low, cairn_real high) { return one_in(12) ? arith_random_argument(&r) : between(low, high); }
static cairn_vec2 vector(cairn_real size) { return cairn_vec2_of(number(-size, size), number(-size, size)); }
static cairn_angle angle(void) { return (cairn_angle)arith_random_bits(&r); }
static cairn_body_id any_body(void) { return ids[below(IDS)]; }
static cairn_spring_id any_spring(void) { return spring_ids[below(IDS)]; }
static const cairn_body_model *any_model(void) { return one_in(40) ? NULL : &models[below(MODELS)]; }

static cairn_wide stiffness(void)
{
    cairn_wide x = cairn_wide_of((int32_t)(arith_random_bits(&r) >> below(31)) & 0x7FFFFFFF, one_in(20) ? 20 : -16);
    return x;
}

static void make_shapes(void)
{
    const cairn_shape circle = CAIRN_CIRCLE(0), box = CAIRN_BOX(0, 0);
    for (int k = 0; k < 8; k++) {
        shapes[k] = k < 4 ? circle : box;
        shapes[k].size = cairn_vec2_of(number(CAIRN_F(0.05), CAIRN_F(1.5)), k < 4 ? 0 : number(CAIRN_F(0.05), CAIRN_F(4)));
    }
    polygon_count = 0;
    for (int k = 0; k < POLYGONS; k++) {
        cairn_vec2 points[2 * CAIRN_MAX_VERTICES];
        const int count = (int)below(2 * CAIRN_MAX_VERTICES + 1);
        for (int i = 0; i < count; i++) {
            points[i] = vector(CAIRN_F(1));
        }
        polygon_count += cairn_polygon_init_hull(&polygons[polygon_count], points, count) == CAIRN_OK;
    }
}

static void make_models(void)
{
    const cairn_body_model ground = CAIRN_BODY_MODEL(CAIRN_STATIC, &shapes[0], &cairn_material_default);
    for (int k = 0; k < 6; k++) {
        cairn_material *m = &materials[k];
        m->static_friction = cairn_factor_from_real(between(0, CAIRN_F(1)));
        m->kinetic_friction = one_in(2) ? m->static_friction : cairn_factor_from_real(between(0, CAIRN_F(1)));
        m->restitution = one_in(2) ? 0 : cairn_factor_from_real(between(0, CAIRN_F(1)));
        m->threshold = one_in(2) ? 0 : number(0, CAIRN_F(2));
        m->bounce = one_in(3) ? NULL : &cairn_bounce;
    }
    for (int k = 0; k < MODELS; k++) {
        cairn_body_model *m = &models[k];
        *m = ground;
        m->type = one_in(4) ? CAIRN_STATIC : one_in(5) ? CAIRN_KINEMATIC : CAIRN_DYNAMIC;
        m->shape = polygon_count > 0 && one_in(3) ? &polygons[below((uint32_t)polygon_count)].shape : &shapes[below(8)];
        m->material = &materials[below(6)];
        m->density = one_in(3) ? stiffness() : cairn_wide_from_real(between(CAIRN_F(0.1), CAIRN_F(5)));
        m->gravity_scale = one_in(4) ? number(CAIRN_F(-2), CAIRN_F(2)) : CAIRN_F(1);
        m->damping = one_in(4) ? number(0, CAIRN_F(3)) : 0;
        m->angular_damping = one_in(4) ? number(0, CAIRN_F(3)) : 0;
        m->layer = one_in(6) ? (uint16_t)arith_random_bits(&r) : 1;
        m->mask = one_in(6) ? (uint16_t)arith_random_bits(&r) : 0xFFFF;
        m->sensor = one_in(8);
        m->fixed_rotation = one_in(8);
        m->fixed_position = one_in(8);
    }
}

/* ---- what is asked ---- */

static int found;

static bool on_body(void *context, cairn_body_id id)
{
    (void)context;
    found++;
    TEST_ASSERT_TRUE(cairn_body_exists(world, id));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_LOCKED, cairn_body_destroy(world, id));
    return !one_in(4);
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
    const cairn_vec2 one = vector(CAIRN_F(5)), other = vector(CAIRN_F(5));
    const uint16_t mask = (uint16_t)arith_random_bits(&r);
    int cursor = 0;
    switch (below(10)) {
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
    default: (void)cairn_spring_length(world, any_spring()); break;
    }
}

/* ---- what is changed ---- */

static void change_body(void)
{
    const cairn_body_id id = any_body();
    switch (below(9)) {
    case 0: (void)cairn_body_set_transform(world, id, vector(CAIRN_F(4)), angle()); break;
    case 1: (void)cairn_body_set_velocity(world, id, vector(CAIRN_F(20))); break;
    case 2: (void)cairn_body_set_angular_velocity(world, id, number(CAIRN_F(-30), CAIRN_F(30))); break;
    case 3: (void)cairn_body_set_model(world, id, any_model()); break;
    case 4: (void)cairn_body_wake(world, id); break;
    case 5: (void)cairn_body_apply_force_at(world, id, vector(CAIRN_F(100)), vector(CAIRN_F(4))); break;
    case 6: (void)cairn_body_apply_torque(world, id, number(CAIRN_F(-100), CAIRN_F(100))); break;
    case 7: (void)cairn_body_apply_impulse_at(world, id, vector(CAIRN_F(10)), vector(CAIRN_F(4))); break;
    default: (void)cairn_body_apply_angular_impulse(world, id, number(CAIRN_F(-10), CAIRN_F(10))); break;
    }
}

static void change_spring(void)
{
    cairn_spring_def def = cairn_spring_def_default(any_body(), any_body());
    switch (below(4)) {
    case 0: (void)cairn_spring_destroy(world, any_spring()); break;
    case 1: (void)cairn_spring_set(world, any_spring(), number(0, CAIRN_F(3)), stiffness(), stiffness()); break;
    default:
        def.anchor_a = vector(CAIRN_F(1));
        def.anchor_b = vector(CAIRN_F(1));
        def.rest_length = number(CAIRN_F(-1), CAIRN_F(3));
        def.stiffness = stiffness();
        def.damping = stiffness();
        def.no_contact = one_in(2);
        if (one_in(2)) {
            (void)cairn_spring_tune(world, &def, number(0, CAIRN_F(30)), number(0, CAIRN_F(1)));
        }
        spring_ids[below(IDS)] = cairn_spring_create(world, &def);
        break;
    }
}

static void change_world(void)
{
    switch (below(6)) {
    case 0: (void)cairn_world_set_gravity(world, vector(CAIRN_F(20))); break;
    case 1: (void)cairn_world_set_rate(world, number(CAIRN_F(10), CAIRN_F(250))); break;
    case 2: (void)cairn_world_set_substeps(world, (int)below(18)); break;
    case 3: (void)cairn_world_set_slop(world, number(0, CAIRN_F(0.02))); break;
    case 4: (void)cairn_world_set_push_out(world, number(0, CAIRN_F(10))); break;
    default: (void)(one_in(2) ? cairn_sleep_enable(world) : cairn_sleep_disable(world)); break;
    }
}

static void create(void)
{
    cairn_body_id id = cairn_body_create(world, any_model(), vector(CAIRN_F(3)), angle());
    if (!cairn_body_id_is_null(id)) {
        ids[below(IDS)] = id; /* whoever was here is known to the world alone from now on */
    }
}

static void call(void)
{
    const uint32_t choice = below(100);
    if (choice < 40) {
        (void)cairn_world_step(world);
    } else if (choice < 55) {
        create();
    } else if (choice < 60) {
        (void)cairn_body_destroy(world, any_body());
    } else if (choice < 75) {
        change_body();
    } else if (choice < 85) {
        change_spring();
    } else if (choice < 90) {
        change_world();
    } else {
        ask();
    }
}

/* ---- what holds ---- */

static cairn_real size_of(cairn_real x) { return x < 0 ? -x : x; }

static void check(void)
{
    int count = 0;
    const cairn_real limit = CAIRN_F(16384);
    cairn_body_id id = cairn_world_next_body(world, cairn_body_id_null());
    for (; !cairn_body_id_is_null(id) && count <= BODIES; id = cairn_world_next_body(world, id)) {
        const cairn_vec2 center = cairn_body_center(world, id), velocity = cairn_body_velocity(world, id);
        const cairn_real fastest = cairn_world_speed_limit(world) + CAIRN_F(0.01);
        TEST_ASSERT_TRUE(size_of(center.x) <= limit && size_of(center.y) <= limit);
        TEST_ASSERT_TRUE(size_of(velocity.x) <= fastest && size_of(velocity.y) <= fastest);
        count++;
    }
    TEST_ASSERT_TRUE(count <= BODIES);
    const cairn_world_stats *stats = cairn_world_get_stats(world);
    TEST_ASSERT_TRUE(stats->arbiters <= ARBITERS && stats->awake <= count + BODIES && stats->springs <= SPRINGS);
}

static void open_world(uint32_t seed)
{
    r = arith_random_seeded(seed);
    make_shapes();
    make_models();
    world = cairn_world_init_with(&yard, cairn_vec2_of(0, CAIRN_F(-10)), &cairn_solver_soft, one_in(4) ? NULL : &cairn_continuous);
    for (int k = 0; k < IDS; k++) {
        ids[k].index = (uint16_t)below(BODIES + 3);
        ids[k].generation = (uint16_t)below(3);
        spring_ids[k].index = (uint16_t)below(SPRINGS + 3);
        spring_ids[k].generation = (uint16_t)below(3);
    }
    if (!one_in(4)) {
        (void)cairn_springs_enable(world, &coils);
    }
    if (one_in(2)) {
        (void)cairn_meshes_enable(world, &nets);
    }
    if (one_in(2)) {
        (void)cairn_quadtree_enable(world, &tree, vector(CAIRN_F(3)), (int)below(8), (int)below(8));
    }
    if (one_in(2)) {
        (void)cairn_blocks_enable(world, &blocks);
    }
    if (one_in(6)) {
        (void)cairn_world_use_slides_solver(world, (int)below(20));
    }
}

static uint32_t played(uint32_t seed)
{
    open_world(seed);
    for (int k = 0; k < CALLS; k++) {
        call();
        check();
    }
    return cairn_world_hash(world);
}

void test_any_calls_in_any_order_leave_a_sound_world_and_always_the_same_one(void)
{
    int alive = 0;
    for (uint32_t seed = 1; seed <= WORLDS; seed++) {
        const uint32_t hash = played(seed);
        TEST_ASSERT_EQUAL_HEX32(hash, played(seed));
        alive += cairn_world_get_stats(world)->steps > 50 && cairn_world_get_stats(world)->bodies > 3;
    }
    TEST_ASSERT_TRUE(alive > WORLDS / 2); /* the worlds are not mostly empty */
    TEST_ASSERT_TRUE(found > 0);
}
