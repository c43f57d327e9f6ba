/* Gusts: two waves of different length, so that they do not come by the clock. */
#ifndef WIND_H
#define WIND_H

#include <cairn/arith.h>

typedef struct wind {
    uint32_t phase_a, phase_b; /* parts of a turn */
    cairn_real greatest, now;  /* m/s^2, to the right */
} wind;

void wind_start(wind *w, cairn_real greatest, uint32_t seed);
/* 1/60 s later. */
void wind_step(wind *w);

#endif
