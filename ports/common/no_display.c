/* For a port without a display. */
#include "cairn_port.h"

void cairn_port_display(const uint8_t *frame)
{
    (void)frame;
}
