/* iteration.c - launches the kernels of an iteration, batch by batch. */
#include "mode/vcm/iteration.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "render/prepare.h"

/* Light paths of a batch, and the memory of their vertices. */
enum { PATHS_CPU = 1 << 14, PATHS_GPU = 1 << 18, LEAST_PATHS = 64 };

/*
 * The first radius, in radii of the sphere around the scene, for as many light paths as a picture
 * of 512 x 512 pixels has; with others a disc is as large as to hold as many vertices, up to a
 * limit.
 */
static const double part_of_scene = 0.003, usual_paths = 512.0 * 512, most_of_scene = 0.02,
                    slow_of_scene = 0.2;

static const size_t vertex_bytes_cpu = (size_t)1 << 26, vertex_bytes_gpu = (size_t)1 << 29;

rt_u32 rt_vcm_techniques(rt_techniques techniques)
{
    const rt_u32 path = RT_TECHNIQUE_EMISSION | RT_TECHNIQUE_NEE;
    switch (techniques) {
    case RT_TECHNIQUES_VCM:
        return path | RT_TECHNIQUE_CAMERA | RT_TECHNIQUE_CONNECTION | RT_TECHNIQUE_MERGING;
    case RT_TECHNIQUES_BPM:
        return RT_TECHNIQUE_EMISSION | RT_TECHNIQUE_MERGING;
    case RT_TECHNIQUES_BPT:
        return path | RT_TECHNIQUE_CAMERA | RT_TECHNIQUE_CONNECTION;
    case RT_TECHNIQUES_PT:
        return path;
    case RT_TECHNIQUES_EMISSION:
        return RT_TECHNIQUE_EMISSION;
    case RT_TECHNIQUES_NEE:
        return RT_TECHNIQUE_NEE;
    case RT_TECHNIQUES_CAMERA:
        return RT_TECHNIQUE_CAMERA;
    case RT_TECHNIQUES_CONNECTION:
        return RT_TECHNIQUE_CONNECTION;
    case RT_TECHNIQUES_MERGING:
        return RT_TECHNIQUE_MERGING;
    }
    return 0;
}

rt_u32 rt_vcm_shown(const rt_render_options *options)
{
    return rt_vcm_techniques(options->techniques) & rt_vcm_techniques(options->contribution);
}

/* ---- Kernels and memory ------------------------------------------------------ */

rt_status rt_vcm_prepare(rt_vcm *v, rt_stage_progress *progress, rt_error *error)
{
    cl_mem any = v->job->renderer->scene; /* stands for all buffers that are not touched yet */
    rt_params params;
    rt_vcm_params vcm;
    memset(&params, 0, sizeof params);
    memset(&vcm, 0, sizeof vcm);
    rt_arg light[] = {RT_ARG(params), RT_ARG(any), RT_ARG(vcm), RT_ARG(any), RT_ARG(any),
                      RT_ARG(any),    RT_ARG(any), RT_ARG(any), RT_ARG(any)};
    rt_arg camera[] = {RT_ARG(params), RT_ARG(any), RT_ARG(vcm), RT_ARG(any),
                       RT_ARG(any),    RT_ARG(any), RT_ARG(any), RT_ARG(any),
                       RT_ARG(any),    RT_ARG(any), RT_ARG(any)};
    rt_status status = rt_kernel_prepare(v->device, &v->light, "vcm_light", "vcm_light", light, 9,
                                         progress, error);
    if (status == RT_OK)
        status = rt_kernel_prepare(v->device, &v->camera, "vcm_camera", "vcm_camera", camera, 11,
                                   progress, error);
    if (status == RT_OK)
        status = rt_device_kernel(v->device, &v->splat, "vcm_film", "vcm_splat", NULL, error);
    if (status == RT_OK)
        status = rt_device_kernel(v->device, &v->black, "vcm_film", "vcm_black", NULL, error);
    if (status == RT_OK)
        status = rt_device_kernel(v->device, &v->join, "photon_film", "photon_join", NULL, error);
    return status;
}

static void release_batch(rt_vcm *v)
{
    rt_buffer_release(v->device, v->vertices);
    rt_buffer_release(v->device, v->places);
    rt_buffer_release(v->device, v->splats);
    v->vertices = v->places = v->splats = NULL;
}

static rt_status create_batch(rt_vcm *v, rt_error *error)
{
    static const char what[] = "the vertices of light paths";
    const size_t all = (size_t)v->slots * v->paths;
    rt_status status = rt_buffer_create(v->device, &v->vertices, CL_MEM_READ_WRITE,
                                        all * sizeof(rt_light_vertex), NULL, what, error);
    if (status == RT_OK)
        status = rt_buffer_create(v->device, &v->places, CL_MEM_READ_WRITE,
                                  rt_prefix_sum_room(v->paths) * sizeof(rt_u32), NULL, what, error);
    if (status == RT_OK)
        status = rt_buffer_create(v->device, &v->splats, CL_MEM_READ_WRITE, all * sizeof(rt_splat),
                                  NULL, what, error);
    if (status != RT_OK)
        release_batch(v);
    return status;
}

