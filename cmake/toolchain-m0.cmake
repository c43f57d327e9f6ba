set(CAIRN_CORE m0)
set(CAIRN_CORE_BOARD microbit)
include("${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake")
