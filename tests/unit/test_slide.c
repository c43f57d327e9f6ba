/* What slides past another body, or meets it corner to corner: momentum is kept, and nothing is passed unseen. */
# include "../support/yard.h" /* the space keeps it out of the generated runner, which lies elsewhere */

static const cairn_shape box = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));
static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.5));
static const cairn_material rough = CAIRN_MATERIAL(0.4, 0.4);
static const cairn_material bouncing = CAIRN_MATERIAL_BOUNCING(0.4, 0.4, 0.3, 0);

void setUp(void) { open_yard(0); }
void tearDown(void) {}

static cairn_body_id throw(const cairn_shape *shape, const cairn_material *material, cairn_real x, cairn_real y, cairn_real vx, cairn_real vy)
{
    yard_def def = def_at(shape, x, y);
    def.material = material;
    def.velocity = cairn_vec2_of(vx, vy);
    return make(&def);
}

/* Of bodies of density 1 about the origin, where a box has an inertia of 1 / 6 and a ball pi / 32. */
static cairn_real angular_momentum(cairn_body_id id, cairn_real mass, cairn_real inertia)
{
    cairn_vec2 at = cairn_body_center(world, id), v = cairn_body_velocity(world, id);
    return cairn_real_mul(mass, cairn_real_mul(at.x, v.y) - cairn_real_mul(at.y, v.x)) + cairn_real_mul(inertia, cairn_body_angular_velocity(world, id));
}

static cairn_real of_box(cairn_body_id id) { return angular_momentum(id, CAIRN_F(1), CAIRN_F(1.0 / 6)); }

static cairn_real change_over_slide(const cairn_material *material)
{
    cairn_body_id lower = throw(&box, material, 0, 0, 0, 0), upper = throw(&box, material, CAIRN_F(-0.3), CAIRN_F(1.01), CAIRN_F(4), CAIRN_F(-1));
    cairn_real before = of_box(lower) + of_box(upper);
    run(30);
    TEST_ASSERT_TRUE(cairn_body_angular_velocity(world, lower) != 0);
    return of_box(lower) + of_box(upper) - before;
}

void test_a_box_that_slides_over_a_free_one_keeps_the_angular_momentum(void)
{
    ASSERT_NEAR(0.002, 0, change_over_slide(&rough));
}

void test_so_do_boxes_that_bounce(void)
{
    ASSERT_NEAR(0.002, 0, change_over_slide(&bouncing));
}

void test_so_does_a_ball_over_a_free_box(void)
{
    cairn_body_id lower = throw(&box, &rough, 0, 0, 0, 0), upper = throw(&ball, &rough, CAIRN_F(-0.3), CAIRN_F(1.01), CAIRN_F(4), CAIRN_F(-1));
    cairn_real mass = CAIRN_F(0.7853982), inertia = CAIRN_F(0.0981748);
    cairn_real before = of_box(lower) + angular_momentum(upper, mass, inertia);
    run(30);
    ASSERT_NEAR(0.002, 0, of_box(lower) + angular_momentum(upper, mass, inertia) - before);
}

/* The deepest that any contact is in a number of steps. */
static cairn_real deepest(int steps)
{
    cairn_real least = 0;
    for (int i = 0; i < steps; i++) {
        int cursor = 0;
        cairn_contact contact;
        run(1);
        while (cairn_world_next_contact(world, &cursor, &contact)) {
            for (int k = 0; k < contact.count; k++) {
                least = contact.points[k].separation < least ? contact.points[k].separation : least;
            }
        }
    }
    return least;
}

void test_boxes_that_meet_corner_to_corner_do_not_enter_one_another(void)
{
    for (int side = -1; side <= 1; side += 2) {
        yard_def def = def_at(&box, CAIRN_F(0.75) * side, CAIRN_F(0.01) * side);
        def.angle = CAIRN_DEGREES(45);
        def.velocity = cairn_vec2_of(CAIRN_F(-3) * side, 0);
        def.material = &bouncing;
        make(&def);
    }
    ASSERT_NEAR(0.005, 0, deepest(10));
}
