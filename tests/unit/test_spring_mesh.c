/* Meshes against statics, and what holds of any network: bounded, and no energy from nowhere. */
#define YARD_BODIES 40
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape bead = CAIRN_CIRCLE(CAIRN_F(0.125));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1)); /* 1 kg */

CAIRN_SPRINGS(coils, 80);
CAIRN_SPRING_MESHES(webs, 30, 80, 2000);

static cairn_body_id beads[YARD_BODIES];
static int bead_count;
static int32_t stiffness, damping;

static void open_empty(cairn_real gravity)
{
    open_yard(0);
    memset(coils_springs, 0, sizeof coils_springs);
    ASSERT_OK(cairn_springs_enable(world, &coils));
    ASSERT_OK(cairn_world_set_gravity(world, at(0, gravity)));
    bead_count = 0;
    stiffness = 1000;
    damping = 0;
}

void setUp(void)
{
    open_empty(CAIRN_F(-10));
    ASSERT_OK(cairn_meshes_enable(world, &webs));
}
void tearDown(void) {}

/* A bead of 1 kg that meets nothing. */
static cairn_body_id put_bead(cairn_real x, cairn_real y, bool held)
{
    yard_def def = def_at(&bead, x, y);
    def.type = held ? CAIRN_STATIC : CAIRN_DYNAMIC;
    def.density = cairn_wide_div(cairn_wide_from_int(64 * 7), cairn_wide_from_int(22)); /* pi / 64 m^2 */
    def.layer = 1;
    def.mask = 0;
    return beads[bead_count++] = make(&def);
}

static cairn_spring_id join(cairn_body_id a, cairn_body_id b)
{
    cairn_spring_def def = cairn_spring_def_default(a, b);
    def.stiffness = cairn_wide_from_int(stiffness);
    def.damping = cairn_wide_from_int(damping);
    cairn_spring_id id = cairn_spring_create(world, &def);
    TEST_ASSERT_FALSE(cairn_spring_id_is_null(id));
    return id;
}

/* Beads in rows and columns, half a metre apart, the first of each of the first `held` rows fixed; diagonals both ways if wanted. */
static void put_grid(int rows, int columns, int held, bool diagonals)
{
    for (int r = 0; r < rows; r++) {
        for (int c = 0; c < columns; c++) {
            put_bead(CAIRN_F(0.5) * c, CAIRN_F(-0.5) * r, c == 0 && r < held);
        }
    }
    for (int r = 0; r < rows; r++) {
        for (int c = 0; c < columns; c++) {
            cairn_body_id here = beads[r * columns + c];
            if (c + 1 < columns) { join(here, beads[r * columns + c + 1]); }
            if (r + 1 < rows) { join(here, beads[(r + 1) * columns + c]); }
            if (diagonals && r + 1 < rows && c + 1 < columns) { join(here, beads[(r + 1) * columns + c + 1]); }
            if (diagonals && r + 1 < rows && c > 0) { join(here, beads[(r + 1) * columns + c - 1]); }
        }
    }
}

static cairn_real farthest(void)
{
    cairn_real most = 0;
    for (int i = 0; i < bead_count; i++) {
        cairn_vec2 p = cairn_body_position(world, beads[i]);
        cairn_real sizes[4] = { p.x, -p.x, p.y, -p.y };
        for (int k = 0; k < 4; k++) {
            most = sizes[k] > most ? sizes[k] : most;
        }
    }
    return most;
}

/* ---- statics ---- */

/* One upright spring and two at 45 degrees: 2 k upwards in all. */
static void hang_on_three(void)
{
    cairn_body_id load = put_bead(0, CAIRN_F(-1), false);
    damping = 20;
    join(put_bead(CAIRN_F(-1), 0, true), load);
    join(put_bead(0, 0, true), load);
    join(put_bead(CAIRN_F(1), 0, true), load);
    run(600);
}

void test_a_load_on_three_springs_sags_by_its_weight_over_their_stiffness(void)
{
    hang_on_three();
    ASSERT_NEAR_VEC2(0.0001, 0, -1.004988, cairn_body_position(world, beads[0])); /* 0.25 % less than 10 / 2000, as they stretch */
}

