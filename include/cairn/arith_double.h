/*
 * The double-precision definition of every operation of arith_fixed.h: the same names, no rounding. For the host
 * only, and the only place of the engine that knows floating point. Limits that are part of the algorithm (speed
 * caps, clamps to a lever's bound) are kept; limits of a format are not.
 */
#ifndef CAIRN_ARITH_DOUBLE_H
#define CAIRN_ARITH_DOUBLE_H

#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef double cairn_real;
typedef double cairn_angle; /* radians, unbounded */
typedef double cairn_motion;
typedef double cairn_offset;
typedef double cairn_unit;
typedef double cairn_dir;
typedef double cairn_heading;
typedef int16_t cairn_lean; /* none */
typedef double cairn_lever;
typedef double cairn_ratio;
typedef double cairn_share;
typedef double cairn_factor;
typedef double cairn_wide;
typedef double cairn_push;
typedef double cairn_area;
typedef uint8_t cairn_carry;
typedef double cairn_extent;
typedef double cairn_spot;
typedef double cairn_packed;
typedef uint16_t cairn_residue; /* nothing lies below a double's last bit */

#define CAIRN_PI 3.14159265358979323846
#define CAIRN_F(x) ((cairn_real)(x))
#define CAIRN_RADIANS(x) ((cairn_angle)(x))
#define CAIRN_DEGREES(x) ((cairn_angle)((x) * (CAIRN_PI / 180.0)))
#define CAIRN_MOTION(x) ((cairn_motion)(x))
#define CAIRN_OFFSET(x) ((cairn_offset)(x))
#define CAIRN_UNIT(x) ((cairn_unit)(x))
#define CAIRN_RATIO(x) ((cairn_ratio)(x))
#define CAIRN_SHARE(x) ((cairn_share)(x))
#define CAIRN_FACTOR(x) ((cairn_factor)(x))

#define CAIRN_REAL_MAX 32767.999984741211 /* the world is as large as in fixed point */
#define CAIRN_LEVER_MAX 2.8284271247461903

static inline double cairn_clamp(double x, double limit) { return x > limit ? limit : x < -limit ? -limit : x; }

static inline cairn_real cairn_real_add(cairn_real a, cairn_real b) { return a + b; }
static inline cairn_real cairn_real_sub(cairn_real a, cairn_real b) { return a - b; }
static inline cairn_real cairn_real_mul(cairn_real a, cairn_real b) { return a * b; }
static inline cairn_real cairn_real_from_int(int32_t x) { return x; }
static inline int32_t cairn_real_floor(cairn_real x) { return (int32_t)floor(x); }
static inline bool cairn_real_is_within(cairn_real x, cairn_real limit) { return x <= limit && -x <= limit; }
static inline cairn_real cairn_real_half(cairn_real x) { return x / 2; }
static inline bool cairn_real_is_longer(cairn_real x, cairn_real y, cairn_real r) { return r < 8 && x * x + y * y > (r + 0.001) * (r + 0.001); }
static inline cairn_real cairn_real_divide(cairn_real a, cairn_real b)
{
    return b != 0 ? a / b : a > 0 ? CAIRN_REAL_MAX : a < 0 ? -CAIRN_REAL_MAX : 0;
}
static inline cairn_real cairn_real_sqrt(cairn_real x) { return x > 0 ? sqrt(x) : 0; }
static inline bool cairn_real_is_short(cairn_real x, cairn_real y, cairn_real r) { return sqrt(x * x + y * y) <= r; }
static inline cairn_real cairn_real_length(cairn_real x, cairn_real y) { return sqrt(x * x + y * y); }

