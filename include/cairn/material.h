/* What a surface is made of. Materials are plain constant data: declare them `static const` and share them. */
#ifndef CAIRN_MATERIAL_H
#define CAIRN_MATERIAL_H

#include "arith.h"

#ifdef __cplusplus
extern "C" {
#endif

struct cairn_world;

/* The stage of the step that makes bodies bounce. It is linked only where a material names it. */
typedef struct cairn_bounce_class {
    void (*impact)(struct cairn_world *world, int substep);
} cairn_bounce_class;

extern const cairn_bounce_class cairn_bounce;

/*
 * static_friction, kinetic_friction: Coulomb's coefficients, 0 to 64; kinetic at most static.
 * restitution: 0 (no rebound) to 1 (no loss). A pair takes the larger of the two.
 * threshold: approach speed in m/s below which the pair does not rebound; may be 0. (What gravity gives
 * in a step is always rest.) A pair takes the smaller of those of its bouncing materials.
 * Pairs take the geometric mean of the frictions.
 */
typedef struct cairn_material {
    cairn_factor static_friction, kinetic_friction;
    cairn_factor restitution;
    cairn_real threshold;
    const cairn_bounce_class *bounce; /* CAIRN_BOUNCE_CLASS where restitution > 0, or impacts are to keep momentum exactly; else null */
} cairn_material;

/* What a material that bounces names: nothing where there is no soft solver, since the others have restitution of their own. */
#if CAIRN_WITH_SOFT_SOLVER
#define CAIRN_BOUNCE_CLASS &cairn_bounce
#else
#define CAIRN_BOUNCE_CLASS NULL
#endif
/* Initialisers from plain numbers. */
#define CAIRN_MATERIAL(static_friction, kinetic_friction) \
    { CAIRN_FACTOR(static_friction), CAIRN_FACTOR(kinetic_friction), 0, 0, NULL }
#define CAIRN_MATERIAL_BOUNCING(static_friction, kinetic_friction, restitution, threshold) \
    { CAIRN_FACTOR(static_friction), CAIRN_FACTOR(kinetic_friction), CAIRN_FACTOR(restitution), CAIRN_F(threshold), CAIRN_BOUNCE_CLASS }

extern const cairn_material cairn_material_default; /* 0.5, 0.4, no rebound */
extern const cairn_material cairn_material_ice;     /* 0.05, 0.02, no rebound */
extern const cairn_material cairn_material_metal;   /* 0.6, 0.4, rebound 0.1 */
extern const cairn_material cairn_material_jelly;   /* 0.9, 0.7, rebound 0.6 */

#ifdef __cplusplus
}
#endif

#endif
