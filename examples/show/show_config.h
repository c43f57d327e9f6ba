/* Two worlds are solved at once: here time is short. See include/cairn/config.h. */
#define CAIRN_WITH_QUICK_WAYS 1
