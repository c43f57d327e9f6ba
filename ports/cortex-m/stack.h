/* How much of the stack was ever used: the start-up paints it, the measure finds the first painted-over word. */
#ifndef CAIRN_STACK_H
#define CAIRN_STACK_H

#include <stdint.h>

/* A value that code is unlikely to store: odd, not an address, not a small number. */
#define CAIRN_STACK_PAINT 0xCA127A17u

extern uint32_t cairn_link_stack_bottom[], cairn_link_stack_top[];

/* Bytes from the top of the stack to the lowest word that was written. */
uint32_t cairn_stack_used(void);

/* Paints all of the stack that is not in use. */
void cairn_stack_paint(void);

/* Bytes from the top of the stack to where it stands. Inline: a function's own frame would be counted too. */
static inline uint32_t cairn_stack_now(void)
{
    uintptr_t here;
    __asm__ volatile("mov %0, sp" : "=r"(here));
    return (uint32_t)((uintptr_t)cairn_link_stack_top - here);
}

#endif
