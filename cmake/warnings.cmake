# cairn_warnings: what our own C files are compiled with. Never passed on to those who link Cairn.
add_library(cairn_warnings INTERFACE)
target_compile_options(cairn_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
if(CAIRN_IS_TOP_LEVEL)
    # A later compiler's new warning must not break the build of a game.
    target_compile_options(cairn_warnings INTERFACE -Werror)
endif()
