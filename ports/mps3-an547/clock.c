/* mps3-an547 (Cortex-M55, secure): the SSE-300's system counter at 32 MHz, 4.096 ticks an instruction of 128 ns
   (icount shift 7). Its low word wraps at 32 bits like the other boards' timers. */
#include "board.h"

enum { COUNTER_CONTROL = 0x58100000, COUNTER_LOW = 0x58000000, COUNTER_ENABLE = 1 };

const cairn_board_clock cairn_board_clock_scale = {.multiplier = 125, .shift = 9, .rate = 7812500};

void cairn_board_clock_start(void)
{
    CAIRN_REGISTER(COUNTER_CONTROL) = COUNTER_ENABLE;
}

uint32_t cairn_board_ticks(void)
{
    return CAIRN_REGISTER(COUNTER_LOW);
}
