/*
 * The error of every operation of arith_fixed.h against the host's floating point, in units of the result's last
 * place: largest, root mean square, and the bound that arith_fixed.h states. `arith_errors exhaustive` takes every
 * value of operations with one argument, `arith_errors random` 10^7 seeded arguments of the others and all pairs of edges;
 * without a word it does both; an operation's name takes that alone. Exits with 1 if a bound does not hold. Two threads.
 * A second word is how many arguments in random runs, a third one takes only every so manieth where all could be taken, and `json` as a fourth
 * prints a JSON object a line. With libfixmath at hand its operations are measured beside ours.
 */
#define _POSIX_C_SOURCE 200112L
#include "arith_random.h"
#include "cairn/arith.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846264338327950288L
#define THREADS 2

static uint64_t random_arguments = 10000000, stride = 1;

typedef struct tally {
    double largest, squares;
    uint64_t count;
    int32_t worst_a, worst_b;
} tally;

static inline void note(tally *t, double error, int32_t a, int32_t b)
{
    double size = error < 0 ? -error : error;
    t->squares += error * error;
    t->count++;
    if (size > t->largest) {
        t->largest = size;
        t->worst_a = a;
        t->worst_b = b;
    }
}

static double held(long double x)
{
    return (double)(x > INT32_MAX ? INT32_MAX : x < -INT32_MAX ? -INT32_MAX : x);
}

/* ---- one argument: all arguments of [first, last) ---- */

static void every_root(tally *t, uint64_t first, uint64_t last)
{
    tally own = *t; /* in registers */
    for (uint64_t x = first; x < last; x += stride) {
        note(&own, (double)cairn_real_sqrt((int32_t)x) - 256.0 * sqrt((double)x), (int32_t)x, 0);
    }
    *t = own;
}

static double cosine_high[65536], sine_high[65536], cosine_low[65536], sine_low[65536]; /* of 2^-16 and 2^-32 turns */
static double cosine_whole[65536], sine_whole[65536], cosine_part[65536], sine_part[65536]; /* of whole radians and 2^-16 of one */

static void prepare_rotation(void)
{
    for (int i = 0; i < 65536; i++) {
        long double high = 2 * PI * i / 65536, low = high / 65536;
        cosine_high[i] = (double)cosl(high);
        sine_high[i] = (double)sinl(high);
        cosine_low[i] = (double)cosl(low);
        sine_low[i] = (double)sinl(low);
        cosine_whole[i] = (double)cosl((int16_t)i);
        sine_whole[i] = (double)sinl((int16_t)i);
        cosine_part[i] = (double)cosl(i / 65536.0L);
        sine_part[i] = (double)sinl(i / 65536.0L);
    }
}

/* Not an error but a bug: no bound holds it. */
static void note_wrong(tally *t, int32_t a) { note(t, HUGE_VAL, a, 0); }

/*
 * The quarter turn around 0, by the addition theorem from two tables: the reference is right within 10^-6 units. The
 * other three are the same bits turned, which every fifth argument shows.
 */
static void every_rotation(tally *t, uint64_t first, uint64_t last)
{
    tally own = *t; /* in registers */
    for (uint64_t x = first; x < last; x += stride) {
        uint32_t angle = (uint32_t)x - 0x20000000u, high = angle >> 16, low = angle & 0xFFFFu;
        double c = cosine_high[high] * cosine_low[low] - sine_high[high] * sine_low[low];
        double s = sine_high[high] * cosine_low[low] + cosine_high[high] * sine_low[low];
        cairn_unit cosine, sine;
        cairn_angle_rotation((cairn_angle)angle, &cosine, &sine);
        note(&own, cosine - 1073741824.0 * c, (int32_t)angle, 0);
        note(&own, sine - 1073741824.0 * s, (int32_t)angle, 1);
        for (uint32_t quarter = x % 5 == 0 ? 1 : 4; quarter < 4; quarter++) {
            cairn_unit turned_cosine, turned_sine, was = cosine;
            cairn_angle_rotation((cairn_angle)(angle + (quarter << 30)), &turned_cosine, &turned_sine);
            cosine = -sine;
            sine = was;
            if (turned_cosine != cosine || turned_sine != sine) { note_wrong(&own, (int32_t)angle); }
        }
    }
    *t = own;
}

