/* Registers of the LM3S6965 that the display and the buttons share.
   Source: Texas Instruments, "Stellaris LM3S6965 Microcontroller Data Sheet", 2014. */
#ifndef CAIRN_LM3S_H
#define CAIRN_LM3S_H

#include "board.h"

enum {
    GPIO_C = 0x40006000,
    GPIO_E = 0x40024000,
    GPIO_F = 0x40025000,
    GPIO_DIRECTION = 0x400,
    GPIO_PULL_UP = 0x510,
    GPIO_DIGITAL = 0x51C,
    SYSCTL_CLOCK_SSI = 0x400FE104,  /* RCGC1 */
    SYSCTL_CLOCK_SSI0 = 1 << 4,
    SYSCTL_CLOCK_GPIO = 0x400FE108, /* RCGC2 */
    SYSCTL_CLOCK_GPIO_ACDEF = 0x3D
};

/* The data register of a port, masked to some pins: the mask is part of the address. */
static inline volatile uint32_t *gpio_pins(uint32_t port, uint32_t pins)
{
    return &CAIRN_REGISTER(port + (pins << 2));
}

#endif
