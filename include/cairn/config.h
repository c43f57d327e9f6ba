/* Compile-time options, each with its default. Override any of them with -D or with a header named by CAIRN_CONFIG. */
#ifndef CAIRN_CONFIG_H
#define CAIRN_CONFIG_H

#ifdef CAIRN_CONFIG
#include CAIRN_CONFIG
#endif

/* Most vertices of a polygon, 4 (a box has four) to 16. Sets the size of a cairn_polygon and the stack of the narrow phase. */
#ifndef CAIRN_MAX_VERTICES
#define CAIRN_MAX_VERTICES 8
#endif
#if CAIRN_MAX_VERTICES < 4 || CAIRN_MAX_VERTICES > 16
#error "CAIRN_MAX_VERTICES must be 4 to 16"
#endif

/*
 * What a game is sure not to need, the compiler can leave out: 0 for each such feature. Calls that enable it, and models that ask for it, are
 * then refused with CAIRN_ERROR_KIND. What is merely not called is not linked anyway; these take out what the step would ask again and again.
 * `tools/cairn trim` writes such a header from a scene.
 */
#ifndef CAIRN_WITH_SPRINGS
#define CAIRN_WITH_SPRINGS 1
#endif
#ifndef CAIRN_WITH_BOUNCE
#define CAIRN_WITH_BOUNCE 1 /* materials that bounce */
#endif
#ifndef CAIRN_WITH_CONTINUOUS
#define CAIRN_WITH_CONTINUOUS 1 /* worlds that watch fast bodies */
#endif
#ifndef CAIRN_WITH_SLEEP
#define CAIRN_WITH_SLEEP 1
#endif
#ifndef CAIRN_WITH_QUADTREE
#define CAIRN_WITH_QUADTREE 1
#endif
#ifndef CAIRN_WITH_FIXED_POSITION
#define CAIRN_WITH_FIXED_POSITION 1 /* bodies that turn in their place */
#endif
#ifndef CAIRN_WITH_SENSORS
#define CAIRN_WITH_SENSORS 1
#endif
#ifndef CAIRN_WITH_DAMPING
#define CAIRN_WITH_DAMPING 1
#endif
#ifndef CAIRN_WITH_GRAVITY_SCALE
#define CAIRN_WITH_GRAVITY_SCALE 1 /* bodies that fall otherwise than others */
#endif
#ifndef CAIRN_WITH_POLYGONS
#define CAIRN_WITH_POLYGONS 1
#endif
#ifndef CAIRN_WITH_FRICTION
#define CAIRN_WITH_FRICTION 1 /* materials that rub */
#endif
#ifndef CAIRN_WITH_TURNING
#define CAIRN_WITH_TURNING 1 /* bodies that turn: without, all that moves is of fixed rotation */
#endif
/*
 * Boxes and polygons that stand at an angle, or turn. Without, bits are others where a ball slides or rolls past a corner or a round static body:
 * what its normal's last bit does to it is not taken back.
 */
#ifndef CAIRN_WITH_SLOPES
#define CAIRN_WITH_SLOPES 1
#endif
#ifndef CAIRN_WITH_MASSES
#define CAIRN_WITH_MASSES 1 /* without, all that is dynamic is of one shape and one density */
#endif
#ifndef CAIRN_WITH_SETTINGS
#define CAIRN_WITH_SETTINGS 1 /* without, the rate, the sub-steps, the passes and the push-out stay what they are at first */
#endif
/*
 * Solvers (world.h, solver.h): one at least. Without the soft one there are no blocks, no contacts that hold, no quick ways and no impact phase, at
 * half of the flash of a game of boxes and polygons; the bits are those of the full build with the same solver. The others have no sub-steps, so that
 * CAIRN_WITH_SETTINGS 0 allows the soft one alone, or the others without it.
 */
