/* The slides' demo scenes, small enough for half a picture: what each puts into a world of its own. */
#ifndef STAGES_H
#define STAGES_H

#include <cairn/cairn.h>

/* How many there are. */
int stages_count(void);
const char *stages_name(int number);
/* Pixels a metre, and the height in the middle of the picture. */
int stages_scale(int number);
cairn_real stages_height(int number);
/* Fill an empty world in which springs are enabled. */
void stages_build(int number, cairn_world *world);

#endif
