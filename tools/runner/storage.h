/* How much memory a scene's world is given: the same on the host and in the tables written for firmware. */
#ifndef CAIRN_RUNNER_STORAGE_H
#define CAIRN_RUNNER_STORAGE_H

#include "scene.h"

/* Contacts of a heap are about twice its bodies; four times leaves room for near pairs. */
static inline uint16_t runner_arbiters(const cairn_scene *scene) { return (uint16_t)(4 * scene->body_count + 16); }
static inline uint16_t runner_cells(const cairn_scene *scene) { return (uint16_t)(2 * scene->body_count + 16); }
static inline uint16_t runner_entries(const cairn_scene *scene) { return (uint16_t)(8 * scene->body_count + 16); }

#endif
