/*
 * Loads a scene table from a JSON scene file. For the host: it uses the heap, cJSON and, to read numbers, double.
 * tools/cairn_tools/scene.schema.json says the format; the limits checked here are the same.
 */
#ifndef CAIRN_SCENE_JSON_H
#define CAIRN_SCENE_JSON_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cairn_scene_file cairn_scene_file;

/* Reads a JSON text. Null on error; `error` then holds one line that names the field and says what is wrong with it. */
cairn_scene_file *cairn_scene_file_read(const char *text, char *error, size_t error_size);
/* The table, valid until the file is freed. */
const cairn_scene *cairn_scene_file_table(const cairn_scene_file *file);
/* Null is allowed. */
void cairn_scene_file_free(cairn_scene_file *file);

#ifdef __cplusplus
}
#endif

#endif
