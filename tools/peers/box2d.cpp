// Box2D 2.4, which is in single precision.
#include "peer.h"

#include <box2d/box2d.h>

#include <new>

namespace {

// What Box2D's manual suggests.
constexpr int default_velocity_iterations = 8;
constexpr int default_position_iterations = 3;

int velocity_iterations, position_iterations;
float step;

alignas(b2World) unsigned char world_memory[sizeof(b2World)];
b2World *world;

b2Body *body_at(int place)
{
    return static_cast<b2Body *>(peer_handles[place]);
}

b2Vec2 vect(peer_vec v)
{
    return b2Vec2(v.x, v.y);
}

void add_fixture(b2Body *body, const peer_body &entry, const peer_shape &from)
{
    b2CircleShape circle;
    b2PolygonShape polygon;
    b2FixtureDef def;
    if (from.count == 0) {
        circle.m_radius = from.radius;
        def.shape = &circle;
    } else {
        b2Vec2 corners[PEER_CORNERS];
        for (int i = 0; i < from.count; i++) {
            corners[i] = vect(from.corners[i]);
        }
        polygon.Set(corners, from.count);
        def.shape = &polygon;
    }
    def.friction = entry.friction;
    def.restitution = entry.restitution;
    def.density = 1.0f; // the body's mass is set below
    def.filter.categoryBits = entry.layer;
    def.filter.maskBits = entry.mask;
    body->CreateFixture(&def);
}

b2Body *make_body(const peer_body &entry)
{
    const peer_shape &shape = peer_the_scene.shapes[entry.shape];
    b2BodyDef def;
    def.type = entry.is_static ? b2_staticBody : b2_dynamicBody;
    def.position = vect(entry.position);
    def.angle = entry.angle;
    def.linearVelocity = vect(entry.velocity);
    def.angularVelocity = entry.angular_velocity;
    def.fixedRotation = entry.fixed_rotation;
    b2Body *body = world->CreateBody(&def);
    add_fixture(body, entry, shape);
    if (!entry.is_static) {
        b2MassData mass;
        mass.mass = entry.mass;
        mass.center = vect(shape.centre);
        mass.I = entry.inertia + entry.mass * b2Dot(mass.center, mass.center); // about the body's origin
        body->SetMassData(&mass);
    }
    return body;
}

void make_spring(const peer_spring &entry)
{
    b2DistanceJointDef def;
    def.bodyA = body_at(entry.a);
    def.bodyB = body_at(entry.b);
    def.localAnchorA = vect(entry.anchor_a);
    def.localAnchorB = vect(entry.anchor_b);
    def.length = entry.rest_length;
    def.stiffness = entry.stiffness;
    def.damping = entry.damping;
    def.collideConnected = entry.collide;
    world->CreateJoint(&def);
}

} // namespace

// Position iterations go with velocity iterations as they do by default, 3 to 8.
bool peer_build(peer_wish wish)
{
    velocity_iterations = wish.iterations > 0 ? wish.iterations : default_velocity_iterations;
    position_iterations = (velocity_iterations * default_position_iterations + default_velocity_iterations - 1) / default_velocity_iterations;
    step = wish.step > 0 ? wish.step : peer_the_scene.step;
    peer_construct();
    world = new (world_memory) b2World(vect(peer_the_scene.gravity));
    world->SetAllowSleeping(false);
    for (int i = 0; i < peer_the_scene.body_count; i++) {
        peer_handles[i] = make_body(peer_the_scene.bodies[i]);
    }
    for (int i = 0; i < peer_the_scene.spring_count; i++) {
        make_spring(peer_the_scene.springs[i]);
    }
    return true;
}

void peer_step(void)
{
    world->Step(step, velocity_iterations, position_iterations);
}

int peer_body_count(void)
{
    return peer_the_scene.body_count;
}

uint32_t peer_spare(void)
{
    return 0;
}

peer_place peer_body_place(int body)
{
    const b2Vec2 position = body_at(body)->GetPosition();
    return {peer_fixed(position.x), peer_fixed(position.y), peer_fixed(body_at(body)->GetAngle())};
}
