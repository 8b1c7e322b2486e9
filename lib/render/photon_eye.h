/*
 * photon_eye.h - the eye's half of photon mapping: paths from the camera to where photon maps are
 * asked, and what comes of it on the film.
 */
#ifndef RT_LIB_RENDER_PHOTON_EYE_H
#define RT_LIB_RENDER_PHOTON_EYE_H

#include "photon/gather.h"
#include "render/aov.h"
#include "render/photon_bias.h"
#include "render/photon_layers.h"
#include "render/renderer.h"

/* The kernels of the eye's half. */
typedef struct rt_eye_kernels {
    cl_kernel camera; /* photon_camera */
    cl_kernel gather; /* gather_neighbours or gather_tree */
    cl_kernel film;   /* photon_film */
} rt_eye_kernels;

/* Eye paths under way, a batch at a time. */
typedef struct rt_photon_eye {
    rt_renderer *renderer;
    const rt_render_options *options;
    rt_eye_kernels kernels;
    rt_aov *aov;
    uint32_t replicate; /* of the samples to come */
    rt_u32 rows;        /* of caustic points a path can have: diffuse bounces of the final gather */
    size_t capacity;    /* paths a batch */
    cl_mem points;      /* rt_gather_point [capacity] */
    cl_mem caustics;    /* rt_gather_point [rows][capacity] */
    cl_mem pixels;      /* rt_film_pixel, the film on the device */
    rt_gather_disc *discs;       /* [capacity], what was found at the points */
    rt_gather_disc *way_discs;   /* [capacity], and at the caustic points, or in the caustic list */
    rt_photon_layer_sum *layers; /* a pixel, or NULL when there are none */
    rt_gather_point *host_points; /* for them: [1 + rows][capacity] points and caustics */
    rt_photon_bias bias;          /* likewise */
} rt_photon_eye;

/* What the eye asks: lists of photons made ready; each may be NULL. */
typedef struct rt_eye_maps {
    rt_gatherer *global, *caustic; /* at the end of paths: all photons, in one list or in two */
    /* at the diffuse bounces of the final gather: caustic photons alone */
    rt_gatherer *on_the_way;
} rt_eye_maps;

/* Builds the kernels, as part of the stage `compile`. Release with rt_eye_kernels_release. */
rt_status rt_eye_kernels_prepare(rt_eye_kernels *out, const rt_renderer *renderer, int on_device,
                                 rt_stage_progress *progress, rt_error *error);
void rt_eye_kernels_release(rt_eye_kernels *kernels);

/*
 * Makes memory for batches and the film on the device; options are complete. rt_photon_eye_release
 * undoes it.
 */
rt_status rt_photon_eye_create(rt_photon_eye *out, rt_renderer *renderer,
                               const rt_render_options *options, const rt_eye_kernels *kernels,
                               rt_aov *aov, const rt_film *film, rt_error *error);
void rt_photon_eye_release(rt_photon_eye *eye);

/*
 * Gives each pixel the sample of this number; `finer` is asked where there are layers. The gathers
 * of *stats grow by the points that asked for photons. Reports fractions of the part of the stage
 * that progress is set to.
 */
rt_status rt_photon_eye_sample(rt_photon_eye *eye, const rt_eye_maps *maps,
                               const rt_finer_maps *finer, uint32_t sample, rt_film_stats *stats,
                               rt_stage_progress *progress, rt_error *error);

/*
 * The squared radius of each pixel, [height][width], m^2, that one sample finds by this gatherer at
 * the end of its path or, on the way, at its first diffuse bounce; 0 where there are no photons, or
 * none are asked for. The film is left alone.
 */
rt_status rt_photon_eye_radii(rt_photon_eye *eye, rt_gatherer *gatherer, int on_the_way,
                              uint32_t sample, float *squared, rt_stage_progress *progress,
                              rt_error *error);

/* Reads the film, and makes its layers. */
rt_status rt_photon_eye_read(const rt_photon_eye *eye, rt_film *film, rt_error *error);

#endif
