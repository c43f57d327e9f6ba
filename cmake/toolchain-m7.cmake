set(CAIRN_CORE m7)
set(CAIRN_CORE_BOARD mps2-an500)
include("${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake")
