/* What holds under either solver without sub-steps (solver.h), in a world that `open` makes with it. */
#ifndef HARD_SOLVERS_H
#define HARD_SOLVERS_H

#include "yard.h"

/* A box of 1 m that lies on a static slope, which is made. */
static inline yard_def def_on_slope(cairn_angle angle)
{
    static const cairn_shape ground = CAIRN_BOX(CAIRN_F(60), CAIRN_F(1)), box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
    cairn_unit c, s;
    cairn_angle_rotation(angle, &c, &s);
    yard_def slope = def_at(&ground, 0, 0), def = def_at(&box, -cairn_real_from_unit(s), cairn_real_from_unit(c));
    slope.type = CAIRN_STATIC;
    slope.angle = def.angle = angle;
    make(&slope);
    return def;
}

static inline void assert_sensors_report_and_do_not_push(void)
{
    static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5)), box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
    yard_def def = def_at(&box, 0, CAIRN_F(-2));
    def.type = CAIRN_STATIC;
    def.sensor = true;
    cairn_body_id sensor = make(&def), id = put(&ball, 0, 0);
    run(40);
    TEST_ASSERT_TRUE(are_touching(sensor, id));
    run(20);
    ASSERT_NEAR(2 * LSB, -5, y_of(id));
}

/* (as in test_body.c) m u r = (I + m r^2) w */
static inline void assert_a_ball_turns_a_flipper(void (*open)(cairn_real gravity))
{
    static const cairn_shape beam = CAIRN_BOX(CAIRN_F(2), CAIRN_F(0.2)), marble = CAIRN_CIRCLE(CAIRN_F(0.1));
    static const cairn_material smooth = CAIRN_MATERIAL(0, 0);
    for (int pivot_is_second = 0; pivot_is_second < 2; pivot_is_second++) {
        open(0);
        yard_def flipper = def_at(&beam, 0, 0), ball = def_at(&marble, CAIRN_F(0.8), CAIRN_F(0.199)); /* 1 mm deep already: within the allowed penetration */
        flipper.fixed_position = true;
        flipper.material = ball.material = &smooth;
        ball.velocity = at(0, CAIRN_F(-2));
        cairn_body_id first = make(pivot_is_second ? &ball : &flipper), second = make(pivot_is_second ? &flipper : &ball);
        cairn_body_id pivot = pivot_is_second ? second : first, id = pivot_is_second ? first : second;
        run(1);
        ASSERT_NEAR(0.001 * 0.324770, -0.324770, spin_of(pivot));
        ASSERT_NEAR(0.001 * 0.259816, -0.259816, vy_of(id));
        ASSERT_NEAR_VEC2(0, 0, 0, cairn_body_position(world, pivot));
    }
}

/* m g / k = 0.1 m */
static inline void assert_a_spring_sags_by_the_weight_over_the_stiffness(const cairn_spring_storage *coils)
{
    static const cairn_shape peg = CAIRN_CIRCLE(CAIRN_F(0.05)), box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
    ASSERT_OK(cairn_springs_enable(world, coils));
    cairn_body_id hook = put_static(&peg, 0, 0), load = put(&box, 0, CAIRN_F(-2));
    cairn_spring_def def = cairn_spring_def_default(hook, load);
    def.stiffness = cairn_wide_from_int(100);
    def.damping = cairn_wide_from_int(10);
    cairn_spring_id id = cairn_spring_create(world, &def);
    run(300);
    ASSERT_NEAR(0.001, 2.1, cairn_spring_length(world, id));
}

#endif
