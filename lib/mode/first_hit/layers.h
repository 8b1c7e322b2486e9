/*
 * layers.h - the layers of the first hit, summed by the kernel first_hit over the samples of the
 * picture.
 */
#ifndef RT_LIB_MODE_FIRST_HIT_LAYERS_H
#define RT_LIB_MODE_FIRST_HIT_LAYERS_H

#include "base/progress.h"
#include "film/film.h"
#include "render/renderer.h"

/* The layers of a render under way; all zero: none. */
typedef struct rt_first_hit_layers {
    rt_renderer *renderer;
    rt_device *device;
    cl_kernel kernel;
    cl_mem sums; /* rt_first_hits [height][width] */
} rt_first_hit_layers;

/*
 * Makes room in the film and on the device, and the kernel ready, as part of the stage `compile`.
 * rt_first_hit_layers_release undoes it, also after a failure; what is in the film stays.
 */
rt_status rt_first_hit_layers_prepare(rt_first_hit_layers *out, rt_renderer *renderer,
                                      rt_film *film, rt_stage_progress *progress, rt_error *error);
void rt_first_hit_layers_release(rt_first_hit_layers *layers);

/* Adds the items and samples of params; does not wait. Does nothing where there are no layers. */
rt_status rt_first_hit_layers_add(rt_first_hit_layers *layers, const rt_params *params,
                                  rt_error *error);

/* Copies the sums to the film. Does nothing where there are no layers. */
rt_status rt_first_hit_layers_read(const rt_first_hit_layers *layers, rt_film *film,
                                   rt_error *error);

/* Copies the sums of the film to the device. Does nothing where there are no layers. */
rt_status rt_first_hit_layers_write(const rt_first_hit_layers *layers, const rt_film *film,
                                    rt_error *error);

/* What a layer of RT_LAYERS_FIRST_HIT holds for a pixel, out [its channels]. */
void rt_first_hit_layer_value(float *out, const rt_first_hits *sums, int layer);

/* Makes the film's layers, means and ids, from the sums, if there are any. */
void rt_first_hit_layers_resolve(rt_film *film);

#endif
