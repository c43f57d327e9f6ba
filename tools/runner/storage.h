/* How much memory a scene's world is given: the same on the host and in the tables written for firmware. */
#ifndef CAIRN_RUNNER_STORAGE_H
#define CAIRN_RUNNER_STORAGE_H

#include "scene.h"

/* Contacts of a heap are about twice its bodies; four times leaves room for near pairs. */
static inline uint16_t runner_arbiters(const cairn_scene *scene) { return (uint16_t)(4 * scene->body_count + 16); }
static inline uint16_t runner_cells(const cairn_scene *scene) { return (uint16_t)(2 * scene->body_count + 16); }
static inline uint16_t runner_entries(const cairn_scene *scene) { return (uint16_t)(8 * scene->body_count + 16); }

/* Has one of its moving bodies more than 30 times the mass of another? Then it is given memory for blocks. */
static inline bool runner_is_uneven(const cairn_scene *scene)
{
    cairn_wide least = cairn_wide_zero(), most = least;
    for (int i = 0; i < scene->body_count; i++) {
        const cairn_body_model *model = &scene->models[scene->bodies[i].model];
        cairn_mass_data data;
        if (model->type == CAIRN_DYNAMIC && cairn_shape_measure(model->shape, &data) == CAIRN_OK) {
            const cairn_wide mass = cairn_wide_mul(data.area, model->density);
            least = cairn_wide_is_zero(least) || cairn_wide_less(mass, least) ? mass : least;
            most = cairn_wide_less(most, mass) ? mass : most;
        }
    }
    return cairn_wide_less(cairn_wide_mul(least, cairn_wide_from_int(30)), most);
}

#endif
