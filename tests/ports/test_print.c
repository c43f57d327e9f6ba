/* Numbers as text on the console: what reaches a mocked port, and in how many calls. */
#include "cairn_print.h"

#include "mock_cairn_port.h"
#include "unity.h"

void tearDown(void)
{
    cairn_print_flush();
}

void test_a_line_reaches_the_console_in_one_call(void)
{
    cairn_port_write_Expect("step 12 x -3\n");
    cairn_print_text("step ");
    cairn_print_u32(12);
    cairn_print_text(" x ");
    cairn_print_i32(-3);
    cairn_print_text("\n");
}

void test_an_unfinished_line_waits_for_flush(void)
{
    cairn_print_text("abc");
    cairn_port_write_Expect("abc");
    cairn_print_flush();
}

void test_flush_of_nothing_writes_nothing(void)
{
    cairn_print_flush();
    cairn_print_text("");
    cairn_print_flush();
}

void test_extremes_of_each_type(void)
{
    cairn_port_write_Expect("0 4294967295\n");
    cairn_print_u32(0);
    cairn_print_text(" ");
    cairn_print_u32(UINT32_MAX);
    cairn_print_text("\n");
    cairn_port_write_Expect("-2147483648 2147483647\n");
    cairn_print_i32(INT32_MIN);
    cairn_print_text(" ");
    cairn_print_i32(INT32_MAX);
    cairn_print_text("\n");
    cairn_port_write_Expect("18446744073709551615 4294967296 10000000000\n");
    cairn_print_u64(UINT64_MAX);
    cairn_print_text(" ");
    cairn_print_u64(4294967296u);
    cairn_print_text(" ");
    cairn_print_u64(10000000000u);
    cairn_print_text("\n");
    cairn_port_write_Expect("-9223372036854775808 9223372036854775807\n");
    cairn_print_i64(INT64_MIN);
    cairn_print_text(" ");
    cairn_print_i64(INT64_MAX);
    cairn_print_text("\n");
}

void test_hexadecimal_keeps_its_zeros(void)
{
    cairn_port_write_Expect("0000beef 0123456789abcdef\n");
    cairn_print_hex32(0xBEEF);
    cairn_print_text(" ");
    cairn_print_hex64(0x0123456789ABCDEFu);
    cairn_print_text("\n");
}

void test_a_long_line_is_sent_in_parts_and_loses_nothing(void)
{
    char part[128];
    for (int i = 0; i < 127; i++)
        part[i] = 'x';
    part[127] = '\0';
    cairn_port_write_Expect(part);
    cairn_port_write_Expect("xxxend\n");
    for (int i = 0; i < 130; i++)
        cairn_print_text("x");
    cairn_print_text("end\n");
}
