/* The quadtree finds what the all-pairs search finds, each pair once, whatever the world and however small its pools. */
#include <cairn/cairn.h>
#include <unity.h>

#define YARD_MODELS 128 /* two for each body */
#include "bodies.h"
#include "engine.h"
#include "test_number.h"

#ifdef __arm__
#define RANDOM_WORLDS 1000
#else
#define RANDOM_WORLDS 10000
#endif

enum { STEPS = 400, BODIES = 64, ARBITERS = 400, CELLS = 1025, ENTRIES = 1024 };

CAIRN_WORLD(memory, BODIES, ARBITERS);
CAIRN_WORLD(other_memory, BODIES, ARBITERS);
CAIRN_QUADTREE(tree_memory, BODIES, CELLS, ENTRIES);

static cairn_shape shapes[BODIES];

void setUp(void) { yard_model_count = 0; }
void tearDown(void) {}

/* ---- what a search finds ---- */

typedef struct finding {
    uint8_t times[BODIES][BODIES];
    uint16_t pairs; /* counts those of two unmoved bodies too */
} finding;

static finding *recorder;

/* Asked by the engine of every pair that may meet, if both bodies have springs: says that they do not. */
static bool record(const cairn_world *world, uint16_t a, uint16_t b)
{
    (void)world;
    recorder->times[a < b ? a : b][a < b ? b : a]++;
    return true;
}

static void search(cairn_world *world, finding *found)
{
    cairn_spring_class recording;
    cairn_spring_pool pool;
    memset(&recording, 0, sizeof recording);
    memset(&pool, 0, sizeof pool);
    memset(found, 0, sizeof *found);
    recording.joined = record;
    pool.kind = &recording;
    recorder = found;
    world->springs = &pool;
    world->stats.pairs = 0;
    world->broad->find_pairs(world);
    found->pairs = world->stats.pairs;
    world->springs = NULL;
}

/* ---- random worlds ---- */

typedef enum world_kind { SCATTERED, OUTSIDE, ONE_POINT, HUGE_ONES, ON_THE_LINES, MIXED, WORLD_KINDS } world_kind;

static cairn_vec2 random_place(uint32_t *seed, world_kind kind, double half)
{
    switch (kind) {
    case OUTSIDE:
        return cairn_vec2_of(random_real(seed, -10 * half, 10 * half), random_real(seed, -10 * half, 10 * half));
    case ONE_POINT:
        return cairn_vec2_of(CAIRN_F(0.25), CAIRN_F(-0.125));
    case ON_THE_LINES:
        return cairn_vec2_of(cairn_real_half(cairn_real_from_int(random_between(seed, -8, 8))), cairn_real_from_int(random_between(seed, -4, 4)));
    default:
        return cairn_vec2_of(random_real(seed, -half, half), random_real(seed, -half, half));
    }
}

static void random_shape(uint32_t *seed, world_kind kind, cairn_shape *shape)
{
    static const cairn_shape box = CAIRN_BOX(0, 0), circle = CAIRN_CIRCLE(0);
    double most = kind == HUGE_ONES && random_between(seed, 0, 2) == 0 ? 100 : 2;
    bool is_box = random_between(seed, 0, 1) == 0;
    *shape = is_box ? box : circle;
    shape->size.x = random_real(seed, 0.01, most);
    shape->size.y = is_box ? random_real(seed, 0.01, most) : 0;
}

static void add_body(cairn_world *world, uint32_t *seed, world_kind kind, double half, int i)
{
    random_shape(seed, kind, &shapes[i]);
    yard_def def = def_at(&shapes[i], 0, 0);
    int type = random_between(seed, 0, 9);
    def.type = type < 2 ? CAIRN_STATIC : type < 3 ? CAIRN_KINEMATIC : CAIRN_DYNAMIC;
    def.position = random_place(seed, kind, half);
    def.angle = kind == ON_THE_LINES ? 0 : cairn_angle_from_radians(random_real(seed, -3, 3));
    cairn_body_id id = make_in(world, &def);
    TEST_ASSERT_FALSE(cairn_body_id_is_null(id));
    cairn_body *body = &world->bodies[id.index - 1];
    body->flags |= CAIRN_BODY_SPRUNG;
    if (kind == ON_THE_LINES) { /* edge to edge, also on the lines between cells */
        body->extent_x = cairn_extent_above(cairn_real_half(cairn_real_from_int(random_between(seed, 1, 3))));
        body->extent_y = cairn_extent_above(cairn_real_half(cairn_real_from_int(random_between(seed, 1, 3))));
    }
    if (def.type == CAIRN_DYNAMIC && random_between(seed, 0, 5) == 0) {
        body->flags |= CAIRN_BODY_ASLEEP;
    }
}

