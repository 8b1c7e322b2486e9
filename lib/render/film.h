/* film.h - the picture and what is known of its making. */
#ifndef RT_LIB_RENDER_FILM_H
#define RT_LIB_RENDER_FILM_H

#include "photon/ledger.h"
#include "rt.h"
#include "types.h"

struct rt_film {
    rt_render_options options; /* as rendered, defaults filled in */
    rt_film_stats stats;
    rt_ledger ledger; /* of all photon paths */
    rt_film_pixel *pixels; /* [height][width], the sums */
    float *rgb;            /* [height][width][3], the means */
    float *photon_layers;  /* [RT_PHOTON_LAYERS][height][width], or NULL */
};

/* Layers for the study of photon mapping, and their names. */
enum { RT_PHOTON_LAYERS = 4 };
extern const char *const rt_photon_layer_names[RT_PHOTON_LAYERS];

/* A black film for complete options; the caller owns *out. */
rt_status rt_film_create(rt_film **out, const rt_render_options *options, rt_error *error);

/* Makes the means from the sums, and from them the counts of samples and of rejected ones. */
void rt_film_resolve(rt_film *film);

#endif
