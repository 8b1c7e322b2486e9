/* photon_render.c - creates the gatherers of the queries, and samples the film with them. */
#include "mode/photon/photon_render.h"

#include <math.h>
#include <string.h>

#include "mode/photon/irradiance_points.h"

/* How each query gathers by the options of the render. */
static void set_gather_options(rt_photon_render *r)
{
    const rt_render_options *o = r->job->options;
    r->options[RT_QUERY_GLOBAL] =
        (rt_gather_options){o->k, o->radius, o->kernel, o->cone_k, o->area, r->search, 0, o->hooks};
    r->options[RT_QUERY_CAUSTIC] = (rt_gather_options){
        o->caustic_k, o->caustic_radius, o->caustic_kernel, o->cone_k, o->area, r->search, 1,
        o->hooks};
    r->options[RT_QUERY_EARLIER] =
        r->options[r->in_use->settings.split ? RT_QUERY_CAUSTIC : RT_QUERY_GLOBAL];
    /* Many points have no caustic near them, and no layer shows the radius of these queries. */
    r->options[RT_QUERY_EARLIER].skip_empty = 1;
    for (rt_query query = 0; query < RT_QUERIES; query++) {
        r->first_radius[query] = r->options[query].max_radius;
        if (r->options[query].k == RT_K_ALL)
            r->options[query].k = 0;
    }
}

int rt_photon_render_keeps(const rt_render_job *job, rt_photon_search search)
{
    const rt_render_options *o = job->options;
    /*
     * The caustic photons of a list that holds all kinds, those at which the irradiance is
     * estimated, and those in media are picked out by the host.
     */
    const int picks =
        o->final_gather > 0 && (o->caustic_photons == 0 || rt_eye_paths_take_irradiance(o));
    return job->renderer->device->keeps_photons && search == RT_SEARCH_TREE && !o->photon_map &&
           !picks && !job->renderer->has_media;
}

/* Has the emitter leave the photons on the device, and makes what builds their trees. */
static rt_status keep_photons(rt_photon_render *r, rt_error *error)
{
    rt_emitter_keep(r->emitter);
    for (rt_query query = 0; query < RT_QUERIES; query++)
        r->places[query][0].builder = r->places[query][1].builder = &r->builder;
    return rt_tree_builder_create(&r->builder, r->job->renderer->device, error);
}

rt_status rt_photon_render_begin(rt_photon_render *r, rt_error *error)
{
    const rt_render_options *o = r->job->options;
    const rt_renderer *renderer = r->job->renderer;
    r->map.settings = rt_photon_settings_of(o, renderer->has_media);
    rt_photon_map_set_memory(&r->map, renderer->device->memory);
    r->caustics.memory = r->irradiances.memory = renderer->device->memory;
    set_gather_options(r);
    rt_status status = rt_eye_paths_create(&r->eye_paths, r->job, &r->eye_kernels, error);
    if (status == RT_OK && !o->photon_map)
        status = rt_emitter_create(&r->emitter, renderer->device, r->emit, renderer->scene,
                                   o->light_shares, o->light_share_count, error);
    if (status == RT_OK && r->keeps)
        status = keep_photons(r, error);
    r->work = rt_work_begin(r->job->film, o);
    r->work.profile = renderer->device->profile;
    return status;
}

void rt_photon_render_free(rt_photon_render *r)
{
    if (r->job)
        rt_photon_render_close(r);
    for (int i = 0; i < RT_QUERIES && r->job; i++) {
        rt_buffer_release(r->job->renderer->device, r->first_radii[i]);
        rt_tree_place_release(&r->places[i][0], r->job->renderer->device);
        rt_tree_place_release(&r->places[i][1], r->job->renderer->device);
    }
    rt_tree_builder_release(&r->builder);
    rt_eye_paths_release(&r->eye_paths);
    rt_emitter_destroy(r->emitter);
    rt_photon_list_clear(&r->caustics);
    rt_photon_list_clear(&r->irradiances);
    rt_photon_map_free(&r->map);
    rt_eye_kernels_release(&r->eye_kernels);
    rt_kernel_release(r->emit);
    rt_kernel_release(r->starts);
    memset(r, 0, sizeof *r);
}

uint32_t rt_photon_render_replicates(const rt_photon_render *r)
{
    return r->job->film->units.replicates;
}

