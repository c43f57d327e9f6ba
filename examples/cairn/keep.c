/* See keep.h. */
#include "keep.h"

#include <string.h>

enum { MAGIC = 0x4361726E /* "Carn" */, LAYOUT = 1 };

static uint32_t checksum(const keep *k)
{
    const uint8_t *bytes = (const uint8_t *)k;
    uint32_t hash = 2166136261u + LAYOUT;
    for (size_t i = offsetof(keep, best); i < sizeof *k; i++)
        hash = (hash ^ bytes[i]) * 16777619u;
    return hash;
}

static void seal(keep *k)
{
    k->magic = MAGIC;
    k->checksum = checksum(k);
}

void keep_take_best(keep *k, const score *s)
{
    memset(k, 0, sizeof *k);
    k->best = s->best;
    seal(k);
}

static void take_stone(keep *k, const game_round *r, const stone *s)
{
    keep_stone *out = &k->stones[k->count];
    const cairn_vec2 at = cairn_body_position(r->world, s->body);
    out->seed = s->seed;
    out->x = at.x;
    out->y = at.y;
    out->angle = cairn_body_angle(r->world, s->body);
    k->count++;
}

void keep_take(keep *k, const game_round *r, const score *s)
{
    memset(k, 0, sizeof *k);
    k->best = s->best;
    k->points = s->points;
    k->streak = s->streak;
    k->random = r->random.state;
    k->wind_a = r->wind.phase_a;
    k->wind_b = r->wind.phase_b;
    k->number = (uint16_t)r->number;
    k->playing = 1;
    k->lives = r->lives;
    k->supply = (uint8_t)(r->supply + (r->current != NULL ? 1 : 0));
    for (int i = 0; i < r->level.piece_count; i++)
        k->piece_angle[i] = cairn_body_angle(r->world, r->pieces[i]);
    for (int i = 0; i < LEVEL_STONES; i++)
        if (r->stones[i].state == STONE_LANDED)
            take_stone(k, r, &r->stones[i]);
    seal(k);
}

bool keep_is_valid(const keep *k)
{
    return k->magic == MAGIC && k->checksum == checksum(k) && k->count <= LEVEL_STONES && k->lives <= ROUND_LIVES_MAX &&
           k->supply <= LEVEL_STONES && (k->playing == 0 || k->lives > 0);
}

void keep_restore(const keep *k, game_round *r, score *s)
{
    s->best = k->best;
    s->points = k->points;
    s->streak = k->streak;
    round_start(r, k->number, 1, k->lives);
    r->random.state = k->random != 0 ? k->random : 1;
    r->wind.phase_a = k->wind_a;
    r->wind.phase_b = k->wind_b;
    r->supply = k->supply;
    for (int i = 0; i < r->level.piece_count; i++)
        (void)cairn_body_set_transform(r->world, r->pieces[i], r->level.pieces[i].position, k->piece_angle[i]);
}

int keep_restore_stones(const keep *k, game_round *r, int from, int count)
{
    int i = from;
    for (; i < k->count && i < from + count; i++)
        (void)round_restore_stone(r, k->stones[i].seed, cairn_vec2_of(k->stones[i].x, k->stones[i].y), k->stones[i].angle);
    return i;
}
