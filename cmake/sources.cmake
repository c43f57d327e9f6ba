# The engine's source files. A feature is a file; what a game does not call is not linked.
set(CAIRN_SOURCES
    src/arbiter.c
    src/arith_fixed.c
    src/broad_pairs.c
    src/collide_circle_polygon.c
    src/collide_polygon.c
    src/contact.c
    src/material.c
    src/rows.c
    src/shape_box.c
    src/shape_circle.c
    src/shape_polygon.c
)
