/*
 * Questions to the world between two steps. Bodies are tried in the order of the pool: first by the upright box about
 * the shape, then by the shape itself, in offsets (Q10.22) relative to its centre of mass. What lies on a surface counts
 * as inside.
 */
#include "engine.h"
#include <cairn/query.h>

#define RAY_LENGTH_MAX CAIRN_F(250)

/* Up to here, m, distances of a body's corners to what is asked fit into an offset; beyond it, all are quartered. */
#define NEAR CAIRN_F(250)

typedef struct region {
    cairn_vec2 lower, upper;
} region;

static cairn_real smaller(cairn_real a, cairn_real b) { return a < b ? a : b; }
static cairn_real larger(cairn_real a, cairn_real b) { return a > b ? a : b; }

static region region_of(cairn_vec2 a, cairn_vec2 b)
{
    region r;
    r.lower = cairn_vec2_of(smaller(a.x, b.x), smaller(a.y, b.y));
    r.upper = cairn_vec2_of(larger(a.x, b.x), larger(a.y, b.y));
    return r;
}

/* The upright box about a body where it is now, symmetric about its centre of mass; a step of a cairn_real wider for the residues. */
static region region_about(const cairn_body *body)
{
    region r;
    cairn_real x, y, step = cairn_real_above_offset(0);
    cairn_unit c, s;
    cairn_body_facing(body, &c, &s);
    cairn_shape_extents(body->model->shape, c, s, &x, &y);
    r.lower = cairn_vec2_of(body->x - x, body->y - y);
    r.upper = cairn_vec2_of(body->x + x + step, body->y + y + step);
    return r;
}

static bool regions_meet(const region *a, const region *b)
{
    return a->lower.x <= b->upper.x && b->lower.x <= a->upper.x && a->lower.y <= b->upper.y && b->lower.y <= a->upper.y;
}

/* A body's shape about the origin; all offsets in quarters where the full numbers might not fit. */
typedef struct target {
    const cairn_body *body;
    bool quartered;
    cairn_offset radius;   /* of a circle; a polygon has an outline instead, in its own frame: */
    cairn_outline outline;
    cairn_room room;
    cairn_unit c, s;
} target;

static cairn_offset scaled(const target *s, cairn_offset x)
{
    return s->quartered ? cairn_offset_half(cairn_offset_half(x)) : x;
}

static bool is_circle(const target *s) { return cairn_shape_is_round(s->body->model->shape); }

/* span: the sum of the sizes of the body's box and of what is asked. */
static void set_target(target *s, const cairn_body *body, cairn_real span)
{
    s->body = body;
    s->quartered = span > NEAR;
    if (is_circle(s)) {
        s->radius = scaled(s, cairn_offset_from_real(body->model->shape->size.x));
        return;
    }
    cairn_body_facing(body, &s->c, &s->s);
    cairn_shape_outline(body->model->shape, s->room.corner, &s->outline);
}

static cairn_offset2 relative(const target *s, cairn_vec2 point)
{
    cairn_offset2 r;
    r.x = scaled(s, cairn_coordinate_offset(s->body->x, s->body->x_residue, point.x, cairn_residue_zero()));
    r.y = scaled(s, cairn_coordinate_offset(s->body->y, s->body->y_residue, point.y, cairn_residue_zero()));
    return r;
}

/* An edge of the polygon: the corner from which it goes, and its normal. */
typedef struct edge {
    cairn_offset2 corner;
    cairn_unit2 normal;
} edge;

static void set_edge(edge *e, const target *s, int i)
{
    e->corner = cairn_offset2_turned(s->outline.vertex[i], s->c, s->s);
    e->corner.x = scaled(s, e->corner.x);
    e->corner.y = scaled(s, e->corner.y);
    e->normal = cairn_unit2_turned(s->outline.normal[i], s->c, s->s);
}

/* How far a point lies outside of an edge. */
static cairn_offset outside_of(const edge *e, cairn_offset x, cairn_offset y)
{
    return cairn_offset_dot(x - e->corner.x, y - e->corner.y, e->normal.x, e->normal.y);
}

/* ---- rays ---- */

/* Where a ray enters a shape. */
typedef struct entry {
    cairn_unit fraction;
    cairn_unit normal_x, normal_y; /* zero: it starts inside */
} entry;

/* sqrt(a^2 - b^2), b <= a */
static cairn_offset leg(cairn_offset a, cairn_offset b)
{
    return cairn_wide_to_offset(cairn_wide_sqrt(cairn_wide_mul(cairn_wide_from_offset(a - b), cairn_wide_from_offset(a + b))));
}

