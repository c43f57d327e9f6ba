/* No engine: what the image takes without one. */
#include "peer.h"

bool peer_build(peer_wish wish)
{
    (void)wish;
    return true;
}
void peer_step(void) {}
int peer_body_count(void) { return 0; }
uint32_t peer_spare(void) { return 0; }

peer_place peer_body_place(int body)
{
    (void)body;
    return (peer_place){0, 0, 0};
}
