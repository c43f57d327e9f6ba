/* Restitution: Newton's law u+ = -e u- at the moment of the impact, for falls, pairs, chains, pivots and spinning balls. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(60), CAIRN_F(1));
static const cairn_shape beam = CAIRN_BOX(CAIRN_F(2), CAIRN_F(0.2));

/* without friction, so that spin plays no part */
static const cairn_material dead = CAIRN_MATERIAL_BOUNCING(0, 0, 0, 0);
static const cairn_material half = CAIRN_MATERIAL_BOUNCING(0, 0, 0.5, 0);
static const cairn_material elastic = CAIRN_MATERIAL_BOUNCING(0, 0, 1, 0);
static const cairn_material grippy = CAIRN_MATERIAL_BOUNCING(0.2, 0.2, 1, 0);
static const cairn_material sticky = CAIRN_MATERIAL_BOUNCING(10, 10, 0.5, 0);

static const cairn_material bouncing_rough = CAIRN_MATERIAL_BOUNCING(0.5, 0.5, 0.5, 0);

void setUp(void) { open_yard(CAIRN_F(-10)); }
void tearDown(void) {}

static cairn_body_id put_of(const cairn_shape *shape, const cairn_material *material, cairn_real x, cairn_real y)
{
    yard_def def = def_at(shape, x, y);
    def.material = material;
    return make(&def);
}

static cairn_body_id drop(const cairn_shape *shape, const cairn_material *material, cairn_real height)
{
    put_static(&ground, 0, CAIRN_F(-0.5));
    return put_of(shape, material, 0, height + CAIRN_F(0.5));
}

/* The highest place of a ball's underside after its next bounces, read from its energy so that steps do not matter. */
static cairn_real apex(cairn_body_id id, int bounces)
{
    int seen = 0;
    for (int i = 0; i < 2400 && seen < bounces; i++) {
        bool falls = vy_of(id) < 0;
        run(1);
        seen += falls && vy_of(id) > 0;
    }
    TEST_ASSERT_EQUAL_INT(bounces, seen);
    cairn_real v = vy_of(id);
    return y_of(id) - CAIRN_F(0.5) + cairn_real_mul(v, v) / 20;
}

/* ---- falls ---- */

void test_without_restitution_a_ball_stays_where_it_falls(void)
{
    cairn_body_id id = drop(&ball, &dead, CAIRN_F(1));
    run(60);
    cairn_real lowest = CAIRN_F(1), highest = 0;
    for (int i = 0; i < 60; i++) {
        run(1);
        lowest = y_of(id) < lowest ? y_of(id) : lowest;
        highest = y_of(id) > highest ? y_of(id) : highest;
    }
    ASSERT_NEAR(0.001, 0.5, lowest);
    ASSERT_NEAR(0.001, 0.5, highest);
}

/* e^2 h, to a tenth of a per cent */
void test_with_half_the_restitution_a_ball_rises_to_a_quarter(void)
{
    ASSERT_NEAR(0.001 * 0.25, 0.25, apex(drop(&ball, &half, CAIRN_F(1)), 1));
    open_yard(CAIRN_F(-10));
    ASSERT_NEAR(0.001 * 1.5, 1.5, apex(drop(&ball, &half, CAIRN_F(6)), 1));
}

void test_each_bounce_takes_its_share_again(void)
{
    ASSERT_NEAR(0.002 * 0.375, 0.375, apex(drop(&ball, &half, CAIRN_F(6)), 2));
}

void test_an_elastic_ball_rises_to_where_it_fell_from(void)
{
    ASSERT_NEAR(0.001, 1, apex(drop(&ball, &elastic, CAIRN_F(1)), 1));
}

void test_an_elastic_ball_keeps_its_height_over_many_bounces(void)
{
    ASSERT_NEAR(0.001, 1, apex(drop(&ball, &elastic, CAIRN_F(1)), 30));
}

/* Where in a step the impact falls makes no difference, to a tenth of a millimetre: heights all through a step's way. */
void test_the_moment_of_the_impact_within_the_step_does_not_matter(void)
{
    for (int i = 0; i < 24; i++) {
        open_yard(CAIRN_F(-10));
        cairn_body_id id = drop(&ball, &elastic, CAIRN_F(1) + CAIRN_F(0.00311) * i);
        cairn_real height = apex(id, 1);
        ASSERT_NEAR(0.0001, 0, height - CAIRN_F(1) - CAIRN_F(0.00311) * i);
        open_yard(CAIRN_F(-10));
        height = apex(drop(&ball, &half, CAIRN_F(1) + CAIRN_F(0.00311) * i), 1);
        ASSERT_NEAR(0.0001, 0, 4 * height - CAIRN_F(1) - CAIRN_F(0.00311) * i);
    }
}

