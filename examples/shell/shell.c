/* See shell.h. */
#include "shell.h"

#include "cairn_port.h"
#include "cairn_print.h"
#include "script.h"
#include "words.h"

#include <stddef.h>

enum {
    STEPS_A_SECOND = 60,
    DRAWN_AT_LEAST = 4, /* one frame of so many is drawn even if the game is late */
    LATE_FRAMES = 8,    /* farther behind than that, the game takes its time */
    BAD_CALL = 2
};

/* What frames cost, in units of the port's clock. */
typedef struct costs {
    uint32_t step, draw, flush, frame; /* worst of each */
    uint32_t worst;                    /* the frame that took most */
    uint32_t sum, rest, count;         /* sum * 256 + rest */
} costs;

static draw_canvas canvas;
static script input;
static shell_words words;
static costs spent;

/* FNV-1a, by Fowler, Noll and Vo. */
static uint32_t picture_hash(void)
{
    uint32_t hash = 2166136261u;
    for (uint32_t i = 0; i < sizeof canvas.pixels; i++)
        hash = (hash ^ canvas.pixels[i]) * 16777619u;
    return hash;
}

static void print_hashes(const char *name, uint32_t frame, const shell_app *app)
{
    cairn_print_text(name);
    cairn_print_u32(frame);
    cairn_print_text(" state ");
    cairn_print_hex32(app->hash());
    cairn_print_text(" picture ");
    cairn_print_hex32(picture_hash());
    cairn_print_text("\n");
}

static void print_picture(uint32_t frame)
{
    static const char digits[] = "0123456789abcdef";
    char line[DRAW_WIDTH + 2];
    cairn_print_text("picture ");
    cairn_print_u32(frame);
    cairn_print_text("\n");
    for (int y = 0; y < DRAW_HEIGHT; y++) {
        for (int x = 0; x < DRAW_WIDTH; x++)
            line[x] = digits[draw_get(&canvas, x, y)];
        line[DRAW_WIDTH] = '\n';
        line[DRAW_WIDTH + 1] = '\0';
        cairn_print_flush();
        cairn_port_write(line);
    }
}

static void note_cost(uint32_t frame, uint32_t step, uint32_t draw, uint32_t flush)
{
    const uint32_t all = step + draw + flush;
    spent.step = step > spent.step ? step : spent.step;
    spent.draw = draw > spent.draw ? draw : spent.draw;
    spent.flush = flush > spent.flush ? flush : spent.flush;
    if (all > spent.frame) {
        spent.frame = all;
        spent.worst = frame;
    }
    spent.rest += all & 255u;
    spent.sum += (all >> 8) + (spent.rest >> 8);
    spent.rest &= 255u;
    spent.count++;
}

static void print_cost(void)
{
    cairn_print_text("cost worst ");
    cairn_print_u32(spent.frame);
    cairn_print_text(" in frame ");
    cairn_print_u32(spent.worst);
    cairn_print_text(" mean ");
    cairn_print_u32(spent.count > 0 ? spent.sum / spent.count * 256u : 0);
    cairn_print_text(" worst step ");
    cairn_print_u32(spent.step);
    cairn_print_text(" drawing ");
    cairn_print_u32(spent.draw);
    cairn_print_text(" flush ");
    cairn_print_u32(spent.flush);
    cairn_print_text(" stack ");
    cairn_print_u32(cairn_port_stack_used());
    cairn_print_text("\n");
}

static int complain(const shell_app *app, const char *what, uint32_t line, const char *error)
{
    cairn_print_text(app->name);
    cairn_print_text(": ");
    if (what[0] != '\0') {
        cairn_print_text(what);
        if (line > 0) {
            cairn_print_text(" line ");
            cairn_print_u32(line);
        }
        cairn_print_text(": ");
    }
    cairn_print_text(error);
    cairn_print_text("\n");
    cairn_print_flush();
    return BAD_CALL;
}

/* A line of a script, where the buttons differ from those of the frame before. */
static void record(uint32_t frame, uint32_t buttons)
{
    static uint32_t before;
    char names[SCRIPT_NAMES];
    if (frame == 1)
        before = 0;
    if (buttons == before)
        return;
    before = buttons;
    script_names(names, buttons);
    cairn_print_text("held ");
    cairn_print_u32(frame);
    cairn_print_text(" ");
    cairn_print_text(names);
    cairn_print_text("\n");
}

static uint32_t buttons_of(uint32_t frame)
{
    const uint32_t buttons = words.input[0] != '\0' ? script_buttons(&input, frame) : cairn_port_buttons();
    if (words.record && input.error == NULL)
        record(frame, buttons);
    return buttons;
}

/* One step and its picture, measured. */
static void play_frame(const shell_app *app, uint32_t frame, uint32_t buttons)
{
    const uint32_t begin = cairn_port_clock();
    app->step(buttons);
    const uint32_t stepped = cairn_port_clock();
    app->draw(&canvas);
    const uint32_t drawn = cairn_port_clock();
    cairn_port_display(canvas.pixels);
    note_cost(frame, stepped - begin, drawn - stepped, cairn_port_clock() - drawn);
}

/* What is asked for of a frame that has been played. */
static void report(const shell_app *app, uint32_t frame)
{
    if (words.every != 0 && frame % words.every == 0)
        print_hashes("frame ", frame, app);
    if (words.dump != 0 && frame % words.dump == 0)
        print_picture(frame);
}

static int finish(const shell_app *app)
{
    print_hashes("end ", words.frames, app);
    if (words.cost)
        print_cost();
    cairn_print_flush();
    return 0;
}

static int run_counted(const shell_app *app)
{
    for (uint32_t frame = 1; frame <= words.frames; frame++) {
        const uint32_t buttons = buttons_of(frame);
        if (input.error != NULL)
            return complain(app, words.input, input.line, input.error);
        play_frame(app, frame, buttons);
        report(app, frame);
    }
    return finish(app);
}

/* At 60 steps a second: a picture where there is time for it, and of the last frame. */
static int run_paced(const shell_app *app)
{
    const uint32_t period = cairn_port_clock_rate() / STEPS_A_SECOND;
    uint32_t due = cairn_port_clock(), undrawn = 0;
    for (uint32_t frame = 1; !words.has_frames || frame <= words.frames; frame++) {
        const uint32_t buttons = buttons_of(frame);
        if (input.error != NULL)
            return complain(app, words.input, input.line, input.error);
        app->step(buttons);
        const bool is_last = words.has_frames && frame == words.frames;
        if (cairn_port_clock() - due < period || ++undrawn >= DRAWN_AT_LEAST || is_last) {
            app->draw(&canvas);
            cairn_port_display(canvas.pixels);
            undrawn = 0;
        }
        report(app, frame);
        due += period;
        if ((int32_t)(cairn_port_clock() - due) > (int32_t)(LATE_FRAMES * period))
            due = cairn_port_clock();
        while ((int32_t)(cairn_port_clock() - due) < 0) {
        }
    }
    return finish(app);
}

int shell_run(const shell_app *app)
{
    const char *error = words_read(&words, cairn_port_arguments());
    if (error != NULL)
        return complain(app, "", 0, error);
    script_open(&input, words.input[0] != '\0' ? words.input : NULL);
    if (input.error != NULL)
        return complain(app, words.input, input.line, input.error);
    draw_clear(&canvas, 0);
    app->start(words.has_seed ? words.seed : cairn_port_seed());
    if (app->resume != NULL && words.keep[0] != '\0')
        app->resume(words.keep);
    return words.has_frames && !words.paced ? run_counted(app) : run_paced(app);
}
