/* A build of Cairn without all that config.h can leave out, as tools/cairn trim writes it for balls at rest. */
#define CAIRN_WITH_SPRINGS 0
#define CAIRN_WITH_BOUNCE 0
#define CAIRN_WITH_CONTINUOUS 0
#define CAIRN_WITH_BLOCKS 0
#define CAIRN_WITH_SLEEP 0
#define CAIRN_WITH_QUADTREE 0
#define CAIRN_WITH_SLIDES_SOLVER 0
#define CAIRN_WITH_SMALL_SOLVER 0
#define CAIRN_WITH_FIXED_POSITION 0
#define CAIRN_WITH_SENSORS 0
#define CAIRN_WITH_DAMPING 0
#define CAIRN_MAX_POINTS 1
#define CAIRN_MAX_VERTICES 4