static bool enter_circle(cairn_offset radius, const cairn_offset2 *start, const cairn_offset2 *end, entry *in)
{
    cairn_unit ux, uy;
    if (cairn_unit_along(start->x, start->y, &ux, &uy) <= radius) {
        return true;
    }
    cairn_offset length = cairn_unit_along(end->x - start->x, end->y - start->y, &ux, &uy);
    cairn_offset nearest = -cairn_offset_dot(start->x, start->y, ux, uy); /* along the ray, to the point closest to the centre */
    cairn_offset aside = cairn_offset_dot(start->x, -start->y, uy, ux);
    aside = aside < 0 ? -aside : aside;
    if (aside > radius) {
        return false;
    }
    cairn_offset way = nearest - leg(radius, aside);
    if (way < 0 || way > length || length == 0) {
        return false;
    }
    in->fraction = cairn_offset_fraction(way, length);
    cairn_unit_along(start->x + cairn_offset_mul(way, ux), start->y + cairn_offset_mul(way, uy), &in->normal_x, &in->normal_y);
    return true;
}

/* Cyrus and Beck: the last edge that the ray crosses inwards, if it comes before the first that it crosses outwards. */
static bool enter_polygon(const target *s, const cairn_offset2 *start, const cairn_offset2 *end, entry *in)
{
    cairn_unit leave = CAIRN_UNIT(1);
    for (int i = 0; i < s->outline.count; i++) {
        edge e;
        set_edge(&e, s, i);
        cairn_offset from = outside_of(&e, start->x, start->y), to = outside_of(&e, end->x, end->y);
        if (from > 0 && to > 0) {
            return false;
        }
        if (from > 0) {
            cairn_unit fraction = cairn_offset_fraction(from, from - to);
            bool first = in->normal_x == 0 && in->normal_y == 0;
            if (first || fraction > in->fraction) {
                in->fraction = fraction;
                in->normal_x = e.normal.x;
                in->normal_y = e.normal.y;
            }
        } else if (to > 0) {
            cairn_unit fraction = cairn_offset_fraction(-from, to - from);
            leave = fraction < leave ? fraction : leave;
        }
    }
    return in->fraction <= leave;
}

typedef struct ray {
    cairn_vec2 start, end;
    cairn_real length;
    region box;
} ray;

static cairn_status set_ray(ray *r, cairn_world *world, cairn_vec2 start, cairn_vec2 end)
{
    r->start = start;
    r->end = end;
    r->length = cairn_real_length(cairn_real_sub(end.x, start.x), cairn_real_sub(end.y, start.y));
    r->box = region_of(start, end);
    return r->length <= RAY_LENGTH_MAX ? CAIRN_OK : cairn_fail(world, CAIRN_ERROR_RANGE);
}

static cairn_real size_of(const region *r) { return r->upper.x - r->lower.x + (r->upper.y - r->lower.y); }

static bool answers(const cairn_body *body, uint16_t mask) { return (body->flags & CAIRN_BODY_USED) && (body->model->layer & mask); }

static bool enter_body(const ray *r, const cairn_body *body, entry *in)
{
    target s;
    region box = region_about(body);
    if (!regions_meet(&box, &r->box)) {
        return false;
    }
    in->fraction = in->normal_x = in->normal_y = 0;
    set_target(&s, body, cairn_real_add(size_of(&box), r->length));
    cairn_offset2 start = relative(&s, r->start), end = relative(&s, r->end);
    return is_circle(&s) ? enter_circle(s.radius, &start, &end, in) : enter_polygon(&s, &start, &end, in);
}

/* from + (to - from) * fraction */
CAIRN_ONCE cairn_real between(cairn_real from, cairn_real to, cairn_unit fraction)
{
    return from + cairn_real_from_offset(cairn_offset_mul(cairn_offset_from_real(to - from), fraction));
}

static cairn_ray_hit hit_of(const cairn_world *world, const cairn_body *body, const ray *r, const entry *in)
{
    cairn_ray_hit hit;
    hit.body = cairn_body_id_of(world, body);
    hit.point = cairn_vec2_of(between(r->start.x, r->end.x, in->fraction), between(r->start.y, r->end.y, in->fraction));
    hit.normal = cairn_vec2_of(cairn_real_from_unit(in->normal_x), cairn_real_from_unit(in->normal_y));
    hit.fraction = cairn_real_from_unit(in->fraction);
    return hit;
}

