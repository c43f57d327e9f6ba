/* See canvas.h. */
#include "canvas.h"

#include <string.h>

static uint8_t pair_of(int shade) { return (uint8_t)(shade << 4 | shade); }

static int at_least(int x, int limit) { return x < limit ? limit : x; }
static int at_most(int x, int limit) { return x > limit ? limit : x; }

void draw_clear(draw_canvas *canvas, int shade)
{
    memset(canvas->pixels, pair_of(shade), sizeof canvas->pixels);
    draw_unclip(canvas);
}

void draw_clip(draw_canvas *canvas, int left, int top, int right, int bottom)
{
    canvas->left = (int16_t)at_most(at_least(left, 0), DRAW_WIDTH);
    canvas->top = (int16_t)at_most(at_least(top, 0), DRAW_HEIGHT);
    canvas->right = (int16_t)at_least(at_most(right, DRAW_WIDTH), canvas->left);
    canvas->bottom = (int16_t)at_least(at_most(bottom, DRAW_HEIGHT), canvas->top);
}

void draw_unclip(draw_canvas *canvas) { draw_clip(canvas, 0, 0, DRAW_WIDTH, DRAW_HEIGHT); }

static bool is_inside(const draw_canvas *canvas, int x, int y)
{
    return x >= canvas->left && x < canvas->right && y >= canvas->top && y < canvas->bottom;
}

int draw_get(const draw_canvas *canvas, int x, int y)
{
    if (x < 0 || x >= DRAW_WIDTH || y < 0 || y >= DRAW_HEIGHT)
        return 0;
    const uint8_t pair = canvas->pixels[y * DRAW_PITCH + x / 2];
    return (x & 1) != 0 ? pair & 15 : pair >> 4;
}

static void set(uint8_t *pair, int x, int shade)
{
    *pair = (uint8_t)((x & 1) != 0 ? (*pair & 0xF0) | shade : (*pair & 0x0F) | shade << 4);
}

void draw_pixel(draw_canvas *canvas, int x, int y, int shade)
{
    if (is_inside(canvas, x, y))
        set(&canvas->pixels[y * DRAW_PITCH + x / 2], x, shade);
}

void draw_blend(draw_canvas *canvas, int x, int y, int shade, int cover)
{
    if (!is_inside(canvas, x, y))
        return;
    uint8_t *pair = &canvas->pixels[y * DRAW_PITCH + x / 2];
    const int old = (x & 1) != 0 ? *pair & 15 : *pair >> 4;
    set(pair, x, (old * (DRAW_COVERED - cover) + shade * cover + DRAW_COVERED / 2) / DRAW_COVERED);
}

void draw_row(draw_canvas *canvas, int x, int end, int y, int shade)
{
    if (y < canvas->top || y >= canvas->bottom)
        return;
    x = at_least(x, canvas->left);
    end = at_most(end, canvas->right);
    if (x >= end)
        return;
    uint8_t *row = &canvas->pixels[y * DRAW_PITCH];
    if ((x & 1) != 0) {
        set(&row[x / 2], x, shade);
        x++;
    }
    if (x < end && (end & 1) != 0) {
        end--;
        set(&row[end / 2], end, shade);
    }
    if (x < end)
        memset(&row[x / 2], pair_of(shade), (size_t)(end - x) / 2);
}

/* Where a box that begins before `limit` ends, without a sum that could overflow. */
static int end_of(int start, int size, int limit)
{
    if (start < 0)
        return at_most(start + size, limit);
    return size > limit - start ? limit : start + size;
}

/* The part of a box inside of the clip; false if there is none. */
static bool cut(const draw_canvas *canvas, int *x, int *y, int *end_x, int *end_y, int width, int height)
{
    if (width <= 0 || height <= 0 || *x >= canvas->right || *y >= canvas->bottom)
        return false;
    *end_x = end_of(*x, width, canvas->right);
    *end_y = end_of(*y, height, canvas->bottom);
    *x = at_least(*x, canvas->left);
    *y = at_least(*y, canvas->top);
    return *x < *end_x && *y < *end_y;
}

void draw_box(draw_canvas *canvas, int x, int y, int width, int height, int shade)
{
    int end_x, end_y;
    if (!cut(canvas, &x, &y, &end_x, &end_y, width, height))
        return;
    for (; y < end_y; y++)
        draw_row(canvas, x, end_x, y, shade);
}

/* Bayer's ordered dither: a pixel is set if the amount is above its place in the pattern. */
static const uint8_t dither_pattern[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};

void draw_dither(draw_canvas *canvas, int x, int y, int width, int height, int shade, int amount)
{
    int end_x, end_y;
    if (!cut(canvas, &x, &y, &end_x, &end_y, width, height))
        return;
    for (; y < end_y; y++)
        for (int column = x; column < end_x; column++)
            if (dither_pattern[y & 3][column & 3] < amount)
                set(&canvas->pixels[y * DRAW_PITCH + column / 2], column, shade);
}

static int tinted(int shade, int change) { return at_most(at_least(shade + change, 0), DRAW_WHITE); }

void draw_tint(draw_canvas *canvas, int x, int y, int width, int height, int change)
{
    int end_x, end_y;
    uint8_t after[16];
    if (!cut(canvas, &x, &y, &end_x, &end_y, width, height))
        return;
    for (int shade = 0; shade < 16; shade++)
        after[shade] = (uint8_t)tinted(shade, change);
    for (; y < end_y; y++) {
        uint8_t *row = &canvas->pixels[y * DRAW_PITCH];
        int column = x;
        if ((column & 1) != 0) {
            set(&row[column / 2], column, after[row[column / 2] & 15]);
            column++;
        }
        for (; column + 1 < end_x; column += 2)
            row[column / 2] = (uint8_t)(after[row[column / 2] >> 4] << 4 | after[row[column / 2] & 15]);
        if (column < end_x)
            set(&row[column / 2], column, after[row[column / 2] >> 4]);
    }
}

void draw_gradient(draw_canvas *canvas, int top, int bottom)
{
    for (int y = 0; y < DRAW_HEIGHT; y++) {
        const int value = top + (bottom - top) * y / (DRAW_HEIGHT - 1), shade = value >> 4, part = value & 15;
        uint8_t pattern[2], *row = &canvas->pixels[y * DRAW_PITCH];
        for (int i = 0; i < 2; i++) {
            const int left = shade + (dither_pattern[y & 3][2 * i] < part), right = shade + (dither_pattern[y & 3][2 * i + 1] < part);
            pattern[i] = (uint8_t)(tinted(left, 0) << 4 | tinted(right, 0));
        }
        for (int i = 0; i < DRAW_PITCH; i += 2) {
            row[i] = pattern[0];
            row[i + 1] = pattern[1];
        }
    }
}
