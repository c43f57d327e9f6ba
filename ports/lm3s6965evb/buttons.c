/* The board's five buttons, active low: up, down, left, right on PE0 to PE3, select on PF1. */
#include "cairn_port.h"

#include "lm3s.h"

enum { PINS_E = 0x0F, PIN_F_SELECT = 0x02, SELECT_SHIFT = 3 };

static uint32_t is_started, armed;

static void start(void)
{
    CAIRN_REGISTER(SYSCTL_CLOCK_GPIO) |= SYSCTL_CLOCK_GPIO_ACDEF;
    CAIRN_REGISTER(GPIO_E + GPIO_PULL_UP) |= PINS_E;
    CAIRN_REGISTER(GPIO_E + GPIO_DIGITAL) |= PINS_E;
    CAIRN_REGISTER(GPIO_F + GPIO_PULL_UP) |= PIN_F_SELECT;
    CAIRN_REGISTER(GPIO_F + GPIO_DIGITAL) |= PIN_F_SELECT;
}

uint32_t cairn_port_buttons(void)
{
    if (!is_started) {
        start();
        is_started = 1;
    }
    const uint32_t levels = *gpio_pins(GPIO_E, PINS_E) | (*gpio_pins(GPIO_F, PIN_F_SELECT) << SELECT_SHIFT);
    const uint32_t pressed = ~levels & (CAIRN_BUTTON_UP | CAIRN_BUTTON_DOWN | CAIRN_BUTTON_LEFT | CAIRN_BUTTON_RIGHT |
                                        CAIRN_BUTTON_SELECT);
    /* QEMU reads "pressed" until a button was released once: believe a button only after it was seen up. */
    armed |= ~pressed;
    return pressed & armed;
}
