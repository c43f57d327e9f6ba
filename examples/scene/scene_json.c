/*
 * JSON scene files into scene tables. The first complaint is kept; what follows it reads defaults and is thrown away.
 */
#include "scene_json.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

enum { PLACE_SIZE = 128, ENTRIES_MAX = 4096, NAME_LENGTH = 63, PRESETS = 4 };

struct cairn_scene_file {
    cairn_scene table;
    char *name;
    cairn_material *materials;
    cairn_shape *plain;      /* circles and boxes, at the places of their names in "shapes" */
    cairn_polygon *polygons; /* likewise */
    const cairn_shape **shapes;
    cairn_body_model *models;
    cairn_scene_body *bodies;
    cairn_scene_spring *springs;
};

typedef struct reader {
    cairn_scene_file *file;
    const cJSON *root, *shapes;
    const char **material_names; /* in the order of file->materials */
    char *error;
    size_t error_size;
    bool failed;
} reader;

/* A field's range; a required one has no standard value. */
typedef struct range {
    double least, most, standard;
} range;

static const double required = (double)NAN;
static const range layers_range = {0, 65535, 65535};

static const struct {
    const char *name;
    const cairn_material *material;
} presets[PRESETS] = {
    {"default", &cairn_material_default},
    {"ice", &cairn_material_ice},
    {"metal", &cairn_material_metal},
    {"jelly", &cairn_material_jelly},
};

#ifdef CAIRN_DOUBLE
static cairn_wide wide_of(double x) { return x; }
#else
static cairn_wide wide_of(double x)
{
    int exponent = 0;
    const double fraction = frexp(x, &exponent); /* 0, or 0.5 to 1 */
    return cairn_wide_of((int32_t)floor(fraction * 1073741824.0 + 0.5), exponent - 30);
}
#endif

/* ---- complaints ---- */

static void fail(reader *r, const char *place, const char *name, const char *what)
{
    if (!r->failed) {
        const char *dot = *place != '\0' && *name != '\0' && *name != '[' ? "." : "";
        snprintf(r->error, r->error_size, "%s%s%s: %s", place, dot, name, what);
        r->failed = true;
    }
}

static void place_of(char *place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(place, PLACE_SIZE, format, arguments);
    va_end(arguments);
}

static void check_status(reader *r, cairn_status status, const char *place)
{
    if (status == CAIRN_ERROR_SHAPE) {
        fail(r, place, "", "concave, self-crossing, degenerate, or with corners on one line");
    } else if (status != CAIRN_OK) {
        fail(r, place, "", "out of range");
    }
}

/* ---- fields ---- */

static const cJSON *field(const cJSON *object, const char *name)
{
    return cJSON_GetObjectItemCaseSensitive(object, name);
}

/* Complains about fields that are not in the list, which ends with null. */
static void only(reader *r, const cJSON *object, const char *place, const char *const *known)
{
    for (const cJSON *item = object->child; item != NULL; item = item->next) {
        size_t k = 0;
        while (known[k] != NULL && strcmp(known[k], item->string) != 0) {
            k++;
        }
        if (known[k] == NULL) {
            fail(r, place, item->string, "unknown field");
        }
    }
}

static double value_of(reader *r, const cJSON *item, const char *place, const char *name, range limits)
{
    if (!cJSON_IsNumber(item)) {
        fail(r, place, name, "must be a number");
        return 0;
    }
    if (!(item->valuedouble >= limits.least && item->valuedouble <= limits.most)) {
        char what[80];
        snprintf(what, sizeof what, "must be %g to %g", limits.least, limits.most);
        fail(r, place, name, what);
        return 0;
    }
    return item->valuedouble;
}

static double number(reader *r, const cJSON *object, const char *place, const char *name, range limits)
{
    const cJSON *item = field(object, name);
    if (item != NULL) {
        return value_of(r, item, place, name, limits);
    }
    if (isnan(limits.standard)) {
        fail(r, place, name, "missing");
        return 0;
    }
    return limits.standard;
}

static int integer(reader *r, const cJSON *object, const char *place, const char *name, range limits)
{
    const double value = number(r, object, place, name, limits);
    if (value != floor(value)) {
        fail(r, place, name, "must be a whole number");
    }
    return (int)value;
}

static cairn_real real(reader *r, const cJSON *object, const char *place, const char *name, range limits)
{
    return CAIRN_F(number(r, object, place, name, limits));
}

