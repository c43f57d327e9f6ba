/*
 * See shim.h. Positions, velocities and spins are read from the bodies themselves and not through the API: the engine
 * keeps more bits of them than Q16.16 shows.
 */
#include "shim.h"

#include <cairn/cairn.h>

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

typedef struct any_shape {
    cairn_shape plain;
    cairn_polygon polygon;
    const cairn_shape *shape; /* one of the two */
} any_shape;

/* Shapes, materials and models stay where they are: the engine points to them. */
typedef struct list {
    void **items;
    int count, capacity;
} list;

struct shim_world {
    cairn_world_storage storage;
    cairn_spring_storage springs;
    cairn_mesh_storage meshes;
    cairn_quadtree_storage tree;
    cairn_block blocks;
    cairn_world *world;
    list shapes, materials, models;
};

/* ---- numbers ---- */

#ifdef CAIRN_DOUBLE

static cairn_real real_of(double x) { return cairn_clamp(x, CAIRN_REAL_MAX); }
static cairn_wide wide_of(double x) { return x; }
static double from_real(cairn_real x) { return x; }
static double from_wide(cairn_wide x) { return x; }
static double from_motion(cairn_motion x) { return x; }
static double from_velocity(cairn_motion v, cairn_carry carry) { return v + 0.0 * carry; }
static double from_coordinate(cairn_real x, cairn_residue residue) { return x + 0.0 * residue; }
static double from_angle(cairn_angle x) { return remainder(x, 2 * PI); }
static cairn_factor factor_of(double x) { return x; }

#else

static int32_t cut(double x)
{
    return x >= 2147483647.0 ? INT32_MAX : x <= -2147483648.0 ? INT32_MIN : (int32_t)floor(x + 0.5);
}
static cairn_real real_of(double x) { return cut(x * 65536.0); }
static cairn_factor factor_of(double x) { return cut(x * 1048576.0); }
static cairn_wide wide_of(double x)
{
    int exponent = 0;
    const double fraction = frexp(x, &exponent);
    return cairn_wide_of(cut(fraction * 1073741824.0), exponent - 30);
}
static double from_real(cairn_real x) { return x / 65536.0; }
static double from_wide(cairn_wide x) { return ldexp((double)x.mantissa, x.exponent); }
static double from_motion(cairn_motion x) { return x / 268435456.0; }
static double from_velocity(cairn_motion v, cairn_carry carry) { return v / 268435456.0 + carry / 8796093022208.0; }
static double from_coordinate(cairn_real x, cairn_residue residue) { return x / 65536.0 + residue / 268435456.0; }
static double from_angle(cairn_angle x) { return x * (PI / 2147483648.0); }

#endif

static cairn_angle angle_of(double radians)
{
    const double turn = remainder(radians, 2 * PI);
    return CAIRN_RADIANS(turn);
}

static cairn_vec2 pair_of(double x, double y) { return cairn_vec2_of(real_of(x), real_of(y)); }

/* ---- names ---- */

static int64_t name_of_body(cairn_body_id id) { return (int64_t)id.generation << 16 | id.index; }

static cairn_body_id body_of(int64_t name)
{
    cairn_body_id id;
    id.index = (uint16_t)(name & 0xFFFF);
    id.generation = (uint16_t)(name >> 16 & 0xFFFF);
    return id;
}

static cairn_spring_id spring_of(int64_t name)
{
    cairn_spring_id id;
    id.index = (uint16_t)(name & 0xFFFF);
    id.generation = (uint16_t)(name >> 16 & 0xFFFF);
    return id;
}

/* Takes what malloc gave; the name of the item, or a status. */
static int keep(list *items, void *item)
{
    if (item != NULL && items->count == items->capacity) {
        const int capacity = 2 * items->capacity + 8;
        void **larger = realloc(items->items, (size_t)capacity * sizeof *larger);
        if (larger == NULL) {
            free(item);
            return CAIRN_ERROR_FULL;
        }
        items->items = larger;
        items->capacity = capacity;
    }
    if (item == NULL) {
        return CAIRN_ERROR_FULL;
    }
    items->items[items->count++] = item;
    return items->count;
}

static void *item_of(const list *items, int name) { return name >= 1 && name <= items->count ? items->items[name - 1] : NULL; }

static void forget(list *items)
{
    for (int i = 0; i < items->count; i++) {
        free(items->items[i]);
    }
    free(items->items);
}

/* ---- worlds ---- */

