/* The leanest engine that has all features: without what only saves time, and without contacts that hold. */
#define CAIRN_WITH_QUICK_WAYS 0
#define CAIRN_WITH_SHORTCUTS 0
#define CAIRN_WITH_HOLD 0
#define CAIRN_WITH_QUICK_SPRINGS 0
