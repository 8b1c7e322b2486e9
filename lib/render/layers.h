/* layers.h - what the first surface is like, summed beside the radiance: albedo, normal and depth. */
#ifndef RT_LIB_RENDER_LAYERS_H
#define RT_LIB_RENDER_LAYERS_H

#include "render/renderer.h"

/* The layers of a render under way; all zero: none. */
typedef struct rt_layers {
    cl_kernel kernel;
    cl_mem films; /* rt_film_pixel [RT_LAYER_COUNT][height][width] */
} rt_layers;

/* Whether the options ask for layers, as the picture itself or beside it. */
int rt_layers_wanted(const rt_render_options *options);

/* Makes room in the film and on the device, and the kernel ready, as part of the stage `compile`. */
rt_status rt_layers_begin(rt_layers *out, rt_renderer *renderer, rt_film *film, rt_stage_progress *progress,
                          rt_error *error);

/* Adds the items and samples of params; does not wait. Does nothing where there are no layers. */
rt_status rt_layers_add(rt_layers *layers, rt_renderer *renderer, const rt_params *params, rt_error *error);

/* Copies the sums to the film. Does nothing where there are no layers. */
rt_status rt_layers_read(const rt_layers *layers, rt_renderer *renderer, rt_film *film, rt_error *error);
void rt_layers_free(rt_layers *layers);

/* Makes the layers' means from the sums, and from them the picture, where the mode is to show one. */
void rt_layers_resolve(rt_film *film);

#endif
