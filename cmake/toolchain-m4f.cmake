set(CAIRN_CORE m4f)
set(CAIRN_CORE_BOARD mps2-an386)
include("${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake")
