/* See round.h. */
#include "round.h"

#include <cairn/sleep.h>

#include <string.h>

enum {
    BODIES = LEVEL_STONES + LEVEL_PIECES + 2,
    ARBITERS = 112,
    CELLS = 48,
    ENTRIES = 4 * BODIES,
    TREE_SIZE_LOG2 = 5,
    TREE_DEPTH = 5,
    NEXT_AFTER = 24,    /* steps from a landing to the next stone */
    LAND_AFTER = 240,   /* what falls for longer has landed, wherever it is */
    GIVE_UP_AFTER = 800, /* steps without stones while something moves; in a quarter of that if all is at rest */
    TILT_FIRST = 15, /* degrees */
    TILT_A_LEVEL = 8,
    TILT_MOST = 80,
    MERCY = 90          /* steps in which what falls costs no further life */
};

#define GRAVITY CAIRN_F(-8)
#define STILL CAIRN_F(0.15)      /* m/s: a tall cairn may sway */
#define WATER CAIRN_F(-1.3)      /* what is lower is lost */
#define CRANE_CLEARANCE CAIRN_F(1.8)
#define CRANE_SLACK CAIRN_F(0.25)
#define TREE_CENTER_Y CAIRN_F(12)

CAIRN_WORLD(yard, BODIES, ARBITERS);
CAIRN_SPRINGS(ropes, 1);
CAIRN_QUADTREE(tree, BODIES, CELLS, ENTRIES);

static void place_pieces(game_round *r)
{
    for (int i = 0; i < LEVEL_PIECES; i++)
        r->pieces[i] = cairn_body_id_null();
    for (int i = 0; i < r->level.piece_count; i++) {
        const level_piece *p = &r->level.pieces[i];
        r->pieces[i] = cairn_body_create(r->world, p->model, p->position, p->angle);
    }
}

void round_start(game_round *r, int number, uint32_t seed, int lives)
{
    memset(r, 0, sizeof *r);
    /* Without continuous collision: a stone falls less than a third of its height in a step. */
    r->world = cairn_world_init_with(&yard, cairn_vec2_of(0, GRAVITY), &cairn_solver_soft, NULL);
    (void)cairn_springs_enable(r->world, &ropes);
    (void)cairn_quadtree_enable(r->world, &tree, cairn_vec2_of(0, TREE_CENTER_Y), TREE_SIZE_LOG2, TREE_DEPTH);
    (void)cairn_sleep_enable(r->world);
    r->number = number;
    level_get(&r->level, number);
    r->random = random_from(seed);
    r->supply = r->level.stones;
    r->lives = (uint8_t)lives;
    r->crane_height = CRANE_CLEARANCE;
    r->state = ROUND_LANDED;
    wind_start(&r->wind, r->level.wind, seed);
    place_pieces(r);
    (void)crane_start(&r->crane, r->world, cairn_vec2_of(0, CRANE_CLEARANCE));
}

static stone *free_stone(game_round *r)
{
    for (int i = 0; i < LEVEL_STONES; i++)
        if (r->stones[i].state == STONE_NONE)
            return &r->stones[i];
    return NULL;
}

bool round_restore_stone(game_round *r, uint32_t seed, cairn_vec2 position, cairn_angle angle)
{
    stone *s = free_stone(r);
    if (s == NULL)
        return false;
    stone_shape(s, seed, &r->level.style);
    return stone_place(s, r->world, position, angle, STONE_LANDED);
}

/* How a stone hangs: in later levels it has to be turned farther. */
static cairn_angle random_tilt(game_round *r)
{
    const int most = TILT_FIRST + TILT_A_LEVEL * r->number;
    const int tilt = most > TILT_MOST ? TILT_MOST : most;
    return random_between(&r->random, -tilt, tilt) * CAIRN_DEGREES(1);
}

static void hang_next(game_round *r)
{
    stone *s = r->supply > 0 ? free_stone(r) : NULL;
    r->current = NULL;
    r->wait = 0;
    r->state = ROUND_EMPTY;
    if (s == NULL)
        return;
    stone_shape(s, random_next(&r->random), &r->level.style);
    if (!crane_hang(&r->crane, r->world, s, random_tilt(r)))
        return;
    r->supply--;
    r->current = s;
    r->state = ROUND_HANGING;
    r->events |= EVENT_HUNG;
}

/* A stone may only hang where it is clear of the cairn. */
static bool is_crane_up(const game_round *r)
{
    return cairn_body_position(r->world, r->crane.trolley).y >= r->crane_height - CRANE_SLACK;
}

