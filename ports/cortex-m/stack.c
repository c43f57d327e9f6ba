/* The high-water mark of the stack that the start-up painted, and where it stands. */
#include "stack.h"

uint32_t cairn_stack_used(void)
{
    const uint32_t *word = cairn_link_stack_bottom;
    while (word < cairn_link_stack_top && *word == CAIRN_STACK_PAINT)
        word++;
    return (uint32_t)((uintptr_t)cairn_link_stack_top - (uintptr_t)word);
}

uint32_t cairn_stack_now(void)
{
    return (uint32_t)((uintptr_t)cairn_link_stack_top - (uintptr_t)__builtin_frame_address(0));
}
