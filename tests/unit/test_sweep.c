/* The ways that contacts take through the sweeps, and that they agree with one another. */
#include "sweep.h"

# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape sliver = CAIRN_BOX(CAIRN_F(4), CAIRN_F(0.1));
static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_shape ground = CAIRN_BOX(CAIRN_F(60), CAIRN_F(1));
/* Friction above 1 is not for the quick ways. */
static const cairn_material firm = CAIRN_MATERIAL(1, 1), rough = CAIRN_MATERIAL(1.01, 1.01), very_rough = CAIRN_MATERIAL(4, 4);

void setUp(void) { open_yard(CAIRN_F(-10)); }
void tearDown(void) {}

static void put_floor(void) { put_static(&ground, 0, CAIRN_F(-0.5)); }

static int path_at(uint16_t place) { return world->arbiters[world->order[place]].path; }
static int way_at(uint16_t place) { return path_at(place) & CAIRN_PATH_WAY; }

static cairn_body_id put_of(const cairn_shape *shape, cairn_real x, cairn_real y, int density)
{
    yard_def def = def_at(shape, x, y);
    def.density = cairn_wide_from_int(density);
    return make(&def);
}

void test_an_arbiter_takes_80_bytes(void)
{
#ifndef CAIRN_DOUBLE
    TEST_ASSERT_EQUAL_UINT32(80, sizeof(cairn_arbiter));
#endif
}

void test_what_is_static_what_is_even_and_what_is_not_have_ways_of_their_own(void)
{
    put_floor();
    put(&box, 0, CAIRN_F(0.5));
    put(&box, 0, CAIRN_F(1.5));
    put_of(&box, 0, CAIRN_F(2.5), 2);
    run(60);
    TEST_ASSERT_EQUAL_UINT16(3, world->arbiter_count);
    TEST_ASSERT_EQUAL_INT(CAIRN_PATH_ON_STATIC, way_at(0));
    TEST_ASSERT_EQUAL_INT(CAIRN_PATH_EVEN, way_at(1));
    TEST_ASSERT_EQUAL_INT(CAIRN_PATH_SHARED, way_at(2));
}

static int way_between(cairn_body_id a, cairn_body_id b)
{
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        const cairn_arbiter *arbiter = &world->arbiters[world->order[place]];
        if (arbiter->a + 1 == a.index && arbiter->b + 1 == b.index) {
            return way_at(place);
        }
    }
    return CAIRN_PATH_NONE;
}

void test_a_ball_is_pushed_through_its_centre(void)
{
    cairn_body_id floor = put_static(&ground, 0, CAIRN_F(-0.5));
    cairn_body_id low = put(&ball, 0, CAIRN_F(0.5)), high = put(&ball, 0, CAIRN_F(1.5)), heavy = put_of(&ball, 0, CAIRN_F(2.5), 2);
    cairn_body_id block = put(&box, CAIRN_F(4), CAIRN_F(0.5)), on_block = put(&ball, CAIRN_F(4.1), CAIRN_F(1.5));
    run(10);
    TEST_ASSERT_EQUAL_INT(CAIRN_PATH_CENTRAL, way_between(floor, low));
    TEST_ASSERT_EQUAL_INT(CAIRN_PATH_EVEN_CENTRAL, way_between(low, high));
    TEST_ASSERT_EQUAL_INT(CAIRN_PATH_CENTRAL, way_between(high, heavy));
    TEST_ASSERT_EQUAL_INT(CAIRN_PATH_ON_STATIC, way_between(floor, block));
    TEST_ASSERT_EQUAL_INT(CAIRN_PATH_SINGLE, way_between(block, on_block)); /* the block may turn */
}

void test_long_levers_fixed_bodies_uneven_masses_and_rough_surfaces_are_taken_with_care(void)
{
    yard_def pin = def_at(&box, CAIRN_F(8), CAIRN_F(0.499));
    pin.fixed_position = true;
    put_floor();
    cairn_body_id id = put(&box, CAIRN_F(-8), CAIRN_F(0.5));
    ASSERT_OK(set_material(id, &very_rough));
    make(&pin);
    put_of(&box, 0, CAIRN_F(0.5), 1);
    put_of(&box, 0, CAIRN_F(1.5), 40);
    run(30);
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        const cairn_arbiter *arbiter = &world->arbiters[world->order[place]];
        bool plain = arbiter->b == 3; /* the light box on the floor */
        TEST_ASSERT_EQUAL_INT(plain && !(arbiter->block & CAIRN_BLOCK_NUMBER) ? CAIRN_PATH_ON_STATIC
                              : arbiter->block & CAIRN_BLOCK_NUMBER ? CAIRN_PATH_NONE : CAIRN_PATH_CAREFUL, way_at(place));
    }
}

