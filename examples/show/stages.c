/* See stages.h. */
#include "stages.h"

static const cairn_material plain = CAIRN_MATERIAL(0.6, 0.5);
static const cairn_material lively = CAIRN_MATERIAL_BOUNCING(0.5, 0.4, 0.5, 0.5);

static const cairn_shape ground_shape = CAIRN_BOX(CAIRN_F(40), CAIRN_F(1)), wall_shape = CAIRN_BOX(CAIRN_F(0.5), CAIRN_F(12));
static const cairn_shape crate_shape = CAIRN_BOX(CAIRN_F(0.8), CAIRN_F(0.8)), brick_shape = CAIRN_BOX(CAIRN_F(0.9), CAIRN_F(0.6));
static const cairn_shape plank_shape = CAIRN_BOX(CAIRN_F(0.6), CAIRN_F(0.2)), ramp_shape = CAIRN_BOX(CAIRN_F(7), CAIRN_F(0.3));
static const cairn_shape ball_shape = CAIRN_CIRCLE(CAIRN_F(0.35)), bob_shape = CAIRN_CIRCLE(CAIRN_F(0.3)), bead_shape = CAIRN_CIRCLE(CAIRN_F(0.15));

#define MODEL(name, shape, material, type, density, mask) \
    static const cairn_body_model name = { &shape, &material, type, CAIRN_DENSITY(density), CAIRN_F(1), 0, 0, 1, mask, false, false, false, NULL }
MODEL(ground, ground_shape, plain, CAIRN_STATIC, 1, 0xFFFF);
MODEL(wall, wall_shape, plain, CAIRN_STATIC, 1, 0xFFFF);
MODEL(ramp, ramp_shape, plain, CAIRN_STATIC, 1, 0xFFFF);
MODEL(crate, crate_shape, plain, CAIRN_DYNAMIC, 1, 0xFFFF);
MODEL(brick, brick_shape, plain, CAIRN_DYNAMIC, 1, 0xFFFF);
MODEL(plank, plank_shape, plain, CAIRN_DYNAMIC, 2, 0xFFFF);
MODEL(heavy, crate_shape, plain, CAIRN_DYNAMIC, 20, 0xFFFF);
MODEL(ball, ball_shape, plain, CAIRN_DYNAMIC, 1, 0xFFFF);
MODEL(bouncing, ball_shape, lively, CAIRN_DYNAMIC, 1, 0xFFFF);
MODEL(striker, ball_shape, plain, CAIRN_DYNAMIC, 4, 0xFFFF);
MODEL(peg, bead_shape, plain, CAIRN_STATIC, 1, 0);
MODEL(bob, bob_shape, plain, CAIRN_DYNAMIC, 4, 0);
MODEL(bead, bead_shape, plain, CAIRN_DYNAMIC, 4, 0xFFFF);

static cairn_body_id put(cairn_world *world, const cairn_body_model *model, cairn_real x, cairn_real y)
{
    return cairn_body_create(world, model, cairn_vec2_of(x, y), 0);
}

static void put_ground(cairn_world *world) { (void)put(world, &ground, 0, CAIRN_F(-0.5)); }

static void tie(cairn_world *world, cairn_body_id a, cairn_body_id b, int stiffness, cairn_real length)
{
    cairn_spring_def def = cairn_spring_def_default(a, b);
    def.stiffness = cairn_wide_from_int(stiffness);
    def.damping = cairn_wide_from_int(stiffness / 50 > 10 ? 10 : stiffness / 50 + 1);
    def.rest_length = length;
    def.no_contact = true;
    (void)cairn_spring_create(world, &def);
}

static void build_tower(cairn_world *world)
{
    put_ground(world);
    for (int i = 0; i < 10; i++)
        (void)put(world, &crate, 0, CAIRN_F(0.4) + i * CAIRN_F(0.8));
}

static void build_pyramid(cairn_world *world)
{
    put_ground(world);
    for (int row = 0; row < 6; row++)
        for (int i = 0; i < 6 - row; i++)
            (void)put(world, &brick, (2 * i - 5 + row) * CAIRN_F(0.47), CAIRN_F(0.3) + row * CAIRN_F(0.62));
}

/* Two masses on springs, one under the other, soft to stiff. Both sides have Cairn's springs, which are solved implicitly; in the slides' own the stiff ones burst. */
static void build_ropes(cairn_world *world)
{
    static const int stiffness[3] = {200, 5000, 100000};
    put_ground(world);
    for (int i = 0; i < 3; i++) {
        const cairn_real x = (i - 1) * CAIRN_F(2.2);
        const cairn_body_id top = put(world, &peg, x, CAIRN_F(6)), upper = put(world, &bob, x + CAIRN_F(1), CAIRN_F(6));
        const cairn_body_id lower = put(world, &bob, x + CAIRN_F(1), CAIRN_F(4.6));
        tie(world, top, upper, stiffness[i], CAIRN_F(1));
        tie(world, upper, lower, stiffness[i], CAIRN_F(1.4));
    }
}

