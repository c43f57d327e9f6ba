/* The search without a tree finds each pair of bodies whose boxes overlap once, however bodies come, go and move about. */
#include <cairn/cairn.h>
#include <unity.h>

#define YARD_MODELS 2
#include "bodies.h"
#include "engine.h"
#include "test_number.h"

enum { BODIES = 40, STEPS = 200 };

CAIRN_WORLD(memory, BODIES, 100);

static const cairn_shape crate = CAIRN_BOX(CAIRN_F(0.5), CAIRN_F(0.5));
static const cairn_shape tile = CAIRN_BOX(CAIRN_F(3), CAIRN_F(0.25));

static uint8_t times[BODIES][BODIES];

void setUp(void) { yard_model_count = 0; }
void tearDown(void) {}

/* Asked by the engine of every pair that may meet, if both bodies have springs: says that they do not. */
static bool record(const cairn_world *world, uint16_t a, uint16_t b)
{
    (void)world;
    times[a < b ? a : b][a < b ? b : a]++;
    return true;
}

static void search(cairn_world *world)
{
    cairn_spring_class recording;
    cairn_spring_pool pool;
    memset(&recording, 0, sizeof recording);
    memset(&pool, 0, sizeof pool);
    memset(times, 0, sizeof times);
    recording.joined = record;
    pool.kind = &recording;
    world->springs = &pool;
    world->broad->find_pairs(world);
    world->springs = NULL;
}

static bool should_meet(const cairn_world *world, uint16_t i, uint16_t j)
{
    const cairn_body *a = &world->bodies[i], *b = &world->bodies[j];
    return (a->flags & CAIRN_BODY_USED) && (b->flags & CAIRN_BODY_USED) && (cairn_body_is_active(a) || cairn_body_is_active(b))
        && (cairn_body_is_dynamic(a) || cairn_body_is_dynamic(b)) && cairn_boxes_are_near(a, b, 0);
}

/* Boxes that overlap at their corners only are not asked about, where the discs around the bodies do not. */
static bool discs_overlap(const cairn_body *a, const cairn_body *b)
{
    cairn_vec2 size_a = a->model->shape->size, size_b = b->model->shape->size;
    cairn_real across = cairn_real_length(size_a.x, size_a.y) + cairn_real_length(size_b.x, size_b.y);
    return cairn_real_length(a->x - b->x, a->y - b->y) <= cairn_real_half(across);
}

static int assert_each_pair_once(const cairn_world *world)
{
    int pairs = 0;
    for (uint16_t i = 0; i < world->body_end; i++) {
        for (uint16_t j = (uint16_t)(i + 1); j < world->body_end; j++) {
            bool meet = should_meet(world, i, j);
            TEST_ASSERT_TRUE(times[i][j] <= (meet ? 1 : 0));
            TEST_ASSERT_TRUE(times[i][j] == 1 || !meet || !discs_overlap(&world->bodies[i], &world->bodies[j]));
            pairs += times[i][j];
        }
    }
    return pairs;
}

static void assert_sorted(const cairn_world *world)
{
    for (uint16_t place = 1; place < world->sorted_count; place++) {
        uint16_t i = world->sorted[place - 1], j = world->sorted[place];
        const cairn_body *a = &world->bodies[i], *b = &world->bodies[j];
        cairn_real left = a->x - cairn_real_from_extent(a->extent_x), next = b->x - cairn_real_from_extent(b->extent_x);
        TEST_ASSERT_TRUE(left < next || (left == next && i < j));
    }
}

/* On a grid, so that many boxes begin at the same x. */
static cairn_vec2 some_place(uint32_t *seed)
{
    cairn_real x = cairn_real_half(cairn_real_from_int(random_between(seed, -6, 6)));
    cairn_real y = cairn_real_half(cairn_real_from_int(random_between(seed, -6, 6)));
    return cairn_vec2_of(x, y);
}

static void make_one(cairn_world *world, uint32_t *seed)
{
    yard_def def = def_at(random_between(seed, 0, 4) == 0 ? &tile : &crate, 0, 0);
    def.type = random_between(seed, 0, 3) == 0 ? CAIRN_STATIC : CAIRN_DYNAMIC;
    def.position = some_place(seed);
    yard_model_count = 0; /* all share one model: only their boxes count here */
    cairn_body_id id = make_in(world, &def);
    if (!cairn_body_id_is_null(id)) {
        world->bodies[id.index - 1].flags |= CAIRN_BODY_SPRUNG;
    }
}

/* Any body there is, or null. */
static cairn_body_id some_body(const cairn_world *world, uint32_t *seed)
{
    cairn_body_id id = cairn_world_next_body(world, cairn_body_id_null());
    for (int skip = random_between(seed, 0, BODIES - 1); skip > 0 && !cairn_body_id_is_null(id); skip--) {
        id = cairn_world_next_body(world, id);
    }
    return id;
}

void test_bodies_that_come_go_and_move_are_paired_each_once(void)
{
    cairn_world *world = cairn_world_init(&memory, cairn_vec2_of(0, 0));
    uint32_t seed = 11;
    int pairs = 0;
    for (int step = 0; step < STEPS; step++) {
        for (int i = random_between(&seed, 0, 3); i > 0; i--) {
            make_one(world, &seed);
        }
        cairn_body_id gone = random_between(&seed, 0, 2) == 0 ? some_body(world, &seed) : cairn_body_id_null();
        if (!cairn_body_id_is_null(gone)) {
            TEST_ASSERT_EQUAL(CAIRN_OK, cairn_body_destroy(world, gone));
        }
        cairn_body_id moved = some_body(world, &seed);
        if (!cairn_body_id_is_null(moved)) {
            TEST_ASSERT_EQUAL(CAIRN_OK, cairn_body_set_transform(world, moved, some_place(&seed), 0));
        }
        search(world);
        pairs += assert_each_pair_once(world);
        assert_sorted(world);
    }
    TEST_ASSERT_EQUAL(BODIES, world->body_end);
    TEST_ASSERT_TRUE(pairs > 10 * STEPS);
}

void test_sleepers_and_static_bodies_are_not_paired_with_one_another(void)
{
    cairn_world *world = cairn_world_init(&memory, cairn_vec2_of(0, 0));
    uint32_t seed = 12;
    for (int i = 0; i < BODIES; i++) {
        make_one(world, &seed);
        if (i % 2 == 0) {
            world->bodies[i].flags |= CAIRN_BODY_ASLEEP;
        }
    }
    search(world);
    TEST_ASSERT_GREATER_THAN(10, assert_each_pair_once(world));
}
