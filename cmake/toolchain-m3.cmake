set(CAIRN_CORE m3)
set(CAIRN_CORE_BOARD mps2-an385)
include("${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake")
