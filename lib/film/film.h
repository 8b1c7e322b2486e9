/* film.h - the film: sums of samples, the means made of them, layers and statistics. */
#ifndef RT_LIB_FILM_FILM_H
#define RT_LIB_FILM_FILM_H

#include "film/coverage.h"
#include "film/layers.h"
#include "film/photon_sums.h"
#include "film/units.h"
#include "photon/ledger.h"
#include "rt.h"
#include "types.h"

/* The owner under which a film counts its memory. */
extern const char rt_film_owner[];

/* Planes of the moments of passes. */
enum { RT_MOMENTS = 3 };

struct rt_film {
    double made;               /* its creation, by rt_clock: its address may have been another's */
    rt_memory *memory;         /* that it counts in; NULL: none */
    uint64_t reserved;         /* bytes that count for its layers, and for writing it to a file */
    rt_render_options options; /* as rendered, defaults filled in */
    rt_film_stats stats;
    uint64_t scene;   /* fingerprint of the scene and the camera; 0: not taken */
    char *note;       /* that of the options, or NULL */
    uint64_t light;   /* that of a photon map and of light shares, if given by the caller; or 0 */
    rt_ledger ledger; /* of all photon paths */
    rt_units units;   /* the work that the whole picture takes */
    int lacks_base;   /* the samples of units.base are in another film, to be added to */
    rt_coverage done; /* the units whose samples are in the sums */
    /* where the sums lie, on the lines of a cache */
    void *pixel_memory, *hit_memory, *moment_memory;
    rt_film_pixel *pixels;       /* [units.replicates][height][width], the sums */
    float *rgb;                  /* [height][width][3], the means */
    rt_first_hits *first_hits;   /* [height][width], the sums of the kernel first_hit, or NULL */
    rt_photon_sums *photon_sums; /* [height][width], or NULL */
    rt_u32 *rates; /* [height][width], in 1 / RT_RATE_UNIT, 0: not known yet; or NULL: rates.h */
    rt_film_pixel *moments; /* [RT_MOMENTS][height][width] of passes, or NULL: bias.h */
    int is_resolved;        /* rgb and layers are those of the sums */
    rt_film_layers layers;  /* each [height][width][channels] */
};

/*
 * A black film for complete options, which counts in `memory` with all layers that they ask for and
 * with what writing it to a file takes: neither must fail at the end of a render. The caller owns
 * *out.
 */
rt_status rt_film_create(rt_film **out, const rt_render_options *options, rt_memory *memory,
                         rt_error *error);

/* Makes room for the layers of the first hit, without samples, unless they are there. */
rt_status rt_film_make_first_hits(rt_film *film, rt_error *error);

/* Takes all samples out of a film; what it is a picture of stays. */
void rt_film_clear(rt_film *film);

/* The bytes of the moments of passes; 0 without. */
size_t rt_film_moment_bytes(const rt_film *film);

/* width * height */
size_t rt_film_pixels(const rt_film *film);

/* Fails where it is not known of which scene it is, so that it cannot be `what`, as "kept". */
rt_status rt_film_check_exact(const rt_film *film, const char *what, rt_error *error);

/* The bytes of the sums of all planes. */
size_t rt_film_bytes(const rt_film *film);

/* Adds the samples of so many pixels to others. */
void rt_film_join_pixels(rt_film_pixel *pixels, const rt_film_pixel *others, size_t count);

/* The sum of a channel. */
double rt_film_sum(const rt_film_pixel *pixel, int channel);
double rt_first_hits_sum(const rt_first_hits *hits, int channel);

/*
 * What a sum is divided by: the sum of weights. Where a few samples' signs nearly cancel, which
 * only Mitchell's filter has, the number of samples. 0 without samples.
 */
double rt_film_divisor(double weight, double count);

/* The samples of a pixel, or passes, that the film holds; the mean over its pixels. */
double rt_film_samples_done(const rt_film *film);

/* The samples of pixel i, in all planes. */
uint32_t rt_film_count(const rt_film *film, size_t i);

/* The means of pixel i, over all planes; returns how many of its samples were rejected. */
uint32_t rt_film_mean(float rgb[3], const rt_film *film, size_t i);

/* Makes the means from the sums, and the counts of samples and of rejected ones. */
void rt_film_make_means(rt_film *film);

#endif
