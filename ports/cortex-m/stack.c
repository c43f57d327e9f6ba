/* The high-water mark of the stack that the start-up painted, and a new coat of paint. */
#include "stack.h"

uint32_t cairn_stack_used(void)
{
    const uint32_t *word = cairn_link_stack_bottom;
    while (word < cairn_link_stack_top && *word == CAIRN_STACK_PAINT)
        word++;
    return (uint32_t)((uintptr_t)cairn_link_stack_top - (uintptr_t)word);
}

void cairn_stack_paint(void)
{
    /* Volatile, or it would become a call of memset(), whose frame lies where it paints. */
    volatile uint32_t *word = cairn_link_stack_bottom;
    /* Room for what this function pushes after it has looked at sp, as compilers do for the M55. */
    const uint32_t *end = cairn_link_stack_top - cairn_stack_now() / sizeof *word - 16;
    while (word < end)
        *word++ = CAIRN_STACK_PAINT;
}
