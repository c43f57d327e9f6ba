/* Points: what a stone brings, and what a level does. */
#ifndef SCORE_H
#define SCORE_H

#include <cairn/arith.h>

enum { SCORE_STREAK_MAX = 5, SCORE_UNUSED_STONE = 25, SCORE_LIFE = 50 };

typedef struct score {
    uint32_t points, best;
    uint8_t streak; /* stones placed without losing one: 1 to SCORE_STREAK_MAX times the points */
} score;

static inline void score_start(score *s)
{
    s->points = 0;
    s->streak = 1;
}

static inline void score_add(score *s, uint32_t points)
{
    s->points += points;
    if (s->points > 999999)
        s->points = 999999;
    if (s->points > s->best)
        s->best = s->points;
}

/* A stone has landed, the cairn is higher by so many metres, and it came down at this speed. Returns the points. */
uint32_t score_landing(score *s, cairn_real growth, cairn_real speed);
void score_lost_stone(score *s);
/* The line was held with so many stones and lives to spare. Returns the points. */
uint32_t score_level(score *s, int number, int stones, int lives);

#endif
