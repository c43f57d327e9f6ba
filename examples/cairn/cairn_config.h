/* What the game does not need of the engine: see include/cairn/config.h. */
#define CAIRN_WITH_BOUNCE 0
#define CAIRN_WITH_CONTINUOUS 0
#define CAIRN_WITH_BLOCKS 0
#define CAIRN_WITH_SLIDES_SOLVER 0
#define CAIRN_WITH_SMALL_SOLVER 0
#define CAIRN_WITH_SENSORS 0

/* And what it takes at -Os for the worst frame's sake: 1.5 KB of flash for 21,000 instructions of 825,000. */
#define CAIRN_WITH_SHORTCUTS 1
