/*
 * Counts what each operation of the arithmetic costs on the core it is built for: instructions in QEMU, nanoseconds on
 * the host. Prints one line an operation: its name and the mean over the arguments, loop and call overhead of
 * an empty operation taken off.
 */
#include "arith_random.h"
#include "cairn/arith.h"
#include "cairn_port.h"
#include "cairn_print.h"

enum { COUNT = 256 };

static int32_t left[COUNT], right[COUNT];
static volatile int32_t sink;

/* The loop is compiled with the operation inlined into it, as in the engine. */
#define OPERATION(name, expression)                        \
    static void name(void)                                 \
    {                                                      \
        int32_t sum = 0;                                   \
        for (int i = 0; i < COUNT; i++) {                  \
            int32_t a = left[i], b = right[i];             \
            int32_t c = sum, d = b;                        \
            (void)a;                                       \
            (void)b;                                       \
            (void)c;                                       \
            (void)d;                                       \
            sum = (int32_t)((uint32_t)sum ^ (uint32_t)(expression)); \
        }                                                  \
        sink = sum;                                        \
    }

cairn_wide third = { 0xAAAAAAABu, -33 }; /* not static: the compiler shall not know the value */

static int32_t rotation(int32_t a)
{
    cairn_unit c, s;
    cairn_angle_rotation(a, &c, &s);
    return c ^ s;
}

static int32_t along(int32_t x, int32_t y)
{
    cairn_unit ux, uy;
    int32_t length = cairn_unit_along(x, y, &ux, &uy);
    return length ^ ux ^ uy;
}

static int32_t fold(uint64_t x) { return (int32_t)((uint32_t)x ^ (uint32_t)(x >> 32)); }

static int32_t moved(int32_t a)
{
    static cairn_real x;
    static cairn_residue residue;
    cairn_coordinate_move(&x, &residue, a);
    return x ^ residue;
}

static cairn_wide wide(int32_t a) { cairn_wide k = { (uint32_t)a | 0x80000000u, -28 }; return k; }

OPERATION(empty, a ^ b)
OPERATION(mul16, cairn_mul16(a, b >> 16, 14) ^ b)
OPERATION(mul32_30, cairn_mul32(a, b, 30))
OPERATION(mul32_32, cairn_mul32(a, b, 32))
OPERATION(dot16, cairn_dot16(a, b >> 17, c >> 1, a >> 17, 14) ^ b)
OPERATION(dot32, cairn_dot32(a, b >> 1, c, d >> 1, 30))
OPERATION(product, fold(cairn_product((uint32_t)a, (uint32_t)b)))
OPERATION(clz, cairn_clz((uint32_t)a) ^ b)
OPERATION(motion_add, cairn_motion_add(a, b))
OPERATION(motion_factor, cairn_motion_factor(a, (int32_t)((uint32_t)b >> 12)))
OPERATION(coordinate_move, moved(a >> 4) ^ b)
OPERATION(real_mul, cairn_real_mul(a >> 8, b >> 8))
OPERATION(real_divide, cairn_real_divide(a, b))
OPERATION(real_sqrt, cairn_real_sqrt(a & INT32_MAX) ^ b)
OPERATION(real_length, cairn_real_length(a >> 1, b >> 1))
OPERATION(angle_rotation, rotation(a) ^ b)
OPERATION(angle_of, cairn_angle_of(a, b))
OPERATION(angle_from_motion, cairn_angle_from_motion(a, third) ^ b)
OPERATION(wide_scale, cairn_wide_scale(a, third, 0) ^ b)
OPERATION(wide_mul, (int32_t)cairn_wide_mul(wide(a), wide(b)).mantissa)
OPERATION(wide_div, (int32_t)cairn_wide_div(wide(a), wide(b)).mantissa)
OPERATION(wide_add, (int32_t)cairn_wide_add(wide(a), wide(b)).mantissa)
OPERATION(wide_sqrt, (int32_t)cairn_wide_sqrt(wide(a)).mantissa ^ b)
OPERATION(lever_of, cairn_lever_of(a >> 8, third) ^ b)
OPERATION(offset_fraction, cairn_offset_fraction((a & b) & INT32_MAX, (a | 1) & INT32_MAX))
OPERATION(unit_along_1m, along(a >> 9, b >> 9))
OPERATION(unit_along_100m, along(a >> 2, b >> 2))
OPERATION(factor_inverse, cairn_factor_inverse((1 << 20) + (int32_t)((uint32_t)a >> 10)) ^ b)
OPERATION(factor_spin, cairn_factor_spin(a & 0x3FFFFFFF, (cairn_lever)(b >> 17), (cairn_lever)(a >> 17)))

static const struct {
    const char *name;
    void (*run)(void);
} operations[] = {
    { "mul16", mul16 },
    { "mul32 >> 30", mul32_30 },
    { "mul32 >> 32", mul32_32 },
    { "dot16", dot16 },
    { "dot32 >> 30", dot32 },
    { "product", product },
    { "clz", clz },
    { "motion_add", motion_add },
    { "motion_factor", motion_factor },
    { "factor_spin", factor_spin },
    { "factor_inverse", factor_inverse },
    { "coordinate_move", coordinate_move },
    { "wide_scale", wide_scale },
    { "lever_of", lever_of },
    { "angle_from_motion", angle_from_motion },
    { "angle_rotation", angle_rotation },
    { "unit_along, 1 m", unit_along_1m },
    { "unit_along, 100 m", unit_along_100m },
    { "offset_fraction", offset_fraction },
    { "angle_of", angle_of },
    { "real_mul", real_mul },
    { "real_divide", real_divide },
    { "real_sqrt", real_sqrt },
    { "real_length", real_length },
    { "wide_mul", wide_mul },
    { "wide_div", wide_div },
    { "wide_add", wide_add },
    { "wide_sqrt", wide_sqrt },
};

static uint32_t cost(void (*run)(void))
{
    uint32_t before = cairn_port_clock();
    run();
    return cairn_port_clock() - before;
}

int main(void)
{
    arith_random random = arith_random_seeded(1);
    cairn_port_init();
    for (int i = 0; i < COUNT; i++) {
        left[i] = (int32_t)arith_random_bits(&random);
        right[i] = (int32_t)arith_random_bits(&random);
    }
    for (uint32_t i = 0; i < sizeof operations / sizeof operations[0]; i++) {
        uint32_t spent = cost(operations[i].run), idle = cost(empty);
        uint32_t tenths = ((spent > idle ? spent - idle : 0) * 10u + COUNT / 2) / COUNT;
        cairn_print_text(operations[i].name);
        cairn_print_text(": ");
        cairn_print_u32(tenths / 10u);
        cairn_print_text(".");
        cairn_print_u32(tenths % 10u);
        cairn_print_text("\n");
    }
    cairn_print_flush();
    cairn_port_exit(0);
    return 0;
}
