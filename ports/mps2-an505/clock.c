/* mps2-an505 (Cortex-M33, secure): timer 0 at 20 MHz, 2.56 ticks an instruction of 128 ns (icount shift 7). */
#include "clock_cmsdk.h"

enum { TIMER0 = 0x50000000 };

const cairn_board_clock cairn_board_clock_scale = {.multiplier = 25, .shift = 6, .rate = 7812500};

void cairn_board_clock_start(void)
{
    cmsdk_start(TIMER0);
}

uint32_t cairn_board_ticks(void)
{
    return cmsdk_ticks(TIMER0);
}
