# Unity tests and CMock mocks. On the host a test is a program, in a cross build an image that ctest runs in QEMU.
#   cairn_add_unit_test(NAME SOURCE [SOURCES file...] [LIBRARIES target...] [HOST_ONLY])
#   cairn_add_mocks(TARGET CONFIG file PREFIX prefix HEADERS file...)
# A game of another project includes this file after Cairn itself, which gives it cairn::mock and these functions:
#   include("${cairn_SOURCE_DIR}/cmake/testing.cmake")

include("${CMAKE_CURRENT_LIST_DIR}/images.cmake")

find_program(CAIRN_RUBY ruby REQUIRED)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
if(NOT EXISTS "${CAIRN_CMOCK_ROOT}/lib/cmock.rb")
    message(FATAL_ERROR "no CMock in ${CAIRN_CMOCK_ROOT}: run tools/setup, set CAIRN_CMOCK_ROOT, or CAIRN_BUILD_TESTS=OFF")
endif()

set(CAIRN_UNITY_DIR "${CAIRN_CMOCK_ROOT}/vendor/unity")
set(CAIRN_TEST_SUPPORT_DIR "${CMAKE_CURRENT_LIST_DIR}/../tests/support")
set(CAIRN_TEST_SECONDS 300 CACHE STRING "After how many seconds a test has failed")

# Unity and CMock are others' code: their headers are system headers, their sources compile without our warnings.
if(NOT TARGET cairn_unity)
    add_library(cairn_unity STATIC "${CAIRN_UNITY_DIR}/src/unity.c")
    target_include_directories(cairn_unity SYSTEM PUBLIC "${CAIRN_UNITY_DIR}/src")
    target_compile_definitions(cairn_unity PUBLIC UNITY_INCLUDE_DOUBLE UNITY_SUPPORT_64)
    add_library(cairn_cmock STATIC "${CAIRN_CMOCK_ROOT}/src/cmock.c")
    target_include_directories(cairn_cmock SYSTEM PUBLIC "${CAIRN_CMOCK_ROOT}/src")
    target_link_libraries(cairn_cmock PUBLIC cairn_unity)
    if(CMAKE_CROSSCOMPILING)
        target_sources(cairn_unity PRIVATE "${CAIRN_TEST_SUPPORT_DIR}/unity_console.c")
        target_include_directories(cairn_unity PUBLIC "${CAIRN_TEST_SUPPORT_DIR}" PRIVATE "${CAIRN_PORTS_DIR}/cortex-m")
        target_compile_definitions(cairn_unity PUBLIC UNITY_INCLUDE_CONFIG_H)
        # No heap on a board.
        target_compile_definitions(cairn_cmock PUBLIC CMOCK_MEM_STATIC CMOCK_MEM_SIZE=16384)
    endif()
endif()

function(cairn_add_unit_test name source)
    cmake_parse_arguments(test "HOST_ONLY" "" "SOURCES;LIBRARIES" ${ARGN})
    if(test_HOST_ONLY AND CMAKE_CROSSCOMPILING)
        return()
    endif()
    get_filename_component(path "${source}" ABSOLUTE)
    set(runner "${CMAKE_CURRENT_BINARY_DIR}/${name}_runner.c")
    add_custom_command(OUTPUT "${runner}"
        COMMAND "${CAIRN_RUBY}" "${CAIRN_UNITY_DIR}/auto/generate_test_runner.rb" --use_param_tests=1 "${path}" "${runner}"
        DEPENDS "${path}" VERBATIM)
    set_source_files_properties("${runner}" PROPERTIES COMPILE_OPTIONS "-w")
    cairn_add_image(${name} SOURCES "${path}" "${runner}" ${test_SOURCES} LIBRARIES ${test_LIBRARIES} cairn_unity)
    get_target_property(board ${name} CAIRN_BOARD)
    if(board STREQUAL "host")
        add_test(NAME ${name} COMMAND ${name})
    else()
        add_test(NAME ${name} COMMAND "${Python3_EXECUTABLE}" "${CAIRN_PORTS_DIR}/../tools/qemu-run"
            --timeout ${CAIRN_TEST_SECONDS} ${board} "$<TARGET_FILE:${name}>")
    endif()
    math(EXPR limit "${CAIRN_TEST_SECONDS} + 10")
    # A file in which the generator finds no test proves nothing.
    set_tests_properties(${name} PROPERTIES TIMEOUT ${limit} FAIL_REGULAR_EXPRESSION "(^|\n)0 Tests ")
endfunction()

function(cairn_add_mocks target)
    cmake_parse_arguments(mocks "" "CONFIG;PREFIX" "HEADERS" ${ARGN})
    get_filename_component(config "${mocks_CONFIG}" ABSOLUTE)
    set(directory "${CMAKE_CURRENT_BINARY_DIR}/${target}")
    set(outputs "")
    foreach(header IN LISTS mocks_HEADERS)
        get_filename_component(module "${header}" NAME_WE)
        set(mock "${directory}/${mocks_PREFIX}${module}")
        add_custom_command(OUTPUT "${mock}.c" "${mock}.h"
            COMMAND "${CAIRN_RUBY}" "${CAIRN_CMOCK_ROOT}/lib/cmock.rb" "-o${config}"
                "--mock_path=${directory}" "--mock_prefix=${mocks_PREFIX}" "${header}"
            DEPENDS "${header}" "${config}" VERBATIM)
        set_source_files_properties("${mock}.c" PROPERTIES COMPILE_OPTIONS "-w")
        list(APPEND outputs "${mock}.c")
    endforeach()
    add_library(${target} STATIC ${outputs})
    target_include_directories(${target} PUBLIC "${directory}")
    target_link_libraries(${target} PUBLIC cairn_cmock)
endfunction()

if(NOT TARGET cairn_mock)
    add_subdirectory("${CMAKE_CURRENT_LIST_DIR}/../tests/mock" "${CMAKE_CURRENT_BINARY_DIR}/mock")
endif()
