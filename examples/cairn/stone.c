/* See stone.h. */
#include "stone.h"

#include "random.h"

static const cairn_material rough = CAIRN_MATERIAL(0.95, 0.85);

enum {
    TRIES = 4,
    JITTER = 26, /* percent of the way to the next corner, at most */
    ROUND_CORNERS_MIN = 7,
    PERCENT_OF_TURN = 42949672,
    LEAN_PERCENT = 16,
    SIDE_PERCENT = 55 /* how high or low the corner of a side may lie, in percent of half the height */
};

static cairn_real between(random_source *r, cairn_real low, cairn_real high)
{
    return low + (high - low) / 256 * random_between(r, 0, 256);
}

static cairn_real percent_of(cairn_real x, int32_t percent) { return x / 100 * percent; }

/* Corners on an ellipse at uneven angles: convex whatever the angles. */
static int round_corners(cairn_vec2 *points, random_source *r, cairn_real wide, cairn_real high)
{
    const int count = random_between(r, ROUND_CORNERS_MIN, STONE_CORNERS), start = random_between(r, 0, 99);
    for (int i = 0; i < count; i++) {
        const int percent = (100 * i + start + random_between(r, -JITTER, JITTER)) / count;
        cairn_unit c, s;
        cairn_angle_rotation((cairn_angle)((uint32_t)percent * (uint32_t)PERCENT_OF_TURN), &c, &s);
        points[i] = cairn_vec2_of(cairn_mul32(wide, c, 30), cairn_mul32(high, s, 30));
    }
    return count;
}

/* Two beds, the upper one leaning a little, and a corner at either side: convex, for the sides lie between the beds and reach farther than they do. */
static int bedded_corners(cairn_vec2 *points, random_source *r, const stone_style *style, cairn_real wide, cairn_real high)
{
    static const int8_t beds[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    int count = 0;
    for (int i = 0; i < 4; i++) {
        const cairn_real bed = percent_of(wide, random_between(r, style->bed_min, style->bed_max));
        const cairn_real height = percent_of(high, i < 2 ? 100 : random_between(r, 100 - LEAN_PERCENT, 100));
        points[count++] = cairn_vec2_of(beds[i][0] * bed, beds[i][1] * height);
        if ((i & 1) != 0) {
            const cairn_real side = percent_of(high, random_between(r, -SIDE_PERCENT, SIDE_PERCENT));
            points[count++] = cairn_vec2_of(beds[i][0] * wide, side);
        }
    }
    return count;
}

void stone_shape(stone *s, uint32_t seed, const stone_style *style)
{
    random_source r = random_from(seed);
    cairn_vec2 points[STONE_CORNERS];
    cairn_status status = CAIRN_ERROR_SHAPE;
    for (int try = 0; try < TRIES && status != CAIRN_OK; try++) {
        const cairn_real wide = between(&r, style->wide_min, style->wide_max), high = between(&r, style->high_min, style->high_max);
        const int count = style->bed_max > 0 ? bedded_corners(points, &r, style, wide, high) : round_corners(points, &r, wide, high);
        status = cairn_polygon_init(&s->polygon, points, count);
    }
    if (status != CAIRN_OK)
        (void)cairn_polygon_init_regular(&s->polygon, ROUND_CORNERS_MIN, style->high_max);
    s->seed = seed;
    s->state = STONE_NONE;
    s->model = cairn_body_model_default(&s->polygon.shape);
    s->model.material = &rough;
    s->model.layer = STONE_LAYER;
    s->model.angular_damping = CAIRN_F(1);
}

bool stone_place(stone *s, cairn_world *world, cairn_vec2 position, cairn_angle angle, stone_state state)
{
    s->body = cairn_body_create(world, &s->model, position, angle);
    if (cairn_body_id_is_null(s->body))
        return false;
    s->state = state;
    s->top = position.y;
    return true;
}

void stone_remove(stone *s, cairn_world *world)
{
    (void)cairn_body_destroy(world, s->body);
    s->body = cairn_body_id_null();
    s->state = STONE_NONE;
}

int stone_corners(const stone *s, cairn_world *world, cairn_vec2 *corners)
{
    const cairn_vec2 center = cairn_body_center(world, s->body);
    cairn_unit c, si;
    cairn_angle_rotation(cairn_body_angle(world, s->body), &c, &si);
    for (int i = 0; i < s->polygon.count; i++) {
        const cairn_real x = cairn_real_from_offset(s->polygon.vertex[i].x), y = cairn_real_from_offset(s->polygon.vertex[i].y);
        corners[i].x = center.x + cairn_dot32(x, c, -y, si, 30);
        corners[i].y = center.y + cairn_dot32(x, si, y, c, 30);
    }
    return s->polygon.count;
}

void stone_measure(stone *s, cairn_world *world)
{
    cairn_vec2 corners[STONE_CORNERS];
    if (!cairn_body_is_awake(world, s->body))
        return;
    const int count = stone_corners(s, world, corners);
    s->top = corners[0].y;
    for (int i = 1; i < count; i++)
        if (corners[i].y > s->top)
            s->top = corners[i].y;
}

cairn_real stone_speed(const stone *s, cairn_world *world)
{
    const cairn_vec2 v = cairn_body_velocity(world, s->body);
    const cairn_real x = v.x < 0 ? -v.x : v.x, y = v.y < 0 ? -v.y : v.y;
    return x > y ? x : y;
}

bool stone_touches(const stone *s, cairn_world *world)
{
    int cursor = 0;
    cairn_body_id other;
    return cairn_body_next_touched(world, s->body, &cursor, &other);
}

cairn_angle stone_flat_angle(const stone *s)
{
    cairn_angle angle = 0;
    int64_t longest = 0;
    for (int i = 0; i < s->polygon.count; i++) {
        const cairn_offset2 a = s->polygon.vertex[i], b = s->polygon.vertex[i + 1 < s->polygon.count ? i + 1 : 0];
        const int64_t x = (b.x - a.x) >> 6, y = (b.y - a.y) >> 6;
        if (x * x + y * y <= longest)
            continue;
        longest = x * x + y * y;
        /* The edge runs to the right when it lies below. */
        angle = (cairn_angle)(0u - (uint32_t)cairn_angle_of((cairn_real)y, (cairn_real)x));
    }
    return angle;
}
