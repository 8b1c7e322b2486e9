/* iteration.c - launches the kernels of an iteration, batch by batch, and those of the pilot. */
#include "mode/vcm/iteration.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "mode/vcm/own_radii.h"

int rt_vcm_uses_merging(const rt_vcm *v)
{
    return (rt_vcm_techniques(v->job->options->techniques) & RT_TECHNIQUE_MERGING) != 0;
}

/* ---- An iteration ------------------------------------------------------------- */

/*
 * The light paths of an iteration are the next ones of a seed, and when its numbers are used up, of
 * another. Where the error is estimated, iterations take turns at replicates, each with seeds of
 * its own.
 */
static rt_vcm_params params_of(rt_vcm *v, uint32_t number)
{
    const rt_render_options *o = v->job->options;
    const uint64_t paths = rt_film_pixels(v->job->film);
    const double squared_factor = rt_shrink_after(&v->shrink, number, 0, o->alpha);
    const uint64_t iterations_a_seed = (UINT64_C(1) << 32) / paths;
    const uint32_t replicates = v->job->film->units.replicates, turn = number / replicates;
    const uint32_t seeds_before =
        (uint32_t)(turn / iterations_a_seed) * replicates + number % replicates;
    return (rt_vcm_params){
        .techniques = rt_vcm_techniques(o->techniques),
        .shown = rt_vcm_shown(o),
        .light_paths = (rt_u32)paths,
        .light_seed = o->seed + seeds_before * 0x9e3779b9u,
        .first_path = (rt_u32)(turn % iterations_a_seed * paths),
        .slots = v->paths,
        .radius = rt_vcm_uses_merging(v) ? (float)(v->radius * sqrt(squared_factor)) : 0,
        .is_packed = rt_vcm_merges(v->job->options),
        .unit = v->unit,
        .own_factor = v->own ? (float)squared_factor : 0,
        .is_measured = v->moments.sums && rt_merge_is_measured(number),
    };
}

static rt_status follow_light_paths(rt_vcm *v, const rt_params *params, const rt_vcm_params *vcm,
                                    rt_error *error)
{
    rt_u32 pixels = (rt_u32)rt_film_pixels(v->job->film);
    rt_arg light[] = {{sizeof *params, params}, RT_ARG(v->job->renderer->scene),
                      {sizeof *vcm, vcm},       RT_ARG(v->shares),
                      RT_ARG(v->vertices),      RT_ARG(v->counts),
                      RT_ARG(v->places),        RT_ARG(v->splats),
                      RT_ARG(v->heads)};
    rt_arg splat[] = {RT_ARG(pixels), RT_ARG(v->splats), RT_ARG(v->heads), RT_ARG(v->pass)};
    rt_status status = rt_run(v->device, v->light, light, 9, params->item_count, error);
    if (status == RT_OK && (vcm->shown & RT_TECHNIQUE_CAMERA))
        status = rt_run(v->device, v->splat, splat, 4, pixels, error);
    if (status == RT_OK && vcm->is_packed)
        status = rt_vertex_grid_add(&v->grid, v->vertices, v->counts, v->places, vcm->slots,
                                    params->first_item, params->item_count, error);
    return status;
}

/* queries: NULL, but where vcm->is_query */
static rt_status follow_camera_paths(const rt_vcm *v, const rt_params *params,
                                     const rt_vcm_params *vcm, cl_mem queries, rt_error *error)
{
    /* Buffers that are not read without merging. */
    const cl_mem none = v->counts;
    const cl_mem vertices = vcm->is_packed ? v->grid.list : v->vertices,
                 firsts = vcm->is_packed ? v->grid.firsts : none,
                 points = vcm->is_packed ? v->grid.order : none,
                 lights = vcm->is_packed ? v->grid.lights : none,
                 begins = vcm->is_packed ? v->grid.begins : none, own = v->own ? v->own : none,
                 parts = vcm->is_packed ? v->moments.parts : none;
    const cl_mem asked = queries ? queries : none;
    rt_arg camera[] = {{sizeof *params, params},
                       RT_ARG(v->job->renderer->scene),
                       {sizeof *vcm, vcm},
                       RT_ARG(v->shares),
                       RT_ARG(vertices),
                       RT_ARG(v->counts),
                       RT_ARG(firsts),
                       RT_ARG(points),
                       RT_ARG(lights),
                       RT_ARG(begins),
                       RT_ARG(own),
                       RT_ARG(parts),
                       RT_ARG(v->pass),
                       RT_ARG(asked)};
    return rt_run(v->device, v->camera, camera, 14, params->item_count, error);
}

/* Whether camera paths find light. */
static int needs_camera_paths(const rt_vcm_params *vcm)
{
    return (vcm->shown & ~RT_TECHNIQUE_CAMERA) != 0;
}

