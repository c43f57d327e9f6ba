/*
 * Meshes: networks of springs that are held in shape by diagonals or close in rings, solved as a whole. Without this a
 * world solves them path by path: bounded too, but the stiffer the mesh the farther it then hangs beyond its statics.
 */
#ifndef CAIRN_SPRING_MESH_H
#define CAIRN_SPRING_MESH_H

#include "spring.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The layouts are the engine's own, see spring_mesh.c. */
typedef struct cairn_mesh_node {
    uint16_t body, row, rank;
    uint8_t shifts, turns;     /* numbers of its rows */
    cairn_wide scale, turning; /* from a row's value to the body's velocity and spin */
    cairn_share mass, inertia; /* on the diagonals */
} cairn_mesh_node;

typedef struct cairn_mesh_row {
    uint32_t entries;  /* where its entries begin */
    uint16_t first;    /* the column of the first of them */
    cairn_wide inverse; /* of the entry on the diagonal */
    cairn_motion value;
} cairn_mesh_row;

typedef struct cairn_mesh_link {
    uint16_t spring, node[2]; /* of its a and its b; CAIRN_NONE where that does not move */
    cairn_share shift[2], turn[2]; /* what a unit of its pull is in the ends' rows */
    cairn_wide position_gain;
    cairn_share velocity_gain;
    cairn_motion pull;
} cairn_mesh_link;

typedef struct cairn_mesh_part { /* one network */
    uint16_t network;            /* its first spring */
    uint16_t node, nodes, row, rows, link, links;
    cairn_unit turned, stale; /* by how much its springs have turned since its factors were made, at most, and when they are too old */
    bool has_levers;
} cairn_mesh_part;

struct cairn_mesh_class;

typedef struct cairn_mesh {
    const struct cairn_mesh_class *kind;
    cairn_mesh_part *parts;
    cairn_mesh_node *nodes;
    cairn_mesh_row *rows;
    cairn_mesh_link *links;
    cairn_share *entries;
    uint16_t body_capacity, link_capacity;
    uint32_t entry_capacity;
    uint16_t part_count, node_count, row_count, link_count;
    uint32_t entry_count;
} cairn_mesh;

typedef struct cairn_mesh_storage {
    cairn_mesh *mesh;
    cairn_mesh_part *parts;
    cairn_mesh_node *nodes;
    cairn_mesh_row *rows;
    cairn_mesh_link *links;
    cairn_share *entries;
    uint16_t bodies, springs;
    uint32_t entry_count;
} cairn_mesh_storage;

/*
 * Declare, at file scope, the memory for meshes of so many moving bodies and springs in all, with so many entries of
 * their matrices. A square of n x n beads needs about 4 n^3 entries, a beam of n bays about 16 n. A network that does not
 * fit is solved by paths.
 */
#define CAIRN_SPRING_MESHES(name, body_count, spring_count, matrix_entries) \
    static cairn_mesh name##_mesh; \
    static cairn_mesh_part name##_parts[body_count]; \
    static cairn_mesh_node name##_nodes[body_count]; \
    static cairn_mesh_row name##_rows[3 * (body_count)]; \
    static cairn_mesh_link name##_links[spring_count]; \
    static cairn_share name##_entries[matrix_entries]; \
    static const cairn_mesh_storage name = { &name##_mesh, name##_parts, name##_nodes, name##_rows, name##_links, name##_entries, \
                                             (body_count), (spring_count), (matrix_entries) }

/* Bytes of RAM that it takes, a constant expression. */
#define CAIRN_SPRING_MESHES_BYTES(body_count, spring_count, matrix_entries) \
    (sizeof(cairn_mesh) + (body_count) * (sizeof(cairn_mesh_part) + sizeof(cairn_mesh_node) + 3 * sizeof(cairn_mesh_row)) \
     + (spring_count) * sizeof(cairn_mesh_link) + (matrix_entries) * sizeof(cairn_share))

/* Give a world memory for meshes; once per world, after cairn_springs_enable (CAIRN_ERROR_KIND before it, or twice). */
cairn_status cairn_meshes_enable(cairn_world *world, const cairn_mesh_storage *storage);

#ifdef __cplusplus
}
#endif

#endif
