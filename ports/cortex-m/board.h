/* What a board's folder gives to the code that all Cortex-M boards share. */
#ifndef CAIRN_BOARD_H
#define CAIRN_BOARD_H

#include <stdint.h>

#define CAIRN_REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))

/* One instruction under the icount shift of board.json is 2^shift / multiplier ticks of the board's timer: more than two,
   so that a tick more or less is less than half an instruction. */
typedef struct cairn_board_clock {
    uint32_t multiplier;
    uint32_t shift;
    uint32_t rate; /* instructions a second of virtual time */
} cairn_board_clock;

extern const cairn_board_clock cairn_board_clock_scale;

/* Starts the timer, at any value. */
void cairn_board_clock_start(void);

/* The timer, counting up modulo 2^32. Takes the same number of instructions each time. */
uint32_t cairn_board_ticks(void);

#endif
