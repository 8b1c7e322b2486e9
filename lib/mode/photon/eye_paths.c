/* eye_paths.c - follows eye paths in batches, gathers at their ends, and adds them to the film. */
#include "mode/photon/eye_paths.h"

#include <string.h>

#include "base/memory.h"
#include "mode/photon/pass_sums.h"
#include "mode/photon/radius_test.h"
#include "render/prepare.h"

/* ---- A batch: paths, queries, film ------------------------------------------ */

/* Follows one eye path of each of params->item_count pixels. */
static rt_status follow_paths(rt_eye_paths *paths, rt_params *params, rt_error *error)
{
    const rt_renderer *renderer = paths->job->renderer;
    const uint32_t each = paths->device->path_pixels;
    rt_u32 stride = (rt_u32)paths->capacity;
    /* The tree of no photons is not read: any buffers will do. */
    const rt_volume_gather none = {.nodes = paths->points, .blocks = paths->points};
    const rt_volume_gather *v = paths->volume ? paths->volume : &none;
    rt_arg args[] = {{sizeof *params, params}, RT_ARG(renderer->scene), RT_ARG(paths->points),
                     RT_ARG(paths->earlier),   RT_ARG(stride),          RT_ARG(v->params),
                     RT_ARG(v->tree.shape),    RT_ARG(v->nodes),        RT_ARG(v->blocks)};
    params->final_gather = paths->rows;
    params->pixels_an_item = each;
    rt_status status =
        rt_kernel_args(paths->kernels.camera, args, renderer->has_media ? 9 : 5, error);
    return status == RT_OK ? rt_launch(renderer->device, paths->kernels.camera,
                                       (params->item_count + each - 1) / each, error)
                           : status;
}

/* Counts the query points of discs on the host. others: as in count, or NULL. */
static void count_here(rt_u32 out[2], const rt_gather_disc *discs, const rt_gather_disc *others,
                       size_t count)
{
    for (size_t i = 0; i < count; i++) {
        out[0] += discs[i].is_query;
        out[1] += discs[i].is_query && discs[i].count == 0 && !(others && others[i].count > 0);
    }
}

/* The same on the device, where the discs lie. */
static rt_status count_there(rt_u32 out[2], const rt_eye_paths *paths, cl_mem discs, cl_mem others,
                             size_t count, rt_error *error)
{
    const size_t runs = rt_eye_paths_runs(count);
    rt_u32 points = (rt_u32)count, with_others = others != NULL;
    rt_arg args[] = {RT_ARG(points), RT_ARG(with_others), RT_ARG(discs),
                     others ? (rt_arg)RT_ARG(others) : (rt_arg)RT_ARG(discs),
                     RT_ARG(paths->counts)};
    rt_status status = rt_run(paths->device, paths->kernels.count, args, 5, runs, error);
    if (status == RT_OK)
        status = rt_buffer_read(paths->device, paths->counts, 0,
                                2 * runs * sizeof *paths->host_counts, paths->host_counts, error);
    for (size_t i = 0; i < 2 * runs && status == RT_OK; i++)
        out[i % 2] += paths->host_counts[i];
    return status;
}

/*
 * Counts the points that made a query, and of these those that found no photon, neither by it nor
 * by the other query of the point, which may be NULL.
 */
static rt_status count_queries(rt_u32 out[2], const rt_eye_paths *paths, const rt_gatherer *query,
                               const rt_gatherer *other, const rt_gather_disc *discs, size_t count,
                               rt_error *error)
{
    cl_mem there = rt_gatherer_discs(query);
    out[0] = out[1] = 0;
    if (there && !paths->sums)
        return count_there(out, paths, there, other ? rt_gatherer_discs(other) : NULL, count,
                           error);
    count_here(out, discs, other ? paths->more_discs : NULL, count);
    return RT_OK;
}

/* Makes one query at the points of a row, and for the layers the finer one as well. */
static rt_status gather(rt_eye_paths *paths, const rt_queries *queries, rt_query query, size_t row,
                        size_t count, rt_error *error)
{
    rt_gatherer *gatherer = queries->gatherers[query];
    cl_mem points = row == 0 ? paths->points : paths->earlier;
    size_t first = row == 0 ? 0 : (row - 1) * paths->capacity;
    rt_gather_disc *discs = query == RT_QUERY_GLOBAL ? paths->discs : paths->more_discs;
    /* Unless layers show what was found, it is only counted, where it lies. */
    if (!paths->sums && rt_gatherer_discs(gatherer))
        discs = NULL;
    if (paths->sums)
        return rt_photon_bias_add(&paths->bias, gatherer, queries->finer + query, points, first,
                                  row, count, discs, error);
    return rt_gatherer_add(gatherer, points, first, count, discs, error);
}

