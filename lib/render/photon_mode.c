/*
 * photon_mode.c - photon mapping: light paths fill a photon map, then eye paths ask it for the light
 * that arrives where they end.
 */
#include <string.h>

#include "error.h"
#include "photon/emit.h"
#include "photon/gather.h"
#include "render/layers.h"
#include "render/renderer.h"

/* A render under way. */
typedef struct photon_render {
    rt_renderer *renderer;
    const rt_render_options *options;
    rt_film *film;
    cl_kernel emit, camera, gather;
    rt_photon_map map;
    rt_gatherer *gatherer;
    cl_mem pixels; /* rt_film_pixel, the film on the device */
    rt_layers layers;
    double began;  /* of emission, for options->time */
    rt_error error; /* of the search tree's thread */
} photon_render;

/* Builds the three kernels; the scene stands for all buffers that they do not touch yet. */
static rt_status compile(photon_render *r, rt_error *error)
{
    rt_device *device = r->renderer->device;
    cl_mem any = r->renderer->scene;
    rt_stage_progress progress;
    rt_params params;
    rt_density_params estimate;
    memset(&params, 0, sizeof params);
    memset(&estimate, 0, sizeof estimate);
    rt_arg emit[] = {RT_ARG(params), RT_ARG(any), RT_ARG(any), RT_ARG(any)};
    rt_arg camera[] = {RT_ARG(params), RT_ARG(any), RT_ARG(any)};
    rt_arg gather[] = {RT_ARG(params), RT_ARG(any), RT_ARG(estimate), RT_ARG(any),
                       RT_ARG(any),    RT_ARG(any), RT_ARG(any),      RT_ARG(any)};

    rt_status status = rt_stage_begin(&progress, r->options->hooks, RT_STAGE_COMPILE);
    if (status == RT_OK)
        status = rt_kernel_prepare(device, &r->emit, "photon_emit", "photon_emit", emit, 4, &progress, error);
    if (status == RT_OK)
        status = rt_kernel_prepare(device, &r->camera, "photon_camera", "photon_camera", camera, 3, &progress, error);
    if (status == RT_OK)
        status = rt_kernel_prepare(device, &r->gather, "photon_gather", "photon_gather", gather, 8, &progress, error);
    if (status == RT_OK && rt_layers_wanted(r->options))
        status = rt_layers_begin(&r->layers, r->renderer, r->film, &progress, error);
    return status == RT_OK ? rt_stage_end(&progress, &r->film->stats.compile_seconds) : status;
}

/* Fills the photon map. */
static rt_status emit(photon_render *r, rt_error *error)
{
    const rt_render_options *options = r->options;
    rt_params params = rt_params_make(options);
    rt_film_stats *stats = &r->film->stats;
    rt_stage_progress progress;

    r->began = rt_clock();
    rt_status status = rt_stage_begin(&progress, options->hooks, RT_STAGE_EMIT);
    if (status == RT_OK)
        status = rt_photon_emit(&r->map, r->renderer->device, r->emit, r->renderer->scene, &params, options->photons,
                                &progress, error);
    stats->photons_emitted = r->map.emitted;
    stats->photons_stored = r->map.count;
    if (status != RT_OK)
        return status;
    rt_log(options->hooks, "%zu photons stored of %llu paths", r->map.count, (unsigned long long)r->map.emitted);
    if (r->map.count == 0)
        rt_log(options->hooks, "the photon map is empty: no path from a light left a photon on a diffuse surface");
    if (r->map.rejected > 0)
        rt_log(options->hooks, "%llu photons left out because they were not finite",
               (unsigned long long)r->map.rejected);
    return rt_stage_end(&progress, &stats->emit_seconds);
}

static rt_status create_gatherer(void *data)
{
    photon_render *r = data;
    const rt_render_options *o = r->options;
    rt_gather_options how = {o->k, o->radius, o->kernel, o->cone_k};
    return rt_gatherer_create(&r->gatherer, r->renderer->device, r->gather, r->renderer->scene, &r->map, &how,
                              &r->error);
}