void test_bounces_are_the_same_for_any_number_of_substeps(void)
{
    for (int substeps = 1; substeps <= 16; substeps++) {
        open_yard(CAIRN_F(-10));
        ASSERT_OK(cairn_world_set_substeps(world, substeps));
        ASSERT_NEAR(0.001, 1, apex(drop(&ball, &elastic, CAIRN_F(1)), 2));
    }
}

void test_a_flat_box_bounces_flat(void)
{
    cairn_body_id id = drop(&box, &elastic, CAIRN_F(1));
    ASSERT_NEAR(0.001, 1, apex(id, 5));
    ASSERT_NEAR(0.0001, 0, spin_of(id));
    ASSERT_NEAR(0.0001, 0, turned(id));
    ASSERT_NEAR(0.0001, 0, x_of(id));
}

/* A smaller and smaller bounce, then rest: with a threshold of 0 too. */
void test_a_bouncing_ball_comes_to_rest(void)
{
    cairn_body_id id = drop(&ball, &half, CAIRN_F(1));
    run(240);
    ASSERT_NEAR(0.0005, 0.5, y_of(id));
    cairn_real rested = y_of(id);
    for (int i = 0; i < 240; i++) {
        run(1);
        ASSERT_NEAR(LSB, 0, vy_of(id));
        ASSERT_NEAR(LSB, 0, y_of(id) - rested);
    }
}

void test_a_kinematic_bat_gives_its_speed_to_the_ball(void)
{
    open_yard(0);
    yard_def def = def_at(&box, CAIRN_F(-2), 0);
    def.type = CAIRN_KINEMATIC;
    def.velocity.x = CAIRN_F(3);
    make(&def);
    cairn_body_id id = put_of(&ball, &half, 0, 0);
    run(60);
    ASSERT_NEAR(0.001 * 4.5, 4.5, vx_of(id)); /* (1 + e) u */
}

/* ---- two bodies ---- */

/* m1 u = m1 v1 + m2 v2 and v2 - v1 = e u, for a mass ratio of R to 1 and u = 1. */
static void assert_impact(int heavy, const cairn_material *material, cairn_real v1, cairn_real v2, cairn_real within_1, cairn_real within_2)
{
    open_yard(0);
    yard_def def = def_at(&ball, CAIRN_F(-2), 0);
    def.material = material;
    def.density = cairn_wide_from_int(heavy);
    def.velocity.x = CAIRN_F(4);
    cairn_body_id first = make(&def);
    cairn_body_id second = put_of(&ball, material, 0, 0);
    run(60);
    TEST_ASSERT_TRUE(size_of(vx_of(first) - v1) <= within_1);
    TEST_ASSERT_TRUE(size_of(vx_of(second) - v2) <= within_2);
}

/* (R - 1) / (R + 1) and 2 R / (R + 1), times 4 m/s; within 0.1 % of the speed of approach */
#define ASSERT_ELASTIC_IMPACT(R) \
    assert_impact(R, &elastic, CAIRN_F(4 * ((R) - 1.0) / ((R) + 1.0)), CAIRN_F(4 * 2.0 * (R) / ((R) + 1.0)), CAIRN_F(0.004), CAIRN_F(0.004))

void test_equal_balls_exchange_their_velocities(void) { ASSERT_ELASTIC_IMPACT(1); }

void test_impacts_of_unequal_balls_keep_momentum_and_energy(void)
{
    ASSERT_ELASTIC_IMPACT(2);
    ASSERT_ELASTIC_IMPACT(10);
    ASSERT_ELASTIC_IMPACT(100);
    ASSERT_ELASTIC_IMPACT(1000);
}

