/* See bot.h. */
#include "bot.h"

#include "cairn_port.h"

#define NEAR CAIRN_F(0.05)
#define CALM CAIRN_F(0.12)
#define FLAT CAIRN_DEGREES(3)
#define TOP_LAYER CAIRN_F(0.1)

enum { PATIENCE = 420, BEAT = 3 };

/* Where the next stone should go: over the highest stone, or where the level says. */
static cairn_real aim(const game_round *r)
{
    cairn_real x = r->level.aim, top = TOP_LAYER;
    for (int i = 0; i < LEVEL_STONES; i++) {
        const stone *s = &r->stones[i];
        if (s->state == STONE_LANDED && s->top > top) {
            top = s->top;
            x = cairn_body_center(r->world, s->body).x;
        }
    }
    return x;
}

static uint32_t steer(cairn_real way, cairn_real speed)
{
    /* Slow down in time: as if it were where it will be in a third of a second. */
    const cairn_real ahead = way - speed / 3;
    return ahead > NEAR ? CAIRN_BUTTON_RIGHT : ahead < -NEAR ? CAIRN_BUTTON_LEFT : 0u;
}

uint32_t bot_buttons(const game_round *r, uint32_t frame)
{
    if (r->state != ROUND_HANGING)
        return 0;
    const cairn_real goal = aim(r);
    const cairn_vec2 trolley = cairn_body_position(r->world, r->crane.trolley), pull = cairn_body_velocity(r->world, r->crane.trolley);
    const cairn_vec2 load = cairn_body_center(r->world, r->current->body), swing = cairn_body_velocity(r->world, r->current->body);
    const cairn_angle flat = stone_flat_angle(r->current);
    const cairn_angle lean = (cairn_angle)((uint32_t)cairn_body_angle(r->world, r->current->body) - (uint32_t)flat);
    uint32_t buttons = steer(goal - trolley.x, pull.x);
    const bool is_flat = lean < FLAT && lean > -FLAT;
    if (!is_flat)
        buttons |= lean < 0 ? CAIRN_BUTTON_UP : CAIRN_BUTTON_DOWN;
    const bool is_over = cairn_real_is_within(load.x - goal, NEAR) && cairn_real_is_within(swing.x, CALM);
    /* In wind nothing hangs still: after a while a fair moment will do. */
    const bool is_fair = frame % PATIENCE < BEAT && cairn_real_is_within(load.x - goal, 3 * NEAR);
    if (r->held == 0 && is_flat && (is_over || is_fair) && frame % BEAT == 0)
        buttons |= CAIRN_BUTTON_SELECT;
    return buttons;
}