/* In the order of their turns, and in each of their bodies; nothing has to be swept that is in none. */
static void assert_arranged(void)
{
    uint16_t at = world->swept_ends[CAIRN_PATH_NONE];
    if (world->rearranged) {
        return; /* the next step will see to it */
    }
    for (int turn = CAIRN_PATH_CAREFUL; turn <= CAIRN_PATH_TURN; turn++) {
        for (uint16_t place = 0; place < world->arbiter_count; place++) {
            if ((path_at(place) & CAIRN_PATH_TURN) == turn) {
                TEST_ASSERT_EQUAL_UINT16(world->order[place], world->swept[at]);
                at++;
            }
        }
        TEST_ASSERT_EQUAL_UINT16(at, world->swept_ends[turn]);
    }
}

void test_contacts_are_swept_in_the_order_of_their_ways_whatever_happens(void)
{
    static const cairn_material bouncy = CAIRN_MATERIAL_BOUNCING(0.3, 0.3, 0.8, 0.5);
    int arranged = 0;
    cairn_body_id kept[8];
    put_floor();
    ASSERT_OK(cairn_sleep_enable(world));
    for (int i = 0; i < 12; i++) {
        cairn_body_id id = put(i % 3 == 0 ? &ball : &box, CAIRN_F(i % 4 * 1.1), CAIRN_F(0.5 + i / 4 * 1.2));
        ASSERT_OK(i % 5 == 0 ? set_material(id, &bouncy) : CAIRN_OK);
        kept[i % 8] = id;
    }
    for (int step = 0; step < 400; step++) {
        run(1);
        assert_arranged();
        arranged += !world->rearranged;
        if (step % 60 == 30) {
            ASSERT_OK(cairn_body_set_velocity(world, kept[step / 60], at(CAIRN_F(2), CAIRN_F(3))));
        }
        if (step == 200) {
            ASSERT_OK(cairn_body_destroy(world, kept[7]));
        }
    }
    TEST_ASSERT_GREATER_THAN(20, arranged);
}

void test_points_that_are_apart_are_known(void)
{
    open_yard(0);
    put(&ball, 0, 0);
    put(&ball, CAIRN_F(1.003), 0);
    cairn_body_id far = put(&ball, CAIRN_F(-1.003), 0);
    put(&ball, CAIRN_F(2.002), 0); /* lies in the one beside it, and so all are looked at */
    run(2);
    TEST_ASSERT_EQUAL_UINT16(3, world->arbiter_count);
    TEST_ASSERT_EQUAL_INT(CAIRN_PATH_EVEN_CENTRAL, path_at(0));
    ASSERT_NEAR(0, -1.003, x_of(far));
    ASSERT_SAME(0, world->arbiters[world->order[0]].rows[0].impulse);
}

/* Boxes of friction 1 and of little more go different ways through the sweeps, and the same one in the world. */
static cairn_vec2 thrown_onto_the_floor(const cairn_material *material)
{
    open_yard(CAIRN_F(-10));
    put_floor();
    cairn_body_id id = put_moving(&box, 0, CAIRN_F(0.5), CAIRN_F(4), 0), top = put(&box, CAIRN_F(0.1), CAIRN_F(1.5));
    ASSERT_OK(set_material(id, material));
    ASSERT_OK(set_material(top, material));
    run(120);
    return cairn_body_position(world, top);
}

void test_the_careful_way_leads_where_the_quick_one_does(void)
{
    cairn_vec2 quick = thrown_onto_the_floor(&firm), careful = thrown_onto_the_floor(&rough);
    ASSERT_NEAR(0.01, 0, quick.x - careful.x);
    ASSERT_NEAR(0.001, 0, quick.y - careful.y);
}

/* A ball rolls into another one, and that into a box: by the ways of one point, or by the careful one. */
static void roll_into_one_another(const cairn_material *material, int density, cairn_vec2 places[3])
{
    open_yard(CAIRN_F(-10));
    put_floor();
    cairn_body_id ids[3] = { put_moving(&ball, CAIRN_F(-2), CAIRN_F(0.5), CAIRN_F(3), 0), put_of(&ball, 0, CAIRN_F(0.5), density),
                             put(&box, CAIRN_F(2), CAIRN_F(0.5)) };
    for (int i = 0; i < 3; i++) {
        ASSERT_OK(set_material(ids[i], material));
    }
    run(120);
    for (int i = 0; i < 3; i++) {
        places[i] = cairn_body_position(world, ids[i]);
    }
}

void test_the_ways_of_one_point_lead_where_the_careful_one_does(void)
{
    for (int density = 1; density <= 3; density += 2) {
        cairn_vec2 quick[3], careful[3];
        roll_into_one_another(&firm, density, quick);
        roll_into_one_another(&rough, density, careful);
        TEST_ASSERT_TRUE(quick[1].x > CAIRN_F(0.1)); /* it was hit */
        for (int i = 0; i < 3; i++) {
            ASSERT_NEAR(0.02, 0, quick[i].x - careful[i].x); /* they differ by a hundredth of the friction too */
            ASSERT_NEAR(0.001, 0, quick[i].y - careful[i].y);
        }
    }
}

