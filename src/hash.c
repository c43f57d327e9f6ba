/* The state hash: FNV-1a over values, never over raw memory, so that byte order and padding do not show. */
#include "engine.h"
#include <cairn/spring.h>

#ifndef CAIRN_DOUBLE

static uint32_t mix(uint32_t hash, uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        hash = (hash ^ (value & 255u)) * 16777619u;
        value >>= 8;
    }
    return hash;
}

static uint32_t mix_body(uint32_t hash, const cairn_body *body)
{
    hash = mix(hash, (uint32_t)body->x);
    hash = mix(hash, (uint32_t)body->y);
    hash = mix(hash, (uint32_t)body->x_residue << 16 | body->y_residue);
    hash = mix(hash, (uint32_t)body->angle);
    hash = mix(hash, (uint32_t)body->vx);
    hash = mix(hash, (uint32_t)body->vy);
    hash = mix(hash, (uint32_t)body->w);
    hash = mix(hash, (uint32_t)(uint16_t)body->vx_carry << 16 | (uint16_t)body->vy_carry);
    return mix(hash, (uint32_t)(body->flags & (CAIRN_BODY_USED | CAIRN_BODY_ASLEEP)) << 16 | body->rest);
}

static uint32_t mix_arbiter(uint32_t hash, const cairn_arbiter *arbiter)
{
    hash = mix(hash, (uint32_t)arbiter->a << 16 | arbiter->b);
    hash = mix(hash, (uint32_t)arbiter->friction_impulse);
    hash = mix(hash, (uint32_t)arbiter->slip);
    for (int i = 0; i < arbiter->count; i++) {
        hash = mix(hash, (uint32_t)arbiter->rows[i].impulse);
        hash = mix(hash, (uint32_t)arbiter->rows[i].load);
        hash = mix(hash, (uint32_t)arbiter->rows[i].gap);
        hash = mix(hash, (uint32_t)cairn_arbiter_exponent(arbiter) << 16 | arbiter->rows[i].feature);
    }
    return hash;
}

uint32_t cairn_world_hash(const cairn_world *world)
{
    uint32_t hash = 2166136261u;
    if (world == NULL) {
        return 0;
    }
    for (uint16_t i = 0; i < world->body_end; i++) {
        hash = mix_body(hash, &world->bodies[i]);
    }
    for (uint16_t place = 0; place < world->arbiter_count; place++) {
        hash = mix_arbiter(hash, cairn_arbiter_at(world, place));
    }
    hash = mix(hash, world->gravity_x.carry);
    hash = mix(hash, world->gravity_y.carry);
    return hash;
}

#else

uint32_t cairn_world_hash(const cairn_world *world)
{
    (void)world;
    return 0; /* doubles have no bits to hold to */
}

#endif
