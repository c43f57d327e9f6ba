/*
 * What the engine knows, on a canvas: the callbacks of cairn/debug_draw.h drawn with this folder's shapes. Four layers, each
 * switched by the pad: SELECT held for a fifth of a second, and then a direction (up: shapes, left: contacts, right: cells, down: springs).
 */
#ifndef DRAW_DEBUG_VIEW_H
#define DRAW_DEBUG_VIEW_H

#include "view.h"

#include <cairn/debug_draw.h>

typedef enum draw_layer {
    DRAW_LAYER_SHAPES = 1,
    DRAW_LAYER_CONTACTS = 2,
    DRAW_LAYER_CELLS = 4,
    DRAW_LAYER_SPRINGS = 8,
    DRAW_LAYERS_ALL = 15
} draw_layer;

typedef struct draw_layers {
    unsigned shown;  /* a set of draw_layer */
    uint32_t before; /* the buttons a step ago */
    uint8_t held;    /* for how many steps SELECT has been, up to those that it takes */
} draw_layers;

/* Switch layers by the buttons held in this step. True if one was switched: the game then does not take the direction for its own. */
bool draw_layers_step(draw_layers *layers, uint32_t buttons);

/* Draw the layers that are shown. */
void draw_world(draw_canvas *canvas, const draw_view *view, cairn_world *world, const draw_layers *layers);

#endif