static inline cairn_heading cairn_heading_of(cairn_angle a) { return a; }
static inline bool cairn_heading_is_near(cairn_heading heading, cairn_angle a, cairn_angle limit) { return fabs(a - heading) <= limit; }
static inline cairn_angle cairn_angle_add(cairn_angle a, cairn_angle b) { return a + b; }
static inline void cairn_angle_rotation(cairn_angle angle, cairn_unit *cosine, cairn_unit *sine)
{
    *cosine = cos(angle);
    *sine = sin(angle);
}
static inline cairn_angle cairn_angle_of(cairn_real y, cairn_real x) { return atan2(y, x); }
static inline cairn_real cairn_angle_radians(cairn_angle a) { return remainder(a, 2 * CAIRN_PI); }
static inline cairn_angle cairn_angle_from_radians(cairn_real radians) { return radians; }
static inline cairn_angle cairn_angle_of_turn(int32_t part, int32_t whole) { return 2 * CAIRN_PI * part / whole; }

/* A wide number is handed over as it is. */
typedef cairn_wide cairn_wide_word;
static inline cairn_wide_word cairn_wide_to_word(cairn_wide a) { return a; }
static inline cairn_wide cairn_wide_from_word(cairn_wide_word w) { return w; }
static inline cairn_wide cairn_wide_of(double x, int exponent) { return ldexp(fabs(x), exponent); }
static inline cairn_wide cairn_wide_mul(cairn_wide a, cairn_wide b) { return a * b; }
static inline cairn_wide cairn_wide_div(cairn_wide a, cairn_wide b) { return b != 0 ? a / b : 0; }
static inline cairn_wide cairn_wide_inverse(cairn_wide a) { return cairn_wide_div(1, a); }
static inline cairn_wide cairn_wide_add(cairn_wide a, cairn_wide b) { return a + b; }
static inline cairn_wide cairn_wide_sqrt(cairn_wide a) { return sqrt(a); }
#define CAIRN_DENSITY(x) (x)
#define CAIRN_WIDE_PART(x) (x)
#define CAIRN_WIDE_SCALED(x, exponent) ((x) * ((exponent) < 0 ? 1.0 / (1 << -(exponent)) : (double)(1 << (exponent))))
#define CAIRN_WIDE_PI CAIRN_PI
static inline cairn_wide cairn_wide_determinant(cairn_share a, cairn_share b, cairn_share c, cairn_share d) { return fabs(a * d - b * c); }
static inline cairn_packed cairn_wide_pack(cairn_wide k) { return k; }
static inline cairn_wide cairn_wide_unpack(cairn_packed p) { return p; }
static inline cairn_wide cairn_wide_zero(void) { return 0; }
static inline bool cairn_wide_is_zero(cairn_wide a) { return a == 0; }
static inline bool cairn_wide_is(cairn_wide a, cairn_wide b) { return a == b; }
static inline bool cairn_wide_less(cairn_wide a, cairn_wide b) { return a < b; }
static inline cairn_wide cairn_wide_from_real(cairn_real x) { return fabs(x); }
static inline cairn_wide cairn_wide_from_offset(cairn_offset x) { return fabs(x); }
static inline cairn_wide cairn_wide_from_int(int32_t x) { return fabs((double)x); }
static inline cairn_wide cairn_wide_from_area(cairn_area a) { return fabs(a); }
static inline cairn_wide cairn_wide_from_sum(cairn_offset a, cairn_offset b) { return fabs(a + b); }
static inline cairn_real cairn_wide_to_real(cairn_wide k) { return k; }
static inline cairn_share cairn_wide_to_share(cairn_wide k) { return k; }
static inline cairn_motion cairn_wide_to_motion(cairn_wide k) { return k; }
static inline cairn_offset cairn_wide_to_offset(cairn_wide k) { return k; }
static inline cairn_motion cairn_motion_from_real(cairn_real x, cairn_wide k) { return x * k; }
static inline cairn_real cairn_real_from_motion(cairn_motion x, cairn_wide k) { return x * k; }
static inline cairn_angle cairn_angle_from_motion(cairn_motion x, cairn_wide inverse_gyration) { return x * inverse_gyration; }
static inline cairn_lever cairn_lever_of(cairn_offset arm, cairn_wide inverse_gyration)
{
    return cairn_clamp(arm * inverse_gyration, CAIRN_LEVER_MAX);
}
static inline cairn_lever cairn_lever_in_turn(cairn_offset arm, cairn_wide inverse_gyration, uint32_t step)
{
    (void)step;
    return cairn_lever_of(arm, inverse_gyration);
}
static inline cairn_lever cairn_lever_add(cairn_lever j, cairn_lever k) { return cairn_clamp(j + k, CAIRN_LEVER_MAX); }

