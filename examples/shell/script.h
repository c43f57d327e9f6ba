/*
 * A recorded play as text: which buttons are held from which frame on. Lines of a frame number (they rise) and the names of
 * the buttons joined by '+', or "none"; what follows a '#' is a comment:
 *
 *     # drop the first stone
 *     60  right
 *     90  right+select
 *     92  none
 *
 * It is read through cairn_port_load() as it is needed, so a script may be of any length.
 */
#ifndef SHELL_SCRIPT_H
#define SHELL_SCRIPT_H

#include <stdbool.h>
#include <stdint.h>

enum { SCRIPT_CHUNK = 256, SCRIPT_LINE = 80, SCRIPT_NAMES = 32 };

typedef struct script {
    const char *name;   /* null: no script, no button is ever held */
    const char *error;  /* null, or what is wrong with the line `line` */
    uint32_t line;
    uint32_t offset;    /* of what is read next, in the file */
    uint16_t at, count; /* in the chunk */
    bool began, ended;
    uint32_t held;      /* now */
    uint32_t next_frame, next_held; /* the line after */
    char chunk[SCRIPT_CHUNK];
} script;

/* Open a script. On an error script->error is set. name null: without. */
void script_open(script *s, const char *name);

/* The buttons held in a frame; frames are asked for in rising order. 0 once there is an error. */
uint32_t script_buttons(script *s, uint32_t frame);

/* The names of the buttons held, as a script has them, in a buffer of SCRIPT_NAMES. */
void script_names(char *names, uint32_t held);

/* One line of a script: false with `error` set if it is bad. A line without anything sets `empty`. */
bool script_read_line(const char *text, uint32_t *frame, uint32_t *held, bool *empty, const char **error);

#endif
