/* The pinball table: what stands on it and its two flippers. Bodies only; the rules are in pinball.c. */
#ifndef TABLE_H
#define TABLE_H

#include <cairn/cairn.h>

enum { TABLE_PARTS = 24, TABLE_BUMPERS = 3, TABLE_LAMPS = 3, TABLE_SLINGS = 2 };

typedef enum part_kind {
    PART_WALL,
    PART_BUMPER,
    PART_SLING,
    PART_LAMP
} part_kind;

typedef struct table {
    cairn_world *world;
    cairn_body_id ball;
    cairn_body_id flippers[2]; /* left, right */
    cairn_body_id parts[TABLE_PARTS];
    uint8_t kinds[TABLE_PARTS];
    int part_count;
} table;

void table_build(table *t);
/* The ball in the plunger's lane, at rest. */
void table_serve(table *t);
/* Drive the flippers: up where the bit (1 left, 2 right) is set. */
void table_flip(table *t, unsigned up);
/* Which part a body is; -1 if none. */
int table_part_of(const table *t, cairn_body_id body);

#endif
