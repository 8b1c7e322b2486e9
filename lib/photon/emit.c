/* emit.c - runs photon paths on the device in batches, and appends their photons to a map. */
#include "photon/emit.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "photon/forecast.h"
#include "photon/path_sums.h"
#include "photon/photon_packer.h"
#include "render/prepare.h"
#include "render/renderer.h"

/*
 * Bounds of a batch: the memory of its slots, and its length, so that progress moves; a GPU takes
 * more, to have all of it at work.
 */
enum {
    SLOT_BYTES_CPU = 1 << 26,
    SLOT_BYTES_GPU = 1 << 28,
    PATHS_CPU = 1 << 15,
    PATHS_GPU = 1 << 18,
    LEAST_BATCH = 64
};

/* Arguments of the kernel: rt_params, the scene, and then buffers. */
enum { EMIT_ARGUMENTS = 5 };

/* Batches that take turns: the device follows the paths of one while the host takes another's. */
enum { BATCHES = 2 };

/* A batch of paths, and while it is under way where the host reads it. */
typedef struct emission_batch {
    cl_mem photons;  /* rt_photon [slots][paths]; NULL: there is no such batch */
    cl_mem accounts; /* rt_path_account [paths] */
    rt_params params;
    const void *mapped_photons; /* NULL where the device packs them */
    const void *mapped_accounts;
    cl_event ready; /* complete when both are mapped; NULL where they stay on the device */
} emission_batch;

struct rt_emitter {
    rt_device *device;
    cl_kernel kernel;
    cl_mem scene;
    rt_light_sources lights;
    cl_mem shares; /* rt_light_share, one a light of the kernels' table */
    size_t slots;  /* photons a path can store; 0 before the first emission */
    size_t paths;  /* a batch, at most */
    emission_batch batches[BATCHES];
    int packs; /* the device packs photons before they are read */
    int keeps; /* it packs them, and they stay there */
    rt_photon_packer packer;
    rt_path_sums sums;         /* of a batch that stays there */
    uint64_t memory;           /* bytes that the photons of a map must fit into; 0: any */
    void (*after)(void *user); /* each batch; NULL: nothing */
    void *after_user;
};

const char *rt_emit_kernel_name(const rt_renderer *renderer)
{
    static const char *const programs[] = RT_PROGRAMS("photon_emit");
    return rt_renderer_program(renderer, programs);
}

rt_status rt_emit_kernel_prepare(cl_kernel *out, rt_device *device, cl_mem scene, const char *name,
                                 rt_stage_progress *progress, rt_error *error)
{
    rt_params params;
    memset(&params, 0, sizeof params);
    rt_arg args[EMIT_ARGUMENTS] = {RT_ARG(params), RT_ARG(scene), RT_ARG(scene), RT_ARG(scene),
                                   RT_ARG(scene)};
    return rt_kernel_prepare(device, out, name, name, args, EMIT_ARGUMENTS, progress, error);
}

rt_status rt_emitter_create(rt_emitter **out, rt_device *device, cl_kernel kernel, cl_mem scene,
                            const float *shares, size_t share_count, rt_error *error)
{
    rt_emitter *e = calloc(1, sizeof *e);
    if (!e)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for photon emission");
    e->device = device;
    e->kernel = kernel;
    e->scene = scene;
    e->memory = rt_physical_memory();
    e->packs = !device->info.is_cpu;
    rt_status status = rt_light_sources_read(&e->lights, device, scene, shares, share_count, error);
    if (status == RT_OK)
        status = rt_buffer_create(
            device, &e->shares, CL_MEM_READ_ONLY, e->lights.light_count * sizeof *e->lights.shares,
            e->lights.light_count ? e->lights.shares : NULL, "the table of light shares", error);
    if (status == RT_OK)
        *out = e;
    else
        rt_emitter_destroy(e);
    return status;
}

const rt_light_sources *rt_emitter_lights(const rt_emitter *e)
{
    return &e->lights;
}