/* Makes all queries of a batch. A point counts as a query once, however many lists there are. */
static rt_status gather_all(rt_eye_paths *paths, const rt_queries *queries, size_t count,
                            rt_error *error)
{
    rt_film_stats *stats = &paths->job->film->stats;
    const rt_gatherer *global = queries->gatherers[RT_QUERY_GLOBAL],
                      *caustic = queries->gatherers[RT_QUERY_CAUSTIC],
                      *earlier = queries->gatherers[RT_QUERY_EARLIER];
    rt_u32 counts[2];
    rt_status status = RT_OK;
    if (paths->sums)
        status = rt_photon_bias_begin(&paths->bias, paths->points, paths->earlier, count, error);
    if (status == RT_OK && global)
        status = gather(paths, queries, RT_QUERY_GLOBAL, 0, count, error);
    if (status == RT_OK && caustic)
        status = gather(paths, queries, RT_QUERY_CAUSTIC, 0, count, error);
    if (status == RT_OK && global)
        status = count_queries(counts, paths, global, caustic, paths->discs, count, error);
    if (status == RT_OK && global) {
        stats->gathers += counts[0];
        stats->gathers_at_ends += counts[0];
        stats->gathers_empty += counts[1];
    }
    for (rt_u32 row = 1; earlier && row <= paths->rows && status == RT_OK; row++) {
        status = gather(paths, queries, RT_QUERY_EARLIER, row, count, error);
        if (status == RT_OK)
            status = count_queries(counts, paths, earlier, NULL, paths->more_discs, count, error);
        stats->gathers += status == RT_OK ? counts[0] : 0;
    }
    return status;
}

/* Adds a batch to the layers, after gathering. */
static rt_status add_to_layers(rt_eye_paths *paths, const rt_queries *queries, size_t count,
                               rt_error *error)
{
    rt_device *device = paths->job->renderer->device;
    rt_gather_point *points = paths->host_points, *earlier = points + paths->capacity;
    size_t row = paths->capacity * sizeof *points;
    if (!paths->sums)
        return RT_OK;
    if (!queries->gatherers[RT_QUERY_GLOBAL])
        memset(paths->discs, 0, count * sizeof *paths->discs);
    rt_status status =
        rt_buffer_read(device, paths->points, 0, count * sizeof *points, points, error);
    if (status == RT_OK)
        status = rt_buffer_read(device, paths->earlier, 0, paths->rows * row, earlier, error);
    if (status == RT_OK)
        rt_photon_layers_add(paths->sums, points, paths->discs, paths->bias.sums, count,
                             paths->split, earlier, paths->rows, paths->capacity);
    return status;
}

/* Adds gather points to a film. */
static rt_status add_to_film(rt_eye_paths *paths, const rt_params *params, cl_mem points,
                             cl_mem earlier, cl_mem film, rt_error *error)
{
    rt_u32 stride = (rt_u32)paths->capacity;
    rt_arg args[] = {
        {sizeof *params, params}, RT_ARG(points), RT_ARG(earlier), RT_ARG(stride), RT_ARG(film)};
    rt_status status = rt_kernel_args(paths->kernels.film, args, sizeof args / sizeof *args, error);
    return status == RT_OK ? rt_launch(paths->job->renderer->device, paths->kernels.film,
                                       params->item_count, error)
                           : status;
}

/* ---- A sample of the film --------------------------------------------------- */

/* The work on a batch of eye paths. */
typedef rt_status batch_work(rt_eye_paths *paths, const rt_queries *queries,
                             const rt_params *params, void *data, rt_error *error);

size_t rt_eye_paths_batch(const rt_eye_paths *paths, const rt_queries *queries)
{
    const size_t batch = rt_queries_capacity(queries, paths->capacity) / paths->split;
    return batch > 0 ? batch : 1;
}

/*
 * Follows one eye path of every item, split into so many, a batch at a time, and does the work on
 * each batch.
 */
static rt_status each_batch(rt_eye_paths *paths, const rt_queries *queries, rt_unit_range items,
                            uint32_t sample, rt_u32 split, batch_work *work, void *data,
                            rt_stage_progress *progress, rt_error *error)
{
    const uint32_t count = (uint32_t)items.count;
    size_t batch = rt_eye_paths_batch(paths, queries);
    rt_params params = rt_params_make(paths->job->options);
    rt_status status = RT_OK;

    params.first_sample = sample;
    params.split = split;
    params.sample_count = 1;
    params.replicate = paths->replicate;
    rt_profile_begin(paths->device->profile, "gather");
    for (uint32_t done = 0; done < count && status == RT_OK; done += params.item_count) {
        params.first_item = (uint32_t)items.first + done;
        params.item_count = count - done < batch ? count - done : (uint32_t)batch;
        status = follow_paths(paths, &params, error);
        if (status == RT_OK)
            status = work(paths, queries, &params, data, error);
        if (status == RT_OK)
            status = rt_stage_update(progress, (double)(done + params.item_count) / count);
    }
    rt_profile_end(paths->device->profile);
    return status;
}

