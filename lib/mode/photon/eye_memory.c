/* eye_memory.c - the memory of a batch of eye paths, and the film on the device. */
#include <string.h>

#include "base/memory.h"
#include "mode/photon/eye_paths.h"

/* The shortest batch, where there is little memory. */
enum { LEAST_BATCH = 64 };

static const char what[] = "a batch of eye paths";

static rt_status create_layers(rt_eye_paths *paths, rt_error *error)
{
    if (!paths->job->options->photon_layers)
        return RT_OK;
    rt_device *device = paths->job->renderer->device;
    paths->host_points = rt_memory_alloc(device->memory, (1 + paths->rows) * paths->capacity,
                                         sizeof *paths->host_points, what, error);
    if (!paths->host_points)
        return RT_ERROR_MEMORY;
    paths->sums = paths->pass_sums ? paths->pass_sums : paths->job->film->photon_sums;
    return rt_photon_bias_create(&paths->bias, device, paths->capacity, paths->rows, error);
}

/* In passes, the samples of one go to an empty film of one plane; else straight to the film. */
static rt_status create_film(rt_eye_paths *paths, rt_error *error)
{
    rt_film *film = paths->job->film;
    const size_t pixels = rt_film_pixels(film), bytes = pixels * sizeof *film->pixels;
    static const char pass[] = "the film of a pass";
    rt_status status = rt_mirror_create(paths->device, &paths->film, rt_film_bytes(film),
                                        film->pixels, "the film", error);
    paths->pixels = paths->film;
    if (status != RT_OK || !film->units.in_passes)
        return status;
    paths->pixels = NULL;
    if (film->photon_sums) {
        paths->pass_sums =
            rt_memory_zeroed(paths->device->memory, pixels, sizeof *paths->pass_sums, pass, error);
        if (!paths->pass_sums)
            return RT_ERROR_MEMORY;
    }
    status = rt_buffer_create(paths->device, &paths->pixels, CL_MEM_READ_WRITE, bytes, NULL, pass,
                              error);
    if (status == RT_OK)
        status = rt_buffer_clear(paths->device, paths->pixels, bytes, error);
    return status == RT_OK
               ? rt_pass_moments_create(&paths->moments, paths->device, paths->kernels.moments,
                                        film, paths->capacity, paths->rows, error)
               : status;
}

size_t rt_eye_paths_runs(size_t points)
{
    return (points + RT_SUM_RUN - 1) / RT_SUM_RUN;
}

static rt_status create_buffers(rt_eye_paths *paths, rt_error *error)
{
    rt_device *device = paths->job->renderer->device;
    size_t bytes = paths->capacity * sizeof(rt_gather_point);
    rt_status status = rt_buffer_create(device, &paths->points, CL_MEM_READ_WRITE, bytes, NULL,
                                        "the buffer of gather points", error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &paths->earlier, CL_MEM_READ_WRITE, paths->rows * bytes,
                                  NULL, "the buffer of caustic gather points", error);
    if (status == RT_OK)
        status =
            rt_buffer_create(device, &paths->counts, CL_MEM_READ_WRITE,
                             2 * rt_eye_paths_runs(paths->capacity) * sizeof *paths->host_counts,
                             NULL, "the counts of queries", error);
    if (status == RT_OK)
        status = create_film(paths, error);
    return status == RT_OK ? create_layers(paths, error) : status;
}

static rt_status create_memory(rt_eye_paths *paths, rt_error *error)
{
    paths->discs = rt_memory_alloc(paths->device->memory, paths->capacity, 2 * sizeof *paths->discs,
                                   what, error);
    if (!paths->discs)
        return RT_ERROR_MEMORY;
    paths->more_discs = paths->discs + paths->capacity;
    paths->host_counts = rt_memory_alloc(paths->device->memory, rt_eye_paths_runs(paths->capacity),
                                         2 * sizeof *paths->host_counts, what, error);
    if (!paths->host_counts)
        return RT_ERROR_MEMORY;
    return create_buffers(paths, error);
}

static void release_memory(rt_eye_paths *paths)
{
    rt_buffer_release(paths->device, paths->points);
    rt_buffer_release(paths->device, paths->earlier);
    if (paths->pixels != paths->film)
        rt_buffer_release(paths->device, paths->pixels);
    rt_buffer_release(paths->device, paths->film);
    rt_buffer_release(paths->device, paths->counts);
    paths->points = paths->earlier = paths->pixels = paths->film = paths->counts = NULL;
    rt_memory_free(paths->discs);
    rt_memory_free(paths->host_counts);
    rt_memory_free(paths->pass_sums);
    rt_memory_free(paths->host_points);
    paths->discs = paths->more_discs = NULL;
    paths->sums = paths->pass_sums = NULL;
    paths->host_counts = NULL;
    paths->host_points = NULL;
    rt_photon_bias_release(&paths->bias);
    rt_pass_moments_release(&paths->moments);
}

/* Where no rough lobe can split a path, all of them are whole. */
static rt_u32 split_of(const rt_render_job *job)
{
    return job->renderer->has_rough_specular ? job->options->split : 1;
}

/* With shorter batches where there is not enough memory. */
rt_status rt_eye_paths_create(rt_eye_paths *paths, const rt_render_job *job,
                              const rt_eye_kernels *kernels, rt_error *error)
{
    const rt_render_options *o = job->options;
    size_t pixels = rt_film_pixels(job->film);
    memset(paths, 0, sizeof *paths);
    paths->job = job;
    paths->device = job->renderer->device;
    paths->kernels = *kernels;
    paths->rows = o->final_gather < o->max_depth ? o->final_gather : o->max_depth;
    paths->split = split_of(job);
    size_t batch = rt_gather_points_max(paths->device) / (1 + paths->rows) / paths->split;
    if (pixels < batch)
        batch = pixels;
    paths->capacity = batch * paths->split;
    rt_status status = create_memory(paths, error);
    while (status == RT_ERROR_MEMORY && paths->capacity > LEAST_BATCH && batch > 1) {
        release_memory(paths);
        batch /= 2;
        paths->capacity = batch * paths->split;
        status = create_memory(paths, error);
    }
    return status;
}

void rt_eye_paths_release(rt_eye_paths *paths)
{
    if (paths->device)
        rt_device_settle(paths->device); /* it may work on the film in place */
    release_memory(paths);
    memset(paths, 0, sizeof *paths);
}
