/*
 * Runs the scene on the linked engine by the image's arguments, which are whole numbers in this order, and 0 where left out:
 *
 *   STEPS              of the run
 *   EVERY              print the places after each so many steps; 0: never
 *   ITERATIONS         of the engine's solver; 0: its own by default
 *   RATE               steps per second; 0: the scene's own
 *
 * and prints:
 *
 *   start X Y          of each body, in 2^-16 m, in the order of the scene
 *   state STEP         if asked for; then a line "X Y ANGLE" of each body, the angle in 2^-16 radians
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

static void print_state(uint32_t step)
{
    print_line("state", step);
    for (int i = 0; i < peer_body_count(); i++) {
        const peer_place place = peer_body_place(i);
        cairn_print_i32(place.x);
        cairn_print_text(" ");
        cairn_print_i32(place.y);
        cairn_print_text(" ");
        cairn_print_i32(place.angle);
        cairn_print_text("\n");
    }
}

/* The next number of the text, and the text behind it; 0 where there is none. */
static uint32_t take_number(const char **text)
{
    uint32_t value = 0;
    while (**text == ' ') {
        (*text)++;
    }
    for (; **text >= '0' && **text <= '9'; (*text)++) {
        value = value * 10 + (uint32_t)(**text - '0');
    }
    return value;
}

static int run(uint32_t steps, uint32_t every, peer_wish wish)
{
    if (!peer_build(wish)) {
        cairn_print_text("error the engine refuses the scene\n");
        return 1;
    }
    print_places("start");
    const uint32_t before = peer_clock();
    const uint32_t clock_cost = peer_clock() - before;
    uint32_t spare = peer_spare();
    if (every > 0) {
        print_state(0);
    }
    for (uint32_t i = 0; i < steps; i++) {
        const uint32_t start = peer_clock();
        peer_step();
        const uint32_t cost = peer_clock() - start - clock_cost;
        print_line("cost", cost);
        if (every > 0 && (i + 1) % every == 0) {
            print_state(i + 1);
        }
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
    const char *words = cairn_port_arguments();
    const uint32_t steps = take_number(&words);
    const uint32_t every = take_number(&words);
    peer_wish wish;
    wish.iterations = (int)take_number(&words);
    const uint32_t rate = take_number(&words);
    wish.step = rate > 0 ? 1.0f / (float)rate : 0.0f;
    const int code = run(steps, every, wish);
    cairn_print_flush();
    cairn_port_exit(code);
    return code;
}