/* (R - e) / (R + 1) and (1 + e) R / (R + 1) */
void test_half_elastic_impacts_lose_what_newton_says(void)
{
    assert_impact(1, &half, CAIRN_F(1), CAIRN_F(3), CAIRN_F(0.004), CAIRN_F(0.004));
    assert_impact(9, &half, CAIRN_F(3.4), CAIRN_F(5.4), CAIRN_F(0.004), CAIRN_F(0.004));
    assert_impact(999, &half, CAIRN_F(3.994), CAIRN_F(5.994), CAIRN_F(0.004), CAIRN_F(0.004));
}

/* 30 degrees off the line of centres: the part along it is exchanged, the part across it kept. */
void test_an_oblique_impact_exchanges_only_what_lies_along_the_normal(void)
{
    open_yard(0);
    cairn_body_id still = put_of(&ball, &elastic, 0, 0);
    yard_def def = def_at(&ball, CAIRN_F(-0.8660254 - 1.01), CAIRN_F(0.5)); /* they meet half a metre off centre: sin = 0.5 */
    def.material = &elastic;
    def.velocity.x = CAIRN_F(2);
    cairn_body_id moving = make(&def);
    run(60);
    /* the contact is found a step's way before the impact: the normal is within 1.2 degrees of 30 */
    ASSERT_NEAR_VEC2(0.05, 2 * 0.75, -2 * 0.4330127, cairn_body_velocity(world, still));
    cairn_vec2 a = cairn_body_velocity(world, still), b = cairn_body_velocity(world, moving);
    ASSERT_NEAR(0.004, 2, a.x + b.x);
    ASSERT_NEAR(0.004, 0, a.y + b.y);
    ASSERT_NEAR(0.004, 4, cairn_real_mul(a.x, a.x) + cairn_real_mul(a.y, a.y) + cairn_real_mul(b.x, b.x) + cairn_real_mul(b.y, b.y));
}

/* ---- chains ---- */

/* Five balls in a row that touch are met by so many at 3 m/s, with this gap; as many leave at the other end. */
static void assert_cradle(int coming, cairn_real gap)
{
    cairn_body_id ids[7];
    open_yard(0);
    for (int i = 0; i < 5 + coming; i++) {
        yard_def def = def_at(&ball, i < 5 ? CAIRN_F(1) * i : CAIRN_F(-1) * (i - 4) - gap, 0);
        def.material = &elastic;
        def.velocity.x = i < 5 ? 0 : CAIRN_F(3);
        ids[i] = make(&def);
    }
    run(60);
    for (int i = 0; i < 5 + coming; i++) {
        bool leaves = i < 5 && i >= 5 - coming;
        ASSERT_NEAR(0.003, 0, vx_of(ids[i]) - (leaves ? CAIRN_F(3) : 0));
        if (i < 5 - coming) {
            ASSERT_NEAR(0.001, 0, x_of(ids[i]) - CAIRN_F(1) * i); /* the others stay where they hung */
        }
    }
}

/* The gaps let the first impact fall at the end of a sub-step, after its middle, and at its start. */
void test_newtons_cradle_passes_the_momentum_to_the_last_ball(void)
{
    assert_cradle(1, CAIRN_F(1.3));
    assert_cradle(1, CAIRN_F(1.307));
    assert_cradle(1, CAIRN_F(1.3001));
}

void test_two_balls_come_and_two_go(void)
{
    assert_cradle(2, CAIRN_F(1.3));
    assert_cradle(2, CAIRN_F(1.307));
    assert_cradle(2, CAIRN_F(1.3001));
}

/* ---- levers ---- */

/*
 * A ball hits a beam at rest, 0.8 m from its pivot: J = (1 + e) u / (1/m + r^2 / I). With m = pi / 4 and
 * I = 0.4 * 4.04 / 12, e = 1 and u = 2: J = 0.663816.
 */
void test_a_ball_bounces_off_a_pivot_as_off_the_mass_it_feels(void)
{
    open_yard(0);
    yard_def def = def_at(&beam, 0, 0);
    def.fixed_position = true;
    def.material = &elastic;
    cairn_body_id pivot = make(&def);
    def = def_at(&ball, CAIRN_F(0.8), CAIRN_F(0.7));
    def.material = &elastic;
    def.velocity.y = CAIRN_F(-2);
    cairn_body_id id = make(&def);
    run(4);
    ASSERT_NEAR(0.004, -2 + 0.663816 / 0.785398, vy_of(id));
    ASSERT_NEAR(0.012, -0.8 * 0.663816 / 0.134667, spin_of(pivot)); /* 0.3 % */
    ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_position(world, pivot));
}

