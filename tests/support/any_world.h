/*
 * Worlds, things and arguments at random, for the tests that call anything in any order. A world has a manner: how large, how fast and how far
 * from the origin all is, and how often an argument is one that no game should give.
 */
#ifndef CAIRN_TEST_ANY_WORLD_H
#define CAIRN_TEST_ANY_WORLD_H

#include "arith_random.h"

#include <cairn/cairn.h>

enum {
    ANY_BODIES = 40,
    ANY_ARBITERS = 110,
    ANY_SPRINGS = 48,
    ANY_SHAPES = 8,
    ANY_POLYGONS = 6,
    ANY_MATERIALS = 6,
    ANY_MODELS = 32,
    ANY_IDS = 32
};

/* Small pools are full most of the time; in large ones things stand and hang. */
CAIRN_WORLD(any_tight, 12, 24);
CAIRN_WORLD(any_wide, ANY_BODIES, ANY_ARBITERS);
CAIRN_SPRINGS(any_few, 8);
CAIRN_SPRINGS(any_many, ANY_SPRINGS);
CAIRN_SPRING_MESHES(any_nets, 6, 8, 60);
CAIRN_SPRING_MESHES(any_large_nets, ANY_BODIES, ANY_SPRINGS, 2000);
CAIRN_QUADTREE(any_tree, 12, 9, 40);
CAIRN_QUADTREE(any_large_tree, ANY_BODIES, 30, 400);
CAIRN_BLOCKS(any_blocks);

typedef struct any_manner {
    bool wide;         /* the large pools */
    bool tree;         /* if the quadtree is asked for: it gives the same bits as none */
    uint32_t odd;      /* one of so many arguments may be anything */
    uint32_t unit;     /* of lengths, 2^-16 */
    cairn_real speed;  /* m/s */
    cairn_vec2 origin; /* about which all lies */
    int longest;       /* steps without another call */
    int calls;
} any_manner;

static arith_random any_r;
static any_manner any;
static cairn_world *world;
static cairn_shape any_shapes[ANY_SHAPES];
static cairn_polygon any_polygons[ANY_POLYGONS];
static int any_polygon_count;
static cairn_material any_materials[ANY_MATERIALS];
static cairn_body_model any_models[ANY_MODELS];
static cairn_body_id any_ids[ANY_IDS]; /* live, stale or never made */
static cairn_spring_id any_spring_ids[ANY_IDS];

/* ---- arguments ---- */

static uint32_t below(uint32_t count) { return arith_random_bits(&any_r) % count; }
static bool one_in(uint32_t count) { return below(count) == 0; }
static cairn_real between(cairn_real low, cairn_real high) { return low + (cairn_real)below((uint32_t)(high - low) + 1); }
/* What a game would say, and now and then what none should. */
static cairn_real number(cairn_real low, cairn_real high) { return one_in(any.odd) ? arith_random_argument(&any_r) : between(low, high); }
static cairn_vec2 vector(cairn_real size) { return cairn_vec2_of(number(-size, size), number(-size, size)); }
static cairn_angle any_angle(void) { return one_in(3) ? 0 : (cairn_angle)arith_random_bits(&any_r); }

/* In the world's own unit. */
static cairn_real scaled(cairn_real x) { return (cairn_real)((int64_t)x * any.unit / 65536); }
static cairn_real length(cairn_real low, cairn_real high) { return one_in(any.odd) ? arith_random_argument(&any_r) : scaled(between(low, high)); }
static cairn_vec2 reach(cairn_real size) { return cairn_vec2_of(length(-size, size), length(-size, size)); }

static cairn_vec2 from_origin(cairn_real x, cairn_real y) { return cairn_vec2_of(any.origin.x + scaled(x), any.origin.y + scaled(y)); }
static cairn_vec2 any_place(cairn_real size)
{
    return one_in(any.odd) ? vector(size) : from_origin(between(-size, size), between(-size, size));
}

static cairn_wide any_amount(void)
{
    return cairn_wide_of((int32_t)(arith_random_bits(&any_r) >> below(31)) & 0x7FFFFFFF, one_in(20) ? 20 : -16);
}

