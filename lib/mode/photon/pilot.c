/* pilot.c - pilot passes: photons are counted in sectors of each pixel's disc, and tested. */
#include "mode/photon/pilot.h"

#include <string.h>

#include "base/memory.h"
#include "mode/photon/emission.h"
#include "mode/photon/first_radius.h"
#include "mode/photon/radius_test.h"

/* The number of the pilot's first pass: no render has so many of its own. */
enum { FIRST_PASS = 0x7fffff00 };

/*
 * Photons that a test needs. Chi-square of equal cells holds from 10 = N^2/n on for N photons in n
 * of them (Koehler, Larntz 1980); this is 72.
 */
enum { FEWEST = 3 * RT_RADIUS_SECTORS };

static const char what[] = "the tests of gather radii";

/* What the pilot holds for each query, or NULL. */
typedef struct pilot {
    cl_mem tests[RT_QUERIES];
    cl_mem critical;
} pilot;

static void release(pilot *p, rt_device *device)
{
    rt_device_settle(device);
    for (int i = 0; i < RT_QUERIES; i++)
        rt_buffer_release(device, p->tests[i]);
    rt_buffer_release(device, p->critical);
}

/* Where a radius was given, it is each pixel's own from here on. */
static rt_status make_radii(rt_photon_render *r, rt_query query, rt_error *error)
{
    rt_device *device = r->job->renderer->device;
    const size_t pixels = rt_film_pixels(r->job->film);
    float *limits = rt_memory_alloc(device->memory, pixels, sizeof *limits, what, error);
    if (!limits)
        return RT_ERROR_MEMORY;
    for (size_t i = 0; i < pixels; i++)
        limits[i] = (float)(r->first_radius[query] * r->first_radius[query]);
    rt_status status =
        rt_buffer_create(device, r->first_radii + query, CL_MEM_READ_WRITE, pixels * sizeof *limits,
                         limits, "the buffer of gather radii", error);
    rt_memory_free(limits);
    return status;
}

static rt_status begin(pilot *p, rt_photon_render *r, rt_error *error)
{
    rt_device *device = r->job->renderer->device;
    const size_t bytes = rt_film_pixels(r->job->film) * sizeof(rt_radius_test);
    float critical[RT_RADIUS_LENGTHS];
    memcpy(critical, rt_radius_test_critical(r->job->options->radius_rule), sizeof critical);
    rt_status status = rt_buffer_create(device, &p->critical, CL_MEM_READ_ONLY, sizeof critical,
                                        critical, what, error);
    for (rt_query query = 0; query < RT_QUERIES && status == RT_OK; query++) {
        if (!rt_photon_render_list(r, query) || r->first_radius[query] == 0 ||
            !rt_photon_render_seen_by_pixels(r, query))
            continue;
        if (!r->first_radii[query])
            status = make_radii(r, query, error);
        if (status == RT_OK)
            status = rt_buffer_create(device, p->tests + query, CL_MEM_READ_WRITE, bytes, NULL,
                                      what, error);
        if (status == RT_OK)
            status = rt_buffer_clear(device, p->tests[query], bytes, error);
    }
    return status;
}

/* Makes the gatherers of the queries that are tested. */
static rt_status open_queries(const pilot *p, rt_photon_render *r, rt_error *error)
{
    rt_status status = RT_OK;
    for (rt_query query = 0; query < RT_QUERIES && status == RT_OK; query++) {
        rt_gather_options within = r->options[query];
        within.k = 0;
        within.max_radius = (float)r->first_radius[query];
        if (p->tests[query] && rt_photon_render_list(r, query)->count > 0)
            status = rt_photon_render_open(r, query, &within, error);
    }
    return status;
}

static rt_status test(const pilot *p, rt_photon_render *r, rt_error *error)
{
    rt_device *device = r->job->renderer->device;
    const size_t pixels = rt_film_pixels(r->job->film);
    rt_u32 count = (rt_u32)pixels, rule = r->job->options->radius_rule, fewest = FEWEST;
    rt_status status = RT_OK;
    for (rt_query query = 0; query < RT_QUERIES && status == RT_OK; query++) {
        rt_arg args[] = {
            RT_ARG(count),
            RT_ARG(rule),
            RT_ARG(fewest),
            RT_ARG(p->critical),
            RT_ARG(r->first_radii[query]),
            RT_ARG(p->tests[query]),
        };
        if (p->tests[query])
            status = rt_run(device, r->eye_kernels.test, args, 6, pixels, error);
    }
    return status == RT_OK ? rt_device_finish(device, error) : status;
}

rt_status rt_pilot_run(rt_photon_render *r, rt_stage_progress *progress, rt_error *error)
{
    const double from = progress->from, to = progress->to;
    const uint32_t replicates = rt_photon_render_replicates(r);
    pilot p = {{NULL}, NULL};
    rt_status status = begin(&p, r, error);
    for (uint32_t i = 0; i < RT_PILOT_PASSES && status == RT_OK; i++) {
        const uint32_t pass = FIRST_PASS + i;
        rt_stage_part(progress, from + (to - from) * i / RT_PILOT_PASSES,
                      from + (to - from) * (i + 1) / RT_PILOT_PASSES);
        r->eye_paths.replicate = pass % replicates;
        status = rt_photon_render_emit(r, pass, progress, error);
        if (status == RT_OK)
            status = open_queries(&p, r, error);
        if (status == RT_OK)
            status = rt_eye_paths_count_sectors(&r->eye_paths, &r->queries, p.tests, r->first_radii,
                                                pass / replicates, progress, error);
        rt_queries_close(&r->queries);
        if (status == RT_OK)
            status = test(&p, r, error);
    }
    release(&p, r->job->renderer->device);
    return status;
}
