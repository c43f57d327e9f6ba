/* The narrow phase of a circle with a polygon: the nearest face, or the nearest corner where the centre lies beyond a face's end. */
#include "engine.h"

/* The contact of a circle (radius r, at the origin) with the polygon's surface in direction (nx, ny) from the circle. */
static void touch(cairn_offset r, cairn_offset separation, cairn_unit nx, cairn_unit ny, int feature, cairn_manifold *out)
{
    cairn_offset middle = r + cairn_offset_half(separation);
    out->normal_x = nx;
    out->normal_y = ny;
    out->points[0].x = cairn_offset_mul(middle, nx);
    out->points[0].y = cairn_offset_mul(middle, ny);
    out->points[0].separation = out->separation = separation;
    out->points[0].feature = (uint16_t)feature;
    out->count = 1;
}

void cairn_collide_circle_polygon(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out)
{
    cairn_hull hull;
    cairn_offset r = cairn_offset_from_real(a->shape->size.x);
    cairn_offset most = -CAIRN_OFFSET_MAX;
    int edge = 0;
    out->count = 0;
    cairn_pose_hull(b, &hull);
    for (int i = 0; i < hull.count; i++) {
        cairn_offset distance = cairn_offset_dot(-hull.vertex[i].x, -hull.vertex[i].y, hull.normal[i].x, hull.normal[i].y);
        if (distance > r + margin) {
            return;
        }
        if (distance > most) {
            most = distance;
            edge = i;
        }
    }
    int next = edge + 1 < hull.count ? edge + 1 : 0;
    cairn_unit nx = hull.normal[edge].x, ny = hull.normal[edge].y;
    if (most > 0) {
        /* Outside: beyond one of the ends of the face it is the corner that is nearest. */
        int corner = -1;
        if (cairn_offset_dot(-hull.vertex[edge].x, -hull.vertex[edge].y, -ny, nx) < 0) {
            corner = edge;
        } else if (cairn_offset_dot(-hull.vertex[next].x, -hull.vertex[next].y, -ny, nx) > 0) {
            corner = next;
        }
        if (corner >= 0) {
            cairn_unit ux, uy;
            cairn_offset distance = cairn_unit_along(hull.vertex[corner].x, hull.vertex[corner].y, &ux, &uy);
            if (distance <= r + margin) {
                touch(r, distance - r, ux, uy, 16 + corner, out);
            }
            return;
        }
    }
    touch(r, most - r, -nx, -ny, edge, out);
}