static inline void cairn_coordinate_move(cairn_real *x, cairn_residue *residue, cairn_motion by)
{
    *residue = 0;
    *x += by;
}
static inline cairn_offset cairn_coordinate_offset(cairn_real from, cairn_residue from_residue, cairn_real to, cairn_residue to_residue)
{
    (void)from_residue;
    (void)to_residue;
    return to - from;
}
static inline void cairn_coordinate_shift(cairn_real *x, cairn_residue *residue, cairn_offset by)
{
    *residue = 0;
    *x += by;
}
static inline cairn_motion cairn_motion_half(cairn_motion x) { return x / 2; }
static inline cairn_motion cairn_motion_shifted(cairn_motion x, int bits) { return x / (1 << bits); }
static inline cairn_motion cairn_motion_eighth(cairn_motion x) { return x / 8; }
static inline cairn_real cairn_real_turn(cairn_real x, cairn_real y, cairn_unit c, cairn_unit s) { return x * c + y * s; }
static inline cairn_real cairn_coordinate_round(cairn_real x, cairn_residue residue)
{
    (void)residue;
    return x;
}
static inline cairn_residue cairn_residue_zero(void) { return 0; }

static inline cairn_offset cairn_offset_from_real(cairn_real x) { return x; }
static inline cairn_real cairn_real_from_offset(cairn_offset x) { return x; }
static inline cairn_motion cairn_motion_from_offset(cairn_offset x) { return x; }
static inline cairn_offset cairn_offset_from_motion(cairn_motion x) { return x; }
#define CAIRN_OFFSET_MAX 512.0
static inline cairn_offset cairn_offset_half(cairn_offset x) { return x / 2; }
static inline cairn_offset cairn_offset_add(cairn_offset a, cairn_offset b) { return a + b; }
static inline cairn_extent cairn_extent_above(cairn_real x) { return x; }
static inline cairn_real cairn_real_from_extent(cairn_extent x) { return x; }
static inline cairn_real cairn_real_from_extents(cairn_extent a, cairn_extent b) { return a + b; }
static inline bool cairn_angle_is_in_sector(cairn_angle a, cairn_angle b) { return floor(a * (2048 / CAIRN_PI)) == floor(b * (2048 / CAIRN_PI)); }
static inline cairn_real cairn_real_sector(cairn_real radius) { return radius / 512; }
static inline bool cairn_angle_is_in_wide_sector(cairn_angle a, cairn_angle b) { return floor(a * (32 / CAIRN_PI)) == floor(b * (32 / CAIRN_PI)); }
static inline cairn_real cairn_real_wide_sector(cairn_real radius) { return radius * 13 / 128; }
static inline cairn_spot cairn_spot_of(cairn_real x) { return x; }
static inline cairn_real cairn_spot_real(cairn_spot spot, cairn_real x) { (void)x; return spot; }
static inline cairn_extent cairn_spot_way(cairn_spot spot, cairn_real x) { return fabs(x - spot); }
static inline bool cairn_spots_are_near(cairn_spot a, cairn_spot b, cairn_extent half_a, cairn_extent half_b) { return fabs(a - b) <= half_a + half_b; }
static inline cairn_real cairn_real_above_motion(cairn_motion x) { return x; }
static inline cairn_real cairn_real_above_offset(cairn_offset x) { return x; }
static inline cairn_offset cairn_offset_mul(cairn_offset a, cairn_unit u) { return a * u; }
static inline cairn_offset cairn_offset_dot(cairn_offset ax, cairn_offset ay, cairn_unit ux, cairn_unit uy) { return ax * ux + ay * uy; }
static inline cairn_area cairn_offset_cross(cairn_offset ax, cairn_offset ay, cairn_offset bx, cairn_offset by) { return ax * by - ay * bx; }
static inline cairn_unit cairn_unit_dot(cairn_unit ax, cairn_unit ay, cairn_unit bx, cairn_unit by) { return ax * bx + ay * by; }
static inline cairn_unit cairn_offset_fraction(cairn_offset a, cairn_offset b) { return a / b; }
static inline cairn_offset cairn_unit_along(cairn_offset x, cairn_offset y, cairn_unit *ux, cairn_unit *uy)
{
    double length = sqrt(x * x + y * y);
    *ux = length > 0 ? x / length : 1;
    *uy = length > 0 ? y / length : 0;
    return length;
}
static inline cairn_dir cairn_dir_from_unit(cairn_unit u) { return u; }
static inline cairn_dir cairn_dir_in_turn(cairn_unit u, uint32_t step)
{
    (void)step;
    return u;
}
static inline cairn_lean cairn_dir_lean(cairn_unit x, cairn_unit y, cairn_dir dx, cairn_dir dy)
{
    (void)x, (void)y, (void)dx, (void)dy;
    return 0;
}
static inline cairn_motion cairn_motion_lean(cairn_motion x, cairn_lean angle) { return x * angle; }
static inline void cairn_motion_add_lack(cairn_motion *vx, cairn_motion *vy, cairn_motion push, cairn_motion rub, cairn_dir dx, cairn_dir dy,
                                         cairn_lean lean, int times, uint32_t step)
{
    (void)vx, (void)vy, (void)push, (void)rub, (void)dx, (void)dy, (void)lean, (void)times, (void)step;
}
static inline cairn_unit cairn_unit_from_dir(cairn_dir d) { return d; }
static inline cairn_real cairn_real_from_unit(cairn_unit u) { return u; }
static inline cairn_lever cairn_lever_negate(cairn_lever j) { return -j; }
static inline cairn_dir cairn_dir_negate(cairn_dir d) { return -d; }
static inline cairn_real cairn_real_below_motion(cairn_motion x) { return x; }
static inline cairn_motion cairn_motion_between(cairn_real way, cairn_residue from_residue, cairn_residue to_residue)
{
    (void)from_residue;
    (void)to_residue;
    return way;
}
static inline cairn_motion cairn_motion_apart(cairn_motion from, cairn_motion to, cairn_motion origin) { return to - from + origin; }
typedef struct cairn_frame {
    cairn_dir x, y;
    double inverse, limit;
} cairn_frame;
typedef double cairn_tilt, cairn_swing, cairn_stretch, cairn_part;
#define CAIRN_STRETCH(x) ((double)(x))
static inline bool cairn_frame_set(cairn_frame *frame, cairn_unit x, cairn_unit y, cairn_offset length)
{
    int exponent;
    frexp(length, &exponent);
    frame->x = x;
    frame->y = y;
    frame->inverse = 1 / length;
    frame->limit = ldexp(1, exponent - 6);
    return length >= 1.0 / 256 && length < 16;
}
static inline bool cairn_frame_holds(const cairn_frame *frame, cairn_motion x, cairn_motion y) { return fabs(x) < frame->limit && fabs(y) < frame->limit; }
static inline bool cairn_frame_holds_well(const cairn_frame *frame, cairn_real x, cairn_real y) { return cairn_frame_holds(frame, 2 * x, 2 * y); }
static inline cairn_stretch cairn_frame_stretch(const cairn_frame *frame, cairn_motion x, cairn_motion y, cairn_tilt *tilt)
{
    double across = y * frame->x - x * frame->y;
    *tilt = across * frame->inverse;
    return x * frame->x + y * frame->y + across * *tilt / 2;
}
static inline cairn_dir cairn_frame_x(const cairn_frame *frame, cairn_tilt tilt) { return frame->x - tilt * frame->y; }
static inline cairn_dir cairn_frame_y(const cairn_frame *frame, cairn_tilt tilt) { return frame->y + tilt * frame->x; }
static inline cairn_tilt cairn_frame_tilt(const cairn_frame *frame, cairn_dir x, cairn_dir y) { return frame->x * y - frame->y * x; }
static inline bool cairn_frame_is_passed(const cairn_frame *frame, cairn_motion x) { return fabs(x) >= frame->limit / 2; }
#define CAIRN_LAG_NONE 0
#define CAIRN_LAG_QUARTER 2
static inline cairn_tilt cairn_tilt_towards(cairn_tilt from, cairn_tilt to, uint8_t lag) { return lag == CAIRN_LAG_NONE ? to : from + (to - from) / 4; }
static inline cairn_unit cairn_dir_cosine(cairn_dir ax, cairn_dir ay, cairn_dir bx, cairn_dir by) { return ax * bx + ay * by; }
typedef double cairn_turn;
#define CAIRN_TURN(x) ((cairn_turn)(x))
static inline cairn_turn cairn_dir_turn(cairn_dir ax, cairn_dir ay, cairn_dir bx, cairn_dir by) { return fmax(fabs(ax - bx), fabs(ay - by)); }
static inline cairn_unit cairn_unit_from_turn(cairn_turn turn) { return turn < 0.5 ? turn : 0.5; }
static inline cairn_turn cairn_turn_from_unit(cairn_unit u) { return u; }
static inline cairn_dir cairn_dir_towards(cairn_dir from, cairn_dir to) { return 0.75 * from + 0.25 * to; }

