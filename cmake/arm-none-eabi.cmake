# The common part of the toolchain files: GNU Arm Embedded. CAIRN_CORE is set by the file that includes this; the core's
# flags come from the manifest of its default board, so that they are written in one place.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)

set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++) # where a game, or what we compare with, is in C++
set(CMAKE_AR arm-none-eabi-gcc-ar)
set(CMAKE_RANLIB arm-none-eabi-gcc-ranlib)
set(CMAKE_OBJCOPY arm-none-eabi-objcopy)
set(CMAKE_SIZE arm-none-eabi-size)

# A program cannot be linked without a board's linker script.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

include("${CMAKE_CURRENT_LIST_DIR}/boards.cmake")
cairn_board_read("${CAIRN_CORE_BOARD}" cpu_flags CAIRN_CORE_FLAGS)
list(JOIN CAIRN_CORE_FLAGS " " CMAKE_C_FLAGS_INIT)
string(APPEND CMAKE_C_FLAGS_INIT " -ffunction-sections -fdata-sections -masm-syntax-unified")
set(CMAKE_CXX_FLAGS_INIT "${CMAKE_C_FLAGS_INIT}")

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
