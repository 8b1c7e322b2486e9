/* rng_draw.h - random numbers drawn by the kernels of rng.cl. */
#ifndef RT_TESTS_KERNELS_RNG_DRAW_H
#define RT_TESTS_KERNELS_RNG_DRAW_H

#include "support.h"

/* A scene with nothing but the table of Sobol points. Release it with rt_buffer_release. */
cl_mem rng_scene(void);

/*
 * A set and the next: of samples 0 .. count - 1 of a stream (along), or of sample 7 of as many
 * streams.
 */
void rng_draw_pairs(rt_sampler kind, uint32_t seed, int along, uint32_t set, uint32_t count,
                    float (*out)[8]);

#endif