/* Six nodes behind two that are held, braced both ways. The figure is that of Newton's method on the beads' forces. */
void test_a_cantilever_sags_as_statics_say(void)
{
    stiffness = 100000;
    damping = 300;
    put_grid(2, 4, 2, true);
    run(900);
    ASSERT_NEAR(0.00005, -0.007004, y_of(beads[3]));
}

void test_a_stiff_cantilever_is_as_good_as_rigid(void)
{
    stiffness = 100000000;
    put_grid(2, 4, 2, true);
    for (int i = 0; i < 300; i++) {
        run(1);
        ASSERT_NEAR(0.0005, 0, y_of(beads[3]));
    }
    TEST_ASSERT_EQUAL_UINT32(0, stats()->saturations);
}

/* Four upright springs at its corners, one from the side: it sags straight, and turns back when it was turned. */
void test_a_box_on_springs_at_its_corners_sags_and_keeps_upright(void)
{
    cairn_body_id body = put(&box, 0, 0);
    cairn_spring_def def = cairn_spring_def_default(put_bead(CAIRN_F(-3), 0, true), body);
    def.stiffness = cairn_wide_from_int(1000);
    def.damping = cairn_wide_from_int(20);
    TEST_ASSERT_FALSE(cairn_spring_id_is_null(cairn_spring_create(world, &def)));
    for (int i = 0; i < 4; i++) {
        cairn_real x = i & 1 ? CAIRN_F(0.5) : CAIRN_F(-0.5), y = i & 2 ? CAIRN_F(0.5) : CAIRN_F(-0.5);
        def.a = put_bead(x, 4 * y, true);
        def.anchor_b = at(x, y);
        TEST_ASSERT_FALSE(cairn_spring_id_is_null(cairn_spring_create(world, &def)));
    }
    ASSERT_OK(cairn_body_set_transform(world, body, at(0, 0), CAIRN_RADIANS(0.1)));
    run(1200);
    ASSERT_NEAR_VEC2(0.0002, 0, -0.0025, cairn_body_position(world, body));
    ASSERT_NEAR(0.0002, 0, turned(body));
}

void test_a_pivot_in_a_mesh_turns_and_stays_where_it_is(void)
{
    yard_def def = def_at(&box, 0, 0);
    def.fixed_position = true;
    cairn_body_id pivot = make(&def);
    for (int i = 0; i < 3; i++) {
        cairn_spring_def plan = cairn_spring_def_default(put_bead(CAIRN_F(2), CAIRN_F(0.5) * (i - 1), true), pivot);
        plan.anchor_b = at(CAIRN_F(0.5), 0);
        plan.stiffness = cairn_wide_from_int(100000);
        plan.damping = cairn_wide_from_int(1000);
        TEST_ASSERT_FALSE(cairn_spring_id_is_null(cairn_spring_create(world, &plan)));
    }
    ASSERT_OK(cairn_body_set_transform(world, pivot, at(0, 0), CAIRN_RADIANS(0.2)));
    run(300);
    ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_position(world, pivot));
    ASSERT_NEAR(0.002, 0, turned(pivot));
}

/* ---- motion ---- */

/* A stiff square, thrown spinning: its centre keeps its course, and it keeps its size. */
void test_a_thrown_mesh_keeps_its_momentum_and_shape(void)
{
    open_empty(0);
    ASSERT_OK(cairn_meshes_enable(world, &webs));
    stiffness = 1000000;
    put_grid(3, 3, 0, true);
    for (int i = 0; i < 9; i++) {
        cairn_vec2 p = cairn_body_position(world, beads[i]);
        ASSERT_OK(cairn_body_set_velocity(world, beads[i], at(CAIRN_F(1) - 2 * (p.y + CAIRN_F(0.5)), 2 * (p.x - CAIRN_F(0.5)))));
    }
    run(120);
    cairn_real x = 0, y = 0;
    for (int i = 0; i < 9; i++) {
        x += x_of(beads[i]);
        y += y_of(beads[i]);
    }
    ASSERT_NEAR(0.01, 9 * 2.5, x);
    ASSERT_NEAR(0.01, 9 * -0.5, y);
    cairn_real dx = x_of(beads[8]) - x_of(beads[0]), dy = y_of(beads[8]) - y_of(beads[0]);
    ASSERT_NEAR(0.005, 2, cairn_real_mul(dx, dx) + cairn_real_mul(dy, dy));
}

