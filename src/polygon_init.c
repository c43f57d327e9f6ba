/*
 * Making convex polygons, at set-up: corners are checked, put counter-clockwise and measured. Given points are exact
 * as offsets (Q10.22), products of two as areas (Q20.44); what follows from them is a sum of positive wide numbers,
 * so that nothing cancels and small shapes are measured as well as large ones.
 */
#include "engine.h"

/* A corner that stands out less from the line between its neighbours lies on it but for rounding: two steps of a cairn_real. */
#define FLAT CAIRN_OFFSET(0.00003)
/* The least width: 1 mm, less what rounding may take. */
#define THIN CAIRN_OFFSET(0.00099)

typedef struct corner_list {
    int count;
    cairn_offset2 at[2 * CAIRN_MAX_VERTICES];
} corner_list;

static const cairn_offset2 *after(const corner_list *corners, int i) { return &corners->at[i + 1 < corners->count ? i + 1 : 0]; }
static const cairn_offset2 *before(const corner_list *corners, int i) { return &corners->at[i > 0 ? i - 1 : corners->count - 1]; }

/* Twice the area of the triangle a, b, c; positive if it turns to the left. */
CAIRN_ONCE cairn_area turn(const cairn_offset2 *a, const cairn_offset2 *b, const cairn_offset2 *c)
{
    return cairn_offset_cross(b->x - a->x, b->y - a->y, c->x - b->x, c->y - b->y);
}

/* x^2 + y^2 */
CAIRN_ONCE cairn_wide_word square_word(cairn_offset x, cairn_offset y)
{
    cairn_wide wide_x = cairn_wide_from_offset(x), wide_y = cairn_wide_from_offset(y);
    return cairn_wide_to_word(cairn_wide_add(cairn_wide_mul(wide_x, wide_x), cairn_wide_mul(wide_y, wide_y)));
}
CAIRN_ALWAYS_INLINE cairn_wide square_of(cairn_offset x, cairn_offset y) { return cairn_wide_from_word(square_word(x, y)); }

/* Does a triangle with twice this area rise less above its side from a to b? */
CAIRN_ONCE bool is_lower(cairn_area area, const cairn_offset2 *a, const cairn_offset2 *b, cairn_offset height)
{
    cairn_wide side = cairn_wide_sqrt(square_of(b->x - a->x, b->y - a->y));
    return cairn_wide_less(cairn_wide_from_area(area), cairn_wide_mul(side, cairn_wide_from_offset(height)));
}

/* ---- corners ---- */

static cairn_status load(corner_list *corners, const cairn_vec2 *points, int count)
{
    corners->count = count;
    for (int i = 0; i < count; i++) {
        if (cairn_real_length(points[i].x, points[i].y) > CAIRN_SHAPE_RADIUS_MAX) {
            return CAIRN_ERROR_SHAPE;
        }
        corners->at[i].x = cairn_offset_from_real(points[i].x);
        corners->at[i].y = cairn_offset_from_real(points[i].y);
    }
    return CAIRN_OK;
}

/* Against the direction; the first corner stays first. */
static void reverse(corner_list *corners)
{
    for (int low = 1, high = corners->count - 1; low < high; low++, high--) {
        cairn_offset2 swap = corners->at[low];
        corners->at[low] = corners->at[high];
        corners->at[high] = swap;
    }
}

/* Does the way turn by more than a right angle at b? */
static bool is_acute(const cairn_offset2 *a, const cairn_offset2 *b, const cairn_offset2 *c)
{
    return cairn_offset_cross(b->x - a->x, b->y - a->y, b->y - c->y, c->x - b->x) < 0;
}

/* Does the way turn right at this corner, or hardly to the left? The tip of a wedge is no flat corner. */
static bool is_flat_at(const corner_list *corners, int i)
{
    const cairn_offset2 *a = before(corners, i), *b = &corners->at[i], *c = after(corners, i);
    cairn_area left = turn(a, b, c);
    if (left <= 0 || is_acute(a, b, c)) {
        return left <= 0;
    }
    return is_lower(left, a, c, FLAT);
}

static bool points_down(const cairn_offset2 *a, const cairn_offset2 *b) { return b->y < a->y || (b->y == a->y && b->x < a->x); }

/* Left turns only, and one time round: a way that winds more often crosses itself. */
static bool is_convex(const corner_list *corners)
{
    int winding = 0;
    for (int i = 0; i < corners->count; i++) {
        if (is_flat_at(corners, i)) {
            return false;
        }
        if (points_down(before(corners, i), &corners->at[i]) && !points_down(&corners->at[i], after(corners, i))) {
            winding++;
        }
    }
    return winding == 1;
}

/* The least width of a convex outline lies across one of its edges. */
static bool is_thin(const corner_list *corners)
{
    for (int i = 0; i < corners->count; i++) {
        cairn_area most = 0;
        for (int j = 0; j < corners->count; j++) {
            cairn_area span = turn(&corners->at[i], after(corners, i), &corners->at[j]);
            most = span > most ? span : most;
        }
        if (is_lower(most, &corners->at[i], after(corners, i), THIN)) {
            return true;
        }
    }
    return false;
}