#ifndef CAIRN_WITH_SOFT_SOLVER
#define CAIRN_WITH_SOFT_SOLVER 1
#endif
#ifndef CAIRN_WITH_SLIDES_SOLVER
#define CAIRN_WITH_SLIDES_SOLVER (CAIRN_WITH_SOFT_SOLVER && CAIRN_WITH_SETTINGS)
#endif
#ifndef CAIRN_WITH_SMALL_SOLVER
#define CAIRN_WITH_SMALL_SOLVER (!CAIRN_WITH_SOFT_SOLVER || CAIRN_WITH_SETTINGS)
#endif
#ifndef CAIRN_WITH_BLOCKS
#define CAIRN_WITH_BLOCKS CAIRN_WITH_SOFT_SOLVER
#endif
/* Circles of more than 15 m of radius. Without them the lengths of springs beyond 32 m are off by up to 1.2 um as well. */
#ifndef CAIRN_WITH_GIANTS
#define CAIRN_WITH_GIANTS 1
#endif
/* Springs of no rest length, 1 KB: without, they pull along the line between two points that nearly meet, and jitter. */
#ifndef CAIRN_WITH_PINS
#define CAIRN_WITH_PINS 1
#endif
/*
 * Ropes and nets from centre to centre solved by what their bodies have moved by since their springs' directions and lengths were last computed:
 * 2 KB. Without, these are computed in every sub-step, which takes three times as long, as it does for springs that pull off the centres. Other bits where such springs share
 * bodies, the same on every target; a spring alone is none of them.
 */
#ifndef CAIRN_WITH_QUICK_SPRINGS
#define CAIRN_WITH_QUICK_SPRINGS 1
#endif
/* Bodies kept sorted, to find pairs. Without, each is held against each: to the same bits, and for 16 bodies as quickly, but for 100 not. */
#ifndef CAIRN_WITH_SORT
#define CAIRN_WITH_SORT 1
#endif
/*
 * Ways of their own through the solver's passes for most kinds of contacts, and what else only saves time, at the price of flash: pairs that the
 * quadtree keeps from step to step, springs that take over the coefficients of the one before. Without them the bits are the same. A build for
 * size has none.
 */
#ifndef CAIRN_WITH_QUICK_WAYS
#if defined(__OPTIMIZE_SIZE__) || !CAIRN_WITH_SOFT_SOLVER
#define CAIRN_WITH_QUICK_WAYS 0
#else
#define CAIRN_WITH_QUICK_WAYS 1
#endif
#endif
/*
 * What finds out that contacts and bodies have nothing to do in a step, and leaves them out of it: points that will not meet, bodies that only
 * fall. It only saves time, too, at 1.4 KB: without it the bits are the same. A build for size has none.
 */
#ifndef CAIRN_WITH_SHORTCUTS
#if defined(__OPTIMIZE_SIZE__) || !CAIRN_WITH_SOFT_SOLVER
#define CAIRN_WITH_SHORTCUTS 0
#else
#define CAIRN_WITH_SHORTCUTS 1
#endif
#endif
/*
 * Contacts that hold: rows that serve for more than a step, and the memory of the load that rests on them (hold.c). Without, every contact is looked
 * at anew in every step, which takes time, and what is stacked sinks in deeper: the pyramid of 55 boxes by 2.6 mm in place of 0.3. Other bits than
 * the full build's; the same on every target.
 */
#ifndef CAIRN_WITH_HOLD
#define CAIRN_WITH_HOLD CAIRN_WITH_SOFT_SOLVER
#endif
/* Most points of a contact: 2, or 1 where all that moves is round, which takes a third off an arbiter. */
#ifndef CAIRN_MAX_POINTS
#define CAIRN_MAX_POINTS 2
#endif

#define CAIRN_IS_FLAG(option) ((option) == 0 || (option) == 1)
#if !CAIRN_IS_FLAG(CAIRN_WITH_SPRINGS) || !CAIRN_IS_FLAG(CAIRN_WITH_BOUNCE) || !CAIRN_IS_FLAG(CAIRN_WITH_CONTINUOUS) \
    || !CAIRN_IS_FLAG(CAIRN_WITH_BLOCKS) || !CAIRN_IS_FLAG(CAIRN_WITH_SLEEP) || !CAIRN_IS_FLAG(CAIRN_WITH_QUADTREE) \
    || !CAIRN_IS_FLAG(CAIRN_WITH_SOFT_SOLVER) || !CAIRN_IS_FLAG(CAIRN_WITH_SLIDES_SOLVER) || !CAIRN_IS_FLAG(CAIRN_WITH_SMALL_SOLVER) \
    || !CAIRN_IS_FLAG(CAIRN_WITH_FIXED_POSITION) || !CAIRN_IS_FLAG(CAIRN_WITH_SENSORS) \
    || !CAIRN_IS_FLAG(CAIRN_WITH_DAMPING) || !CAIRN_IS_FLAG(CAIRN_WITH_QUICK_WAYS) \
    || !CAIRN_IS_FLAG(CAIRN_WITH_SHORTCUTS) || !CAIRN_IS_FLAG(CAIRN_WITH_HOLD) || !CAIRN_IS_FLAG(CAIRN_WITH_POLYGONS) \
    || !CAIRN_IS_FLAG(CAIRN_WITH_FRICTION) || !CAIRN_IS_FLAG(CAIRN_WITH_TURNING) || !CAIRN_IS_FLAG(CAIRN_WITH_SLOPES) \
    || !CAIRN_IS_FLAG(CAIRN_WITH_MASSES) || !CAIRN_IS_FLAG(CAIRN_WITH_SETTINGS) || !CAIRN_IS_FLAG(CAIRN_WITH_GIANTS) \
    || !CAIRN_IS_FLAG(CAIRN_WITH_SORT) || !CAIRN_IS_FLAG(CAIRN_WITH_GRAVITY_SCALE) || !CAIRN_IS_FLAG(CAIRN_WITH_PINS) \
    || !CAIRN_IS_FLAG(CAIRN_WITH_QUICK_SPRINGS)