static rt_status add_black_samples(const rt_vcm *v, rt_error *error)
{
    rt_u32 pixels = (rt_u32)rt_film_pixels(v->job->film);
    rt_arg args[] = {RT_ARG(pixels), RT_ARG(v->pass)};
    return rt_run(v->device, v->black, args, 2, pixels, error);
}

/* Adds the film of an iteration to the render's, and its samples to the layers of the first hit. */
static rt_status end_iteration(rt_vcm *v, rt_u32 is_measured, rt_params *params, rt_error *error)
{
    rt_u32 pixels = (rt_u32)rt_film_pixels(v->job->film), plane = params->replicate;
    rt_arg args[] = {RT_ARG(pixels), RT_ARG(plane), RT_ARG(v->pass), RT_ARG(v->film)};
    rt_status status = is_measured ? rt_merge_moments_add(&v->moments, v->pass, error) : RT_OK;
    if (status == RT_OK)
        status = rt_run(v->device, v->join, args, 4, pixels, error);
    params->first_item = 0;
    params->item_count = pixels;
    if (status == RT_OK)
        status = rt_first_hit_layers_add(v->job->layers, params, error);
    return status == RT_OK ? rt_device_finish(v->device, error) : status;
}

/*
 * Longer batches leave less time in which cores wait for the last of them; shorter ones are sooner
 * at an end when the render is cancelled. What is rendered depends on neither.
 */
static void adapt_batch(rt_vcm *v, double seconds)
{
    static const double shortest = 0.05, longest = 0.2;
    enum { LEAST = 1 << 10 };
    if (seconds < shortest && v->batch <= v->paths / 2)
        v->batch *= 2;
    else if (seconds > longest && v->batch > LEAST)
        v->batch /= 2;
}

/*
 * The light paths of all pixels, or the camera paths, or for each batch the one and then the other.
 */
static rt_status follow_batches(rt_vcm *v, rt_params params, const rt_vcm_params *vcm, int light,
                                int camera, rt_stage_progress *progress, rt_error *error)
{
    const uint32_t pixels = (uint32_t)rt_film_pixels(v->job->film);
    rt_status status = RT_OK;
    for (uint32_t done = 0; done < pixels && status == RT_OK; done += params.item_count) {
        const double began = rt_clock();
        params.first_item = done;
        params.item_count = pixels - done < v->batch ? pixels - done : v->batch;
        rt_params of_light = params;
        of_light.replicate = 0; /* its seeds are other ones */
        if (light)
            status = follow_light_paths(v, &of_light, vcm, error);
        if (status == RT_OK && camera)
            status = follow_camera_paths(v, &params, vcm, NULL, error);
        if (status == RT_OK)
            status = rt_device_finish(v->device, error);
        if (params.item_count == v->batch) /* the last one of all may be shorter */
            adapt_batch(v, rt_clock() - began);
        if (status == RT_OK)
            status = rt_stage_update(progress, (double)(done + params.item_count) / pixels);
    }
    return status;
}

/* All light paths first, as each camera path is merged with them all. */
static rt_status follow_merging(rt_vcm *v, const rt_params *params, rt_vcm_params *vcm,
                                rt_stage_progress *progress, rt_error *error)
{
    const double from = progress->from, to = progress->to, middle = from + 0.3 * (to - from);
    rt_vertex_grid_begin(&v->grid);
    rt_stage_part(progress, from, middle);
    rt_status status = follow_batches(v, *params, vcm, 1, 0, progress, error);
    if (status == RT_OK)
        status = rt_vertex_grid_sort(&v->grid, v->job->renderer->scene, vcm, error);
    rt_stage_part(progress, middle, to);
    return status == RT_OK ? follow_batches(v, *params, vcm, 0, 1, progress, error) : status;
}

/* ---- Radii of pixels -------------------------------------------------------------- */

/* What one sample of each pixel sees, into queries. */
static rt_status find_queries(const rt_vcm *v, const rt_params *params, const rt_vcm_params *vcm,
                              cl_mem queries, rt_error *error)
{
    const uint32_t pixels = (uint32_t)rt_film_pixels(v->job->film);
    rt_params some = *params;
    rt_vcm_params asking = *vcm;
    rt_status status = RT_OK;
    asking.is_query = 1;
    asking.is_measured = 0;
    for (uint32_t done = 0; done < pixels && status == RT_OK; done += some.item_count) {
        some.first_item = done;
        some.item_count = pixels - done < v->paths ? pixels - done : v->paths;
        status = follow_camera_paths(v, &some, &asking, queries, error);
    }
    return status;
}

