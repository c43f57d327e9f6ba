/* See game.h. */
#include "game.h"

#include "cairn_port.h"

#include <string.h>

enum {
    DEMO_AFTER = 480,     /* steps of the title */
    PAUSE_AFTER = 45,     /* steps that SELECT is held */
    CARD_STEPS = 40,      /* in which a press after a level is not taken, so that none is by chance */
    RESTORED_A_STEP = 3,
    MENU_RESUME = 0,
    MENU_RETRY,
    MENU_TITLE
};

#define CRANE_OVER_CAMERA CAIRN_F(1.25) /* the balloon near the upper edge of the picture */

static void enter(game *g, game_state state)
{
    g->state = state;
    g->since = 0;
    g->menu = 0;
    g->held = 0;
}

/* What goes with a round that has just been made. */
static void begin_round(game *g)
{
    feel_start(&g->feel, g->frame + 1);
    g->camera = g->round.crane_height - CRANE_OVER_CAMERA;
}

static void start_round(game *g, int number, int lives)
{
    round_start(&g->round, number, random_next(&g->random), lives);
    begin_round(g);
}

static void start_demo(game *g)
{
    start_round(g, random_between(&g->random, 0, level_count() - 1), ROUND_LIVES);
}

void game_start(game *g, uint32_t seed)
{
    memset(g, 0, sizeof *g);
    g->random = random_from(seed);
    score_start(&g->score);
    start_round(g, 0, ROUND_LIVES);
    enter(g, GAME_TITLE);
}

static void keep_now(game *g)
{
    if (g->keep_name != NULL)
        (void)cairn_port_save(g->keep_name, &g->kept, sizeof g->kept);
    g->can_continue = g->kept.playing != 0;
}

void game_use_keep(game *g, const char *name)
{
    g->keep_name = name;
    if (cairn_port_load(name, 0, &g->kept, sizeof g->kept) != (int32_t)sizeof g->kept || !keep_is_valid(&g->kept))
        memset(&g->kept, 0, sizeof g->kept);
    g->score.best = g->kept.best;
    g->can_continue = g->kept.playing != 0;
}

/* ---- what a level's events look like ---- */

static void show_events(game *g)
{
    const game_round *r = &g->round;
    if ((r->events & EVENT_LANDED) != 0) {
        cairn_vec2 at = r->event_at;
        feel_points(&g->feel, at, r->event_points);
        at.y -= CAIRN_F(0.25);
        feel_thud(&g->feel, at, r->event_speed);
    }
    if ((r->events & EVENT_SPLASH) != 0)
        feel_splash(&g->feel, r->splash_at);
    if (r->held > 0 && r->held % 8 == 0)
        feel_sparks(&g->feel, cairn_vec2_of(0, r->level.goal));
}

static void move_camera(game *g)
{
    const cairn_real goal = g->round.crane_height - CRANE_OVER_CAMERA;
    g->camera += (goal - g->camera) / 16;
}

static round_wish wish_of(uint32_t buttons, uint32_t pressed)
{
    round_wish wish;
    wish.crane.move = (int8_t)(((buttons & CAIRN_BUTTON_RIGHT) != 0) - ((buttons & CAIRN_BUTTON_LEFT) != 0));
    wish.crane.turn = (int8_t)(((buttons & CAIRN_BUTTON_UP) != 0) - ((buttons & CAIRN_BUTTON_DOWN) != 0));
    wish.drop = (pressed & CAIRN_BUTTON_SELECT) != 0;
    return wish;
}

static void step_round(game *g, uint32_t buttons, uint32_t pressed, score *s)
{
    round_step(&g->round, wish_of(buttons, pressed), s);
    show_events(g);
    move_camera(g);
}

/* ---- states ---- */

static void step_menu(game *g, uint32_t pressed, int lines)
{
    if ((pressed & CAIRN_BUTTON_DOWN) != 0 && g->menu + 1 < lines)
        g->menu++;
    if ((pressed & CAIRN_BUTTON_UP) != 0 && g->menu > 0)
        g->menu--;
}

static void play_from(game *g, int number, int lives)
{
    score_start(&g->score);
    start_round(g, number, lives);
    enter(g, GAME_PLAY);
}

static void step_title(game *g, uint32_t pressed)
{
    step_menu(g, pressed, g->can_continue ? 2 : 1);
    if (pressed != 0)
        g->since = 0;
    if ((pressed & CAIRN_BUTTON_SELECT) != 0) {
        g->random = random_from(g->random.state + g->frame);
        if (g->can_continue && g->menu == 0) {
            keep_restore(&g->kept, &g->round, &g->score);
            begin_round(g);
            g->restored = 0;
            enter(g, GAME_RESUME);
        } else {
            play_from(g, 0, ROUND_LIVES);
        }
    } else if (g->since >= DEMO_AFTER) {
        enter(g, GAME_DEMO);
    }
}

