/* What a port must do, as an image: each argument asks for one thing, and check_probe.py judges it from outside. */
#include "cairn_port.h"
#include "cairn_print.h"

#include <string.h>

enum { SHORT_LOOP = 1000, LONG_LOOP = 21000, EXIT_CODE = 7, STACK_BYTES = 1024 };

#if defined(__arm__)

/* Two instructions a round. Not inlined: every call must run the same code around the loop. */
__attribute__((noinline)) static uint32_t clock_of_loop(uint32_t rounds)
{
    const uint32_t before = cairn_port_clock();
    __asm__ volatile("1: subs %0, #1\n\tbne 1b" : "+l"(rounds) : : "cc");
    return cairn_port_clock() - before;
}

/* Beyond one wrap of a 24-bit SysTick, where a board has nothing better. */
__attribute__((noinline)) static uint32_t clock_of_many_loops(uint32_t rounds, uint32_t times)
{
    const uint32_t before = cairn_port_clock();
    for (uint32_t i = 0; i < times; i++) {
        uint32_t left = rounds;
        __asm__ volatile("1: subs %0, #1\n\tbne 1b" : "+l"(left) : : "cc");
    }
    return cairn_port_clock() - before;
}

static void print_clock(void)
{
    cairn_print_text("loop ");
    cairn_print_u32(clock_of_loop(LONG_LOOP) - clock_of_loop(SHORT_LOOP));
    cairn_print_text("\nmany ");
    cairn_print_u32(clock_of_many_loops(LONG_LOOP, 1000) - clock_of_many_loops(SHORT_LOOP, 1000));
    cairn_print_text("\nempty");
    for (int i = 0; i < 5; i++) {
        const uint32_t before = cairn_port_clock();
        const uint32_t cost = cairn_port_clock() - before;
        cairn_print_text(" ");
        cairn_print_u32(cost);
    }
    cairn_print_text("\n");
}

static void undefined_instruction(void)
{
    __asm__ volatile("udf #0");
}

/* Deeper than any stack; the array keeps it from becoming a loop. */
static uint32_t recurse(uint32_t depth)
{
    volatile uint32_t local[64];
    local[depth % 64u] = depth;
    return depth == UINT32_MAX ? 0 : recurse(depth + 1u) + local[depth % 64u];
}

static void overflow_stack(void)
{
    cairn_print_u32(recurse(0));
}

#else

static void print_clock(void)
{
    const uint32_t before = cairn_port_clock();
    while (cairn_port_clock() == before) {
    }
    cairn_print_text("clock runs\n");
}

static void undefined_instruction(void)
{
    __builtin_trap();
}

static void overflow_stack(void)
{
    cairn_print_text("not tried on the host\n");
}

#endif

static void use_stack(void)
{
    volatile uint8_t bytes[STACK_BYTES];
    for (uint32_t i = 0; i < STACK_BYTES; i++)
        bytes[i] = (uint8_t)i;
    (void)bytes[0];
}

static void print_stack(void)
{
    const uint32_t before = cairn_port_stack_used();
    use_stack();
    cairn_print_text("stack ");
    cairn_print_u32(before);
    cairn_print_text(" ");
    cairn_print_u32(cairn_port_stack_used());
    cairn_print_text(" ");
    cairn_print_u32(cairn_port_stack_now());
    cairn_port_stack_paint();
    cairn_print_text(" ");
    cairn_print_u32(cairn_port_stack_used());
    cairn_print_text("\n");
}

static void wait_for_button(void)
{
    while (cairn_port_buttons() == 0) {
    }
}

/* A gradient: grey grows by one every 8 pixels to the right. Stays until a button is pressed. */
static void show_picture(void)
{
    static uint8_t frame[CAIRN_PORT_DISPLAY_BYTES];
    for (uint32_t i = 0; i < CAIRN_PORT_DISPLAY_BYTES; i++) {
        const uint32_t grey = (i % (CAIRN_PORT_DISPLAY_WIDTH / 2u)) / 4u;
        frame[i] = (uint8_t)(grey << 4 | grey);
    }
    cairn_port_display(frame);
    cairn_port_write("drawn\n");
    wait_for_button();
}

/* Tells the first button that is held. */
static void print_button(void)
{
    cairn_port_write("ready\n");
    uint32_t held;
    do {
        held = cairn_port_buttons();
    } while (held == 0);
    cairn_print_text("button ");
    cairn_print_u32(held);
    cairn_print_text("\n");
}

static void print_number(int32_t number)
{
    cairn_print_text(" ");
    cairn_print_i32(number);
}

/* What is there before, a long text, a short one in its place from an offset on, behind its end, a place that cannot be written. */
static void try_keep(const char *name)
{
    char text[16] = "";
    cairn_print_text("keep");
    print_number(cairn_port_load(name, 0, text, sizeof text));
    print_number(cairn_port_save(name, "a long text", 11));
    print_number(cairn_port_load(name, 0, text, sizeof text));
    print_number(cairn_port_save(name, "short", 5));
    memset(text, 0, sizeof text);
    print_number(cairn_port_load(name, 2, text, sizeof text));
    cairn_print_text(" ");
    cairn_print_text(text);
    print_number(cairn_port_load(name, 5, text, sizeof text));
    print_number(cairn_port_save("no/such/folder/file", "x", 1));
    cairn_print_text("\n");
}

int main(void)
{
    cairn_port_init();
    const char *arguments = cairn_port_arguments();
    if (strcmp(arguments, "exit") == 0)
        cairn_port_exit(EXIT_CODE);
    else if (strcmp(arguments, "clock") == 0)
        print_clock();
    else if (strcmp(arguments, "fault") == 0)
        undefined_instruction();
    else if (strcmp(arguments, "overflow") == 0)
        overflow_stack();
    else if (strcmp(arguments, "stack") == 0)
        print_stack();
    else if (strncmp(arguments, "keep ", 5) == 0)
        try_keep(arguments + 5);
    else if (strcmp(arguments, "picture") == 0)
        show_picture();
    else if (strcmp(arguments, "button") == 0)
        print_button();
    else {
        cairn_print_text("arguments: ");
        cairn_print_text(arguments);
        cairn_print_text("\n");
    }
    cairn_print_flush();
    return 0;
}
