/* rt/film.h - rendering, and the film that it makes. Part of rt.h, the manual. */
#ifndef RT_RT_FILM_H
#define RT_RT_FILM_H

#include "photon.h"
#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Film ------------------------------------------------------------------------------------ */

typedef struct rt_film rt_film;

/*
 * Fails with RT_ERROR_USAGE, error->field naming the member, when an option is out of its range or
 * does not go with another, as rt_render does.
 */
RT_API rt_status rt_render_options_check(const rt_render_options *options, rt_error *error);

/*
 * Renders; options NULL: the scene's own. The caller owns *out. When a progress callback cancels,
 * returns RT_CANCELLED and *out still receives the film of the samples so far (NULL when there are
 * none yet). In photon mode warns as rt_photon_map_emit does, and when most points that asked for
 * all photons found none. The film does not depend on the renderer's further life.
 */
RT_API rt_status rt_render(rt_film **out, rt_renderer *renderer, const rt_render_options *options,
                           rt_error *error);
RT_API void rt_film_destroy(rt_film *film);

/* Linear radiance, [height][width][3], top row first; owned by the film. */
RT_API const float *rt_film_rgb(const rt_film *film);
RT_API void rt_film_get_size(const rt_film *film, uint32_t *width, uint32_t *height);

/*
 * A layer of the film, [height][width][*channels], top row first; owned by the film. NULL when
 * there is none of that name. channels may be NULL. With rt_render_options.aov, and by the modes
 * that show one, as means over the samples that the picture has:
 *   albedo           3  kd + ks + kt of the first hit, ks of a metal by its reflectance; 0 where
 *                    nothing is hit
 *   normal           3  its shading normal in the world, as the shape has it, not turned to the
 *                    camera; 0 likewise
 *   depth            1  metres along the view axis (from the eye, for an environment camera), mean
 *                       of the samples that hit
 * With rt_render_options.variance or target_error:
 *   variance         3  variance of the picture's radiance, estimated from independent sequences:
 *                       what the pixel estimates is within rt_film_stats.interval_factor
 *                       sqrt(variance) of it, with a confidence of 95 %. In photon mode that is the
 *                       noise; the bias that gathering has is not in it
 * With rt_render_options.photon_layers:
 *   photon.count     1  mean number of photons that count at the end of an eye path
 *   photon.radius    1  mean radius of the disc that they lie in, m
 *   photon.density   1  mean of their number over the disc's area, 1/m^2
 *   photon.variance  1  variance of the pixel, the mean of its three channels, estimated from its
 *                       samples. In passes these are independent; in one pass they share their
 *                       photons, whose part it leaves out
 *   photon.bias      1  estimated bias of the pixel, the mean of its three channels, positive where
 *                       gathering makes it too bright: 2 (L - L'), where L' gathers once more
 *                       within half the squared radius, or k/(k - k') (L - L') with the k' = (k +
 *                       1)/2 nearest (Richardson's extrapolation). Of all lists and passes. As
 *                       noisy as L', so to be looked at as a mean over pixels; at edges of light
 *                       and of surfaces, where the bias grows as the radius and not as its square,
 *                       it is 2 - sqrt 2 = 0.59 of it. Photons of the sampler sobol lie too evenly
 *                       for few nearest ones, which is a bias of another kind, not in proportion to
 *                       k, that comes in with the wrong sign. 0, which says nothing, for a list
 *                       asked with k 2, and below k 9 with the hull. Gathering takes about twice as
 *                       long
 */
RT_API const float *rt_film_layer(const rt_film *film, const char *name, uint32_t *channels);

typedef struct rt_film_stats {
    uint32_t spp;             /* samples that every pixel has */
    uint64_t rejected;        /* samples left out because they were not finite */
    uint64_t photons_emitted; /* photon paths */
    uint64_t photons_stored;
    /* photons left out because they were not finite or lay beyond 1e15 m */
    uint64_t photons_rejected;
    uint64_t gathers; /* queries of the photon map: points that asked for photons */
    /*
     * of these, at the ends of eye paths, where all photons are asked for; the others are on the
     * way of a final gather, and ask for caustic photons
     */
    uint64_t gathers_at_ends;
    /*
     * of those at the ends, the ones that found no photon to sum. When they are more than half,
     * rt_render warns of it
     */
    uint64_t gathers_empty;
    uint32_t passes; /* of progressive photon mapping, done; 0: not in passes */
    /* independent sequences, from which the error is estimated; 0: it is not */
    uint32_t replicates;
    /*
     * of the picture: root of the mean squared error over all pixels and channels, by the mean
     * radiance. Estimated from the layer variance, so that of photon mapping is the noise alone,
     * and light that RT_MODE_PATH leaves out is not in it
     */
    double relative_error;
    /*
     * what it is below, with a confidence of 95 %; as long as samples are many enough to show what
     * light there is: what no path has met yet, none can tell of. Infinite below 8 samples, or
     * passes in photon mode, which are too few to tell
     */
    double relative_error_bound;
    /*
     * half of a pixel's 95 % interval by its standard deviation, the root of the layer variance:
     * Student's t, two-sided, replicates - 1 degrees of freedom
     */
    double interval_factor;
    double light_power; /* emitted power of all lights, W, mean of the three channels */
    double build_seconds, compile_seconds, emit_seconds, gather_seconds, render_seconds;
} rt_film_stats;
RT_API void rt_film_get_stats(const rt_film *film, rt_film_stats *out);

/*
 * The energy ledger of all photon paths of a render, as rt_photon_map_ledger; no rows in path mode.
 */
RT_API size_t rt_film_get_ledger(const rt_film *film, rt_light_ledger *out, size_t capacity);

typedef enum rt_tonemap { RT_TONEMAP_NONE = 0, RT_TONEMAP_REINHARD, RT_TONEMAP_ACES } rt_tonemap;

typedef struct rt_image_options {
    float exposure;     /* stops: radiance is multiplied by 2^exposure; for 8-bit formats only */
    rt_tonemap tonemap; /* for 8-bit formats only */
    const char *scene, *command; /* recorded in the attributes of an .exr; NULL: left out */
} rt_image_options;

/*
 * Writes the film in the format of the file's extension: .exr (linear float, with the seed, samples
 * and version as attributes, and the layers: albedo.R .G .B, normal.X .Y .Z, depth.Z, variance.R .G
 * .B, and photon.count and the like by their names), .png and .ppm (sRGB), .pfm (linear float). The
 * file appears whole or not at all. Fails with RT_ERROR_USAGE for another extension and
 * RT_ERROR_OUTPUT when it cannot be written.
 */
RT_API rt_status rt_film_write(const rt_film *film, const char *path,
                               const rt_image_options *options, rt_error *error);

#ifdef __cplusplus
}
#endif

#endif
