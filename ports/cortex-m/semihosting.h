/* The debugger's (or QEMU's) services for a Cortex-M image, by `bkpt 0xab`.
   Source: Arm, "Semihosting for AArch32 and AArch64", 2022. */
#ifndef CAIRN_SEMIHOSTING_H
#define CAIRN_SEMIHOSTING_H

#include <stdint.h>

/* Writes a text that ends with 0. */
void cairn_semihosting_write(const char *text);

/* Fills `buffer` with the command line, image name first; leaves "" if there is none or it is too long. */
void cairn_semihosting_command_line(char *buffer, uint32_t size);

/* Ends the program; does not return. */
void cairn_semihosting_exit(int code);

#endif