static bool has_memory(const shim_world *w)
{
    return w->storage.world != NULL && w->storage.bodies != NULL && w->storage.arbiters != NULL && w->storage.order != NULL && w->storage.swept != NULL && w->storage.sorted != NULL
        && w->springs.pool != NULL && w->springs.springs != NULL && w->tree.tree != NULL && w->tree.cells != NULL
        && w->tree.boxes != NULL && w->tree.entries != NULL && w->meshes.mesh != NULL && w->meshes.parts != NULL && w->meshes.nodes != NULL
        && w->meshes.rows != NULL && w->meshes.links != NULL && w->meshes.entries != NULL;
}

shim_world *shim_create(int bodies, int arbiters, int springs, int cells, double gravity_x, double gravity_y)
{
    enum { MOST = 65000, MESH_ENTRIES = 64 }; /* a spring */
    if (bodies < 1 || bodies > MOST || arbiters < 1 || arbiters > MOST || springs < 0 || springs > MOST || cells < 0 || cells > MOST) {
        return NULL;
    }
    shim_world *w = calloc(1, sizeof *w);
    if (w == NULL) {
        return NULL;
    }
    const int entries = cells > 0 ? (4 * bodies < MOST ? 4 * bodies : MOST) : 0;
    w->storage.world = calloc(1, sizeof(cairn_world));
    w->storage.bodies = calloc((size_t)bodies, sizeof(cairn_body));
    w->storage.arbiters = calloc((size_t)arbiters, sizeof(cairn_arbiter));
    w->storage.order = calloc((size_t)arbiters, sizeof(uint16_t));
    w->storage.swept = calloc((size_t)arbiters, sizeof(uint16_t));
    w->storage.sorted = calloc((size_t)bodies, sizeof(uint16_t));
    w->storage.body_capacity = (uint16_t)bodies;
    w->storage.arbiter_capacity = (uint16_t)arbiters;
    w->springs.pool = calloc(1, sizeof(cairn_spring_pool));
    w->springs.springs = calloc((size_t)springs + 1, sizeof(cairn_spring));
    w->springs.capacity = (uint16_t)springs;
    w->tree.tree = calloc(1, sizeof(cairn_quadtree));
    w->tree.boxes = calloc((size_t)bodies, sizeof(cairn_quadtree_box));
    w->tree.box_capacity = (uint16_t)bodies;
    w->tree.cells = calloc((size_t)cells + 1, sizeof(cairn_quadtree_cell));
    w->tree.entries = calloc((size_t)entries + 1, sizeof(cairn_quadtree_entry));
    w->tree.cell_capacity = (uint16_t)cells;
    w->tree.entry_capacity = (uint16_t)entries;
    w->meshes.mesh = calloc(1, sizeof(cairn_mesh));
    w->meshes.parts = calloc((size_t)springs + 1, sizeof(cairn_mesh_part));
    w->meshes.nodes = calloc((size_t)springs + 1, sizeof(cairn_mesh_node));
    w->meshes.rows = calloc((size_t)springs + 1, 3 * sizeof(cairn_mesh_row));
    w->meshes.links = calloc((size_t)springs + 1, sizeof(cairn_mesh_link));
    w->meshes.entries = calloc((size_t)springs + 1, MESH_ENTRIES * sizeof(cairn_share));
    w->meshes.bodies = (uint16_t)(springs < 20000 ? springs : 20000);
    w->meshes.springs = (uint16_t)springs;
    w->meshes.entry_count = (uint32_t)springs * MESH_ENTRIES;
    w->world = has_memory(w) ? cairn_world_init(&w->storage, pair_of(gravity_x, gravity_y)) : NULL;
    if (w->world == NULL || cairn_blocks_enable(w->world, &w->blocks) != CAIRN_OK || (springs > 0 && cairn_springs_enable(w->world, &w->springs) != CAIRN_OK)) {
        shim_destroy(w);
        return NULL;
    }
    return w;
}

void shim_destroy(shim_world *w)
{
    if (w == NULL) {
        return;
    }
    free(w->storage.world);
    free(w->storage.bodies);
    free(w->storage.arbiters);
    free(w->storage.order);
    free(w->storage.swept);
    free(w->storage.sorted);
    free(w->springs.pool);
    free(w->springs.springs);
    free(w->meshes.mesh);
    free(w->meshes.parts);
    free(w->meshes.nodes);
    free(w->meshes.rows);
    free(w->meshes.links);
    free(w->meshes.entries);
    free(w->tree.tree);
    free(w->tree.boxes);
    free(w->tree.cells);
    free(w->tree.entries);
    forget(&w->shapes);
    forget(&w->materials);
    forget(&w->models);
    free(w);
}

