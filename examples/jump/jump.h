/* A rule of a small game: a player can jump off whatever it touches, and not in mid-air. */
#ifndef JUMP_H
#define JUMP_H

#include <cairn/cairn.h>

/* Newton seconds: a player of 1 kg leaves the ground at 5 m/s. */
#define JUMP_IMPULSE CAIRN_F(5)

/* Gives the player the jump's impulse if it touches a body that is not a sensor. Tells whether it jumped. */
bool jump(cairn_world *world, cairn_body_id player);

#endif
