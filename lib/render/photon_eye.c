#include "render/photon_eye.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

rt_status rt_eye_kernels_prepare(rt_eye_kernels *out, const rt_renderer *renderer, int on_device,
                                 rt_stage_progress *progress, rt_error *error)
{
    rt_device *device = renderer->device;
    cl_mem any = renderer->scene; /* stands for all buffers that are not touched yet */
    const char *name = on_device ? "gather_tree" : "gather_neighbours";
    rt_params params;
    rt_density_params estimate;
    rt_photon_tree tree;
    rt_u32 stride = 0;
    memset(&params, 0, sizeof params);
    memset(&estimate, 0, sizeof estimate);
    memset(&tree, 0, sizeof tree);
    rt_arg camera[] = {RT_ARG(params), RT_ARG(any), RT_ARG(any), RT_ARG(any), RT_ARG(stride)};
    rt_arg gather[] = {RT_ARG(params), RT_ARG(estimate), RT_ARG(any),
                       RT_ARG(any),    RT_ARG(any),      RT_ARG(any)};
    rt_arg walk[] = {RT_ARG(params), RT_ARG(estimate), RT_ARG(any), RT_ARG(any), RT_ARG(tree),
                     RT_ARG(any),    RT_ARG(any),      RT_ARG(any), RT_ARG(any)};
    rt_arg film[] = {RT_ARG(params), RT_ARG(any), RT_ARG(any), RT_ARG(stride), RT_ARG(any)};

    memset(out, 0, sizeof *out);
    rt_status status = rt_kernel_prepare(device, &out->camera, "photon_camera", "photon_camera",
                                         camera, 5, progress, error);
    if (status == RT_OK)
        status = rt_kernel_prepare(device, &out->gather, name, name, on_device ? walk : gather,
                                   on_device ? 9 : 6, progress, error);
    if (status == RT_OK)
        status = rt_kernel_prepare(device, &out->film, "photon_film", "photon_film", film, 5,
                                   progress, error);
    return status;
}

void rt_eye_kernels_release(rt_eye_kernels *kernels)
{
    rt_kernel_release(kernels->camera);
    rt_kernel_release(kernels->gather);
    rt_kernel_release(kernels->film);
    memset(kernels, 0, sizeof *kernels);
}

static rt_status create_layers(rt_photon_eye *eye, size_t pixels, rt_error *error)
{
    if (!eye->options->photon_layers)
        return RT_OK;
    eye->host_points = malloc((1 + eye->rows) * eye->capacity * sizeof *eye->host_points);
    if (!eye->host_points)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory for the layers of %zu points",
                       eye->capacity);
    rt_status status =
        rt_photon_bias_create(&eye->bias, eye->renderer->device, eye->capacity, eye->rows, error);
    return status == RT_OK ? rt_photon_layers_create(&eye->layers, pixels, error) : status;
}

rt_status rt_photon_eye_create(rt_photon_eye *eye, rt_renderer *renderer,
                               const rt_render_options *options, const rt_eye_kernels *kernels,
                               rt_aov *aov, const rt_film *film, rt_error *error)
{
    rt_device *device = renderer->device;
    size_t pixels = (size_t)options->width * options->height;
    memset(eye, 0, sizeof *eye);
    eye->renderer = renderer;
    eye->options = options;
    eye->kernels = *kernels;
    eye->aov = aov;
    eye->rows =
        options->final_gather < options->max_depth ? options->final_gather : options->max_depth;
    eye->capacity = RT_GATHER_POINTS_MAX / (1 + eye->rows);
    if (pixels < eye->capacity)
        eye->capacity = pixels;

    size_t bytes = eye->capacity * sizeof(rt_gather_point);
    eye->discs = malloc(2 * eye->capacity * sizeof *eye->discs);
    if (!eye->discs)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory to gather at %zu points", eye->capacity);
    eye->way_discs = eye->discs + eye->capacity;
    rt_status status = rt_buffer_create(device, &eye->points, CL_MEM_READ_WRITE, bytes, NULL,
                                        "gather points", error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &eye->caustics, CL_MEM_READ_WRITE, eye->rows * bytes,
                                  NULL, "gather points of caustics", error);
    if (status == RT_OK)
        status = create_layers(eye, pixels, error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &eye->pixels, CL_MEM_READ_WRITE,
                                  pixels * sizeof *film->pixels, film->pixels, "the film", error);
    return status;
}

void rt_photon_eye_release(rt_photon_eye *eye)
{
    rt_buffer_release(eye->points);
    rt_buffer_release(eye->caustics);
    rt_buffer_release(eye->pixels);
    free(eye->discs);
    free(eye->layers);
    free(eye->host_points);
    rt_photon_bias_release(&eye->bias);
    memset(eye, 0, sizeof *eye);
}

