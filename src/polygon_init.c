/*
 * Making convex polygons, at set-up: corners are checked, put counter-clockwise and measured. Given points are exact
 * as offsets (Q10.22), products of two as areas (Q20.44); what follows from them is a sum of positive wide numbers,
 * so that nothing cancels and small shapes are measured as well as large ones.
 */
#include "engine.h"

/* A corner that stands out less from the line between its neighbours lies on it but for rounding: two steps of a cairn_real. */
#define FLAT cairn_wide_from_offset(CAIRN_OFFSET(0.00003))
/* The least width: 1 mm, less what rounding may take. */
#define THIN cairn_wide_from_offset(CAIRN_OFFSET(0.00099))

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
static cairn_wide squared(cairn_wide x, cairn_wide y) { return cairn_wide_add(cairn_wide_mul(x, x), cairn_wide_mul(y, y)); }

static cairn_wide distance_squared(const cairn_offset2 *a, const cairn_offset2 *b)
{
    return squared(cairn_wide_from_offset(b->x - a->x), cairn_wide_from_offset(b->y - a->y));
}

CAIRN_ONCE cairn_wide distance(const cairn_offset2 *a, const cairn_offset2 *b) { return cairn_wide_sqrt(distance_squared(a, b)); }

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
    return cairn_wide_less(cairn_wide_from_area(left), cairn_wide_mul(distance(a, c), FLAT));
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
        if (cairn_wide_less(cairn_wide_from_area(most), cairn_wide_mul(distance(&corners->at[i], after(corners, i)), THIN))) {
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

/* ---- measures: the fan of triangles from the first corner ---- */

static cairn_area fan_area(const corner_list *corners, int i) { return turn(corners->at, &corners->at[i], &corners->at[i + 1]); }
CAIRN_ONCE cairn_wide fan_weight(const corner_list *corners, int i) { return cairn_wide_from_area(fan_area(corners, i)); }

static cairn_wide twice_area(const corner_list *corners)
{
    cairn_area sum = 0;
    for (int i = 1; i + 1 < corners->count; i++) {
        sum += fan_area(corners, i);
    }
    return cairn_wide_from_area(sum);
}

/* The lower left corner of the bounding box. */
static cairn_offset2 lowest(const corner_list *corners)
{
    cairn_offset2 low = corners->at[0];
    for (int i = 1; i < corners->count; i++) {
        low.x = corners->at[i].x < low.x ? corners->at[i].x : low.x;
        low.y = corners->at[i].y < low.y ? corners->at[i].y : low.y;
    }
    return low;
}

/* x + y + z, none of them negative */
static cairn_wide sum_of(cairn_offset x, cairn_offset y, cairn_offset z)
{
    return cairn_wide_add(cairn_wide_from_sum(x, y), cairn_wide_from_offset(z));
}

/* The mean of the triangles' centroids, weighted by area, from the lower left: (sum of A_i (a_i + b_i + c_i)) / 3 A. */
static cairn_offset2 centroid_of(const corner_list *corners)
{
    cairn_offset2 low = lowest(corners), first = corners->at[0], centroid;
    cairn_wide x = cairn_wide_zero(), y = cairn_wide_zero();
    cairn_wide thrice = cairn_wide_mul(cairn_wide_from_int(3), twice_area(corners));
    for (int i = 1; i + 1 < corners->count; i++) {
        cairn_offset2 b = corners->at[i], c = corners->at[i + 1];
        cairn_wide area = fan_weight(corners, i);
        x = cairn_wide_add(x, cairn_wide_mul(area, sum_of(first.x - low.x, b.x - low.x, c.x - low.x)));
        y = cairn_wide_add(y, cairn_wide_mul(area, sum_of(first.y - low.y, b.y - low.y, c.y - low.y)));
    }
    centroid.x = low.x + cairn_wide_to_offset(cairn_wide_div(x, thrice));
    centroid.y = low.y + cairn_wide_to_offset(cairn_wide_div(y, thrice));
    return centroid;
}

/* Squared radius of gyration of a triangle about its own centroid, times 36: the sum of its squared sides. */
static cairn_wide triangle_gyration(const cairn_offset2 *a, const cairn_offset2 *b, const cairn_offset2 *c)
{
    return cairn_wide_add(distance_squared(a, b), cairn_wide_add(distance_squared(b, c), distance_squared(c, a)));
}

/* Squared distance of the centroids of the fan's triangles i and j, times 9. */
static cairn_wide centroid_distance(const corner_list *corners, int i, int j)
{
    const cairn_offset2 *p = corners->at;
    return squared(cairn_wide_from_sum(p[i].x - p[j].x, p[i + 1].x - p[j + 1].x),
                   cairn_wide_from_sum(p[i].y - p[j].y, p[i + 1].y - p[j + 1].y));
}

/*
 * Squared radius of gyration: the mean of the triangles' own, and the variance of their centroids as the mean over all
 * pairs, sum of A_i A_j |c_i - c_j|^2 / A^2 (Huygens and Koenig, without a difference of large numbers).
 */
static cairn_wide gyration_squared(const corner_list *corners, cairn_wide whole)
{
    cairn_wide own = cairn_wide_zero(), spread = cairn_wide_zero();
    for (int i = 1; i + 1 < corners->count; i++) {
        cairn_wide share = cairn_wide_div(fan_weight(corners, i), whole);
        own = cairn_wide_add(own, cairn_wide_mul(share, triangle_gyration(corners->at, &corners->at[i], &corners->at[i + 1])));
        for (int j = 1; j < i; j++) {
            cairn_wide other = cairn_wide_div(fan_weight(corners, j), whole);
            spread = cairn_wide_add(spread, cairn_wide_mul(cairn_wide_mul(share, other), centroid_distance(corners, i, j)));
        }
    }
    return cairn_wide_add(cairn_wide_div(own, cairn_wide_from_int(36)), cairn_wide_div(spread, cairn_wide_from_int(9)));
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
    for (int i = 0; i < corners->count; i++) {
        const cairn_offset2 *here = &corners->at[i], *next = after(corners, i);
        polygon->vertex[i].x = here->x - centroid.x;
        polygon->vertex[i].y = here->y - centroid.y;
        cairn_unit_along(next->y - here->y, here->x - next->x, &polygon->normal[i].x, &polygon->normal[i].y);
    }
}

/* How near the nearest edge is. */
static cairn_offset inradius_of(const cairn_polygon *polygon)
{
    cairn_offset least = CAIRN_OFFSET_MAX;
    for (int i = 0; i < polygon->count; i++) {
        cairn_offset distance = cairn_offset_dot(polygon->vertex[i].x, polygon->vertex[i].y, polygon->normal[i].x, polygon->normal[i].y);
        least = distance < least ? distance : least;
    }
    return least;
}

/* From corners in order. */
static cairn_status fill(cairn_polygon *polygon, const corner_list *corners, cairn_offset2 centroid)
{
    cairn_offset radius = farthest_from(corners, centroid);
    if (radius > cairn_offset_from_real(CAIRN_SHAPE_RADIUS_MAX)) {
        return CAIRN_ERROR_SHAPE;
    }
    cairn_wide whole = twice_area(corners);
    cairn_clear(polygon, sizeof *polygon);
    polygon->shape.kind = &cairn_polygon_class;
    polygon->shape.size = cairn_vec2_of(cairn_real_above_offset(radius), 0);
    polygon->shape.polygon = polygon;
    polygon->mass.area = cairn_wide_div(whole, cairn_wide_from_int(2));
    polygon->mass.gyration = cairn_wide_sqrt(gyration_squared(corners, whole));
    fill_outline(polygon, corners, centroid);
    polygon->inradius = inradius_of(polygon);
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

/* From left to right, by insertion. */
static void sort(corner_list *corners)
{
    for (int i = 1; i < corners->count; i++) {
        cairn_offset2 moved = corners->at[i];
        int place = i;
        while (place > 0 && is_left_of(&moved, &corners->at[place - 1])) {
            corners->at[place] = corners->at[place - 1];
            place--;
        }
        corners->at[place] = moved;
    }
}

/* Add a corner to a chain that turns left only; `start` is where the chain began. */
static void extend(corner_list *chain, int start, const cairn_offset2 *corner)
{
    while (chain->count >= start + 2 && turn(&chain->at[chain->count - 2], &chain->at[chain->count - 1], corner) <= 0) {
        chain->count--;
    }
    chain->at[chain->count++] = *corner;
}

/*
 * Andrew's monotone chain: from left to right along what lies below the line from the first to the last point, and back
 * along what lies above it. No point is in both chains, so the hull is never longer than the list.
 */
static void wrap(const corner_list *points, corner_list *hull)
{
    const cairn_offset2 *first = &points->at[0], *last = &points->at[points->count - 1];
    hull->count = 0;
    for (int i = 0; i < points->count; i++) {
        if (turn(first, last, &points->at[i]) <= 0) {
            extend(hull, 0, &points->at[i]);
        }
    }
    int start = hull->count - 1;
    for (int i = points->count - 1; i >= 0; i--) {
        if (turn(first, last, &points->at[i]) > 0) {
            extend(hull, start, &points->at[i]);
        }
    }
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
            hull->at[j] = hull->at[j + 1];
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
    sort(&given);
    wrap(&given, &hull);
    drop_flat(&hull);
    if (hull.count < 3 || hull.count > CAIRN_MAX_VERTICES || put_in_order(&hull) != CAIRN_OK) {
        return CAIRN_ERROR_SHAPE;
    }
    return fill(polygon, &hull, centroid_of(&hull));
}