/* Makes batches as long as memory allows. */
static rt_status create_batches(rt_vcm *v, rt_error *error)
{
    const int is_cpu = v->device->info.is_cpu;
    const size_t pixels = rt_film_pixels(v->job->film);
    const size_t bytes = is_cpu ? vertex_bytes_cpu : vertex_bytes_gpu;
    size_t paths = is_cpu ? PATHS_CPU : PATHS_GPU;
    v->slots = v->job->options->max_depth > 1 ? v->job->options->max_depth - 1 : 1;
    while (paths > LEAST_PATHS &&
           (paths / 2 >= pixels || paths * v->slots * sizeof(rt_light_vertex) > bytes))
        paths /= 2;
    v->paths = (rt_u32)paths;
    rt_status status = create_batch(v, error);
    while (status == RT_ERROR_MEMORY && v->paths > LEAST_PATHS) {
        v->paths /= 2;
        status = create_batch(v, error);
    }
    return status;
}

static rt_status create_shares(rt_vcm *v, rt_error *error)
{
    rt_status status =
        rt_light_sources_read(&v->lights, v->device, v->job->renderer->scene, NULL, 0, error);
    if (status != RT_OK)
        return status;
    return rt_buffer_create(
        v->device, &v->shares, CL_MEM_READ_ONLY, v->lights.light_count * sizeof *v->lights.shares,
        v->lights.light_count ? v->lights.shares : NULL, "the table of light shares", error);
}

/* The film, that of an iteration, and the lists of splats, all empty. */
static rt_status create_film(rt_vcm *v, rt_error *error)
{
    rt_film *film = v->job->film;
    const size_t pixels = rt_film_pixels(film), bytes = pixels * sizeof *film->pixels;
    const size_t words = (pixels + 3) / 4 * 16; /* to be cleared, a multiple of 16 */
    static const char what[] = "the film of an iteration";
    rt_status status =
        rt_mirror_create(v->device, &v->film, rt_film_bytes(film), film->pixels, "the film", error);
    if (status == RT_OK)
        status = rt_buffer_create(v->device, &v->pass, CL_MEM_READ_WRITE, bytes, NULL, what, error);
    if (status == RT_OK)
        status = rt_buffer_clear(v->device, v->pass, bytes, error);
    if (status == RT_OK)
        status =
            rt_buffer_create(v->device, &v->heads, CL_MEM_READ_WRITE, words, NULL, what, error);
    if (status == RT_OK)
        status = rt_buffer_clear(v->device, v->heads, words, error);
    if (status == RT_OK)
        status =
            rt_buffer_create(v->device, &v->counts, CL_MEM_READ_WRITE, words, NULL, what, error);
    return status == RT_OK ? rt_buffer_clear(v->device, v->counts, words, error) : status;
}

/* Whether weights count merging, and whether its light is added. */
static int merges(const rt_vcm *v)
{
    return (rt_vcm_techniques(v->job->options->techniques) & RT_TECHNIQUE_MERGING) != 0;
}

static int shows_merging(const rt_vcm *v)
{
    return (rt_vcm_shown(v->job->options) & RT_TECHNIQUE_MERGING) != 0;
}

/* Warns of a radius with which camera vertices merge with a large part of all light vertices. */
static void warn_of_radius(const rt_vcm *v, double scene_radius, double usual)
{
    if (shows_merging(v) && v->radius > slow_of_scene * scene_radius)
        rt_warn(
            v->job->options->hooks,
            "a radius of %.3g m is %.3g of that of the scene, so that each camera vertex merges "
            "with a large part of %zu light paths, which is slow; the default is %.3g m",
            v->radius, v->radius / scene_radius, rt_film_pixels(v->job->film), usual);
}

/* The grid, and the radius of the first iteration. */
static rt_status create_merging(rt_vcm *v, double scene_radius, rt_error *error)
{
    rt_status status = RT_OK;
    if (shows_merging(v))
        status = rt_vertex_grid_create(&v->grid, v->device, rt_film_pixels(v->job->film), error);
    if (status != RT_OK)
        return status;
    const double paths = rt_film_pixels(v->job->film),
                 part = fmin(part_of_scene * sqrt(usual_paths / paths), most_of_scene),
                 usual = part * (scene_radius > 0 ? scene_radius : 1);
    v->radius = v->job->options->radius;
    if (v->radius > 0) {
        warn_of_radius(v, usual / part, usual);
        return RT_OK;
    }
    v->radius = usual;
    rt_log(v->job->options->hooks, "first radius of merging: %g m", v->radius);
    return RT_OK;
}