/* Mostly one that lives. */
static cairn_body_id any_body(void)
{
    cairn_body_id id = cairn_body_id_null();
    id.index = (uint16_t)below(any.wide ? ANY_BODIES : 12);
    id = cairn_world_next_body(world, id);
    return cairn_body_id_is_null(id) || one_in(8) ? any_ids[below(ANY_IDS)] : id;
}

static cairn_spring_id any_spring(void)
{
    cairn_spring_id id = cairn_spring_id_null();
    id.index = (uint16_t)below(any.wide ? ANY_SPRINGS : 8);
    id = cairn_world_next_spring(world, id);
    return cairn_spring_id_is_null(id) || one_in(8) ? any_spring_ids[below(ANY_IDS)] : id;
}

/* ---- shapes, materials and models ---- */

static void make_shapes(void)
{
    const cairn_shape circle = CAIRN_CIRCLE(0), box = CAIRN_BOX(0, 0);
    for (int k = 0; k < ANY_SHAPES; k++) {
        const bool round = k < ANY_SHAPES / 2, thin = one_in(5);
        any_shapes[k] = round ? circle : box;
        any_shapes[k].size = cairn_vec2_of(length(CAIRN_F(0.05), CAIRN_F(1.5)), round ? 0 : length(CAIRN_F(0.05), thin ? CAIRN_F(0.1) : CAIRN_F(4)));
    }
    any_polygon_count = 0;
    for (int k = 0; k < ANY_POLYGONS; k++) {
        cairn_vec2 points[2 * CAIRN_MAX_VERTICES];
        const int count = (int)below(2 * CAIRN_MAX_VERTICES + 1);
        for (int i = 0; i < count; i++) {
            points[i] = reach(CAIRN_F(1));
        }
        any_polygon_count += cairn_polygon_init_hull(&any_polygons[any_polygon_count], points, count) == CAIRN_OK;
    }
}

static void make_materials(void)
{
    for (int k = 0; k < ANY_MATERIALS; k++) {
        cairn_material *m = &any_materials[k];
        m->static_friction = cairn_factor_from_real(between(0, one_in(4) ? CAIRN_F(4) : CAIRN_F(1)));
        m->kinetic_friction = one_in(2) ? m->static_friction : cairn_factor_from_real(between(0, CAIRN_F(1)));
        m->restitution = one_in(2) ? 0 : cairn_factor_from_real(between(0, CAIRN_F(1)));
        m->threshold = one_in(2) ? 0 : number(0, CAIRN_F(2));
        m->bounce = m->restitution == 0 || one_in(any.odd) ? NULL : &cairn_bounce;
    }
}

/* One thing of a model, or more. */
static void vary(cairn_body_model *m)
{
    switch (below(10)) {
    case 0: m->material = &any_materials[below(ANY_MATERIALS)]; break;
    case 1: m->density = one_in(2) ? any_amount() : cairn_wide_from_real(between(CAIRN_F(0.1), CAIRN_F(5))); break;
    case 2: m->gravity_scale = number(CAIRN_F(-2), CAIRN_F(2)); break;
    case 3: m->damping = number(0, CAIRN_F(3)); break;
    case 4: m->angular_damping = number(0, CAIRN_F(3)); break;
    case 5: m->layer = (uint16_t)arith_random_bits(&any_r); break;
    case 6: m->mask = (uint16_t)arith_random_bits(&any_r); break;
    case 7: m->sensor = !m->sensor; break;
    case 8: m->fixed_rotation = !m->fixed_rotation; break;
    default: m->fixed_position = !m->fixed_position; break;
    }
}

static void make_models(void)
{
    const cairn_body_model plain = CAIRN_BODY_MODEL(CAIRN_DYNAMIC, &any_shapes[0], &cairn_material_default);
    for (int k = 0; k < ANY_MODELS; k++) {
        cairn_body_model *m = &any_models[k];
        if (k > 0 && one_in(2)) { /* of the same shape and type, so that a body may change from one to the other */
            *m = any_models[k - 1];
        } else {
            *m = plain;
            m->type = one_in(5) ? CAIRN_STATIC : one_in(5) ? CAIRN_KINEMATIC : CAIRN_DYNAMIC;
            m->shape = any_polygon_count > 0 && one_in(3) ? &any_polygons[below((uint32_t)any_polygon_count)].shape : &any_shapes[below(ANY_SHAPES)];
        }
        for (uint32_t changes = below(4); changes > 0; changes--) {
            vary(m);
        }
    }
}

