/* See hop.h. */
#include "hop.h"

#include "jump.h"
#include "stage.h"

#include "cairn_port.h"

#include <string.h>

#define GRAVITY CAIRN_F(-9)
#define RUN CAIRN_F(3)            /* m/s */
#define RUN_STEP CAIRN_F(0.3)     /* m/s a step */
#define PLATFORM_SPEED CAIRN_F(1)
#define CLEAR CAIRN_F(0.03)       /* feet this far below a ledge's top still stand on it */
#define FALLEN CAIRN_F(-4)

enum { BODIES = 28, ARBITERS = 64, SHOWN_AFTER = 240, ALL_COINS = (1 << HOP_COINS) - 1 };

CAIRN_WORLD(stage, BODIES, ARBITERS);

void hop_start(hop *h)
{
    const uint32_t best = h->best;
    memset(h, 0, sizeof *h);
    h->best = best;
    h->facing = 1;
    h->camera_y = CAIRN_F(1.4);
    h->world = cairn_world_init(&stage, cairn_vec2_of(0, GRAVITY));
    for (int i = 0; i < HOP_GROUNDS; i++)
        h->grounds[i] = cairn_body_create(h->world, stage_grounds[i], stage_ground_at[i], 0);
    for (int i = 0; i < HOP_LEDGES; i++)
        h->ledges[i] = cairn_body_create(h->world, &stage_ledge_open, stage_ledge_at[i], 0);
    for (int i = 0; i < HOP_COINS; i++)
        h->coins[i] = cairn_body_create(h->world, &stage_coin, stage_coin_at[i], 0);
    for (int i = 0; i < HOP_CRATES; i++)
        h->crates[i] = cairn_body_create(h->world, &stage_crate, stage_crate_at[i], 0);
    h->platform = cairn_body_create(h->world, &stage_platform, stage_platform_at, 0);
    h->hero = cairn_body_create(h->world, &stage_hero, stage_start, 0);
}

/* One way: a ledge carries the hero once his feet are above it, and lets him through from below, or when he asks for it. */
static void open_ledges(hop *h, bool drops)
{
    const cairn_vec2 at = cairn_body_position(h->world, h->hero);
    const cairn_real feet = at.y - STAGE_HERO_HALF;
    for (int i = 0; i < HOP_LEDGES; i++) {
        const bool carries = feet > stage_ledge_at[i].y + STAGE_LEDGE_HALF - CLEAR && !drops;
        if (carries == ((h->solid >> i & 1) != 0))
            continue;
        h->solid = (uint8_t)(h->solid ^ 1 << i);
        (void)cairn_body_set_model(h->world, h->ledges[i], carries ? &stage_ledge_solid : &stage_ledge_open);
    }
}

/* What he stands on moves: he runs against that. */
static cairn_real ground_speed(hop *h)
{
    int cursor = 0;
    cairn_body_id other;
    while (cairn_body_next_touched(h->world, h->hero, &cursor, &other))
        if (cairn_body_id_equal(other, h->platform))
            return cairn_body_velocity(h->world, other).x;
    return 0;
}

static void run(hop *h, uint32_t buttons)
{
    const int way = ((buttons & CAIRN_BUTTON_RIGHT) != 0) - ((buttons & CAIRN_BUTTON_LEFT) != 0);
    const cairn_real wish = way * RUN + ground_speed(h);
    cairn_vec2 v = cairn_body_velocity(h->world, h->hero);
    v.x = v.x < wish - RUN_STEP ? v.x + RUN_STEP : v.x > wish + RUN_STEP ? v.x - RUN_STEP : wish;
    if (way != 0)
        h->facing = (int8_t)way;
    (void)cairn_body_set_velocity(h->world, h->hero, v);
}

static void move_platform(hop *h)
{
    const cairn_real x = cairn_body_position(h->world, h->platform).x;
    cairn_real speed = cairn_body_velocity(h->world, h->platform).x;
    if (x >= STAGE_PLATFORM_RIGHT || speed == 0)
        speed = -PLATFORM_SPEED;
    if (x <= STAGE_PLATFORM_LEFT)
        speed = PLATFORM_SPEED;
    (void)cairn_body_set_velocity(h->world, h->platform, cairn_vec2_of(speed, 0));
}

static void take_coins(hop *h)
{
    int cursor = 0;
    cairn_body_id other;
    unsigned touched = 0;
    while (cairn_body_next_touched(h->world, h->hero, &cursor, &other))
        for (int i = 0; i < HOP_COINS; i++)
            if (cairn_body_id_equal(other, h->coins[i]))
                touched |= 1u << i;
    for (int i = 0; i < HOP_COINS; i++)
        if ((touched >> i & 1u) != 0) {
            (void)cairn_body_destroy(h->world, h->coins[i]);
            h->coins[i] = cairn_body_id_null();
            h->got = (uint8_t)(h->got | 1 << i);
        }
}

static void follow(hop *h)
{
    const cairn_vec2 at = cairn_body_position(h->world, h->hero);
    const cairn_real x = at.x + h->facing * CAIRN_F(0.8), y = at.y > CAIRN_F(1.4) ? at.y : CAIRN_F(1.4);
    h->camera_x += (x - h->camera_x) / 12;
    h->camera_y += (y - h->camera_y) / 12;
    if (at.y < FALLEN)
        (void)cairn_body_set_transform(h->world, h->hero, stage_start, 0);
}

void hop_step(hop *h, uint32_t buttons)
{
    const uint32_t pressed = buttons & ~h->before;
    h->before = buttons;
    h->frame++;
    if (h->got == ALL_COINS) {
        if (h->done == 0 && (h->best == 0 || h->clock < h->best))
            h->best = h->clock;
        if (++h->done > SHOWN_AFTER)
            hop_start(h);
    } else {
        h->clock++;
    }
    open_ledges(h, (buttons & CAIRN_BUTTON_DOWN) != 0);
    run(h, buttons);
    if ((pressed & (CAIRN_BUTTON_SELECT | CAIRN_BUTTON_UP)) != 0)
        (void)jump(h->world, h->hero);
    move_platform(h);
    (void)cairn_world_step(h->world);
    take_coins(h);
    follow(h);
}

uint32_t hop_hash(const hop *h)
{
    return (cairn_world_hash(h->world) * 31 + h->got) * 31 + h->frame;
}
