/* What an image asks of the machine it runs on: a console, a clock, arguments, an exit, a picture and buttons.
   The engine itself never calls a port. One folder beside this one implements it per board; tests mock it. */
#ifndef CAIRN_PORT_H
#define CAIRN_PORT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The display: rows from the top, two pixels a byte, the left pixel in the high half, 0 black to 15 white. */
#define CAIRN_PORT_DISPLAY_WIDTH 128
#define CAIRN_PORT_DISPLAY_HEIGHT 64
#define CAIRN_PORT_DISPLAY_BYTES (CAIRN_PORT_DISPLAY_WIDTH * CAIRN_PORT_DISPLAY_HEIGHT / 2)

/* Bits of cairn_port_buttons(). */
#define CAIRN_BUTTON_UP 0x01u
#define CAIRN_BUTTON_DOWN 0x02u
#define CAIRN_BUTTON_LEFT 0x04u
#define CAIRN_BUTTON_RIGHT 0x08u
#define CAIRN_BUTTON_SELECT 0x10u

/* Starts the clock and the console. Call it first in main(). */
void cairn_port_init(void);

/* Writes a text that ends with 0 to the console. It adds no line end. */
void cairn_port_write(const char *text);

/* Time since cairn_port_init(), modulo 2^32; take differences. The unit:
   - a board in QEMU under the `-icount` shift of its board.json: one executed instruction, exactly. Two calls in a row
     differ by the cost of a call, the same each time: measure it once and subtract it;
   - the rp2040: one cycle;
   - the host: one nanosecond of a monotonic clock.
   A board's timer is 32 bits wide: read it at least once every 1.3e9 instructions. */
uint32_t cairn_port_clock(void);

/* How many units of cairn_port_clock() make a second of the machine's own time: what a game paces its frames with. */
uint32_t cairn_port_clock_rate(void);

/* The words given to the image after its name, separated by spaces; "" if there are none. */
const char *cairn_port_arguments(void);

/* Ends the image with an exit code of 0 to 255 and does not return. A fault ends it with 100 + the exception number. */
void cairn_port_exit(int code);

/* The most bytes of stack used since reset, or since it was painted; 0 where the machine does not tell (the host). */
uint32_t cairn_port_stack_used(void);

/* Forgets how deep the stack has been: what is called from here on is measured alone. */
void cairn_port_stack_paint(void);

/* The bytes of stack in use where it is called; 0 where the machine does not tell (the host). */
uint32_t cairn_port_stack_now(void);

/* Shows a picture of CAIRN_PORT_DISPLAY_BYTES. Does nothing where there is no display. */
void cairn_port_display(const uint8_t *frame);

/* The buttons held now, a set of CAIRN_BUTTON_...; 0 where there are none. */
uint32_t cairn_port_buttons(void);

/* A number that differs from start to start where the machine has one (the host); else always the same: a game then adds
   the moment of the first press. */
uint32_t cairn_port_seed(void);

/* Data that outlives the image, under a name: a file on the host and, by semihosting, in QEMU; a board on its own gives a
   page of its flash. Reads up to `size` bytes from an offset. Returns how many; 0 at the end; -1 if there is no such data. */
int32_t cairn_port_load(const char *name, uint32_t offset, void *data, uint32_t size);

/* Puts the data in place of what is there: all or, if the machine stops meanwhile, nothing. Returns 0, or -1 if it was not kept.
   A name has at most 120 characters. */
int32_t cairn_port_save(const char *name, const void *data, uint32_t size);

#ifdef __cplusplus
}
#endif

#endif
