/*
 * What newlib asks of the image: memory for malloc(), which tells how far it grew (in pages of 4 KB), and printing, which
 * the peers call only for what is wrong and for dumps. With newlib's own their images would be 20 KB larger.
 */
#include "peer.h"

#include "cairn_port.h"

#include <errno.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

enum { ARENA_BYTES = 2 * 1024 * 1024 };

/* peers.py takes it off the image's memory again. */
char peer_arena[ARENA_BYTES] __attribute__((aligned(8)));
static ptrdiff_t used, most;

void *_sbrk(ptrdiff_t bytes);

void *_sbrk(ptrdiff_t bytes)
{
    if (bytes > ARENA_BYTES - used || used + bytes < 0) {
        errno = ENOMEM;
        return (void *)-1;
    }
    char *start = peer_arena + used;
    used += bytes;
    if (used > most) {
        most = used;
    }
    return start;
}

uint32_t peer_heap_used(void) { return (uint32_t)most; }
uint32_t peer_clock(void) { return cairn_port_clock(); }

int vfprintf(FILE *file, const char *format, va_list arguments)
{
    (void)file;
    (void)format;
    (void)arguments;
    return 0;
}

int vprintf(const char *format, va_list arguments)
{
    (void)format;
    (void)arguments;
    return 0;
}

int fprintf(FILE *file, const char *format, ...)
{
    (void)file;
    (void)format;
    return 0;
}

int printf(const char *format, ...)
{
    (void)format;
    return 0;
}
