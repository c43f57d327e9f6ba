/* Forces and torques, which act during the next step, and impulses, which act at once. */
#include "engine.h"

/* It wakes. */
static cairn_body *find_dynamic(cairn_world *world, cairn_body_id id, cairn_status *status)
{
    cairn_body *body = cairn_body_find_to_change(world, id, status);
    if (body != NULL && !cairn_body_is_dynamic(body)) {
        *status = cairn_fail(world, CAIRN_ERROR_KIND);
        body = NULL;
    }
    if (body != NULL) {
        cairn_body_wake_up(world, body);
    }
    return body;
}

/* r x f */
static cairn_real cross(cairn_vec2 r, cairn_vec2 f) { return cairn_real_sub(cairn_real_mul(r.x, f.y), cairn_real_mul(r.y, f.x)); }

/* Add a force's (or impulse's) velocity change: `per_mass` is h^2 (or h). */
static void add_linear(cairn_body *body, cairn_motion *x, cairn_motion *y, cairn_vec2 amount, cairn_wide per_mass)
{
    if (!cairn_body_is_fixed(body)) {
        cairn_wide k = cairn_wide_div(per_mass, cairn_body_mass_of(body));
        *x = cairn_motion_add(*x, cairn_motion_from_real(amount.x, k));
        *y = cairn_motion_add(*y, cairn_motion_from_real(amount.y, k));
    }
}

/* The same for a torque: rho T / I = T / (m rho). */
static void add_angular(cairn_body *body, cairn_motion *w, cairn_real amount, cairn_wide per_mass)
{
    cairn_wide k = cairn_wide_mul(cairn_wide_div(per_mass, cairn_body_mass_of(body)), cairn_body_inverse_gyration(body));
    *w = cairn_motion_add(*w, cairn_motion_from_real(amount, k));
}

cairn_status cairn_body_apply_force(cairn_world *world, cairn_body_id id, cairn_vec2 force)
{
    cairn_status status;
    cairn_body *body = find_dynamic(world, id, &status);
    if (body != NULL) {
        add_linear(body, &body->ux, &body->uy, force, cairn_wide_mul(cairn_world_substep(world), cairn_world_substep(world)));
    }
    return status;
}

cairn_status cairn_body_apply_torque(cairn_world *world, cairn_body_id id, cairn_real torque)
{
    cairn_status status;
    cairn_body *body = find_dynamic(world, id, &status);
    if (body != NULL) {
        add_angular(body, &body->uw, torque, cairn_wide_mul(cairn_world_substep(world), cairn_world_substep(world)));
    }
    return status;
}

cairn_status cairn_body_apply_force_at(cairn_world *world, cairn_body_id id, cairn_vec2 force, cairn_vec2 point)
{
    cairn_status status = cairn_body_apply_force(world, id, force);
    return status != CAIRN_OK ? status : cairn_body_apply_torque(world, id, cross(cairn_body_arm(cairn_body_find(world, id), point), force));
}

cairn_status cairn_body_apply_impulse(cairn_world *world, cairn_body_id id, cairn_vec2 impulse)
{
    cairn_status status;
    cairn_body *body = find_dynamic(world, id, &status);
    if (body != NULL) {
        add_linear(body, &body->vx, &body->vy, impulse, cairn_world_substep(world));
        world->driven = true;
        cairn_body_limit_speed(world, body);
    }
    return status;
}

cairn_status cairn_body_apply_angular_impulse(cairn_world *world, cairn_body_id id, cairn_real impulse)
{
    cairn_status status;
    cairn_body *body = find_dynamic(world, id, &status);
    if (body != NULL) {
        add_angular(body, &body->w, impulse, cairn_world_substep(world));
        cairn_body_limit_speed(world, body);
    }
    return status;
}

cairn_status cairn_body_apply_impulse_at(cairn_world *world, cairn_body_id id, cairn_vec2 impulse, cairn_vec2 point)
{
    cairn_status status = cairn_body_apply_impulse(world, id, impulse);
    return status != CAIRN_OK ? status : cairn_body_apply_angular_impulse(world, id, cross(cairn_body_arm(cairn_body_find(world, id), point), impulse));
}
