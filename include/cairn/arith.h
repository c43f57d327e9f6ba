/*
 * The numbers of Cairn: one type per quantity, one definition per operation.
 *
 * The engine is written once in these types. Normally they are fixed point (arith_fixed.h). With CAIRN_DOUBLE
 * defined, on the host only, the same source is compiled in double precision (arith_double.h), so that comparing
 * the two builds shows rounding and nothing else.
 *
 * type          fixed point          quantity
 * cairn_real    Q16.16               what a person writes: metres, seconds, newtons (+-32768, step 1.5e-5)
 * cairn_angle   32-bit binary angle  one turn is 2^32; wraps (step 1.5e-9 rad)
 * cairn_motion  Q4.28                sub-step units: velocity * h, impulse * h / mass, displacement (+-8 m, step 3.7e-9)
 * cairn_offset  Q10.22               vectors between bodies and their vertices (+-512 m, step 2.4e-7)
 * cairn_unit    Q2.30                components of unit vectors and rotations
 * cairn_dir     Q1.14 in 16 bits     the same inside of the solver's sweeps
 * cairn_heading 16 bits of an angle  which way a body looked, to compare (step 9.6e-5 rad)
 * cairn_lever   Q2.13 in 16 bits     lever arm over radius of gyration (+-2.83)
 * cairn_ratio   Q1.14 in 16 bits     effective masses and scales in [0, 2)
 * cairn_share   Q2.30                a body's share of a relative velocity change, in [0, 1]
 * cairn_grip    Q11.20               friction coefficients
 * cairn_push    Q35.28 in 64 bits   impulses and velocities of a block, see block.h (+-524288 m)
 * cairn_wide    32-bit mantissa and exponent   positive magnitudes of any size: masses, inertias, stiffness; set-up only
 * cairn_extent  Q8.8 in 16 bits      half sizes of bounding boxes, rounded up
 * cairn_packed  24-bit mantissa and exponent   a cairn_wide in 32 bits, as a body keeps it
 *
 * Values of one type may be added, subtracted, negated and compared with C's own operators where their range
 * allows it; everything else goes through the operations named here.
 */
#ifndef CAIRN_ARITH_H
#define CAIRN_ARITH_H

#include "config.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef CAIRN_DOUBLE
#include "arith_double.h"
#else
#include "arith_fixed.h"
#endif

/* A pair of API numbers: metres, metres per second, newtons ... */
typedef struct cairn_vec2 {
    cairn_real x, y;
} cairn_vec2;

static inline cairn_vec2 cairn_vec2_of(cairn_real x, cairn_real y)
{
    cairn_vec2 v;
    v.x = x;
    v.y = y;
    return v;
}

#endif
