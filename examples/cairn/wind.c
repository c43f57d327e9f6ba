/* See wind.h. */
#include "wind.h"

/* 2^32 / (60 * seconds) */
enum { STEP_A = 14316557 /* 5 s */, STEP_B = 5506368 /* 13 s */ };

void wind_start(wind *w, cairn_real greatest, uint32_t seed)
{
    w->phase_a = seed * 2654435761u;
    w->phase_b = seed * 40503u;
    w->greatest = greatest;
    w->now = 0;
}

void wind_step(wind *w)
{
    cairn_unit cosine, a, b;
    w->phase_a += STEP_A;
    w->phase_b += STEP_B;
    cairn_angle_rotation((cairn_angle)w->phase_a, &cosine, &a);
    cairn_angle_rotation((cairn_angle)w->phase_b, &cosine, &b);
    w->now = cairn_mul32(w->greatest, a / 2 + b / 2, 30);
}
