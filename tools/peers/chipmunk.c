/* Chipmunk 7, in single precision. */
#include "peer.h"

#include <chipmunk/chipmunk.h>

/* Chipmunk's default. */
enum { ITERATIONS = 10 };
/* Metres. The default of 0.1 is for lengths in pixels: a stack of crates of one metre would sink by a tenth at each joint. */
static const cpFloat SLOP = 0.005f;

static cpSpace *space;
static cpFloat step;

static cpVect vect(peer_vec v) { return cpv(v.x, v.y); }

/* Chipmunk multiplies both frictions and both restitutions: the root makes that their geometric mean. */
static void add_shape(cpBody *body, const peer_body *entry, const peer_shape *from)
{
    cpShape *shape;
    if (from->count == 0) {
        shape = cpCircleShapeNew(body, from->radius, cpvzero);
    } else {
        cpVect corners[PEER_CORNERS];
        for (int i = 0; i < from->count; i++) {
            corners[i] = vect(from->corners[i]);
        }
        shape = cpPolyShapeNewRaw(body, from->count, corners, 0);
    }
    cpShapeSetFriction(shape, cpfsqrt(entry->friction));
    cpShapeSetElasticity(shape, cpfsqrt(entry->restitution));
    cpShapeSetFilter(shape, cpShapeFilterNew(CP_NO_GROUP, entry->layer, entry->mask));
    cpSpaceAddShape(space, shape);
}

static cpBody *make_body(const peer_body *entry)
{
    const peer_shape *shape = &peer_the_scene.shapes[entry->shape];
    cpBody *body = entry->is_static ? cpBodyNewStatic() : cpBodyNew(entry->mass, entry->fixed_rotation ? (cpFloat)INFINITY : entry->inertia);
    if (!entry->is_static) {
        cpBodySetCenterOfGravity(body, vect(shape->centre));
    }
    cpBodySetAngle(body, entry->angle);
    cpBodySetPosition(body, vect(entry->position));
    cpSpaceAddBody(space, body);
    if (!entry->is_static) {
        cpBodySetVelocity(body, vect(entry->velocity));
        cpBodySetAngularVelocity(body, entry->angular_velocity);
    }
    add_shape(body, entry, shape);
    return body;
}

static void make_spring(const peer_spring *entry)
{
    cpConstraint *spring = cpDampedSpringNew(peer_handles[entry->a], peer_handles[entry->b], vect(entry->anchor_a), vect(entry->anchor_b),
                                             entry->rest_length, entry->stiffness, entry->damping);
    cpConstraintSetCollideBodies(spring, entry->collide);
    cpSpaceAddConstraint(space, spring);
}

bool peer_build(peer_wish wish)
{
    step = wish.step > 0 ? wish.step : peer_the_scene.step;
    space = cpSpaceNew();
    cpSpaceSetGravity(space, vect(peer_the_scene.gravity));
    cpSpaceSetIterations(space, wish.iterations > 0 ? wish.iterations : ITERATIONS);
    cpSpaceSetCollisionSlop(space, SLOP);
    for (int i = 0; i < peer_the_scene.body_count; i++) {
        peer_handles[i] = make_body(&peer_the_scene.bodies[i]);
    }
    for (int i = 0; i < peer_the_scene.spring_count; i++) {
        make_spring(&peer_the_scene.springs[i]);
    }
    return true;
}

void peer_step(void) { cpSpaceStep(space, step); }
int peer_body_count(void) { return peer_the_scene.body_count; }
uint32_t peer_spare(void) { return 0; }

peer_place peer_body_place(int body)
{
    const cpVect position = cpBodyGetPosition(peer_handles[body]);
    return (peer_place){peer_fixed(position.x), peer_fixed(position.y), peer_fixed(cpBodyGetAngle(peer_handles[body]))};
}
