/* See table.h. Metres: the table is 8 wide and 13 high, and as steep as gravity says. */
#include "table.h"

#define GRAVITY CAIRN_F(-7)
#define FLIPPER_SPEED CAIRN_F(16) /* rad/s */
#define FLIPPER_DOWN CAIRN_DEGREES(-24)
#define FLIPPER_UP CAIRN_DEGREES(32)
#define FLIPPER_GAIN 20 /* 1/s: how fast what is left of the way is gone */

enum { BODIES = 32, ARBITERS = 48, FLIPPER_LAYER = 2, BALL_LAYER = 4 };

CAIRN_WORLD(cabinet, BODIES, ARBITERS);

static const cairn_material steel = CAIRN_MATERIAL_BOUNCING(0.2, 0.15, 0.35, 0.4);
static const cairn_material rubber = CAIRN_MATERIAL_BOUNCING(0.3, 0.3, 0.75, 0.2);

static const cairn_shape ball_shape = CAIRN_CIRCLE(CAIRN_F(0.22));
static const cairn_body_model ball_model = { &ball_shape, &steel, CAIRN_DYNAMIC, CAIRN_DENSITY(4), CAIRN_F(1), 0, 0, BALL_LAYER, 0xFFFF, false, false, false, NULL };

/* A flipper turns about its middle and cannot leave it; its other half lies under the guide, which it does not meet. */
static const cairn_shape flipper_shape = CAIRN_BOX(CAIRN_F(3.0), CAIRN_F(0.26));
static const cairn_body_model flipper_model = { &flipper_shape, &steel, CAIRN_DYNAMIC, CAIRN_DENSITY(40), 0, 0, 0, FLIPPER_LAYER, BALL_LAYER, false, false, true, NULL };

static const cairn_shape side_shape = CAIRN_BOX(CAIRN_F(0.5), CAIRN_F(14)), top_shape = CAIRN_BOX(CAIRN_F(9), CAIRN_F(0.5));
static const cairn_shape lane_shape = CAIRN_BOX(CAIRN_F(0.16), CAIRN_F(9.2)), guide_shape = CAIRN_BOX(CAIRN_F(2.3), CAIRN_F(0.3));
static const cairn_shape right_guide_shape = CAIRN_BOX(CAIRN_F(1.7), CAIRN_F(0.3));
static const cairn_shape corner_shape = CAIRN_BOX(CAIRN_F(2.6), CAIRN_F(0.5)), post_shape = CAIRN_CIRCLE(CAIRN_F(0.14));
static const cairn_shape bumper_shape = CAIRN_CIRCLE(CAIRN_F(0.55)), sling_shape = CAIRN_BOX(CAIRN_F(1.5), CAIRN_F(0.2));
static const cairn_shape lamp_shape = CAIRN_CIRCLE(CAIRN_F(0.3));

#define WALL(name, shape) \
    static const cairn_body_model name = { &shape, &steel, CAIRN_STATIC, CAIRN_DENSITY(1), CAIRN_F(1), 0, 0, 1, 0xFFFF, false, false, false, NULL }
WALL(side, side_shape);
WALL(top, top_shape);
WALL(lane, lane_shape);
WALL(guide, guide_shape);
WALL(right_guide, right_guide_shape);
WALL(corner, corner_shape);
static const cairn_body_model post = { &post_shape, &rubber, CAIRN_STATIC, CAIRN_DENSITY(1), CAIRN_F(1), 0, 0, 1, 0xFFFF, false, false, false, NULL };
static const cairn_body_model bumper = { &bumper_shape, &rubber, CAIRN_STATIC, CAIRN_DENSITY(1), CAIRN_F(1), 0, 0, 1, 0xFFFF, false, false, false, NULL };
static const cairn_body_model sling = { &sling_shape, &rubber, CAIRN_STATIC, CAIRN_DENSITY(1), CAIRN_F(1), 0, 0, 1, 0xFFFF, false, false, false, NULL };
static const cairn_body_model lamp = { &lamp_shape, &steel, CAIRN_STATIC, CAIRN_DENSITY(1), CAIRN_F(1), 0, 0, 1, 0xFFFF, true, false, false, NULL };

