/*
 * The engine for scripting languages: plain numbers in SI units in and out, no structures, any number of worlds in one
 * process. tools/cairn_tools/host.py wraps it. A body, spring, shape or material is named by a whole number above
 * zero; what fails gives a cairn_status, which is negative. Numbers beyond a format's range are cut to it.
 */
#ifndef CAIRN_SHIM_H
#define CAIRN_SHIM_H

#include <stdint.h>

#define SHIM __attribute__((visibility("default")))

typedef struct shim_world shim_world;

/* What shim_body takes beside numbers, or-ed together. */
enum { SHIM_SENSOR = 1, SHIM_FIXED_ROTATION = 2, SHIM_FIXED_POSITION = 4 };
/* A state: x, y of the centre of mass, angle in (-pi, pi], velocity, angular velocity. At the engine's full resolution. */
enum { SHIM_STATE = 6 };
/* A contact: bodies a and b, touching (0, 1), normal, then x, y, separation and impulse of two points (NaN: no such point). */
enum { SHIM_CONTACT = 13 };
/* steps, dropped, saturations, bodies, awake, pairs, arbiters, points, springs, tree_cells, tree_entries, tree_full, looked, solved, moved */
enum { SHIM_STATS = 15 };

/* Null if out of memory or a number is out of range. springs and cells (of the quadtree) may be 0. */
SHIM shim_world *shim_create(int bodies, int arbiters, int springs, int cells, double gravity_x, double gravity_y);
SHIM void shim_destroy(shim_world *w);

/* Settings. Each gives a cairn_status. */
SHIM int shim_set_gravity(shim_world *w, double x, double y);
SHIM int shim_set_rate(shim_world *w, double steps_per_second);
SHIM int shim_set_substeps(shim_world *w, int substeps);
SHIM int shim_set_slop(shim_world *w, double slop);
SHIM int shim_set_push_out(shim_world *w, double speed);
SHIM int shim_set_sleep(shim_world *w, int on);
SHIM int shim_use_slides_solver(shim_world *w, int passes);
SHIM int shim_use_small_solver(shim_world *w, int passes);
SHIM int shim_use_quadtree(shim_world *w, double x, double y, int size_log2, int depth);
SHIM double shim_speed_limit(const shim_world *w);

SHIM int shim_circle(shim_world *w, double radius);
SHIM int shim_box(shim_world *w, double width, double height);
SHIM int shim_polygon(shim_world *w, const double *points, int count); /* x, y, x, y ... */
SHIM int shim_regular(shim_world *w, int sides, double radius);
/* Without restitution the threshold is not used. */
SHIM int shim_material(shim_world *w, double static_friction, double kinetic_friction, double restitution, double threshold);

/* type: a cairn_body_type. Material 0 is the default one. x, y: of the shape's origin. */
SHIM int64_t shim_body(shim_world *w, int shape, int material, int type, int flags, double density, double x, double y, double angle,
                       double vx, double vy, double omega);
SHIM int shim_body_destroy(shim_world *w, int64_t body);
SHIM int shim_body_set_transform(shim_world *w, int64_t body, double x, double y, double angle);
SHIM int shim_body_set_velocity(shim_world *w, int64_t body, double vx, double vy, double omega);
SHIM int shim_body_set_layers(shim_world *w, int64_t body, int layer, int mask);
SHIM int shim_body_set_damping(shim_world *w, int64_t body, double linear, double angular);
SHIM int shim_body_set_gravity_scale(shim_world *w, int64_t body, double scale);
SHIM int shim_body_force(shim_world *w, int64_t body, double fx, double fy, double x, double y);
SHIM int shim_body_impulse(shim_world *w, int64_t body, double px, double py, double x, double y);
SHIM double shim_body_mass(shim_world *w, int64_t body);
SHIM double shim_body_inertia(shim_world *w, int64_t body);

/* Anchors in the bodies' frames; a negative rest length means as placed. */
SHIM int64_t shim_spring(shim_world *w, int64_t a, int64_t b, double ax, double ay, double bx, double by, double rest_length,
                         double stiffness, double damping, int no_contact);
/* Solve entangled networks as a whole. */
SHIM int shim_use_meshes(shim_world *w);
SHIM int shim_spring_destroy(shim_world *w, int64_t spring);

/* Advance. shim_record also writes the states of some bodies: before the first step and after each `every`th. */
SHIM int shim_step(shim_world *w, int steps);
SHIM int shim_record(shim_world *w, int steps, int every, const int64_t *bodies, int count, double *out);
/* States of some bodies; NaN for what does not exist. */
SHIM void shim_states(shim_world *w, const int64_t *bodies, int count, double *out);
/* Writes up to `capacity` contacts and gives how many there are. */
SHIM int shim_contacts(shim_world *w, double *out, int capacity);
SHIM void shim_stats(const shim_world *w, int64_t *out);
/* The engine's own in fixed point; one of all states in double. */
SHIM uint32_t shim_hash(shim_world *w);
/* The status of the last call that failed, and 0 from then on. */
SHIM int shim_error(shim_world *w);

#endif
