/*
 * vcm_light_faceted.cl - as vcm_light.cl, of scenes where all shading normals are the geometric
 * ones.
 */
#define RT_FACETED
#include "vcm_light.cl"