static bool flag(reader *r, const cJSON *object, const char *place, const char *name, const bool standard)
{
    const cJSON *item = field(object, name);
    if (item != NULL && !cJSON_IsBool(item)) {
        fail(r, place, name, "must be true or false");
    }
    return item == NULL ? standard : cJSON_IsTrue(item);
}

static cairn_vec2 pair_of(reader *r, const cJSON *item, const char *place, const char *name, range limits)
{
    if (!cJSON_IsArray(item) || cJSON_GetArraySize(item) != 2) {
        fail(r, place, name, "must be a list of two numbers");
        return cairn_vec2_of(0, 0);
    }
    const double x = value_of(r, item->child, place, name, limits);
    const double y = value_of(r, item->child->next, place, name, limits);
    return cairn_vec2_of(CAIRN_F(x), CAIRN_F(y));
}

/* A missing pair is (0, standard). */
static cairn_vec2 pair(reader *r, const cJSON *object, const char *place, const char *name, range limits)
{
    const cJSON *item = field(object, name);
    if (item == NULL && isnan(limits.standard)) {
        fail(r, place, name, "missing");
    }
    if (item == NULL) {
        return cairn_vec2_of(0, CAIRN_F(r->failed ? 0.0 : limits.standard));
    }
    return pair_of(r, item, place, name, limits);
}

/* The place of a text among the choices, which end with null; 0 if the field is missing. */
static int choice(reader *r, const cJSON *object, const char *place, const char *name, const char *const *choices)
{
    const cJSON *item = field(object, name);
    if (item == NULL) {
        return 0;
    }
    for (int k = 0; choices[k] != NULL; k++) {
        if (cJSON_IsString(item) && strcmp(item->valuestring, choices[k]) == 0) {
            return k;
        }
    }
    char what[80];
    int length = 0;
    for (int k = 0; choices[k] != NULL; k++) {
        const char *joint = k == 0 ? "" : choices[k + 1] == NULL ? " or " : ", ";
        length += snprintf(what + length, sizeof what - (size_t)length, "%s\"%s\"", k == 0 ? "must be " : joint, choices[k]);
    }
    fail(r, place, name, what);
    return 0;
}

/* The length of a list or object at the top, 0 to ENTRIES_MAX. */
static uint16_t count_of(reader *r, const char *name, const cJSON *item, const bool is_right_kind)
{
    if (item == NULL) {
        return 0;
    }
    if (!is_right_kind) {
        fail(r, "", name, cJSON_IsArray(item) ? "must be an object" : "must be a list");
        return 0;
    }
    const int count = cJSON_GetArraySize(item);
    if (count > ENTRIES_MAX) {
        fail(r, "", name, "has more than 4096 entries");
        return 0;
    }
    return (uint16_t)count;
}

/* Zeroed memory for count things; a failure is a complaint. */
static void *room(reader *r, size_t count, size_t size)
{
    void *memory = calloc(count + 1, size);
    if (memory == NULL) {
        fail(r, "", "(file)", "not enough memory");
    }
    return memory;
}

/* ---- materials ---- */

static cairn_material material_of(reader *r, const cJSON *object, const char *place)
{
    static const char *const known[] = {"static_friction", "kinetic_friction", "restitution", "restitution_threshold", NULL};
    const range friction = {0, 8, required};
    cairn_material material = cairn_material_default;
    if (!cJSON_IsObject(object)) {
        fail(r, place, "", "must be an object");
        return material;
    }
    only(r, object, place, known);
    const double grip = number(r, object, place, "static_friction", friction);
    const double slide = number(r, object, place, "kinetic_friction", friction);
    const double restitution = number(r, object, place, "restitution", (range){0, 1, required});
    if (slide > grip) {
        fail(r, place, "kinetic_friction", "must be at most static_friction");
    }
    material.static_friction = CAIRN_FACTOR(grip);
    material.kinetic_friction = CAIRN_FACTOR(slide);
    material.restitution = CAIRN_FACTOR(restitution);
    material.threshold = real(r, object, place, "restitution_threshold", (range){0, 1000, 1});
    material.bounce = restitution > 0 ? &cairn_bounce : NULL;
    return material;
}

