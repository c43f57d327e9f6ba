/* Collects Unity's characters to lines: a console call costs far more than a character. */
#include "unity_config.h"

#include "semihosting.h"

enum { LINE_CAPACITY = 255 };

static char line[LINE_CAPACITY + 1];
static int length;

void cairn_test_flush(void)
{
    line[length] = '\0';
    length = 0;
    cairn_semihosting_write(line);
}

void cairn_test_put(int character)
{
    line[length++] = (char)character;
    if (character == '\n' || length == LINE_CAPACITY)
        cairn_test_flush();
}
