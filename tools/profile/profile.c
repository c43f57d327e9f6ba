/*
 * A plugin for QEMU that counts the instructions of each function, per step of a world.
 *   -plugin file=libcairn-profile.so,map=FILE,out=FILE,first=N,last=N[,code=FILE]
 * map: the image's functions in the order of their addresses, one a line, "LOW HIGH KIND" with addresses in hexadecimal:
 *   step     cairn_world_step itself: counting starts where it is entered
 *   engine   counted
 *   helper   counted while a step runs: the compiler's and the C library's routines
 *   aside    not counted and no end of a step: interrupts
 *   outside  the rest of the image: here a step has ended
 * out: per line of map, the instructions that it and the helpers it called took in steps first to last.
 * code: the image's instructions in the order of their addresses, one a line, "ADDRESS SIZE CLASS REGISTERS": SIZE in bytes,
 * CLASS a number below 32 whose meaning is the caller's, REGISTERS how many it loads or stores. Then a line of out goes on
 * with three numbers a class: its instructions, their registers, and how often another than the instruction behind followed.
 * What is executed is counted, as -icount does; an instruction that an IT block skips is one too.
 *
 * The declarations are those that QEMU's manual gives for version 1 of its plugin interface (QEMU 4.2 and later), since
 * Debian has no package with the header.
 */
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
typedef struct qemu_info_t qemu_info_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum { WITHOUT_REGISTERS = 0 };
typedef void (*translated_cb)(qemu_plugin_id_t id, struct qemu_plugin_tb *block);
typedef void (*executed_cb)(unsigned int cpu, void *data);
typedef void (*ended_cb)(qemu_plugin_id_t id, void *data);
extern size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *block);
extern struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *block, size_t i);
extern uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *instruction);
extern void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id, translated_cb call);
extern void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *instruction, executed_cb call, int flags, void *data);
extern void qemu_plugin_register_atexit_cb(qemu_plugin_id_t id, ended_cb call, void *data);

#define EXPORTED __attribute__((visibility("default")))
EXPORTED extern int qemu_plugin_version;
EXPORTED int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t *info, int count, char **words);
int qemu_plugin_version = 1;

typedef enum kind { STEP, ENGINE, HELPER, ASIDE, OUTSIDE } kind;

enum { MOST_FUNCTIONS = 8192, MOST_CLASSES = 32 };

typedef struct tally {
    uint64_t count, registers, jumps;
} tally;

typedef struct function {
    uint64_t low, high;
    kind kind;
    uint64_t instructions;
    tally classes[MOST_CLASSES];
} function;

typedef struct instruction {
    uint64_t address;
    unsigned size, class, registers;
} instruction;

/* Instructions in a row that belong to one function. */
typedef struct run {
    function *of;
    uint64_t length;
    bool enters; /* cairn_world_step */
    uint64_t start, behind; /* where it starts, and what follows unless its last instruction jumps */
    unsigned last_class;
    unsigned share_count;
    struct {
        unsigned class;
        uint64_t count, registers;
    } shares[MOST_CLASSES];
} run;

static function functions[MOST_FUNCTIONS];
static size_t function_count;
static function elsewhere = {0, 0, HELPER, 0, {{0, 0, 0}}}; /* hand-written routines of libgcc tell no size */
static instruction *code;
static size_t code_count;
static unsigned class_count;
static const char *out_file;
static uint64_t first = 1, last = UINT64_MAX;

static uint64_t steps;
static bool in_step;
static function *payer; /* the engine's function that ran last: it pays for the helpers */
static const run *before; /* the run that was counted last, and who paid for it */
static function *payer_before;

static bool read_map(const char *file)
{
    static const char *const names[] = {"step", "engine", "helper", "aside", "outside"};
    FILE *map = fopen(file, "r");
    char name[16];
    if (map == NULL) {
        return false;
    }
    while (function_count < MOST_FUNCTIONS) {
        function *f = &functions[function_count];
        if (fscanf(map, "%" SCNx64 " %" SCNx64 " %15s", &f->low, &f->high, name) != 3) {
            break;
        }
        f->kind = STEP;
        while (f->kind < OUTSIDE && strcmp(name, names[f->kind]) != 0) {
            f->kind++;
        }
        function_count++;
    }
    fclose(map);
    return function_count > 0 && function_count < MOST_FUNCTIONS;
}

static bool read_code(const char *file)
{
    FILE *list = fopen(file, "r");
    size_t capacity = 0;
    instruction one;
    if (list == NULL) {
        return false;
    }
    while (fscanf(list, "%" SCNx64 " %u %u %u", &one.address, &one.size, &one.class, &one.registers) == 4) {
        if (code_count == capacity) {
            capacity = capacity == 0 ? 4096 : 2 * capacity;
            code = realloc(code, capacity * sizeof *code);
        }
        if (code == NULL || one.class >= MOST_CLASSES) {
            fclose(list);
            return false;
        }
        class_count = one.class >= class_count ? one.class + 1 : class_count;
        code[code_count++] = one;
    }
    fclose(list);
    return code_count > 0;
}

