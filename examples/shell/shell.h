/*
 * What every example's main() is: it reads the image's words, steps the game 60 times a second, draws as often as there is
 * time for, and shows the picture. Without a person: `frames=N input=SCRIPT` plays a script as fast as it goes.
 *
 *     frames=N     end after so many frames; without it the image runs for ever, at 60 frames a second
 *     input=FILE   the buttons, see script.h; without it those of the board
 *     seed=N       of the game's random numbers; without it the port's
 *     keep=FILE    where the game is saved, and resumed from
 *     every=K      a line each K frames: the frame's number, the game's hash and the picture's
 *     dump=K       the picture each K frames, as 64 lines of 128 hexadecimal digits
 *     cost         at the end the worst frame, in units of cairn_port_clock(): physics, drawing, flush
 *     record       a line `held FRAME BUTTONS` where the buttons change: without its first word it is a line of a script
 *     paced        at 60 frames a second even with frames=N; `every` and `dump` then show the last picture that was drawn
 */
#ifndef SHELL_H
#define SHELL_H

#include "canvas.h"

typedef struct shell_app {
    const char *name;
    void (*start)(uint32_t seed);
    void (*step)(uint32_t buttons);        /* 1/60 s */
    void (*draw)(draw_canvas *canvas);
    uint32_t (*hash)(void);                /* of all that decides the game's future */
    void (*resume)(const char *keep);      /* may be null: a file's name is given, once, after start() */
} shell_app;

/* Play. Returns the exit code: 0, or 2 after one line that says what is wrong with a word or the script. */
int shell_run(const shell_app *app);

#endif
