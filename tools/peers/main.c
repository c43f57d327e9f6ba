/*
 * Runs the scene on the linked engine for as many steps as the image's one argument says, and prints:
 *
 *   start X Y          of each body, in 2^-16 m, in the order of the scene
 *   cost UNITS         of peer_step() alone, by peer_clock(), once a step
 *   end X Y            of each body
 *   heap BYTES         the most ever taken
 *   stack BYTES        likewise
 *   spare BYTES        the least of peer_spare() after any step
 *   done
 *
 * One program for all engines: what it costs beside the engine is the same for all, and none.c tells how much that is.
 */
#include "peer.h"

#include "cairn_port.h"
#include "cairn_print.h"

static void print_line(const char *name, uint32_t value)
{
    cairn_print_text(name);
    cairn_print_text(" ");
    cairn_print_u32(value);
    cairn_print_text("\n");
}

static void print_places(const char *name)
{
    const int count = peer_body_count();
    for (int i = 0; i < count; i++) {
        const peer_place place = peer_body_place(i);
        cairn_print_text(name);
        cairn_print_text(" ");
        cairn_print_i32(place.x);
        cairn_print_text(" ");
        cairn_print_i32(place.y);
        cairn_print_text("\n");
    }
}

static uint32_t number_of(const char *text)
{
    uint32_t value = 0;
    for (; *text >= '0' && *text <= '9'; text++) {
        value = value * 10 + (uint32_t)(*text - '0');
    }
    return value;
}

static int run(uint32_t steps)
{
    if (!peer_build()) {
        cairn_print_text("error the engine refuses the scene\n");
        return 1;
    }
    print_places("start");
    const uint32_t before = peer_clock();
    const uint32_t clock_cost = peer_clock() - before;
    uint32_t spare = peer_spare();
    for (uint32_t i = 0; i < steps; i++) {
        const uint32_t start = peer_clock();
        peer_step();
        const uint32_t cost = peer_clock() - start - clock_cost;
        print_line("cost", cost);
        if (peer_spare() < spare) {
            spare = peer_spare();
        }
    }
    print_places("end");
    print_line("heap", peer_heap_used());
    print_line("stack", cairn_port_stack_used());
    print_line("spare", spare);
    cairn_print_text("done\n");
    return 0;
}

int main(void)
{
    cairn_port_init();
    const int code = run(number_of(cairn_port_arguments()));
    cairn_print_flush();
    cairn_port_exit(code);
    return code;
}