#error "each CAIRN_WITH_... must be 0 or 1"
#endif
#if CAIRN_MAX_POINTS != 1 && CAIRN_MAX_POINTS != 2
#error "CAIRN_MAX_POINTS must be 1 or 2"
#endif
#if !CAIRN_WITH_SOFT_SOLVER && !CAIRN_WITH_SLIDES_SOLVER && !CAIRN_WITH_SMALL_SOLVER
#error "one of CAIRN_WITH_SOFT_SOLVER, CAIRN_WITH_SLIDES_SOLVER and CAIRN_WITH_SMALL_SOLVER must be 1"
#endif
#if !CAIRN_WITH_SOFT_SOLVER && (CAIRN_WITH_BLOCKS || CAIRN_WITH_HOLD || CAIRN_WITH_SHORTCUTS || CAIRN_WITH_QUICK_WAYS)
#error "CAIRN_WITH_SOFT_SOLVER 0 needs CAIRN_WITH_BLOCKS, CAIRN_WITH_HOLD, CAIRN_WITH_SHORTCUTS and CAIRN_WITH_QUICK_WAYS 0"
#endif
#if !CAIRN_WITH_SETTINGS && CAIRN_WITH_SOFT_SOLVER && (CAIRN_WITH_SLIDES_SOLVER || CAIRN_WITH_SMALL_SOLVER)
#error "CAIRN_WITH_SETTINGS 0 needs CAIRN_WITH_SOFT_SOLVER alone, or 0: the others have no sub-steps"
#endif
#if CAIRN_MAX_POINTS == 1 && CAIRN_WITH_BLOCKS
#error "CAIRN_MAX_POINTS 1 needs CAIRN_WITH_BLOCKS 0"
#endif
#if !CAIRN_WITH_SLOPES && CAIRN_WITH_TURNING && CAIRN_MAX_POINTS > 1
#error "CAIRN_WITH_SLOPES 0 needs CAIRN_WITH_TURNING 0 or CAIRN_MAX_POINTS 1"
#endif

/* Called with 0 when an invariant of the library's own is broken. A game may route it or compile it out. */
#ifndef CAIRN_ASSERT
#define CAIRN_ASSERT(condition) ((void)0)
#endif

/* 1 where bytes count and not instructions: what only saves time is left out. The bits are the same. */
#ifdef __OPTIMIZE_SIZE__
#define CAIRN_SMALL 1
#else
#define CAIRN_SMALL 0
#endif

/* For functions whose arguments are mostly constants: they must not become calls, but where branches are counted, or bytes. */
#if defined(CAIRN_INLINE)
#elif defined(__GNUC__) && !CAIRN_SMALL
#define CAIRN_INLINE static inline __attribute__((always_inline))
#else
#define CAIRN_INLINE static inline
#endif

/* For functions that are but another form of a call. */
#if defined(__GNUC__)
#define CAIRN_ALWAYS_INLINE static inline __attribute__((always_inline))
#else
#define CAIRN_ALWAYS_INLINE static inline
#endif

/* For functions with much on the stack beside the deepest calls of their caller: inlined, their frame would lie under those. */
#if defined(__GNUC__)
#define CAIRN_APART static __attribute__((noinline))
#else
#define CAIRN_APART static
#endif

/* The same for functions of a header. */
#if defined(__GNUC__) && defined(__OPTIMIZE_SIZE__)
#define CAIRN_SHARED static __attribute__((noinline, unused))
#else
#define CAIRN_SHARED static inline
#endif

/* For functions of one file that gcc would copy to where they are called: one copy of them where bytes count and that is smaller. */
#if defined(__GNUC__) && defined(__OPTIMIZE_SIZE__)
#define CAIRN_ONCE static __attribute__((noinline))
#else
#define CAIRN_ONCE static
#endif

#endif
