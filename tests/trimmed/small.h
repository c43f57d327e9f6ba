/* A build whose only solver is the small one, with all else. */
#define CAIRN_WITH_SOFT_SOLVER 0
#define CAIRN_WITH_SLIDES_SOLVER 0