static cairn_world *random_world(uint32_t *seed, world_kind kind, double half)
{
    cairn_world *world = cairn_world_init(&memory, cairn_vec2_of(0, 0));
    yard_model_count = 0;
    int count = random_between(seed, 0, BODIES);
    for (int i = 0; i < count; i++) {
        add_body(world, seed, kind == MIXED ? (world_kind)random_between(seed, SCATTERED, ON_THE_LINES) : kind, half, i);
    }
    for (int i = random_between(seed, 0, count / 3); i > 0; i--) { /* holes in the pool */
        cairn_body_id id = cairn_world_next_body(world, cairn_body_id_null());
        for (int skip = random_between(seed, 0, count); skip > 0 && !cairn_body_id_is_null(id); skip--) {
            id = cairn_world_next_body(world, id);
        }
        if (!cairn_body_id_is_null(id)) {
            TEST_ASSERT_EQUAL(CAIRN_OK, cairn_body_destroy(world, id));
        }
    }
    return world;
}

/* A tree of some size, pools from the least to plenty. */
static void enable_random_tree(cairn_world *world, uint32_t *seed, int size_log2)
{
    static const uint16_t cells[] = { 1, 4, 5, 9, 21, 64, CELLS };
    cairn_quadtree_storage storage = tree_memory;
    storage.cell_capacity = cells[random_between(seed, 0, 6)];
    storage.entry_capacity = (uint16_t)(random_between(seed, 0, 2) == 0 ? ENTRIES : BODIES + random_between(seed, 0, BODIES));
    int depth = random_between(seed, 1, 10);
    memset(tree_memory_cells, 0x55, sizeof tree_memory_cells);
    memset(tree_memory_entries, 0x55, sizeof tree_memory_entries);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_quadtree_enable(world, &storage, cairn_vec2_of(0, 0), size_log2, depth));
    world->tree->leaf_length = (uint8_t)random_between(seed, 1, 8);
}

static void assert_each_once(const finding *found)
{
    for (int i = 0; i < BODIES; i++) {
        for (int j = 0; j < BODIES; j++) {
            TEST_ASSERT_TRUE(found->times[i][j] <= 1);
        }
    }
}

void test_random_worlds_have_the_pairs_of_the_all_pairs_search_each_once(void)
{
    static finding expected, found;
    uint32_t seed = 3, pairs = 0, splits = 0, full = 0;
    for (int n = 0; n < RANDOM_WORLDS; n++) {
        int size_log2 = random_between(&seed, 1, 6);
        cairn_world *world = random_world(&seed, (world_kind)(n % WORLD_KINDS), (1 << size_log2) / 2.0);
        search(world, &expected);
        enable_random_tree(world, &seed, size_log2);
        search(world, &found);
        assert_each_once(&found);
        TEST_ASSERT_EQUAL_MEMORY(&expected, &found, sizeof expected);
        TEST_ASSERT_TRUE(world->stats.tree_cells <= world->tree->cell_capacity);
        TEST_ASSERT_TRUE(world->stats.tree_entries <= world->tree->entry_capacity);
        pairs += found.pairs;
        splits += world->stats.tree_cells > 1 ? 1u : 0u;
        full += world->stats.tree_full > 0 ? 1u : 0u;
    }
    /* The worlds were worth it: many pairs, trees that grew, trees that could not. */
    TEST_ASSERT_TRUE(pairs > 10u * RANDOM_WORLDS);
    TEST_ASSERT_TRUE(splits > RANDOM_WORLDS / 4);
    TEST_ASSERT_TRUE(full > RANDOM_WORLDS / 20);
}

/* ---- simulated worlds ---- */

static const cairn_shape floor_shape = CAIRN_BOX(CAIRN_F(20), CAIRN_F(1));
static const cairn_shape wall_shape = CAIRN_BOX(CAIRN_F(1), CAIRN_F(20));
static const cairn_shape crate = CAIRN_BOX(CAIRN_F(0.5), CAIRN_F(0.5));
static const cairn_shape ball = CAIRN_CIRCLE(CAIRN_F(0.25));

