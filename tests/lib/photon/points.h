/* points.h - reproducible random points for the tests of photon maps. */
#ifndef RT_TESTS_PHOTON_POINTS_H
#define RT_TESTS_PHOTON_POINTS_H

#include <stdint.h>

/* A stream of random numbers: O'Neill's PCG, 32 bits of output from 64 of state. */
typedef struct points_stream {
    uint64_t state;
} points_stream;

/* Uniform in [0, 1), with 24 bits. */
float points_uniform(points_stream *stream);

#endif
