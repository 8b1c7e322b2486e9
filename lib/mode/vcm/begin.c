/* begin.c - the kernels of mode vcm, and the memory that iterations work in. */
#include "mode/vcm/iteration.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "render/prepare.h"

/* Light paths of a batch, at most and of the first on a CPU, and the memory of their vertices. */
enum { PATHS_CPU = 1 << 17, FIRST_CPU = 1 << 14, PATHS_GPU = 1 << 18, LEAST_PATHS = 64 };

/*
 * The first radius, in radii of the sphere around the scene, for as many light paths as a picture
 * of 512 x 512 pixels has; with others a disc is as large as to hold as many vertices, up to a
 * limit.
 */
static const double part_of_scene = 0.003, usual_paths = 512.0 * 512, most_of_scene = 0.02,
                    slow_of_scene = 0.2;

static const size_t vertex_bytes_cpu = (size_t)1 << 28, vertex_bytes_gpu = (size_t)1 << 29;

const char *rt_vcm_light_program(const rt_render_job *job)
{
    return job->renderer->has_dispersion        ? "vcm_light_dispersive"
           : job->renderer->has_shading_normals ? "vcm_light"
           : job->renderer->is_plain            ? "vcm_light_plain"
                                                : "vcm_light_faceted";
}

const char *rt_vcm_camera_program(const rt_render_job *job)
{
    return job->renderer->has_dispersion        ? "vcm_camera_dispersive"
           : job->renderer->has_shading_normals ? "vcm_camera"
           : job->renderer->is_plain            ? "vcm_camera_plain"
                                                : "vcm_camera_faceted";
}

rt_status rt_vcm_prepare(rt_vcm *v, rt_stage_progress *progress, rt_error *error)
{
    cl_mem any = v->job->renderer->scene; /* stands for all buffers that are not touched yet */
    rt_params params;
    rt_vcm_params vcm;
    memset(&params, 0, sizeof params);
    memset(&vcm, 0, sizeof vcm);
    rt_arg light[] = {RT_ARG(params), RT_ARG(any), RT_ARG(vcm), RT_ARG(any), RT_ARG(any),
                      RT_ARG(any),    RT_ARG(any), RT_ARG(any), RT_ARG(any)};
    rt_arg camera[] = {RT_ARG(params), RT_ARG(any), RT_ARG(vcm), RT_ARG(any), RT_ARG(any),
                       RT_ARG(any),    RT_ARG(any), RT_ARG(any), RT_ARG(any), RT_ARG(any),
                       RT_ARG(any),    RT_ARG(any), RT_ARG(any), RT_ARG(any)};
    rt_status status = rt_kernel_prepare(v->device, &v->light, rt_vcm_light_program(v->job),
                                         "vcm_light", light, 9, progress, error);
    if (status == RT_OK)
        status = rt_kernel_prepare(v->device, &v->camera, rt_vcm_camera_program(v->job),
                                   "vcm_camera", camera, 14, progress, error);
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
    v->batch = is_cpu && v->paths > FIRST_CPU ? FIRST_CPU : v->paths;
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

/* Warns of a radius with which camera vertices merge with a large part of all light vertices. */
static void warn_of_radius(const rt_vcm *v, double scene_radius, double usual)
{
    if (rt_vcm_merges(v->job->options) && v->radius > slow_of_scene * scene_radius)
        rt_warn(
            v->job->options->hooks,
            "a radius of %.3g m is %.3g of that of the scene, so that each camera vertex merges "
            "with a large part of %zu light paths, which is slow, and spreads their light over as "
            "wide a disc; the default is %.3g m",
            v->radius, v->radius / scene_radius, rt_film_pixels(v->job->film), usual);
}

/* The grid, and the radius of the first iteration. */
static rt_status create_merging(rt_vcm *v, double scene_radius, rt_error *error)
{
    rt_status status = RT_OK;
    if (rt_vcm_merges(v->job->options))
        status = rt_vertex_grid_create(&v->grid, v->device, rt_film_pixels(v->job->film), error);
    if (status == RT_OK && v->job->film->moments)
        status = rt_merge_moments_create(&v->moments, v->device, v->job->film, error);
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
    if (status == RT_OK && rt_vcm_uses_merging(v))
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
    rt_merge_moments_release(&v->moments);
    const cl_mem buffers[] = {v->shares, v->counts, v->heads, v->pass, v->film, v->own};
    const cl_kernel kernels[] = {v->light, v->camera, v->splat, v->black, v->join};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        rt_buffer_release(v->device, buffers[i]);
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++)
        rt_kernel_release(kernels[i]);
    rt_light_sources_free(&v->lights);
    memset(v, 0, sizeof *v);
}
