/* visibility_pilot.c - which starts of photon paths lead to where the camera gathers. */
#include "mode/photon/visibility_pilot.h"

#include <string.h>

#include "base/memory.h"
#include "photon/seen_cells.h"

/*
 * Gather points that camera paths find, at least; and photon paths: a part of those of the render,
 * within bounds, in rounds of which each follows what the ones before it found.
 */
enum { POINTS = 1 << 14, PART = 8, PATHS_LEAST = 1 << 14, PATHS_MOST = 1 << 17, ROUNDS = 4 };

/*
 * A trial takes PATHS_LEAST paths at most, and the points of so many pieces of the film, where the
 * render emits at least so many paths, and goes on after a round where few are seen. It takes a
 * twentieth of a second, in which a GPU emits millions of paths.
 */
enum { PIECES = 64, PATHS_TRIED = 1000000, PATHS_TRIED_GPU = 32000000 };
static const double few = 0.05;

static const char what[] = "the pilot of visual importance";

/* What the pilot holds. */
typedef struct pilot {
    rt_seen_cells cells;
    rt_light_sources lights; /* with their shares without importance */
    uint32_t levels;
    rt_pilot_path *paths;     /* [ROUNDS][each] */
    rt_path_start *starts;    /* [each] */
    size_t each, count;       /* paths a round, and so far */
    rt_importance importance; /* of these; nothing seen: none */
} pilot;

static void release(pilot *p)
{
    rt_importance_free(&p->importance);
    rt_memory_free(p->paths);
    rt_memory_free(p->starts);
    rt_light_sources_free(&p->lights);
    rt_seen_cells_free(&p->cells);
}

/* Finds where camera paths gather, in a trial from pieces of a large film. */
static rt_status see(pilot *p, rt_photon_render *r, rt_stage_progress *progress, rt_error *error)
{
    const size_t pixels = rt_film_pixels(r->job->film);
    const int is_in_pieces = !r->job->options->photon_importance && pixels > POINTS;
    const size_t pieces = is_in_pieces ? PIECES : 1;
    const size_t piece = is_in_pieces ? POINTS / PIECES : pixels;
    const size_t most = pieces * piece * (1 + r->eye_paths.rows);
    const size_t samples = (POINTS + most - 1) / most;
    rt_memory *memory = r->job->renderer->device->memory;
    float(*points)[3] = rt_memory_alloc(memory, samples * most, sizeof *points, what, error);
    rt_status status = points ? RT_OK : RT_ERROR_MEMORY;
    size_t count = 0;
    for (size_t i = 0; i < samples * pieces && status == RT_OK; i++) {
        const rt_unit_range items = {pixels * (i % pieces) / pieces, piece};
        size_t more = 0;
        status = rt_eye_paths_points(&r->eye_paths, items, (uint32_t)(i / pieces), points + count,
                                     &more, progress, error);
        count += more;
    }
    if (status == RT_OK)
        status = rt_seen_cells_make(&p->cells, (const float(*)[3])points, count, memory, error);
    rt_memory_free(points);
    return status;
}

static rt_status begin(pilot *p, const rt_photon_render *r, rt_error *error)
{
    const rt_render_options *o = r->job->options;
    const rt_renderer *renderer = r->job->renderer;
    const uint64_t all = o->photon_importance ? o->photons * o->passes / PART : 0;
    rt_memory *memory = renderer->device->memory;
    memset(p, 0, sizeof *p);
    p->each = (size_t)(all < PATHS_LEAST  ? PATHS_LEAST
                       : all > PATHS_MOST ? PATHS_MOST
                                          : all) /
              ROUNDS;
    p->paths = rt_memory_zeroed(memory, ROUNDS * p->each, sizeof *p->paths, what, error);
    if (p->paths)
        p->starts = rt_memory_alloc(memory, p->each, sizeof *p->starts, what, error);
    if (!p->starts)
        return RT_ERROR_MEMORY;
    rt_status status = rt_light_sources_read(&p->lights, renderer->device, renderer->scene,
                                             o->light_shares, o->light_share_count, error);
    p->levels = rt_importance_levels(ROUNDS * p->each, p->lights.light_count);
    return status;
}

/* Marks the paths that left a photon where the camera gathers. In media, all are. */
static void mark(pilot *p, const rt_photon_map *map)
{
    const rt_photon_list *surface = map->lists + RT_PHOTONS_GLOBAL,
                         *volume = map->lists + RT_PHOTONS_VOLUME;
    for (size_t i = 0; i < surface->count; i++)
        if (rt_seen_cells_hold(&p->cells, surface->photons[i].position))
            p->paths[surface->photons[i].path].counts = 1;
    for (size_t i = 0; i < volume->count; i++)
        p->paths[volume->photons[i].path].counts = 1;
}