static void every_angle_in_radians(tally *t, uint64_t first, uint64_t last)
{
    tally own = *t; /* in registers */
    for (uint64_t x = first; x < last; x += stride) {
        int32_t angle = (int32_t)(uint32_t)x;
        note(&own, cairn_angle_radians(angle) - angle * (double)(PI / 32768), angle, 0);
    }
    *t = own;
}

/* 2^16 / 2 pi = 10430 + 0.378...; the whole turns of the reference wrap as well. */
static void every_angle_from_radians(tally *t, uint64_t first, uint64_t last)
{
    tally own = *t; /* in registers */
    for (uint64_t x = first; x < last; x += stride) {
        int32_t radians = (int32_t)(uint32_t)x;
        double part = radians * (double)(32768 / PI - 10430);
        int32_t whole = (int32_t)part;
        uint32_t wrapped = (uint32_t)radians * 10430u + (uint32_t)whole;
        int32_t off = (int32_t)((uint32_t)cairn_angle_from_radians(radians) - wrapped);
        note(&own, off - (part - whole), radians, 0);
    }
    *t = own;
}

/* Sine and cosine as a person writes them: of any number of radians in Q16.16, in Q16.16. The reference as above. */
static void every_sine_of_radians(tally *t, uint64_t first, uint64_t last)
{
    tally own = *t; /* in registers */
    for (uint64_t x = first; x < last; x += stride) {
        int32_t radians = (int32_t)(uint32_t)x;
        uint32_t whole = (uint32_t)x >> 16, part = (uint32_t)x & 0xFFFFu;
        cairn_unit c, s;
        cairn_angle_rotation(cairn_angle_from_radians(radians), &c, &s);
        note(&own, cairn_real_from_unit(s) - 65536.0 * (sine_whole[whole] * cosine_part[part] + cosine_whole[whole] * sine_part[part]), radians, 0);
        note(&own, cairn_real_from_unit(c) - 65536.0 * (cosine_whole[whole] * cosine_part[part] - sine_whole[whole] * sine_part[part]), radians, 1);
    }
    *t = own;
}

/* From 256 up, where the inverse is below 64 units, every 16th. */
static void every_inverse(tally *t, uint64_t first, uint64_t last)
{
    tally own = *t; /* in registers */
    for (uint64_t x = first; x < last; x += x < (1 << 28) ? stride : 16 * stride) {
        double exact = 17179869184.0 / (double)(x + 1); /* 2^14 * 2^20 / f */
        note(&own, cairn_factor_inverse((int32_t)(x + 1)) - (exact > 32767 ? 32767 : exact), (int32_t)(x + 1), 0);
    }
    *t = own;
}

static void every_clz(tally *t, uint64_t first, uint64_t last)
{
    tally own = *t; /* in registers */
    int bits = 0;
    for (uint64_t x = first; x < last; x += stride) {
        while (x >> bits != 0) { bits++; }
        if (cairn_clz((uint32_t)x) != 32 - bits) { note_wrong(&own, (int32_t)(uint32_t)x); }
    }
    own.count += (last - first + stride - 1) / stride;
    *t = own;
}

/* ---- two arguments ---- */

typedef struct arguments {
    int32_t a, b, c, d;
    cairn_wide k, m;
} arguments;

static long double value(cairn_wide k) { return ldexpl((long double)k.mantissa, k.exponent); }

/* In units of the last place at the smallest mantissa, 2^-31 of the value. */
static void note_wide(tally *t, cairn_wide k, long double exact, const arguments *x)
{
    if (exact > 0 && exact < HUGE_VALL) { note(t, (double)((value(k) - exact) / exact * 2147483648.0L), x->a, x->b); }
}

static void mul16(tally *t, const arguments *x)
{
    int16_t b = (int16_t)(x->b % 16385);
    note(t, (double)(cairn_mul16(x->a, b, 14) - (long double)x->a * b / 16384), x->a, b);
}

static void mul32(tally *t, const arguments *x)
{
    note(t, (double)(cairn_mul32(x->a, x->b / 2, 30) - (long double)x->a * (x->b / 2) / 1073741824), x->a, x->b);
}

static void dot16(tally *t, const arguments *x)
{
    int16_t b = (int16_t)(x->b % 16385), d = (int16_t)(x->d % 16385);
    long double exact = ((long double)(x->a / 2) * b + (long double)(x->c / 2) * d) / 16384;
    note(t, (double)(cairn_dot16(x->a / 2, b, x->c / 2, d, 14) - exact), x->a, x->b);
}

