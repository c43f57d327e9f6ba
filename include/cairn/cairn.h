/* All of Cairn's public headers. Including them costs nothing; what is not called is not linked. */
#ifndef CAIRN_H
#define CAIRN_H

#include "arbiter.h"
#include "arith.h"
#include "block.h"
#include "body.h"
#include "debug_draw.h"
#include "material.h"
#include "quadtree.h"
#include "query.h"
#include "shape.h"
#include "sleep.h"
#include "solver.h"
#include "spring.h"
#include "spring_mesh.h"
#include "status.h"
#include "world.h"

#endif