static void add_fixed(cairn_world *world, const cairn_shape *shape, cairn_real x, cairn_real y)
{
    yard_def def = def_at(shape, 0, 0);
    def.type = CAIRN_STATIC;
    def.position = cairn_vec2_of(x, y);
    TEST_ASSERT_FALSE(cairn_body_id_is_null(make_in(world, &def)));
}

/* A trough into which crates and balls fall; some fall beside it and out of the tree. */
static cairn_world *trough(const cairn_world_storage *storage)
{
    cairn_world *world = cairn_world_init(storage, cairn_vec2_of(0, CAIRN_F(-10)));
    uint32_t seed = 5;
    add_fixed(world, &floor_shape, 0, 0);
    add_fixed(world, &wall_shape, CAIRN_F(-3), CAIRN_F(10));
    add_fixed(world, &wall_shape, CAIRN_F(3), CAIRN_F(10));
    for (int i = 0; i < 44; i++) {
        yard_def def = def_at(i & 1 ? &crate : &ball, 0, 0);
        def.position = cairn_vec2_of(random_real(&seed, -2, 2), cairn_real_half(cairn_real_from_int(i + 3)));
        def.angle = cairn_angle_from_radians(random_real(&seed, -1, 1));
        if (i % 11 == 0) {
            def.position.x = CAIRN_F(9.9); /* on the floor's end */
        }
        TEST_ASSERT_FALSE(cairn_body_id_is_null(make_in(world, &def)));
    }
    return world;
}

static void assert_same_state(cairn_world *a, cairn_world *b)
{
    TEST_ASSERT_EQUAL_HEX32(cairn_world_hash(a), cairn_world_hash(b));
    for (uint16_t i = 0; i < a->body_end; i++) {
        TEST_ASSERT_TRUE(a->bodies[i].x == b->bodies[i].x);
        TEST_ASSERT_TRUE(a->bodies[i].y == b->bodies[i].y);
        TEST_ASSERT_TRUE(a->bodies[i].angle == b->bodies[i].angle);
    }
    TEST_ASSERT_EQUAL(a->stats.pairs, b->stats.pairs);
    TEST_ASSERT_EQUAL(a->stats.arbiters, b->stats.arbiters);
    TEST_ASSERT_EQUAL(a->stats.awake, b->stats.awake);
}

static void assert_same_history(cairn_world *pairs, cairn_world *tree)
{
    for (int step = 0; step < STEPS; step++) {
        TEST_ASSERT_EQUAL(CAIRN_OK, cairn_world_step(pairs));
        TEST_ASSERT_EQUAL(CAIRN_OK, cairn_world_step(tree));
        assert_same_state(pairs, tree);
    }
    TEST_ASSERT_EQUAL(0, pairs->stats.dropped);
    TEST_ASSERT_TRUE(tree->stats.tree_cells > 4);
    TEST_ASSERT_TRUE(pairs->stats.arbiters > 40);
}

void test_a_simulated_world_has_the_same_hash_with_either_search(void)
{
    cairn_world *pairs = trough(&memory), *tree = trough(&other_memory);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_quadtree_enable(tree, &tree_memory, cairn_vec2_of(0, CAIRN_F(8)), 4, 6));
    assert_same_history(pairs, tree);
}

void test_sleepers_wake_alike_with_either_search(void)
{
    cairn_world *pairs = trough(&memory), *tree = trough(&other_memory);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_quadtree_enable(tree, &tree_memory, cairn_vec2_of(0, CAIRN_F(8)), 4, 6));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_sleep_enable(pairs));
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_sleep_enable(tree));
    assert_same_history(pairs, tree);
    yard_def def = def_at(&crate, 0, 0);
    def.position = cairn_vec2_of(0, CAIRN_F(15));
    def.velocity = cairn_vec2_of(0, CAIRN_F(-20));
    make_in(pairs, &def);
    make_in(tree, &def);
    assert_same_history(pairs, tree);
}

/* Between steps bodies are made, destroyed and put elsewhere. */
static void disturb(cairn_world *world, int round)
{
    uint32_t seed = (uint32_t)round + 11;
    cairn_body_id id = cairn_world_next_body(world, cairn_body_id_null());
    for (int skip = random_between(&seed, 3, 20); skip > 0; skip--) {
        id = cairn_world_next_body(world, id);
    }
    if (round % 3 == 0) {
        TEST_ASSERT_EQUAL(CAIRN_OK, cairn_body_destroy(world, id));
        yard_def def = def_at(&crate, random_real(&seed, -2, 2), random_real(&seed, 12, 16));
        make_in(world, &def);
    } else if (round % 3 == 1) {
        cairn_vec2 to = cairn_vec2_of(random_real(&seed, -2, 2), random_real(&seed, 12, 16));
        TEST_ASSERT_EQUAL(CAIRN_OK, cairn_body_set_transform(world, id, to, CAIRN_RADIANS(0.3)));
    } else {
        cairn_vec2 speed = cairn_vec2_of(random_real(&seed, -2, 2), random_real(&seed, 5, 60));
        TEST_ASSERT_EQUAL(CAIRN_OK, cairn_body_set_velocity(world, id, speed));
    }
}

