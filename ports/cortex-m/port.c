/* The port interface of every Cortex-M board: console, arguments and exit by semihosting, clock from the board's timer. */
#include "cairn_port.h"

#include "board.h"
#include "semihosting.h"
#include "stack.h"

enum { COMMAND_LINE_SIZE = 512 };

static char command_line[COMMAND_LINE_SIZE];
static uint32_t ticks_start, ticks_low, ticks_high;

void cairn_port_init(void)
{
    ticks_low = 0;
    ticks_high = 0;
    cairn_board_clock_start();
    ticks_start = cairn_board_ticks();
}

void cairn_port_write(const char *text)
{
    cairn_semihosting_write(text);
}

/* instructions = round(ticks * multiplier / 2^shift) of the 64-bit time. Ticks since a first reading are less than one off,
   which is less than half an instruction: the result is exact and never drifts. No branch: each call costs the same. */
uint32_t cairn_port_clock(void)
{
    const uint32_t now = cairn_board_ticks() - ticks_start;
    ticks_high += (uint32_t)(now < ticks_low);
    ticks_low = now;
    const uint64_t ticks = ((uint64_t)ticks_high << 32) | now;
    const uint32_t shift = cairn_board_clock_scale.shift;
    return (uint32_t)((ticks * cairn_board_clock_scale.multiplier + (1u << (shift - 1u))) >> shift);
}

uint32_t cairn_port_clock_rate(void)
{
    return cairn_board_clock_scale.rate;
}

const char *cairn_port_arguments(void)
{
    cairn_semihosting_command_line(command_line, COMMAND_LINE_SIZE);
    const char *text = command_line;
    while (*text != '\0' && *text != ' ')
        text++;
    while (*text == ' ')
        text++;
    return text;
}

void cairn_port_exit(int code)
{
    cairn_semihosting_exit(code);
}

uint32_t cairn_port_stack_used(void)
{
    return cairn_stack_used();
}

void cairn_port_stack_paint(void)
{
    cairn_stack_paint();
}

uint32_t cairn_port_stack_now(void)
{
    return cairn_stack_now();
}
