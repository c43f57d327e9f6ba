/* From reset to main() on any Cortex-M: vector table, stack paint, .data and .bss, the FPU, and the fault handler.
   The linker script (sections.ld) puts the stack at the bottom of RAM: an overflow faults instead of eating data. */
#include "semihosting.h"
#include "stack.h"

#include <stddef.h>

#define MPU_TYPE (*(volatile uint32_t *)0xE000ED90u)
#define MPU_CTRL (*(volatile uint32_t *)0xE000ED94u)
#define MPU_RNR (*(volatile uint32_t *)0xE000ED98u)
#define MPU_RBAR (*(volatile uint32_t *)0xE000ED9Cu)
#define MPU_RASR (*(volatile uint32_t *)0xE000EDA0u) /* RLAR on v8-M */
#define SCB_CPACR (*(volatile uint32_t *)0xE000ED88u)
#define SCB_CCR (*(volatile uint32_t *)0xE000ED14u)
#define SCB_SHCSR (*(volatile uint32_t *)0xE000ED24u)

enum {
    CCR_TRAP_DIVIDE_BY_ZERO = 1 << 4,
    SHCSR_SEPARATE_FAULTS = 7 << 16, /* memory, bus and usage faults get their own numbers */
    MPU_ENABLE_OVER_DEFAULT_MAP = 5,
    MPU_V7_16M_NO_ACCESS = 1 << 28 | 23 << 1 | 1, /* execute never, 2^(23 + 1) bytes, on */
    MPU_V8_READ_ONLY_NO_EXECUTE = 2 << 1 | 1,
    GUARD_BYTES = 1 << 24,
    FAULT_EXIT_CODE = 100,
    FRAME_PC = 6 /* words from the stack pointer to the pc that an exception stacks */
};

extern uint32_t cairn_link_data_source[], cairn_link_data_start[], cairn_link_data_end[];
extern uint32_t cairn_link_bss_start[], cairn_link_bss_end[];

int main(void);
void cairn_reset(void);
void cairn_start(void);
void cairn_fault(void);
void cairn_fault_report(uint32_t exception, const uint32_t *frame);

/* A board that needs the SysTick interrupt defines this. */
void cairn_systick(void) __attribute__((weak, alias("cairn_fault")));

typedef void (*vector)(void);

__attribute__((section(".vectors"), used)) static const struct {
    uint32_t *stack_top;
    vector exceptions[15];
} vectors = {
    cairn_link_stack_top,
    {cairn_reset, cairn_fault, cairn_fault, cairn_fault, cairn_fault, cairn_fault, cairn_fault, cairn_fault, cairn_fault,
     cairn_fault, cairn_fault, cairn_fault, cairn_fault, cairn_fault, cairn_systick},
};

#if __ARM_ARCH_ISA_THUMB >= 2

/* Not every machine faults below its RAM (MPS2 takes the writes and forgets them): forbid the 16 MB below the stack. */
static void guard_stack(void)
{
    if (MPU_TYPE == 0)
        return;
    MPU_RNR = 0;
#if __ARM_ARCH >= 8
    MPU_RBAR = ((uint32_t)cairn_link_stack_bottom - GUARD_BYTES) | MPU_V8_READ_ONLY_NO_EXECUTE;
    MPU_RASR = ((uint32_t)cairn_link_stack_bottom - 32u) | 1u;
#else
    MPU_RBAR = (uint32_t)cairn_link_stack_bottom - GUARD_BYTES;
    MPU_RASR = MPU_V7_16M_NO_ACCESS;
#endif
    MPU_CTRL = MPU_ENABLE_OVER_DEFAULT_MAP;
    __asm__ volatile("dsb\n\tisb" ::: "memory");
}

static void enable_traps(void)
{
    SCB_CCR |= CCR_TRAP_DIVIDE_BY_ZERO;
    SCB_SHCSR |= SHCSR_SEPARATE_FAULTS;
    guard_stack();
}

#else

/* A v6-M core has neither an MPU nor faults of several kinds. */
static void enable_traps(void)
{
}

#endif

static void enable_fpu(void)
{
#if defined(__ARM_FP)
    /* Full access to coprocessors 10 and 11, the FPU (and the vector unit of an M55). */
    SCB_CPACR |= 0xFu << 20;
    __asm__ volatile("dsb\n\tisb" ::: "memory");
#endif
}

/* Paints the whole stack while nothing is on it yet, which C code could not promise. */
__attribute__((naked)) void cairn_reset(void)
{
    __asm__ volatile("ldr r0, =cairn_link_stack_bottom\n\t"
                     "ldr r1, =cairn_link_stack_top\n\t"
                     "ldr r2, =%c0\n"
                     "1: str r2, [r0]\n\t"
                     "adds r0, #4\n\t"
                     "cmp r0, r1\n\t"
                     "blo 1b\n\t"
                     "ldr r0, =cairn_start\n\t"
                     "bx r0\n\t"
                     ".ltorg" ::"i"(CAIRN_STACK_PAINT));
}

__attribute__((used)) void cairn_start(void)
{
    enable_fpu();
    enable_traps();
    const uint32_t *from = cairn_link_data_source;
    for (uint32_t *to = cairn_link_data_start; to < cairn_link_data_end; to++)
        *to = *from++;
    for (uint32_t *to = cairn_link_bss_start; to < cairn_link_bss_end; to++)
        *to = 0;
    cairn_semihosting_exit(main());
}

/* The stack may be what failed: note the frame, then start again from its top. */
__attribute__((naked)) void cairn_fault(void)
{
    __asm__ volatile("mrs r0, ipsr\n\t"
                     "mov r1, sp\n\t"
                     "ldr r2, =cairn_link_stack_top\n\t"
                     "mov sp, r2\n\t"
                     "ldr r2, =cairn_fault_report\n\t"
                     "bx r2\n\t"
                     ".ltorg");
}

static void write_hex(uint32_t value)
{
    char text[9];
    for (size_t i = 0; i < 8; i++)
        text[i] = "0123456789abcdef"[(value >> (28u - 4u * i)) & 0xFu];
    text[8] = '\0';
    cairn_semihosting_write(text);
}

__attribute__((used)) void cairn_fault_report(uint32_t exception, const uint32_t *frame)
{
    cairn_semihosting_write("\nfault: exception 0x");
    write_hex(exception);
    if (frame >= cairn_link_stack_bottom && frame + FRAME_PC < cairn_link_stack_top) {
        cairn_semihosting_write(" at pc 0x");
        write_hex(frame[FRAME_PC]);
    } else {
        cairn_semihosting_write(", stack overflow");
    }
    cairn_semihosting_write("\n");
    cairn_semihosting_exit(FAULT_EXIT_CODE + (int)exception);
}
