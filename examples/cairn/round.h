/* One level played: stones hang, fall, land, stay or are lost, until the line is held or nothing is left to build with. */
#ifndef ROUND_H
#define ROUND_H

#include "crane.h"
#include "level.h"
#include "random.h"
#include "score.h"
#include "wind.h"

#include <cairn/quadtree.h>

enum {
    ROUND_HOLD_STEPS = 180, /* for how long the cairn has to stand above the line */
    ROUND_LIVES = 3,
    ROUND_LIVES_MAX = 5
};

typedef enum round_state {
    ROUND_HANGING, /* a stone hangs on the rope */
    ROUND_FALLING, /* it falls */
    ROUND_LANDED,  /* it has just landed; the next one comes */
    ROUND_EMPTY,   /* there is none any more: does the cairn stand? */
    ROUND_WON,
    ROUND_LOST
} round_state;

/* What happened in a step, a set. */
typedef enum round_event {
    EVENT_HUNG = 1,
    EVENT_DROPPED = 2,
    EVENT_LANDED = 4, /* at event_at, with event_speed, for event_points */
    EVENT_SPLASH = 8, /* a stone is lost at splash_at */
    EVENT_LIFE = 16,  /* and a life with it */
    EVENT_REACHED = 32, /* the cairn stands above the line: the clock starts */
    EVENT_WON = 64,
    EVENT_LOST = 128
} round_event;

typedef struct round_wish {
    crane_wish crane;
    bool drop;
} round_wish;

typedef struct game_round {
    cairn_world *world;
    level level;
    int number;
    round_state state;
    uint16_t wait, held, mercy; /* steps */
    uint8_t supply;             /* stones that do not hang yet */
    uint8_t lives;
    bool standing;              /* nothing of the cairn moves */
    cairn_real top, record;     /* of the cairn, m */
    cairn_real crane_height;
    random_source random;
    crane crane;
    wind wind;
    stone *current;             /* hanging or falling */
    stone stones[LEVEL_STONES];
    cairn_body_id pieces[LEVEL_PIECES];
    uint32_t events;
    cairn_vec2 event_at, splash_at;
    cairn_real event_speed;
    uint32_t event_points;
} game_round;

/* The world it is played in; there is one. */
void round_start(game_round *r, int number, uint32_t seed, int lives);
/* Before the first step of a round: a stone that has landed in an earlier life of the game. */
bool round_restore_stone(game_round *r, uint32_t seed, cairn_vec2 position, cairn_angle angle);
/* 1/60 s. */
void round_step(game_round *r, round_wish wish, score *s);
/* Of all that decides the future. */
uint32_t round_hash(const game_round *r);

#endif
