/* The CMSDK APB timer of Arm's MPS2 boards: 32 bits, counting down. Included by one file of each board.
   Source: Arm, "Cortex-M System Design Kit Technical Reference Manual", section 4.2. */
#ifndef CAIRN_CLOCK_CMSDK_H
#define CAIRN_CLOCK_CMSDK_H

#include "board.h"

enum { CMSDK_CTRL = 0x0, CMSDK_VALUE = 0x4, CMSDK_RELOAD = 0x8, CMSDK_CTRL_ENABLE = 1 };

static inline void cmsdk_start(uint32_t base)
{
    CAIRN_REGISTER(base + CMSDK_CTRL) = 0;
    CAIRN_REGISTER(base + CMSDK_RELOAD) = UINT32_MAX;
    CAIRN_REGISTER(base + CMSDK_VALUE) = UINT32_MAX;
    CAIRN_REGISTER(base + CMSDK_CTRL) = CMSDK_CTRL_ENABLE;
}

static inline uint32_t cmsdk_ticks(uint32_t base)
{
    return UINT32_MAX - CAIRN_REGISTER(base + CMSDK_VALUE);
}

#endif
