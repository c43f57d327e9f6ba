/* The port interface on a PC: stdio, a monotonic clock, and the process's own arguments. */
#define _POSIX_C_SOURCE 200809L
#include "cairn_port.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { ARGUMENTS_SIZE = 512 };

static const uint32_t nanoseconds_per_second = 1000000000u;

static char arguments[ARGUMENTS_SIZE];
static struct timespec start;

/* An image's main() takes no arguments, as on a board: the C library hands them to constructors too (glibc, macOS). */
__attribute__((constructor)) static void take_arguments(int count, char **words)
{
    size_t length = 0;
    for (int i = 1; i < count; i++) {
        const char *separator = length == 0 ? "" : " ";
        const int added = snprintf(arguments + length, sizeof arguments - length, "%s%s", separator, words[i]);
        if (added < 0 || (size_t)added >= sizeof arguments - length) {
            fputs("the arguments are too long\n", stderr);
            exit(EXIT_FAILURE);
        }
        length += (size_t)added;
    }
}

void cairn_port_init(void)
{
    clock_gettime(CLOCK_MONOTONIC, &start);
}

void cairn_port_write(const char *text)
{
    fputs(text, stdout);
}

uint32_t cairn_port_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    const int64_t seconds = (int64_t)now.tv_sec - (int64_t)start.tv_sec;
    const int64_t rest = (int64_t)now.tv_nsec - (int64_t)start.tv_nsec;
    return (uint32_t)(seconds * (int64_t)nanoseconds_per_second + rest);
}

uint32_t cairn_port_clock_rate(void)
{
    return nanoseconds_per_second;
}

const char *cairn_port_arguments(void)
{
    return arguments;
}

void cairn_port_exit(int code)
{
    exit(code);
}

uint32_t cairn_port_stack_used(void)
{
    return 0;
}

void cairn_port_stack_paint(void)
{
}

uint32_t cairn_port_stack_now(void)
{
    return 0;
}

uint32_t cairn_port_seed(void)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    return (uint32_t)now.tv_sec * 1000003u + (uint32_t)now.tv_nsec;
}
