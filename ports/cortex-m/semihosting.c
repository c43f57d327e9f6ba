/* Semihosting calls of a Cortex-M: operation in r0, argument or its address in r1, result in r0. */
#include "semihosting.h"

enum {
    SYS_WRITE0 = 0x04,
    SYS_GET_CMDLINE = 0x15,
    SYS_EXIT_EXTENDED = 0x20,
    APPLICATION_EXIT = 0x20026
};

static uint32_t semihosting_call(uint32_t operation, uintptr_t argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register uintptr_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

void cairn_semihosting_write(const char *text)
{
    (void)semihosting_call(SYS_WRITE0, (uintptr_t)text);
}

void cairn_semihosting_command_line(char *buffer, uint32_t size)
{
    uintptr_t block[2] = {(uintptr_t)buffer, size};
    buffer[0] = '\0';
    if (semihosting_call(SYS_GET_CMDLINE, (uintptr_t)block) != 0)
        buffer[0] = '\0';
    buffer[size - 1] = '\0';
}

void cairn_semihosting_exit(int code)
{
    uintptr_t block[2] = {APPLICATION_EXIT, (uintptr_t)code};
    for (;;)
        (void)semihosting_call(SYS_EXIT_EXTENDED, (uintptr_t)block);
}
