/* Sky, stars, moon, mountains and water behind the cairn, see picture.h. */
#include "picture.h"

#include "line.h"

enum { STARS = 22, FAR_RANGE = 4, NEAR_RANGE = 5, MOON_X = 86 };

/* Sky from top to bottom in sixteenths of a shade, and the shades of the far and the near range. */
typedef struct sky_look {
    uint8_t top, bottom, far, near, stars;
} sky_look;

static const sky_look skies[] = {
    {40, 92, 4, 2, 0},
    {24, 76, 4, 2, 8},
    {10, 58, 3, 1, 16},
    {0, 36, 2, 1, STARS},
};

/* A mountain's top, pixels, and how much snow it bears; its foot lies below the frame. */
typedef struct peak {
    int16_t x, y, snow;
} peak;

static const peak far_range[FAR_RANGE] = {{14, 34, 38}, {48, 26, 34}, {84, 32, 36}, {118, 24, 40}};
static const peak near_range[NEAR_RANGE] = {{-4, 44, 30}, {30, 50, 26}, {66, 46, 30}, {96, 52, 24}, {126, 42, 32}};

static void draw_stars(draw_canvas *canvas, const game *g, int count)
{
    random_source r = random_from(7);
    for (int i = 0; i < count; i++) {
        const uint32_t place = random_next(&r);
        const bool twinkles = ((g->frame >> 4) + place) % 7 == 0;
        draw_pixel(canvas, (int)(place >> 8 & 127), (int)(place >> 16) % 40, twinkles ? 13 : 7);
    }
}

static void draw_moon(draw_canvas *canvas, int y)
{
    const draw_point center = {MOON_X * DRAW_SUB, y * DRAW_SUB}, spot = {(MOON_X - 2) * DRAW_SUB, (y - 2) * DRAW_SUB};
    const draw_shades light = {11, 8};
    draw_disc(canvas, center, 6 * DRAW_SUB, light);
    draw_disc(canvas, spot, 2 * DRAW_SUB, draw_shade(8));
    draw_box(canvas, MOON_X + 2, y + 2, 2, 2, 7);
}

/* Row by row, three pixels wider every two: hard edges, but most of the picture at little cost. */
static void draw_peak(draw_canvas *canvas, peak p, int down, int shade)
{
    for (int row = 0; p.y + down + row < DRAW_HEIGHT; row++)
        draw_row(canvas, p.x - row * 3 / 2, p.x + row * 3 / 2 + 1, p.y + down + row, shade);
}

/* Snow on its top, with a ragged edge. */
static void draw_cap(draw_canvas *canvas, peak p, int down, int shade)
{
    const int height = p.snow / 5;
    for (int row = 0; row < height + 2; row++) {
        const int half = row * 3 / 2, y = p.y + down + row;
        if (row < height)
            draw_row(canvas, p.x - half, p.x + half + 1, y, shade);
        else
            for (int x = p.x - half + (p.snow & 3); x < p.x + half - 2; x += 5)
                draw_row(canvas, x, x + 3 - (row - height), y, shade);
    }
}

static void draw_water(draw_canvas *canvas, const game *g, int y)
{
    if (y >= DRAW_HEIGHT)
        return;
    draw_box(canvas, 0, y, DRAW_WIDTH, DRAW_HEIGHT - y, 1);
    draw_row(canvas, 0, DRAW_WIDTH, y, 5);
    for (int row = 2; y + row < DRAW_HEIGHT; row += 3)
        for (int x = 0; x < DRAW_WIDTH; x += 16) {
            const int from = x + (int)((g->frame / 8 + (uint32_t)row * 5) % 16);
            draw_row(canvas, from, from + 6 - row / 2, y + row, 4);
        }
}

/* Streaks that go with the wind, the faster the stronger it is. */
static void draw_wind(draw_canvas *canvas, const game *g)
{
    const int strength = (int)(g->round.wind.now / (CAIRN_F(1) / 8));
    const int count = strength < 0 ? -strength : strength;
    for (int i = 0; i < count && i < 8; i++) {
        const int way = (int)(g->frame * (uint32_t)(2 + i % 3)) % 176;
        const int x = (i * 53 + (strength < 0 ? 175 - way : way)) % 176 - 24;
        draw_row(canvas, x, x + 10 + i % 4, (i * 29 + 17) % 56 + 4, 8);
    }
}

void picture_landscape(draw_canvas *canvas, const game *g, const draw_view *view)
{
    const sky_look *look = &skies[g->round.level.dark & 3];
    /* What is far moves less: pixels that the camera has risen, and a share of them. */
    const int risen = (int)(draw_view_length(view, view->center.y) / DRAW_SUB);
    draw_gradient(canvas, look->top, look->bottom);
    draw_stars(canvas, g, look->stars);
    if (look->stars > 0)
        draw_moon(canvas, 14 + risen / 24);
    for (int i = 0; i < FAR_RANGE; i++)
        draw_peak(canvas, far_range[i], risen / 8, look->far);
    for (int i = 0; i < FAR_RANGE; i++)
        draw_cap(canvas, far_range[i], risen / 8, look->far + 5);
    for (int i = 0; i < NEAR_RANGE; i++)
        draw_peak(canvas, near_range[i], risen / 3, look->near);
    draw_wind(canvas, g);
    const draw_point water = draw_view_point(view, cairn_vec2_of(0, CAIRN_F(-1.0)));
    draw_water(canvas, g, water.y / DRAW_SUB);
}
