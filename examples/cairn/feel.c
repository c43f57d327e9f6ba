/* See feel.h. */
#include "feel.h"

#include <string.h>

#define MILLIMETRES(x) CAIRN_F((x) / 1000.0)
#define FALLING MILLIMETRES(3) /* m a step, each step */
#define POP_RISE MILLIMETRES(12)

enum { GRAIN_LIFE = 26, SPLASH_LIFE = 34, POP_LIFE = 50, THUD_GRAINS_MAX = 10, SPLASH_GRAINS = 12, SPARKS = 4 };

void feel_start(feel *f, uint32_t seed)
{
    memset(f, 0, sizeof *f);
    f->random = random_from(seed);
}

void feel_step(feel *f)
{
    for (int i = 0; i < FEEL_GRAINS; i++) {
        feel_grain *g = &f->grains[i];
        if (g->life == 0)
            continue;
        g->life--;
        g->at.x = cairn_real_add(g->at.x, g->velocity.x);
        g->at.y = cairn_real_add(g->at.y, g->velocity.y);
        if (g->heavy)
            g->velocity.y -= FALLING;
        else
            g->velocity.x -= g->velocity.x / 16;
    }
    for (int i = 0; i < FEEL_POPS; i++)
        if (f->pops[i].life > 0) {
            f->pops[i].life--;
            f->pops[i].at.y = cairn_real_add(f->pops[i].at.y, POP_RISE);
        }
    if (f->shake > 0)
        f->shake--;
}

static void add_grain(feel *f, cairn_vec2 at, cairn_vec2 velocity, int life, bool heavy)
{
    feel_grain *g = &f->grains[f->next_grain];
    f->next_grain = (uint8_t)((f->next_grain + 1) % FEEL_GRAINS);
    g->at = at;
    g->velocity = velocity;
    g->life = (uint8_t)(life - random_between(&f->random, 0, life / 2));
    g->heavy = heavy;
}

static cairn_real random_real(feel *f, cairn_real low, cairn_real high) { return (cairn_real)random_between(&f->random, low, high); }

void feel_thud(feel *f, cairn_vec2 at, cairn_real speed)
{
    int count = 2 + 2 * (int)cairn_real_floor(speed);
    count = count < 2 ? 2 : count > THUD_GRAINS_MAX ? THUD_GRAINS_MAX : count;
    for (int i = 0; i < count; i++) {
        const cairn_real away = random_real(f, MILLIMETRES(10), MILLIMETRES(45));
        const cairn_vec2 velocity = {i % 2 == 0 ? away : -away, random_real(f, MILLIMETRES(2), MILLIMETRES(16))};
        add_grain(f, at, velocity, GRAIN_LIFE, false);
    }
    if (count > 4)
        f->shake = (uint8_t)(count > FEEL_SHAKE_MAX ? FEEL_SHAKE_MAX : count);
}

void feel_splash(feel *f, cairn_vec2 at)
{
    for (int i = 0; i < SPLASH_GRAINS; i++) {
        const cairn_vec2 velocity = {random_real(f, MILLIMETRES(-30), MILLIMETRES(30)), random_real(f, MILLIMETRES(30), MILLIMETRES(70))};
        add_grain(f, at, velocity, SPLASH_LIFE, true);
    }
    f->shake = FEEL_SHAKE_MAX;
}

void feel_sparks(feel *f, cairn_vec2 at)
{
    for (int i = 0; i < SPARKS; i++) {
        const cairn_vec2 velocity = {random_real(f, MILLIMETRES(-40), MILLIMETRES(40)), random_real(f, MILLIMETRES(0), MILLIMETRES(60))};
        add_grain(f, at, velocity, SPLASH_LIFE, true);
    }
}

void feel_points(feel *f, cairn_vec2 at, uint32_t points)
{
    feel_pop *p = &f->pops[f->next_pop];
    f->next_pop = (uint8_t)((f->next_pop + 1) % FEEL_POPS);
    p->at = at;
    p->points = points;
    p->life = POP_LIFE;
}

int feel_shake_x(const feel *f) { return f->shake > 4 ? (f->shake & 2) - 1 : 0; }
int feel_shake_y(const feel *f) { return f->shake > 0 ? ((f->shake & 1) != 0 ? 1 : -1) : 0; }