static void dot32(tally *t, const arguments *x)
{
    long double exact = ((long double)x->a * (x->b / 4) + (long double)x->c * (x->d / 4)) / 1073741824;
    note(t, (double)(cairn_dot32(x->a, x->b / 4, x->c, x->d / 4, 30) - exact), x->a, x->b);
}

static void real_mul(tally *t, const arguments *x)
{
    note(t, cairn_real_mul(x->a, x->b) - held((long double)x->a * x->b / 65536), x->a, x->b);
}

static void real_divide(tally *t, const arguments *x)
{
    if (x->b != 0) { note(t, cairn_real_divide(x->a, x->b) - held((long double)x->a * 65536 / x->b), x->a, x->b); }
}

static long double length(int32_t x, int32_t y) { return sqrtl((long double)x * x + (long double)y * y); }

static void real_length(tally *t, const arguments *x)
{
    note(t, cairn_real_length(x->a, x->b) - held(length(x->a, x->b)), x->a, x->b);
}

static void geometric_mean(tally *t, const arguments *x)
{
    int32_t a = x->a < 0 ? -x->a : x->a, b = x->b < 0 ? -x->b : x->b;
    note(t, (double)(cairn_real_geometric_mean(a, b) - sqrtl((long double)a * b)), a, b);
}

static void angle_of(tally *t, const arguments *x)
{
    double off;
    if (x->a == 0 && x->b == 0) { return; }
    off = (double)(cairn_angle_of(x->a, x->b) - atan2l(x->a, x->b) * (2147483648.0L / PI));
    note(t, remainder(off, 4294967296.0), x->a, x->b);
}

/* Radians in Q16.16; at the turn's end both signs are right. */
static void angle_in_radians(tally *t, const arguments *x)
{
    double off;
    if (x->a == 0 && x->b == 0) { return; }
    off = (double)(cairn_angle_radians(cairn_angle_of(x->a, x->b)) - atan2l(x->a, x->b) * 65536);
    note(t, remainder(off, (double)(131072 * PI)), x->a, x->b);
}

static void factor_reciprocal(tally *t, const arguments *x)
{
    int32_t f = x->a < 0 ? -x->a : x->a;
    if (f > 0) { note(t, cairn_factor_reciprocal(f) - held(1099511627776.0L / f), f, 0); }
}

static void angle_from_motion(tally *t, const arguments *x)
{
    long double exact = x->a * value(x->k) * (8 / PI);
    if (fabsl(exact) > 4294967296.0L) { return; } /* the error is relative to whole turns: tested by name */
    note(t, remainder((double)(cairn_angle_from_motion(x->a, x->k) - exact), 4294967296.0), x->a, x->b);
}

static void wide_mul(tally *t, const arguments *x) { note_wide(t, cairn_wide_mul(x->k, x->m), value(x->k) * value(x->m), x); }
static void wide_div(tally *t, const arguments *x) { note_wide(t, cairn_wide_div(x->k, x->m), value(x->k) / value(x->m), x); }
static void wide_add(tally *t, const arguments *x) { note_wide(t, cairn_wide_add(x->k, x->m), value(x->k) + value(x->m), x); }
static void wide_sqrt(tally *t, const arguments *x) { note_wide(t, cairn_wide_sqrt(x->k), sqrtl(value(x->k)), x); }

static void wide_scale(tally *t, const arguments *x)
{
    note(t, cairn_wide_scale(x->a, x->k, 0) - held(x->a * value(x->k)), x->a, x->b);
}

static void lever_of(tally *t, const arguments *x)
{
    long double exact = x->a / 512.0L * value(x->k);
    exact = exact > CAIRN_LEVER_MAX ? CAIRN_LEVER_MAX : exact < -CAIRN_LEVER_MAX ? -CAIRN_LEVER_MAX : exact;
    if (value(x->k) < 32768) { note(t, (double)(cairn_lever_of(x->a, x->k) - exact), x->a, x->b); }
}

static void diffused(tally *t, const arguments *x)
{
    cairn_diffused d = cairn_diffused_of(x->a, x->k);
    long double exact = x->a * value(x->k) * 4096;
    long double given = (long double)d.whole + d.fraction / 4294967296.0L;
    if (fabsl(exact) < INT32_MAX) { note(t, (double)((given - exact) * 4294967296.0L), x->a, x->b); }
}

