/* lm3s6965evb (Cortex-M3): SysTick at 50 MHz, 3.2 ticks an instruction of 64 ns (icount shift 6), the board's only timer that can be read. */
#include "clock_systick.h"

enum {
    RCC = 0x400FE060,
    RCC_SYSDIV_SHIFT = 23,
    RCC_SYSDIV_MASK = 0xF << RCC_SYSDIV_SHIFT,
    RCC_SYSDIV_50_MHZ = 3 << RCC_SYSDIV_SHIFT,
    RCC_USE_SYSDIV = 1 << 22,
    HANDLER_TICKS = 16 /* 5 instructions of 3.2 ticks */
};

const cairn_board_clock cairn_board_clock_scale = {.multiplier = 5, .shift = 4, .rate = 15625000};

void cairn_board_clock_start(void)
{
    CAIRN_REGISTER(RCC) = (CAIRN_REGISTER(RCC) & ~(uint32_t)RCC_SYSDIV_MASK) | RCC_SYSDIV_50_MHZ | RCC_USE_SYSDIV;
    systick_start();
}

uint32_t cairn_board_ticks(void) { return systick_ticks(HANDLER_TICKS); }
