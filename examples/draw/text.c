/* See text.h. */
#include "text.h"

#include <stddef.h>

enum { FIRST = ' ', LAST = '_', ROWS = 5 };

/* A letter's rows from the top, an octal digit each. */
static const uint16_t font[LAST - FIRST + 1] = {
    000000, 022202, 055000, 057575, 027272, 051245, 025253, 022000, 012221, 042224, 005250, 002720, 000024, 000700, 000002, 011244, /*  !"#$%&'()*+,-./ */
    075557, 026227, 071747, 071317, 055711, 074717, 074757, 071222, 075757, 075717, 002020, 002024, 012421, 007070, 042124, 071202, /* 0-9 :;<=>? */
    075747, 025755, 065656, 034443, 065556, 074647, 074644, 034553, 055755, 072227, 011152, 055655, 044447, 057755, 065555, 025552, /* @A-O */
    065644, 025563, 065655, 034216, 072222, 055557, 055552, 055775, 055255, 055222, 071247, 064446, 044211, 031113, 027222, 000007, /* P-Z [\]^_ */
};

static unsigned glyph_of(char letter)
{
    if (letter >= 'a' && letter <= 'z')
        letter = (char)(letter - 'a' + 'A');
    return letter < FIRST || letter > LAST ? 0u : font[letter - FIRST];
}

static bool has_pixel(unsigned glyph, int column, int row) { return (glyph >> (3 * (ROWS - 1 - row) + 2 - column) & 1u) != 0; }

static void draw_letter(draw_canvas *canvas, int x, int y, unsigned glyph, int shade)
{
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < 3; column++)
            if (has_pixel(glyph, column, row))
                draw_pixel(canvas, x + column, y + row, shade);
}

void draw_text(draw_canvas *canvas, int x, int y, const char *text, int shade)
{
    for (; *text != '\0' && x < DRAW_WIDTH; text++, x += DRAW_LETTER_WIDTH)
        draw_letter(canvas, x, y, glyph_of(*text), shade);
}

/* A letter's row in the middle of five bits; none above the first one and below the last. */
static unsigned row_of(unsigned glyph, int row) { return row < 0 || row >= ROWS ? 0u : (glyph >> (3 * (ROWS - 1 - row)) & 7u) << 1; }

void draw_label(draw_canvas *canvas, int x, int y, const char *text, int shade)
{
    for (; *text != '\0' && x < DRAW_WIDTH; text++, x += DRAW_LETTER_WIDTH) {
        const unsigned glyph = glyph_of(*text);
        for (int row = -1; row <= ROWS; row++) {
            const unsigned letter = row_of(glyph, row), rim = letter << 1 | letter >> 1 | row_of(glyph, row - 1) | row_of(glyph, row + 1);
            for (int column = 0; column < 5; column++)
                if ((letter >> (4 - column) & 1u) != 0)
                    draw_pixel(canvas, x + column - 1, y + row, shade);
                else if ((rim >> (4 - column) & 1u) != 0)
                    draw_pixel(canvas, x + column - 1, y + row, 0);
        }
    }
}

void draw_centered(draw_canvas *canvas, int x, int y, const char *text, int shade)
{
    draw_label(canvas, x - draw_text_width(text) / 2, y, text, shade);
}

static void draw_big_letter(draw_canvas *canvas, int x, int y, unsigned glyph, int size, draw_shades shades)
{
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < 3; column++)
            if (has_pixel(glyph, column, row))
                draw_box(canvas, x + column * size, y + row * size, size, size,
                         shades.top + (shades.bottom - shades.top) * row / (ROWS - 1));
}

void draw_big_text(draw_canvas *canvas, int x, int y, const char *text, int size, draw_shades shades)
{
    for (; *text != '\0' && x < DRAW_WIDTH; text++, x += DRAW_LETTER_WIDTH * size) {
        draw_big_letter(canvas, x + 1, y + 1, glyph_of(*text), size, draw_shade(0));
        draw_big_letter(canvas, x, y, glyph_of(*text), size, shades);
    }
}

int draw_text_width(const char *text)
{
    int width = 0;
    for (; *text != '\0'; text++)
        width += DRAW_LETTER_WIDTH;
    return width > 0 ? width - 1 : 0;
}

int draw_number(char *buffer, int32_t value, int decimals)
{
    char digits[DRAW_NUMBER_SIZE];
    int count = 0, length = 0;
    uint32_t rest = value < 0 ? 0u - (uint32_t)value : (uint32_t)value;
    do {
        if (count == decimals && decimals > 0 && count < 4)
            digits[count++] = '.';
        digits[count++] = (char)('0' + rest % 10);
        rest /= 10;
    } while ((rest > 0 || (decimals > 0 && count <= decimals + 1)) && count < DRAW_NUMBER_SIZE - 1);
    if (value < 0 && length < DRAW_NUMBER_SIZE - 1)
        buffer[length++] = '-';
    while (count > 0 && length < DRAW_NUMBER_SIZE - 1)
        buffer[length++] = digits[--count];
    buffer[length] = '\0';
    return length;
}