static const struct {
    const cairn_body_model *model;
    cairn_vec2 at;
    cairn_angle angle;
    part_kind kind;
} plan[] = {
    {&side, {CAIRN_F(-4.2), CAIRN_F(6.5)}, 0, PART_WALL},
    {&side, {CAIRN_F(4.2), CAIRN_F(6.5)}, 0, PART_WALL},
    {&top, {CAIRN_F(0), CAIRN_F(13.2)}, 0, PART_WALL},
    {&lane, {CAIRN_F(3.3), CAIRN_F(5.4)}, 0, PART_WALL},
    {&corner, {CAIRN_F(3.4), CAIRN_F(12.5)}, CAIRN_DEGREES(-45), PART_WALL},
    {&corner, {CAIRN_F(-3.4), CAIRN_F(12.5)}, CAIRN_DEGREES(45), PART_WALL},
    {&guide, {CAIRN_F(-2.95), CAIRN_F(2.35)}, CAIRN_DEGREES(-24), PART_WALL},
    {&right_guide, {CAIRN_F(2.5), CAIRN_F(2.15)}, CAIRN_DEGREES(24), PART_WALL},
    {&post, {CAIRN_F(-3.2), CAIRN_F(6.6)}, 0, PART_WALL},
    {&post, {CAIRN_F(2.5), CAIRN_F(6.6)}, 0, PART_WALL},
    {&post, {CAIRN_F(-0.3), CAIRN_F(6.2)}, 0, PART_WALL},
    {&bumper, {CAIRN_F(-1.7), CAIRN_F(8.6)}, 0, PART_BUMPER},
    {&bumper, {CAIRN_F(1.1), CAIRN_F(8.6)}, 0, PART_BUMPER},
    {&bumper, {CAIRN_F(-0.3), CAIRN_F(10.1)}, 0, PART_BUMPER},
    {&sling, {CAIRN_F(-2.7), CAIRN_F(4.4)}, CAIRN_DEGREES(-62), PART_SLING},
    {&sling, {CAIRN_F(2.0), CAIRN_F(4.4)}, CAIRN_DEGREES(62), PART_SLING},
    {&lamp, {CAIRN_F(-1.8), CAIRN_F(11.9)}, 0, PART_LAMP},
    {&lamp, {CAIRN_F(-0.3), CAIRN_F(11.9)}, 0, PART_LAMP},
    {&lamp, {CAIRN_F(1.2), CAIRN_F(11.9)}, 0, PART_LAMP},
};

void table_build(table *t)
{
    t->world = cairn_world_init(&cabinet, cairn_vec2_of(0, GRAVITY));
    t->part_count = 0;
    for (unsigned i = 0; i < sizeof plan / sizeof plan[0]; i++) {
        t->kinds[t->part_count] = (uint8_t)plan[i].kind;
        t->parts[t->part_count++] = cairn_body_create(t->world, plan[i].model, plan[i].at, plan[i].angle);
    }
    t->flippers[0] = cairn_body_create(t->world, &flipper_model, cairn_vec2_of(CAIRN_F(-1.95), CAIRN_F(1.75)), FLIPPER_DOWN);
    t->flippers[1] = cairn_body_create(t->world, &flipper_model, cairn_vec2_of(CAIRN_F(1.65), CAIRN_F(1.75)), -FLIPPER_DOWN);
    t->ball = cairn_body_create(t->world, &ball_model, cairn_vec2_of(0, 0), 0);
    table_serve(t);
}

void table_serve(table *t)
{
    (void)cairn_body_set_transform(t->world, t->ball, cairn_vec2_of(CAIRN_F(3.65), CAIRN_F(1.5)), 0);
    (void)cairn_body_set_velocity(t->world, t->ball, cairn_vec2_of(0, 0));
    (void)cairn_body_set_angular_velocity(t->world, t->ball, 0);
}

void table_flip(table *t, unsigned up)
{
    for (unsigned i = 0; i < 2; i++) {
        const cairn_angle goal = (up >> i & 1u) != 0 ? FLIPPER_UP : FLIPPER_DOWN;
        const cairn_angle left = (i == 0 ? goal : -goal) - cairn_body_angle(t->world, t->flippers[i]);
        cairn_real speed = FLIPPER_GAIN * cairn_angle_radians(left);
        speed = speed > FLIPPER_SPEED ? FLIPPER_SPEED : speed < -FLIPPER_SPEED ? -FLIPPER_SPEED : speed;
        (void)cairn_body_set_angular_velocity(t->world, t->flippers[i], speed);
    }
}

int table_part_of(const table *t, cairn_body_id body)
{
    for (int i = 0; i < t->part_count; i++)
        if (cairn_body_id_equal(t->parts[i], body))
            return i;
    return -1;
}