/* Counter-clockwise, or refused. */
static cairn_status put_in_order(corner_list *corners)
{
    if (turn(&corners->at[0], &corners->at[1], &corners->at[2]) < 0) {
        reverse(corners);
    }
    return is_convex(corners) && !is_thin(corners) ? CAIRN_OK : CAIRN_ERROR_SHAPE;
}

/* ---- the centroid: of the fan of triangles from the first corner ---- */

typedef enum axis { AXIS_X, AXIS_Y } axis;

static cairn_offset on(axis k, const cairn_offset2 *p) { return k == AXIS_X ? p->x : p->y; }

/* x + y + z, none of them negative */
static cairn_wide sum_of(cairn_offset x, cairn_offset y, cairn_offset z)
{
    return cairn_wide_add(cairn_wide_from_sum(x, y), cairn_wide_from_offset(z));
}

/* The mean of the triangles' centroids, weighted by area, from the lowest corner on: (sum of A_i (a_i + b_i + c_i)) / 3 A. */
CAIRN_ONCE cairn_offset mean_on(axis k, const corner_list *corners)
{
    cairn_wide sum = cairn_wide_zero();
    cairn_area whole = 0;
    cairn_offset low = on(k, corners->at);
    for (int i = 1; i < corners->count; i++) {
        low = on(k, &corners->at[i]) < low ? on(k, &corners->at[i]) : low;
    }
    for (int i = 1; i + 1 < corners->count; i++) {
        const cairn_offset2 *a = corners->at, *b = &corners->at[i], *c = b + 1;
        cairn_area part = turn(a, b, c);
        whole += part;
        sum = cairn_wide_add(sum, cairn_wide_mul(cairn_wide_from_area(part), sum_of(on(k, a) - low, on(k, b) - low, on(k, c) - low)));
    }
    return low + cairn_wide_to_offset(cairn_wide_div(sum, cairn_wide_mul(cairn_wide_from_int(3), cairn_wide_from_area(whole))));
}

static cairn_offset2 centroid_of(const corner_list *corners)
{
    cairn_offset2 centroid;
    centroid.x = mean_on(AXIS_X, corners);
    centroid.y = mean_on(AXIS_Y, corners);
    return centroid;
}

/* ---- the polygon ---- */

static cairn_offset farthest_from(const corner_list *corners, cairn_offset2 centroid)
{
    cairn_offset most = 0;
    cairn_unit x, y;
    for (int i = 0; i < corners->count; i++) {
        cairn_offset length = cairn_unit_along(corners->at[i].x - centroid.x, corners->at[i].y - centroid.y, &x, &y);
        most = length > most ? length : most;
    }
    return most;
}

static void fill_outline(cairn_polygon *polygon, const corner_list *corners, cairn_offset2 centroid)
{
    polygon->count = (uint8_t)corners->count;
    polygon->centroid.x = centroid.x;
    polygon->centroid.y = centroid.y;
    cairn_offset inradius = CAIRN_OFFSET_MAX;
    for (int i = 0; i < corners->count; i++) {
        const cairn_offset2 *here = &corners->at[i], *next = after(corners, i);
        cairn_offset2 *vertex = &polygon->vertex[i];
        cairn_unit2 *normal = &polygon->normal[i];
        vertex->x = here->x - centroid.x;
        vertex->y = here->y - centroid.y;
        cairn_unit_along(next->y - here->y, here->x - next->x, &normal->x, &normal->y);
        cairn_offset distance = cairn_offset_dot(vertex->x, vertex->y, normal->x, normal->y);
        inradius = distance < inradius ? distance : inradius;
    }
    polygon->inradius = inradius;
}

/*
 * Area and radius of gyration, by the triangles from the centroid to each side: one with corners 0, a, b turns with A (a^2 + a b + b^2) / 6, and
 * a^2 + a b + b^2 is (a^2 + b^2 + (a + b)^2) / 2, a sum of positive numbers.
 */
static void measure(cairn_polygon *polygon)
{
    cairn_wide moment = cairn_wide_zero(), whole;
    cairn_area area = 0;
    const cairn_offset2 *a = &polygon->vertex[polygon->count - 1];
    for (const cairn_offset2 *b = polygon->vertex; b != polygon->vertex + polygon->count; a = b++) {
        cairn_area part = cairn_offset_cross(a->x, a->y, b->x, b->y);
        cairn_wide squares = cairn_wide_add(cairn_wide_add(square_of(a->x, a->y), square_of(b->x, b->y)), square_of(a->x + b->x, a->y + b->y));
        area += part;
        moment = cairn_wide_add(moment, cairn_wide_mul(cairn_wide_from_area(part), squares));
    }
    whole = cairn_wide_from_area(area);
    polygon->mass.area = cairn_wide_div(whole, cairn_wide_from_int(2));
    polygon->mass.gyration = cairn_wide_sqrt(cairn_wide_div(moment, cairn_wide_mul(cairn_wide_from_int(12), whole)));
}