/* The cairn's height, and whether all of it rests. */
static void measure(game_round *r)
{
    r->top = 0;
    r->standing = r->state != ROUND_FALLING;
    for (int i = 0; i < LEVEL_STONES; i++) {
        stone *s = &r->stones[i];
        if (s->state != STONE_LANDED)
            continue;
        stone_measure(s, r->world);
        if (s->top > r->top)
            r->top = s->top;
        if (stone_speed(s, r->world) > STILL)
            r->standing = false;
    }
}

static void lose_life(game_round *r, score *s)
{
    if (r->mercy > 0)
        return;
    r->mercy = MERCY;
    r->lives--;
    r->events |= EVENT_LIFE;
    score_lost_stone(s);
}

static void drop_lost_stones(game_round *r, score *s)
{
    for (int i = 0; i < LEVEL_STONES; i++) {
        stone *lost = &r->stones[i];
        if (lost->state == STONE_NONE || lost->state == STONE_HANGING)
            continue;
        const cairn_vec2 at = cairn_body_position(r->world, lost->body);
        if (at.y > WATER)
            continue;
        if (lost == r->current) {
            r->current = NULL;
            r->state = ROUND_LANDED;
            r->wait = 0;
        }
        stone_remove(lost, r->world);
        r->events |= EVENT_SPLASH;
        r->splash_at = cairn_vec2_of(at.x, WATER);
        lose_life(r, s);
    }
}

/* The falling stone, which came down at this speed, may have landed. */
static void land(game_round *r, score *s, cairn_real speed)
{
    stone *fallen = r->current;
    if (!stone_touches(fallen, r->world) && ++r->wait < LAND_AFTER)
        return;
    fallen->state = STONE_LANDED;
    r->state = ROUND_LANDED;
    r->wait = 0;
    measure(r);
    r->event_at = cairn_body_position(r->world, fallen->body);
    r->event_speed = speed;
    r->event_points = score_landing(s, r->top > r->record ? r->top - r->record : 0, speed);
    if (r->top > r->record)
        r->record = r->top;
    r->events |= EVENT_LANDED;
    r->current = NULL;
}

/* The clock of the line: it runs while the cairn stands above it, and runs back twice as fast while it does not. */
static void hold_line(game_round *r)
{
    if (r->top >= r->level.goal && r->standing) {
        if (r->held == 0)
            r->events |= EVENT_REACHED;
        r->held++;
    } else {
        r->held = (uint16_t)(r->held > 2 ? r->held - 2 : 0);
    }
}

static void judge(game_round *r)
{
    if (r->held >= ROUND_HOLD_STEPS) {
        r->state = ROUND_WON;
        r->events |= EVENT_WON;
    } else if (r->lives == 0 || (r->state == ROUND_EMPTY && r->wait >= GIVE_UP_AFTER && r->held == 0)) {
        r->state = ROUND_LOST;
        r->events |= EVENT_LOST;
    }
}

static void move_crane(game_round *r, round_wish wish)
{
    cairn_real height = r->top + CRANE_CLEARANCE;
    if (height < CRANE_CLEARANCE)
        height = CRANE_CLEARANCE;
    r->crane_height = height;
    wind_step(&r->wind);
    crane_step(&r->crane, r->world, wish.crane, height, r->wind.now);
    if (r->state == ROUND_HANGING && wish.drop && crane_drop(&r->crane, r->world) != NULL) {
        r->state = ROUND_FALLING;
        r->wait = 0;
        r->events |= EVENT_DROPPED;
    }
}

void round_step(game_round *r, round_wish wish, score *s)
{
    r->events = 0;
    move_crane(r, wish);
    const cairn_real speed = r->state == ROUND_FALLING ? stone_speed(r->current, r->world) : 0;
    (void)cairn_world_step(r->world);
    if (r->mercy > 0)
        r->mercy--;
    if (r->state == ROUND_WON || r->state == ROUND_LOST)
        return;
    if (r->state == ROUND_FALLING)
        land(r, s, speed);
    drop_lost_stones(r, s);
    measure(r);
    if (r->state == ROUND_LANDED && ++r->wait >= NEXT_AFTER && is_crane_up(r))
        hang_next(r);
    if (r->state == ROUND_EMPTY)
        r->wait = (uint16_t)(r->wait + (r->standing ? 4 : 1));
    hold_line(r);
    judge(r);
}

uint32_t round_hash(const game_round *r)
{
    uint32_t hash = cairn_world_hash(r->world);
    hash = hash * 31 + r->random.state;
    hash = hash * 31 + r->wind.phase_a;
    hash = hash * 31 + (uint32_t)(r->number << 16 | r->lives << 8 | r->supply);
    return hash * 31 + (uint32_t)(r->state << 24) + r->held;
}