int shim_set_gravity(shim_world *w, double x, double y) { return cairn_world_set_gravity(w->world, pair_of(x, y)); }
int shim_set_rate(shim_world *w, double steps_per_second) { return cairn_world_set_rate(w->world, real_of(steps_per_second)); }
int shim_set_substeps(shim_world *w, int substeps) { return cairn_world_set_substeps(w->world, substeps); }
int shim_set_slop(shim_world *w, double slop) { return cairn_world_set_slop(w->world, real_of(slop)); }
int shim_set_push_out(shim_world *w, double speed) { return cairn_world_set_push_out(w->world, real_of(speed)); }
int shim_set_sleep(shim_world *w, int on) { return on ? cairn_sleep_enable(w->world) : cairn_sleep_disable(w->world); }
int shim_use_slides_solver(shim_world *w, int passes) { return cairn_world_use_slides_solver(w->world, passes); }
int shim_use_small_solver(shim_world *w, int passes) { return cairn_world_use_small_solver(w->world, passes); }
int shim_use_quadtree(shim_world *w, double x, double y, int size_log2, int depth)
{
    return cairn_quadtree_enable(w->world, &w->tree, pair_of(x, y), size_log2, depth);
}
double shim_speed_limit(const shim_world *w) { return from_real(cairn_world_speed_limit(w->world)); }

/* ---- shapes and materials ---- */

static int keep_plain(shim_world *w, cairn_shape shape)
{
    any_shape *item = calloc(1, sizeof *item);
    if (item != NULL) {
        item->plain = shape;
        item->shape = &item->plain;
    }
    return keep(&w->shapes, item);
}

static int keep_polygon(shim_world *w, any_shape *item, cairn_status status)
{
    if (status != CAIRN_OK) {
        free(item);
        return status;
    }
    item->shape = &item->polygon.shape;
    return keep(&w->shapes, item);
}

int shim_circle(shim_world *w, double radius)
{
    const cairn_shape shape = CAIRN_CIRCLE(real_of(radius));
    return keep_plain(w, shape);
}

int shim_box(shim_world *w, double width, double height)
{
    const cairn_shape shape = CAIRN_BOX(real_of(width), real_of(height));
    return keep_plain(w, shape);
}

int shim_polygon(shim_world *w, const double *points, int count)
{
    cairn_vec2 corners[CAIRN_MAX_VERTICES];
    if (count < 0 || count > CAIRN_MAX_VERTICES) {
        return CAIRN_ERROR_RANGE;
    }
    any_shape *item = calloc(1, sizeof *item);
    if (item == NULL) {
        return CAIRN_ERROR_FULL;
    }
    for (int i = 0; i < count; i++) {
        corners[i] = pair_of(points[2 * i], points[2 * i + 1]);
    }
    return keep_polygon(w, item, cairn_polygon_init(&item->polygon, corners, count));
}

int shim_regular(shim_world *w, int sides, double radius)
{
    any_shape *item = calloc(1, sizeof *item);
    if (item == NULL) {
        return CAIRN_ERROR_FULL;
    }
    return keep_polygon(w, item, cairn_polygon_init_regular(&item->polygon, sides, real_of(radius)));
}

int shim_material(shim_world *w, double static_friction, double kinetic_friction, double restitution, double threshold)
{
    cairn_material *item = calloc(1, sizeof *item);
    if (item != NULL) {
        item->static_friction = factor_of(static_friction);
        item->kinetic_friction = factor_of(kinetic_friction);
        item->restitution = restitution > 0 ? factor_of(restitution) : 0;
        item->threshold = real_of(threshold);
        item->bounce = restitution >= 0 ? &cairn_bounce : NULL;
    }
    return keep(&w->materials, item);
}

/* ---- bodies ---- */

/* Each body has a model of its own here: scenes are made once, and any of it may be changed. */
static const cairn_body_model *keep_model(shim_world *w, const cairn_body_model *model)
{
    cairn_body_model *item = calloc(1, sizeof *item);
    if (item != NULL) {
        *item = *model;
    }
    return item_of(&w->models, keep(&w->models, item));
}

