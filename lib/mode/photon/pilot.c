/*
 * pilot.c - pilot passes: photons are counted in sectors of each pixel's disc and tested, or the
 * estimates of discs are compared with those of halves of them.
 */
#include "mode/photon/pilot.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "mode/photon/emission.h"
#include "mode/photon/first_radius.h"
#include "mode/photon/radius_choice.h"
#include "mode/photon/radius_test.h"

/* The number of the pilot's first pass: no render has so many of its own. */
enum { FIRST_PASS = 0x7fffff00 };

/*
 * Photons that a test needs. Chi-square of equal cells holds from 10 = N^2/n on for N photons in n
 * of them (Koehler, Larntz 1980); this is 72.
 */
enum { FEWEST = 3 * RT_RADIUS_SECTORS };

/*
 * Passes that radii are chosen for, however many a render takes: more can be added to a picture
 * later. The error changes little with this, and radii go on to shrink.
 */
enum { HORIZON = 256 };

static const char what[] = "the tests of gather radii";

/* What the pilot holds for each query, or NULL. */
typedef struct pilot {
    size_t item; /* bytes of a pixel's test, or trial */
    /* tests, or, where the least mean squared error is looked for, trials of each half */
    cl_mem tests[2][RT_QUERIES];
    cl_mem critical;
} pilot;

static int seeks_least_error(const rt_photon_render *r)
{
    return rt_radius_rule_of(r->job->options) == RT_RADIUS_MSE;
}

/*
 * How often the largest disc that is tried is to be halved for the first one: discs grow where no
 * radius is given, and the least mean squared error is looked for.
 */
static uint32_t larger_of(const rt_photon_render *r, rt_query query)
{
    return seeks_least_error(r) && r->options[query].max_radius == 0 ? RT_RADIUS_LARGER : 0;
}

