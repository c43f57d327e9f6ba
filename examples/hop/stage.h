/* What the hero's world is made of: plans in flash, used by hop.c. */
#ifndef STAGE_H
#define STAGE_H

#include "hop.h"

enum { LAYER_GROUND = 1, LAYER_HERO = 2, LAYER_LEDGE = 4, LAYER_COIN = 8 };

#define STAGE_HERO_HALF CAIRN_F(0.38)
#define STAGE_LEDGE_HALF CAIRN_F(0.1)
#define STAGE_PLATFORM_LEFT CAIRN_F(5.2)
#define STAGE_PLATFORM_RIGHT CAIRN_F(8.6)

extern const cairn_body_model stage_hero, stage_platform, stage_crate, stage_coin;
/* A ledge that carries, and the same one for a hero below it: he meets it not. Crates meet both. */
extern const cairn_body_model stage_ledge_solid, stage_ledge_open;
extern const cairn_body_model *const stage_grounds[HOP_GROUNDS];
extern const cairn_vec2 stage_ground_at[HOP_GROUNDS], stage_ledge_at[HOP_LEDGES], stage_coin_at[HOP_COINS], stage_crate_at[HOP_CRATES];
extern const cairn_vec2 stage_start, stage_platform_at;

#endif