void test_what_is_too_fast_for_the_quick_way_stops_all_the_same(void)
{
    open_yard(0);
    cairn_body_id fast = put_moving(&box, CAIRN_F(-3), 0, CAIRN_F(40), 0), slow = put(&box, CAIRN_F(3), 0);
    run(60);
    ASSERT_NEAR(0.01, 40, vx_of(fast) + vx_of(slow));
    TEST_ASSERT_TRUE(vx_of(slow) >= vx_of(fast));
    ASSERT_NEAR(0.5, 20, vx_of(slow));
}

void test_a_sliver_on_its_end_falls_by_the_careful_way(void)
{
    put_floor();
    yard_def def = def_at(&sliver, 0, CAIRN_F(0.8));
    def.angle = CAIRN_RADIANS(0.2);
    cairn_body_id id = make(&def);
    run(240);
    ASSERT_NEAR(0.001, 0.05, y_of(id));
    ASSERT_NEAR(0.001, 0, cairn_angle_radians(cairn_body_angle(world, id)));
}

/* ---- the careful way, which is all that a build for size has, gives the quick ones' bits ---- */

static cairn_body bodies_after[YARD_BODIES];
static cairn_arbiter arbiters_after[YARD_ARBITERS];

static void assert_same_motion(cairn_motion expected, cairn_motion actual) { ASSERT_NEAR(1e-12, 0, expected - actual); }

/* Every contact by the careful way, against what a pass by the contacts' own ways has left in bodies_after and arbiters_after. */
static void assert_careful_gives_the_same(cairn_careful_pass *careful)
{
    for (uint16_t at = world->swept_ends[CAIRN_PATH_NONE]; at < world->swept_ends[CAIRN_PATH_TURN]; at++) {
        cairn_arbiter *arbiter = &world->arbiters[world->swept[at]];
        const cairn_arbiter *after = &arbiters_after[world->swept[at]];
        careful(world, arbiter, false);
        for (int i = 0; i < arbiter->count; i++) {
            assert_same_motion(after->rows[i].impulse, arbiter->rows[i].impulse);
        }
        assert_same_motion(after->friction_impulse, arbiter->friction_impulse);
    }
    for (uint16_t i = 0; i < world->body_end; i++) {
        assert_same_motion(bodies_after[i].vx, world->bodies[i].vx);
        assert_same_motion(bodies_after[i].vy, world->bodies[i].vy);
        assert_same_motion(bodies_after[i].w, world->bodies[i].w);
    }
}

static void restore(void)
{
    memcpy(bodies_after, world->bodies, sizeof bodies_after);
    memcpy(arbiters_after, world->arbiters, sizeof arbiters_after);
    memcpy(world->bodies, bodies_before, sizeof bodies_before);
    memcpy(world->arbiters, arbiters_before, sizeof arbiters_before);
}

static void assert_ways_agree(void)
{
    cairn_sweep_choose_again(world); /* some are to be made anew */
    cairn_sweep_arrange(world);
    keep_yard();
    cairn_sweep_warm_start(world);
    restore();
    assert_careful_gives_the_same(cairn_careful_warm_start);
    keep_yard();
    cairn_sweep_biased(world, 0);
    restore();
    assert_careful_gives_the_same(cairn_careful_biased_pass);
    keep_yard();
    cairn_sweep_relax(world, 0);
    restore();
    assert_careful_gives_the_same(cairn_careful_relax_pass);
}

void test_the_careful_way_gives_the_quick_ones_bits(void)
{
    unsigned ways = 0;
    put_floor();
    for (int i = 0; i < 4; i++) {
        put_of(&box, CAIRN_F(0.1 * i), CAIRN_F(0.5 + 1.01 * i), 1 + i / 2);
        put_of(&ball, CAIRN_F(3), CAIRN_F(0.5 + 1.01 * i), 1 + i / 2);
        put_moving(&ball, CAIRN_F(-2 - i), CAIRN_F(0.6), CAIRN_F(2), 0);
    }
    put(&box, CAIRN_F(-8), CAIRN_F(0.5));
    put(&ball, CAIRN_F(-8.1), CAIRN_F(1.5));
    for (int step = 0; step < 90; step++) {
        run(1);
        for (uint16_t place = 0; place < world->arbiter_count; place++) {
            ways |= 1u << way_at(place);
        }
        keep_yard();
        cairn_world world_then = world_before;
        static cairn_body bodies_then[YARD_BODIES];
        static cairn_arbiter arbiters_then[YARD_ARBITERS];
        memcpy(bodies_then, bodies_before, sizeof bodies_then);
        memcpy(arbiters_then, arbiters_before, sizeof arbiters_then);
        assert_ways_agree();
        *world = world_then;
        memcpy(world->bodies, bodies_then, sizeof bodies_then);
        memcpy(world->arbiters, arbiters_then, sizeof arbiters_then);
    }
    for (unsigned way = CAIRN_PATH_ON_STATIC; way <= CAIRN_PATH_EVEN; way++) {
        TEST_ASSERT_TRUE(ways & 1u << way);
    }
    TEST_ASSERT_TRUE(ways & 1u << CAIRN_PATH_EVEN_CENTRAL);
}
