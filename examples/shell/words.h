/* The words that an image of the examples takes, see shell.h. */
#ifndef SHELL_WORDS_H
#define SHELL_WORDS_H

#include <stdbool.h>
#include <stdint.h>

enum { WORDS_NAME = 120 };

typedef struct shell_words {
    uint32_t frames, every, dump, seed;
    bool has_frames, has_seed, cost, record, paced;
    char input[WORDS_NAME + 1], keep[WORDS_NAME + 1]; /* "": not given */
} shell_words;

/* Read the words of cairn_port_arguments(). Returns null, or what is wrong. */
const char *words_read(shell_words *words, const char *text);

#endif