static void read_materials(reader *r)
{
    const cJSON *all = field(r->root, "materials");
    const uint16_t count = count_of(r, "materials", all, cJSON_IsObject(all));
    r->file->materials = room(r, (size_t)count + PRESETS, sizeof *r->file->materials);
    r->material_names = room(r, (size_t)count + PRESETS, sizeof *r->material_names);
    if (r->failed || count == 0) {
        return;
    }
    for (const cJSON *item = all->child; item != NULL; item = item->next) {
        char place[PLACE_SIZE];
        place_of(place, "materials.%s", item->string);
        r->file->materials[r->file->table.material_count] = material_of(r, item, place);
        r->material_names[r->file->table.material_count++] = item->string;
    }
}

/* The place of a material; a preset takes a place when a body first names it. */
static uint16_t material_named(reader *r, const char *name, const char *place)
{
    cairn_scene *table = &r->file->table;
    for (uint16_t i = 0; i < table->material_count; i++) {
        if (strcmp(r->material_names[i], name) == 0) {
            return i;
        }
    }
    for (int k = 0; k < PRESETS; k++) {
        if (strcmp(presets[k].name, name) == 0) {
            r->file->materials[table->material_count] = *presets[k].material;
            r->material_names[table->material_count] = presets[k].name;
            return table->material_count++;
        }
    }
    fail(r, place, "material", "names no material");
    return 0;
}

/* ---- shapes ---- */

static void read_polygon(reader *r, const cJSON *list, const char *place, cairn_polygon *polygon)
{
    cairn_vec2 points[CAIRN_MAX_VERTICES];
    const int count = cJSON_IsArray(list) ? cJSON_GetArraySize(list) : 0;
    if (count < 3 || count > CAIRN_MAX_VERTICES) {
        fail(r, place, "", "must be a list of 3 to 8 points");
        return;
    }
    int k = 0;
    for (const cJSON *item = list->child; item != NULL; item = item->next) {
        char name[16];
        snprintf(name, sizeof name, "[%d]", k);
        points[k++] = pair_of(r, item, place, name, (range){-125, 125, required});
    }
    if (!r->failed) {
        check_status(r, cairn_polygon_init(polygon, points, count), place);
    }
}

static void read_regular(reader *r, const cJSON *object, const char *place, cairn_polygon *polygon)
{
    static const char *const known[] = {"sides", "radius", NULL};
    if (!cJSON_IsObject(object)) {
        fail(r, place, "", "must be an object");
        return;
    }
    only(r, object, place, known);
    const int sides = integer(r, object, place, "sides", (range){3, CAIRN_MAX_VERTICES, required});
    const cairn_real radius = real(r, object, place, "radius", (range){0.001, 125, required});
    if (!r->failed) {
        check_status(r, cairn_polygon_init_regular(polygon, sides, radius), place);
    }
}

static void plain_shape(cairn_shape *shape, const cairn_shape_class *kind, cairn_vec2 size)
{
    shape->kind = kind;
    shape->size = size;
    shape->polygon = NULL;
}

/* Gives the shape at one of the two places that are kept for it. */
static const cairn_shape *read_shape(reader *r, const cJSON *object, const char *name, cairn_shape *plain, cairn_polygon *polygon)
{
    char place[PLACE_SIZE];
    place_of(place, "shapes.%s", name);
    if (!cJSON_IsObject(object) || cJSON_GetArraySize(object) != 1) {
        fail(r, place, "", "must have exactly one of circle, box, regular, polygon");
        return plain;
    }
    const cJSON *item = object->child;
    place_of(place, "shapes.%s.%s", name, item->string);
    const cairn_shape *shape = plain;
    if (strcmp(item->string, "circle") == 0) {
        const double radius = value_of(r, item, place, "", (range){0.001, 125, required});
        plain_shape(plain, &cairn_circle_class, cairn_vec2_of(CAIRN_F(radius), 0));
    } else if (strcmp(item->string, "box") == 0) {
        plain_shape(plain, &cairn_box_class, pair_of(r, item, place, "", (range){0.001, 250, required}));
    } else if (strcmp(item->string, "regular") == 0) {
        read_regular(r, item, place, polygon);
        shape = &polygon->shape;
    } else if (strcmp(item->string, "polygon") == 0) {
        read_polygon(r, item, place, polygon);
        shape = &polygon->shape;
    } else {
        fail(r, place, "", "unknown field");
    }
    cairn_mass_data mass;
    if (!r->failed) {
        check_status(r, cairn_shape_measure(shape, &mass), place);
    }
    return shape;
}