cairn_status cairn_query_ray(cairn_world *world, cairn_vec2 start, cairn_vec2 end, uint16_t mask, cairn_ray_hit *hit)
{
    ray r;
    entry in, best;
    const cairn_body *closest = NULL;
    if (world == NULL || hit == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (set_ray(&r, world, start, end) != CAIRN_OK) {
        return CAIRN_ERROR_RANGE;
    }
    best.fraction = best.normal_x = best.normal_y = 0;
    for (uint16_t i = 0; i < world->body_end; i++) {
        const cairn_body *body = &world->bodies[i];
        if (answers(body, mask) && !body->model->sensor && enter_body(&r, body, &in)
            && (closest == NULL || in.fraction < best.fraction)) {
            closest = body;
            best = in;
        }
    }
    if (closest != NULL) {
        *hit = hit_of(world, closest, &r, &best);
    } else {
        cairn_clear(hit, sizeof *hit);
    }
    return CAIRN_OK;
}

cairn_status cairn_query_ray_all(cairn_world *world, cairn_vec2 start, cairn_vec2 end, uint16_t mask, cairn_ray_visitor visit, void *context)
{
    ray r;
    entry in;
    if (world == NULL || visit == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (set_ray(&r, world, start, end) != CAIRN_OK) {
        return CAIRN_ERROR_RANGE;
    }
    uint8_t locked = world->locked; /* a visitor may ask in its turn */
    world->locked = 1;
    for (uint16_t i = 0; i < world->body_end; i++) {
        const cairn_body *body = &world->bodies[i];
        if (answers(body, mask) && enter_body(&r, body, &in)) {
            cairn_ray_hit hit = hit_of(world, body, &r, &in);
            if (!visit(context, &hit)) {
                break;
            }
        }
    }
    world->locked = locked;
    return CAIRN_OK;
}

/* ---- points and boxes ---- */

typedef struct question {
    region box;
    uint16_t mask;
} question;

/* Is the question, which meets the box about the body, met by its shape as well? */
typedef bool (*body_test)(const question *asked, const region *about, const cairn_body *body);

static void visit_where(cairn_world *world, const question *asked, body_test test, cairn_body_visitor visit, void *context)
{
    uint8_t locked = world->locked;
    world->locked = 1;
    for (uint16_t i = 0; i < world->body_end; i++) {
        const cairn_body *body = &world->bodies[i];
        if (!answers(body, asked->mask)) {
            continue;
        }
        region about = region_about(body);
        if (regions_meet(&about, &asked->box) && test(asked, &about, body) && !visit(context, cairn_body_id_of(world, body))) {
            break;
        }
    }
    world->locked = locked;
}

static bool holds_point(const question *asked, const region *about, const cairn_body *body)
{
    target s;
    set_target(&s, body, size_of(about));
    cairn_offset2 p = relative(&s, asked->box.lower);
    if (is_circle(&s)) {
        cairn_unit x, y;
        return cairn_unit_along(p.x, p.y, &x, &y) <= s.radius;
    }
    for (int i = 0; i < s.outline.count; i++) {
        edge e;
        set_edge(&e, &s, i);
        if (outside_of(&e, p.x, p.y) > 0) {
            return false;
        }
    }
    return true;
}

cairn_status cairn_query_point(cairn_world *world, cairn_vec2 point, uint16_t mask, cairn_body_visitor visit, void *context)
{
    question asked;
    if (world == NULL || visit == NULL) {
        return CAIRN_ERROR_NULL;
    }
    asked.box = region_of(point, point);
    asked.mask = mask;
    visit_where(world, &asked, holds_point, visit, context);
    return CAIRN_OK;
}

static cairn_offset into(cairn_offset x, cairn_offset low, cairn_offset high) { return x < low ? low : x > high ? high : x; }

static bool box_meets_circle(const cairn_offset2 *lower, const cairn_offset2 *upper, cairn_offset radius)
{
    cairn_unit x, y;
    return cairn_unit_along(into(0, lower->x, upper->x), into(0, lower->y, upper->y), &x, &y) <= radius;
}

/* The separating-axis test: the box's axes, and the normals of the polygon with the box's corner that lies farthest behind. */
static bool box_meets_polygon(const cairn_offset2 *lower, const cairn_offset2 *upper, const target *s)
{
    bool left = true, right = true, below = true, above = true;
    for (int i = 0; i < s->outline.count; i++) {
        edge e;
        set_edge(&e, s, i);
        if (outside_of(&e, e.normal.x > 0 ? lower->x : upper->x, e.normal.y > 0 ? lower->y : upper->y) > 0) {
            return false;
        }
        left = left && e.corner.x < lower->x;
        right = right && e.corner.x > upper->x;
        below = below && e.corner.y < lower->y;
        above = above && e.corner.y > upper->y;
    }
    return !left && !right && !below && !above;
}

/* What of a box lies outside of the box about the body does not matter: so it may be of any size. */
static bool meets_box(const question *asked, const region *about, const cairn_body *body)
{
    target s;
    set_target(&s, body, size_of(about));
    cairn_vec2 low = cairn_vec2_of(larger(asked->box.lower.x, about->lower.x), larger(asked->box.lower.y, about->lower.y));
    cairn_vec2 high = cairn_vec2_of(smaller(asked->box.upper.x, about->upper.x), smaller(asked->box.upper.y, about->upper.y));
    cairn_offset2 lower = relative(&s, low), upper = relative(&s, high);
    return is_circle(&s) ? box_meets_circle(&lower, &upper, s.radius) : box_meets_polygon(&lower, &upper, &s);
}

cairn_status cairn_query_box(cairn_world *world, cairn_vec2 lower, cairn_vec2 upper, uint16_t mask, cairn_body_visitor visit, void *context)
{
    question asked;
    if (world == NULL || visit == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (lower.x > upper.x || lower.y > upper.y) {
        return cairn_fail(world, CAIRN_ERROR_RANGE);
    }
    asked.box = region_of(lower, upper);
    asked.mask = mask;
    visit_where(world, &asked, meets_box, visit, context);
    return CAIRN_OK;
}
