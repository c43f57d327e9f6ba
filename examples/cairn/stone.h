/* A stone: an irregular convex polygon made from a seed, and the body it has in the world. */
#ifndef STONE_H
#define STONE_H

#include <cairn/cairn.h>

enum { STONE_LAYER = 2, STONE_CORNERS = CAIRN_MAX_VERTICES };

/* What the stones of a level are like: half their sizes, and how much of the width is flat below and above, in percent; 0: they are round. */
typedef struct stone_style {
    cairn_real wide_min, wide_max, high_min, high_max;
    uint8_t bed_min, bed_max;
} stone_style;

typedef enum stone_state {
    STONE_NONE,
    STONE_HANGING,
    STONE_FALLING,
    STONE_LANDED
} stone_state;

typedef struct stone {
    stone_state state;
    uint32_t seed;
    cairn_body_id body;
    cairn_real top; /* of its highest corner, when last looked at */
    cairn_body_model model;
    cairn_polygon polygon;
} stone;

/* Give a stone its shape. The same seed and style give the same stone. */
void stone_shape(stone *s, uint32_t seed, const stone_style *style);
/* Put it into the world; false if there is no room. */
bool stone_place(stone *s, cairn_world *world, cairn_vec2 position, cairn_angle angle, stone_state state);
void stone_remove(stone *s, cairn_world *world);

/* Where its corners are in the world; returns how many. */
int stone_corners(const stone *s, cairn_world *world, cairn_vec2 *corners);
/* Look at how high it reaches, if it may have moved. */
void stone_measure(stone *s, cairn_world *world);
/* Speed along the faster axis, m/s. */
cairn_real stone_speed(const stone *s, cairn_world *world);
bool stone_touches(const stone *s, cairn_world *world);
/* The angle at which it would lie on its longest edge. */
cairn_angle stone_flat_angle(const stone *s);

#endif