/* Gathers from larger discs what the bias is estimated by; see moments.h. */
static rt_status measure_batch(rt_eye_paths *paths, const rt_queries *queries,
                               const rt_params *params, rt_error *error)
{
    const size_t points = (size_t)params->item_count * params->split;
    rt_pass_moments *m = &paths->moments;
    rt_status status = RT_OK;
    for (int size = 0; size < RT_LARGER && status == RT_OK; size++) {
        status = rt_pass_moments_copy(m, paths->points, paths->earlier, points, error);
        if (status == RT_OK)
            status = rt_pass_moments_gather(m, queries, size, points, error);
        if (status == RT_OK)
            status = add_to_film(paths, params, m->points, m->earlier, m->larger[size], error);
    }
    return status;
}

/* Makes the queries, and adds their radiance to the film and its layers. */
static rt_status add_batch(rt_eye_paths *paths, const rt_queries *queries, const rt_params *params,
                           void *data, rt_error *error)
{
    const size_t points = (size_t)params->item_count * params->split;
    rt_status status = RT_OK;
    (void)data;
    if (paths->moments.is_measured)
        status = measure_batch(paths, queries, params, error);
    if (status == RT_OK)
        status = gather_all(paths, queries, points, error);
    if (status == RT_OK)
        status = add_to_layers(paths, queries, points, error);
    if (status == RT_OK)
        status = add_to_film(paths, params, paths->points, paths->earlier, paths->pixels, error);
    if (status == RT_OK && !paths->job->film->units.in_passes)
        status = rt_first_hit_layers_add(paths->job->layers, params, error);
    return status;
}

rt_status rt_eye_paths_sample(rt_eye_paths *paths, const rt_queries *queries, rt_unit_range items,
                              uint32_t sample, rt_stage_progress *progress, rt_error *error)
{
    return each_batch(paths, queries, items, sample, paths->split, add_batch, NULL, progress,
                      error);
}

/* Of rt_eye_paths_radii. */
typedef struct radii {
    rt_query query;
    float *squared;
} radii;

/* Notes the squared radii of the discs at the points of a batch, by pixel. */
static rt_status note_radii(rt_eye_paths *paths, const rt_queries *queries, const rt_params *params,
                            void *data, rt_error *error)
{
    const radii *r = data;
    cl_mem points = r->query == RT_QUERY_EARLIER ? paths->earlier : paths->points;
    rt_status status = rt_gatherer_add(queries->gatherers[r->query], points, 0, params->item_count,
                                       paths->discs, error);
    for (uint32_t i = 0; i < params->item_count && status == RT_OK; i++)
        r->squared[paths->discs[i].pixel] =
            paths->discs[i].count > 0 ? paths->discs[i].squared_radius : 0;
    return status;
}

rt_status rt_eye_paths_radii(rt_eye_paths *paths, const rt_queries *queries, rt_query query,
                             uint32_t sample, float *squared, rt_stage_progress *progress,
                             rt_error *error)
{
    radii r = {query, squared};
    const rt_unit_range all = {0, rt_film_pixels(paths->job->film)};
    return each_batch(paths, queries, all, sample, 1, note_radii, &r, progress, error);
}

/* Of rt_eye_paths_points. */
typedef struct place_list {
    float (*points)[3];
    size_t count;
    rt_gather_point *batch; /* [1 + rows][capacity] */
} place_list;

/* Keeps the places of those of `count` points that gather. */
static void keep_places(place_list *list, const rt_gather_point *points, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const rt_gather_point *p = points + i;
        if (p->weight[0] > 0 || p->weight[1] > 0 || p->weight[2] > 0)
            memcpy(list->points[list->count++], p->position, sizeof p->position);
    }
}

static rt_status list_places(rt_eye_paths *paths, const rt_queries *queries,
                             const rt_params *params, void *data, rt_error *error)
{
    place_list *list = data;
    rt_gather_point *earlier = list->batch + paths->capacity;
    const size_t row = paths->capacity * sizeof *earlier;
    (void)queries;
    rt_status status = rt_buffer_read(paths->device, paths->points, 0,
                                      params->item_count * sizeof *list->batch, list->batch, error);
    if (status == RT_OK && paths->rows > 0)
        status =
            rt_buffer_read(paths->device, paths->earlier, 0, paths->rows * row, earlier, error);
    if (status != RT_OK)
        return status;
    keep_places(list, list->batch, params->item_count);
    for (rt_u32 i = 0; i < paths->rows; i++)
        keep_places(list, earlier + i * paths->capacity, params->item_count);
    return RT_OK;
}

