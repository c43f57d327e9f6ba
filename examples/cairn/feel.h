/* What makes it feel: dust where stones meet, splashes, points that pop up, the picture that shakes. It decides nothing. */
#ifndef FEEL_H
#define FEEL_H

#include "random.h"

#include <cairn/arith.h>

enum { FEEL_GRAINS = 32, FEEL_POPS = 4, FEEL_SHAKE_MAX = 12 };

typedef struct feel_grain {
    cairn_vec2 at, velocity; /* m, m a step */
    uint8_t life;            /* steps; 0: none */
    bool heavy;              /* falls */
} feel_grain;

typedef struct feel_pop {
    cairn_vec2 at;
    uint32_t points;
    uint8_t life;
} feel_pop;

typedef struct feel {
    feel_grain grains[FEEL_GRAINS];
    feel_pop pops[FEEL_POPS];
    uint8_t next_grain, next_pop;
    uint8_t shake; /* steps left */
    random_source random;
} feel;

void feel_start(feel *f, uint32_t seed);
void feel_step(feel *f);
/* Dust to both sides, the more the harder the blow (m/s). */
void feel_thud(feel *f, cairn_vec2 at, cairn_real speed);
void feel_splash(feel *f, cairn_vec2 at);
void feel_points(feel *f, cairn_vec2 at, uint32_t points);
/* Sparks all over a box: a line is held. */
void feel_sparks(feel *f, cairn_vec2 at);
/* How far the picture is off its place, in pixels. */
int feel_shake_x(const feel *f);
int feel_shake_y(const feel *f);

#endif
