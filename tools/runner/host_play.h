/* Reads what was recorded of a run, as tools/cairn_tools/trim_recording.py writes it for this program. */
#ifndef CAIRN_HOST_PLAY_H
#define CAIRN_HOST_PLAY_H

#include "runner.h"

/*
 * A file of numbers: bodies present at the start, events, and of each event step, kind, body, x and y; these two as the
 * arithmetic has them. Sets the options to play them. False, and nothing to free, if there is no such file.
 */
bool host_read_play(const char *path, runner_options *options, cairn_scene_play *play);
void host_free_play(cairn_scene_play *play);

#endif