int64_t shim_body(shim_world *w, int shape, int material, int type, int flags, double density, double x, double y, double angle,
                  double vx, double vy, double omega)
{
    const any_shape *item = item_of(&w->shapes, shape);
    if (item == NULL || (material != 0 && item_of(&w->materials, material) == NULL)) {
        return CAIRN_ERROR_NULL;
    }
    cairn_body_model model = cairn_body_model_default(item->shape);
    if (material != 0) {
        model.material = item_of(&w->materials, material);
    }
    model.type = (cairn_body_type)type;
    model.density = wide_of(density);
    model.sensor = (flags & SHIM_SENSOR) != 0;
    model.fixed_rotation = (flags & SHIM_FIXED_ROTATION) != 0;
    model.fixed_position = (flags & SHIM_FIXED_POSITION) != 0;
    const cairn_body_id id = cairn_body_create(w->world, keep_model(w, &model), pair_of(x, y), angle_of(angle));
    if (cairn_body_id_is_null(id)) {
        return cairn_world_error(w->world);
    }
    if (model.type != CAIRN_STATIC) {
        (void)cairn_body_set_velocity(w->world, id, pair_of(vx, vy));
        (void)cairn_body_set_angular_velocity(w->world, id, real_of(omega));
    }
    return name_of_body(id);
}

int shim_body_destroy(shim_world *w, int64_t body) { return cairn_body_destroy(w->world, body_of(body)); }
int shim_body_set_transform(shim_world *w, int64_t body, double x, double y, double angle)
{
    return cairn_body_set_transform(w->world, body_of(body), pair_of(x, y), angle_of(angle));
}
int shim_body_set_velocity(shim_world *w, int64_t body, double vx, double vy, double omega)
{
    const cairn_status status = cairn_body_set_velocity(w->world, body_of(body), pair_of(vx, vy));
    return status != CAIRN_OK ? status : cairn_body_set_angular_velocity(w->world, body_of(body), real_of(omega));
}
/* The model of a body, to be changed; any, where there is no such body, which cairn_body_set_model() refuses. */
static cairn_body_model model_of(const shim_world *w, int64_t body)
{
    const cairn_body_model *model = cairn_body_get_model(w->world, body_of(body));
    return model != NULL ? *model : cairn_body_model_default(NULL);
}

int shim_body_set_layers(shim_world *w, int64_t body, int layer, int mask)
{
    cairn_body_model model = model_of(w, body);
    model.layer = (uint16_t)layer;
    model.mask = (uint16_t)mask;
    return cairn_body_set_model(w->world, body_of(body), keep_model(w, &model));
}
int shim_body_set_damping(shim_world *w, int64_t body, double linear, double angular)
{
    cairn_body_model model = model_of(w, body);
    model.damping = real_of(linear);
    model.angular_damping = real_of(angular);
    return cairn_body_set_model(w->world, body_of(body), keep_model(w, &model));
}
int shim_body_set_gravity_scale(shim_world *w, int64_t body, double scale)
{
    cairn_body_model model = model_of(w, body);
    model.gravity_scale = real_of(scale);
    return cairn_body_set_model(w->world, body_of(body), keep_model(w, &model));
}
int shim_body_force(shim_world *w, int64_t body, double fx, double fy, double x, double y)
{
    return cairn_body_apply_force_at(w->world, body_of(body), pair_of(fx, fy), pair_of(x, y));
}
int shim_body_impulse(shim_world *w, int64_t body, double px, double py, double x, double y)
{
    return cairn_body_apply_impulse_at(w->world, body_of(body), pair_of(px, py), pair_of(x, y));
}
double shim_body_mass(shim_world *w, int64_t body) { return from_wide(cairn_body_mass(w->world, body_of(body))); }
double shim_body_inertia(shim_world *w, int64_t body) { return from_wide(cairn_body_inertia(w->world, body_of(body))); }

/* ---- springs ---- */

int64_t shim_spring(shim_world *w, int64_t a, int64_t b, double ax, double ay, double bx, double by, double rest_length,
                    double stiffness, double damping, int no_contact)
{
    cairn_spring_def def = cairn_spring_def_default(body_of(a), body_of(b));
    def.anchor_a = pair_of(ax, ay);
    def.anchor_b = pair_of(bx, by);
    def.rest_length = real_of(rest_length);
    def.stiffness = wide_of(stiffness);
    def.damping = wide_of(damping);
    def.no_contact = no_contact != 0;
    const cairn_spring_id id = cairn_spring_create(w->world, &def);
    return cairn_spring_id_is_null(id) ? cairn_world_error(w->world) : (int64_t)id.generation << 16 | id.index;
}

int shim_use_meshes(shim_world *w) { return cairn_meshes_enable(w->world, &w->meshes); }