/* Follows one eye path of each of params->item_count pixels. */
static rt_status follow_paths(rt_photon_eye *eye, rt_params *params, rt_error *error)
{
    rt_u32 stride = (rt_u32)eye->capacity;
    rt_arg args[] = {{sizeof *params, params},
                     RT_ARG(eye->renderer->scene),
                     RT_ARG(eye->points),
                     RT_ARG(eye->caustics),
                     RT_ARG(stride)};
    params->final_gather = eye->rows;
    rt_status status = rt_kernel_args(eye->kernels.camera, args, sizeof args / sizeof *args, error);
    return status == RT_OK
               ? rt_launch(eye->renderer->device, eye->kernels.camera, params->item_count, error)
               : status;
}

/* Adds a batch that was gathered for to the layers. */
static rt_status add_to_layers(rt_photon_eye *eye, const rt_eye_maps *maps, size_t count,
                               rt_error *error)
{
    rt_gather_point *points = eye->host_points, *caustics = points + eye->capacity;
    size_t row = eye->capacity * sizeof *points;
    if (!eye->layers)
        return RT_OK;
    if (!maps->global)
        memset(eye->discs, 0, count * sizeof *eye->discs);
    rt_status status = rt_buffer_read(eye->renderer->device, eye->points, 0, count * sizeof *points,
                                      points, error);
    if (status == RT_OK)
        status = rt_buffer_read(eye->renderer->device, eye->caustics, 0, eye->rows * row, caustics,
                                error);
    if (status == RT_OK)
        rt_photon_layers_add(eye->layers, points, eye->discs, eye->bias.sums, count, caustics,
                             eye->rows, eye->capacity);
    return status;
}

/* Counts the points that asked; caustic: what they found in a second list, or NULL. */
static void count_ends(const rt_gather_disc *discs, const rt_gather_disc *caustic, size_t count,
                       rt_film_stats *stats)
{
    for (size_t i = 0; i < count; i++) {
        stats->gathers += discs[i].asked;
        stats->gathers_at_ends += discs[i].asked;
        stats->gathers_empty +=
            discs[i].asked && discs[i].count == 0 && !(caustic && caustic[i].count > 0);
    }
}

static void count_asked(const rt_gather_disc *discs, size_t count, uint64_t *asked)
{
    for (size_t i = 0; i < count; i++)
        *asked += discs[i].asked;
}

/* Asks one map at the points of a row, and for the layers a finer one as well. */
static rt_status ask_map(rt_photon_eye *eye, rt_gatherer *map, const rt_finer *finer, cl_mem points,
                         size_t first, size_t row, size_t count, rt_gather_disc *discs,
                         rt_error *error)
{
    if (eye->layers)
        return rt_photon_bias_add(&eye->bias, map, finer, points, first, row, count, discs, error);
    return rt_gatherer_add(map, points, first, count, discs, error);
}

/* Of rt_photon_eye_sample. */
typedef struct sampling {
    const rt_eye_maps *maps;
    const rt_finer_maps *finer;
    rt_film_stats *stats;
} sampling;

/*
 * Asks all maps for the photons of a batch. A point counts as asked once, however many lists there
 * are.
 */
static rt_status ask(rt_photon_eye *eye, const sampling *s, size_t count, rt_error *error)
{
    const rt_eye_maps *maps = s->maps;
    const rt_finer_maps *finer = s->finer;
    rt_status status = RT_OK;
    if (eye->layers)
        status = rt_photon_bias_begin(&eye->bias, eye->points, eye->caustics, count, error);
    if (status == RT_OK && maps->global)
        status =
            ask_map(eye, maps->global, &finer->global, eye->points, 0, 0, count, eye->discs, error);
    if (status == RT_OK && maps->caustic)
        status = ask_map(eye, maps->caustic, &finer->caustic, eye->points, 0, 0, count,
                         eye->way_discs, error);
    if (status == RT_OK && maps->global)
        count_ends(eye->discs, maps->caustic ? eye->way_discs : NULL, count, s->stats);
    for (rt_u32 row = 0; row < eye->rows && maps->on_the_way && status == RT_OK; row++) {
        status = ask_map(eye, maps->on_the_way, &finer->on_the_way, eye->caustics,
                         row * eye->capacity, 1 + row, count, eye->way_discs, error);
        if (status == RT_OK)
            count_asked(eye->way_discs, count, &s->stats->gathers);
    }
    return status;
}

