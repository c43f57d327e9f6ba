# Programs on a port: cairn_add_image(NAME [BOARD board] SOURCES file... [LIBRARIES target...]).
# On the host the board is "host" and the image an ordinary program. In a cross build the board is one of the core's,
# ${CAIRN_BOARD} by default; run the image by `tools/qemu-run BOARD IMAGE.elf`.
# A game of another project includes this file after Cairn itself: include("${cairn_SOURCE_DIR}/cmake/images.cmake")

include("${CMAKE_CURRENT_LIST_DIR}/boards.cmake")

if(NOT CMAKE_CROSSCOMPILING)
    set(CAIRN_BOARD host)
else()
    set(CAIRN_BOARD "${CAIRN_CORE_BOARD}" CACHE STRING "The board that images are linked for")
endif()

if(NOT TARGET cairn_print)
    add_library(cairn_print STATIC "${CAIRN_PORTS_DIR}/common/print.c")
    target_include_directories(cairn_print PUBLIC "${CAIRN_PORTS_DIR}/include")
    target_link_libraries(cairn_print PRIVATE cairn_warnings)
endif()

option(CAIRN_WINDOW "The host's images in a window of SDL2, with keys; without it they have no display and no buttons" OFF)

function(cairn_add_host_port)
    add_library(cairn_port_host STATIC "${CAIRN_PORTS_DIR}/host/port.c" "${CAIRN_PORTS_DIR}/host/keep.c")
    target_include_directories(cairn_port_host PUBLIC "${CAIRN_PORTS_DIR}/include")
    target_link_libraries(cairn_port_host PRIVATE cairn_warnings)
    if(CAIRN_WINDOW)
        find_package(SDL2 QUIET)
        if(NOT SDL2_FOUND)
            message(FATAL_ERROR "CAIRN_WINDOW needs SDL2: tools/setup --window installs it (Debian's libsdl2-dev)")
        endif()
        target_sources(cairn_port_host PRIVATE "${CAIRN_PORTS_DIR}/host/window.c")
        target_link_libraries(cairn_port_host PRIVATE SDL2::SDL2)
    else()
        target_sources(cairn_port_host PRIVATE
            "${CAIRN_PORTS_DIR}/common/no_display.c"
            "${CAIRN_PORTS_DIR}/common/no_buttons.c")
    endif()
endfunction()

# The library of a board: made when the first image asks for it.
function(cairn_add_board_port board)
    cairn_board_read(${board} core core)
    if(NOT core STREQUAL CAIRN_CORE)
        message(FATAL_ERROR "the board ${board} has the core ${core}, this build is for ${CAIRN_CORE}")
    endif()
    cairn_board_read(${board} sources sources)
    list(TRANSFORM sources PREPEND "${CAIRN_PORTS_DIR}/${board}/")
    set(shared "${CAIRN_PORTS_DIR}/cortex-m")
    if(NOT "${CAIRN_PORTS_DIR}/${board}/display.c" IN_LIST sources)
        list(APPEND sources "${CAIRN_PORTS_DIR}/common/no_display.c")
    endif()
    if(NOT "${CAIRN_PORTS_DIR}/${board}/buttons.c" IN_LIST sources)
        list(APPEND sources "${CAIRN_PORTS_DIR}/common/no_buttons.c")
    endif()
    add_library(cairn_port_${board} STATIC ${sources} "${shared}/port.c" "${shared}/keep.c" "${shared}/semihosting.c" "${shared}/stack.c")
    target_include_directories(cairn_port_${board} PUBLIC "${CAIRN_PORTS_DIR}/include" "${shared}")
    target_link_libraries(cairn_port_${board} PRIVATE cairn_warnings)
    # The vector table is named by nobody: its object is linked as a file, not from the library.
    add_library(cairn_startup_${board} OBJECT "${shared}/startup.c")
    target_link_libraries(cairn_startup_${board} PRIVATE cairn_warnings)
endfunction()

function(cairn_add_image name)
    cmake_parse_arguments(image "" "BOARD" "SOURCES;LIBRARIES" ${ARGN})
    if(NOT image_BOARD)
        set(image_BOARD "${CAIRN_BOARD}")
    endif()
    if(NOT TARGET cairn_port_${image_BOARD})
        if(image_BOARD STREQUAL "host")
            cairn_add_host_port()
        else()
            cairn_add_board_port(${image_BOARD})
        endif()
    endif()
    add_executable(${name} ${image_SOURCES})
    set_target_properties(${name} PROPERTIES CAIRN_BOARD "${image_BOARD}")
    target_include_directories(${name} PRIVATE "${CAIRN_PORTS_DIR}/include")
    target_link_libraries(${name} PRIVATE ${image_LIBRARIES} cairn_print cairn_warnings)
    if(image_BOARD STREQUAL "host")
        target_link_libraries(${name} PRIVATE cairn_port_host)
    else()
        cairn_link_for_board(${name} ${image_BOARD})
    endif()
endfunction()

function(cairn_link_for_board name board)
    set(script "${CAIRN_PORTS_DIR}/${board}/board.ld")
    set_target_properties(${name} PROPERTIES
        SUFFIX ".elf"
        LINK_DEPENDS "${script};${CAIRN_PORTS_DIR}/cortex-m/sections.ld")
    target_link_libraries(${name} PRIVATE cairn_startup_${board} cairn_port_${board})
    target_link_options(${name} PRIVATE
        -nostartfiles --specs=nosys.specs
        "-L${CAIRN_PORTS_DIR}/cortex-m" "-T${script}"
        -Wl,--gc-sections -Wl,--no-warn-rwx-segments "-Wl,-Map=$<TARGET_FILE:${name}>.map")
endfunction()
