/* mps2-an500 (Cortex-M7): timer 0 at 25 MHz, 3.2 ticks an instruction of 128 ns (icount shift 7). */
#include "clock_cmsdk.h"

enum { TIMER0 = 0x40000000 };

const cairn_board_clock cairn_board_clock_scale = {.multiplier = 5, .shift = 4, .rate = 7812500};

void cairn_board_clock_start(void)
{
    cmsdk_start(TIMER0);
}

uint32_t cairn_board_ticks(void)
{
    return cmsdk_ticks(TIMER0);
}