static void offset_fraction(tally *t, const arguments *x)
{
    int32_t a = x->a < 0 ? -x->a : x->a, b = x->b < 0 ? -x->b : x->b;
    int32_t low = a < b ? a : b, high = a < b ? b : a;
    if (high > 0) { note(t, (double)(cairn_offset_fraction(low, high) - (long double)low / high * 1073741824), low, high); }
}

static void unit_along(tally *t, const arguments *x)
{
    long double size = length(x->a, x->b);
    cairn_unit ux, uy;
    if (size > 0) {
        cairn_unit_along(x->a, x->b, &ux, &uy);
        note(t, (double)(ux - x->a / size * 1073741824), x->a, x->b);
        note(t, (double)(uy - x->b / size * 1073741824), x->a, x->b);
    }
}

/* Of a vector of 1 mm or more: both components' error together, over 1. */
static void normalised(tally *t, const arguments *x)
{
    long double size = length(x->a, x->b);
    cairn_unit ux, uy;
    if (size >= 4194) {
        cairn_unit_along(x->a, x->b, &ux, &uy);
        note(t, (double)hypotl(ux / 1073741824.0L - x->a / size, uy / 1073741824.0L - x->b / size), x->a, x->b);
    }
}

static void unit_along_length(tally *t, const arguments *x)
{
    cairn_unit ux, uy;
    note(t, cairn_unit_along(x->a, x->b, &ux, &uy) - held(length(x->a, x->b)), x->a, x->b);
}

static void factor_spin(tally *t, const arguments *x)
{
    int32_t share = x->a & 0x3FFFFFFF, j = x->b % (CAIRN_LEVER_MAX + 1), k = x->c % (CAIRN_LEVER_MAX + 1);
    long double exact = (long double)share * j * k / 68719476736.0L;
    note(t, (double)(cairn_factor_spin(share, (cairn_lever)j, (cairn_lever)k) - exact), share, j);
}

static void motion_factor(tally *t, const arguments *x)
{
    note(t, cairn_motion_factor(x->a, x->b) - held((long double)x->a * x->b / 1048576), x->a, x->b);
}

static void offset_from_motion(tally *t, const arguments *x)
{
    note(t, cairn_offset_from_motion(x->a) - x->a / 64.0, x->a, 0);
}

#ifdef CAIRN_LIBFIXMATH
/* ---- libfixmath: its functions of the same purpose. What it saturates or calls an overflow is not counted against it. ---- */
#include <libfixmath/fixmath.h>

#define THINNED 61 /* of 2^31 or 2^32 arguments, for some of these take long */

static void every_fix16_sqrt(tally *t, uint64_t first, uint64_t last)
{
    for (uint64_t x = first; x < last; x += THINNED * stride) {
        note(t, (double)fix16_sqrt((int32_t)x) - 256.0 * sqrt((double)x), (int32_t)x, 0);
    }
}

static void every_fix16_sine(tally *t, uint64_t first, uint64_t last)
{
    for (uint64_t x = first; x < last; x += THINNED * stride) {
        int32_t radians = (int32_t)(uint32_t)x;
        note(t, fix16_sin(radians) - 65536.0 * sin(radians / 65536.0), radians, 0);
        note(t, fix16_cos(radians) - 65536.0 * cos(radians / 65536.0), radians, 1);
    }
}

static bool is_within_range(long double x) { return x <= INT32_MAX && x >= -INT32_MAX; }

static void fixmath_mul(tally *t, const arguments *x)
{
    long double exact = (long double)x->a * x->b / 65536;
    if (is_within_range(exact)) { note(t, (double)(fix16_mul(x->a, x->b) - exact), x->a, x->b); }
}

static void fixmath_div(tally *t, const arguments *x)
{
    long double exact = x->b == 0 ? HUGE_VALL : (long double)x->a * 65536 / x->b;
    if (is_within_range(exact)) { note(t, (double)(fix16_div(x->a, x->b) - exact), x->a, x->b); }
}

static void fixmath_atan2(tally *t, const arguments *x)
{
    if (x->a == 0 && x->b == 0) { return; }
    note(t, remainder((double)(fix16_atan2(x->a, x->b) - atan2l(x->a, x->b) * 65536), (double)(131072 * PI)), x->a, x->b);
}
#endif

/* ---- the table ---- */

