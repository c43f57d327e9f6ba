# Chooses the core's faster primitives of the arithmetic, ports/arith; they give the same bits as the plain C.
include(CheckCSourceCompiles)

set(CAIRN_ARITH auto CACHE STRING "Primitives of the arithmetic: auto, none, armv6m or armv7m")
set_property(CACHE CAIRN_ARITH PROPERTY STRINGS auto none armv6m armv7m)

# Sets CAIRN_ARITH_CHOSEN to a header's name in ports/arith, or to nothing.
function(cairn_choose_arithmetic)
    set(chosen "${CAIRN_ARITH}")
    if(chosen STREQUAL "auto")
        check_c_source_compiles("
            #if !defined(__ARM_ARCH_PROFILE) || __ARM_ARCH_PROFILE != 'M' || !defined(__thumb2__)
            #error not a Cortex-M3 or above
            #endif
            int main(void) { return 0; }" CAIRN_CORE_IS_ARMV7M)
        check_c_source_compiles("
            #if !defined(__ARM_ARCH_PROFILE) || __ARM_ARCH_PROFILE != 'M' || defined(__thumb2__)
            #error not a Cortex-M0, M0+, M1 or M23
            #endif
            int main(void) { return 0; }" CAIRN_CORE_IS_ARMV6M)
        if(CAIRN_CORE_IS_ARMV7M)
            set(chosen armv7m)
        elseif(CAIRN_CORE_IS_ARMV6M)
            set(chosen armv6m)
        else()
            set(chosen none)
        endif()
    endif()
    if(CAIRN_DOUBLE OR chosen STREQUAL "none")
        set(chosen "")
    elseif(NOT EXISTS "${PROJECT_SOURCE_DIR}/ports/arith/${chosen}.h")
        message(FATAL_ERROR "CAIRN_ARITH is '${chosen}'; known: auto, none, armv6m, armv7m")
    endif()
    set(CAIRN_ARITH_CHOSEN "${chosen}" PARENT_SCOPE)
endfunction()
