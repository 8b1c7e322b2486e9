/* film.h - the picture and what is known of its making. */
#ifndef RT_LIB_RENDER_FILM_H
#define RT_LIB_RENDER_FILM_H

#include "photon/ledger.h"
#include "rt.h"
#include "types.h"

/* Layers besides the radiance. */
typedef enum rt_film_layer_id {
    RT_FILM_ALBEDO,
    RT_FILM_NORMAL,
    RT_FILM_DEPTH,
    RT_FILM_VARIANCE,
    RT_FILM_PHOTON_COUNT,
    RT_FILM_PHOTON_RADIUS,
    RT_FILM_PHOTON_DENSITY,
    RT_FILM_PHOTON_VARIANCE,
    RT_FILM_PHOTON_BIAS,
    RT_FILM_LAYERS
} rt_film_layer_id;

typedef struct rt_layer_kind {
    const char *name;
    uint32_t channels;
    const char *channel[3]; /* their names in an .exr */
} rt_layer_kind;
extern const rt_layer_kind rt_layer_kinds[RT_FILM_LAYERS];

struct rt_film {
    rt_render_options options; /* as rendered, defaults filled in */
    rt_film_stats stats;
    rt_ledger ledger;      /* of all photon paths */
    rt_film_pixel *pixels; /* [height][width], the sums */
    float *rgb;            /* [height][width][3], the means */
    /* [RT_LAYER_COUNT][height][width], of the layers that the kernel aov sums, or NULL */
    rt_film_pixel *layer_sums;
    float *layers[RT_FILM_LAYERS]; /* [height][width][channels], or NULL */
    struct rt_noise *noise;        /* what rounds tell of the error, or NULL; see noise.h */
};

/* Makes room for the layers from first to last, all zero; the film owns it. */
rt_status rt_film_add_layers(rt_film *film, rt_film_layer_id first, rt_film_layer_id last,
                             rt_error *error);

/* A black film for complete options; the caller owns *out. */
rt_status rt_film_create(rt_film **out, const rt_render_options *options, rt_error *error);

/*
 * What the sums of a pixel are divided by: the sum of weights. Where a few samples' signs nearly
 * cancel, which only Mitchell's filter has, their number. 0 without samples.
 */
double rt_film_divisor(const rt_film_pixel *pixel);

/*
 * Makes the means from the sums, and from them the counts of samples and of rejected ones; and what
 * the rounds tell.
 */
rt_status rt_film_resolve(rt_film *film, rt_error *error);

#endif
