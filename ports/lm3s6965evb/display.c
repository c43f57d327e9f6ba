/* The board's OLED: an SSD0323, 128 x 64 pixels of 16 greys, by SSI0 with the data/command line on PC7.
   Source: Solomon Systech, "SSD0323", and TI's data sheet of the LM3S6965, chapter 14. */
#include "cairn_port.h"

#include "lm3s.h"

enum {
    SSI_CONTROL0 = 0x40008000,
    SSI_CONTROL1 = 0x40008004,
    SSI_DATA = 0x40008008,
    SSI_STATUS = 0x4000800C,
    SSI_PRESCALE = 0x40008010,
    SSI_8_BITS_IDLE_HIGH = 0xC7, /* 8 bits, clock idles high, second edge */
    SSI_ENABLE = 2,
    SSI_PRESCALE_1_MHZ = 50,
    STATUS_RECEIVED = 1 << 2,
    STATUS_BUSY = 1 << 4,
    FIFO_DEPTH = 8,
    PIN_DATA = 1 << 7 /* PC7: low for a command, high for data */
};

static const uint8_t init_commands[] = {
    0xAE,             /* display off */
    0x15, 0x00, 0x3F, /* columns 0 to 63, two pixels each */
    0x75, 0x00, 0x3F, /* rows 0 to 63 */
    0x81, 0x3F,       /* contrast */
    0x86,             /* full current range */
    0xA0, 0x52,       /* layout of the glass */
    0xA1, 0x00,       /* start line */
    0xA2, 0x00,       /* offset */
    0xA4,             /* show memory, not inverted */
    0xA8, 0x3F,       /* 64 lines */
    0xB1, 0x22,       /* phase lengths */
    0xB2, 0x46,       /* row period */
    0xB3, 0x71,       /* clock divider */
    0xBC, 0x0B,       /* precharge voltage */
    0xBE, 0x1F,       /* common voltage */
    0xBF, 0x0D,       /* segment low voltage */
    0xAD, 0x03,       /* external supply */
    0xE3,             /* no operation, ends the above */
    0xAF,             /* display on */
};

static const uint8_t frame_commands[] = {0x15, 0x00, 0x3F, 0x75, 0x00, 0x3F};

static uint32_t is_started;

/* As many bytes as the FIFO holds. When all have gone their answers are there, and are taken out: with a full receive FIFO the
   sender sticks. Unrolled: 4 instructions a byte, and not 12. */
static void send_burst(const uint8_t *bytes)
{
#pragma GCC unroll 8
    for (int i = 0; i < FIFO_DEPTH; i++)
        CAIRN_REGISTER(SSI_DATA) = bytes[i];
    while ((CAIRN_REGISTER(SSI_STATUS) & STATUS_BUSY) != 0) {
    }
#pragma GCC unroll 8
    for (int i = 0; i < FIFO_DEPTH; i++)
        (void)CAIRN_REGISTER(SSI_DATA);
}

static void send(const uint8_t *bytes, uint32_t count)
{
    for (; count >= FIFO_DEPTH; count -= FIFO_DEPTH, bytes += FIFO_DEPTH)
        send_burst(bytes);
    for (; count > 0; count--) {
        CAIRN_REGISTER(SSI_DATA) = *bytes++;
        while ((CAIRN_REGISTER(SSI_STATUS) & STATUS_RECEIVED) == 0) {
        }
        (void)CAIRN_REGISTER(SSI_DATA);
    }
}

static void send_commands(const uint8_t *commands, uint32_t count)
{
    *gpio_pins(GPIO_C, PIN_DATA) = 0;
    send(commands, count);
}

static void start(void)
{
    CAIRN_REGISTER(SYSCTL_CLOCK_SSI) |= SYSCTL_CLOCK_SSI0;
    CAIRN_REGISTER(SYSCTL_CLOCK_GPIO) |= SYSCTL_CLOCK_GPIO_ACDEF;
    CAIRN_REGISTER(GPIO_C + GPIO_DIRECTION) |= PIN_DATA;
    CAIRN_REGISTER(GPIO_C + GPIO_DIGITAL) |= PIN_DATA;
    CAIRN_REGISTER(SSI_CONTROL1) = 0;
    CAIRN_REGISTER(SSI_PRESCALE) = SSI_PRESCALE_1_MHZ;
    CAIRN_REGISTER(SSI_CONTROL0) = SSI_8_BITS_IDLE_HIGH;
    CAIRN_REGISTER(SSI_CONTROL1) = SSI_ENABLE;
    send_commands(init_commands, sizeof init_commands);
}

void cairn_port_display(const uint8_t *frame)
{
    if (!is_started) {
        start();
        is_started = 1;
    }
    send_commands(frame_commands, sizeof frame_commands);
    *gpio_pins(GPIO_C, PIN_DATA) = PIN_DATA;
    send(frame, CAIRN_PORT_DISPLAY_BYTES);
}