/* Shares of the lights, and behind them the tables of their starts, in one buffer. */
static rt_status write_tables(rt_emitter *e, const rt_importance *importance, rt_error *error)
{
    static const char name[] = "the tables of visual importance";
    const size_t lights = e->lights.light_count, cells = (size_t)1 << 4 * importance->levels,
                 rows = importance->levels > 0 ? cells * sizeof(float) / sizeof(rt_light_share) : 0,
                 count = lights * (1 + rows);
    rt_light_share *all = rt_memory_zeroed(e->device->memory, count, sizeof *all, name, error);
    if (!all)
        return RT_ERROR_MEMORY;
    for (size_t i = 0; i < lights; i++) {
        all[i] = e->lights.shares[i];
        all[i].cells = (rt_u32)(lights + i * rows);
        all[i].levels = importance->levels;
        memcpy(all + all[i].cells, importance->sums + i * cells, rows * sizeof *all);
    }
    rt_buffer_release(e->device, e->shares);
    e->shares = NULL;
    rt_status status = rt_buffer_create(e->device, &e->shares, CL_MEM_READ_ONLY,
                                        count * sizeof *all, all, name, error);
    rt_memory_free(all);
    return status;
}

rt_status rt_emitter_follow(rt_emitter *e, const rt_importance *importance, rt_error *error)
{
    rt_light_sources_weigh(&e->lights, importance->factors);
    return write_tables(e, importance, error);
}

static void release_buffers(const rt_emitter *e, emission_batch *batch)
{
    rt_buffer_release(e->device, batch->photons);
    rt_buffer_release(e->device, batch->accounts);
    batch->photons = batch->accounts = NULL;
}

static void release_batches(rt_emitter *e)
{
    for (int i = 0; i < BATCHES; i++)
        release_buffers(e, e->batches + i);
    rt_photon_packer_release(&e->packer);
    rt_path_sums_release(&e->sums);
    e->slots = 0;
}

void rt_emitter_destroy(rt_emitter *e)
{
    if (!e)
        return;
    release_batches(e);
    rt_buffer_release(e->device, e->shares);
    rt_light_sources_free(&e->lights);
    free(e);
}

void rt_emitter_pack(rt_emitter *e)
{
    release_batches(e);
    e->packs = 1;
}

void rt_emitter_keep(rt_emitter *e)
{
    rt_emitter_pack(e);
    e->keeps = 1;
}

void rt_emitter_limit_memory(rt_emitter *e, uint64_t bytes)
{
    e->memory = bytes;
}

rt_status rt_emitter_make_ledger(const rt_emitter *e, rt_ledger *out, rt_error *error)
{
    return rt_ledger_create(out, &e->lights, error);
}

void rt_emitter_after_batch(rt_emitter *e, void (*after)(void *user), void *user)
{
    e->after = after;
    e->after_user = user;
}

void rt_emitter_warn_reach(const rt_emitter *e, const rt_hooks *hooks)
{
    if (e->lights.reach > 0)
        rt_warn(hooks,
                "photons of the sky and of directional lights fall on planes only within %.3g m of "
                "the %s: their reflection of light that arrives farther out is missing; use quads "
                "instead of planes, or a final gather to reduce the loss",
                e->lights.reach, e->lights.reach_from);
}

static rt_status create_buffers(const rt_emitter *e, emission_batch *batch, size_t slots,
                                size_t paths, rt_error *error)
{
    const cl_mem_flags flags = CL_MEM_READ_WRITE | (e->packs ? 0 : CL_MEM_ALLOC_HOST_PTR);
    rt_status status =
        rt_buffer_create(e->device, &batch->photons, flags, paths * slots * sizeof(rt_photon), NULL,
                         "the buffer of photon slots", error);
    if (status == RT_OK)
        status =
            rt_buffer_create(e->device, &batch->accounts, flags, paths * sizeof(rt_path_account),
                             NULL, "the buffer of path accounts", error);
    if (status != RT_OK)
        release_buffers(e, batch);
    return status;
}

