/* The debugger's (or QEMU's) services for a Cortex-M image, by `bkpt 0xab`.
   Source: Arm, "Semihosting for AArch32 and AArch64", 2022. */
#ifndef CAIRN_SEMIHOSTING_H
#define CAIRN_SEMIHOSTING_H

#include <stdint.h>

/* Writes a text that ends with 0. */
void cairn_semihosting_write(const char *text);

/* Fills `buffer` with the command line, image name first; leaves "" if there is none or it is too long. */
void cairn_semihosting_command_line(char *buffer, uint32_t size);

/* How a file is opened: ISO C's "rb" and "wb". */
enum { CAIRN_SEMIHOSTING_READ = 1, CAIRN_SEMIHOSTING_WRITE = 5 };

/* A file's handle, or -1. */
int32_t cairn_semihosting_open(const char *name, uint32_t mode);
void cairn_semihosting_close(int32_t handle);
/* 0, or another number if it cannot. */
int32_t cairn_semihosting_seek(int32_t handle, uint32_t offset);
/* How many of the bytes were not read or written. */
uint32_t cairn_semihosting_read(int32_t handle, void *data, uint32_t size);
uint32_t cairn_semihosting_send(int32_t handle, const void *data, uint32_t size);
/* 0, or another number if it cannot. */
int32_t cairn_semihosting_rename(const char *from, const char *to);

/* Ends the program; does not return. */
void cairn_semihosting_exit(int code);

#endif
