/* Prints numbers on the port's console without printf, a line at a time: one call of the port per line, not per number. */
#ifndef CAIRN_PRINT_H
#define CAIRN_PRINT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Each appends to the current line. A line goes to the console when it ends with '\n', or in parts when it is long. */
void cairn_print_text(const char *text);
void cairn_print_u32(uint32_t value);
void cairn_print_i32(int32_t value);
void cairn_print_u64(uint64_t value);
void cairn_print_i64(int64_t value);

/* 8 and 16 lower-case hexadecimal digits, without a prefix. */
void cairn_print_hex32(uint32_t value);
void cairn_print_hex64(uint64_t value);

/* Sends an unfinished line. Call it before cairn_port_exit(). */
void cairn_print_flush(void);

#ifdef __cplusplus
}
#endif

#endif