static void read_shapes(reader *r)
{
    cairn_scene_file *file = r->file;
    r->shapes = field(r->root, "shapes");
    if (r->shapes == NULL) {
        fail(r, "", "shapes", "missing");
    }
    const uint16_t count = count_of(r, "shapes", r->shapes, cJSON_IsObject(r->shapes));
    file->plain = room(r, count, sizeof *file->plain);
    file->polygons = room(r, count, sizeof *file->polygons);
    file->shapes = room(r, count, sizeof *file->shapes);
    if (r->failed) {
        return;
    }
    for (const cJSON *item = r->shapes->child; item != NULL; item = item->next) {
        const uint16_t i = file->table.shape_count++;
        file->shapes[i] = read_shape(r, item, item->string, &file->plain[i], &file->polygons[i]);
    }
}

static uint16_t shape_named(reader *r, const char *name, const char *place)
{
    uint16_t i = 0;
    for (const cJSON *item = r->shapes->child; item != NULL; item = item->next, i++) {
        if (strcmp(item->string, name) == 0) {
            return i;
        }
    }
    fail(r, place, "shape", "names no shape");
    return 0;
}

/* ---- bodies and springs ---- */

/* A text field; null, with a complaint where it is no text. */
static const char *text(reader *r, const cJSON *object, const char *place, const char *name)
{
    const cJSON *item = field(object, name);
    if (item != NULL && !cJSON_IsString(item)) {
        fail(r, place, name, "must be a text");
    }
    return cJSON_IsString(item) ? item->valuestring : NULL;
}

static bool is_same(const cairn_body_model *a, const cairn_body_model *b)
{
    return a->shape == b->shape && a->material == b->material && a->type == b->type && a->layer == b->layer && a->mask == b->mask &&
           a->sensor == b->sensor && a->fixed_rotation == b->fixed_rotation && a->fixed_position == b->fixed_position &&
           !cairn_wide_less(a->density, b->density) && !cairn_wide_less(b->density, a->density);
}

/* The place of such a model, which bodies of one make share; there is room for as many as bodies. */
static uint16_t model_like(cairn_scene_file *file, const cairn_body_model *model)
{
    uint16_t place = 0;
    while (place < file->table.model_count && !is_same(&file->models[place], model)) {
        place++;
    }
    if (place == file->table.model_count) {
        file->models[place] = *model;
        file->table.model_count++;
    }
    return place;
}

static void read_body(reader *r, const cJSON *object, const char *place, cairn_scene_body *body)
{
    static const char *const known[] = {"name", "shape", "material", "type", "position", "angle", "velocity",
                                        "angular_velocity", "density", "sensor", "fixed_rotation", "fixed_position",
                                        "layer", "mask", NULL};
    static const char *const types[] = {"dynamic", "static", NULL};
    const range coordinate = {-32000, 32000, 0};
    if (!cJSON_IsObject(object)) {
        fail(r, place, "", "must be an object");
        return;
    }
    only(r, object, place, known);
    const char *shape = text(r, object, place, "shape");
    const char *material = text(r, object, place, "material");
    if (shape == NULL) {
        fail(r, place, "shape", "missing");
        return;
    }
    cairn_body_model model = cairn_body_model_default(r->file->shapes[shape_named(r, shape, place)]);
    model.material = &r->file->materials[material_named(r, material == NULL ? "default" : material, place)];
    model.type = choice(r, object, place, "type", types) == 1 ? CAIRN_STATIC : CAIRN_DYNAMIC;
    model.density = wide_of(number(r, object, place, "density", (range){1e-6, 32000, 1}));
    model.sensor = flag(r, object, place, "sensor", false);
    model.fixed_rotation = flag(r, object, place, "fixed_rotation", false);
    model.fixed_position = flag(r, object, place, "fixed_position", false);
    model.layer = (uint16_t)integer(r, object, place, "layer", (range){0, 65535, 1});
    model.mask = (uint16_t)integer(r, object, place, "mask", layers_range);
    body->model = model_like(r->file, &model);
    body->position = pair(r, object, place, "position", (range){-32000, 32000, required});
    body->angle = CAIRN_RADIANS(number(r, object, place, "angle", coordinate));
    body->velocity = pair(r, object, place, "velocity", coordinate);
    body->angular_velocity = real(r, object, place, "angular_velocity", coordinate);
}

