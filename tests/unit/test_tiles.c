/* What slides over surfaces side by side does not run into the corners between them, and still into what stands in its way. */
#define YARD_BODIES 48
#define YARD_ARBITERS 64
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape tile = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape crate = CAIRN_BOX(CAIRN_F(0.8), CAIRN_F(0.8));
static const cairn_shape marble = CAIRN_CIRCLE(CAIRN_F(0.3));
static const cairn_material ice = CAIRN_MATERIAL(0.0, 0.0);

void setUp(void)
{
    open_yard(CAIRN_F(-10));
    for (int i = 0; i < 40; i++) {
        put_static(&tile, i * CAIRN_F(1), CAIRN_F(-0.5));
    }
}

void tearDown(void) {}

static cairn_body_id slide(const cairn_shape *shape, cairn_real height, cairn_real speed, cairn_real spin)
{
    yard_def def = def_at(shape, CAIRN_F(1.2), height);
    def.velocity.x = speed;
    def.angular_velocity = spin;
    def.material = spin == 0 ? &ice : &cairn_material_default;
    return make(&def);
}

static void assert_goes_on(cairn_body_id id, cairn_real height, cairn_real speed, int steps)
{
    for (int i = 0; i < steps; i++) {
        run(1);
        ASSERT_NEAR(0.002, 0, vx_of(id) - speed);
        ASSERT_NEAR(0.005, 0, vy_of(id));
        ASSERT_NEAR(0.001, 0, y_of(id) - height);
    }
}

void test_a_slow_crate_slides_over_the_joints_of_a_floor(void)
{
    assert_goes_on(slide(&crate, CAIRN_F(0.4), CAIRN_F(0.1), 0), CAIRN_F(0.4), CAIRN_F(0.1), 600);
}

void test_a_crate_slides_over_the_joints_of_a_floor(void)
{
    assert_goes_on(slide(&crate, CAIRN_F(0.4), CAIRN_F(2), 0), CAIRN_F(0.4), CAIRN_F(2), 300);
}

void test_a_fast_crate_slides_over_the_joints_of_a_floor(void)
{
    assert_goes_on(slide(&crate, CAIRN_F(0.4), CAIRN_F(40), 0), CAIRN_F(0.4), CAIRN_F(40), 55);
}

void test_a_ball_rolls_over_the_joints_of_a_floor(void)
{
    assert_goes_on(slide(&marble, CAIRN_F(0.3), CAIRN_F(3), CAIRN_F(-10)), CAIRN_F(0.3), CAIRN_F(3), 300);
}

void test_a_fast_ball_rolls_over_the_joints_of_a_floor(void)
{
    assert_goes_on(slide(&marble, CAIRN_F(0.3), CAIRN_F(30), CAIRN_F(-100)), CAIRN_F(0.3), CAIRN_F(30), 70);
}

void test_a_crate_falls_along_the_joints_of_a_wall(void)
{
    for (int i = 0; i < 7; i++) {
        put_static(&tile, CAIRN_F(3), i * CAIRN_F(1) + CAIRN_F(0.5));
    }
    cairn_body_id id = put(&crate, CAIRN_F(3.9), CAIRN_F(7));
    run(60); /* 5 m and half a step's more */
    ASSERT_NEAR(0.001, 3.9, x_of(id));
    ASSERT_NEAR(0.001, 2, y_of(id));
    ASSERT_NEAR(0.0001, -10, vy_of(id));
}

/* As the player of a platform game, who holds the stick towards the wall. */
static cairn_body_id hold_against_wall(cairn_real y, cairn_real vy, int steps)
{
    static const cairn_shape player = CAIRN_BOX(CAIRN_F(0.6), CAIRN_F(1));
    for (int i = 0; i < 7; i++) {
        put_static(&tile, CAIRN_F(5), i * CAIRN_F(1) + CAIRN_F(0.5));
    }
    yard_def def = def_at(&player, CAIRN_F(4.2), y);
    def.fixed_rotation = true;
    def.material = &ice;
    def.velocity.y = vy;
    cairn_body_id id = make(&def);
    for (int i = 0; i < steps; i++) {
        ASSERT_OK(cairn_body_set_velocity(world, id, at(CAIRN_F(3), vy_of(id))));
        run(1);
        ASSERT_NEAR(0.001, 4.2, x_of(id));
    }
    return id;
}

