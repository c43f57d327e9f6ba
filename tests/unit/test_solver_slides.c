/* The slides' scheme: what it does right, and where it falls short of the soft solver, which is why it is the baseline. */
#include <cairn/solver.h>

# include "../support/hard_solvers.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(60), CAIRN_F(1));
static const cairn_material elastic = CAIRN_MATERIAL_BOUNCING(0, 0, 1, 0);
CAIRN_SPRINGS(coils, 2);

static void open_slides(cairn_real gravity)
{
    open_yard(gravity);
    ASSERT_OK(cairn_world_use_slides_solver(world, 10));
}

void setUp(void) { open_slides(CAIRN_F(-10)); }
void tearDown(void) {}

static void put_floor(void) { put_static(&ground, 0, CAIRN_F(-0.5)); }

/* ---- choosing it ---- */

void test_passes_outside_of_1_to_100_are_refused(void)
{
    open_yard(0);
    TEST_ASSERT_EQUAL_INT(CAIRN_ERROR_NULL, cairn_world_use_slides_solver(NULL, 10));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_use_slides_solver(world, 0));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_use_slides_solver(world, 101));
    ASSERT_REFUSED(CAIRN_ERROR_RANGE, cairn_world_use_slides_solver(world, 266));
    ASSERT_OK(cairn_world_use_slides_solver(world, 1));
    ASSERT_OK(cairn_world_use_slides_solver(world, 100));
}

void test_a_world_may_be_made_with_it(void)
{
    world = cairn_world_init_with(&yard, at(0, CAIRN_F(-10)), &cairn_solver_slides, NULL);
    TEST_ASSERT_NOT_NULL(world);
    put_floor();
    cairn_body_id id = put(&box, 0, CAIRN_F(0.5));
    run(60);
    ASSERT_NEAR(0.02, 0.5, y_of(id));
}

void test_a_game_may_change_to_it_in_the_middle(void)
{
    open_yard(CAIRN_F(-10));
    put_floor();
    cairn_body_id id = put(&box, 0, CAIRN_F(0.5)), thrown = put_moving(&ball, CAIRN_F(9), CAIRN_F(9), CAIRN_F(2), 0);
    run(30);
    ASSERT_OK(cairn_world_use_slides_solver(world, 10));
    ASSERT_NEAR_VEC2(4 * LSB, 2, -5, cairn_body_velocity(world, thrown));
    run(60);
    ASSERT_NEAR(0.02, 0.5, y_of(id));
}

/* ---- what it does right ---- */

void test_a_projectile_flies_its_parabola(void)
{
    cairn_body_id id = put_moving(&ball, 0, 0, CAIRN_F(3), CAIRN_F(7));
    run(60);
    ASSERT_NEAR_VEC2(4 * LSB, 3, 2, cairn_body_position(world, id));
}

/* It may sink in by the allowed penetration of 1 cm, and by what one step of Baumgarte leaves. */
void test_a_box_stands(void)
{
    put_floor();
    cairn_body_id id = put(&box, 0, CAIRN_F(0.5));
    run(600);
    ASSERT_NEAR(0.01, 0.49, y_of(id));
    ASSERT_NEAR(0.005, 0, x_of(id));
    ASSERT_NEAR(0.005, 0, turned(id));
}

void test_momentum_is_conserved(void)
{
    open_slides(0);
    cairn_body_id a = put_moving(&box, CAIRN_F(-2), CAIRN_F(0.3), CAIRN_F(5), 0), b = put_moving(&box, CAIRN_F(2), 0, CAIRN_F(-1), CAIRN_F(0.5));
    run(120);
    ASSERT_NEAR(8 * LSB, 4, vx_of(a) + vx_of(b));
    ASSERT_NEAR(8 * LSB, 0.5, vy_of(a) + vy_of(b));
    TEST_ASSERT_TRUE(vx_of(b) > vx_of(a)); /* and they part */
}

void test_friction_holds_below_the_kinetic_angle_and_slides_above(void)
{
    yard_def def = def_on_slope(CAIRN_DEGREES(15));
    cairn_body_id id = make(&def);
    run(120);
    ASSERT_NEAR(0.05, 0, x_of(id) - def.position.x);
    ASSERT_OK(set_material(id, &cairn_material_ice));
    run(60);
    TEST_ASSERT_TRUE(x_of(id) < def.position.x - CAIRN_F(0.3));
}

void test_overlapping_bodies_part(void)
{
    open_slides(0);
    cairn_body_id a = put(&ball, 0, 0), b = put(&ball, CAIRN_F(0.7), 0);
    run(60);
    TEST_ASSERT_TRUE(x_of(b) - x_of(a) > CAIRN_F(0.98));
}

void test_an_elastic_ball_rebounds(void)
{
    put_floor();
    yard_def def = def_at(&ball, 0, CAIRN_F(1.5));
    def.material = &elastic;
    cairn_body_id id = make(&def);
    cairn_real top = 0;
    run(30);
    for (int i = 0; i < 40; i++) {
        run(1);
        top = y_of(id) > top ? y_of(id) : top;
    }
    ASSERT_NEAR(0.01, 1.5, top);
}

void test_a_spring_sags_by_the_weight_over_the_stiffness(void) { assert_a_spring_sags_by_the_weight_over_the_stiffness(&coils); }

void test_sensors_report_and_do_not_push(void) { assert_sensors_report_and_do_not_push(); }

void test_a_ball_turns_a_flipper_by_the_law_of_angular_momentum(void) { assert_a_ball_turns_a_flipper(open_slides); }

/* ---- where it falls short ---- */

/* How far the worst box of a stack is from its place after so many steps. */
static cairn_real worst_of_stack(int boxes, int steps)
{
    cairn_body_id ids[12];
    cairn_real worst = 0;
    put_floor();
    for (int i = 0; i < boxes; i++) {
        ids[i] = put(&box, 0, CAIRN_F(0.5) + CAIRN_F(1) * i);
    }
    run(steps);
    for (int i = 0; i < boxes; i++) {
        cairn_real off = size_of(x_of(ids[i])), down = size_of(y_of(ids[i]) - CAIRN_F(0.5) - CAIRN_F(1) * i);
        worst = off > worst ? off : worst;
        worst = down > worst ? down : worst;
    }
    return worst;
}

/* The slides: "stacks fall apart". The same stack stands under the soft solver, whose four sub-steps cost less. */
void test_a_stack_of_ten_falls_that_stands_under_the_soft_solver(void)
{
    TEST_ASSERT_TRUE(worst_of_stack(10, 900) > CAIRN_F(0.5));
    open_yard(CAIRN_F(-10));
    TEST_ASSERT_TRUE(worst_of_stack(10, 900) < CAIRN_F(0.01));
}

void test_more_passes_leave_less_of_the_penetration(void)
{
    open_yard(CAIRN_F(-10));
    ASSERT_OK(cairn_world_use_slides_solver(world, 1));
    cairn_real one = worst_of_stack(3, 60);
    open_yard(CAIRN_F(-10));
    ASSERT_OK(cairn_world_use_slides_solver(world, 40));
    cairn_real forty = worst_of_stack(3, 60);
    TEST_ASSERT_TRUE(forty < CAIRN_F(0.04)); /* three contacts, a centimetre each */
    TEST_ASSERT_TRUE(one > 2 * forty);
}
