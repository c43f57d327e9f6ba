/*
 * What the files of meshes share: spring_mesh_make.c (which springs and bodies belong to one, in which order and with which weights), when springs
 * have changed -> spring_mesh.c (equations and their solution), in each sub-step.
 */
#ifndef CAIRN_SPRING_WEB_H
#define CAIRN_SPRING_WEB_H

#include "spring_solve.h"
#include <cairn/spring_mesh.h>

/* A part of the meshes' memory: one network, and where it lies there. */
typedef struct cairn_web {
    cairn_world *world;
    cairn_mesh *mesh;
    cairn_mesh_part *part;
    cairn_mesh_node *nodes, *node_end;
    cairn_mesh_row *rows, *row_end;
    cairn_mesh_link *links, *link_end;
} cairn_web;

CAIRN_SHARED cairn_spring *cairn_web_spring(const cairn_web *w, const cairn_mesh_link *link) { return &w->world->springs->springs[link->spring]; }
static inline uint16_t cairn_mesh_rows_of(const cairn_mesh_node *node) { return (uint16_t)(node->shifts + node->turns); }

/* ---- spring_mesh_make.c ---- */
void cairn_web_find(cairn_world *world, cairn_mesh_part *part, cairn_web *out);
/* Of the entangled networks. */
void cairn_meshes_make(cairn_world *world);

#endif