static rt_status create_batch(rt_emitter *e, size_t slots, size_t paths, rt_error *error)
{
    rt_status status = create_buffers(e, e->batches, slots, paths, error);
    if (status == RT_OK && e->packs)
        status = rt_photon_packer_create(&e->packer, e->device, paths, slots, error);
    if (status == RT_OK && e->keeps)
        status = rt_path_sums_create(&e->sums, e->device, &e->lights, paths, error);
    if (status != RT_OK)
        release_batches(e);
    return status;
}

/*
 * Makes the other batches that `count` paths have use for, as far as there is memory. Packing
 * serves one batch at a time.
 */
static void create_more(rt_emitter *e, uint64_t count)
{
    for (int i = 1; i < BATCHES && count > i * (uint64_t)e->paths && !e->packs; i++)
        if (!e->batches[i].photons &&
            create_buffers(e, e->batches + i, e->slots, e->paths, NULL) != RT_OK)
            return;
}

/*
 * Makes memory for batches of at most `count` paths, unless there is enough; for shorter batches
 * where the device has no more.
 */
static rt_status prepare_batch(rt_emitter *e, size_t slots, uint64_t count, rt_error *error)
{
    const int is_cpu = e->device->info.is_cpu;
    size_t most = (is_cpu ? SLOT_BYTES_CPU : SLOT_BYTES_GPU) / (slots * sizeof(rt_photon));
    size_t bound = is_cpu ? PATHS_CPU : PATHS_GPU;
    size_t paths = most < 1 ? 1 : most > bound ? bound : most;
    if (paths > count)
        paths = (size_t)count;
    if (e->slots == slots && e->paths >= paths) {
        create_more(e, count);
        return RT_OK;
    }
    release_batches(e);
    rt_status status = create_batch(e, slots, paths, error);
    while (status == RT_ERROR_MEMORY && paths > LEAST_BATCH) {
        paths /= 2;
        status = create_batch(e, slots, paths, error);
    }
    if (status == RT_OK) {
        e->slots = slots;
        e->paths = paths;
        create_more(e, count);
    }
    return status;
}

/* Ends the mapping of a batch. */
static rt_status unmap_batch(const rt_emitter *e, emission_batch *b, rt_error *error)
{
    rt_status status = rt_buffer_unmap(e->device, b->photons, b->mapped_photons, error);
    rt_status other =
        rt_buffer_unmap(e->device, b->accounts, b->mapped_accounts, status == RT_OK ? error : NULL);
    b->mapped_photons = b->mapped_accounts = NULL;
    return status == RT_OK ? other : status;
}

/* Has the device follow the paths of a batch, and map what they leave. */
static rt_status begin_batch(const rt_emitter *e, emission_batch *b, rt_error *error)
{
    const size_t paths = b->params.item_count;
    const size_t photons = e->paths * e->slots * sizeof(rt_photon);
    rt_arg args[EMIT_ARGUMENTS] = {RT_ARG(b->params), RT_ARG(e->scene), RT_ARG(e->shares),
                                   RT_ARG(b->photons), RT_ARG(b->accounts)};
    b->ready = NULL;
    rt_status status = rt_run(e->device, e->kernel, args, EMIT_ARGUMENTS, paths, error);
    if (status == RT_OK && !e->packs)
        status = rt_buffer_map_begin(e->device, b->photons, photons, &b->mapped_photons, NULL,
                                     "photons", error);
    if (status == RT_OK && !e->keeps)
        status = rt_buffer_map_begin(e->device, b->accounts, paths * sizeof(rt_path_account),
                                     &b->mapped_accounts, &b->ready, "the accounts of photon paths",
                                     error);
    if (status != RT_OK)
        unmap_batch(e, b, NULL);
    return status;
}

/* Books the accounts of a batch, which the host has. */
static rt_status book_batch(const rt_emitter *e, rt_photon_map *map, rt_photon_kind kind,
                            const rt_path_account *accounts, size_t paths, rt_error *error)
{
    return kind == RT_PHOTONS_GLOBAL ? rt_ledger_book(&map->ledger, &e->lights, accounts, paths,
                                                      e->device->threads, error)
                                     : RT_OK;
}

