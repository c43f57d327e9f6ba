/* Reading a whole file (or stdin) on the host. */
#ifndef CAIRN_RUNNER_HOST_FILE_H
#define CAIRN_RUNNER_HOST_FILE_H

#include "scene_json.h"

/* The scene in a file, "-" for stdin. Null after a line on stderr. */
cairn_scene_file *host_read_scene(const char *name);

#endif
