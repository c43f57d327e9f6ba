/* What the game may ask of a body: where it is, how it moves, what it is. */
#include "engine.h"

cairn_vec2 cairn_body_point(const cairn_body *body, cairn_offset x, cairn_offset y)
{
    cairn_real px = body->x, py = body->y;
    cairn_residue rx = body->x_residue, ry = body->y_residue;
    cairn_coordinate_shift(&px, &rx, x);
    cairn_coordinate_shift(&py, &ry, y);
    return cairn_vec2_of(cairn_coordinate_round(px, rx), cairn_coordinate_round(py, ry));
}

static cairn_vec2 center_of(const cairn_body *body)
{
    return cairn_vec2_of(cairn_coordinate_round(body->x, body->x_residue), cairn_coordinate_round(body->y, body->y_residue));
}

static cairn_vec2 origin_of(const cairn_body *body)
{
    cairn_offset cx, cy;
    if (!CAIRN_WITH_POLYGONS) {
        return center_of(body);
    }
    cairn_body_centroid(body, &cx, &cy);
    return cairn_body_point(body, -cx, -cy);
}

cairn_vec2 cairn_body_position(cairn_world *world, cairn_body_id id)
{
    const cairn_body *body = cairn_body_find(world, id);
    return body == NULL ? cairn_vec2_of(0, 0) : origin_of(body);
}

cairn_vec2 cairn_body_center(cairn_world *world, cairn_body_id id)
{
    const cairn_body *body = cairn_body_find(world, id);
    return body == NULL ? cairn_vec2_of(0, 0) : center_of(body);
}

cairn_angle cairn_body_angle(cairn_world *world, cairn_body_id id)
{
    const cairn_body *body = cairn_body_find(world, id);
    return body == NULL ? 0 : body->angle;
}

static cairn_vec2 velocity_of(const cairn_world *world, const cairn_body *body)
{
    return cairn_vec2_of(cairn_real_from_motion(body->vx, cairn_world_inverse_substep(world)), cairn_real_from_motion(body->vy, cairn_world_inverse_substep(world)));
}

static cairn_real spin_of(const cairn_world *world, const cairn_body *body)
{
    return cairn_real_from_motion(body->w, cairn_wide_mul(cairn_body_inverse_gyration(body), cairn_world_inverse_substep(world)));
}

cairn_vec2 cairn_body_velocity(cairn_world *world, cairn_body_id id)
{
    const cairn_body *body = cairn_body_find(world, id);
    return body == NULL ? cairn_vec2_of(0, 0) : velocity_of(world, body);
}

cairn_real cairn_body_angular_velocity(cairn_world *world, cairn_body_id id)
{
    const cairn_body *body = cairn_body_find(world, id);
    return body == NULL ? 0 : spin_of(world, body);
}

cairn_vec2 cairn_body_arm(const cairn_body *body, cairn_vec2 point)
{
    cairn_vec2 center = center_of(body);
    return cairn_vec2_of(cairn_real_sub(point.x, center.x), cairn_real_sub(point.y, center.y));
}

/* v + cross(w, r) */
cairn_vec2 cairn_body_velocity_at(cairn_world *world, cairn_body_id id, cairn_vec2 point)
{
    const cairn_body *body = cairn_body_find(world, id);
    if (body == NULL) {
        return cairn_vec2_of(0, 0);
    }
    cairn_vec2 v = velocity_of(world, body), r = cairn_body_arm(body, point);
    cairn_real spin = spin_of(world, body);
    return cairn_vec2_of(cairn_real_sub(v.x, cairn_real_mul(spin, r.y)), cairn_real_add(v.y, cairn_real_mul(spin, r.x)));
}

cairn_vec2 cairn_body_to_world(cairn_world *world, cairn_body_id id, cairn_vec2 local)
{
    const cairn_body *body = cairn_body_find(world, id);
    if (body == NULL) {
        return cairn_vec2_of(0, 0);
    }
    cairn_vec2 origin = origin_of(body);
    cairn_unit c, s;
    cairn_angle_rotation(body->angle, &c, &s);
    return cairn_vec2_of(cairn_real_add(origin.x, cairn_real_turn(local.x, -local.y, c, s)),
                         cairn_real_add(origin.y, cairn_real_turn(local.x, local.y, s, c)));
}

cairn_vec2 cairn_body_to_local(cairn_world *world, cairn_body_id id, cairn_vec2 point)
{
    const cairn_body *body = cairn_body_find(world, id);
    if (body == NULL) {
        return cairn_vec2_of(0, 0);
    }
    cairn_vec2 origin = origin_of(body);
    cairn_real x = cairn_real_sub(point.x, origin.x), y = cairn_real_sub(point.y, origin.y);
    cairn_unit c, s;
    cairn_angle_rotation(body->angle, &c, &s);
    return cairn_vec2_of(cairn_real_turn(x, y, c, s), cairn_real_turn(x, y, -s, c));
}

cairn_wide cairn_body_mass(cairn_world *world, cairn_body_id id)
{
    const cairn_body *body = cairn_body_find(world, id);
    return body == NULL ? cairn_wide_zero() : cairn_body_mass_of(body);
}

/* m rho^2 */
cairn_wide cairn_body_inertia(cairn_world *world, cairn_body_id id)
{
    const cairn_body *body = cairn_body_find(world, id);
    if (body == NULL) {
        return cairn_wide_zero();
    }
    cairn_wide inverse = cairn_body_inverse_gyration(body);
    return cairn_wide_div(cairn_body_mass_of(body), cairn_wide_mul(inverse, inverse));
}

const cairn_body_model *cairn_body_get_model(cairn_world *world, cairn_body_id id)
{
    const cairn_body *body = cairn_body_find(world, id);
    return body == NULL ? NULL : body->model;
}

const cairn_shape *cairn_body_shape(cairn_world *world, cairn_body_id id)
{
    const cairn_body *body = cairn_body_find(world, id);
    return body == NULL ? NULL : body->model->shape;
}

cairn_body_type cairn_body_get_type(cairn_world *world, cairn_body_id id)
{
    const cairn_body *body = cairn_body_find(world, id);
    return body == NULL ? CAIRN_DYNAMIC : cairn_body_type_of(body);
}

const void *cairn_body_user(cairn_world *world, cairn_body_id id)
{
    const cairn_body *body = cairn_body_find(world, id);
    return body == NULL ? NULL : body->model->user;
}

bool cairn_body_is_awake(cairn_world *world, cairn_body_id id)
{
    const cairn_body *body = cairn_body_find(world, id);
    return body != NULL && cairn_body_is_active(body);
}

bool cairn_body_is_sensor(cairn_world *world, cairn_body_id id)
{
    const cairn_body *body = cairn_body_find(world, id);
    return body != NULL && body->model->sensor;
}
