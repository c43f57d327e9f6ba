/* See level.h. */
#include "level.h"

#define BASE_HEIGHT CAIRN_F(1.6)
#define TOP_AT(x, top) { CAIRN_F(x), CAIRN_F((top) - 0.8) }
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* A static box of a width, as a shape and a model of one name. */
#define GROUND(name, width, height, material) \
    static const cairn_shape name##_shape = CAIRN_BOX(CAIRN_F(width), height); \
    static const cairn_body_model name = { &name##_shape, (material), CAIRN_STATIC, CAIRN_DENSITY(1), CAIRN_F(1), 0, 0, \
                                           LEVEL_LAYER, 0xFFFF, false, false, false, NULL }

static const cairn_material earth = CAIRN_MATERIAL(0.95, 0.85);
static const cairn_material frost = CAIRN_MATERIAL(0.16, 0.12);

GROUND(meadow, 4.6, BASE_HEIGHT, &earth);
GROUND(cliff, 2.6, BASE_HEIGHT, &earth);
GROUND(pillar, 1.5, BASE_HEIGHT, &earth);
GROUND(needle, 1.9, BASE_HEIGHT, &earth);
GROUND(lake, 3.2, BASE_HEIGHT, &frost);
GROUND(bowl, 3.2, BASE_HEIGHT, &earth);
GROUND(rim, 0.3, CAIRN_F(0.3), &earth);
GROUND(stop, 0.5, CAIRN_F(0.5), &earth);
GROUND(pivot, 0.3, CAIRN_F(1.0), &earth);

/* A plank that turns about its middle: its weight and its damping are the player's mercy. */
static const cairn_shape plank_shape = CAIRN_BOX(CAIRN_F(4), CAIRN_F(0.22));
static const cairn_body_model plank = { &plank_shape, &earth, CAIRN_DYNAMIC, CAIRN_DENSITY(6), CAIRN_F(1), 0, CAIRN_F(2.5),
                                        LEVEL_LAYER, STONE_LAYER | 4, false, false, true, NULL };
static const cairn_shape chock_shape = CAIRN_BOX(CAIRN_F(0.4), CAIRN_F(0.4));
static const cairn_body_model chock = { &chock_shape, &earth, CAIRN_STATIC, CAIRN_DENSITY(1), CAIRN_F(1), 0, 0,
                                        4, LEVEL_LAYER | STONE_LAYER, false, false, false, NULL };

static const level_piece meadow_pieces[] = {{&meadow, TOP_AT(0, 0), 0, LOOK_GRASS}};
static const level_piece cliff_pieces[] = {{&cliff, TOP_AT(0.4, 0), 0, LOOK_GRASS}};
static const level_piece breeze_pieces[] = {{&cliff, TOP_AT(-0.5, 0), 0, LOOK_ROCK}};
static const level_piece twin_pieces[] = {{&pillar, TOP_AT(-1.0, 0), 0, LOOK_ROCK}, {&pillar, TOP_AT(1.0, 0.3), 0, LOOK_ROCK}};
static const level_piece seesaw_pieces[] = {
    {&pivot, {CAIRN_F(0), CAIRN_F(-0.61)}, 0, LOOK_PIVOT},
    {&chock, {CAIRN_F(-1.6), CAIRN_F(-0.6)}, 0, LOOK_ROCK},
    {&chock, {CAIRN_F(1.6), CAIRN_F(-0.6)}, 0, LOOK_ROCK},
    {&plank, {CAIRN_F(0), CAIRN_F(0)}, 0, LOOK_PLANK},
};
static const level_piece frost_pieces[] = {{&lake, TOP_AT(0, 0), 0, LOOK_ICE}};
static const level_piece pebble_pieces[] = {
    {&bowl, TOP_AT(0, 0), 0, LOOK_SNOW},
    {&rim, {CAIRN_F(-1.45), CAIRN_F(0.15)}, 0, LOOK_SNOW},
    {&rim, {CAIRN_F(1.45), CAIRN_F(0.15)}, 0, LOOK_SNOW},
};
static const level_piece storm_pieces[] = {{&needle, TOP_AT(0.2, 0), 0, LOOK_SNOW}, {&stop, {CAIRN_F(-2.4), CAIRN_F(-0.4)}, 0, LOOK_SNOW}};

/* Slabs lie well, boulders less, pebbles roll. */
#define SLABS { CAIRN_F(0.52), CAIRN_F(0.72), CAIRN_F(0.24), CAIRN_F(0.34), 52, 88 }
#define BOULDERS { CAIRN_F(0.44), CAIRN_F(0.62), CAIRN_F(0.30), CAIRN_F(0.40), 42, 74 }
#define PEBBLES { CAIRN_F(0.40), CAIRN_F(0.50), CAIRN_F(0.28), CAIRN_F(0.35), 30, 54 }

static const level levels[] = {
    {"MEADOW", CAIRN_F(2.0), 0, 0, 12, COUNT(meadow_pieces), 0, SLABS, meadow_pieces},
    {"CLIFF", CAIRN_F(2.8), 0, CAIRN_F(0.4), 12, COUNT(cliff_pieces), 0, SLABS, cliff_pieces},
    {"BREEZE", CAIRN_F(3.2), CAIRN_F(0.9), CAIRN_F(-0.5), 14, COUNT(breeze_pieces), 1, BOULDERS, breeze_pieces},
    {"TWINS", CAIRN_F(3.4), CAIRN_F(0.3), CAIRN_F(1.0), 16, COUNT(twin_pieces), 1, SLABS, twin_pieces},
    {"SEESAW", CAIRN_F(2.2), 0, 0, 16, COUNT(seesaw_pieces), 2, SLABS, seesaw_pieces},
    {"FROST", CAIRN_F(3.0), CAIRN_F(0.5), 0, 16, COUNT(frost_pieces), 2, BOULDERS, frost_pieces},
    {"PEBBLES", CAIRN_F(2.0), CAIRN_F(0.4), 0, 20, COUNT(pebble_pieces), 3, PEBBLES, pebble_pieces},
    {"STORM", CAIRN_F(4.0), CAIRN_F(1.8), CAIRN_F(0.2), 24, COUNT(storm_pieces), 3, BOULDERS, storm_pieces},
};

enum { LEVEL_COUNT = COUNT(levels), LAPS_MAX = 8 };

int level_count(void) { return LEVEL_COUNT; }

void level_get(level *out, int number)
{
    int lap = number / LEVEL_COUNT;
    if (lap > LAPS_MAX)
        lap = LAPS_MAX;
    *out = levels[number % LEVEL_COUNT];
    out->goal += lap * CAIRN_F(0.5);
    out->wind += lap * CAIRN_F(0.4);
    if (lap > 0)
        out->stones = LEVEL_STONES;
}