/* The same with the beam free: its mass counts as well, J = 2 u / (1/m + 1/M + r^2 / I). */
void test_a_ball_bounces_off_the_end_of_a_free_beam(void)
{
    open_yard(0);
    cairn_body_id free_beam = put_of(&beam, &elastic, 0, 0);
    yard_def def = def_at(&ball, CAIRN_F(0.8), CAIRN_F(0.7));
    def.material = &elastic;
    def.velocity.y = CAIRN_F(-2);
    cairn_body_id id = make(&def);
    run(4);
    /* J = 4 / (1.273240 + 2.5 + 4.752475) = 0.469167 */
    ASSERT_NEAR(0.004, -2 + 0.469167 / 0.785398, vy_of(id));
    ASSERT_NEAR(0.004, -0.469167 / 0.4, vy_of(free_beam));
    ASSERT_NEAR(0.009, -0.8 * 0.469167 / 0.134667, spin_of(free_beam)); /* 0.3 % */
}

/* A level box lands with its left half on the corner of a post: elastic and without friction, it keeps its energy and spins. */
void test_a_box_that_hits_off_its_centre_spins(void)
{
    open_yard(0);
    put_static(&box, CAIRN_F(-1), 0);
    yard_def def = def_at(&box, CAIRN_F(-0.25), CAIRN_F(1.2));
    def.velocity.y = CAIRN_F(-1);
    def.material = &elastic;
    cairn_body_id id = make(&def);
    run(30);
    cairn_vec2 v = cairn_body_velocity(world, id);
    cairn_real w = spin_of(id);
    ASSERT_NEAR(0.004, 1, cairn_real_mul(v.x, v.x) + cairn_real_mul(v.y, v.y) + cairn_real_mul(w, w) / 6);
    TEST_ASSERT_TRUE(w < CAIRN_F(-0.5));
}

/*
 * A tilted box comes down on one corner, to the left or to the right: J = 2 u / (1/m + l^2 / I), with l the corner's
 * distance aside. At 20 degrees l = 0.5 (cos - sin) = 0.298836 and J = 1.302283 u: the one corner is the first point of
 * the contact, the other one the second.
 */
void test_a_tilted_box_bounces_off_either_corner_alike(void)
{
    for (int side = 0; side < 2; side++) {
        open_yard(0);
        put_static(&ground, 0, CAIRN_F(-0.5));
        yard_def def = def_at(&box, 0, CAIRN_F(0.7));
        def.angle = side == 0 ? CAIRN_DEGREES(20) : CAIRN_DEGREES(-20);
        def.material = &elastic;
        def.velocity.y = CAIRN_F(-3);
        cairn_body_id id = make(&def);
        run(2); /* it has 0.06 m to go: 1.2 steps */
        ASSERT_NEAR(0.001 * 3, -3 + 3 * 1.302283, vy_of(id));
        ASSERT_NEAR(0.003 * 7, 0, size_of(spin_of(id)) - CAIRN_F(3 * 1.302283 * 0.298836 * 6));
        TEST_ASSERT_EQUAL_INT(side == 0, spin_of(id) < 0);
    }
}

/* Nearly flat and spinning: one point leaves while the other one hits, and none of the impulses pulls. */
void test_a_spinning_box_that_lands_nearly_flat_gains_no_energy(void)
{
    for (int i = -4; i <= 4; i++) {
        open_yard(0);
        put_static(&ground, 0, CAIRN_F(-0.5));
        yard_def def = def_at(&box, 0, CAIRN_F(0.53));
        def.angular_velocity = CAIRN_F(1.1) * i;
        def.material = &elastic;
        def.velocity.y = CAIRN_F(-2);
        cairn_body_id id = make(&def);
        run(30);
        cairn_vec2 v = cairn_body_velocity(world, id);
        cairn_real w = spin_of(id), before = CAIRN_F(4) + cairn_real_mul(CAIRN_F(1.1) * i, CAIRN_F(1.1) * i) / 6;
        ASSERT_NEAR(0.02, 0, cairn_real_mul(v.x, v.x) + cairn_real_mul(v.y, v.y) + cairn_real_mul(w, w) / 6 - before);
        TEST_ASSERT_TRUE(y_of(id) > CAIRN_F(0.49));
    }
}