/* Emits photons of all kinds from an emitter, and notes where their paths started. */
static rt_status emit(pilot *p, const rt_photon_render *r, rt_emitter *emitter, rt_photon_map *map,
                      rt_stage_progress *progress, rt_error *error)
{
    const uint32_t seed = ~r->job->options->seed;
    rt_status status = RT_OK;
    if (p->importance.seen > 0)
        status = rt_emitter_follow(emitter, &p->importance, error);
    if (status == RT_OK)
        status = rt_emitter_emit(emitter, map, RT_PHOTONS_GLOBAL, seed, p->count, p->each, progress,
                                 error);
    if (status == RT_OK)
        status = rt_emitter_starts(emitter, r->starts, p->starts, &map->settings, seed, p->count,
                                   p->each, p->levels, error);
    for (size_t i = 0; i < p->each && status == RT_OK; i++) {
        rt_pilot_path *path = p->paths + p->count + i;
        path->start = p->starts[i];
        path->weight = rt_importance_weight(&p->importance, &p->lights, p->starts + i);
    }
    return status;
}

/* A round: photons by what is known, and what is known then. */
static rt_status run_round(pilot *p, const rt_photon_render *r, rt_stage_progress *progress,
                           rt_error *error)
{
    const rt_render_options *o = r->job->options;
    rt_renderer *renderer = r->job->renderer;
    rt_emitter *emitter = NULL;
    rt_photon_map map;
    memset(&map, 0, sizeof map);
    map.settings = r->map.settings;
    map.settings.split = 0;
    rt_photon_map_set_memory(&map, renderer->device->memory);
    rt_status status = rt_emitter_create(&emitter, renderer->device, r->emit, renderer->scene,
                                         o->light_shares, o->light_share_count, error);
    if (status == RT_OK)
        status = emit(p, r, emitter, &map, progress, error);
    if (status == RT_OK)
        mark(p, &map);
    rt_photon_map_free(&map);
    rt_emitter_destroy(emitter);
    if (status != RT_OK)
        return status;
    p->count += p->each;
    rt_importance_free(&p->importance);
    return rt_importance_make(&p->importance, &p->lights, p->levels, o->light_share_count == 0,
                              p->paths, p->count, error);
}

/* Tells what was found. */
static void tell(const pilot *p, rt_photon_render *r)
{
    const rt_hooks *hooks = r->job->options->hooks;
    rt_film_stats *stats = &r->job->film->stats;
    stats->paths_seen = p->importance.seen;
    stats->paths_seen_by_importance = p->importance.seen == 0 ? 0 : p->importance.expected;
    if (p->importance.seen == 0)
        rt_log(hooks, "visual importance: the camera gathers none of the pilot's photons");
    else
        rt_log(hooks,
               "visual importance: the camera gathers photons of %.3g %% of the paths, by "
               "importance of %.3g %%",
               100 * stats->paths_seen, 100 * stats->paths_seen_by_importance);
}

/* Whether what importance would bring is worth finding out: a part is too small for a trial. */
static int is_tried(const rt_render_job *job)
{
    const rt_render_options *o = job->options;
    const uint64_t least = job->renderer->device->info.is_cpu ? PATHS_TRIED : PATHS_TRIED_GPU;
    return !o->photon_map && o->parts <= 1 && !o->next_units && o->photons * o->passes >= least;
}

int rt_visibility_pilot_is_run(const rt_render_job *job)
{
    return job->options->photon_importance || is_tried(job);
}

/* Whether all is known after so many rounds. */
static int is_known(const pilot *p, const rt_render_options *o, int rounds)
{
    return rounds == ROUNDS || (rounds > 0 && !o->photon_importance && p->importance.seen >= few);
}

rt_status rt_visibility_pilot_run(rt_photon_render *r, rt_stage_progress *progress, rt_error *error)
{
    const rt_render_options *o = r->job->options;
    const double began = rt_clock();
    pilot p;
    if (!rt_visibility_pilot_is_run(r->job))
        return RT_OK;
    rt_status status = begin(&p, r, error);
    if (status == RT_OK)
        status = see(&p, r, progress, error);
    for (int i = 0; !is_known(&p, o, i) && status == RT_OK; i++)
        status = run_round(&p, r, progress, error);
    if (status == RT_OK)
        tell(&p, r);
    if (status == RT_OK && o->photon_importance && p.importance.seen > 0)
        status = rt_emitter_follow(r->emitter, &p.importance, error);
    release(&p);
    r->job->film->stats.emit_seconds += rt_clock() - began;
    return status;
}