/* Light paths of a seed that no iteration has, and the radii by their vertices. */
static rt_status run_pilot(rt_vcm *v, rt_merge_query *found, cl_mem queries,
                           rt_stage_progress *progress, rt_error *error)
{
    const rt_render_options *o = v->job->options;
    rt_vcm_params vcm = params_of(v, 0);
    rt_params params = rt_params_make(o);
    rt_radii_search of = {.grid = &v->grid,
                          .scene = v->job->renderer->scene,
                          .queries = queries,
                          .found = found,
                          .pixels = (rt_u32)rt_film_pixels(v->job->film)};
    const char *const program = rt_vcm_camera_program(v->job);
    vcm.light_seed = ~o->seed;
    vcm.shown = RT_TECHNIQUE_MERGING;
    params.seed = ~o->seed;
    params.sample_count = 1;
    rt_vertex_grid_begin(&v->grid);
    rt_status status = follow_batches(v, params, &vcm, 1, 0, progress, error);
    if (status == RT_OK)
        status = rt_device_kernel(v->device, &of.radii, program, "vcm_radii", NULL, error);
    if (status == RT_OK)
        status =
            rt_device_kernel(v->device, &of.ask_lights, program, "vcm_light_queries", NULL, error);
    if (status == RT_OK)
        status = rt_own_radii_limit(&v->radius, &of, error);
    if (status == RT_OK)
        status = find_queries(v, &params, &vcm, queries, error);
    if (status == RT_OK)
        status = rt_own_radii_find(&v->own, &v->radius, &of, o->width, error);
    rt_kernel_release(of.radii);
    rt_kernel_release(of.ask_lights);
    return status;
}

rt_status rt_vcm_choose_radii(rt_vcm *v, rt_stage_progress *progress, rt_error *error)
{
    static const char what[] = "the radii of merging";
    const size_t pixels = rt_film_pixels(v->job->film);
    cl_mem queries = NULL;
    if (!rt_vcm_merges(v->job->options) || v->job->options->radius > 0)
        return RT_OK;
    rt_merge_query *found = rt_memory_alloc(v->device->memory, pixels, sizeof *found, what, error);
    rt_status status =
        found ? rt_mirror_create(v->device, &queries, pixels * sizeof *found, found, what, error)
              : RT_ERROR_MEMORY;
    rt_stage_part(progress, 0, 0);
    if (status == RT_OK)
        status = run_pilot(v, found, queries, progress, error);
    rt_buffer_release(v->device, queries);
    rt_memory_free(found);
    if (status == RT_OK)
        rt_log(v->job->options->hooks, "first radius of merging: %s%g m",
               v->own ? "each pixel's own, at most " : "", v->radius);
    return status;
}

/* ---- Iterations ------------------------------------------------------------------- */

/* Whether a technique that is shown joins light paths with the camera or with camera paths. */
static int needs_light_paths(const rt_vcm_params *vcm)
{
    const rt_u32 joins = RT_TECHNIQUE_CAMERA | RT_TECHNIQUE_CONNECTION | RT_TECHNIQUE_MERGING;
    return (vcm->shown & joins) != 0;
}

rt_status rt_vcm_iterate(rt_vcm *v, uint32_t number, rt_stage_progress *progress, rt_error *error)
{
    const uint32_t replicates = v->job->film->units.replicates;
    rt_vcm_params vcm = params_of(v, number);
    rt_params params = rt_params_make(v->job->options);
    params.replicate = number % replicates;
    params.first_sample = number / replicates;
    params.sample_count = 1;
    const int light = needs_light_paths(&vcm), camera = needs_camera_paths(&vcm);
    rt_status status = vcm.is_packed
                           ? follow_merging(v, &params, &vcm, progress, error)
                           : follow_batches(v, params, &vcm, light, camera, progress, error);
    if (status == RT_OK && !camera)
        status = add_black_samples(v, error);
    return status == RT_OK ? end_iteration(v, vcm.is_measured, &params, error) : status;
}

/* ---- The film ------------------------------------------------------------------- */

rt_status rt_vcm_read(const rt_vcm *v, rt_error *error)
{
    rt_film *film = v->job->film;
    rt_status status = rt_mirror_read(v->device, v->film, rt_film_bytes(film), film->pixels, error);
    if (status == RT_OK && v->moments.sums)
        status = rt_mirror_read(v->device, v->moments.sums, rt_film_moment_bytes(film),
                                film->moments, error);
    return status == RT_OK ? rt_first_hit_layers_read(v->job->layers, film, error) : status;
}

rt_status rt_vcm_write(const rt_vcm *v, rt_error *error)
{
    const rt_film *film = v->job->film;
    rt_status status =
        rt_mirror_write(v->device, v->film, rt_film_bytes(film), film->pixels, error);
    if (status == RT_OK && v->moments.sums)
        status = rt_mirror_write(v->device, v->moments.sums, rt_film_moment_bytes(film),
                                 film->moments, error);
    return status == RT_OK ? rt_first_hit_layers_write(v->job->layers, film, error) : status;
}