static void release(pilot *p, rt_device *device)
{
    rt_device_settle(device);
    for (int i = 0; i < 2 * RT_QUERIES; i++)
        rt_buffer_release(device, p->tests[i / RT_QUERIES][i % RT_QUERIES]);
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

static rt_status make_critical(pilot *p, const rt_photon_render *r, rt_error *error)
{
    float critical[RT_RADIUS_LENGTHS];
    memcpy(critical, rt_radius_test_critical(rt_radius_rule_of(r->job->options)), sizeof critical);
    return rt_buffer_create(r->job->renderer->device, &p->critical, CL_MEM_READ_ONLY,
                            sizeof critical, critical, what, error);
}

static rt_status make_tests(cl_mem *out, const pilot *p, const rt_photon_render *r, rt_error *error)
{
    rt_device *device = r->job->renderer->device;
    const size_t bytes = rt_film_pixels(r->job->film) * p->item;
    rt_status status = rt_buffer_create(device, out, CL_MEM_READ_WRITE, bytes, NULL, what, error);
    return status == RT_OK ? rt_buffer_clear(device, *out, bytes, error) : status;
}

static rt_status begin(pilot *p, rt_photon_render *r, rt_error *error)
{
    const int halves = seeks_least_error(r) ? 2 : 1;
    p->item = seeks_least_error(r) ? sizeof(rt_radius_trial) : sizeof(rt_radius_test);
    rt_status status = seeks_least_error(r) ? RT_OK : make_critical(p, r, error);
    for (rt_query query = 0; query < RT_QUERIES && status == RT_OK; query++) {
        if (!rt_photon_render_list(r, query) || r->first_radius[query] == 0 ||
            !rt_photon_render_seen_by_pixels(r, query))
            continue;
        if (!r->first_radii[query])
            status = make_radii(r, query, error);
        for (int half = 0; half < halves && status == RT_OK; half++)
            status = make_tests(&p->tests[half][query], p, r, error);
    }
    return status;
}

/* Makes the gatherer of a query that is tested, with the largest disc that is tried. */
static rt_status open_query(rt_photon_render *r, rt_query query, rt_error *error)
{
    const float larger = (float)(1u << larger_of(r, query));
    rt_gather_options within = r->options[query];
    within.k = 0;
    within.max_radius = (float)r->first_radius[query] * sqrtf(larger);
    rt_status status = rt_photon_render_open(r, query, &within, error);
    if (status == RT_OK)
        rt_gatherer_limit_pixels(r->queries.gatherers[query], r->first_radii[query], larger);
    return status;
}

static rt_status open_queries(const pilot *p, rt_photon_render *r, rt_error *error)
{
    rt_status status = RT_OK;
    for (rt_query query = 0; query < RT_QUERIES && status == RT_OK; query++)
        if (p->tests[0][query] && rt_photon_render_list(r, query)->count > 0)
            status = open_query(r, query, error);
    return status;
}

static rt_status test(const pilot *p, rt_photon_render *r, rt_error *error)
{
    rt_device *device = r->job->renderer->device;
    const size_t pixels = rt_film_pixels(r->job->film);
    rt_u32 count = (rt_u32)pixels, rule = rt_radius_rule_of(r->job->options), fewest = FEWEST;
    rt_status status = RT_OK;
    for (rt_query query = 0; query < RT_QUERIES && status == RT_OK; query++) {
        rt_arg args[] = {
            RT_ARG(count),
            RT_ARG(rule),
            RT_ARG(fewest),
            RT_ARG(p->critical),
            RT_ARG(r->first_radii[query]),
            RT_ARG(p->tests[0][query]),
        };
        if (p->tests[0][query])
            status = rt_run(device, r->eye_kernels.test, args, 6, pixels, error);
    }
    return status == RT_OK ? rt_device_finish(device, error) : status;
}

/* Chooses the radii of a query by its trials. */
static rt_status choose_radii(const pilot *p, rt_photon_render *r, rt_query query, rt_error *error)
{
    rt_device *device = r->job->renderer->device;
    const rt_render_options *o = r->job->options;
    const size_t pixels = rt_film_pixels(r->job->film), bytes = pixels * p->item;
    const rt_radius_passes passes = {HORIZON, RT_PILOT_PASSES, o->alpha, larger_of(r, query)};
    float *squared = rt_memory_alloc(device->memory, pixels, sizeof *squared, what, error);
    rt_radius_trial *trials =
        squared ? rt_memory_alloc(device->memory, 2 * pixels, p->item, what, error) : NULL;
    const rt_radius_trial *const halves[2] = {trials, trials ? trials + pixels : NULL};
    cl_mem radii = r->first_radii[query];
    rt_status status = trials ? RT_OK : RT_ERROR_MEMORY;
    for (int i = 0; i < 2 && status == RT_OK; i++)
        status = rt_buffer_read(device, p->tests[i][query], 0, bytes, trials + i * pixels, error);
    if (status == RT_OK)
        status = rt_buffer_read(device, radii, 0, pixels * sizeof *squared, squared, error);
    if (status == RT_OK)
        status =
            rt_radius_choose(squared, halves, o->width, o->height, &passes, device->memory, error);
    if (status == RT_OK)
        status = rt_buffer_write(device, radii, 0, pixels * sizeof *squared, squared, error);
    r->first_radius[query] *= sqrt(1u << passes.larger);
    rt_memory_free(squared);
    rt_memory_free(trials);
    return status;
}

static rt_status choose_all(const pilot *p, rt_photon_render *r, rt_error *error)
{
    rt_status status = RT_OK;
    for (rt_query query = 0; query < RT_QUERIES && status == RT_OK; query++)
        if (p->tests[0][query])
            status = choose_radii(p, r, query, error);
    return status;
}

/* A pass of the pilot. */
static rt_status run_pass(pilot *p, rt_photon_render *r, uint32_t number,
                          rt_stage_progress *progress, rt_error *error)
{
    const uint32_t pass = FIRST_PASS + number, replicates = rt_photon_render_replicates(r);
    const int half = seeks_least_error(r) && number >= RT_PILOT_PASSES / 2;
    r->eye_paths.replicate = pass % replicates;
    rt_status status = rt_photon_render_emit(r, pass, progress, error);
    if (status == RT_OK)
        status = open_queries(p, r, error);
    if (status == RT_OK)
        status = rt_eye_paths_count_sectors(&r->eye_paths, &r->queries, p->tests[half],
                                            pass / replicates, progress, error);
    rt_queries_close(&r->queries);
    return status == RT_OK && !seeks_least_error(r) ? test(p, r, error) : status;
}

rt_status rt_pilot_run(rt_photon_render *r, rt_stage_progress *progress, rt_error *error)
{
    const double from = progress->from, to = progress->to;
    pilot p = {0, {{NULL}}, NULL};
    rt_status status = begin(&p, r, error);
    for (uint32_t i = 0; i < RT_PILOT_PASSES && status == RT_OK; i++) {
        rt_stage_part(progress, from + (to - from) * i / RT_PILOT_PASSES,
                      from + (to - from) * (i + 1) / RT_PILOT_PASSES);
        status = run_pass(&p, r, i, progress, error);
    }
    if (status == RT_OK && seeks_least_error(r))
        status = choose_all(&p, r, error);
    release(&p, r->job->renderer->device);
    return status;
}
