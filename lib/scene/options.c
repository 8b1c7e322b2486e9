/* options.c - the ranges of render options. */
#include <math.h>

#include "base/error.h"
#include "scene/check.h"
#include "scene/scene.h"

enum {
    film_side_max = 65536,
    film_pixels_max = 1 << 28,
    depth_max = 4096,
    k_max = 1 << 16,
    k_hull_min = 5,
    passes_max = 1 << 24
};
static const double photons_max = 4e9;
static const float cone_k_max = 1e6f;

static rt_status check_film(const rt_render_options *o, rt_error *error)
{
    if (o->width > film_side_max)
        return rt_fail_field(error, RT_ERROR_USAGE, "width",
                             "width is %u pixels; it must not exceed %d", o->width, film_side_max);
    if (o->height > film_side_max)
        return rt_fail_field(error, RT_ERROR_USAGE, "height",
                             "height is %u pixels; it must not exceed %d", o->height,
                             film_side_max);
    if ((uint64_t)o->width * o->height > film_pixels_max)
        return rt_fail_field(error, RT_ERROR_USAGE, "height",
                             "a film of %u x %u pixels is over the limit of %d", o->width,
                             o->height, film_pixels_max);
    if (o->spp > RT_SPP_MAX)
        return rt_fail_field(error, RT_ERROR_USAGE, "spp", "spp is %u; it must not exceed %d",
                             o->spp, RT_SPP_MAX);
    if (o->max_depth > depth_max)
        return rt_fail_field(error, RT_ERROR_USAGE, "max_depth",
                             "max_depth is %u; it must not exceed %d", o->max_depth, depth_max);
    if (o->roulette_depth > depth_max)
        return rt_fail_field(error, RT_ERROR_USAGE, "roulette_depth",
                             "roulette_depth is %u; it must not exceed %d", o->roulette_depth,
                             depth_max);
    if (o->roulette_threshold != 0 &&
        !(o->roulette_threshold >= 1e-6f && o->roulette_threshold <= 1))
        return rt_fail_field(error, RT_ERROR_USAGE, "roulette_threshold",
                             "roulette_threshold is %g; it must lie between 1e-6 and 1",
                             o->roulette_threshold);
    if (!(o->time >= 0 && o->time <= 1e9))
        return rt_fail_field(error, RT_ERROR_USAGE, "time",
                             "time is %g s; it must lie between 0 and 1e9", o->time);
    if (!(o->target_error >= 0 && o->target_error <= 1))
        return rt_fail_field(error, RT_ERROR_USAGE, "target_error",
                             "target_error is %g; it must lie between 0 and 1", o->target_error);
    return RT_OK;
}

