/* microbit (nRF51, Cortex-M0): TIMER0, 32 bits at 8 MHz, 2.048 ticks an instruction of 256 ns (icount shift 8).
   At the full 16 MHz a tick is 62.5 ns and QEMU loses half a nanosecond per reading: 8 MHz stays exact. */
#include "board.h"

enum {
    TIMER0 = 0x40008000,
    TASK_START = TIMER0 + 0x000,
    TASK_STOP = TIMER0 + 0x004,
    TASK_CLEAR = TIMER0 + 0x00C,
    TASK_CAPTURE0 = TIMER0 + 0x040,
    MODE = TIMER0 + 0x504,
    BITMODE = TIMER0 + 0x508,
    PRESCALER = TIMER0 + 0x510,
    CAPTURED0 = TIMER0 + 0x540,
    MODE_TIMER = 0,
    BITMODE_32 = 3,
    PRESCALER_HALF = 1
};

const cairn_board_clock cairn_board_clock_scale = {.multiplier = 125, .shift = 8, .rate = 3906250};

void cairn_board_clock_start(void)
{
    CAIRN_REGISTER(TASK_STOP) = 1;
    CAIRN_REGISTER(MODE) = MODE_TIMER;
    CAIRN_REGISTER(BITMODE) = BITMODE_32;
    CAIRN_REGISTER(PRESCALER) = PRESCALER_HALF;
    CAIRN_REGISTER(TASK_CLEAR) = 1;
    CAIRN_REGISTER(TASK_START) = 1;
}

uint32_t cairn_board_ticks(void)
{
    CAIRN_REGISTER(TASK_CAPTURE0) = 1;
    return CAIRN_REGISTER(CAPTURED0);
}
