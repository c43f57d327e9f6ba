/* Integers as text on the port's console. Collects a line, because a console call costs far more than a character. */
#include "cairn_print.h"

#include "cairn_port.h"

enum { LINE_CAPACITY = 127, U64_DIGITS = 20 };

static char line[LINE_CAPACITY + 1];
static uint32_t line_length;

void cairn_print_flush(void)
{
    if (line_length == 0)
        return;
    line[line_length] = '\0';
    line_length = 0;
    cairn_port_write(line);
}

static void put(char c)
{
    line[line_length++] = c;
    if (c == '\n' || line_length == LINE_CAPACITY)
        cairn_print_flush();
}

void cairn_print_text(const char *text)
{
    for (; *text != '\0'; text++)
        put(*text);
}

/* Puts a number's digits into the buffer behind `count` lower ones, the lowest first. */
static int add_digits(char *digits, int count, uint32_t value)
{
    do {
        digits[count++] = (char)('0' + (int)(value % 10u));
        value /= 10u;
    } while (value != 0);
    return count;
}

static void put_digits(const char *digits, int count)
{
    while (count > 0)
        put(digits[--count]);
}

void cairn_print_u64(uint64_t value)
{
    char digits[U64_DIGITS];
    int count = 0;
    /* A 32-bit division is far cheaper on these cores: use the wide one only while the value needs it. */
    while (value > UINT32_MAX) {
        digits[count++] = (char)('0' + (int)(value % 10u));
        value /= 10u;
    }
    put_digits(digits, add_digits(digits, count, (uint32_t)value));
}

/* Not by the wide one: an image without 64-bit numbers is to be without their division, 1 KB on a Cortex-M. */
void cairn_print_u32(uint32_t value)
{
    char digits[U64_DIGITS];
    put_digits(digits, add_digits(digits, 0, value));
}

void cairn_print_i64(int64_t value)
{
    if (value >= 0) {
        cairn_print_u64((uint64_t)value);
        return;
    }
    put('-');
    /* Unsigned negation is defined for the most negative value too. */
    cairn_print_u64(0u - (uint64_t)value);
}

void cairn_print_i32(int32_t value)
{
    if (value < 0)
        put('-');
    cairn_print_u32(value < 0 ? 0u - (uint32_t)value : (uint32_t)value);
}

void cairn_print_hex32(uint32_t value)
{
    for (int shift = 28; shift >= 0; shift -= 4)
        put("0123456789abcdef"[(value >> shift) & 0xFu]);
}

void cairn_print_hex64(uint64_t value)
{
    cairn_print_hex32((uint32_t)(value >> 32));
    cairn_print_hex32((uint32_t)value);
}