static const cairn_body_model *any_model(void) { return one_in(40) ? NULL : &any_models[below(ANY_MODELS)]; }

/* Mostly one that the body may have. */
static const cairn_body_model *model_for(cairn_body_id id)
{
    const cairn_body_model *now = cairn_body_get_model(world, id);
    const uint32_t from = below(ANY_MODELS);
    for (uint32_t k = 0; now != NULL && !one_in(10) && k < ANY_MODELS; k++) {
        const cairn_body_model *model = &any_models[(from + k) % ANY_MODELS];
        if (model->shape == now->shape && model->type == now->type && model != now) {
            return model;
        }
    }
    return any_model();
}

/* The first dynamic model from some place on. */
static const cairn_body_model *mobile_model(void)
{
    const uint32_t from = below(ANY_MODELS);
    for (uint32_t k = 0; k < ANY_MODELS; k++) {
        if (any_models[(from + k) % ANY_MODELS].type == CAIRN_DYNAMIC) {
            return &any_models[(from + k) % ANY_MODELS];
        }
    }
    return &any_models[from];
}

/* ---- the world ---- */

#define FAR CAIRN_F(15900)
static cairn_real within(cairn_real x, cairn_real limit) { return x > limit ? limit : x < -limit ? -limit : x; }

static void choose_manner(uint32_t seed)
{
    static const cairn_real units[] = { CAIRN_F(1), CAIRN_F(1), CAIRN_F(1), CAIRN_F(0.02), CAIRN_F(0.1), CAIRN_F(0.4), CAIRN_F(8), CAIRN_F(50) };
    static const uint32_t odds[] = { 12, 60, 400, 1u << 30 };
    any_r = arith_random_seeded(seed);
    any.wide = one_in(2);
    any.odd = odds[below(4)];
    any.unit = (uint32_t)units[below(8)];
    any.speed = one_in(3) ? CAIRN_F(300) : one_in(2) ? CAIRN_F(20) : CAIRN_F(1);
    any.longest = one_in(2) ? 1 : one_in(2) ? 8 : 80;
    any.calls = any.longest == 80 ? 30 : 120;
    any.origin = one_in(2) ? cairn_vec2_of(0, 0) : vector(FAR);
    any.origin = cairn_vec2_of(within(any.origin.x, FAR), within(any.origin.y, FAR));
}

static void find_pairs_by_tree(void)
{
    const int size = (int)below(8), depth = (int)below(8);
    const cairn_vec2 center = any_place(CAIRN_F(3));
    if (any.tree) {
        (void)cairn_quadtree_enable(world, any.wide ? &any_large_tree : &any_tree, center, size, depth);
    }
}

static void open_any_world(void)
{
    make_shapes();
    make_materials();
    make_models();
    world = cairn_world_init_with(any.wide ? &any_wide : &any_tight, cairn_vec2_of(0, CAIRN_F(-10)), &cairn_solver_soft, one_in(4) ? NULL : &cairn_continuous);
    for (int k = 0; k < ANY_IDS; k++) {
        any_ids[k].index = (uint16_t)below(15);
        any_ids[k].generation = (uint16_t)below(3);
        any_spring_ids[k].index = (uint16_t)below(11);
        any_spring_ids[k].generation = (uint16_t)below(3);
    }
    if (!one_in(4)) {
        (void)cairn_springs_enable(world, any.wide ? &any_many : &any_few);
    }
    if (one_in(2)) {
        (void)cairn_meshes_enable(world, any.wide ? &any_large_nets : &any_nets);
    }
    if (one_in(2)) {
        find_pairs_by_tree();
    }
    if (one_in(2)) {
        (void)cairn_blocks_enable(world, &any_blocks);
    }
    if (one_in(4)) {
        (void)(one_in(2) ? cairn_world_use_slides_solver(world, (int)below(20)) : cairn_world_use_small_solver(world, (int)below(20)));
    }
    if (one_in(2)) {
        (void)cairn_sleep_enable(world);
    }
}