/* Null where the list does not name the address. */
static const instruction *instruction_at(uint64_t address)
{
    size_t low = 0, high = code_count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (code[middle].address < address) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < code_count && code[low].address == address ? &code[low] : NULL;
}

static function *function_at(uint64_t address)
{
    size_t low = 0, high = function_count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (address >= functions[middle].high) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < function_count && address >= functions[low].low ? &functions[low] : &elsewhere;
}

static void count_classes(function *to, const run *now)
{
    for (unsigned i = 0; i < now->share_count; i++) {
        tally *t = &to->classes[now->shares[i].class];
        t->count += now->shares[i].count;
        t->registers += now->shares[i].registers;
    }
}

static void executed(unsigned int cpu, void *data)
{
    const run *now = data;
    (void)cpu;
    if (now->of->kind == ASIDE) {
        return;
    }
    if (before != NULL && before->behind != now->start) {
        payer_before->classes[before->last_class].jumps++;
    }
    before = NULL;
    if (now->enters) {
        steps++;
        in_step = true;
    }
    if (now->of->kind == OUTSIDE) {
        in_step = false;
    } else if (in_step && steps >= first && steps <= last) {
        payer = now->of->kind == HELPER && payer != NULL ? payer : now->of;
        payer->instructions += now->length;
        count_classes(payer, now);
        before = now->share_count > 0 ? now : NULL;
        payer_before = payer;
    }
}

/* Adds an instruction to the shares of a run; what the list does not name is of class 0. */
static void add_instruction(run *to, uint64_t address)
{
    const instruction *it = instruction_at(address);
    const unsigned class = it != NULL ? it->class : 0;
    unsigned i = 0;
    while (i < to->share_count && to->shares[i].class != class) {
        i++;
    }
    if (i == to->share_count) {
        to->shares[to->share_count++].class = class;
    }
    to->shares[i].count++;
    to->shares[i].registers += it != NULL ? it->registers : 0;
    to->behind = it != NULL ? address + it->size : 0;
    to->last_class = class;
}

static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb *block)
{
    size_t count = qemu_plugin_tb_n_insns(block), i = 0;
    (void)id;
    while (i < count) {
        struct qemu_plugin_insn *start = qemu_plugin_tb_get_insn(block, i);
        uint64_t address = qemu_plugin_insn_vaddr(start);
        run *now = calloc(1, sizeof *now); /* lives as long as QEMU may execute the block: to the end */
        if (now == NULL) {
            abort();
        }
        now->of = function_at(address);
        now->enters = now->of->kind == STEP && address == now->of->low;
        now->start = address;
        do {
            if (code_count > 0) {
                add_instruction(now, address);
            }
            now->length++;
            i++;
            address = i < count ? qemu_plugin_insn_vaddr(qemu_plugin_tb_get_insn(block, i)) : 0;
        } while (i < count && function_at(address) == now->of);
        qemu_plugin_register_vcpu_insn_exec_cb(start, executed, WITHOUT_REGISTERS, now);
    }
}

static void ended(qemu_plugin_id_t id, void *data)
{
    FILE *out = fopen(out_file, "w");
    (void)id;
    (void)data;
    if (out == NULL) {
        perror(out_file);
        return;
    }
    for (size_t i = 0; i < function_count; i++) {
        fprintf(out, "%" PRIu64, functions[i].instructions);
        for (unsigned k = 0; k < class_count; k++) {
            const tally *t = &functions[i].classes[k];
            fprintf(out, " %" PRIu64 " %" PRIu64 " %" PRIu64, t->count, t->registers, t->jumps);
        }
        fputc('\n', out);
    }
    fclose(out);
}

/* The text behind name= if the word starts so. */
static const char *value_of(const char *word, const char *name)
{
    size_t length = strlen(name);
    return strncmp(word, name, length) == 0 && word[length] == '=' ? word + length + 1 : NULL;
}

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t *info, int count, char **words)
{
    const char *map = NULL, *code_file = NULL;
    (void)info;
    for (int i = 0; i < count; i++) {
        const char *value;
        if ((value = value_of(words[i], "map")) != NULL) {
            map = value;
        } else if ((value = value_of(words[i], "code")) != NULL) {
            code_file = value;
        } else if ((value = value_of(words[i], "out")) != NULL) {
            out_file = value;
        } else if ((value = value_of(words[i], "first")) != NULL) {
            first = strtoull(value, NULL, 10);
        } else if ((value = value_of(words[i], "last")) != NULL) {
            last = strtoull(value, NULL, 10);
        }
    }
    if (map == NULL || out_file == NULL || !read_map(map) || (code_file != NULL && !read_code(code_file))) {
        fprintf(stderr, "profile: needs map=FILE with functions, and out=FILE; code=FILE with instructions if given\n");
        return -1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    qemu_plugin_register_atexit_cb(id, ended, NULL);
    return 0;
}