int shim_spring_destroy(shim_world *w, int64_t spring) { return cairn_spring_destroy(w->world, spring_of(spring)); }

/* ---- time ---- */

int shim_step(shim_world *w, int steps)
{
    cairn_status status = CAIRN_OK;
    for (int i = 0; i < steps && status == CAIRN_OK; i++) {
        status = cairn_world_step(w->world);
    }
    return status;
}

static void state(shim_world *w, cairn_body_id id, double *out)
{
    if (!cairn_body_exists(w->world, id)) {
        for (int k = 0; k < SHIM_STATE; k++) {
            out[k] = (double)NAN;
        }
        return;
    }
    const cairn_body *body = &w->world->bodies[id.index - 1];
    const double rate = from_wide(w->world->inverse_substep);
    out[0] = from_coordinate(body->x, body->x_residue);
    out[1] = from_coordinate(body->y, body->y_residue);
    out[2] = from_angle(body->angle);
    out[3] = from_velocity(body->vx, body->vx_carry) * rate;
    out[4] = from_velocity(body->vy, body->vy_carry) * rate;
    out[5] = from_motion(body->w) * rate * from_wide(cairn_wide_unpack(body->inverse_gyration));
}

void shim_states(shim_world *w, const int64_t *bodies, int count, double *out)
{
    for (int i = 0; i < count; i++) {
        state(w, body_of(bodies[i]), out + (ptrdiff_t)SHIM_STATE * i);
    }
}

int shim_record(shim_world *w, int steps, int every, const int64_t *bodies, int count, double *out)
{
    shim_states(w, bodies, count, out);
    for (int step = 1; step <= steps; step++) {
        const cairn_status status = cairn_world_step(w->world);
        if (status != CAIRN_OK) {
            return status;
        }
        if (every > 0 && step % every == 0) {
            out += (ptrdiff_t)SHIM_STATE * count;
            shim_states(w, bodies, count, out);
        }
    }
    return CAIRN_OK;
}

/* ---- what there is to know ---- */

int shim_contacts(shim_world *w, double *out, int capacity)
{
    cairn_contact contact;
    int cursor = 0;
    int count = 0;
    while (cairn_world_next_contact(w->world, &cursor, &contact)) {
        if (count++ >= capacity) {
            continue;
        }
        out[0] = (double)name_of_body(contact.a);
        out[1] = (double)name_of_body(contact.b);
        out[2] = contact.touching ? 1 : 0;
        out[3] = from_real(contact.normal.x);
        out[4] = from_real(contact.normal.y);
        for (int k = 0; k < 2; k++) {
            const cairn_contact_point *point = &contact.points[k];
            const bool present = k < contact.count;
            double *values = out + 5 + 4 * k;
            values[0] = present ? from_real(point->position.x) : (double)NAN;
            values[1] = present ? from_real(point->position.y) : (double)NAN;
            values[2] = present ? from_real(point->separation) : (double)NAN;
            values[3] = present ? from_real(point->impulse) : (double)NAN;
        }
        out += SHIM_CONTACT;
    }
    return count;
}

void shim_stats(const shim_world *w, int64_t *out)
{
    const cairn_world_stats *stats = cairn_world_get_stats(w->world);
    const int64_t values[SHIM_STATS] = {
        stats->steps, stats->dropped, stats->saturations, stats->bodies, stats->awake, stats->pairs,
        stats->arbiters, stats->points, stats->springs, stats->tree_cells, stats->tree_entries, stats->tree_full,
        stats->looked, stats->solved, stats->moved,
    };
    memcpy(out, values, sizeof values);
}

uint32_t shim_hash(shim_world *w)
{
#ifdef CAIRN_DOUBLE
    /* FNV-1a over the bytes of all states: the engine's own hash is of fixed point only. */
    uint32_t hash = 2166136261u;
    for (cairn_body_id id = cairn_world_next_body(w->world, cairn_body_id_null()); !cairn_body_id_is_null(id);
         id = cairn_world_next_body(w->world, id)) {
        double values[SHIM_STATE];
        unsigned char bytes[sizeof values];
        state(w, id, values);
        memcpy(bytes, values, sizeof bytes);
        for (size_t i = 0; i < sizeof bytes; i++) {
            hash = (hash ^ bytes[i]) * 16777619u;
        }
    }
    return hash;
#else
    return cairn_world_hash(w->world);
#endif
}

int shim_error(shim_world *w) { return cairn_world_error(w->world); }
