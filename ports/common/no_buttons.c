/* For a port without buttons. */
#include "cairn_port.h"

uint32_t cairn_port_buttons(void)
{
    return 0;
}