static inline cairn_motion cairn_motion_clamp(cairn_motion x, cairn_motion limit) { return cairn_clamp(x, limit); }
static inline cairn_motion cairn_motion_add(cairn_motion a, cairn_motion b) { return a + b; }
static inline cairn_motion cairn_motion_along(cairn_motion x, cairn_motion y, cairn_dir dx, cairn_dir dy) { return x * dx + y * dy; }
static inline cairn_motion cairn_motion_half_along(cairn_motion x, cairn_motion y, cairn_dir dx, cairn_dir dy) { return (x * dx + y * dy) / 2; }
static inline cairn_motion cairn_motion_half_dir(cairn_motion a, cairn_dir d) { return a * d / 2; }
static inline cairn_motion cairn_motion_half_lever(cairn_motion a, cairn_lever j) { return a * j / 2; }
#define CAIRN_LEVER_SHORT 2.0
static inline cairn_motion cairn_motion_levers(cairn_motion a, cairn_lever j, cairn_motion b, cairn_lever k) { return a * j + b * k; }
static inline cairn_motion cairn_motion_add_levers(cairn_motion u, cairn_motion a, cairn_lever j, cairn_motion b, cairn_lever k) { return u + a * j + b * k; }
static inline bool cairn_lever_is_short(cairn_lever j) { return fabs(j) <= CAIRN_LEVER_SHORT; }
static inline bool cairn_motion_is_within(cairn_motion x, cairn_motion limit) { return fabs(x) <= limit; }
static inline bool cairn_motions_are_within(cairn_motion x, cairn_motion y, cairn_motion w, cairn_motion limit)
{
    return fabs(x) < limit && fabs(y) < limit && fabs(w) < limit;
}
static inline cairn_motion cairn_motion_above_zero(cairn_motion x, cairn_motion limit) { return x < 0 ? 0 : x > limit ? limit : x; }
typedef double cairn_size;
static inline cairn_size cairn_size_of(cairn_motion x) { return fabs(x); }
static inline cairn_size cairn_size_with(cairn_size size, cairn_motion x) { return fabs(x) > size ? fabs(x) : size; }
static inline bool cairn_size_is_below(cairn_size size, cairn_motion limit) { return size < limit; }
#define CAIRN_KNOWS_SQUARES 0
static inline cairn_size cairn_squares_with(cairn_size sum, cairn_motion x) { return sum + x * x; }
static inline bool cairn_squares_are_below(cairn_size sum, cairn_motion limit) { return sum < limit * limit; }
static inline bool cairn_size_is_far_below(cairn_size size, cairn_motion limit) { return size < limit / 32; }
static inline cairn_motion cairn_motion_ratio_short(cairn_motion a, cairn_ratio r) { return a * r; }
static inline cairn_motion cairn_motion_factor_below(cairn_motion a, cairn_factor f) { return a * f; }
static inline cairn_motion cairn_motion_dir(cairn_motion a, cairn_dir d) { return a * d; }
static inline cairn_motion cairn_motion_lever(cairn_motion a, cairn_lever j) { return a * j; }
static inline cairn_motion cairn_motion_ratio(cairn_motion a, cairn_ratio r) { return a * r; }
typedef double cairn_fine;
static inline cairn_fine cairn_fine_of(cairn_motion a) { return a; }
static inline cairn_motion cairn_motion_from_fine(cairn_fine a) { return a; }
static inline cairn_fine cairn_fine_add(cairn_fine a, cairn_fine b) { return a + b; }
static inline cairn_fine cairn_fine_half(cairn_motion a) { return a * 0.5; }
static inline cairn_fine cairn_fine_share(cairn_motion a, cairn_share s) { return a * s; }
static inline cairn_motion cairn_fine_dir(cairn_fine a, cairn_dir d) { return a * d; }
static inline cairn_motion cairn_fine_lever(cairn_fine a, cairn_lever j) { return a * j; }
static inline cairn_motion cairn_fine_along(cairn_fine x, cairn_fine y, cairn_dir dx, cairn_dir dy) { return x * dx + y * dy; }
#define CAIRN_KNOWS_QUIET 0
#define CAIRN_QUIET CAIRN_MOTION(1.2e-4)
static inline bool cairn_motion_is_quiet(cairn_motion x) { return fabs(x) < CAIRN_QUIET; }
static inline bool cairn_motion_is_fairly_quiet(cairn_motion x) { return fabs(x) < 4 * CAIRN_QUIET; }
static inline bool cairn_motion_is_calm(cairn_motion x) { return fabs(x) < 1.0 / 64; }
static inline void cairn_forget(void) {}
static inline cairn_motion cairn_kept(cairn_motion x) { return x; }
static inline cairn_motion cairn_quiet_add_along(cairn_motion sum, cairn_motion x, cairn_motion y, cairn_dir dx, cairn_dir dy) { return sum + (x * dx + y * dy); }
static inline cairn_motion cairn_quiet_add_levers(cairn_motion sum, cairn_motion a, cairn_lever j, cairn_motion b, cairn_lever k) { return sum + (a * j + b * k); }
static inline cairn_motion cairn_quiet_less_ratio(cairn_motion sum, cairn_motion a, cairn_ratio r) { return sum - a * r; }
static inline cairn_fine cairn_quiet_share(cairn_motion a, cairn_share s) { return a * s; }
static inline cairn_motion cairn_quiet_half_dir(cairn_motion a, cairn_dir d) { return a * d / 2; }
static inline cairn_motion cairn_quiet_half_lever(cairn_motion a, cairn_lever j) { return a * j / 2; }
static inline cairn_motion cairn_quiet_half_along(cairn_motion x, cairn_motion y, cairn_dir dx, cairn_dir dy) { return (x * dx + y * dy) / 2; }
static inline cairn_motion cairn_quiet_add_fine_dir(cairn_motion sum, cairn_fine a, cairn_dir d) { return sum + a * d; }
static inline cairn_motion cairn_quiet_less_fine_dir(cairn_motion sum, cairn_fine a, cairn_dir d) { return sum - a * d; }
static inline cairn_motion cairn_quiet_add_fine_lever(cairn_motion sum, cairn_fine a, cairn_lever j) { return sum + a * j; }
static inline cairn_motion cairn_quiet_add_fine_along(cairn_motion sum, cairn_fine x, cairn_fine y, cairn_dir dx, cairn_dir dy) { return sum + (x * dx + y * dy); }
static inline cairn_motion cairn_quiet_less_fine_along(cairn_motion sum, cairn_fine x, cairn_fine y, cairn_dir dx, cairn_dir dy) { return sum - (x * dx + y * dy); }
static inline cairn_motion cairn_motion_share(cairn_motion a, cairn_share s) { return a * s; }
static inline cairn_motion cairn_motion_share_carried(cairn_motion a, cairn_share s, cairn_carry *carry)
{
    *carry = 0;
    return a * s;
}
static inline cairn_motion cairn_motion_factor(cairn_motion a, cairn_factor f) { return a * f; }

