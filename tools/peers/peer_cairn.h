/* What of Cairn a scene needs beside bodies, by functions of cairn.c: a feature that no table names is not linked. */
#ifndef CAIRN_PEER_CAIRN_H
#define CAIRN_PEER_CAIRN_H

#include "peer.h"
#include "scene.h"

/* False if the engine refuses. */
typedef bool (*peer_feature)(void);

bool peer_use_springs(void);
bool peer_use_quadtree(void);
bool peer_use_blocks(void);
bool peer_use_slides(void);
bool peer_use_small(void);

/* Ended by null; written by tools/cairn_tools/peers.py behind the table of `tools/cairn table`. */
extern const peer_feature peer_features[];

#endif
