/* A build for what does not turn, among upright boxes (upright.h). */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape crate = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1)), floor_shape = CAIRN_BOX(CAIRN_F(40), CAIRN_F(1));
static cairn_body_model upright;

void setUp(void)
{
    open_yard(CAIRN_F(-10));
    put_static(&floor_shape, 0, CAIRN_F(-0.5));
    upright = cairn_body_model_default(&crate);
    upright.fixed_rotation = true;
}
void tearDown(void) {}

void test_crates_stand_on_one_another(void)
{
    cairn_body_id ids[5];
    for (int i = 0; i < 5; i++) {
        ids[i] = cairn_body_create(world, &upright, at(CAIRN_F(0.3 * i), CAIRN_F(0.5 + i)), 0);
    }
    run(600);
    for (int i = 0; i < 5; i++) {
        ASSERT_NEAR_VEC2(0.01, 0.3 * i, 0.5 + i, cairn_body_position(world, ids[i]));
        TEST_ASSERT_TRUE(cairn_body_angle(world, ids[i]) == 0);
    }
}

void test_what_would_turn_or_leans_is_refused(void)
{
    cairn_body_model turns = cairn_body_model_default(&crate);
    ASSERT_REFUSED_ID(CAIRN_ERROR_KIND, cairn_body_create(world, &turns, at(0, CAIRN_F(3)), 0));
    ASSERT_REFUSED_ID(CAIRN_ERROR_KIND, cairn_body_create(world, &upright, at(0, CAIRN_F(3)), CAIRN_DEGREES(10)));
}
