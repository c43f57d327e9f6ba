/* Reads scene files for the host's programs. */
#include "host_file.h"

#include <stdio.h>
#include <stdlib.h>

enum { FIRST_SIZE = 65536, LARGEST_SIZE = 16 * 1024 * 1024 };

/* All of a stream, ended with 0; null if it is too long or cannot be read. */
static char *read_all(FILE *stream)
{
    size_t size = FIRST_SIZE;
    size_t length = 0;
    char *text = malloc(size);
    while (text != NULL) {
        length += fread(text + length, 1, size - 1 - length, stream);
        if (length < size - 1) {
            text[length] = '\0';
            break;
        }
        size *= 2;
        char *larger = size > LARGEST_SIZE ? NULL : realloc(text, size);
        if (larger == NULL) {
            free(text);
        }
        text = larger;
    }
    if (text != NULL && ferror(stream)) {
        free(text);
        return NULL;
    }
    return text;
}

cairn_scene_file *host_read_scene(const char *name)
{
    const bool from_stdin = strcmp(name, "-") == 0;
    FILE *stream = from_stdin ? stdin : fopen(name, "rb");
    char *text = stream == NULL ? NULL : read_all(stream);
    if (stream != NULL && !from_stdin) {
        fclose(stream);
    }
    if (text == NULL) {
        fprintf(stderr, "%s: cannot be read\n", name);
        return NULL;
    }
    char error[256];
    cairn_scene_file *file = cairn_scene_file_read(text, error, sizeof error);
    if (file == NULL) {
        fprintf(stderr, "%s: %s\n", name, error);
    }
    free(text);
    return file;
}
