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

/* Called with 0 when an invariant of the library's own is broken. A game may route it or compile it out. */
#ifndef CAIRN_ASSERT
#define CAIRN_ASSERT(condition) ((void)0)
#endif

/* For functions whose arguments are mostly constants: they must not become calls, but where branches are counted. */
#if defined(CAIRN_INLINE)
#elif defined(__GNUC__)
#define CAIRN_INLINE static inline __attribute__((always_inline))
#else
#define CAIRN_INLINE static inline
#endif

/* For functions with much on the stack beside the deepest calls of their caller: inlined, their frame would lie under those. */
#if defined(__GNUC__)
#define CAIRN_APART static __attribute__((noinline))
#else
#define CAIRN_APART static
#endif

#endif