static rt_status add_to_film(rt_photon_eye *eye, const rt_params *params, rt_error *error)
{
    rt_u32 stride = (rt_u32)eye->capacity;
    rt_arg args[] = {{sizeof *params, params},
                     RT_ARG(eye->points),
                     RT_ARG(eye->caustics),
                     RT_ARG(stride),
                     RT_ARG(eye->pixels)};
    rt_status status = rt_kernel_args(eye->kernels.film, args, sizeof args / sizeof *args, error);
    return status == RT_OK
               ? rt_launch(eye->renderer->device, eye->kernels.film, params->item_count, error)
               : status;
}

/* The smallest batch of those in use. */
static size_t batch_size(const rt_photon_eye *eye, const rt_eye_maps *maps)
{
    const rt_gatherer *all[] = {maps->global, maps->caustic, maps->on_the_way};
    size_t batch = eye->capacity;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i] && rt_gatherer_capacity(all[i]) < batch)
            batch = rt_gatherer_capacity(all[i]);
    return batch;
}

/* What is done with a batch of eye paths that were followed. */
typedef rt_status batch_work(rt_photon_eye *eye, const rt_params *params, void *data,
                             rt_error *error);

/*
 * Follows the eye paths of one sample of every pixel, a batch at a time, and does the work on each.
 */
static rt_status each_batch(rt_photon_eye *eye, const rt_eye_maps *maps, uint32_t sample,
                            batch_work *work, void *data, rt_stage_progress *progress,
                            rt_error *error)
{
    uint32_t pixels = eye->options->width * eye->options->height;
    size_t batch = batch_size(eye, maps);
    rt_params params = rt_params_make(eye->options);
    rt_status status = RT_OK;

    params.first_sample = sample;
    params.sample_count = 1;
    params.replicate = eye->replicate;
    for (uint32_t done = 0; done < pixels && status == RT_OK; done += params.item_count) {
        params.first_item = done;
        params.item_count = pixels - done < batch ? pixels - done : (uint32_t)batch;
        status = follow_paths(eye, &params, error);
        if (status == RT_OK)
            status = work(eye, &params, data, error);
        if (status == RT_OK)
            status = rt_stage_update(progress, (double)(done + params.item_count) / pixels);
    }
    return status;
}

/* Asks the maps, and adds what comes of it to the film and its layers. */
static rt_status add_batch(rt_photon_eye *eye, const rt_params *params, void *data, rt_error *error)
{
    const sampling *s = data;
    rt_status status = ask(eye, s, params->item_count, error);
    if (status == RT_OK)
        status = add_to_layers(eye, s->maps, params->item_count, error);
    if (status == RT_OK)
        status = add_to_film(eye, params, error);
    if (status == RT_OK)
        status = rt_aov_add(eye->aov, eye->renderer, params, error);
    return status;
}

rt_status rt_photon_eye_sample(rt_photon_eye *eye, const rt_eye_maps *maps,
                               const rt_finer_maps *finer, uint32_t sample, rt_film_stats *stats,
                               rt_stage_progress *progress, rt_error *error)
{
    sampling s = {maps, finer, stats};
    return each_batch(eye, maps, sample, add_batch, &s, progress, error);
}

/* Of rt_photon_eye_radii. */
typedef struct radii {
    rt_gatherer *gatherer;
    cl_mem points;
    float *squared;
} radii;

/* Notes the squared radii of the discs at the points of a batch, by pixel. */
static rt_status note_radii(rt_photon_eye *eye, const rt_params *params, void *data,
                            rt_error *error)
{
    const radii *r = data;
    rt_status status =
        rt_gatherer_add(r->gatherer, r->points, 0, params->item_count, eye->discs, error);
    for (uint32_t i = 0; i < params->item_count && status == RT_OK; i++)
        r->squared[eye->discs[i].pixel] =
            eye->discs[i].count > 0 ? eye->discs[i].squared_radius : 0;
    return status;
}

rt_status rt_photon_eye_radii(rt_photon_eye *eye, rt_gatherer *gatherer, int on_the_way,
                              uint32_t sample, float *squared, rt_stage_progress *progress,
                              rt_error *error)
{
    rt_eye_maps maps = {gatherer, NULL, NULL};
    radii r = {gatherer, on_the_way ? eye->caustics : eye->points, squared};
    return each_batch(eye, &maps, sample, note_radii, &r, progress, error);
}

rt_status rt_photon_eye_read(const rt_photon_eye *eye, rt_film *film, rt_error *error)
{
    size_t bytes = (size_t)eye->options->width * eye->options->height * sizeof *film->pixels;
    rt_status status =
        rt_buffer_read(eye->renderer->device, eye->pixels, 0, bytes, film->pixels, error);
    return status == RT_OK && eye->layers ? rt_photon_layers_resolve(film, eye->layers, error)
                                          : status;
}
