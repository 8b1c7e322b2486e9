/* layers.h - the layers photon.count and so on: what was gathered at each pixel. */
#ifndef RT_LIB_MODE_PHOTON_LAYERS_H
#define RT_LIB_MODE_PHOTON_LAYERS_H

#include "film/film.h"
#include "types.h"

/* Sums of a pixel. */
typedef struct rt_photon_layer_sum {
    double asked, photons, radius, density; /* of the query points at ends of paths */
    /* of all samples: mean of the three channels, its square and bias */
    double samples, value, square, bias;
} rt_photon_layer_sum;

/* Sums for a film of so many pixels, which count in `memory`; rt_memory_free frees *out. */
rt_status rt_photon_layers_create(rt_photon_layer_sum **out, size_t pixels, rt_memory *memory,
                                  rt_error *error);

/*
 * Adds a batch of gather points, with their radiance and what was found there; earlier
 * [rows][stride] are points whose radiance belongs to the same samples. biases [count] are theirs.
 */
void rt_photon_layers_add(rt_photon_layer_sum *sums, const rt_gather_point *points,
                          const rt_gather_disc *discs, const double *biases, size_t count,
                          const rt_gather_point *earlier, size_t rows, size_t stride);

/* Makes the film's layers from the sums. */
rt_status rt_photon_layers_resolve(rt_film *film, const rt_photon_layer_sum *sums, rt_error *error);

#endif
