/* On the host the C library has the heap, and the start files run the constructors. */
#define _POSIX_C_SOURCE 200809L
#include "peer.h"

#include <time.h>

uint32_t peer_heap_used(void) { return 0; }
void peer_construct(void) {}

/* The time this thread ran, not what passed: other programs may have the processor in between. */
uint32_t peer_clock(void)
{
    struct timespec ran;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &ran);
    return (uint32_t)((uint64_t)ran.tv_sec * 1000000000u + (uint64_t)ran.tv_nsec);
}