/* As off a pivot, with the pivot second in the pair. */
void test_a_ball_bounces_off_a_pivot_that_was_made_later(void)
{
    open_yard(0);
    yard_def def = def_at(&ball, CAIRN_F(0.8), CAIRN_F(0.7));
    def.material = &elastic;
    def.velocity.y = CAIRN_F(-2);
    cairn_body_id id = make(&def);
    def = def_at(&beam, 0, 0);
    def.fixed_position = true;
    def.material = &elastic;
    cairn_body_id pivot = make(&def);
    run(4);
    ASSERT_NEAR(0.004, -2 + 0.663816 / 0.785398, vy_of(id));
    ASSERT_NEAR(0.012, -0.8 * 0.663816 / 0.134667, spin_of(pivot));
    ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_position(world, pivot));
}

/* ---- friction of an impact ---- */

/* A ball without spin at 45 degrees: while it slips, friction takes mu (1 + e) u of its speed along the floor. */
void test_a_slipping_impact_takes_friction_times_the_normal_impulse(void)
{
    open_yard(0);
    yard_def def = def_at(&ground, 0, CAIRN_F(-0.5));
    def.type = CAIRN_STATIC;
    def.material = &grippy;
    make(&def);
    def = def_at(&ball, 0, CAIRN_F(1.013));
    def.material = &grippy;
    def.velocity = at(CAIRN_F(3), CAIRN_F(-2));
    cairn_body_id id = make(&def);
    run(60);
    /* J = 4 m: 0.2 * 4 = 0.8 off the speed, 0.8 m r / I = 3.2 of spin */
    ASSERT_NEAR_VEC2(0.003, 2.2, 2, cairn_body_velocity(world, id));
    ASSERT_NEAR(0.003 * 2, -3.2, spin_of(id));
}

/* A spinning ball meets one at rest head on: friction takes as much spin from the one as it gives to the other. */
/* What is round looks the same however it turns. */
void test_smooth_balls_that_spin_rebound_as_if_they_did_not(void)
{
    cairn_vec2 velocities[2];
    for (int spins = 0; spins < 2; spins++) {
        open_yard(0);
        yard_def def = def_at(&ball, 0, 0);
        def.material = &elastic;
        def.velocity = at(CAIRN_F(6), 0);
        def.angular_velocity = spins ? CAIRN_F(30) : 0;
        make(&def);
        def.position = at(CAIRN_F(2), CAIRN_F(0.6));
        def.velocity = at(CAIRN_F(-2), 0);
        cairn_body_id other = make(&def);
        run(30);
        velocities[spins] = cairn_body_velocity(world, other);
    }
    TEST_ASSERT_TRUE(velocities[0].x > CAIRN_F(1));
    TEST_ASSERT_TRUE(velocities[1].x == velocities[0].x && velocities[1].y == velocities[0].y);
}

/* Each has its own threshold: what is asked for one pair is not another one's. */
void test_balls_of_two_thresholds_keep_to_their_own(void)
{
    static const cairn_material lively = CAIRN_MATERIAL_BOUNCING(0, 0, 1, 0.2), lazy = CAIRN_MATERIAL_BOUNCING(0, 0, 1, 3);
    static const cairn_material floor_of = CAIRN_MATERIAL(0, 0);
    cairn_body_id ids[4];
    yard_def def = def_at(&ground, 0, CAIRN_F(-0.5));
    def.type = CAIRN_STATIC;
    def.material = &floor_of;
    make(&def);
    for (int i = 0; i < 4; i++) {
        ids[i] = put_of(&ball, i & 1 ? &lazy : &lively, CAIRN_F(2) * i, CAIRN_F(0.7)); /* falls 0.2 m: 2 m/s */
    }
    run(120);
    for (int i = 0; i < 4; i++) {
        cairn_real v = vy_of(ids[i]), top = y_of(ids[i]) - CAIRN_F(0.5) + cairn_real_mul(v, v) / 20;
        ASSERT_NEAR(0.005, i & 1 ? 0 : 0.2, top);
    }
}