void test_a_player_held_against_a_wall_of_tiles_falls_freely(void)
{
    cairn_body_id id = hold_against_wall(CAIRN_F(6), 0, 48);
    ASSERT_NEAR(0.02, 2.8, y_of(id));
    ASSERT_NEAR(0.001, -8, vy_of(id));
}

void test_a_player_held_against_a_wall_of_tiles_jumps_freely(void)
{
    cairn_body_id id = hold_against_wall(CAIRN_F(0.5), CAIRN_F(9), 54);
    ASSERT_NEAR(0.05, 4.55, y_of(id));
    ASSERT_NEAR(0.001, 0, vy_of(id));
}

/* It comes down on a joint, with the stick still held: nothing there holds it. */
void test_a_player_that_lands_on_a_joint_runs_on(void)
{
    static const cairn_shape player = CAIRN_BOX(CAIRN_F(0.6), CAIRN_F(0.9));
    for (int k = 0; k < 12; k++) {
        yard_def def = def_at(&player, CAIRN_F(8) + k * CAIRN_F(0.02), CAIRN_F(1.2) + k * CAIRN_F(0.01));
        def.fixed_rotation = true;
        def.material = &ice;
        def.velocity.y = CAIRN_F(-5);
        cairn_body_id id = make(&def);
        cairn_real from = x_of(id);
        for (int i = 0; i < 60; i++) {
            ASSERT_OK(cairn_body_set_velocity(world, id, at(CAIRN_F(3), vy_of(id))));
            run(1);
        }
        ASSERT_NEAR(0.06, 3, x_of(id) - from);
        ASSERT_OK(cairn_body_destroy(world, id));
    }
}

void test_a_crate_lands_beyond_a_joint_as_on_one_floor(void)
{
    yard_def def = def_at(&crate, CAIRN_F(1.05), CAIRN_F(0.45));
    def.velocity = cairn_vec2_of(CAIRN_F(3), CAIRN_F(-1.5));
    def.material = &ice;
    cairn_body_id id = make(&def);
    run(30);
    ASSERT_NEAR(0.002, 3, vx_of(id));
    ASSERT_NEAR(0.002, 0, spin_of(id));
}

/* It comes down just beyond a joint: the corner there is nearly as near. */
void test_a_ball_bounces_off_a_joint_as_off_one_floor(void)
{
    static const cairn_material rubber = CAIRN_MATERIAL_BOUNCING(0.0, 0.0, 0.9, 0.0);
    for (int i = 0; i < 8; i++) {
        yard_def def = def_at(&marble, CAIRN_F(3.36) + i * CAIRN_F(0.02), CAIRN_F(0.5));
        def.velocity = cairn_vec2_of(CAIRN_F(3), CAIRN_F(-4));
        def.material = &rubber;
        cairn_body_id id = make(&def);
        run(6);
        TEST_ASSERT_TRUE(vy_of(id) > CAIRN_F(3));
        ASSERT_NEAR(0.001, 3, vx_of(id));
        ASSERT_OK(cairn_body_destroy(world, id));
    }
}

/* A step of 1 cm is no joint. */
void test_a_crate_does_not_slide_over_a_step(void)
{
    put_static(&tile, CAIRN_F(5), CAIRN_F(-0.49));
    cairn_body_id id = slide(&crate, CAIRN_F(0.4), CAIRN_F(0.5), 0);
    run(600);
    TEST_ASSERT_TRUE(x_of(id) < CAIRN_F(4.12));
}

void test_a_ball_bumps_over_a_step(void)
{
    put_static(&tile, CAIRN_F(5), CAIRN_F(-0.49));
    cairn_body_id id = slide(&marble, CAIRN_F(0.3), CAIRN_F(3), CAIRN_F(-10));
    cairn_real highest = 0;
    for (int i = 0; i < 120; i++) {
        run(1);
        highest = y_of(id) > highest ? y_of(id) : highest;
    }
    TEST_ASSERT_TRUE(highest > CAIRN_F(0.3095));
}