static inline cairn_unit cairn_motion_fraction(cairn_motion part, cairn_motion whole)
{
    return part < 0 ? 0 : part > whole ? 1 : part / whole;
}
static inline cairn_motion cairn_motion_unit(cairn_motion x, cairn_unit u) { return x * u; }
static inline cairn_motion cairn_motion_closing(cairn_motion u, cairn_motion g, cairn_motion s)
{
    double square = u * u + 2 * g * s;
    return square > 0 ? sqrt(square) : 0;
}
static inline cairn_motion cairn_motion_divide(cairn_motion x, cairn_factor f) { return x / f; }
static inline cairn_motion cairn_motion_scale(cairn_motion x, cairn_wide k) { return x * k; }
typedef double cairn_gain;
static inline cairn_gain cairn_gain_from_wide(cairn_wide k) { return k; }
static inline cairn_gain cairn_gain_from_share(cairn_share s) { return s; }
static inline cairn_gain cairn_gain_times_half(cairn_gain k, cairn_factor f) { return k * f / 2; }
static inline cairn_gain cairn_gain_zero(void) { return 0; }
static inline bool cairn_gain_is_zero(cairn_gain k) { return k == 0; }
static inline cairn_motion cairn_motion_gain(cairn_stretch x, cairn_gain k) { return x * k; }
static inline cairn_stretch cairn_stretch_along(cairn_motion x, cairn_motion y, cairn_dir dx, cairn_dir dy) { return x * dx + y * dy; }
static inline cairn_motion cairn_motion_from_stretch(cairn_stretch x) { return x; }
static inline cairn_stretch cairn_stretch_from_offset(cairn_offset x) { return cairn_clamp(x, 4); }
static inline cairn_stretch cairn_stretch_clamp(cairn_stretch x, cairn_stretch limit) { return cairn_clamp(x, limit); }
static inline cairn_part cairn_part_from_factor(cairn_factor f) { return f; }
static inline cairn_motion cairn_motion_part(cairn_motion x, cairn_part f) { return x * f; }
static inline cairn_motion cairn_motion_64th(cairn_offset x) { return x / 64; }

