set(CAIRN_CORE m55)
set(CAIRN_CORE_BOARD mps3-an547)
include("${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake")
