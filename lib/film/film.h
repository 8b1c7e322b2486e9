/* film.h - the film: sums of samples, the means made of them, layers and statistics. */
#ifndef RT_LIB_FILM_FILM_H
#define RT_LIB_FILM_FILM_H

#include "film/layers.h"
#include "photon/ledger.h"
#include "rt.h"
#include "types.h"

struct rt_film {
    rt_memory *memory;         /* that it counts in; NULL: none */
    uint64_t reserved;         /* bytes that count for its layers, and for writing it to a file */
    rt_render_options options; /* as rendered, defaults filled in */
    rt_film_stats stats;
    rt_ledger ledger;      /* of all photon paths */
    rt_film_pixel *pixels; /* [height][width], the sums */
    float *rgb;            /* [height][width][3], the means */
    /* [RT_LAYER_COUNT][height][width], the sums of the kernel first_hit, or NULL */
    rt_film_pixel *layer_sums;
    rt_film_layers layers; /* each [height][width][channels] */
};

/*
 * A black film for complete options, which counts in `memory` with all layers that they ask for and
 * with what writing it to a file takes: neither must fail at the end of a render. The caller owns
 * *out.
 */
rt_status rt_film_create(rt_film **out, const rt_render_options *options, rt_memory *memory,
                         rt_error *error);

/* width * height */
size_t rt_film_pixels(const rt_film *film);

/* The sum of a channel, with what rounding lost. */
double rt_film_sum(const rt_film_pixel *pixel, int channel);

/*
 * What the sums of a pixel are divided by: the sum of weights. Where a few samples' signs nearly
 * cancel, which only Mitchell's filter has, their number. 0 without samples.
 */
double rt_film_divisor(const rt_film_pixel *pixel);

/* Makes the means from the sums, and the counts of samples and of rejected ones. */
void rt_film_resolve(rt_film *film);

#endif
