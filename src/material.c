/* The material presets. */
#include <cairn/material.h>

const cairn_material cairn_material_default = CAIRN_MATERIAL(0.5, 0.4);
const cairn_material cairn_material_ice = CAIRN_MATERIAL(0.05, 0.02);
const cairn_material cairn_material_metal = CAIRN_MATERIAL_BOUNCING(0.6, 0.4, 0.1, 0.5);
const cairn_material cairn_material_jelly = CAIRN_MATERIAL_BOUNCING(0.9, 0.7, 0.6, 0.5);
