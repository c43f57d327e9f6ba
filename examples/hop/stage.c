/* See stage.h. */
#include "stage.h"

#define AT(x, y) { CAIRN_F(x), CAIRN_F(y) }

static const cairn_material grip = CAIRN_MATERIAL(0.9, 0.8);
static const cairn_material smooth = CAIRN_MATERIAL(0.1, 0.05); /* the hero's sides must not stick to walls; he stops by his own will */

static const cairn_shape hero_shape = CAIRN_BOX(CAIRN_F(0.56), CAIRN_F(0.76)), crate_shape = CAIRN_BOX(CAIRN_F(0.6), CAIRN_F(0.6));
static const cairn_shape ledge_shape = CAIRN_BOX(CAIRN_F(1.8), CAIRN_F(0.2)), platform_shape = CAIRN_BOX(CAIRN_F(1.6), CAIRN_F(0.3));
static const cairn_shape coin_shape = CAIRN_CIRCLE(CAIRN_F(0.25));
static const cairn_shape left_shape = CAIRN_BOX(CAIRN_F(7), CAIRN_F(2)), right_shape = CAIRN_BOX(CAIRN_F(8), CAIRN_F(2));
static const cairn_shape wall_shape = CAIRN_BOX(CAIRN_F(1), CAIRN_F(3));

/* One kilogram: the jump's impulse is then its speed. */
const cairn_body_model stage_hero = { &hero_shape, &smooth, CAIRN_DYNAMIC, CAIRN_DENSITY(2.3496), CAIRN_F(1), 0, 0,
                                      LAYER_HERO, 0xFFFF, false, true, false, NULL };
const cairn_body_model stage_platform = { &platform_shape, &grip, CAIRN_KINEMATIC, CAIRN_DENSITY(1), CAIRN_F(1), 0, 0,
                                          LAYER_GROUND, 0xFFFF, false, false, false, NULL };
const cairn_body_model stage_crate = { &crate_shape, &grip, CAIRN_DYNAMIC, CAIRN_DENSITY(0.8), CAIRN_F(1), 0, 0,
                                       LAYER_GROUND, 0xFFFF, false, false, false, NULL };
const cairn_body_model stage_coin = { &coin_shape, &grip, CAIRN_STATIC, CAIRN_DENSITY(1), CAIRN_F(1), 0, 0,
                                      LAYER_COIN, LAYER_HERO, true, false, false, NULL };
const cairn_body_model stage_ledge_solid = { &ledge_shape, &grip, CAIRN_STATIC, CAIRN_DENSITY(1), CAIRN_F(1), 0, 0,
                                             LAYER_LEDGE, 0xFFFF, false, false, false, NULL };
const cairn_body_model stage_ledge_open = { &ledge_shape, &grip, CAIRN_STATIC, CAIRN_DENSITY(1), CAIRN_F(1), 0, 0,
                                            LAYER_LEDGE, LAYER_GROUND, false, false, false, NULL };

#define GROUND(name, shape) \
    static const cairn_body_model name = { &shape, &grip, CAIRN_STATIC, CAIRN_DENSITY(1), CAIRN_F(1), 0, 0, LAYER_GROUND, 0xFFFF, false, false, false, NULL }
GROUND(left_ground, left_shape);
GROUND(right_ground, right_shape);
GROUND(wall, wall_shape);

const cairn_body_model *const stage_grounds[HOP_GROUNDS] = {&left_ground, &right_ground, &wall};
const cairn_vec2 stage_ground_at[HOP_GROUNDS] = {AT(0.5, -1), AT(14, -1), AT(17.5, 1.5)};
const cairn_vec2 stage_ledge_at[HOP_LEDGES] = {AT(1.5, 1.2), AT(3.6, 2.4), AT(1.2, 3.6), AT(11.5, 1.2), AT(13.8, 2.4), AT(11.6, 3.6)};
const cairn_vec2 stage_coin_at[HOP_COINS] = {AT(-2, 0.6), AT(1.5, 1.9), AT(3.6, 3.1), AT(1.2, 4.3), AT(7, 1.9), AT(11.5, 1.9), AT(13.8, 3.1), AT(11.6, 4.3)};
const cairn_vec2 stage_crate_at[HOP_CRATES] = {AT(12.4, 0.3), AT(15, 0.3), AT(15, 0.9)};
const cairn_vec2 stage_start = AT(-1, 0.4), stage_platform_at = AT(5.2, 0);
