/* A recorded run from a file of numbers, see host_play.h. */
#include "host_play.h"

#include <stdio.h>
#include <stdlib.h>

static bool read_event(FILE *file, cairn_scene_event *event)
{
    unsigned long step = 0;
    unsigned kind = 0, body = 0;
    double x = 0, y = 0;
    if (fscanf(file, "%lu %u %u %lf %lf", &step, &kind, &body, &x, &y) != 5) {
        return false;
    }
    event->step = (uint32_t)step;
    event->kind = (cairn_scene_event_kind)kind;
    event->body = (uint16_t)body;
    event->value = cairn_vec2_of((cairn_real)x, (cairn_real)y);
    return true;
}

static bool read_events(FILE *file, cairn_scene_event *events, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (!read_event(file, &events[i])) {
            return false;
        }
    }
    return true;
}

bool host_read_play(const char *path, runner_options *options, cairn_scene_play *play)
{
    FILE *file = fopen(path, "r");
    unsigned present = 0;
    unsigned long count = 0;
    if (file == NULL) {
        return false;
    }
    const bool begun = fscanf(file, "%u %lu", &present, &count) == 2;
    cairn_scene_event *events = begun ? calloc(count + 1, sizeof *events) : NULL;
    const bool done = events != NULL && read_events(file, events, (uint32_t)count);
    fclose(file);
    if (!done) {
        free(events);
        return false;
    }
    play->count = (uint32_t)count;
    play->events = events;
    options->present = (uint16_t)present;
    options->play = play;
    options->due = cairn_scene_play_due;
    return true;
}

void host_free_play(cairn_scene_play *play) { free((void *)(uintptr_t)play->events); }