/* A ring of stiff springs, held at one bead, falls and swings: never higher than it began. */
void test_a_ring_gains_no_height(void)
{
    static const cairn_vec2 places[8] = { { CAIRN_F(1), 0 }, { CAIRN_F(0.7), CAIRN_F(0.7) }, { 0, CAIRN_F(1) }, { CAIRN_F(-0.7), CAIRN_F(0.7) },
                                          { CAIRN_F(-1), 0 }, { CAIRN_F(-0.7), CAIRN_F(-0.7) }, { 0, CAIRN_F(-1) }, { CAIRN_F(0.7), CAIRN_F(-0.7) } };
    stiffness = 100000000;
    for (int i = 0; i < 8; i++) {
        put_bead(places[i].x, places[i].y, i == 0);
    }
    for (int i = 0; i < 8; i++) {
        join(beads[i], beads[(i + 1) % 8]);
    }
    for (int i = 0; i < 600; i++) {
        run(1);
        cairn_real sum = 0;
        for (int k = 0; k < 8; k++) {
            sum += y_of(beads[k]);
        }
        TEST_ASSERT_TRUE(sum < CAIRN_F(0.01));
    }
    TEST_ASSERT_TRUE(farthest() < CAIRN_F(8));
}

/* A web hangs by one corner and folds: its rows and columns come to lie along one another. */
void test_a_web_that_folds_becomes_a_mesh(void)
{
    stiffness = 10000000;
    put_grid(4, 4, 1, false);
    run(1);
    TEST_ASSERT_EQUAL_UINT16(0, webs_mesh.part_count);
    run(300);
    TEST_ASSERT_EQUAL_UINT16(1, webs_mesh.part_count);
    TEST_ASSERT_TRUE(farthest() < CAIRN_F(3.2)); /* six springs of 0.5 m in a row, and a little */
    TEST_ASSERT_TRUE(y_of(beads[15]) < CAIRN_F(-1.6));
}

/* Springs of 1 and of 1e8 N/m in one mesh. */
void test_a_mesh_of_mixed_stiffness_stays_bounded(void)
{
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            put_bead(CAIRN_F(0.5) * i, CAIRN_F(-0.5) * k, i == 0);
        }
    }
    for (int i = 3; i < 9; i++) {
        for (int k = 0; k < i; k++) {
            stiffness = (i + k) % 3 == 0 ? 1 : (i + k) % 3 == 1 ? 10000 : 100000000;
            join(beads[k], beads[i]);
        }
    }
    run(600);
    TEST_ASSERT_TRUE(farthest() < CAIRN_F(2));
}

/* ---- without memory for it ---- */

/* The wheel that flew apart when its paths were swept in one order only. */
static void spin_a_wheel(void)
{
    static const cairn_vec2 places[8] = { { CAIRN_F(1), 0 }, { CAIRN_F(0.7), CAIRN_F(0.7) }, { 0, CAIRN_F(1) }, { CAIRN_F(-0.7), CAIRN_F(0.7) },
                                          { CAIRN_F(-1), 0 }, { CAIRN_F(-0.7), CAIRN_F(-0.7) }, { 0, CAIRN_F(-1) }, { CAIRN_F(0.7), CAIRN_F(-0.7) } };
    cairn_body_id hub = put_bead(0, 0, false);
    stiffness = 1000000;
    for (int i = 0; i < 8; i++) {
        join(hub, put_bead(places[i].x, places[i].y, i == 2));
    }
    for (int i = 0; i < 8; i++) {
        join(beads[i + 1], beads[(i + 1) % 8 + 1]);
    }
    for (int i = 0; i < 600; i++) {
        run(1);
        TEST_ASSERT_TRUE(farthest() < CAIRN_F(1.3));
    }
}

void test_a_wheel_is_bounded_with_and_without_memory_for_meshes(void)
{
    spin_a_wheel();
    open_empty(CAIRN_F(-10));
    spin_a_wheel();
}

