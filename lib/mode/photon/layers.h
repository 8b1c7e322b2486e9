/* layers.h - the layers photon.count and so on: what was gathered at each pixel. */
#ifndef RT_LIB_MODE_PHOTON_LAYERS_H
#define RT_LIB_MODE_PHOTON_LAYERS_H

#include "film/film.h"
#include "types.h"

/*
 * Adds a batch of gather points, with their radiance and what was found there: `split` of them,
 * one after the other, are a sample. earlier [rows][stride] are points whose radiance belongs to
 * the same samples. biases [count] are theirs.
 */
void rt_photon_layers_add(rt_photon_sums *sums, const rt_gather_point *points,
                          const rt_gather_disc *discs, const double *biases, size_t count,
                          size_t split, const rt_gather_point *earlier, size_t rows, size_t stride);

/* What a layer of RT_LAYERS_PHOTON holds for a pixel. */
float rt_photon_layer_value(const rt_photon_sums *sums, int layer);

/* Makes the film's layers from its sums. */
rt_status rt_photon_layers_resolve(rt_film *film, rt_error *error);

#endif
