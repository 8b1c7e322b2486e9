/*
 * vcm_camera_faceted.cl - as vcm_camera.cl, of scenes where all shading normals are the geometric
 * ones.
 */
#define RT_FACETED
#include "vcm_camera.cl"
