/* See words.h. */
#include "words.h"

#include <stddef.h>
#include <string.h>

/* The rest of a word that begins with this; null if it does not. */
static const char *after(const char *word, const char *start)
{
    const size_t length = strlen(start);
    return strncmp(word, start, length) == 0 ? word + length : NULL;
}

static bool is_end(char c) { return c == '\0' || c == ' '; }

static const char *read_number(const char *text, uint32_t *value, bool *given)
{
    uint32_t number = 0;
    if (is_end(*text))
        return "a number is missing after '='";
    for (; !is_end(*text); text++) {
        if (*text < '0' || *text > '9')
            return "a number has digits only";
        if (number > (UINT32_MAX - 9) / 10)
            return "a number is too large";
        number = 10 * number + (uint32_t)(*text - '0');
    }
    *value = number;
    *given = true;
    return NULL;
}

static const char *read_name(const char *text, char *name)
{
    size_t length = 0;
    for (; !is_end(text[length]); length++) {
        if (length == WORDS_NAME)
            return "a file's name is longer than 120 characters";
        name[length] = text[length];
    }
    name[length] = '\0';
    return length == 0 ? "a file's name is missing after '='" : NULL;
}

static bool is_word(const char *word, const char *name)
{
    const char *rest = after(word, name);
    return rest != NULL && is_end(*rest);
}

static const char *set(bool *given)
{
    *given = true;
    return NULL;
}

static const char *read_word(shell_words *words, const char *word)
{
    const char *value;
    bool given;
    if ((value = after(word, "frames=")) != NULL)
        return read_number(value, &words->frames, &words->has_frames);
    if ((value = after(word, "every=")) != NULL)
        return read_number(value, &words->every, &given);
    if ((value = after(word, "dump=")) != NULL)
        return read_number(value, &words->dump, &given);
    if ((value = after(word, "seed=")) != NULL)
        return read_number(value, &words->seed, &words->has_seed);
    if ((value = after(word, "input=")) != NULL)
        return read_name(value, words->input);
    if ((value = after(word, "keep=")) != NULL)
        return read_name(value, words->keep);
    if (is_word(word, "cost"))
        return set(&words->cost);
    if (is_word(word, "record"))
        return set(&words->record);
    if (is_word(word, "paced"))
        return set(&words->paced);
    return "the words are frames=N every=K dump=K seed=N input=FILE keep=FILE cost record paced";
}

const char *words_read(shell_words *words, const char *text)
{
    memset(words, 0, sizeof *words);
    while (*text != '\0') {
        if (*text == ' ') {
            text++;
            continue;
        }
        const char *error = read_word(words, text);
        if (error != NULL)
            return error;
        while (!is_end(*text))
            text++;
    }
    return NULL;
}
