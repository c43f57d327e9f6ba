/* The display and the buttons as a window of SDL2: the same pixels, six times as large; arrow keys, and control or space for select.
   Linked instead of common/no_display.c and common/no_buttons.c with -DCAIRN_WINDOW=ON. */
#include "cairn_port.h"

#include <SDL.h>

#include <stdio.h>
#include <stdlib.h>

enum { SCALE = 6, SHADE = 17 /* 15 greys and black over 0 to 255 */ };

static SDL_Window *window;
static SDL_Renderer *renderer;
static SDL_Texture *texture;
static uint32_t pixels[CAIRN_PORT_DISPLAY_WIDTH * CAIRN_PORT_DISPLAY_HEIGHT];

static void stop(const char *what)
{
    fprintf(stderr, "no window: %s: %s\n", what, SDL_GetError());
    exit(EXIT_FAILURE);
}

static void open_window(void)
{
    if (SDL_Init(SDL_INIT_VIDEO) != 0)
        stop("SDL does not start");
    (void)atexit(SDL_Quit);
    window = SDL_CreateWindow("Cairn", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, CAIRN_PORT_DISPLAY_WIDTH * SCALE,
                              CAIRN_PORT_DISPLAY_HEIGHT * SCALE, SDL_WINDOW_RESIZABLE);
    renderer = window != NULL ? SDL_CreateRenderer(window, -1, 0) : NULL;
    texture = renderer == NULL ? NULL
                               : SDL_CreateTexture(renderer, SDL_PIXELFORMAT_ARGB8888, SDL_TEXTUREACCESS_STREAMING,
                                                   CAIRN_PORT_DISPLAY_WIDTH, CAIRN_PORT_DISPLAY_HEIGHT);
    if (texture == NULL)
        stop("SDL opens none");
    /* A window of another size shows whole pixels, with black around them. */
    (void)SDL_RenderSetLogicalSize(renderer, CAIRN_PORT_DISPLAY_WIDTH, CAIRN_PORT_DISPLAY_HEIGHT);
    (void)SDL_RenderSetIntegerScale(renderer, SDL_TRUE);
}

/* Takes what the window reports; closing it or Escape ends the program. */
static void take_events(void)
{
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0)
        if (event.type == SDL_QUIT || (event.type == SDL_KEYDOWN && event.key.keysym.sym == SDLK_ESCAPE))
            exit(EXIT_SUCCESS);
}

static uint32_t color_of(uint32_t grey)
{
    return 0xFF000000u | grey * SHADE * 0x010101u;
}

void cairn_port_display(const uint8_t *frame)
{
    if (window == NULL)
        open_window();
    for (uint32_t i = 0; i < CAIRN_PORT_DISPLAY_BYTES; i++) {
        pixels[2 * i] = color_of(frame[i] >> 4);
        pixels[2 * i + 1] = color_of(frame[i] & 0xFu);
    }
    (void)SDL_UpdateTexture(texture, NULL, pixels, CAIRN_PORT_DISPLAY_WIDTH * (int)sizeof pixels[0]);
    (void)SDL_RenderClear(renderer);
    (void)SDL_RenderCopy(renderer, texture, NULL, NULL);
    SDL_RenderPresent(renderer);
    take_events();
}

uint32_t cairn_port_buttons(void)
{
    static const struct {
        SDL_Scancode key;
        uint32_t button;
    } keys[] = {
        {SDL_SCANCODE_UP, CAIRN_BUTTON_UP}, {SDL_SCANCODE_DOWN, CAIRN_BUTTON_DOWN}, {SDL_SCANCODE_LEFT, CAIRN_BUTTON_LEFT},
        {SDL_SCANCODE_RIGHT, CAIRN_BUTTON_RIGHT}, {SDL_SCANCODE_LCTRL, CAIRN_BUTTON_SELECT},
        {SDL_SCANCODE_RCTRL, CAIRN_BUTTON_SELECT}, {SDL_SCANCODE_SPACE, CAIRN_BUTTON_SELECT},
    };
    if (window == NULL)
        open_window();
    take_events();
    const Uint8 *held = SDL_GetKeyboardState(NULL);
    uint32_t buttons = 0;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (held[keys[i].key] != 0)
            buttons |= keys[i].button;
    return buttons;
}
