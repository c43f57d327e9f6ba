/* RP2040 (Cortex-M0+): SysTick, so that cairn_port_clock() counts the core's cycles. */
#include "clock_systick.h"

/* As rp2040js has them: two loads, an addition, a store and a return are 2 + 2 + 1 + 2 + 2 cycles, and its period is one short. A chip also takes about 30
   to enter and leave the interrupt. */
enum { HANDLER_CYCLES = 10 };

const cairn_board_clock cairn_board_clock_scale = {.multiplier = 2, .shift = 1, .rate = 125000000};

void cairn_board_clock_start(void) { systick_start(); }

uint32_t cairn_board_ticks(void) { return systick_ticks(HANDLER_CYCLES); }