static void step_resume(game *g)
{
    g->restored = (uint8_t)keep_restore_stones(&g->kept, &g->round, g->restored, RESTORED_A_STEP);
    if (g->restored >= g->kept.count)
        enter(g, GAME_PLAY);
}

/* The machine plays; its points do not count. */
static void step_demo_round(game *g)
{
    score none;
    score_start(&none);
    none.best = 0;
    const uint32_t buttons = bot_buttons(&g->round, g->frame);
    step_round(g, buttons, buttons, &none);
    if (g->round.state >= ROUND_WON && ++g->held > 90) {
        start_demo(g);
        g->held = 0;
    }
}

static void step_play(game *g, uint32_t buttons, uint32_t pressed)
{
    g->held = (uint16_t)((buttons & CAIRN_BUTTON_SELECT) != 0 ? g->held + 1 : 0);
    step_round(g, buttons, pressed, &g->score);
    if ((g->round.events & EVENT_HUNG) != 0) {
        keep_take(&g->kept, &g->round, &g->score);
        keep_now(g);
    }
    if (g->round.state == ROUND_WON) {
        g->bonus = score_level(&g->score, g->round.number, g->round.supply, g->round.lives);
        enter(g, GAME_WON);
    } else if (g->round.state == ROUND_LOST) {
        keep_take_best(&g->kept, &g->score);
        keep_now(g);
        enter(g, GAME_OVER);
    } else if (g->held >= PAUSE_AFTER) {
        enter(g, GAME_PAUSE);
    }
}

static void step_pause(game *g, uint32_t pressed)
{
    step_menu(g, pressed, GAME_MENU_SIZE);
    if ((pressed & CAIRN_BUTTON_SELECT) == 0)
        return;
    if (g->menu == MENU_RESUME) {
        enter(g, GAME_PLAY);
    } else if (g->menu == MENU_RETRY) {
        play_from(g, g->round.number, ROUND_LIVES);
    } else {
        start_demo(g);
        enter(g, GAME_TITLE);
    }
}

static void step_won(game *g, uint32_t pressed)
{
    step_round(g, 0, 0, &g->score);
    if (g->since % 6 == 0)
        feel_sparks(&g->feel, cairn_vec2_of(CAIRN_F(-2) + (cairn_real)(g->since % 5) * CAIRN_F(1), g->round.level.goal));
    if (g->since < CARD_STEPS || (pressed & CAIRN_BUTTON_SELECT) == 0)
        return;
    const int lives = g->round.lives < ROUND_LIVES_MAX ? g->round.lives + 1 : ROUND_LIVES_MAX;
    start_round(g, g->round.number + 1, lives);
    enter(g, GAME_PLAY);
}

static void step_over(game *g, uint32_t pressed)
{
    step_round(g, 0, 0, &g->score);
    step_menu(g, pressed, 2);
    if (g->since < CARD_STEPS || (pressed & CAIRN_BUTTON_SELECT) == 0)
        return;
    if (g->menu == 0) {
        play_from(g, g->round.number, ROUND_LIVES);
    } else {
        start_demo(g);
        enter(g, GAME_TITLE);
    }
}

void game_step(game *g, uint32_t buttons)
{
    uint32_t pressed = buttons & ~g->before;
    g->before = buttons;
    g->frame++;
    g->since++;
    if (draw_layers_step(&g->layers, buttons)) {
        pressed = 0;
        g->held = 0;
    }
    feel_step(&g->feel);
    if (g->state == GAME_TITLE || g->state == GAME_DEMO)
        step_demo_round(g);
    switch (g->state) {
    case GAME_TITLE: step_title(g, pressed); break;
    case GAME_DEMO:
        if (pressed != 0)
            enter(g, GAME_TITLE);
        break;
    case GAME_RESUME: step_resume(g); break;
    case GAME_PLAY: step_play(g, buttons, pressed); break;
    case GAME_PAUSE: step_pause(g, pressed); break;
    case GAME_WON: step_won(g, pressed); break;
    case GAME_OVER: step_over(g, pressed); break;
    }
}

uint32_t game_hash(const game *g)
{
    uint32_t hash = round_hash(&g->round);
    hash = hash * 31 + g->score.points;
    hash = hash * 31 + (uint32_t)g->state;
    return hash * 31 + g->random.state;
}
