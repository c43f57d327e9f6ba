# Takes Cairn into another project in every way the README names, builds its game and runs it.
#   cmake -DSOURCE=... -DBUILD=... -DWORK=... -DCOMPILER=... -DDOUBLE=... -P check.cmake
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT code EQUAL 0)
        message(FATAL_ERROR "${ARGN} ended with ${code}:\n${output}")
    endif()
endfunction()

file(REMOVE_RECURSE "${WORK}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/installed")
foreach(how IN ITEMS find_package add_subdirectory FetchContent)
    run("${CMAKE_COMMAND}" -G Ninja -S "${CMAKE_CURRENT_LIST_DIR}" -B "${WORK}/${how}"
        -DHOW=${how} "-DCAIRN_SOURCE=${SOURCE}" "-DCMAKE_PREFIX_PATH=${WORK}/installed"
        "-DCMAKE_C_COMPILER=${COMPILER}" -DCAIRN_DOUBLE=${DOUBLE})
    run("${CMAKE_COMMAND}" --build "${WORK}/${how}")
    run("${WORK}/${how}/game")
    foreach(program IN ITEMS game_in_cpp image test_marble)
        if(EXISTS "${WORK}/${how}/${program}")
            run("${WORK}/${how}/${program}")
        endif()
    endforeach()
    message("${how}: ok")
endforeach()
