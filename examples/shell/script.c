/* See script.h. */
#include "script.h"

#include "cairn_port.h"

#include <stddef.h>
#include <string.h>

static const struct {
    const char *name;
    uint32_t button;
} button_names[] = {
    {"none", 0}, {"up", CAIRN_BUTTON_UP}, {"down", CAIRN_BUTTON_DOWN}, {"left", CAIRN_BUTTON_LEFT},
    {"right", CAIRN_BUTTON_RIGHT}, {"select", CAIRN_BUTTON_SELECT},
};

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

static const char *skip_blanks(const char *text)
{
    while (is_blank(*text))
        text++;
    return text;
}

static bool is_end(char c) { return c == '\0' || c == '#'; }

static const char *read_frame(const char *text, uint32_t *frame)
{
    uint32_t value = 0;
    const char *start = text;
    for (; *text >= '0' && *text <= '9'; text++) {
        if (value > (UINT32_MAX - 9) / 10)
            return NULL;
        value = 10 * value + (uint32_t)(*text - '0');
    }
    *frame = value;
    return text == start || !(is_blank(*text) || is_end(*text)) ? NULL : text;
}

/* One button's name; null if there is none here. */
static const char *read_button(const char *text, uint32_t *held)
{
    size_t length = 0;
    while (text[length] >= 'a' && text[length] <= 'z')
        length++;
    for (size_t i = 0; i < sizeof button_names / sizeof button_names[0]; i++)
        if (length == strlen(button_names[i].name) && strncmp(text, button_names[i].name, length) == 0) {
            *held |= button_names[i].button;
            return text + length;
        }
    return NULL;
}

static const char *read_buttons(const char *text, uint32_t *held)
{
    *held = 0;
    text = read_button(text, held);
    while (text != NULL && *text == '+')
        text = read_button(text + 1, held);
    return text;
}

bool script_read_line(const char *text, uint32_t *frame, uint32_t *held, bool *empty, const char **error)
{
    text = skip_blanks(text);
    *empty = is_end(*text);
    if (*empty)
        return true;
    text = read_frame(text, frame);
    *error = "a line begins with a frame number";
    if (text == NULL)
        return false;
    text = read_buttons(skip_blanks(text), held);
    *error = "buttons are up, down, left, right, select, joined by '+', or none";
    if (text == NULL || !is_end(*skip_blanks(text)))
        return false;
    *error = NULL;
    return true;
}

void script_names(char *names, uint32_t held)
{
    const size_t count = sizeof button_names / sizeof button_names[0];
    *names = '\0';
    for (size_t i = 1; i < count; i++)
        if ((held & button_names[i].button) != 0) {
            if (*names != '\0')
                strcat(names, "+");
            strcat(names, button_names[i].name);
        }
    if (*names == '\0')
        strcat(names, button_names[0].name);
}

/* The file's next character; false at its end or at an error. */
static bool next_character(script *s, char *c)
{
    if (s->at == s->count) {
        const int32_t count = cairn_port_load(s->name, s->offset, s->chunk, SCRIPT_CHUNK);
        if (count < 0)
            s->error = "cannot be read";
        if (count <= 0)
            return false;
        s->at = 0;
        s->count = (uint16_t)count;
        s->offset += (uint32_t)count;
    }
    *c = s->chunk[s->at++];
    return true;
}

/* The file's next line, without its end; false if there is none. */
static bool next_line(script *s, char *text)
{
    size_t length = 0;
    char c = '\0';
    bool any = false;
    while (next_character(s, &c)) {
        any = true;
        if (c == '\n')
            break;
        if (length == SCRIPT_LINE - 1 || c == '\0') {
            s->line++;
            s->error = c == '\0' ? "this is no text" : "a line is longer than 79 characters";
            return false;
        }
        text[length++] = c;
    }
    text[length] = '\0';
    if (any)
        s->line++;
    return any && s->error == NULL;
}

/* Find the next line with something in it. */
static void advance(script *s)
{
    char text[SCRIPT_LINE];
    const uint32_t last = s->next_frame;
    const bool is_first = !s->began;
    bool empty = true;
    while (empty) {
        if (!next_line(s, text)) {
            s->ended = true;
            return;
        }
        if (!script_read_line(text, &s->next_frame, &s->next_held, &empty, &s->error)) {
            s->ended = true;
            return;
        }
    }
    s->began = true;
    if (!is_first && s->next_frame <= last) {
        s->error = "frame numbers must rise";
        s->ended = true;
    }
}

void script_open(script *s, const char *name)
{
    memset(s, 0, sizeof *s);
    s->name = name;
    s->ended = name == NULL;
    if (name != NULL)
        advance(s);
}

uint32_t script_buttons(script *s, uint32_t frame)
{
    while (!s->ended && s->next_frame <= frame) {
        s->held = s->next_held;
        advance(s);
    }
    return s->error != NULL ? 0 : s->held;
}
