/*
 * own_radii.h - the radii of merging that the pixels of a picture begin with, by the light vertices
 * of a pilot: where light is concentrated, smaller ones than the rest of the scene has.
 */
#ifndef RT_LIB_MODE_VCM_OWN_RADII_H
#define RT_LIB_MODE_VCM_OWN_RADII_H

#include "mode/vcm/vertex_grid.h"

/* What the searches use. */
typedef struct rt_radii_search {
    rt_vertex_grid *grid; /* its list holds the light vertices */
    cl_mem scene;
    cl_mem queries;        /* rt_merge_query [pixels] */
    rt_merge_query *found; /* the memory that they mirror */
    rt_u32 pixels;
    cl_kernel radii, ask_lights; /* vcm_radii, vcm_light_queries */
} rt_radii_search;

/*
 * Lowers *radius to the median, over the light vertices, of the radius of the disc that holds
 * RT_MERGE_WANTED of them: camera paths merge where the light is, also beyond what pixels see, and
 * a lit place that is smaller than a disc would lose most of its light. Writes over the queries.
 */
rt_status rt_own_radii_limit(double *radius, const rt_radii_search *of, rt_error *error);

/*
 * Finds for each query [height][width] of a picture the squared radius of the disc that holds
 * RT_MERGE_WANTED light vertices. *radius is the largest; it becomes the median over all queries.
 * *own: a new buffer, float [height][width], where some pixel's is below *radius, else left as it
 * is.
 */
rt_status rt_own_radii_find(cl_mem *own, double *radius, const rt_radii_search *of, uint32_t width,
                            rt_error *error);

#endif
