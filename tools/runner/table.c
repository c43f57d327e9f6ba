/*
 * Writes a scene file as a C table: cairn-table SCENE.json NAME. The numbers were converted by the loader that the host
 * runs scenes with, so that firmware starts from the same bits. Fixed point only.
 */
#include "host_file.h"
#include "storage.h"

#include <stdio.h>

enum { BAD_CALL = 2 };

/* A Q16.16 number as CAIRN_F(decimal): ten digits after the point give back the same integer. */
static void real(cairn_real x)
{
    printf("CAIRN_F(%.10g)", x / 65536.0);
}

static void pair(const char *name, cairn_vec2 v)
{
    printf(".%s = { ", name);
    real(v.x);
    printf(", ");
    real(v.y);
    printf(" }");
}

static void wide(const char *name, cairn_wide x)
{
    printf(".%s = { %lu, %ld }", name, (unsigned long)x.mantissa, (long)x.exponent);
}

static const char *truth(bool value)
{
    return value ? "true" : "false";
}

static void materials(const cairn_scene *scene)
{
    printf("static const cairn_material materials[] = {\n");
    for (int i = 0; i < scene->material_count; i++) {
        const cairn_material *m = &scene->materials[i];
        printf("    { %ld, %ld, %ld, ", (long)m->static_friction, (long)m->kinetic_friction, (long)m->restitution);
        real(m->threshold);
        printf(", %s }, /* %.4g %.4g %.4g */\n", m->bounce == NULL ? "NULL" : "CAIRN_BOUNCE_CLASS", m->static_friction / 1048576.0,
               m->kinetic_friction / 1048576.0, m->restitution / 1048576.0);
    }
    printf("};\n\n");
}

static void polygon(int place, const cairn_polygon *p)
{
    printf("static const cairn_polygon shape_%d = {\n    .shape = { &cairn_polygon_class, { %ld, %ld }, &shape_%d },\n", place,
           (long)p->shape.size.x, (long)p->shape.size.y, place);
    printf("    .count = %d,\n    .inradius = %ld,\n    .centroid = { %ld, %ld },\n    .vertex = {", p->count, (long)p->inradius, (long)p->centroid.x, (long)p->centroid.y);
    for (int k = 0; k < p->count; k++) {
        printf(" { %ld, %ld },", (long)p->vertex[k].x, (long)p->vertex[k].y);
    }
    printf(" },\n    .normal = {");
    for (int k = 0; k < p->count; k++) {
        printf(" { %ld, %ld },", (long)p->normal[k].x, (long)p->normal[k].y);
    }
    printf(" },\n    .mass = { ");
    wide("area", p->mass.area);
    printf(", ");
    wide("gyration", p->mass.gyration);
    printf(" },\n};\n");
}

static void shapes(const cairn_scene *scene)
{
    for (int i = 0; i < scene->shape_count; i++) {
        const cairn_shape *s = scene->shapes[i];
        if (s->polygon != NULL) {
            polygon(i, s->polygon);
            continue;
        }
        printf("static const cairn_shape shape_%d = %s(", i, s->kind == &cairn_circle_class ? "CAIRN_CIRCLE" : "CAIRN_BOX");
        real(s->size.x);
        if (s->kind != &cairn_circle_class) {
            printf(", ");
            real(s->size.y);
        }
        printf(");\n");
    }
    printf("\nstatic const cairn_shape *const shapes[] = {");
    for (int i = 0; i < scene->shape_count; i++) {
        printf(" &shape_%d%s,", i, scene->shapes[i]->polygon != NULL ? ".shape" : "");
    }
    printf(" };\n\n");
}

static void model(const cairn_scene *scene, const cairn_body_model *m)
{
    int shape = 0;
    while (scene->shapes[shape] != m->shape) {
        shape++;
    }
    printf("    { .shape = &shape_%d%s, .material = &materials[%d], .type = %s, ", shape, m->shape->polygon != NULL ? ".shape" : "",
           (int)(m->material - scene->materials), m->type == CAIRN_STATIC ? "CAIRN_STATIC" : "CAIRN_DYNAMIC");
    wide("density", m->density);
    printf(",\n      .gravity_scale = ");
    real(m->gravity_scale);
    printf(", .layer = %u, .mask = %u, .sensor = %s, .fixed_rotation = %s, .fixed_position = %s },\n", m->layer, m->mask,
           truth(m->sensor), truth(m->fixed_rotation), truth(m->fixed_position));
}

static void body(const cairn_scene_body *b)
{
    printf("    { .model = %u, ", b->model);
    pair("position", b->position);
    printf(", .angle = %ld, ", (long)b->angle);
    pair("velocity", b->velocity);
    printf(", .angular_velocity = ");
    real(b->angular_velocity);
    printf(" },\n");
}

