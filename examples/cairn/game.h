/* The game around the levels: title, a machine that plays behind it, play, pause, what comes after a level. */
#ifndef GAME_H
#define GAME_H

#include "bot.h"
#include "debug_view.h"
#include "feel.h"
#include "keep.h"
#include "round.h"

typedef enum game_state {
    GAME_TITLE, /* over a round that plays itself */
    GAME_DEMO,  /* the same without the title */
    GAME_RESUME, /* the stones of a kept game come back, a few in each step; then play */
    GAME_PLAY,
    GAME_PAUSE,
    GAME_WON,
    GAME_OVER
} game_state;

enum { GAME_MENU_SIZE = 3 };

typedef struct game {
    game_state state;
    uint32_t frame, since; /* since the start, since the state began */
    uint32_t before;       /* the buttons a step ago */
    uint16_t held;         /* for how many steps SELECT has been */
    uint8_t menu;          /* the chosen line of the title or the pause */
    bool can_continue;     /* there is a kept game */
    uint8_t restored;      /* stones of a kept game that are back */
    uint32_t bonus;        /* points of the level */
    cairn_real camera;     /* the height of the picture's middle */
    random_source random;
    game_round round;
    score score;
    feel feel;
    draw_layers layers;
    keep kept;
    const char *keep_name; /* null: nothing is kept */
} game;

void game_start(game *g, uint32_t seed);
/* Keep the game under this name, and offer to go on with what is there. */
void game_use_keep(game *g, const char *name);
/* 1/60 s. */
void game_step(game *g, uint32_t buttons);
uint32_t game_hash(const game *g);

#endif