/* Books the accounts of a batch that stays on the device by their sums, which are its rows. */
static rt_status book_kept(const rt_emitter *e, rt_photon_map *map, const emission_batch *b,
                           const rt_i64 *rows, rt_error *error)
{
    const size_t paths = b->params.item_count;
    const void *accounts = NULL;
    if (e->sums.sources > 0 || map->ledger.count == 0) {
        rt_ledger_book_sums(&map->ledger, rows, paths);
        return RT_OK;
    }
    rt_status status = rt_buffer_map(e->device, b->accounts, paths * sizeof(rt_path_account),
                                     &accounts, "the accounts of photon paths", error);
    if (status == RT_OK)
        status = book_batch(e, map, RT_PHOTONS_GLOBAL, accounts, paths, error);
    rt_status unmapped =
        rt_buffer_unmap(e->device, b->accounts, accounts, status == RT_OK ? error : NULL);
    return status == RT_OK ? unmapped : status;
}

/* Moves photons in media, of those from `first` on, to the list of their own. */
static rt_status take_volume_photons(rt_photon_map *map, size_t first, size_t paths,
                                     rt_error *error)
{
    rt_photon_list *list = map->lists + RT_PHOTONS_GLOBAL, *volume = map->lists + RT_PHOTONS_VOLUME;
    size_t count = 0, kept = first;
    for (size_t i = first; i < list->count; i++)
        count += (list->photons[i].flags & RT_PHOTON_VOLUME) != 0;
    rt_status status = rt_photon_list_reserve(volume, count, error);
    if (status != RT_OK)
        return status;
    for (size_t i = first; i < list->count; i++)
        if (list->photons[i].flags & RT_PHOTON_VOLUME)
            volume->photons[volume->count++] = list->photons[i];
        else
            list->photons[kept++] = list->photons[i];
    list->count = kept;
    volume->emitted += paths;
    return RT_OK;
}

/* Appends the photons of a batch to a list on the host, and books its accounts. */
static rt_status take_batch(rt_emitter *e, rt_photon_map *map, rt_photon_kind kind,
                            const emission_batch *b, rt_error *error)
{
    const rt_path_account *accounts = b->mapped_accounts;
    const size_t paths = b->params.item_count;
    rt_photon_list *list = map->lists + kind;
    const size_t before = list->count;
    rt_status status = list->buffer ? rt_photon_list_fetch(list, error) : RT_OK;
    if (status == RT_OK)
        status = e->packs ? rt_photon_packer_append(&e->packer, list, b->photons, e->paths,
                                                    accounts, paths, error)
                          : rt_photon_list_append(list, b->mapped_photons, e->paths, accounts,
                                                  paths, e->device->threads, error);
    if (status == RT_OK && map->settings.media && kind == RT_PHOTONS_GLOBAL)
        status = take_volume_photons(map, before, paths, error);
    return status == RT_OK ? book_batch(e, map, kind, accounts, paths, error) : status;
}

/* Takes a batch to the host for which the device has no room, as it will later ones. */
static rt_status leave_device(rt_emitter *e, rt_photon_map *map, rt_photon_kind kind,
                              emission_batch *b, const rt_hooks *hooks, rt_error *error)
{
    rt_log(hooks, "photons are taken to the host: the device has no room for them");
    e->keeps = 0;
    rt_status status =
        rt_buffer_map(e->device, b->accounts, b->params.item_count * sizeof(rt_path_account),
                      &b->mapped_accounts, "the accounts of photon paths", error);
    return status == RT_OK ? take_batch(e, map, kind, b, error) : status;
}

