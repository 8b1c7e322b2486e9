/* aov.h - what the first surface is like, summed beside the radiance: albedo, normal and depth. */
#ifndef RT_LIB_RENDER_AOV_H
#define RT_LIB_RENDER_AOV_H

#include "render/renderer.h"

/* The layers of a render under way; all zero: none. */
typedef struct rt_aov {
    cl_kernel kernel;
    cl_mem films; /* rt_film_pixel [RT_LAYER_COUNT][height][width] */
} rt_aov;

/* Whether the options ask for layers, as the picture itself or beside it. */
int rt_aov_wanted(const rt_render_options *options);

/*
 * Makes room in the film and on the device, and the kernel ready, as part of the stage `compile`.
 */
rt_status rt_aov_begin(rt_aov *out, rt_renderer *renderer, rt_film *film,
                       rt_stage_progress *progress, rt_error *error);

/* Adds the items and samples of params; does not wait. Does nothing where there are no layers. */
rt_status rt_aov_add(rt_aov *layers, rt_renderer *renderer, const rt_params *params,
                     rt_error *error);

/* Copies the sums to the film. Does nothing where there are no layers. */
rt_status rt_aov_read(const rt_aov *layers, rt_renderer *renderer, rt_film *film, rt_error *error);
void rt_aov_free(rt_aov *layers);

/*
 * Makes the layers' means from the sums, and from them the picture, where the mode is to show one.
 */
void rt_aov_resolve(rt_film *film);

#endif
