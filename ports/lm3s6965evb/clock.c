/* lm3s6965evb (Cortex-M3): SysTick at 50 MHz, 3.2 ticks an instruction of 64 ns (icount shift 6). The board's only timer
   that can be read is 24 bits wide: an interrupt counts its wraps, and its own instructions are taken off again. */
#include "board.h"

enum {
    RCC = 0x400FE060,
    RCC_SYSDIV_SHIFT = 23,
    RCC_SYSDIV_MASK = 0xF << RCC_SYSDIV_SHIFT,
    RCC_SYSDIV_50_MHZ = 3 << RCC_SYSDIV_SHIFT,
    RCC_USE_SYSDIV = 1 << 22,
    SYSTICK_PERIOD = 1 << 24,
    SYSTICK_ENABLE = 7, /* on, with interrupt, from the core's clock */
    HANDLER_TICKS = 16  /* cairn_systick() is 5 instructions of 3.2 ticks */
};

#define SYSTICK_CONTROL 0xE000E010u
#define SYSTICK_RELOAD 0xE000E014u
#define SYSTICK_VALUE 0xE000E018u

const cairn_board_clock cairn_board_clock_scale = {.multiplier = 5, .shift = 4, .rate = 15625000};

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
    CAIRN_REGISTER(RCC) = (CAIRN_REGISTER(RCC) & ~(uint32_t)RCC_SYSDIV_MASK) | RCC_SYSDIV_50_MHZ | RCC_USE_SYSDIV;
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
    return wraps * (uint32_t)(SYSTICK_PERIOD - HANDLER_TICKS) + (SYSTICK_PERIOD - 1u - value);
}