void test_friction_between_two_balls_turns_both_alike(void)
{
    open_yard(0);
    yard_def def = def_at(&ball, CAIRN_F(-1.513), 0);
    def.material = &grippy;
    def.velocity.x = CAIRN_F(2);
    def.angular_velocity = CAIRN_F(6);
    cairn_body_id first = make(&def), second = put_of(&ball, &grippy, 0, 0);
    run(30);
    ASSERT_NEAR(0.002, 6, spin_of(first) - spin_of(second));
    /* J = 2 m, 0.2 J of it by friction: 0.4 m r / I = 1.6 */
    ASSERT_NEAR(0.01, -1.6, spin_of(second));
    ASSERT_NEAR(0.002, 2, vx_of(first) + vx_of(second));
    ASSERT_NEAR(0.002, 0, vy_of(first) + vy_of(second));
}

/* With friction enough it leaves rolling: v = 2/3 u along the floor. */
void test_a_gripping_impact_leaves_the_ball_rolling(void)
{
    open_yard(0);
    yard_def def = def_at(&ground, 0, CAIRN_F(-0.5));
    def.type = CAIRN_STATIC;
    def.material = &sticky;
    make(&def);
    def = def_at(&ball, 0, CAIRN_F(1.013));
    def.material = &sticky;
    def.velocity = at(CAIRN_F(3), CAIRN_F(-2));
    cairn_body_id id = make(&def);
    run(60);
    ASSERT_NEAR_VEC2(0.003, 2, 1, cairn_body_velocity(world, id));
    ASSERT_NEAR(0.006, -4, spin_of(id));
}

/* ---- momentum ---- */

/* A hexagon and a box meet off centre, both spinning, with friction: what one loses, the other gets. */
static void assert_free_collision(const cairn_material *material)
{
    static const cairn_shape plank = CAIRN_BOX(CAIRN_F(1), CAIRN_F(0.5));
    open_yard(0);
    yard_def def = def_at(&plank, CAIRN_F(-1.5), CAIRN_F(0.2));
    def.material = material;
    def.velocity = at(CAIRN_F(3), CAIRN_F(0.5));
    def.angular_velocity = CAIRN_F(4);
    cairn_body_id first = make(&def);
    def = def_at(&box, CAIRN_F(1.5), CAIRN_F(-0.2));
    def.material = material;
    def.angle = CAIRN_DEGREES(30);
    def.velocity = at(CAIRN_F(-2), 0);
    def.angular_velocity = CAIRN_F(-3);
    cairn_body_id second = make(&def);
    run(60);
    /* m = 0.5 and 1, I = 0.5 1.25 / 12 and 1 / 6 */
    ASSERT_NEAR(0.0002, 0.5 * 3 - 2, vx_of(first) / 2 + vx_of(second));
    ASSERT_NEAR(0.0002, 0.5 * 0.5, vy_of(first) / 2 + vy_of(second));
    cairn_vec2 p = cairn_body_center(world, first), q = cairn_body_center(world, second);
    cairn_real orbit = (cairn_real_mul(p.x, vy_of(first)) - cairn_real_mul(p.y, vx_of(first))) / 2
                     + cairn_real_mul(q.x, vy_of(second)) - cairn_real_mul(q.y, vx_of(second));
    cairn_real spin = cairn_real_mul(CAIRN_F(0.5 * 1.25 / 12), spin_of(first)) + spin_of(second) / 6;
    cairn_real before = CAIRN_F(0.5 * (-1.5 * 0.5 - 0.2 * 3) - 0.2 * 2 + 4 * 0.5 * 1.25 / 12 - 3.0 / 6);
    ASSERT_NEAR(0.0006, 0, orbit + spin - before); /* 1e-4 of the sum of its parts */
}

void test_a_free_collision_keeps_momentum_and_angular_momentum(void)
{
    static const cairn_material dull = CAIRN_MATERIAL_BOUNCING(0.4, 0.4, 0, 0);
    assert_free_collision(&grippy);
    assert_free_collision(&sticky);
    assert_free_collision(&dull);
}

/* A heavy ball, 1e4 times the mass, is hit 64 times from one side: it gets what the light ones lose, to 0.1 %. */
void test_a_heavy_body_feels_each_of_many_light_blows(void)
{
    open_yard(0);
    yard_def def = def_at(&ball, 0, 0);
    def.material = &elastic;
    def.density = cairn_wide_from_int(10000);
    cairn_body_id heavy = make(&def);
    for (int i = 0; i < 64; i++) {
        cairn_body_id light = put_of(&ball, &elastic, CAIRN_F(-1.02) + x_of(heavy), y_of(heavy));
        ASSERT_OK(cairn_body_set_velocity(world, light, at(CAIRN_F(5), 0)));
        run(2);
        TEST_ASSERT_TRUE(vx_of(light) < CAIRN_F(-4.8));
        ASSERT_OK(cairn_body_destroy(world, light));
    }
    ASSERT_NEAR(0.001 * 0.063592, 0.063592, vx_of(heavy)); /* 5 (1 - (1 - 2 / 10001)^64) */
}

