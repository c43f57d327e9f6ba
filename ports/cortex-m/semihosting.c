/* Semihosting calls of a Cortex-M: operation in r0, argument or its address in r1, result in r0. */
#include "semihosting.h"

enum {
    SYS_OPEN = 0x01,
    SYS_CLOSE = 0x02,
    SYS_WRITE0 = 0x04,
    SYS_WRITE = 0x05,
    SYS_READ = 0x06,
    SYS_SEEK = 0x0A,
    SYS_RENAME = 0x0F,
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

static uint32_t length_of(const char *text)
{
    uint32_t length = 0;
    while (text[length] != '\0')
        length++;
    return length;
}

int32_t cairn_semihosting_open(const char *name, uint32_t mode)
{
    uintptr_t block[3] = {(uintptr_t)name, mode, length_of(name)};
    return (int32_t)semihosting_call(SYS_OPEN, (uintptr_t)block);
}

void cairn_semihosting_close(int32_t handle)
{
    uintptr_t block[1] = {(uintptr_t)handle};
    (void)semihosting_call(SYS_CLOSE, (uintptr_t)block);
}

int32_t cairn_semihosting_seek(int32_t handle, uint32_t offset)
{
    uintptr_t block[2] = {(uintptr_t)handle, offset};
    return (int32_t)semihosting_call(SYS_SEEK, (uintptr_t)block);
}

uint32_t cairn_semihosting_read(int32_t handle, void *data, uint32_t size)
{
    uintptr_t block[3] = {(uintptr_t)handle, (uintptr_t)data, size};
    return semihosting_call(SYS_READ, (uintptr_t)block);
}

uint32_t cairn_semihosting_send(int32_t handle, const void *data, uint32_t size)
{
    uintptr_t block[3] = {(uintptr_t)handle, (uintptr_t)data, size};
    return semihosting_call(SYS_WRITE, (uintptr_t)block);
}

int32_t cairn_semihosting_rename(const char *from, const char *to)
{
    uintptr_t block[4] = {(uintptr_t)from, length_of(from), (uintptr_t)to, length_of(to)};
    return (int32_t)semihosting_call(SYS_RENAME, (uintptr_t)block);
}

void cairn_semihosting_exit(int code)
{
    uintptr_t block[2] = {APPLICATION_EXIT, (uintptr_t)code};
    for (;;)
        (void)semihosting_call(SYS_EXIT_EXTENDED, (uintptr_t)block);
}
