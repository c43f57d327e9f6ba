/* How much of the stack was ever used: the start-up paints it, the measure finds the first painted-over word. */
#ifndef CAIRN_STACK_H
#define CAIRN_STACK_H

#include <stdint.h>

/* A value that code is unlikely to store: odd, not an address, not a small number. */
#define CAIRN_STACK_PAINT 0xCA127A17u

extern uint32_t cairn_link_stack_bottom[], cairn_link_stack_top[];

/* Bytes from the top of the stack to the lowest word that was written. */
uint32_t cairn_stack_used(void);

/* Bytes from the top of the stack to where it stands in the caller. */
uint32_t cairn_stack_now(void);

#endif