static inline cairn_motion cairn_motion_from_offset_wide(cairn_offset x, cairn_wide k) { return x * k; }
static inline cairn_wide cairn_wide_from_factor(cairn_factor x) { return x; }
static inline cairn_ratio cairn_ratio_from_wide(cairn_wide k) { return k; }
static inline cairn_angle cairn_angle_part(cairn_angle a, cairn_unit part) { return a * part; }
static inline cairn_wide cairn_wide_from_share(cairn_share x) { return x; }
static inline cairn_share cairn_share_shift(cairn_share x, int n) { return ldexp(x, -n); }
static inline cairn_share cairn_share_mul(cairn_share a, cairn_share b) { return a * b; }

typedef double cairn_sum;
static inline cairn_sum cairn_sum_of(cairn_share a) { return a; }
static inline cairn_sum cairn_sum_less(cairn_sum sum, cairn_share a, cairn_share b) { return sum - a * b; }
static inline cairn_share cairn_sum_share(cairn_sum sum) { return sum; }
static inline int cairn_motion_headroom(cairn_motion most) { (void)most; return 0; }
#define CAIRN_MOTION_LIFTED 1e9
static inline cairn_motion cairn_motion_lift(cairn_motion x, int n) { (void)n; return x; }
static inline cairn_motion cairn_motion_lower(cairn_motion x, cairn_wide k, int n) { (void)n; return x * k; }

