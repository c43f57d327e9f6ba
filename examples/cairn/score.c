/* See score.h. */
#include "score.h"

#define GENTLE CAIRN_F(2.2) /* m/s */

enum { LANDING = 10, GENTLE_BONUS = 5, POINTS_A_METRE = 100, LEVEL = 100 };

uint32_t score_landing(score *s, cairn_real growth, cairn_real speed)
{
    uint32_t points = LANDING;
    if (speed < GENTLE)
        points += GENTLE_BONUS;
    if (growth > 0)
        points += (uint32_t)cairn_real_floor(growth * (cairn_real)POINTS_A_METRE);
    points *= s->streak;
    if (s->streak < SCORE_STREAK_MAX)
        s->streak++;
    score_add(s, points);
    return points;
}

void score_lost_stone(score *s) { s->streak = 1; }

uint32_t score_level(score *s, int number, int stones, int lives)
{
    const uint32_t points = (uint32_t)(LEVEL * (number + 1) + SCORE_UNUSED_STONE * stones + SCORE_LIFE * lives);
    score_add(s, points);
    return points;
}