void test_a_tree_that_is_kept_follows_what_the_game_does(void)
{
    cairn_world *pairs = trough(&memory), *tree = trough(&other_memory);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_quadtree_enable(tree, &tree_memory, cairn_vec2_of(0, CAIRN_F(8)), 4, 6));
    for (int round = 0; round < 60; round++) {
        for (int step = 0; step < 7; step++) {
            TEST_ASSERT_EQUAL(CAIRN_OK, cairn_world_step(pairs));
            TEST_ASSERT_EQUAL(CAIRN_OK, cairn_world_step(tree));
            assert_same_state(pairs, tree);
        }
        disturb(pairs, round);
        disturb(tree, round);
    }
}

/* ---- the tree's size ---- */

static void add_grid(cairn_world *world, const cairn_shape *shape, int columns, int rows)
{
    yard_def def = def_at(shape, 0, 0);
    for (int i = 0; i < columns * rows; i++) {
        def.position = cairn_vec2_of(cairn_real_from_int(i % columns - columns / 2), cairn_real_from_int(1 + i / columns));
        TEST_ASSERT_FALSE(cairn_body_id_is_null(make_in(world, &def)));
    }
}

void test_a_long_floor_takes_few_entries(void)
{
    cairn_world *world = cairn_world_init(&memory, cairn_vec2_of(0, CAIRN_F(-10)));
    add_fixed(world, &floor_shape, 0, 0);
    add_grid(world, &crate, 15, 4);
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_quadtree_enable(world, &tree_memory, cairn_vec2_of(0, 0), 5, 10));
    world->broad->find_pairs(world);
    int of_floor = 0;
    for (int i = 0; i < world->stats.tree_entries; i++) {
        of_floor += world->tree->entries[i].body == 0 ? 1 : 0;
    }
    TEST_ASSERT_TRUE(world->stats.tree_cells > 4);
    TEST_ASSERT_TRUE(world->stats.tree_cells <= 61);
    TEST_ASSERT_TRUE(world->stats.tree_entries <= 4 * 61); /* crates on cell lines, the worst there is */
    TEST_ASSERT_TRUE(of_floor <= 24);
    TEST_ASSERT_EQUAL(0, world->stats.tree_full);
}

static const cairn_shape wide_crate = CAIRN_BOX(CAIRN_F(1), CAIRN_F(1));

void test_pairs_are_kept_where_there_is_room_for_them(void)
{
    cairn_world *world = cairn_world_init(&memory, cairn_vec2_of(0, 0));
    cairn_quadtree_storage storage = tree_memory;
    add_grid(world, &wide_crate, 6, 5);
    uint16_t pairs = 0;
    for (int i = 0; i < 2; i++) {
        bool room = i == 0;
        finding found;
        storage.entry_capacity = room ? ENTRIES : BODIES;
        TEST_ASSERT_EQUAL(CAIRN_OK, cairn_quadtree_enable(world, &storage, cairn_vec2_of(0, 0), 5, 1));
        search(world, &found);
        TEST_ASSERT_EQUAL(room, world->tree->knows_pairs);
        TEST_ASSERT_EQUAL(room ? 0 : 1, world->stats.tree_full);
        TEST_ASSERT_TRUE(found.pairs >= 49 && (room || found.pairs == pairs)); /* neighbours */
        pairs = found.pairs;
    }
}

void test_bodies_that_fill_the_world_do_not_split_it(void)
{
    cairn_world *world = cairn_world_init(&memory, cairn_vec2_of(0, CAIRN_F(-10)));
    for (int i = 0; i < 30; i++) {
        add_fixed(world, &floor_shape, 0, cairn_real_from_int(i % 3));
        add_fixed(world, &wall_shape, cairn_real_from_int(i % 3), 0);
    }
    TEST_ASSERT_EQUAL(CAIRN_OK, cairn_quadtree_enable(world, &tree_memory, cairn_vec2_of(0, 0), 4, 10));
    world->broad->find_pairs(world);
    TEST_ASSERT_EQUAL(1, world->stats.tree_cells);
    TEST_ASSERT_EQUAL(60, world->stats.tree_entries);
}

