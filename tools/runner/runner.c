/* The run itself: the same code on the host and on every board. */
#include "runner.h"

#include "cairn_port.h"

runner_options runner_options_default(void)
{
    runner_options options;
    options.steps = 600;
    options.every = 0;
    options.costs = false;
    options.contacts = false;
    options.substeps = 0;
    options.passes = 0;
    options.solver = -1;
    options.rate = 0;
    options.broad = -1;
    options.sleep = -1;
    options.present = 0;
    options.play = NULL;
    options.due = NULL;
    return options;
}

/* Whether the word is name=..., and then the text behind the sign. */
static const char *value_of(const char *word, const char *name)
{
    const size_t length = strlen(name);
    return strncmp(word, name, length) == 0 && word[length] == '=' ? word + length + 1 : NULL;
}

/* A decimal number of up to 9 digits that ends at a space or at the text's end. */
static bool number_of(const char *text, uint32_t *out)
{
    uint32_t value = 0;
    int digits = 0;
    while (text[digits] >= '0' && text[digits] <= '9' && digits < 9) {
        value = value * 10 + (uint32_t)(text[digits] - '0');
        digits++;
    }
    *out = value;
    return digits > 0 && (text[digits] == '\0' || text[digits] == ' ');
}

/* Whether the word is the one given: of words that end at a space. */
static bool is_word(const char *word, const char *wanted)
{
    const size_t length = strlen(wanted);
    return strncmp(word, wanted, length) == 0 && (word[length] == '\0' || word[length] == ' ');
}

static bool take_number(const char *word, const char *name, uint32_t *out)
{
    const char *value = value_of(word, name);
    return value != NULL && number_of(value, out);
}

bool runner_options_take(runner_options *options, const char *word)
{
    uint32_t number = 0;
    if (take_number(word, "steps", &number)) {
        options->steps = number;
    } else if (take_number(word, "every", &number)) {
        options->every = number;
    } else if (take_number(word, "costs", &number)) {
        options->costs = number != 0;
    } else if (take_number(word, "contacts", &number)) {
        options->contacts = number != 0;
    } else if (take_number(word, "substeps", &number) && number <= 16) {
        options->substeps = (int)number;
    } else if (take_number(word, "passes", &number) && number <= 100) {
        options->passes = (int)number;
    } else if (take_number(word, "rate", &number) && number <= 2000) {
        options->rate = number;
    } else if (take_number(word, "sleep", &number)) {
        options->sleep = number != 0;
    } else if (is_word(word, "solver=soft")) {
        options->solver = CAIRN_SCENE_SOFT;
    } else if (is_word(word, "solver=slides")) {
        options->solver = CAIRN_SCENE_SLIDES;
    } else if (is_word(word, "solver=small")) {
        options->solver = CAIRN_SCENE_SMALL;
    } else if (is_word(word, "broad=pairs")) {
        options->broad = CAIRN_SCENE_PAIRS;
    } else if (is_word(word, "broad=quadtree")) {
        options->broad = CAIRN_SCENE_QUADTREE;
    } else {
        return false;
    }
    return true;
}

/* ---- lines ---- */

static void print_number_line(const char *name, uint32_t value)
{
    cairn_print_text(name);
    cairn_print_text(" ");
    cairn_print_u32(value);
    cairn_print_text("\n");
}

static int print_error(const char *what, int number)
{
    cairn_print_text("error ");
    cairn_print_text(what);
    cairn_print_text(" ");
    cairn_print_i32(number);
    cairn_print_text("\n");
    return 1;
}

static void print_pair(cairn_vec2 v)
{
    runner_print_real(v.x);
    cairn_print_text(" ");
    runner_print_real(v.y);
}

static void print_state(cairn_world *world, const cairn_scene *scene, runner_memory memory, uint32_t step)
{
    print_number_line("state", step);
    for (uint16_t i = 0; i < scene->body_count; i++) {
        print_pair(cairn_body_position(world, memory.ids[i]));
        cairn_print_text(" ");
        runner_print_turn(memory.turns[i]);
        cairn_print_text(" ");
        print_pair(cairn_body_velocity(world, memory.ids[i]));
        cairn_print_text(" ");
        runner_print_real(cairn_body_angular_velocity(world, memory.ids[i]));
        cairn_print_text("\n");
    }
}

/* What any step needed of the pools. */
typedef struct runner_most {
    uint16_t bodies, points, arbiters, cells, entries;
    uint16_t kept; /* entries, and the pairs that the tree keeps behind them */
} runner_most;

static uint16_t larger(uint16_t a, uint16_t b) { return a > b ? a : b; }

static void keep_most(runner_most *most, const cairn_world *world)
{
    const cairn_world_stats *stats = cairn_world_get_stats(world);
    most->bodies = larger(most->bodies, stats->bodies);
    most->points = larger(most->points, stats->points);
    most->arbiters = larger(most->arbiters, stats->arbiters);
    most->cells = larger(most->cells, stats->tree_cells);
    most->entries = larger(most->entries, stats->tree_entries);
    most->kept = larger(most->kept, world->tree == NULL ? 0 : world->tree->pair_end);
}