/* From corners in order. */
static cairn_status fill(cairn_polygon *polygon, const corner_list *corners, cairn_offset2 centroid)
{
    cairn_offset radius = farthest_from(corners, centroid);
    if (radius > cairn_offset_from_real(CAIRN_SHAPE_RADIUS_MAX)) {
        return CAIRN_ERROR_SHAPE;
    }
    cairn_clear(polygon, sizeof *polygon);
    polygon->shape.kind = &cairn_polygon_class;
    polygon->shape.size = cairn_vec2_of(cairn_real_above_offset(radius), 0);
    polygon->shape.polygon = polygon;
    fill_outline(polygon, corners, centroid);
    measure(polygon);
    return CAIRN_OK;
}

cairn_status cairn_polygon_init(cairn_polygon *polygon, const cairn_vec2 *points, int count)
{
    corner_list corners;
    if (polygon == NULL || points == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (count < 3 || count > CAIRN_MAX_VERTICES) {
        return CAIRN_ERROR_RANGE;
    }
    if (load(&corners, points, count) != CAIRN_OK || put_in_order(&corners) != CAIRN_OK) {
        return CAIRN_ERROR_SHAPE;
    }
    return fill(polygon, &corners, centroid_of(&corners));
}

cairn_status cairn_polygon_init_regular(cairn_polygon *polygon, int sides, cairn_real radius)
{
    corner_list corners;
    cairn_offset2 centroid = { 0, 0 };
    if (polygon == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (sides < 3 || sides > CAIRN_MAX_VERTICES) {
        return CAIRN_ERROR_RANGE;
    }
    if (radius < CAIRN_SHAPE_RADIUS_MIN || radius > CAIRN_SHAPE_RADIUS_MAX) {
        return CAIRN_ERROR_SHAPE;
    }
    corners.count = sides;
    for (int i = 0; i < sides; i++) {
        cairn_unit cosine, sine;
        cairn_angle_rotation(cairn_angle_of_turn(i, sides), &cosine, &sine);
        corners.at[i].x = cairn_offset_mul(cairn_offset_from_real(radius), cosine);
        corners.at[i].y = cairn_offset_mul(cairn_offset_from_real(radius), sine);
    }
    return fill(polygon, &corners, centroid); /* in order, convex and thick enough by construction */
}

/* ---- the hull of any points ---- */

static bool is_left_of(const cairn_offset2 *a, const cairn_offset2 *b) { return a->x < b->x || (a->x == b->x && a->y < b->y); }

static cairn_offset size_of(cairn_offset x) { return x < 0 ? -x : x; }

/* How far two points are apart, as far as points of one line are compared by it. */
static cairn_offset apart(const cairn_offset2 *a, const cairn_offset2 *b) { return size_of(b->x - a->x) + size_of(b->y - a->y); }

/* From a corner of the hull, the one that all others lie to the left of; the farthest if several are in line. */
static const cairn_offset2 *next_corner(const corner_list *points, const cairn_offset2 *corner)
{
    const cairn_offset2 *next = points->at;
    for (const cairn_offset2 *p = points->at + 1; p != points->at + points->count; p++) {
        cairn_area left = turn(corner, next, p);
        if (left < 0 || (left == 0 && apart(corner, p) > apart(corner, next))) {
            next = p;
        }
    }
    return next;
}

/* Gift wrapping (Jarvis): round from the leftmost point, until it is reached again. */
static void wrap(const corner_list *points, corner_list *hull)
{
    const cairn_offset2 *corner = points->at;
    for (const cairn_offset2 *p = points->at + 1; p != points->at + points->count; p++) {
        corner = is_left_of(p, corner) ? p : corner;
    }
    hull->count = 0;
    do {
        hull->at[hull->count++] = *corner;
        corner = next_corner(points, corner);
    } while (hull->count < points->count && apart(corner, hull->at) != 0);
}

/* Leave out corners that lie on the line between their neighbours but for rounding. */
static void drop_flat(corner_list *hull)
{
    int i = 0;
    while (i < hull->count && hull->count >= 3) {
        if (!is_flat_at(hull, i)) {
            i++;
            continue;
        }
        hull->count--;
        for (int j = i; j < hull->count; j++) {
            hull->at[j].x = hull->at[j + 1].x; /* one by one, or gcc makes a memmove of it */
            hull->at[j].y = hull->at[j + 1].y;
        }
        i = 0; /* its neighbours have new neighbours */
    }
}

cairn_status cairn_polygon_init_hull(cairn_polygon *polygon, const cairn_vec2 *points, int count)
{
    corner_list given, hull;
    if (polygon == NULL || points == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (count < 3 || count > 2 * CAIRN_MAX_VERTICES) {
        return CAIRN_ERROR_RANGE;
    }
    if (load(&given, points, count) != CAIRN_OK) {
        return CAIRN_ERROR_SHAPE;
    }
    wrap(&given, &hull);
    drop_flat(&hull);
    if (hull.count < 3 || hull.count > CAIRN_MAX_VERTICES || put_in_order(&hull) != CAIRN_OK) {
        return CAIRN_ERROR_SHAPE;
    }
    return fill(polygon, &hull, centroid_of(&hull));
}