/* Follows one eye path of each of params->item_count pixels and adds what it brings to the film. */
static rt_status add_part(photon_render *r, const rt_params *params, rt_error *error)
{
    cl_mem points = rt_gatherer_points(r->gatherer);
    rt_arg args[] = {{sizeof *params, params}, RT_ARG(r->renderer->scene), RT_ARG(points)};
    rt_status status = rt_kernel_args(r->camera, args, 3, error);
    if (status == RT_OK)
        status = rt_launch(r->renderer->device, r->camera, params->item_count, error);
    if (status == RT_OK)
        status = rt_layers_add(&r->layers, r->renderer, params, error);
    if (status == RT_OK)
        status = rt_gatherer_add(r->gatherer, params->item_count, r->pixels, &r->film->stats.gathers, error);
    return status;
}

/* Gives every pixel one sample after the other, until there are enough or time is up. */
static rt_status add_samples(photon_render *r, rt_stage_progress *progress, rt_error *error)
{
    const rt_render_options *options = r->options;
    uint32_t pixels = options->width * options->height, spp = options->spp;
    size_t batch = rt_gatherer_capacity(r->gatherer);
    rt_params params = rt_params_make(options);

    for (uint32_t sample = 0; sample < spp; sample++) {
        params.first_sample = sample;
        params.sample_count = 1;
        for (uint32_t done = 0; done < pixels; done += params.item_count) {
            params.first_item = done;
            params.item_count = pixels - done < batch ? pixels - done : (uint32_t)batch;
            rt_status status = add_part(r, &params, error);
            double by_samples = (sample + (double)(done + params.item_count) / pixels) / spp;
            double by_time = options->time > 0 ? (rt_clock() - r->began) / options->time : 0;
            if (status == RT_OK)
                status = rt_stage_update(progress, by_samples > by_time ? by_samples : by_time < 1 ? by_time : 1);
            if (status != RT_OK)
                return status;
        }
        if (options->time > 0 && rt_clock() - r->began >= options->time)
            break;
    }
    return RT_OK;
}

/* Asks the map for every sample of every pixel. */
static rt_status gather(photon_render *r, rt_error *error)
{
    rt_film *film = r->film;
    rt_device *device = r->renderer->device;
    size_t bytes = (size_t)r->options->width * r->options->height * sizeof *film->pixels;
    rt_stage_progress progress;

    rt_status status = rt_buffer_create(device, &r->pixels, CL_MEM_READ_WRITE, bytes, film->pixels, "the film", error);
    if (status == RT_OK)
        status = rt_stage_begin(&progress, r->options->hooks, RT_STAGE_GATHER);
    if (status == RT_OK) {
        status = rt_stage_run(&progress, create_gatherer, r);
        if (status != RT_OK && status != RT_CANCELLED && error)
            *error = r->error;
    }
    if (status != RT_OK)
        return status;
    status = add_samples(r, &progress, error);
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_status read = rt_buffer_read(device, r->pixels, 0, bytes, film->pixels, error);
        if (read == RT_OK)
            read = rt_layers_read(&r->layers, r->renderer, film, error);
        rt_status end = rt_stage_end(&progress, &film->stats.gather_seconds);
        status = read != RT_OK ? read : status != RT_OK ? status : end;
    }
    return status;
}

rt_status rt_render_photon(rt_renderer *renderer, const rt_render_options *options, rt_film *film, rt_error *error)
{
    photon_render r;
    memset(&r, 0, sizeof r);
    r.renderer = renderer;
    r.options = options;
    r.film = film;

    rt_status status = compile(&r, error);
    if (status == RT_OK)
        status = emit(&r, error);
    if (status == RT_OK)
        status = gather(&r, error);
    rt_gatherer_destroy(r.gatherer);
    rt_photon_map_clear(&r.map);
    rt_layers_free(&r.layers);
    rt_buffer_release(r.pixels);
    rt_kernel_release(r.emit);
    rt_kernel_release(r.camera);
    rt_kernel_release(r.gather);
    return status;
}