static void print_stats(const cairn_world *world, const runner_most *most)
{
    const cairn_world_stats *stats = cairn_world_get_stats(world);
    print_number_line("stat arbiters", stats->arbiters);
    print_number_line("stat points", stats->points);
    print_number_line("stat most_bodies", most->bodies);
    print_number_line("stat most_points", most->points);
    print_number_line("stat most_arbiters", most->arbiters);
    print_number_line("stat most_tree_cells", most->cells);
    print_number_line("stat most_tree_entries", most->entries);
    print_number_line("stat most_tree_kept", most->kept);
    print_number_line("stat pairs", stats->pairs);
    print_number_line("stat looked", stats->looked);
    print_number_line("stat solved", stats->solved);
    print_number_line("stat moved", stats->moved);
    print_number_line("stat awake", stats->awake);
    print_number_line("stat dropped_contacts", stats->dropped);
    print_number_line("stat saturations", stats->saturations);
}

static void print_contacts(cairn_world *world)
{
    cairn_contact contact;
    int cursor = 0;
    while (cairn_world_next_contact(world, &cursor, &contact)) {
        for (int k = 0; contact.touching && k < contact.count; k++) {
            cairn_print_text("contact ");
            print_pair(contact.points[k].position);
            cairn_print_text(" ");
            print_pair(contact.normal);
            cairn_print_text("\n");
        }
    }
}

/* ---- the run ---- */

/* Keeps each body's angle continuous over the turns that the engine's own angle wraps at. */
static void follow_turns(cairn_world *world, const cairn_scene *scene, runner_memory memory)
{
    for (uint16_t i = 0; i < scene->body_count; i++) {
        const cairn_angle angle = cairn_body_angle(world, memory.ids[i]);
        memory.turns[i] = runner_turn_on(memory.turns[i], memory.angles[i], angle);
        memory.angles[i] = angle;
    }
}

static cairn_scene with_options(const cairn_scene *scene, const runner_options *options)
{
    cairn_scene changed = *scene;
    if (options->substeps > 0) {
        changed.substeps = (uint8_t)options->substeps;
    }
    if (options->passes > 0) {
        changed.passes = (uint8_t)options->passes;
    }
    if (options->solver >= 0) {
        changed.solver = (cairn_scene_solver)options->solver;
    }
    if (options->rate > 0) {
        changed.rate = cairn_real_from_int((int)options->rate);
    }
    if (options->broad >= 0) {
        changed.broad = (cairn_scene_broad)options->broad;
    }
    if (options->sleep >= 0) {
        changed.sleep = options->sleep != 0;
    }
    return changed;
}

int runner_run(const cairn_scene *given, const cairn_scene_storage *storage, runner_memory memory, const runner_options *options)
{
    cairn_scene scene = with_options(given, options);
    cairn_status status = CAIRN_OK;
    int place = 0;
    if (options->play != NULL) {
        scene.body_count = options->present;
    }
    cairn_world *world = cairn_scene_build(&scene, storage, memory.ids, NULL, &status, &place);
    if (world == NULL) {
        print_error("status", (int)status);
        return print_error("place", place);
    }
    scene.body_count = given->body_count;
    cairn_print_text("start ");
    cairn_print_u32(scene.body_count);
    cairn_print_text(" ");
    cairn_print_u32(cairn_port_clock_rate());
    cairn_print_text("\n");
    for (uint16_t i = 0; i < scene.body_count; i++) {
        memory.angles[i] = cairn_body_angle(world, memory.ids[i]);
        memory.turns[i] = memory.angles[i];
    }
    const uint32_t before = cairn_port_clock();
    const uint32_t clock_cost = cairn_port_clock() - before;
    runner_most most = {0, 0, 0, 0, 0, 0};
    uint32_t next = 0;
    cairn_port_stack_paint();
    for (uint32_t step = 0; step <= options->steps; step++) {
        if (step > 0) {
            if (options->play != NULL) {
                status = options->due(options->play, &scene, world, memory.ids, step - 1, &next);
                if (status != CAIRN_OK) {
                    print_error("status", (int)status);
                    return print_error("event", (int)next);
                }
            }
            const uint32_t start = cairn_port_clock();
            status = cairn_world_step(world);
            const uint32_t cost = cairn_port_clock() - start - clock_cost;
            if (status != CAIRN_OK) {
                return print_error("step", (int)status);
            }
            follow_turns(world, &scene, memory);
            if (options->costs) {
                print_number_line("cost", cost);
            }
            keep_most(&most, world);
        }
        if (options->every > 0 && step % options->every == 0) {
            print_state(world, &scene, memory, step);
        }
    }
    print_stats(world, &most);
    if (options->contacts) {
        print_contacts(world);
    }
    cairn_print_text("hash ");
    cairn_print_hex32(runner_hash(world));
    cairn_print_text("\n");
    print_number_line("stack", cairn_port_stack_used());
    print_number_line("stack_before", cairn_port_stack_now());
    cairn_print_text("end\n");
    return 0;
}
