/* A build for boxes and balls that do not turn, among upright boxes. */
#include "lean.h"
#define CAIRN_WITH_TURNING 0
#define CAIRN_WITH_SLOPES 0
#define CAIRN_WITH_FIXED_POSITION 0
#define CAIRN_WITH_POLYGONS 0