static uint16_t end_of_spring(reader *r, const cJSON *object, const char *place, const char *name)
{
    const int last = (int)r->file->table.body_count - 1;
    return (uint16_t)integer(r, object, place, name, (range){0, last, required});
}

static void read_spring_force(reader *r, const cJSON *object, const char *place, cairn_scene_spring *spring)
{
    const bool by_stiffness = field(object, "stiffness") != NULL && field(object, "frequency") == NULL && field(object, "damping_ratio") == NULL;
    const bool by_frequency = field(object, "frequency") != NULL && field(object, "stiffness") == NULL && field(object, "damping") == NULL;
    const cairn_scene_body *bodies = r->file->bodies;
    if (by_stiffness) {
        spring->stiffness = wide_of(number(r, object, place, "stiffness", (range){0, 1e9, required}));
        spring->damping = wide_of(number(r, object, place, "damping", (range){0, 1e9, 0}));
    } else if (by_frequency) {
        spring->frequency = real(r, object, place, "frequency", (range){0.001, 1000, required});
        spring->damping_ratio = real(r, object, place, "damping_ratio", (range){0, 100, 0});
    } else {
        fail(r, place, "", "must have either stiffness (and damping) or frequency (and damping_ratio)");
    }
    const cairn_body_model *models = r->file->models;
    if (!r->failed && models[bodies[spring->a].model].type == CAIRN_STATIC && models[bodies[spring->b].model].type == CAIRN_STATIC) {
        spring->frequency = 0; /* without a mass a frequency says nothing, and nothing is to move */
    }
}

static void read_spring(reader *r, const cJSON *object, const char *place, cairn_scene_spring *spring)
{
    static const char *const known[] = {"a", "b", "anchor_a", "anchor_b", "rest_length", "stiffness", "damping", "frequency",
                                        "damping_ratio", "collide", NULL};
    const range coordinate = {-32000, 32000, 0};
    if (!cJSON_IsObject(object)) {
        fail(r, place, "", "must be an object");
        return;
    }
    only(r, object, place, known);
    spring->a = end_of_spring(r, object, place, "a");
    spring->b = end_of_spring(r, object, place, "b");
    if (spring->a == spring->b) {
        fail(r, place, "b", "the same body as a");
    }
    spring->anchor_a = pair(r, object, place, "anchor_a", coordinate);
    spring->anchor_b = pair(r, object, place, "anchor_b", coordinate);
    spring->rest_length = CAIRN_F(-1);
    if (field(object, "rest_length") != NULL) {
        spring->rest_length = real(r, object, place, "rest_length", (range){0, 500, required});
    }
    spring->stiffness = wide_of(0);
    spring->damping = wide_of(0);
    read_spring_force(r, object, place, spring);
    spring->no_contact = !flag(r, object, place, "collide", true);
}

static void read_bodies(reader *r)
{
    const cJSON *list = field(r->root, "bodies");
    const uint16_t count = count_of(r, "bodies", list, cJSON_IsArray(list));
    if (count == 0) {
        fail(r, "", "bodies", list == NULL ? "missing" : "must have at least one entry");
    }
    r->file->models = room(r, count, sizeof *r->file->models);
    r->file->bodies = room(r, count, sizeof *r->file->bodies);
    if (r->failed) {
        return;
    }
    for (const cJSON *item = list->child; item != NULL; item = item->next) {
        char place[PLACE_SIZE];
        const uint16_t i = r->file->table.body_count++;
        place_of(place, "bodies[%d]", i);
        read_body(r, item, place, &r->file->bodies[i]);
    }
}

static void read_springs(reader *r)
{
    const cJSON *list = field(r->root, "springs");
    const uint16_t count = count_of(r, "springs", list, cJSON_IsArray(list));
    r->file->springs = room(r, count, sizeof *r->file->springs);
    if (r->failed || count == 0) {
        return;
    }
    for (const cJSON *item = list->child; item != NULL; item = item->next) {
        char place[PLACE_SIZE];
        const uint16_t i = r->file->table.spring_count++;
        place_of(place, "springs[%d]", i);
        read_spring(r, item, place, &r->file->springs[i]);
    }
}

/* ---- the whole ---- */

