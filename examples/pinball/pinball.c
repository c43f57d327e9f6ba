/* See pinball.h. */
#include "pinball.h"

#include "cairn_port.h"

#include <string.h>

enum { BALLS = 3, CHARGE_MAX = 50, GLOW = 12, IDLE_AFTER = 300, BUMPER_POINTS = 100, SLING_POINTS = 20, LAMP_POINTS = 250, LAMPS_POINTS = 2000 };

#define KICK CAIRN_F(4.5)      /* m/s that a bumper adds */
#define LAUNCH_MIN CAIRN_F(9)  /* m/s */
#define LAUNCH_STEP CAIRN_F(0.14)
#define DRAIN CAIRN_F(-0.4)    /* what is lower is lost */
#define LANE CAIRN_F(3.4)
#define LANE_FLOOR CAIRN_F(1.4)

void pinball_start(pinball *p)
{
    const uint32_t best = p->best;
    memset(p, 0, sizeof *p);
    p->best = best;
    p->balls = BALLS;
    p->waiting = true;
    p->camera = CAIRN_F(2.5);
    table_build(&p->table);
}

static cairn_real sign_of(cairn_real x) { return x < 0 ? -1 : x > 0; }

/* Throw the ball away from a part: along the way from its middle, by the longer axis' share. */
static void kick(pinball *p, cairn_body_id from)
{
    cairn_world *world = p->table.world;
    const cairn_vec2 ball = cairn_body_position(world, p->table.ball), part = cairn_body_position(world, from);
    cairn_vec2 way = cairn_vec2_of(ball.x - part.x, ball.y - part.y);
    const cairn_real length = cairn_real_length(way.x, way.y);
    if (length == 0)
        return;
    cairn_vec2 v = cairn_body_velocity(world, p->table.ball);
    v.x += cairn_real_mul(cairn_real_divide(way.x, length), KICK);
    v.y += cairn_real_mul(cairn_real_divide(way.y, length), KICK);
    (void)cairn_body_set_velocity(world, p->table.ball, v);
}

static void light(pinball *p, int lamp)
{
    if ((p->lit >> lamp & 1) != 0)
        return;
    p->lit = (uint8_t)(p->lit | 1 << lamp);
    p->score += LAMP_POINTS;
    if (p->lit == (1 << TABLE_LAMPS) - 1) {
        p->lit = 0;
        p->score += LAMPS_POINTS;
        memset(p->glow, 3 * GLOW, sizeof p->glow);
    }
}

static void touch(pinball *p, cairn_body_id other)
{
    const int part = table_part_of(&p->table, other);
    if (part < 0 || p->glow[part] > GLOW / 2)
        return;
    switch (p->table.kinds[part]) {
    case PART_BUMPER:
        kick(p, other);
        p->score += BUMPER_POINTS;
        break;
    case PART_SLING:
        kick(p, other);
        p->score += SLING_POINTS;
        break;
    case PART_LAMP:
        light(p, p->table.part_count - 1 - part);
        break;
    default:
        return;
    }
    p->glow[part] = GLOW;
}

static void touch_all(pinball *p)
{
    int cursor = 0;
    cairn_body_id other;
    while (cairn_body_next_touched(p->table.world, p->table.ball, &cursor, &other))
        touch(p, other);
}

static void pull_plunger(pinball *p, uint32_t buttons)
{
    const cairn_vec2 at = cairn_body_position(p->table.world, p->table.ball);
    if (!p->waiting)
        return;
    /* The plunger holds the ball where it lies. */
    if (at.y < LANE_FLOOR)
        table_serve(&p->table);
    if ((buttons & CAIRN_BUTTON_SELECT) != 0) {
        if (p->charge < CHARGE_MAX)
            p->charge++;
    } else if (p->charge > 0) {
        (void)cairn_body_set_velocity(p->table.world, p->table.ball, cairn_vec2_of(0, LAUNCH_MIN + p->charge * LAUNCH_STEP));
        p->charge = 0;
        p->waiting = false;
    }
}

static void watch_ball(pinball *p)
{
    const cairn_vec2 at = cairn_body_position(p->table.world, p->table.ball);
    const bool is_back = at.x > LANE && at.y < LANE_FLOOR;
    if (!p->waiting && (at.y < DRAIN || is_back)) {
        if (!is_back)
            p->balls--;
        p->waiting = true;
        table_serve(&p->table);
    }
    const cairn_real goal = at.y < CAIRN_F(2) ? CAIRN_F(2) : at.y > CAIRN_F(11) ? CAIRN_F(11) : at.y;
    p->camera += (goal - p->camera) / 6;
    if (p->score > p->best)
        p->best = p->score;
}

/* With nobody there it plays by itself: it flips what the ball falls on. */
static uint32_t self_play(const pinball *p)
{
    const cairn_vec2 at = cairn_body_position(p->table.world, p->table.ball), v = cairn_body_velocity(p->table.world, p->table.ball);
    if (p->waiting)
        return p->frame % 128 < 24 + (p->frame >> 7 & 15) ? CAIRN_BUTTON_SELECT : 0u;
    if (at.y > CAIRN_F(2.1) || at.y < CAIRN_F(0.9) || v.y > CAIRN_F(1))
        return 0;
    return at.x < CAIRN_F(-0.2) && sign_of(at.x) < 0 ? CAIRN_BUTTON_LEFT : CAIRN_BUTTON_RIGHT;
}

void pinball_step(pinball *p, uint32_t buttons)
{
    const uint32_t pressed = buttons & ~p->before;
    p->before = buttons;
    p->frame++;
    p->idle = (uint16_t)(buttons != 0 ? 0 : p->idle < IDLE_AFTER ? p->idle + 1 : IDLE_AFTER);
    if (p->balls == 0) {
        if ((pressed & CAIRN_BUTTON_SELECT) != 0 || (p->idle == IDLE_AFTER && p->frame % 256 == 0))
            pinball_start(p);
        return;
    }
    if (p->idle == IDLE_AFTER)
        buttons = self_play(p);
    table_flip(&p->table, ((buttons & CAIRN_BUTTON_LEFT) != 0 ? 1u : 0u) | ((buttons & CAIRN_BUTTON_RIGHT) != 0 ? 2u : 0u));
    pull_plunger(p, buttons);
    (void)cairn_world_step(p->table.world);
    for (int i = 0; i < TABLE_PARTS; i++)
        if (p->glow[i] > 0)
            p->glow[i]--;
    touch_all(p);
    watch_ball(p);
}

uint32_t pinball_hash(const pinball *p)
{
    return (cairn_world_hash(p->table.world) * 31 + p->score) * 31 + p->frame;
}
