# The engine's source files. A feature is a file; what a game does not call is not linked.
set(CAIRN_SOURCES
)
