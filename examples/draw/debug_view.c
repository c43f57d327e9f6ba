/* See debug_view.h. */
#include "debug_view.h"

#include "line.h"

typedef struct painter {
    draw_canvas *canvas;
    const draw_view *view;
} painter;

enum { CORNERS = CAIRN_MAX_VERTICES, NORMAL_LENGTH = 5, AXIS_SHIFT = 2, CELL_SHADE = 6, SPRING_SHADE = 12, HOLD_STEPS = 12, FINE_SCALE = 12 };

/* A state's inside (none below 0) and outline. */
typedef struct state_look {
    int8_t inside, outline;
} state_look;

static const state_look looks[] = {
    [CAIRN_DRAW_DYNAMIC] = {5, 15},
    [CAIRN_DRAW_ASLEEP] = {1, 7},
    [CAIRN_DRAW_STATIC] = {3, 9},
    [CAIRN_DRAW_KINEMATIC] = {3, 12},
    [CAIRN_DRAW_SENSOR] = {-1, 8},
};

static void paint_circle(void *context, cairn_body_id body, cairn_draw_state state, cairn_vec2 center, cairn_real radius, cairn_vec2 axis)
{
    const painter *p = context;
    const draw_point middle = draw_view_point(p->view, center), way = {axis.x >> AXIS_SHIFT, -(axis.y >> AXIS_SHIFT)};
    const int32_t size = draw_view_length(p->view, radius);
    (void)body;
    if (looks[state].inside >= 0)
        draw_disc(p->canvas, middle, size, draw_shade(looks[state].inside));
    draw_ring(p->canvas, middle, size, looks[state].outline);
    draw_mark(p->canvas, middle, size, way, looks[state].outline);
}

static void paint_polygon(void *context, cairn_body_id body, cairn_draw_state state, const cairn_vec2 *corners, int count)
{
    const painter *p = context;
    draw_point points[CORNERS];
    (void)body;
    for (int i = 0; i < count; i++)
        points[i] = draw_view_point(p->view, corners[i]);
    if (looks[state].inside >= 0)
        draw_convex(p->canvas, points, count, draw_shade(looks[state].inside));
    draw_outline(p->canvas, points, count, looks[state].outline);
}

static void paint_contact(void *context, const cairn_contact *contact)
{
    const painter *p = context;
    for (int i = 0; i < contact->count; i++) {
        const draw_point at = draw_view_point(p->view, contact->points[i].position);
        const int x = at.x >> 4, y = at.y >> 4;
        const int way_x = (int)(contact->normal.x * NORMAL_LENGTH / 65536), way_y = (int)(contact->normal.y * NORMAL_LENGTH / 65536);
        draw_line(p->canvas, x, y, x + way_x, y - way_y, contact->touching ? 12 : 6, DRAW_SOLID);
        draw_box(p->canvas, x - 1, y - 1, 3, 3, 0);
        draw_pixel(p->canvas, x, y, DRAW_WHITE);
        if (contact->touching) {
            draw_row(p->canvas, x - 1, x + 2, y, DRAW_WHITE);
            draw_pixel(p->canvas, x, y - 1, DRAW_WHITE);
            draw_pixel(p->canvas, x, y + 1, DRAW_WHITE);
        }
    }
}

static void paint_cell(void *context, cairn_vec2 lower, cairn_real size, int depth, int bodies)
{
    const painter *p = context;
    const draw_point a = draw_view_point(p->view, lower);
    const draw_point b = draw_view_point(p->view, cairn_vec2_of(cairn_real_add(lower.x, size), cairn_real_add(lower.y, size)));
    const int shade = bodies > 0 ? CELL_SHADE + 4 : CELL_SHADE;
    const unsigned pattern = bodies > 0 ? DRAW_DASHED : DRAW_DOTTED;
    (void)depth;
    draw_line(p->canvas, a.x >> 4, b.y >> 4, b.x >> 4, b.y >> 4, shade, pattern);
    draw_line(p->canvas, a.x >> 4, a.y >> 4, a.x >> 4, b.y >> 4, shade, pattern);
}

static void paint_spring(void *context, cairn_spring_id spring, cairn_vec2 a, cairn_vec2 b, cairn_real rest_length)
{
    const painter *p = context;
    const draw_point from = draw_view_point(p->view, a), to = draw_view_point(p->view, b);
    (void)spring;
    (void)rest_length;
    draw_line(p->canvas, from.x >> 4, from.y >> 4, to.x >> 4, to.y >> 4, SPRING_SHADE, DRAW_SOLID);
    if (p->view->scale < FINE_SCALE)
        return; /* smaller, the ends would cover the springs between them */
    draw_ring(p->canvas, from, 2 * DRAW_SUB, DRAW_WHITE);
    draw_ring(p->canvas, to, 2 * DRAW_SUB, DRAW_WHITE);
}

bool draw_layers_step(draw_layers *layers, uint32_t buttons)
{
    static const uint8_t switches[][2] = {
        {CAIRN_BUTTON_UP, DRAW_LAYER_SHAPES},
        {CAIRN_BUTTON_LEFT, DRAW_LAYER_CONTACTS},
        {CAIRN_BUTTON_RIGHT, DRAW_LAYER_CELLS},
        {CAIRN_BUTTON_DOWN, DRAW_LAYER_SPRINGS},
    };
    const uint32_t pressed = buttons & ~layers->before;
    const unsigned shown = layers->shown;
    layers->before = buttons;
    if ((buttons & CAIRN_BUTTON_SELECT) == 0)
        layers->held = 0;
    else if (layers->held < HOLD_STEPS)
        layers->held++;
    for (unsigned i = 0; layers->held == HOLD_STEPS && i < sizeof switches / sizeof switches[0]; i++)
        if ((pressed & switches[i][0]) != 0)
            layers->shown ^= switches[i][1];
    return shown != layers->shown;
}

void draw_world(draw_canvas *canvas, const draw_view *view, cairn_world *world, const draw_layers *layers)
{
    painter p = {canvas, view};
    const cairn_debug_draw paint = {&p, paint_circle, paint_polygon, paint_contact, paint_cell, paint_spring};
    if ((layers->shown & DRAW_LAYER_SHAPES) != 0)
        (void)cairn_debug_draw_bodies(world, &paint);
    if ((layers->shown & DRAW_LAYER_CELLS) != 0)
        (void)cairn_debug_draw_cells(world, &paint);
    if ((layers->shown & DRAW_LAYER_SPRINGS) != 0)
        (void)cairn_debug_draw_springs(world, &paint);
    if ((layers->shown & DRAW_LAYER_CONTACTS) != 0)
        (void)cairn_debug_draw_contacts(world, &paint);
}
