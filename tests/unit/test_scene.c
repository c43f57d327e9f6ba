/* Scene tables: what they build, and what each error says. */
# include "../../examples/scene/scene.c" /* the example's own code; it is no part of the library */
# include "../support/yard.h"

CAIRN_SPRINGS(coils, 2);
CAIRN_QUADTREE(tree, 16, 16, 64);

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(20), CAIRN_F(1));
static const cairn_shape *const shapes[] = { &ball, &ground };
static cairn_material materials[2];
static cairn_body_model models[3];
static cairn_scene_body bodies[3];
static cairn_scene_spring springs[2];
static cairn_scene scene;
static cairn_scene_storage storage;
static cairn_body_id ids[3];
static cairn_spring_id spring_ids[2];

/* A floor, and two balls joined by a spring. */
void setUp(void)
{
    memset(bodies, 0, sizeof bodies);
    memset(springs, 0, sizeof springs);
    memset(&scene, 0, sizeof scene);
    memset(coils_springs, 0, sizeof coils_springs);
    materials[0] = cairn_material_default;
    materials[1] = cairn_material_jelly;
    for (int i = 0; i < 3; i++) {
        models[i] = cairn_body_model_default(&ball);
        models[i].material = &materials[0];
        bodies[i].model = (uint16_t)i;
        bodies[i].position = at(CAIRN_F(2) * i, CAIRN_F(0.5));
    }
    models[0].shape = &ground;
    models[0].type = CAIRN_STATIC;
    bodies[0].position = at(0, CAIRN_F(-0.5));
    bodies[2].velocity = at(CAIRN_F(0.5), 0);
    bodies[2].angular_velocity = CAIRN_F(-1);
    bodies[2].angle = CAIRN_DEGREES(90);
    models[2].material = &materials[1];
    springs[0].a = 1;
    springs[0].b = 2;
    springs[0].rest_length = CAIRN_F(-1);
    springs[0].stiffness = cairn_wide_from_int(10);
    springs[0].damping = cairn_wide_from_int(1);
    scene.name = "test";
    scene.gravity = at(0, CAIRN_F(-10));
    scene.rate = CAIRN_F(60);
    scene.substeps = 4;
    scene.passes = 10;
    scene.material_count = 2;
    scene.shape_count = 2;
    scene.model_count = 3;
    scene.body_count = 3;
    scene.spring_count = 1;
    scene.materials = materials;
    scene.shapes = shapes;
    scene.models = models;
    scene.bodies = bodies;
    scene.springs = springs;
    storage.world = &yard;
    storage.springs = &coils;
    storage.tree = &tree;
}
void tearDown(void) {}

static void build(void)
{
    cairn_status error;
    int place;
    world = cairn_scene_build(&scene, &storage, ids, spring_ids, &error, &place);
    TEST_ASSERT_NOT_NULL(world);
    TEST_ASSERT_EQUAL_INT(CAIRN_OK, error);
}

static void assert_refused(cairn_status status, int at_place)
{
    cairn_status error = CAIRN_OK;
    int place = 77;
    TEST_ASSERT_NULL(cairn_scene_build(&scene, &storage, ids, spring_ids, &error, &place));
    TEST_ASSERT_EQUAL_INT(status, error);
    TEST_ASSERT_EQUAL_INT(at_place, place);
}

void test_a_scene_builds_its_bodies_and_springs_in_the_order_of_its_tables(void)
{
    build();
    TEST_ASSERT_EQUAL_UINT16(3, stats()->bodies);
    TEST_ASSERT_EQUAL_UINT16(1, stats()->springs);
    TEST_ASSERT_EQUAL_INT(CAIRN_STATIC, cairn_body_get_type(world, ids[0]));
    TEST_ASSERT_EQUAL_PTR(&ball, cairn_body_shape(world, ids[1]));
    ASSERT_NEAR_VEC2(0, 4, 0.5, cairn_body_position(world, ids[2]));
    ASSERT_NEAR_VEC2(LSB, 0.5, 0, cairn_body_velocity(world, ids[2]));
    ASSERT_NEAR(LSB, -1, spin_of(ids[2]));
    TEST_ASSERT_TRUE(cairn_body_angle(world, ids[2]) == CAIRN_DEGREES(90));
    ASSERT_NEAR(LSB, 2, cairn_spring_length(world, spring_ids[0]));
    run(60);
    ASSERT_NEAR(0.001, 0.5, y_of(ids[1]));
}

void test_ids_may_be_left_out(void)
{
    cairn_status error;
    int place;
    world = cairn_scene_build(&scene, &storage, NULL, NULL, &error, &place);
    TEST_ASSERT_NOT_NULL(world);
    TEST_ASSERT_EQUAL_UINT16(3, stats()->bodies);
}