static void spring(const cairn_scene_spring *s)
{
    printf("    { .a = %u, .b = %u, ", s->a, s->b);
    pair("anchor_a", s->anchor_a);
    printf(", ");
    pair("anchor_b", s->anchor_b);
    printf(", .rest_length = ");
    real(s->rest_length);
    printf(",\n      ");
    wide("stiffness", s->stiffness);
    printf(", ");
    wide("damping", s->damping);
    printf(", .frequency = ");
    real(s->frequency);
    printf(", .damping_ratio = ");
    real(s->damping_ratio);
    printf(", .no_contact = %s },\n", truth(s->no_contact));
}

static void lists(const cairn_scene *scene)
{
    printf("static const cairn_body_model models[] = {\n");
    for (int i = 0; i < scene->model_count; i++) {
        model(scene, &scene->models[i]);
    }
    printf("};\n\nstatic const cairn_scene_body bodies[] = {\n");
    for (int i = 0; i < scene->body_count; i++) {
        body(&scene->bodies[i]);
    }
    printf("};\n\n");
    if (scene->spring_count > 0) {
        printf("static const cairn_scene_spring springs[] = {\n");
        for (int i = 0; i < scene->spring_count; i++) {
            spring(&scene->springs[i]);
        }
        printf("};\n\n");
    }
}

static void scene_itself(const cairn_scene *scene, const char *name)
{
    static const char *const solvers[] = {"CAIRN_SCENE_SOFT", "CAIRN_SCENE_SLIDES", "CAIRN_SCENE_SMALL"};
    printf("extern const cairn_scene %s;\nconst cairn_scene %s = {\n    .name = \"%s\",\n    ", name, name, scene->name);
    pair("gravity", scene->gravity);
    printf(",\n    .rate = ");
    real(scene->rate);
    printf(",\n    .substeps = %u,\n    .passes = %u,\n", scene->substeps, scene->passes);
    printf("    .solver = %s,\n", solvers[scene->solver]);
    printf("    .broad = %s,\n", scene->broad == CAIRN_SCENE_QUADTREE ? "CAIRN_SCENE_QUADTREE" : "CAIRN_SCENE_PAIRS");
    printf("    .sleep = %s,\n", truth(scene->sleep));
    printf("    .material_count = %u,\n    .shape_count = %u,\n    .model_count = %u,\n    .body_count = %u,\n    .spring_count = %u,\n",
           scene->material_count, scene->shape_count, scene->model_count, scene->body_count, scene->spring_count);
    printf("    .materials = materials,\n    .shapes = shapes,\n    .models = models,\n    .bodies = bodies,\n    .springs = %s,\n};\n\n",
           scene->spring_count > 0 ? "springs" : "NULL");
}

static void memory(const cairn_scene *scene, const char *name)
{
    const bool tree = scene->broad == CAIRN_SCENE_QUADTREE, blocks = runner_is_uneven(scene);
    printf("/* The memory to build it in. */\nCAIRN_WORLD(world, %u, %u);\n", scene->body_count, runner_arbiters(scene));
    if (scene->spring_count > 0) {
        printf("CAIRN_SPRINGS(world_springs, %u);\n", scene->spring_count);
    }
    if (tree) {
        printf("CAIRN_QUADTREE(world_quadtree, %u, %u, %u);\n", scene->body_count, runner_cells(scene), runner_entries(scene));
    }
    if (blocks) {
        printf("CAIRN_BLOCKS(world_blocks);\n");
    }
    printf("\nextern const cairn_scene_storage %s_storage;\nconst cairn_scene_storage %s_storage = { &world, %s, %s, %s };\n", name, name,
           scene->spring_count > 0 ? "&world_springs" : "NULL", tree ? "&world_quadtree" : "NULL", blocks ? "&world_blocks" : "NULL");
}

/* Whether a text can be the name of a C constant here: letters, digits and _, the first no digit. */
static bool is_identifier(const char *name)
{
    for (const char *p = name; *p != '\0'; p++) {
        const bool letter = (*p >= 'a' && *p <= 'z') || (*p >= 'A' && *p <= 'Z') || *p == '_';
        if (!letter && !(*p >= '0' && *p <= '9' && p != name)) {
            return false;
        }
    }
    return *name != '\0';
}

int main(int count, char **words)
{
    if (count != 3 || !is_identifier(words[2])) {
        fprintf(stderr, "usage: %s SCENE.json|- NAME\n", words[0]);
        return BAD_CALL;
    }
    cairn_scene_file *file = host_read_scene(words[1]);
    if (file == NULL) {
        return BAD_CALL;
    }
    const cairn_scene *scene = cairn_scene_file_table(file);
    printf("/* The scene %s. Written by `tools/cairn table`; change the JSON file instead. */\n#include \"scene.h\"\n\n", scene->name);
    materials(scene);
    shapes(scene);
    lists(scene);
    scene_itself(scene, words[2]);
    memory(scene, words[2]);
    cairn_scene_file_free(file);
    return 0;
}
