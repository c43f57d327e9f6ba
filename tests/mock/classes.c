/* The constants that the public headers promise, without the engine behind them: for a game under cairn::mock. */
#include <cairn/cairn.h>

const cairn_shape_class cairn_circle_class = {.rank = 0};
const cairn_shape_class cairn_box_class = {.rank = 1};
const cairn_shape_class cairn_polygon_class = {.rank = 1};
const cairn_bounce_class cairn_bounce = {0};
const cairn_solver_class cairn_solver_soft = {0};
const cairn_solver_class cairn_solver_slides = {0};
const cairn_solver_class cairn_solver_small = {0};
