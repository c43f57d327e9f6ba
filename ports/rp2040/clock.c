/* RP2040 (Cortex-M0+): SysTick at the core's own clock, so that cairn_port_clock() counts cycles. It is 24 bits wide: an
   interrupt counts its wraps, one each 16.8 million cycles, and its own cycles are taken off again (as rp2040js has them;
   a chip also takes about 30 to enter and leave it). */
#include "board.h"

enum {
    SYSTICK_PERIOD = 1 << 24,
    SYSTICK_ENABLE = 7, /* on, with interrupt, from the core's clock */
    /* Two loads, an addition, a store and a return are 2 + 2 + 1 + 2 + 2 cycles, and rp2040js' period is one short. */
    HANDLER_CYCLES = 10
};

#define SYSTICK_CONTROL 0xE000E010u
#define SYSTICK_RELOAD 0xE000E014u
#define SYSTICK_VALUE 0xE000E018u

const cairn_board_clock cairn_board_clock_scale = {.multiplier = 2, .shift = 1, .rate = 125000000};

void cairn_systick(void);

volatile uint32_t cairn_systick_wraps;

/* In assembly, so that its length is known. */
__attribute__((naked)) void cairn_systick(void)
{
    __asm__ volatile("ldr r0, =cairn_systick_wraps\n\t"
                     "ldr r1, [r0]\n\t"
                     "adds r1, #1\n\t"
                     "str r1, [r0]\n\t"
                     "bx lr\n\t"
                     ".ltorg");
}

void cairn_board_clock_start(void)
{
    CAIRN_REGISTER(SYSTICK_CONTROL) = 0;
    CAIRN_REGISTER(SYSTICK_RELOAD) = SYSTICK_PERIOD - 1;
    CAIRN_REGISTER(SYSTICK_VALUE) = 0;
    cairn_systick_wraps = 0;
    CAIRN_REGISTER(SYSTICK_CONTROL) = SYSTICK_ENABLE;
    /* The counter starts at 0 and reloads on its first tick: before that it would read as a whole period. */
    while (CAIRN_REGISTER(SYSTICK_VALUE) == 0) {
    }
}

uint32_t cairn_board_ticks(void)
{
    uint32_t wraps, value;
    do {
        wraps = cairn_systick_wraps;
        value = CAIRN_REGISTER(SYSTICK_VALUE);
    } while (wraps != cairn_systick_wraps);
    return wraps * (uint32_t)(SYSTICK_PERIOD - HANDLER_CYCLES) + (SYSTICK_PERIOD - 1u - value);
}