void test_a_scene_chooses_solver_broad_phase_and_sleep(void)
{
    scene.solver = CAIRN_SCENE_SLIDES;
    scene.broad = CAIRN_SCENE_QUADTREE;
    scene.sleep = true;
    bodies[2].velocity = at(0, 0);
    bodies[2].angular_velocity = 0;
    scene.spring_count = 0;
    build();
    run(240);
    TEST_ASSERT_FALSE(cairn_body_is_awake(world, ids[1]));
    TEST_ASSERT_TRUE(stats()->tree_cells > 0);
    ASSERT_NEAR(0.02, 0.5, y_of(ids[1]));
}

void test_a_scene_chooses_the_small_solver_and_its_passes(void)
{
    scene.solver = CAIRN_SCENE_SMALL;
    scene.passes = 7;
    scene.substeps = 1;
    build();
    TEST_ASSERT_EQUAL_PTR(&cairn_solver_small, world->solver);
    TEST_ASSERT_EQUAL_UINT8(7, world->passes);
    scene.substeps = 4; /* are the soft solver's */
    build();
    TEST_ASSERT_EQUAL_UINT8(1, world->substeps);
}

void test_a_spring_may_be_given_by_its_frequency(void)
{
    springs[0].frequency = CAIRN_F(2);
    springs[0].damping_ratio = CAIRN_F(0.5);
    build();
    run(10);
}

void test_kinds_of_bodies_come_through(void)
{
    models[1].sensor = true;
    models[1].fixed_rotation = true;
    models[2].fixed_position = true;
    build();
    TEST_ASSERT_TRUE(cairn_body_is_sensor(world, ids[1]));
    run(30);
    ASSERT_NEAR_VEC2(0, 4, 0.5, cairn_body_position(world, ids[2]));
}

/* ---- errors: what and where ---- */

void test_bad_gravity_is_refused(void)
{
    scene.gravity = at(0, CAIRN_F(-3000));
    assert_refused(CAIRN_ERROR_RANGE, -1);
}

void test_missing_world_storage_is_refused(void)
{
    storage.world = NULL;
    assert_refused(CAIRN_ERROR_NULL, -1);
}

void test_bad_settings_are_refused(void)
{
    scene.rate = CAIRN_F(5);
    assert_refused(CAIRN_ERROR_RANGE, -1);
    scene.rate = CAIRN_F(60);
    scene.substeps = 17;
    assert_refused(CAIRN_ERROR_RANGE, -1);
    scene.substeps = 4;
    scene.solver = CAIRN_SCENE_SLIDES;
    scene.passes = 0;
    assert_refused(CAIRN_ERROR_RANGE, -1);
    scene.solver = CAIRN_SCENE_SMALL;
    assert_refused(CAIRN_ERROR_RANGE, -1);
}

void test_a_quadtree_without_memory_is_refused(void)
{
    scene.broad = CAIRN_SCENE_QUADTREE;
    storage.tree = NULL;
    assert_refused(CAIRN_ERROR_NULL, -1);
}

void test_springs_without_memory_are_refused(void)
{
    storage.springs = NULL;
    assert_refused(CAIRN_ERROR_NULL, -1);
    scene.spring_count = 0;
    build();
}

void test_the_first_bad_body_is_named(void)
{
    models[1].density = cairn_wide_from_int(0);
    assert_refused(CAIRN_ERROR_RANGE, 1);
    models[1].density = cairn_wide_from_int(1);
    materials[1].kinetic_friction = CAIRN_FACTOR(9);
    assert_refused(CAIRN_ERROR_RANGE, 2);
}

void test_the_first_bad_spring_is_named_behind_the_bodies(void)
{
    springs[0].b = 1;
    assert_refused(CAIRN_ERROR_RANGE, 3);
    springs[0].b = 0;
    springs[0].frequency = CAIRN_F(2000);
    assert_refused(CAIRN_ERROR_RANGE, 3);
}

void test_a_spring_that_names_no_body_is_refused(void)
{
    springs[0].b = 3;
    assert_refused(CAIRN_ERROR_STALE, 3);
    springs[0].b = 60000;
    assert_refused(CAIRN_ERROR_STALE, 3);
}

void test_more_bodies_than_the_world_holds_are_refused(void)
{
    cairn_world_storage small = yard;
    small.body_capacity = 2;
    storage.world = &small;
    assert_refused(CAIRN_ERROR_FULL, 2);
}

void test_more_springs_than_the_pool_holds_are_refused(void)
{
    cairn_spring_storage small = coils;
    small.capacity = 1;
    storage.springs = &small;
    springs[1] = springs[0];
    scene.spring_count = 2;
    assert_refused(CAIRN_ERROR_FULL, 4);
}
