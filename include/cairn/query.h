/* Questions to the world between two steps: what does a ray hit, what lies under a point, what overlaps a box. */
#ifndef CAIRN_QUERY_H
#define CAIRN_QUERY_H

#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cairn_ray_hit {
    cairn_body_id body; /* null: nothing was hit */
    cairn_vec2 point;
    cairn_vec2 normal;   /* unit, of the surface; zero if the ray starts inside */
    cairn_real fraction; /* of the way from start to end, 0 to 1 */
} cairn_ray_hit;

/* Called for each find; return false to stop. The world may not be changed from inside. */
typedef bool (*cairn_ray_visitor)(void *context, const cairn_ray_hit *hit);
typedef bool (*cairn_body_visitor)(void *context, cairn_body_id body);

/* The closest hit of the segment from start to end among the bodies with layer & mask; sensors are passed. Both ends within 250 m of one another. */
cairn_status cairn_query_ray(cairn_world *world, cairn_vec2 start, cairn_vec2 end, uint16_t mask, cairn_ray_hit *hit);
/* Every hit, sensors included, in the order of the pool. */
cairn_status cairn_query_ray_all(cairn_world *world, cairn_vec2 start, cairn_vec2 end, uint16_t mask, cairn_ray_visitor visit, void *context);
/* Every body whose shape holds the point. */
cairn_status cairn_query_point(cairn_world *world, cairn_vec2 point, uint16_t mask, cairn_body_visitor visit, void *context);
/* Every body whose shape overlaps the upright box. */
cairn_status cairn_query_box(cairn_world *world, cairn_vec2 lower, cairn_vec2 upper, uint16_t mask, cairn_body_visitor visit, void *context);

#ifdef __cplusplus
}
#endif

#endif