/* Appends the photons of a batch to a list on the device, and books its accounts. */
static rt_status keep_batch(rt_emitter *e, rt_photon_map *map, rt_photon_kind kind,
                            emission_batch *b, const rt_hooks *hooks, rt_error *error)
{
    const size_t paths = b->params.item_count;
    const int books = kind == RT_PHOTONS_GLOBAL;
    rt_photon_list *list = map->lists + kind;
    const rt_i64 *rows = NULL;
    rt_status status = rt_path_sums_run(&e->sums, &rows, b->accounts, paths, books, error);
    if (status != RT_OK)
        return status;
    const size_t photons = (size_t)rows[RT_TOTAL_PHOTONS];
    status = rt_photon_list_reserve_on(list, e->device, photons, error);
    if (status == RT_ERROR_MEMORY)
        return leave_device(e, map, kind, b, hooks, error);
    if (status == RT_OK)
        status = rt_photon_packer_keep(&e->packer, list, b->photons, e->paths, b->accounts, paths,
                                       error);
    if (status == RT_OK && books)
        status = book_kept(e, map, b, rows, error);
    if (status == RT_OK) {
        list->count += photons;
        list->emitted += paths;
        list->rejected += (uint64_t)rows[RT_TOTAL_REJECTED];
    }
    return status;
}

/* Waits for a batch, and takes its photons, accounts and range into the map. */
static rt_status end_batch(rt_emitter *e, rt_photon_map *map, rt_photon_kind kind,
                           emission_batch *b, const rt_hooks *hooks, rt_error *error)
{
    const rt_photon_list *list = map->lists + kind, *volume = map->lists + RT_PHOTONS_VOLUME;
    const size_t before = list->count, before_in_media = volume->count;
    rt_status status = b->ready ? rt_buffer_map_wait(b->ready, "photons", error) : RT_OK;
    if (status == RT_OK)
        status = b->ready ? take_batch(e, map, kind, b, error)
                          : keep_batch(e, map, kind, b, hooks, error);
    rt_status unmapped = unmap_batch(e, b, status == RT_OK ? error : NULL);
    status = status == RT_OK ? unmapped : status;
    if (status != RT_OK)
        return status;
    rt_path_range range = {b->params.first_item, b->params.item_count, list->count - before,
                           b->params.seed};
    status = rt_path_ranges_add(map->ranges + kind, &range, error);
    if (status != RT_OK || !map->settings.media || kind != RT_PHOTONS_GLOBAL)
        return status;
    range.photons = volume->count - before_in_media;
    return rt_path_ranges_add(map->ranges + RT_PHOTONS_VOLUME, &range, error);
}

/* Waits for a batch that is not wanted any more. */
static void drop_batch(const rt_emitter *e, emission_batch *b)
{
    if (b->ready)
        rt_buffer_map_wait(b->ready, "photons", NULL);
    unmap_batch(e, b, NULL);
}

static rt_params make_params(const rt_emitter *e, const rt_photon_settings *settings,
                             rt_photon_kind kind, uint32_t seed)
{
    rt_params p;
    memset(&p, 0, sizeof p);
    p.seed = seed;
    p.sampler = settings->sampler;
    p.max_depth = settings->max_depth;
    p.direct = settings->direct;
    p.gather_alpha = settings->gather_roughness;
    p.slots = (rt_u32)e->paths;
    p.store = kind == RT_PHOTONS_CAUSTIC ? RT_STORE_CAUSTIC
              : settings->split          ? RT_STORE_GLOBAL
                                         : RT_STORE_ALL;
    return p;
}

rt_status rt_emitter_starts(const rt_emitter *e, cl_kernel kernel, rt_path_start *starts,
                            const rt_photon_settings *settings, uint32_t seed, size_t first,
                            size_t count, uint32_t levels, rt_error *error)
{
    static const char name[] = "the starts of photon paths";
    const size_t bytes = count * sizeof *starts;
    rt_params params = make_params(e, settings, RT_PHOTONS_GLOBAL, seed);
    rt_u32 times = levels;
    cl_mem buffer = NULL;
    params.first_item = (rt_u32)first;
    params.item_count = (rt_u32)count;
    rt_status status =
        rt_buffer_create(e->device, &buffer, CL_MEM_READ_WRITE, bytes, NULL, name, error);
    rt_arg args[] = {RT_ARG(params), RT_ARG(e->scene), RT_ARG(e->shares), RT_ARG(times),
                     RT_ARG(buffer)};
    if (status == RT_OK)
        status = rt_run(e->device, kernel, args, 5, count, error);
    if (status == RT_OK)
        status = rt_buffer_read(e->device, buffer, 0, bytes, starts, error);
    rt_buffer_release(e->device, buffer);
    return status;
}