typedef struct cairn_diffused {
    cairn_motion whole;
} cairn_diffused;
static inline cairn_diffused cairn_diffused_of(cairn_real x, cairn_wide k)
{
    cairn_diffused d;
    d.whole = x * k;
    return d;
}
static inline cairn_diffused cairn_diffused_of_short(cairn_real x, cairn_wide k) { return cairn_diffused_of(x, k); }
static inline cairn_motion cairn_diffuse(cairn_diffused *d) { return d->whole; }

#define CAIRN_PUSH_MAX 524288.0
static inline cairn_push cairn_push_clamp(cairn_push x, cairn_push limit) { return cairn_clamp(x, limit); }
static inline cairn_push cairn_push_from_motion(cairn_motion x) { return x; }
static inline cairn_motion cairn_motion_from_push(cairn_push x) { return x; }
static inline cairn_push cairn_push_half(cairn_push x) { return x / 2; }
static inline cairn_push cairn_push_dir(cairn_push x, cairn_dir d) { return x * d; }
static inline cairn_push cairn_push_lever(cairn_push x, cairn_lever j) { return x * j; }
static inline cairn_push cairn_push_unit(cairn_push x, cairn_unit u) { return x * u; }
static inline cairn_push cairn_push_factor(cairn_push x, cairn_factor f) { return x * f; }
static inline cairn_push cairn_push_scale(cairn_push x, cairn_wide k) { return x * k; }
static inline cairn_push cairn_push_shift(cairn_push x, int n) { return ldexp(x, n); }
static inline int cairn_push_excess(cairn_push x)
{
    (void)x;
    return 0;
}