/* ---- rest ---- */

/* Piles of what bounces rest as others do. */
void test_a_stack_of_bouncing_boxes_comes_to_rest(void)
{
    cairn_body_id ids[5];
    put_static(&ground, 0, CAIRN_F(-0.5));
    for (int i = 0; i < 5; i++) {
        ids[i] = put_of(&box, &bouncing_rough, 0, CAIRN_F(0.52) + CAIRN_F(1.02) * i);
    }
    run(600);
    for (int i = 0; i < 5; i++) {
        ASSERT_NEAR(0.005, 0.5 + i, y_of(ids[i]));
        ASSERT_NEAR(0.002, 0, x_of(ids[i]));
        ASSERT_NEAR(LSB, 0, vy_of(ids[i]));
        ASSERT_NEAR(LSB, 0, spin_of(ids[i]));
    }
}

/* A spinning square falls on its corners: nothing of it goes through the floor, it gains no energy and comes to rest. */
void test_a_spinning_box_bounces_and_comes_to_rest(void)
{
    put_static(&ground, 0, CAIRN_F(-0.5));
    yard_def def = def_at(&box, 0, CAIRN_F(2));
    def.material = &bouncing_rough;
    def.angular_velocity = CAIRN_F(30);
    cairn_body_id id = make(&def);
    cairn_real highest = CAIRN_F(2 * 10 + 900.0 / 12);
    for (int i = 0; i < 900; i++) {
        run(1);
        cairn_vec2 v = cairn_body_velocity(world, id);
        cairn_real w = spin_of(id);
        cairn_real energy = (cairn_real_mul(v.x, v.x) + cairn_real_mul(v.y, v.y)) / 2 + cairn_real_mul(w, w) / 12 + 10 * y_of(id);
        TEST_ASSERT_TRUE(energy <= highest + CAIRN_F(0.02));
        TEST_ASSERT_TRUE(y_of(id) > CAIRN_F(0.48));
    }
    ASSERT_NEAR(0.01, 0, vy_of(id));
    ASSERT_NEAR(0.02, 0, spin_of(id));
}

/* ---- many ---- */

/* Twelve elastic balls in a box, without gravity: the energy stays within a thousandth for five seconds. */
void test_elastic_balls_in_a_box_keep_their_energy(void)
{
    static const cairn_shape wall = CAIRN_BOX(CAIRN_F(1), CAIRN_F(12));
    cairn_body_id ids[12];
    open_yard(0);
    put_static(&wall, CAIRN_F(-5.5), 0);
    put_static(&wall, CAIRN_F(5.5), 0);
    put_static(&ground, 0, CAIRN_F(-5.5));
    put_static(&ground, 0, CAIRN_F(5.5));
    for (int i = 0; i < 12; i++) {
        yard_def def = def_at(&ball, CAIRN_F(2.5) * (i % 4) - CAIRN_F(3.7), CAIRN_F(2.5) * (i / 4) - CAIRN_F(2.6));
        def.material = &elastic;
        def.velocity = at(CAIRN_F(1) * (i % 5 - 2), CAIRN_F(0.7) * (i % 3 - 1));
        ids[i] = make(&def);
    }
    cairn_real first = 0, last = 0;
    for (int i = 0; i < 12; i++) {
        cairn_vec2 v = cairn_body_velocity(world, ids[i]);
        first += cairn_real_mul(v.x, v.x) + cairn_real_mul(v.y, v.y);
    }
    run(300);
    for (int i = 0; i < 12; i++) {
        cairn_vec2 v = cairn_body_velocity(world, ids[i]), x = cairn_body_position(world, ids[i]);
        last += cairn_real_mul(v.x, v.x) + cairn_real_mul(v.y, v.y);
        TEST_ASSERT_TRUE(size_of(x.x) < CAIRN_F(4.51) && size_of(x.y) < CAIRN_F(4.51));
    }
    TEST_ASSERT_TRUE(size_of(last - first) <= first / 1000);
}
