/* The narrow phase of a circle with a polygon: the nearest face, or the nearest corner where the centre lies beyond a face's end. */
#include "engine.h"

/* How far beyond the corner where an edge begins a point lies along that edge. */
static cairn_offset beyond(const cairn_outline *polygon, int corner, int edge, const cairn_offset2 *p)
{
    return cairn_offset_dot(p->x - polygon->vertex[corner].x, p->y - polygon->vertex[corner].y, -polygon->normal[edge].y, polygon->normal[edge].x);
}

/* All in the polygon's own frame, but for what is found. */
void cairn_collide_circle_polygon(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out)
{
    cairn_outline polygon;
    cairn_room room;
    cairn_offset r = cairn_offset_from_real(a->shape->size.x);
    cairn_offset most = -CAIRN_OFFSET_MAX;
    cairn_offset2 centre = cairn_offset2_turned_back(a->x - b->x, a->y - b->y, b->c, b->s);
    int edge = 0;
    out->count = 0;
    cairn_shape_outline(b->shape, room.corner, &polygon);
    for (int i = 0; i < polygon.count; i++) {
        cairn_offset distance = cairn_outline_outside(&polygon, i, &centre);
        if (distance > r + margin) {
            return;
        }
        if (distance > most) {
            most = distance;
            edge = i;
        }
    }
    cairn_offset steady = 0, distance = most;
    cairn_unit2 n;
    int feature = edge;
    n.x = -polygon.normal[edge].x;
    n.y = -polygon.normal[edge].y;
    if (most > 0) {
        /* Outside: beyond one of the ends of the face it is the corner that is nearest. */
        int next = edge + 1 < polygon.count ? edge + 1 : 0;
        cairn_offset start = beyond(&polygon, edge, edge, &centre), end = start < 0 ? 0 : -beyond(&polygon, next, edge, &centre);
        steady = start < end ? start : end;
        if (steady < 0) {
            int corner = start < 0 ? edge : next;
            distance = cairn_unit_along(polygon.vertex[corner].x - centre.x, polygon.vertex[corner].y - centre.y, &n.x, &n.y);
            if (distance > r + margin) {
                return;
            }
            feature = 16 + corner;
            steady = 0;
        }
        steady = most < steady ? most : steady;
    }
    cairn_circle_touch(r, distance - r, cairn_unit2_turned(n, b->c, b->s), feature, steady, out);
}
