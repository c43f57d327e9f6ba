/* A locked world: from inside a visitor nothing may be changed, and everything may be asked. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape peg = CAIRN_CIRCLE(CAIRN_F(0.1));
CAIRN_SPRINGS(coils, 2);
CAIRN_SPRINGS(more_coils, 2);
CAIRN_QUADTREE(tree, 16, 16, 64);
CAIRN_BLOCKS(blocks);

static cairn_body_id body, other;
static cairn_spring_id spring;
static int visits;

void setUp(void)
{
    open_yard(0);
    memset(coils_springs, 0, sizeof coils_springs);
    body = put(&ball, 0, 0);
    other = put_static(&peg, CAIRN_F(5), 0);
    visits = 0;
}
void tearDown(void) {}

/* Let `inside` run once, in a visitor of a query at the origin. */
static void lock(bool (*inside)(void *context, cairn_body_id id))
{
    ASSERT_OK(cairn_query_point(world, at(0, 0), 0xFFFF, inside, NULL));
    TEST_ASSERT_EQUAL_INT(1, visits);
}

static void join(void)
{
    ASSERT_OK(cairn_springs_enable(world, &coils));
    cairn_spring_def def = cairn_spring_def_default(body, other);
    spring = cairn_spring_create(world, &def);
    TEST_ASSERT_TRUE(cairn_spring_exists(world, spring));
}

static bool change_the_world(void *context, cairn_body_id id)
{
    (void)context;
    (void)id;
    visits++;
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_world_step(world));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_world_set_gravity(world, at(0, 0)));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_world_set_rate(world, CAIRN_F(50)));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_world_set_substeps(world, 2));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_world_set_slop(world, CAIRN_F(0.01)));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_world_set_push_out(world, CAIRN_F(1)));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_world_use_slides_solver(world, 10));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_sleep_enable(world));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_sleep_disable(world));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_springs_enable(world, &more_coils));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_quadtree_enable(world, &tree, at(0, 0), 6, 6));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_blocks_enable(world, &blocks));
    return true;
}

void test_the_settings_of_a_locked_world_stay(void) { lock(change_the_world); }

static bool change_a_body(void *context, cairn_body_id id)
{
    yard_def def = def_at(&ball, 0, 0);
    (void)context;
    visits++;
    TEST_ASSERT_TRUE(same(id, body));
    ASSERT_REFUSED_ID(CAIRN_ERROR_LOCKED, make_in(world, &def));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_body_destroy(world, id));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_body_set_transform(world, id, at(1, 1), 0));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_body_set_velocity(world, id, at(1, 1)));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_body_set_angular_velocity(world, id, 1));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, set_material(id, &cairn_material_ice));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_body_wake(world, id));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_body_apply_force(world, id, at(1, 1)));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_body_apply_force_at(world, id, at(1, 1), at(0, 0)));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_body_apply_torque(world, id, 1));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_body_apply_impulse(world, id, at(1, 1)));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_body_apply_impulse_at(world, id, at(1, 1), at(0, 0)));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_body_apply_angular_impulse(world, id, 1));
    return true;
}

void test_the_bodies_of_a_locked_world_stay(void) { lock(change_a_body); }

static bool change_a_spring(void *context, cairn_body_id id)
{
    cairn_spring_def def = cairn_spring_def_default(body, other);
    cairn_spring before[2];
    (void)context;
    (void)id;
    visits++;
    memcpy(before, coils_springs, sizeof before);
    ASSERT_REFUSED_ID(CAIRN_ERROR_LOCKED, cairn_spring_create(world, &def));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_spring_destroy(world, spring));
    ASSERT_REFUSED(CAIRN_ERROR_LOCKED, cairn_spring_set(world, spring, 0, cairn_wide_from_int(1), cairn_wide_from_int(1)));
    TEST_ASSERT_EQUAL_MEMORY(before, coils_springs, sizeof before);
    return true;
}

void test_the_springs_of_a_locked_world_stay(void)
{
    join();
    lock(change_a_spring);
}

static bool ask(void *context, cairn_body_id id)
{
    cairn_ray_hit hit;
    (void)context;
    visits++;
    ASSERT_SAME(0, cairn_body_position(world, id).x);
    TEST_ASSERT_TRUE(cairn_body_exists(world, other));
    ASSERT_NEAR(LSB, 5, cairn_spring_length(world, spring));
    ASSERT_OK(cairn_query_ray(world, at(CAIRN_F(-3), 0), at(CAIRN_F(3), 0), 0xFFFF, &hit));
    TEST_ASSERT_TRUE(same(hit.body, body));
    TEST_ASSERT_EQUAL_INT(CAIRN_OK, cairn_world_error(world));
    return true;
}

void test_a_locked_world_answers(void)
{
    join();
    lock(ask);
}

void test_the_lock_ends_with_the_query(void)
{
    lock(change_the_world);
    ASSERT_OK(cairn_world_step(world));
    ASSERT_OK(cairn_body_destroy(world, body));
}
