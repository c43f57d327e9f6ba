/*
 * What a game did to a scene while it ran: bodies that came and went, blows and velocities, each after so many steps. With it a
 * run can be had again, as `tools/cairn trim` does with a recorded one; trim_recording.py has the form that files have.
 */
#ifndef CAIRN_SCENE_PLAY_H
#define CAIRN_SCENE_PLAY_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum cairn_scene_event_kind { CAIRN_SCENE_SPAWN, CAIRN_SCENE_REMOVE, CAIRN_SCENE_IMPULSE, CAIRN_SCENE_VELOCITY } cairn_scene_event_kind;

typedef struct cairn_scene_event {
    uint32_t step; /* after so many */
    cairn_scene_event_kind kind;
    uint16_t body;    /* a place in the table, which has those that are spawned behind the first body_count */
    cairn_vec2 value; /* of an impulse, at the centre of mass, N s; of a velocity, m/s */
} cairn_scene_event;

/* In the order of steps. */
typedef struct cairn_scene_play {
    uint32_t count;
    const cairn_scene_event *events;
} cairn_scene_play;

/*
 * Do what is due after so many steps; *next is the next event, 0 at first. ids: one a body of the table, those of the scene
 * as cairn_scene_build gives them. Stops at what fails.
 */
cairn_status cairn_scene_play_due(const cairn_scene_play *play, const cairn_scene *scene, cairn_world *world, cairn_body_id *ids,
                                  uint32_t step, uint32_t *next);

#ifdef __cplusplus
}
#endif

#endif