/* 1 to NAME_LENGTH letters, digits or _ . - : fit for a file name, and for a comment in C. */
static bool is_name(const char *name)
{
    size_t length = 0;
    for (; name[length] != '\0'; length++) {
        const char c = name[length];
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (!letter && !(c >= '0' && c <= '9') && c != '_' && c != '.' && c != '-') {
            return false;
        }
    }
    return length > 0 && length <= NAME_LENGTH;
}

static void read_settings(reader *r)
{
    static const char *const known[] = {"cairn_scene", "name", "gravity", "steps_per_second", "substeps", "solver", "passes",
                                        "broad_phase", "sleep", "materials", "shapes", "bodies", "springs", NULL};
    static const char *const solvers[] = {"soft", "slides", "small", NULL}; /* in the order of cairn_scene_solver */
    static const char *const broad_phases[] = {"pairs", "quadtree", NULL};
    cairn_scene *table = &r->file->table;
    only(r, r->root, "", known);
    number(r, r->root, "", "cairn_scene", (range){1, 1, required});
    const char *name = text(r, r->root, "", "name");
    if (name == NULL) {
        fail(r, "", "name", "missing");
        return;
    }
    if (!is_name(name)) {
        fail(r, "", "name", "must be 1 to 63 letters, digits or _ . -");
        return;
    }
    r->file->name = room(r, strlen(name), 1);
    if (r->failed) {
        return;
    }
    memcpy(r->file->name, name, strlen(name) + 1);
    table->name = r->file->name;
    table->gravity = pair(r, r->root, "", "gravity", (range){-2000, 2000, -10});
    table->rate = CAIRN_F(integer(r, r->root, "", "steps_per_second", (range){10, 2000, 60}));
    table->substeps = (uint8_t)integer(r, r->root, "", "substeps", (range){1, 16, 4});
    table->passes = (uint8_t)integer(r, r->root, "", "passes", (range){1, 100, 10});
    table->solver = (cairn_scene_solver)choice(r, r->root, "", "solver", solvers);
    table->broad = choice(r, r->root, "", "broad_phase", broad_phases) == 1 ? CAIRN_SCENE_QUADTREE : CAIRN_SCENE_PAIRS;
    table->sleep = flag(r, r->root, "", "sleep", false);
}

static void read_all(reader *r)
{
    if (!cJSON_IsObject(r->root)) {
        fail(r, "", "(file)", "must be an object");
        return;
    }
    read_settings(r);
    read_materials(r);
    if (!r->failed) {
        read_shapes(r);
    }
    if (!r->failed) {
        read_bodies(r);
    }
    if (!r->failed) {
        read_springs(r);
    }
    cairn_scene_file *file = r->file;
    file->table.materials = file->materials;
    file->table.shapes = file->shapes;
    file->table.models = file->models;
    file->table.bodies = file->bodies;
    file->table.springs = file->springs;
}

static void fail_at(reader *r, const char *text_start, const char *position)
{
    int line = 1;
    const char *line_start = text_start;
    for (const char *p = text_start; p < position; p++) {
        if (*p == '\n') {
            line++;
            line_start = p + 1;
        }
    }
    char place[PLACE_SIZE];
    place_of(place, "line %d column %d", line, (int)(position - line_start) + 1);
    fail(r, place, "", "not JSON");
}

cairn_scene_file *cairn_scene_file_read(const char *json, char *error, size_t error_size)
{
    reader r = {0};
    r.error = error;
    r.error_size = error_size;
    r.file = calloc(1, sizeof *r.file);
    if (r.file == NULL) {
        fail(&r, "", "(file)", "not enough memory");
        return NULL;
    }
    const char *end = json;
    cJSON *root = cJSON_ParseWithOpts(json, &end, 1);
    r.root = root;
    if (root == NULL) {
        fail_at(&r, json, end);
    } else {
        read_all(&r);
    }
    cJSON_Delete(root);
    free((void *)r.material_names);
    if (r.failed) {
        cairn_scene_file_free(r.file);
        return NULL;
    }
    return r.file;
}

const cairn_scene *cairn_scene_file_table(const cairn_scene_file *file)
{
    return &file->table;
}

void cairn_scene_file_free(cairn_scene_file *file)
{
    if (file == NULL) {
        return;
    }
    free(file->name);
    free(file->materials);
    free(file->plain);
    free(file->polygons);
    free((void *)file->shapes);
    free(file->models);
    free(file->bodies);
    free(file->springs);
    free(file);
}
