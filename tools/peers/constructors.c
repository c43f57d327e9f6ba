/* The start-up of the ports is for C: it runs no constructors. init.ld lists them. */
#include "peer.h"

extern void (*const peer_constructors_begin[])(void);
extern void (*const peer_constructors_end[])(void);
/* What a destructor of a global object is registered for; the image never runs one. */
extern void *__dso_handle;
void *__dso_handle;

void peer_construct(void)
{
    for (void (*const *constructor)(void) = peer_constructors_begin; constructor != peer_constructors_end; constructor++) {
        (*constructor)();
    }
}
