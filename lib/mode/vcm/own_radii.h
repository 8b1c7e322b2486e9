/*
 * own_radii.h - the radii of merging that the pixels of a picture begin with, by the light vertices
 * of a pilot: where light is concentrated, smaller ones than the rest of the scene has.
 */
#ifndef RT_LIB_MODE_VCM_OWN_RADII_H
#define RT_LIB_MODE_VCM_OWN_RADII_H

#include "mode/vcm/vertex_grid.h"

/*
 * Finds, by the light vertices in the list of the grid, for each query [height][width] of a picture
 * the squared radius of the disc that holds RT_MERGE_WANTED of them. *radius is the largest; it
 * becomes the median over all queries. *own: a new buffer, float [height][width], where some
 * pixel's is below *radius, else left as it is. found: the memory that the buffer
 * of queries mirrors; kernel: vcm_radii
 */
rt_status rt_own_radii_find(cl_mem *own, double *radius, rt_vertex_grid *grid, cl_mem scene,
                            rt_merge_query *found, cl_mem queries, cl_kernel kernel, uint32_t width,
                            uint32_t height, rt_error *error);

#endif