const rt_photon_list *rt_photon_render_list(const rt_photon_render *r, rt_query query)
{
    const rt_photon_list *lists = r->in_use->lists;
    int split = r->in_use->settings.split != 0;
    switch (query) {
    case RT_QUERY_GLOBAL:
        return lists + RT_PHOTONS_GLOBAL;
    case RT_QUERY_CAUSTIC:
        /* The irradiance is that of all photons. */
        return split && !rt_eye_paths_take_irradiance(r->job->options) ? lists + RT_PHOTONS_CAUSTIC
                                                                       : NULL;
    case RT_QUERY_EARLIER:
        if (r->job->options->final_gather == 0)
            return NULL;
        return split ? lists + RT_PHOTONS_CAUSTIC : &r->caustics;
    case RT_QUERIES:
        break;
    }
    return NULL;
}

/* Makes a gatherer of a query: the finer one, or the other. */
static rt_status open_one(rt_photon_render *r, rt_query query, int finer,
                          const rt_gather_options *options, rt_error *error)
{
    const rt_photon_list *list = rt_photon_render_list(r, query);
    rt_gatherer **out = finer ? &r->queries.finer[query].gatherer : r->queries.gatherers + query;
    const rt_renderer *renderer = r->job->renderer;
    rt_status status =
        rt_gatherer_create(out, renderer->device, r->eye_kernels.gather, list, options,
                           list->buffer ? &r->places[query][finer] : NULL, error);
    if (status == RT_OK)
        rt_gatherer_set_scene(*out, renderer->scene);
    return status;
}

/* The final gather's, of the nearest point of known irradiance. */
static rt_status open_irradiance(rt_photon_render *r, rt_error *error)
{
    rt_device *device = r->job->renderer->device;
    const rt_gather_options nearest = {.max_radius = r->job->options->radius,
                                       .search = RT_SEARCH_IRRADIANCE};
    rt_photon_list_reset(&r->irradiances);
    rt_status status =
        rt_irradiance_points_make(&r->irradiances, r->in_use, device, r->job->options, error);
    return status == RT_OK ? rt_gatherer_create(r->queries.gatherers + RT_QUERY_GLOBAL, device,
                                                r->eye_kernels.irradiance, &r->irradiances,
                                                &nearest, NULL, error)
                           : status;
}

rt_status rt_photon_render_open(rt_photon_render *r, rt_query query,
                                const rt_gather_options *options, rt_error *error)
{
    if (query == RT_QUERY_GLOBAL && rt_eye_paths_take_irradiance(r->job->options))
        return open_irradiance(r, error);
    return open_one(r, query, 0, options, error);
}

rt_status rt_photon_render_open_volume(rt_photon_render *r, double squared_factor, rt_error *error)
{
    const rt_render_options *o = r->job->options;
    rt_renderer *renderer = r->job->renderer;
    if (!renderer->has_media)
        return RT_OK;
    const rt_volume_options how = {.k = o->volume_k == RT_K_ALL ? 0 : o->volume_k,
                                   .max_radius = o->volume_radius,
                                   .factor = sqrt(squared_factor),
                                   .density = o->kernel,
                                   .cone_k = o->cone_k,
                                   .estimate = o->volume_estimate};
    rt_status status = rt_volume_gather_create(&r->volume, renderer->device,
                                               r->in_use->lists + RT_PHOTONS_VOLUME, &how, error);
    r->eye_paths.volume = status == RT_OK ? &r->volume : NULL;
    return status;
}

void rt_photon_render_close(rt_photon_render *r)
{
    rt_queries_close(&r->queries);
    rt_volume_gather_release(&r->volume, r->job->renderer->device);
    r->eye_paths.volume = NULL;
}

rt_status rt_photon_render_open_finer(rt_photon_render *r, rt_query query,
                                      const rt_gather_options *options, rt_error *error)
{
    rt_finer *finer = r->queries.finer + query;
    rt_gather_options fine;
    if (!r->job->options->photon_layers || !rt_photon_bias_finer(&fine, &finer->factor, options))
        return RT_OK;
    return open_one(r, query, 1, &fine, error);
}

rt_status rt_photon_render_sample(rt_photon_render *r, uint32_t first, rt_stage_progress *progress,
                                  rt_error *error)
{
    const double from = progress->from, span = progress->to - progress->from;
    const rt_unit_range all = {0, rt_film_pixels(r->job->film)};
    const uint32_t spp = r->job->options->spp;
    rt_status status = RT_OK;

    for (uint32_t i = 0; i < spp && status == RT_OK; i++) {
        rt_stage_part(progress, from + span * i / spp, from + span * (i + 1) / spp);
        status = rt_eye_paths_sample(&r->eye_paths, &r->queries, all, first + i, progress, error);
    }
    return status;
}
