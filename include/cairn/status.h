/* What a call that can fail returns. Zero is success, every error is negative and leaves the world as it was. */
#ifndef CAIRN_STATUS_H
#define CAIRN_STATUS_H

typedef enum cairn_status {
    CAIRN_OK = 0,
    CAIRN_ERROR_NULL = -1,    /* a required pointer is null */
    CAIRN_ERROR_STALE = -2,   /* the id names nothing: never made, or destroyed since */
    CAIRN_ERROR_RANGE = -3,   /* a number is outside of its documented range */
    CAIRN_ERROR_FULL = -4,    /* the pool has no free place */
    CAIRN_ERROR_SHAPE = -5,   /* a polygon is concave, degenerate, too large or too small */
    CAIRN_ERROR_KIND = -6,    /* the call does not apply to this kind of body or world */
    CAIRN_ERROR_LOCKED = -7   /* called from a callback of the step or of a query, where nothing may be changed */
} cairn_status;

#endif