typedef struct operation {
    const char *name, *unit;
    double bound;
    void (*every)(tally *t, uint64_t first, uint64_t last); /* one of the two */
    uint64_t count;
    void (*each)(tally *t, const arguments *x);
} operation;

#define WORDS ((uint64_t)1 << 32)
#define POSITIVE ((uint64_t)1 << 31)
#define QUARTER ((uint64_t)1 << 30)

static const operation operations[] = {
    { "real_sqrt", "2^-16", 0.5, every_root, POSITIVE, NULL },
    { "angle_rotation", "2^-30", 2.7, every_rotation, QUARTER, NULL },
    { "angle_radians", "2^-16", 0.501, every_angle_in_radians, WORDS, NULL },
    { "angle_from_radians", "turn/2^32", 0.52, every_angle_from_radians, WORDS, NULL },
    { "sine and cosine of radians", "2^-16", 0.51, every_sine_of_radians, WORDS, NULL },
    { "factor_inverse", "2^-14", 0.9, every_inverse, POSITIVE - 1, NULL },
    { "clz", "1", 0, every_clz, WORDS, NULL },
    { "mul16 >> 14", "1", 0.5, NULL, 0, mul16 },
    { "mul32 >> 30", "1", 0.5, NULL, 0, mul32 },
    { "dot16", "1", 0.5, NULL, 0, dot16 },
    { "dot32 >> 30", "1", 0.5, NULL, 0, dot32 },
    { "real_mul", "2^-16", 0.5, NULL, 0, real_mul },
    { "real_divide", "2^-16", 0.5, NULL, 0, real_divide },
    { "real_length", "2^-16", 0.5, NULL, 0, real_length },
    { "real_geometric_mean", "2^-16", 0.5, NULL, 0, geometric_mean },
    { "angle_of", "turn/2^32", 1.1, NULL, 0, angle_of },
    { "angle_of, in radians", "2^-16", 0.51, NULL, 0, angle_in_radians },
    { "factor_reciprocal", "2^-20", 0.76, NULL, 0, factor_reciprocal },
    { "angle_from_motion", "turn/2^32", 2.5, NULL, 0, angle_from_motion },
    { "wide_mul", "2^-31 of it", 0.501, NULL, 0, wide_mul },
    { "wide_div", "2^-31 of it", 0.501, NULL, 0, wide_div },
    { "wide_add", "2^-31 of it", 0.501, NULL, 0, wide_add },
    { "wide_sqrt", "2^-31 of it", 0.501, NULL, 0, wide_sqrt },
    { "wide_scale", "1", 0.5, NULL, 0, wide_scale },
    { "lever_of", "2^-13", 1.1, NULL, 0, lever_of },
    { "diffused_of", "2^-60 m", 0.5, NULL, 0, diffused },
    { "offset_fraction", "2^-30", 2, NULL, 0, offset_fraction },
    { "unit_along", "2^-30", 2, NULL, 0, unit_along },
    { "unit_along from 1 mm up", "1", 3e-9, NULL, 0, normalised },
    { "unit_along's length", "2^-22 m", 0.8, NULL, 0, unit_along_length },
    { "factor_spin", "2^-20", 0.55, NULL, 0, factor_spin },
    { "motion_factor", "2^-28 m", 0.5, NULL, 0, motion_factor },
    { "offset_from_motion", "2^-22 m", 0.5, NULL, 0, offset_from_motion },
#ifdef CAIRN_LIBFIXMATH
    { "fix16_mul", "2^-16", HUGE_VAL, NULL, 0, fixmath_mul },
    { "fix16_div", "2^-16", HUGE_VAL, NULL, 0, fixmath_div },
    { "fix16_sqrt", "2^-16", HUGE_VAL, every_fix16_sqrt, POSITIVE, NULL },
    { "fix16_sin and fix16_cos", "2^-16", HUGE_VAL, every_fix16_sine, WORDS, NULL },
    { "fix16_atan2", "2^-16", HUGE_VAL, NULL, 0, fixmath_atan2 },
#endif
};

typedef struct job {
    const operation *what;
    uint32_t index;
    tally result;
} job;

static cairn_wide some_wide(arith_random *r)
{
    return cairn_wide_of(arith_random_argument(r), (int)(arith_random_bits(r) >> 27) - 32);
}