static inline cairn_unit cairn_unit_coupling(cairn_dir x, cairn_dir y, cairn_lever j, cairn_dir x2, cairn_dir y2, cairn_lever j2,
                                             cairn_wide k, int exponent)
{
    return ldexp((x * x2 + y * y2 + j * j2) * k, exponent);
}
static inline int cairn_unit_room(cairn_unit x)
{
    int exponent;
    frexp(x, &exponent);
    return exponent < 0 ? -exponent / 2 : 0;
}
static inline cairn_unit cairn_unit_grow(cairn_unit x, int n) { return ldexp(x, n); }
static inline cairn_unit cairn_unit_mul(cairn_unit a, cairn_unit b) { return a * b; }
static inline cairn_unit cairn_unit_scale(cairn_unit x, cairn_wide k, int exponent) { return ldexp(x * k, exponent); }
static inline cairn_wide cairn_wide_from_unit(cairn_unit x) { return fabs(x); }

static inline cairn_factor cairn_factor_from_real(cairn_real x) { return x; }
static inline cairn_factor cairn_factor_from_share(cairn_share s) { return s; }
static inline cairn_factor cairn_factor_spin(cairn_share s, cairn_lever j, cairn_lever k) { return s * j * k; }
static inline cairn_factor cairn_factor_from_ratio(cairn_ratio x) { return x; }
static inline cairn_ratio cairn_ratio_from_factor(cairn_factor f) { return f; }
static inline cairn_factor cairn_factor_reciprocal(cairn_factor f) { return 1 / f; }
static inline cairn_factor cairn_factor_mul(cairn_factor a, cairn_factor b) { return a * b; }
static inline cairn_factor cairn_factor_square(cairn_dir x, cairn_dir y) { return x * x + y * y; }
static inline cairn_ratio cairn_factor_inverse(cairn_factor f) { return f > 0.5 ? 1 / f : 2; }
static inline cairn_real cairn_real_geometric_mean(cairn_real a, cairn_real b) { return a > 0 && b > 0 ? sqrt(a * b) : 0; }

static inline cairn_factor cairn_factor_geometric_mean(cairn_factor a, cairn_factor b) { return cairn_real_geometric_mean(a, b); }

#ifdef __cplusplus
}
#endif

#endif
