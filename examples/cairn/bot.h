/* Plays by itself, with the same buttons as a person: it turns the stone onto its longest edge, waits until it hangs still over the cairn, and lets go. */
#ifndef BOT_H
#define BOT_H

#include "round.h"

/* The buttons it holds in this step. */
uint32_t bot_buttons(const game_round *r, uint32_t frame);

#endif