void test_a_network_that_does_not_fit_is_solved_by_paths(void)
{
    cairn_mesh_storage small = webs;
    for (int i = 0; i < 4; i++) {
        open_empty(CAIRN_F(-10));
        small.bodies = i == 0 ? 3 : 30;
        small.springs = i == 1 ? 5 : 80;
        small.entry_count = i == 2 ? 20 : 2000;
        ASSERT_OK(cairn_meshes_enable(world, &small));
        stiffness = 10000;
        damping = 50;
        put_grid(2, 4, 2, true);
        run(300);
        TEST_ASSERT_EQUAL_UINT16(i == 3 ? 1 : 0, webs_mesh.part_count);
        TEST_ASSERT_TRUE(farthest() < CAIRN_F(2));
    }
}

void test_a_load_on_three_springs_hangs_as_well_without_memory_for_meshes(void)
{
    open_empty(CAIRN_F(-10));
    hang_on_three();
    ASSERT_NEAR_VEC2(0.001, 0, -1.005, cairn_body_position(world, beads[0]));
}

/* ---- changes ---- */

void test_a_mesh_is_made_anew_when_its_springs_change(void)
{
    stiffness = 10000;
    damping = 50;
    put_grid(2, 4, 2, true);
    put_bead(CAIRN_F(5), 0, false); /* something goes on moving */
    run(60);
    TEST_ASSERT_EQUAL_UINT16(1, webs_mesh.part_count);
    TEST_ASSERT_EQUAL_UINT16(6, webs_mesh.node_count);
    ASSERT_OK(cairn_body_destroy(world, beads[7]));
    run(1);
    TEST_ASSERT_EQUAL_UINT16(5, webs_mesh.node_count);
    for (int i = 1; i < 7; i++) {
        if (i != 4) { ASSERT_OK(cairn_body_destroy(world, beads[i])); }
    }
    run(1);
    TEST_ASSERT_EQUAL_UINT16(0, webs_mesh.part_count);
}

void test_two_meshes_in_a_world_are_solved_apart(void)
{
    stiffness = 10000;
    hang_on_three();
    cairn_body_id second = put_bead(CAIRN_F(9), CAIRN_F(-1), false);
    join(put_bead(CAIRN_F(8), 0, true), second);
    join(put_bead(CAIRN_F(9), 0, true), second);
    join(put_bead(CAIRN_F(10), 0, true), second);
    run(600);
    TEST_ASSERT_EQUAL_UINT16(2, webs_mesh.part_count);
    ASSERT_NEAR(0.0001, -1.0005, y_of(second));
    ASSERT_NEAR(0.0001, -1.0005, y_of(beads[0]));
}

/* ---- refusals ---- */

void test_enable_refuses_null_a_second_time_and_numbers_out_of_range(void)
{
    cairn_mesh_storage storage = webs;
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_meshes_enable(world, &webs));
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_meshes_enable(NULL, &webs));
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_meshes_enable(world, NULL));
    open_empty(0);
    storage.mesh = NULL;
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_meshes_enable(world, &storage));
    storage = webs;
    storage.parts = NULL;
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_meshes_enable(world, &storage));
    storage = webs;
    storage.nodes = NULL;
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_meshes_enable(world, &storage));
    storage = webs;
    storage.rows = NULL;
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_meshes_enable(world, &storage));
    storage = webs;
    storage.links = NULL;
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_meshes_enable(world, &storage));
    storage = webs;
    storage.entries = NULL;
    ASSERT_REFUSED(CAIRN_ERROR_NULL, cairn_meshes_enable(world, &storage));
    storage = webs;
    storage.bodies = 0;
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_meshes_enable(world, &storage));
    storage.bodies = 20001;
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_meshes_enable(world, &storage));
    storage = webs;
    storage.springs = 0;
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_meshes_enable(world, &storage));
    storage.springs = 65001;
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_meshes_enable(world, &storage));
    open_yard(0);
    ASSERT_REFUSED(CAIRN_ERROR_KIND, cairn_meshes_enable(world, &webs)); /* springs come first */
}