static void build_bridge(cairn_world *world)
{
    cairn_body_id last = put(world, &peg, CAIRN_F(-3.6), CAIRN_F(3));
    put_ground(world);
    for (int i = 0; i < 10; i++) {
        const cairn_body_id next = put(world, &plank, CAIRN_F(-2.9) + i * CAIRN_F(0.65), CAIRN_F(3));
        tie(world, last, next, 4000, CAIRN_F(0.65));
        last = next;
    }
    tie(world, last, put(world, &peg, CAIRN_F(3.6), CAIRN_F(3)), 4000, CAIRN_F(0.65));
    (void)put(world, &ball, CAIRN_F(-0.8), CAIRN_F(4));
    (void)put(world, &ball, CAIRN_F(0.9), CAIRN_F(4.4));
    (void)put(world, &crate, CAIRN_F(0), CAIRN_F(5.4));
}

static void build_heavy(cairn_world *world)
{
    put_ground(world);
    for (int i = 0; i < 4; i++)
        (void)put(world, &crate, CAIRN_F(-1.8), CAIRN_F(0.4) + i * CAIRN_F(0.8));
    (void)put(world, &heavy, CAIRN_F(-1.8), CAIRN_F(3.6));
    (void)put(world, &crate, CAIRN_F(1.2), CAIRN_F(0.4));
    (void)put(world, &crate, CAIRN_F(2.4), CAIRN_F(0.4));
    (void)put(world, &heavy, CAIRN_F(1.8), CAIRN_F(1.2));
    (void)put(world, &crate, CAIRN_F(1.8), CAIRN_F(2.0));
}

static void build_rolling(cairn_world *world)
{
    put_ground(world);
    (void)cairn_body_create(world, &ramp, cairn_vec2_of(CAIRN_F(-1.4), CAIRN_F(4.4)), CAIRN_DEGREES(-16));
    (void)cairn_body_create(world, &ramp, cairn_vec2_of(CAIRN_F(1.4), CAIRN_F(1.7)), CAIRN_DEGREES(14));
    for (int i = 0; i < 4; i++)
        (void)put(world, i % 2 == 0 ? &ball : &bouncing, CAIRN_F(-4) + i * CAIRN_F(0.9), CAIRN_F(6.2));
}

static void build_curtain(cairn_world *world)
{
    enum { COLUMNS = 4, ROWS = 5 };
    cairn_body_id above[COLUMNS];
    for (int column = 0; column < COLUMNS; column++)
        above[column] = put(world, &peg, CAIRN_F(-0.4) + column * CAIRN_F(0.5), CAIRN_F(6.5));
    put_ground(world);
    for (int row = 1; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++) {
            const cairn_body_id next = put(world, &bead, CAIRN_F(-0.4) + column * CAIRN_F(0.5), CAIRN_F(6.5) - row * CAIRN_F(0.5));
            tie(world, above[column], next, 400, CAIRN_F(0.5));
            if (column > 0)
                tie(world, above[column - 1], next, 200, CAIRN_F(0.71));
            above[column] = next;
        }
    const cairn_body_id s = put(world, &striker, CAIRN_F(-3.5), CAIRN_F(4.4));
    (void)cairn_body_set_velocity(world, s, cairn_vec2_of(CAIRN_F(6), CAIRN_F(2)));
}

static void build_balls(cairn_world *world)
{
    put_ground(world);
    (void)put(world, &wall, CAIRN_F(-3), CAIRN_F(5));
    (void)put(world, &wall, CAIRN_F(3), CAIRN_F(5));
    for (int i = 0; i < 20; i++)
        (void)put(world, i % 4 == 0 ? &bouncing : &ball, (i % 5 - 2) * CAIRN_F(0.9) + (i / 5 % 2) * CAIRN_F(0.2), CAIRN_F(1) + i / 5 * CAIRN_F(1));
}

static const struct {
    const char *name;
    void (*build)(cairn_world *world);
    int scale;
    cairn_real height;
} stages[] = {
    {"TOWER", build_tower, 7, CAIRN_F(3.6)},     {"SPRINGS", build_ropes, 8, CAIRN_F(3.6)},
    {"PYRAMID", build_pyramid, 8, CAIRN_F(2.6)}, {"BRIDGE", build_bridge, 8, CAIRN_F(2.8)},
    {"HEAVY ON LIGHT", build_heavy, 9, CAIRN_F(2.2)}, {"ROLLING", build_rolling, 7, CAIRN_F(3)},
    {"CURTAIN", build_curtain, 8, CAIRN_F(3.2)}, {"BALLS", build_balls, 8, CAIRN_F(3)},
};

enum { STAGES = sizeof stages / sizeof stages[0] };

int stages_count(void) { return STAGES; }
const char *stages_name(int number) { return stages[number].name; }
int stages_scale(int number) { return stages[number].scale; }
cairn_real stages_height(int number) { return stages[number].height; }
void stages_build(int number, cairn_world *world) { stages[number].build(world); }
