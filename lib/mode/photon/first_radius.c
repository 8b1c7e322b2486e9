/* first_radius.c - the pixels' own first radii, from distances of the k-th photon. */
#include "mode/photon/first_radius.h"

#include <math.h>

#include "base/memory.h"

int rt_photon_render_seen_by_pixels(const rt_photon_render *r, rt_query query)
{
    return query == RT_QUERY_EARLIER || r->job->options->final_gather == 0;
}

/* The mean distance, from squares; 0 when there are none. */
static double mean_distance(const float *squared, size_t pixels)
{
    double sum = 0;
    size_t found = 0;
    for (size_t i = 0; i < pixels; i++) {
        sum += sqrt(squared[i]);
        found += squared[i] > 0;
    }
    return found ? sum / (double)found : 0;
}

/* The median of up to nine values, which it sorts; of an even number, the upper one. */
static float median(float *values, int count)
{
    for (int i = 1; i < count; i++)
        for (int j = i; j > 0 && values[j] < values[j - 1]; j--) {
            float smaller = values[j];
            values[j] = values[j - 1];
            values[j - 1] = smaller;
        }
    return values[count / 2];
}

/*
 * Turns the squared distances of the k-th photon, of each pixel, into limits: the median of a pixel
 * and its eight neighbours, since behind glass the samples of a pixel may lie far apart. None is
 * above the mean, which also stands where a distance is missing.
 */
static void limit_radii(float *limits, const float *squared, uint32_t width, uint32_t height,
                        double mean)
{
    const float most = (float)(mean * mean);
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            float around[9];
            int count = 0;
            for (uint32_t v = y - (y > 0); v <= y + (y + 1 < height); v++)
                for (uint32_t u = x - (x > 0); u <= x + (x + 1 < width); u++) {
                    const float near = squared[(size_t)v * width + u];
                    around[count++] = near > 0 && near < most ? near : most;
                }
            limits[(size_t)y * width + x] = median(around, count);
        }
}

rt_status rt_photon_render_choose_radius(rt_photon_render *r, rt_query query, uint32_t sample,
                                         rt_stage_progress *progress, rt_error *error)
{
    const rt_render_options *o = r->job->options;
    rt_gather_options nearest = r->options[query];
    size_t pixels = rt_film_pixels(r->job->film);
    float *squared = rt_memory_zeroed(r->job->renderer->device->memory, pixels, 2 * sizeof *squared,
                                      "the list of gather radii", error);
    if (!squared)
        return RT_ERROR_MEMORY;
    float *limits = squared + pixels;

    /* Find the nearest photons of each pixel. */
    nearest.max_radius = 0;
    nearest.k = query == RT_QUERY_GLOBAL ? o->k : o->caustic_k;
    rt_status status = rt_photon_render_open(r, query, &nearest, error);
    if (status == RT_OK)
        status =
            rt_eye_paths_radii(&r->eye_paths, &r->queries, query, sample, squared, progress, error);
    rt_gatherer_destroy(r->queries.gatherers[query]);
    r->queries.gatherers[query] = NULL;
    /* The distances of the k nearest take much room, and passes need none. */
    rt_tree_place_release(&r->places[query][0], r->job->renderer->device);

    /* Keep the mean, and the radii of the pixels where these are meaningful. */
    const double mean = mean_distance(squared, pixels);
    if (status == RT_OK && mean > 0 && rt_photon_render_seen_by_pixels(r, query)) {
        limit_radii(limits, squared, o->width, o->height, mean);
        status =
            rt_buffer_create(r->job->renderer->device, r->first_radii + query, CL_MEM_READ_WRITE,
                             pixels * sizeof *limits, limits, "the buffer of gather radii", error);
    }
    rt_memory_free(squared);
    if (status == RT_OK && mean > 0) {
        r->first_radius[query] = mean;
        rt_log(o->hooks, "first radius of the %s photons: %s%g m",
               query == RT_QUERY_GLOBAL ? "global" : "caustic",
               r->first_radii[query] ? "each pixel's own, at most " : "", mean);
    }
    return status;
}