/* A power of two, by which no weight is rounded, and whose square and its inverse are floats. */
static float unit_of(float radius)
{
    const int exponent = radius > 0 ? ilogbf(radius) : 0;
    return ldexpf(1, exponent < -60 ? -60 : exponent > 60 ? 60 : exponent);
}

rt_status rt_vcm_begin(rt_vcm *v, rt_error *error)
{
    rt_scene_header header;
    rt_status status =
        rt_buffer_read(v->device, v->job->renderer->scene, 0, sizeof header, &header, error);
    if (status == RT_OK && header.material_count > RT_STORED_MATERIALS)
        return rt_fail(error, RT_ERROR_USAGE, "mode vcm knows %u materials at most, not %u",
                       RT_STORED_MATERIALS, header.material_count);
    if (status == RT_OK) {
        v->unit = unit_of(header.radius);
        status = create_shares(v, error);
    }
    if (status == RT_OK)
        status = create_film(v, error);
    if (status == RT_OK)
        status = create_batches(v, error);
    if (status == RT_OK && merges(v))
        status = create_merging(v, header.radius, error);
    v->work = rt_work_begin(v->job->film, v->job->options);
    v->work.profile = v->device->profile;
    return status;
}

void rt_vcm_free(rt_vcm *v)
{
    if (!v->device)
        return;
    rt_device_settle(v->device); /* it may work on the film in place */
    release_batch(v);
    rt_vertex_grid_release(&v->grid);
    const cl_mem buffers[] = {v->shares, v->counts, v->heads, v->pass, v->film};
    const cl_kernel kernels[] = {v->light, v->camera, v->splat, v->black, v->join};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        rt_buffer_release(v->device, buffers[i]);
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++)
        rt_kernel_release(kernels[i]);
    rt_light_sources_free(&v->lights);
    memset(v, 0, sizeof *v);
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
        .radius = merges(v) ? (float)(v->radius * sqrt(squared_factor)) : 0,
        .is_packed = shows_merging(v),
        .unit = v->unit,
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

static rt_status follow_camera_paths(const rt_vcm *v, const rt_params *params,
                                     const rt_vcm_params *vcm, rt_error *error)
{
    /* Buffers that are not read without merging. */
    const cl_mem none = v->counts;
    const cl_mem vertices = vcm->is_packed ? v->grid.list : v->vertices,
                 firsts = vcm->is_packed ? v->grid.firsts : none,
                 points = vcm->is_packed ? v->grid.order : none,
                 lights = vcm->is_packed ? v->grid.lights : none,
                 begins = vcm->is_packed ? v->grid.begins : none;
    rt_arg camera[] = {{sizeof *params, params}, RT_ARG(v->job->renderer->scene),
                       {sizeof *vcm, vcm},       RT_ARG(v->shares),
                       RT_ARG(vertices),         RT_ARG(v->counts),
                       RT_ARG(firsts),           RT_ARG(points),
                       RT_ARG(lights),           RT_ARG(begins),
                       RT_ARG(v->pass)};
    return rt_run(v->device, v->camera, camera, 11, params->item_count, error);
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
static rt_status end_iteration(const rt_vcm *v, rt_params *params, rt_error *error)
{
    rt_u32 pixels = (rt_u32)rt_film_pixels(v->job->film), plane = params->replicate;
    rt_arg args[] = {RT_ARG(pixels), RT_ARG(plane), RT_ARG(v->pass), RT_ARG(v->film)};
    rt_status status = rt_run(v->device, v->join, args, 4, pixels, error);
    params->first_item = 0;
    params->item_count = pixels;
    if (status == RT_OK)
        status = rt_first_hit_layers_add(v->job->layers, params, error);
    return status == RT_OK ? rt_device_finish(v->device, error) : status;
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
        params.first_item = done;
        params.item_count = pixels - done < v->paths ? pixels - done : v->paths;
        rt_params of_light = params;
        of_light.replicate = 0; /* its seeds are other ones */
        if (light)
            status = follow_light_paths(v, &of_light, vcm, error);
        if (status == RT_OK && camera)
            status = follow_camera_paths(v, &params, vcm, error);
        if (status == RT_OK)
            status = rt_device_finish(v->device, error);
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
    return status == RT_OK ? end_iteration(v, &params, error) : status;
}

/* ---- The film ------------------------------------------------------------------- */

rt_status rt_vcm_read(const rt_vcm *v, rt_error *error)
{
    rt_film *film = v->job->film;
    rt_status status = rt_mirror_read(v->device, v->film, rt_film_bytes(film), film->pixels, error);
    return status == RT_OK ? rt_first_hit_layers_read(v->job->layers, film, error) : status;
}

rt_status rt_vcm_write(const rt_vcm *v, rt_error *error)
{
    const rt_film *film = v->job->film;
    rt_status status =
        rt_mirror_write(v->device, v->film, rt_film_bytes(film), film->pixels, error);
    return status == RT_OK ? rt_first_hit_layers_write(v->job->layers, film, error) : status;
}
