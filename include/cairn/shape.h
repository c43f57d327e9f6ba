/*
 * What a rigid body is, outside of space: a circle, a box or a convex polygon. Shapes are never written to by the
 * engine; circles and boxes can be `static const` in flash, and one shape serves any number of bodies.
 */
#ifndef CAIRN_SHAPE_H
#define CAIRN_SHAPE_H

#include "arith.h"
#include "status.h"

#ifdef __cplusplus
extern "C" {
#endif

struct cairn_outline;
struct cairn_polygon;
struct cairn_manifold;
struct cairn_pose;
struct cairn_shape;

/*
 * Sizes a shape may have: radius of a circle, distance of the farthest vertex from the centre, in metres. Four times
 * the largest stays within the reach of an offset (512 m), so that the far corners of two bodies that touch do too.
 */
#define CAIRN_SHAPE_RADIUS_MAX CAIRN_F(125)
#define CAIRN_CIRCLE_RADIUS_MAX (CAIRN_WITH_GIANTS ? CAIRN_SHAPE_RADIUS_MAX : CAIRN_F(15))
#define CAIRN_SHAPE_RADIUS_MIN CAIRN_F(0.001)

typedef struct cairn_offset2 {
    cairn_offset x, y;
} cairn_offset2;

typedef struct cairn_unit2 {
    cairn_unit x, y;
} cairn_unit2;

typedef struct cairn_mass_data {
    cairn_wide area;     /* m^2 */
    cairn_wide gyration; /* radius of gyration: sqrt(inertia / mass), m */
} cairn_mass_data;

/*
 * What the engine asks of a kind of shape. A kind is linked only if a shape names it.
 * rank: kinds collide through the table of the one with the higher rank.
 */
typedef struct cairn_shape_class {
    uint8_t rank;
    cairn_status (*check)(const struct cairn_shape *shape);
    /* Half sizes of the bounding box about the centre of mass, rounded up, for the rotation (c, s). */
    void (*extents)(const struct cairn_shape *shape, cairn_unit c, cairn_unit s, cairn_real *x, cairn_real *y);
    /* The contact of a (of lower or equal rank) with b, seen from a's centre of mass; by the rank of a. One of two is round where contacts have one point. */
    void (*collide[CAIRN_MAX_POINTS == 1 ? 1 : 3])(const struct cairn_pose *a, const struct cairn_pose *b, cairn_offset margin, struct cairn_manifold *out);
} cairn_shape_class;

extern const cairn_shape_class cairn_circle_class;
extern const cairn_shape_class cairn_box_class;
extern const cairn_shape_class cairn_polygon_class;

typedef struct cairn_shape {
    const cairn_shape_class *kind;
    cairn_vec2 size;                     /* circle: radius, 0; box: width, height; polygon: bounding radius, 0 */
    const struct cairn_polygon *polygon; /* polygons only */
} cairn_shape;

/* Constant initialisers; arguments are cairn_real, as in CAIRN_BOX(CAIRN_F(1), CAIRN_F(0.5)). */
#define CAIRN_CIRCLE(radius) { &cairn_circle_class, { (radius), 0 }, NULL }
#define CAIRN_BOX(width, height) { &cairn_box_class, { (width), (height) }, NULL }

/* A convex polygon's data, made by cairn_polygon_init or by the scene converter. Counter-clockwise. */
typedef struct cairn_polygon {
    cairn_shape shape; /* use &polygon.shape */
    uint8_t count;
    cairn_offset inradius; /* of the disc about the centroid that it covers */
    cairn_offset2 centroid, vertex[CAIRN_MAX_VERTICES]; /* vertices relative to the centroid */
    cairn_unit2 normal[CAIRN_MAX_VERTICES]; /* outward, of the edge from vertex i to i + 1 */
    cairn_mass_data mass;
} cairn_polygon;

/*
 * Make the convex polygon with these corners, in either direction, at most CAIRN_MAX_VERTICES, within 125 m of the
 * origin. Points are relative to the body's position; the body turns about their centroid.
 * CAIRN_ERROR_SHAPE if it is concave, self-crossing, has coinciding or collinear corners, or is thinner than 1 mm;
 * CAIRN_ERROR_RANGE if there are too few or too many points.
 */
cairn_status cairn_polygon_init(cairn_polygon *polygon, const cairn_vec2 *points, int count);

/*
 * Make the convex hull of any set of up to 2 * CAIRN_MAX_VERTICES points (slides: "convex hull or rejection").
 * CAIRN_ERROR_SHAPE if the hull has too many corners or is degenerate.
 */
cairn_status cairn_polygon_init_hull(cairn_polygon *polygon, const cairn_vec2 *points, int count);

/* Make the regular polygon with this many sides and this circumradius; its first corner is at angle 0. */
cairn_status cairn_polygon_init_regular(cairn_polygon *polygon, int sides, cairn_real radius);

/* Area in m^2 and second moment of area about the centroid over the area (the squared radius of gyration, m^2). */
cairn_status cairn_shape_measure(const cairn_shape *shape, cairn_mass_data *out);

#ifdef __cplusplus
}
#endif

#endif
