/* Plays what was recorded of a run: the same function on the host and in firmware. */
#include "scene_play.h"

static cairn_status spawn(const cairn_scene *scene, cairn_world *world, cairn_body_id *ids, uint16_t place)
{
    ids[place] = cairn_scene_add_body(scene, world, place);
    return cairn_body_id_is_null(ids[place]) ? cairn_world_error(world) : CAIRN_OK;
}

static cairn_status happen(const cairn_scene_event *event, const cairn_scene *scene, cairn_world *world, cairn_body_id *ids)
{
    switch (event->kind) {
    case CAIRN_SCENE_SPAWN:
        return spawn(scene, world, ids, event->body);
    case CAIRN_SCENE_REMOVE:
        return cairn_body_destroy(world, ids[event->body]);
    case CAIRN_SCENE_IMPULSE:
        return cairn_body_apply_impulse(world, ids[event->body], event->value);
    case CAIRN_SCENE_VELOCITY:
        return cairn_body_set_velocity(world, ids[event->body], event->value);
    }
    return CAIRN_ERROR_RANGE;
}

cairn_status cairn_scene_play_due(const cairn_scene_play *play, const cairn_scene *scene, cairn_world *world, cairn_body_id *ids,
                                  uint32_t step, uint32_t *next)
{
    cairn_status status = CAIRN_OK;
    while (status == CAIRN_OK && *next < play->count && play->events[*next].step <= step) {
        status = happen(&play->events[*next], scene, world, ids);
        *next += 1;
    }
    return status;
}
