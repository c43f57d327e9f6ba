/* See crane.h. */
#include "crane.h"

#define SPEED CAIRN_F(2.4)        /* m/s */
#define SPEED_STEP CAIRN_F(0.16)  /* m/s a step: 10 m/s^2 */
#define RISE_MAX CAIRN_F(4)
#define TURNING CAIRN_F(2.2)      /* rad/s */
#define HANG_DAMPING CAIRN_F(0.9) /* 1/s: swings fade in a second or two */
#define ROPE_FREQUENCY CAIRN_F(7)
#define ROPE_DAMPING CAIRN_F(0.6)

static const cairn_shape trolley_shape = CAIRN_BOX(CAIRN_F(0.3), CAIRN_F(0.12));
static const cairn_body_model trolley_model = { &trolley_shape, &cairn_material_default, CAIRN_KINEMATIC, CAIRN_DENSITY(1), CAIRN_F(1), 0, 0,
                                                8, 0, false, false, false, NULL };

bool crane_start(crane *c, cairn_world *world, cairn_vec2 position)
{
    c->trolley = cairn_body_create(world, &trolley_model, position, 0);
    c->rope = cairn_spring_id_null();
    c->load = NULL;
    return !cairn_body_id_is_null(c->trolley);
}

bool crane_hang(crane *c, cairn_world *world, stone *s, cairn_angle angle)
{
    cairn_vec2 position = cairn_body_position(world, c->trolley);
    position.y -= CRANE_ROPE;
    if (!stone_place(s, world, position, angle, STONE_HANGING))
        return false;
    c->hung = s->model;
    c->hung.damping = HANG_DAMPING;
    (void)cairn_body_set_model(world, s->body, &c->hung);
    cairn_spring_def def = cairn_spring_def_default(c->trolley, s->body);
    def.rest_length = CRANE_ROPE;
    (void)cairn_spring_tune(world, &def, ROPE_FREQUENCY, ROPE_DAMPING);
    c->rope = cairn_spring_create(world, &def);
    if (cairn_spring_id_is_null(c->rope)) {
        stone_remove(s, world);
        return false;
    }
    c->load = s;
    return true;
}

static cairn_real towards(cairn_real now, cairn_real wish, cairn_real step)
{
    return now < wish - step ? now + step : now > wish + step ? now - step : wish;
}

static cairn_vec2 trolley_velocity(const crane *c, cairn_world *world, int move, cairn_real height)
{
    const cairn_vec2 at = cairn_body_position(world, c->trolley);
    cairn_vec2 v = cairn_body_velocity(world, c->trolley);
    v.x = towards(v.x, move * SPEED, SPEED_STEP);
    if ((at.x > CRANE_REACH && v.x > 0) || (at.x < -CRANE_REACH && v.x < 0))
        v.x = 0;
    const cairn_real way = 2 * cairn_real_sub(height, at.y);
    v.y = towards(v.y, way > RISE_MAX ? RISE_MAX : way < -RISE_MAX ? -RISE_MAX : way, SPEED_STEP);
    return v;
}

void crane_step(crane *c, cairn_world *world, crane_wish wish, cairn_real height, cairn_real wind)
{
    (void)cairn_body_set_velocity(world, c->trolley, trolley_velocity(c, world, wish.move, height));
    if (c->load == NULL)
        return;
    const cairn_body_id body = c->load->body;
    (void)cairn_body_set_angular_velocity(world, body, wish.turn * TURNING);
    if (wind != 0) {
        const cairn_real mass = cairn_wide_to_real(cairn_body_mass(world, body));
        (void)cairn_body_apply_force(world, body, cairn_vec2_of(cairn_real_mul(mass, wind), 0));
    }
}

stone *crane_drop(crane *c, cairn_world *world)
{
    stone *s = c->load;
    if (s == NULL)
        return NULL;
    (void)cairn_spring_destroy(world, c->rope);
    (void)cairn_body_set_model(world, s->body, &s->model);
    c->rope = cairn_spring_id_null();
    c->load = NULL;
    s->state = STONE_FALLING;
    return s;
}
