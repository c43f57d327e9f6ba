/* Text in letters of 3 x 5 pixels, four to the next; small letters are drawn as capitals, what is not in the font as a blank. */
#ifndef DRAW_TEXT_H
#define DRAW_TEXT_H

#include "fill.h"

enum { DRAW_LETTER_WIDTH = 4, DRAW_LETTER_HEIGHT = 5, DRAW_NUMBER_SIZE = 12 };

/* x, y: the upper left pixel of the first letter. */
void draw_text(draw_canvas *canvas, int x, int y, const char *text, int shade);
/* With a dark rim, to be read on anything. */
void draw_label(draw_canvas *canvas, int x, int y, const char *text, int shade);
/* Centred about x. */
void draw_centered(draw_canvas *canvas, int x, int y, const char *text, int shade);
/* Each pixel of a letter a square of `size`, shaded from top to bottom, with a dark edge to the lower right. */
void draw_big_text(draw_canvas *canvas, int x, int y, const char *text, int size, draw_shades shades);
/* Pixels from the first letter's left to the last one's right. */
int draw_text_width(const char *text);

/* A number as text, in a buffer of DRAW_NUMBER_SIZE; returns its length. decimals: digits after a point, 0 to 3. */
int draw_number(char *buffer, int32_t value, int decimals);

#endif