rt_status rt_eye_paths_points(rt_eye_paths *paths, rt_unit_range pixels, uint32_t sample,
                              float (*points)[3], size_t *count, rt_stage_progress *progress,
                              rt_error *error)
{
    const rt_queries none = {{NULL}, {{0}}};
    place_list list = {points, 0, NULL};
    list.batch =
        rt_memory_alloc(paths->device->memory, (1 + paths->rows) * paths->capacity,
                        sizeof *list.batch, "gather points of a batch of eye paths", error);
    const rt_status status = list.batch ? each_batch(paths, &none, pixels, sample, 1, list_places,
                                                     &list, progress, error)
                                        : RT_ERROR_MEMORY;
    rt_memory_free(list.batch);
    *count = list.count;
    return status;
}

static rt_status count_batch(rt_eye_paths *paths, const rt_queries *queries,
                             const rt_params *params, void *data, rt_error *error)
{
    const cl_mem *tests = data;
    rt_status status = RT_OK;
    for (rt_query query = 0; query < RT_QUERIES && status == RT_OK; query++)
        if (tests[query] && queries->gatherers[query])
            status = rt_gatherer_count_sectors(queries->gatherers[query], paths->kernels.sectors,
                                               query == RT_QUERY_EARLIER ? paths->earlier
                                                                         : paths->points,
                                               params->item_count, tests[query], error);
    return status;
}

rt_status rt_eye_paths_count_sectors(rt_eye_paths *paths, const rt_queries *queries, cl_mem *tests,
                                     uint32_t sample, rt_stage_progress *progress, rt_error *error)
{
    const rt_unit_range all = {0, rt_film_pixels(paths->job->film)};
    return each_batch(paths, queries, all, sample, 1, count_batch, tests, progress, error);
}

rt_status rt_eye_paths_read(const rt_eye_paths *paths, rt_error *error)
{
    rt_film *film = paths->job->film;
    rt_status status =
        rt_mirror_read(paths->device, paths->film, rt_film_bytes(film), film->pixels, error);
    if (status == RT_OK && paths->moments.sums)
        status = rt_mirror_read(paths->device, paths->moments.sums, rt_film_moment_bytes(film),
                                film->moments, error);
    return status == RT_OK ? rt_first_hit_layers_read(paths->job->layers, film, error) : status;
}

rt_status rt_eye_paths_write(const rt_eye_paths *paths, rt_error *error)
{
    const rt_film *film = paths->job->film;
    rt_status status =
        rt_mirror_write(paths->device, paths->film, rt_film_bytes(film), film->pixels, error);
    if (status == RT_OK && paths->moments.sums)
        status = rt_mirror_write(paths->device, paths->moments.sums, rt_film_moment_bytes(film),
                                 film->moments, error);
    return status == RT_OK ? rt_first_hit_layers_write(paths->job->layers, film, error) : status;
}

void rt_eye_paths_begin_pass(rt_eye_paths *paths, uint32_t pass)
{
    paths->moments.is_measured = rt_pass_is_measured(pass);
    if (paths->pass_sums)
        rt_pass_sums_clear(paths->pass_sums, rt_film_pixels(paths->job->film),
                           paths->device->threads);
}

/* The layers of the first hit get the samples of a pass once it is whole. */
static rt_status add_first_hits(const rt_eye_paths *paths, uint32_t first, rt_error *error)
{
    const rt_render_options *o = paths->job->options;
    rt_params params = rt_params_make(o);
    params.item_count = (uint32_t)rt_film_pixels(paths->job->film);
    params.first_sample = first;
    params.sample_count = o->spp;
    params.replicate = paths->replicate;
    rt_status status = rt_first_hit_layers_add(paths->job->layers, &params, error);
    return status == RT_OK ? rt_device_finish(paths->device, error) : status;
}

rt_status rt_eye_paths_end_pass(rt_eye_paths *paths, uint32_t plane, uint32_t first,
                                rt_error *error)
{
    rt_film *film = paths->job->film;
    const size_t pixels = rt_film_pixels(film);
    rt_u32 count = (rt_u32)pixels;
    rt_arg args[] = {RT_ARG(count), RT_ARG(plane), RT_ARG(paths->pixels), RT_ARG(paths->film)};
    rt_profile_begin(paths->device->profile, "gather");
    rt_status status = rt_pass_moments_add(&paths->moments, paths->pixels, error);
    if (status == RT_OK)
        status = rt_run(paths->device, paths->kernels.join, args, 4, pixels, error);
    if (status == RT_OK && paths->pass_sums)
        rt_pass_sums_join(film->photon_sums, paths->pass_sums, pixels, paths->device->threads);
    if (status == RT_OK)
        status = add_first_hits(paths, first, error);
    rt_profile_end(paths->device->profile);
    return status;
}
