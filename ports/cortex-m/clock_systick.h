/* SysTick at the core's own clock, as a clock of 32 bits. It is 24 bits wide: an interrupt counts its wraps, one each 16.8 million ticks, and its own
   ticks are taken off again. Included by one file of each board that has no other timer to read.
   Source: Arm, "ARMv6-M Architecture Reference Manual", section B3.3. */
#ifndef CAIRN_CLOCK_SYSTICK_H
#define CAIRN_CLOCK_SYSTICK_H

#include "board.h"

enum { SYSTICK_PERIOD = 1 << 24, SYSTICK_ENABLE = 7 /* on, with interrupt, from the core's clock */ };

#define SYSTICK_CONTROL 0xE000E010u
#define SYSTICK_RELOAD 0xE000E014u
#define SYSTICK_VALUE 0xE000E018u

void cairn_systick(void);

volatile uint32_t cairn_systick_wraps;

/* In assembly, so that its length is known: two loads, an addition, a store and a return. */
__attribute__((naked)) void cairn_systick(void)
{
    __asm__ volatile("ldr r0, =cairn_systick_wraps\n\t"
                     "ldr r1, [r0]\n\t"
                     "adds r1, #1\n\t"
                     "str r1, [r0]\n\t"
                     "bx lr\n\t"
                     ".ltorg");
}

static inline void systick_start(void)
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

/* handler: what cairn_systick() takes of the board's ticks. */
static inline uint32_t systick_ticks(uint32_t handler)
{
    uint32_t wraps, value;
    do {
        wraps = cairn_systick_wraps;
        value = CAIRN_REGISTER(SYSTICK_VALUE);
    } while (wraps != cairn_systick_wraps);
    return wraps * (SYSTICK_PERIOD - handler) + (SYSTICK_PERIOD - 1u - value);
}

#endif
