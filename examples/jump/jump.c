/* See jump.h. Its test, test_jump.c, runs it without physics: every call of the engine is a mock. */
#include "jump.h"

static bool stands_on_something(cairn_world *world, cairn_body_id player)
{
    int cursor = 0;
    cairn_body_id other;
    while (cairn_body_next_touched(world, player, &cursor, &other))
        if (!cairn_body_is_sensor(world, other))
            return true;
    return false;
}

bool jump(cairn_world *world, cairn_body_id player)
{
    return stands_on_something(world, player) &&
           cairn_body_apply_impulse(world, player, cairn_vec2_of(0, JUMP_IMPULSE)) == CAIRN_OK;
}
