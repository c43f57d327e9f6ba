/* The least that boxes and polygons that turn, rub and bounce take: the small solver alone. */
#include "small.h"
#define CAIRN_WITH_SETTINGS 0
#define CAIRN_WITH_SORT 0
#define CAIRN_WITH_GRAVITY_SCALE 0
#define CAIRN_WITH_DAMPING 0
#define CAIRN_WITH_FIXED_POSITION 0
#define CAIRN_WITH_SENSORS 0
#define CAIRN_WITH_SLEEP 0
#define CAIRN_WITH_QUADTREE 0
#define CAIRN_WITH_SPRINGS 0
#define CAIRN_WITH_CONTINUOUS 0
#define CAIRN_WITH_GIANTS 0