/* ---- what is refused ---- */

void test_bad_arguments_are_refused_and_leave_the_search_as_it_was(void)
{
    cairn_world *world = cairn_world_init(&memory, cairn_vec2_of(0, 0));
    const cairn_broad_class *before = world->broad;
    cairn_vec2 origin = cairn_vec2_of(0, 0);
    cairn_quadtree_storage storage = tree_memory;
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_quadtree_enable(NULL, &tree_memory, origin, 4, 4));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_quadtree_enable(world, NULL, origin, 4, 4));
    storage.tree = NULL;
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_quadtree_enable(world, &storage, origin, 4, 4));
    storage = tree_memory;
    storage.cells = NULL;
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_quadtree_enable(world, &storage, origin, 4, 4));
    storage = tree_memory;
    storage.entries = NULL;
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_quadtree_enable(world, &storage, origin, 4, 4));
    storage = tree_memory;
    storage.cell_capacity = 0;
    TEST_ASSERT_EQUAL(CAIRN_ERROR_FULL, cairn_quadtree_enable(world, &storage, origin, 4, 4));
    storage = tree_memory;
    storage.box_capacity = BODIES - 1;
    TEST_ASSERT_EQUAL(CAIRN_ERROR_FULL, cairn_quadtree_enable(world, &storage, origin, 4, 4));
    storage = tree_memory;
    storage.boxes = NULL;
    TEST_ASSERT_EQUAL(CAIRN_ERROR_NULL, cairn_quadtree_enable(world, &storage, origin, 4, 4));
    storage = tree_memory;
    storage.entry_capacity = BODIES - 1;
    TEST_ASSERT_EQUAL(CAIRN_ERROR_FULL, cairn_quadtree_enable(world, &storage, origin, 4, 4));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_quadtree_enable(world, &tree_memory, origin, -1, 4));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_quadtree_enable(world, &tree_memory, origin, 15, 4));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_quadtree_enable(world, &tree_memory, origin, 4, 0));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_quadtree_enable(world, &tree_memory, origin, 4, 11));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_quadtree_enable(world, &tree_memory, cairn_vec2_of(CAIRN_F(17000), 0), 4, 4));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_quadtree_enable(world, &tree_memory, cairn_vec2_of(CAIRN_F(-17000), 0), 4, 4));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_quadtree_enable(world, &tree_memory, cairn_vec2_of(0, CAIRN_F(17000)), 4, 4));
    TEST_ASSERT_EQUAL(CAIRN_ERROR_RANGE, cairn_quadtree_enable(world, &tree_memory, cairn_vec2_of(0, CAIRN_F(-17000)), 4, 4));
    world->locked = 1;
    TEST_ASSERT_EQUAL(CAIRN_ERROR_LOCKED, cairn_quadtree_enable(world, &tree_memory, origin, 4, 4));
    world->locked = 0;
    TEST_ASSERT_EQUAL(CAIRN_ERROR_LOCKED, cairn_world_error(world));
    TEST_ASSERT_TRUE(world->broad == before);
    TEST_ASSERT_NULL(world->tree);
}

void test_the_widest_and_the_smallest_tree_hold_bodies_at_the_edge_of_the_world(void)
{
    static finding expected, found;
    uint32_t seed = 9;
    for (int size_log2 = 0; size_log2 <= 14; size_log2 += 14) {
        cairn_world *world = cairn_world_init(&memory, cairn_vec2_of(0, 0));
        for (int i = 0; i < BODIES; i++) {
            add_body(world, &seed, SCATTERED, 1, i);
            world->bodies[i].x += i & 1 ? CAIRN_F(16000) - 1 : -CAIRN_F(16000) + 1;
            world->bodies[i].y += i & 2 ? CAIRN_F(16000) - 1 : -CAIRN_F(16000) + 1;
        }
        search(world, &expected);
        TEST_ASSERT_EQUAL(CAIRN_OK, cairn_quadtree_enable(world, &tree_memory, cairn_vec2_of(CAIRN_F(16000), CAIRN_F(16000)), size_log2, 10));
        search(world, &found);
        TEST_ASSERT_TRUE(expected.pairs > 20);
        TEST_ASSERT_EQUAL_MEMORY(&expected, &found, sizeof expected);
    }
}