/* ---- what a game builds ---- */

static cairn_body_id keep(cairn_body_id id)
{
    if (!cairn_body_id_is_null(id)) {
        any_ids[below(ANY_IDS)] = id; /* whoever was here is known to the world alone from now on */
    }
    return id;
}

static cairn_body_id put_model(const cairn_body_model *model, cairn_real x, cairn_real y)
{
    return keep(cairn_body_create(world, model, from_origin(x, y), 0));
}

static void build_stack(void)
{
    const cairn_body_model *model = mobile_model(), *heavy = one_in(3) ? mobile_model() : model;
    const cairn_real height = between(CAIRN_F(0.1), CAIRN_F(1)), x = between(CAIRN_F(-2), CAIRN_F(2));
    const uint32_t count = below(8) + 2;
    for (uint32_t k = 0; k < count; k++) {
        (void)put_model(k + 1 == count ? heavy : model, x, (cairn_real)k * height);
    }
}

static cairn_spring_id any_bond(cairn_body_id a, cairn_body_id b)
{
    cairn_spring_def def = cairn_spring_def_default(a, b);
    const bool tuned = one_in(2), off_centre = one_in(3);
    if (off_centre) {
        def.anchor_a = reach(CAIRN_F(1));
        def.anchor_b = reach(CAIRN_F(1));
    }
    def.rest_length = one_in(2) ? CAIRN_F(-1) : one_in(4) ? 0 : length(0, CAIRN_F(3));
    def.stiffness = any_amount();
    def.damping = one_in(2) ? any_amount() : cairn_wide_zero();
    def.no_contact = one_in(2);
    if (tuned) {
        (void)cairn_spring_tune(world, &def, number(CAIRN_F(0.1), CAIRN_F(60)), number(0, CAIRN_F(2)));
    }
    const cairn_spring_id id = cairn_spring_create(world, &def);
    any_spring_ids[below(ANY_IDS)] = id;
    return id;
}

/* A rope, a ladder or one with diagonals, hung up at its first body or free. */
static void build_net(void)
{
    const cairn_body_model *model = mobile_model();
    const uint32_t rungs = below(6) + 2, rails = below(3) + 1;
    const bool crossed = one_in(2), hung = one_in(2), upright = one_in(2);
    cairn_body_id row[3], above[3];
    for (uint32_t k = 0; k < rungs; k++) {
        for (uint32_t i = 0; i < rails; i++) {
            const cairn_real along = (cairn_real)k * CAIRN_F(0.6), beside = (cairn_real)i * CAIRN_F(0.5);
            row[i] = put_model(hung && k == 0 ? any_model() : model, upright ? beside : along, upright ? along : beside);
            if (k > 0) {
                (void)any_bond(above[i], row[i]);
            }
            if (i > 0) {
                (void)any_bond(row[i - 1], row[i]);
            }
            if (crossed && k > 0 && i > 0) {
                (void)any_bond(above[i - 1], row[i]);
            }
        }
        memcpy(above, row, sizeof above);
    }
}

/* A floor or a wall of the largest shape there is. */
static void build_floor(void)
{
    const cairn_body_model *floor = NULL;
    for (int k = 0; k < ANY_MODELS; k++) {
        const cairn_body_model *m = &any_models[k];
        if (m->type == CAIRN_STATIC && (floor == NULL || m->shape->size.x > floor->shape->size.x)) {
            floor = m;
        }
    }
    for (int k = -1; k <= 1; k++) {
        (void)put_model(floor, (cairn_real)k * CAIRN_F(1.5), CAIRN_F(-2));
    }
}

static void build(void)
{
    switch (below(4)) {
    case 0: build_stack(); break;
    case 1: build_net(); break;
    case 2: build_floor(); break;
    default: (void)keep(cairn_body_create(world, any_model(), any_place(CAIRN_F(3)), any_angle())); break;
    }
}

#endif
