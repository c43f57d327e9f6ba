set(CAIRN_CORE m33)
set(CAIRN_CORE_BOARD mps2-an505)
include("${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake")