static rt_status check_photons(const rt_render_options *o, rt_error *error)
{
    if ((double)o->photons > photons_max)
        return rt_fail_field(error, RT_ERROR_USAGE, "photons",
                             "photons is %llu; it must not exceed %g",
                             (unsigned long long)o->photons, photons_max);
    if (o->k == 1 || (o->k > k_max && o->k != RT_K_ALL))
        return rt_fail_field(
            error, RT_ERROR_USAGE, "k",
            "k is %u; it must lie between 2 (the k-th gives the radius and is not summed) and %d",
            o->k, k_max);
    if (o->radius != 0 && !(o->radius >= RT_LENGTH_MIN && o->radius <= RT_COORDINATE_MAX))
        return rt_fail_field(error, RT_ERROR_USAGE, "radius",
                             "radius is %g m; it must lie between %g and %g, or be 0 for no limit",
                             o->radius, RT_LENGTH_MIN, RT_COORDINATE_MAX);
    if (o->passes > passes_max)
        return rt_fail_field(error, RT_ERROR_USAGE, "passes", "passes is %u; it must not exceed %d",
                             o->passes, passes_max);
    if (!(o->alpha >= 0 && o->alpha < 1))
        return rt_fail_field(error, RT_ERROR_USAGE, "alpha",
                             "alpha is %g; it must lie between 0 and 1", o->alpha);
    if (o->cone_k != 0 && !(o->cone_k >= 1 && o->cone_k <= cone_k_max))
        return rt_fail_field(error, RT_ERROR_USAGE, "cone_k",
                             "cone_k is %g; it must lie between 1 and %g", o->cone_k, cone_k_max);
    if ((double)o->caustic_photons > photons_max)
        return rt_fail_field(error, RT_ERROR_USAGE, "caustic_photons",
                             "caustic_photons is %llu; it must not exceed %g",
                             (unsigned long long)o->caustic_photons, photons_max);
    if (o->caustic_k == 1 || (o->caustic_k > k_max && o->caustic_k != RT_K_ALL))
        return rt_fail_field(error, RT_ERROR_USAGE, "caustic_k",
                             "caustic_k is %u; it must lie between 2 and %d", o->caustic_k, k_max);
    if (o->caustic_radius != 0 &&
        !(o->caustic_radius >= RT_LENGTH_MIN && o->caustic_radius <= RT_COORDINATE_MAX))
        return rt_fail_field(
            error, RT_ERROR_USAGE, "caustic_radius",
            "caustic_radius is %g m; it must lie between %g and %g, or be 0 for no limit",
            o->caustic_radius, RT_LENGTH_MIN, RT_COORDINATE_MAX);
    if (o->area == RT_AREA_HULL &&
        ((o->k > 0 && o->k < k_hull_min) || (o->caustic_k > 0 && o->caustic_k < k_hull_min)))
        return rt_fail_field(error, RT_ERROR_USAGE,
                             o->k > 0 && o->k < k_hull_min ? "k" : "caustic_k",
                             "with area hull at least %d photons must be looked at; four make the "
                             "smallest hull with one "
                             "inside",
                             k_hull_min);
    if (o->final_gather > depth_max)
        return rt_fail_field(error, RT_ERROR_USAGE, "final_gather",
                             "final_gather is %u; it must not exceed %d", o->final_gather,
                             depth_max);
    return RT_OK;
}

static rt_status check_enums(const rt_render_options *o, rt_error *error)
{
    if ((unsigned)o->mode > RT_MODE_DEPTH)
        return rt_fail_field(error, RT_ERROR_USAGE, "mode", "there is no mode %d", (int)o->mode);
    if ((unsigned)o->sampler > RT_SAMPLER_INDEPENDENT)
        return rt_fail_field(error, RT_ERROR_USAGE, "sampler", "there is no sampler %d",
                             (int)o->sampler);
    if ((unsigned)o->filter > RT_FILTER_MITCHELL)
        return rt_fail_field(error, RT_ERROR_USAGE, "filter", "there is no filter %d",
                             (int)o->filter);
    if ((unsigned)o->estimator > RT_ESTIMATOR_BSDF)
        return rt_fail_field(error, RT_ERROR_USAGE, "estimator", "there is no estimator %d",
                             (int)o->estimator);
    if ((unsigned)o->kernel > RT_DENSITY_GAUSSIAN_JENSEN)
        return rt_fail_field(error, RT_ERROR_USAGE, "kernel", "there is no density kernel %d",
                             (int)o->kernel);
    if ((unsigned)o->caustic_kernel > RT_DENSITY_GAUSSIAN_JENSEN)
        return rt_fail_field(error, RT_ERROR_USAGE, "caustic_kernel",
                             "there is no density kernel %d", (int)o->caustic_kernel);
    if ((unsigned)o->area > RT_AREA_HULL)
        return rt_fail_field(error, RT_ERROR_USAGE, "area", "there is no area %d", (int)o->area);
    if ((unsigned)o->gather > RT_GATHER_DEVICE)
        return rt_fail_field(error, RT_ERROR_USAGE, "gather", "there is no way %d to gather",
                             (int)o->gather);
    if ((unsigned)o->direct > RT_DIRECT_PHOTONS)
        return rt_fail_field(error, RT_ERROR_USAGE, "direct", "there is no direct mode %d",
                             (int)o->direct);
    return RT_OK;
}

rt_status rt_options_check(const rt_render_options *options, rt_error *error)
{
    rt_status status = check_enums(options, error);
    if (status == RT_OK)
        status = check_film(options, error);
    return status == RT_OK ? check_photons(options, error) : status;
}