/*
 * Whether a list that has got so many photons by `done` of `count` paths will stay within the limit
 * of memory.
 */
static rt_status foresee(const rt_photon_list *list, size_t photons, uint64_t done, uint64_t count,
                         rt_error *error)
{
    double more = (double)photons / (double)done * (double)(count - done);
    double room = (double)(list->capacity - list->count);
    return done < RT_FORECAST_PATHS || more <= room
               ? RT_OK
               : rt_memory_foresee(list->memory, (more - room) * sizeof(rt_photon),
                                   "the photon map", error);
}

/* The photons of all lists. */
static size_t count_photons(const rt_photon_map *map)
{
    size_t count = 0;
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        count += map->lists[kind].count;
    return count;
}

/*
 * After `done` of `count` paths: whether there is memory for the others; reports progress. before:
 * the photons of the list before the first; others: those of all lists.
 */
static rt_status note_batch(const rt_emitter *e, const rt_photon_map *map, rt_photon_kind kind,
                            size_t before, size_t others, uint64_t done, uint64_t count,
                            rt_stage_progress *progress, rt_error *error)
{
    const rt_photon_list *list = map->lists + kind;
    rt_status status = foresee(list, list->count - before, done, count, error);
    if (status == RT_OK)
        status =
            rt_photon_forecast(others, count_photons(map) - others, done, count, e->memory, error);
    if (status == RT_OK && e->after)
        e->after(e->after_user);
    return status == RT_OK ? rt_stage_update(progress, (double)done / (double)count) : status;
}

/* Runs the batches of a range one after the other. */
static rt_status emit_batches(rt_emitter *e, rt_photon_map *map, rt_photon_kind kind,
                              const rt_params *params, uint64_t first, uint64_t count,
                              rt_stage_progress *progress, rt_error *error)
{
    const size_t before = map->lists[kind].count, others = count_photons(map);
    const unsigned ring = e->batches[1].photons ? BATCHES : 1;
    unsigned begun = 0, ended = 0; /* batches */
    uint64_t next = 0, done = 0;   /* paths */
    rt_status status = RT_OK;
    while (status == RT_OK && done < count) {
        emission_batch *b = e->batches + begun % ring;
        if (next < count && begun - ended < ring) {
            b->params = *params;
            b->params.first_item = (rt_u32)(first + next);
            b->params.item_count = (rt_u32)(count - next < e->paths ? count - next : e->paths);
            status = begin_batch(e, b, error);
            begun += status == RT_OK;
            next += b->params.item_count;
            continue;
        }
        b = e->batches + ended++ % ring;
        status = end_batch(e, map, kind, b, progress->hooks, error);
        done += b->params.item_count;
        if (status == RT_OK)
            status = note_batch(e, map, kind, before, others, done, count, progress, error);
    }
    while (ended < begun)
        drop_batch(e, e->batches + ended++ % ring);
    return status;
}

rt_status rt_emitter_emit(rt_emitter *e, rt_photon_map *map, rt_photon_kind kind, uint32_t seed,
                          uint64_t first, uint64_t count, rt_stage_progress *progress,
                          rt_error *error)
{
    static const uint64_t indices = (uint64_t)UINT32_MAX + 1;
    /* one photon a segment at most */
    size_t slots = map->settings.max_depth > 1 ? map->settings.max_depth - 1 : 1;

    if (count > indices || first > indices - count)
        return rt_fail_field(error, RT_ERROR_USAGE, "photons",
                             "photon paths %llu to %llu are beyond the %llu of a seed",
                             (unsigned long long)first, (unsigned long long)(first + count),
                             (unsigned long long)indices);
    rt_status status = map->ledger.rows ? RT_OK : rt_ledger_create(&map->ledger, &e->lights, error);
    if (status == RT_OK && count > 0)
        status = prepare_batch(e, slots, count, error);
    if (status == RT_OK && count > 0) {
        rt_params params = make_params(e, &map->settings, kind, seed);
        status = emit_batches(e, map, kind, &params, first, count, progress, error);
    }
    return status;
}