static void run_random(job *j)
{
    arith_random random = arith_random_seeded(100 + j->index);
    uint32_t edges = j->index == 0 ? ARITH_EDGES * ARITH_EDGES : 0;
    for (uint64_t i = 0; i < random_arguments / THREADS + edges; i++) {
        arguments x;
        x.a = i < edges ? arith_edge((uint32_t)i % ARITH_EDGES) : arith_random_argument(&random);
        x.b = i < edges ? arith_edge((uint32_t)i / ARITH_EDGES) : arith_random_argument(&random);
        x.c = arith_random_argument(&random);
        x.d = arith_random_argument(&random);
        x.k = some_wide(&random);
        x.m = some_wide(&random);
        j->what->each(&j->result, &x);
    }
}

static void *run(void *argument)
{
    job *j = (job *)argument;
    if (j->what->every != NULL) {
        j->what->every(&j->result, j->what->count * j->index / THREADS, j->what->count * (j->index + 1) / THREADS);
    } else {
        run_random(j);
    }
    return NULL;
}

static void print(const operation *what, const tally *all, bool right, bool as_json)
{
    double rms = sqrt(all->squares / (double)all->count);
    if (as_json) { /* no bound is stated of what is not ours */
        printf("{\"operation\": \"%s\", \"unit\": \"%s\", \"every_argument\": %s, \"results\": %llu, \"largest\": %.6g, \"rms\": %.6g, ", what->name,
               what->unit, what->every != NULL ? "true" : "false", (unsigned long long)all->count, all->largest, rms);
        printf(what->bound < HUGE_VAL ? "\"bound\": %g, " : "\"bound\": null, ", what->bound);
        printf("\"worst\": [%d, %d]}\n", all->worst_a, all->worst_b);
    } else {
        printf("%-26s %-12s %11.4g %9.4g %9.4g %9.4g  %s(%d, %d)\n", what->name, what->unit, (double)all->count, all->largest, rms, what->bound,
               right ? "" : "TOO LARGE ", all->worst_a, all->worst_b);
    }
    fflush(stdout);
}

/* Prints a line of the table; false if the bound does not hold. */
static bool measure(const operation *what, bool as_json)
{
    pthread_t threads[THREADS];
    job jobs[THREADS];
    tally all = { 0, 0, 0, 0, 0 };
    bool right;
    memset(jobs, 0, sizeof jobs);
    for (uint32_t i = 0; i < THREADS; i++) {
        jobs[i].what = what;
        jobs[i].index = i;
        if (pthread_create(&threads[i], NULL, run, &jobs[i]) != 0) {
            fprintf(stderr, "arith_errors: no thread\n");
            return false;
        }
    }
    for (uint32_t i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        all.squares += jobs[i].result.squares;
        all.count += jobs[i].result.count;
        if (jobs[i].result.largest > all.largest) {
            all.largest = jobs[i].result.largest;
            all.worst_a = jobs[i].result.worst_a;
            all.worst_b = jobs[i].result.worst_b;
        }
    }
    right = all.count > 0 && all.largest <= what->bound;
    print(what, &all, right, as_json);
    return right;
}

static bool is_number(const char *word, uint64_t *number)
{
    char *end;
    *number = strtoull(word, &end, 10);
    return *number > 0 && *end == '\0';
}

int main(int count, char **words)
{
    const char *set = count > 1 ? words[1] : "all";
    bool all = strcmp(set, "all") == 0, right = true, as_json = count > 4 && strcmp(words[4], "json") == 0;
    bool known = count <= (as_json ? 5 : 4) && (count <= 2 || is_number(words[2], &random_arguments)) && (count <= 3 || is_number(words[3], &stride));
    uint32_t measured = 0;
    prepare_rotation();
    if (!as_json) {
        printf("%-26s %-12s %11s %9s %9s %9s  %s\n", "operation", "unit", "results", "largest", "RMS", "bound", "worst at");
    }
    for (uint32_t i = 0; known && i < sizeof operations / sizeof operations[0]; i++) {
        const char *kind = operations[i].every != NULL ? "exhaustive" : "random";
        if (all || strcmp(set, kind) == 0 || strcmp(set, operations[i].name) == 0) {
            right = measure(&operations[i], as_json) && right;
            measured++;
        }
    }
    if (measured == 0) {
        fprintf(stderr, "usage: arith_errors [all|exhaustive|random|OPERATION [RANDOM_ARGUMENTS [STRIDE [json]]]]\n");
        return 2;
    }
    return right ? 0 : 1;
}
