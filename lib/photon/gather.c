#include "photon/gather.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "photon/search.h"

/* Bounds of a batch: its points, and the entries of their neighbour lists. */
enum { POINTS_A_BATCH = 1 << 16, ENTRIES_A_BATCH = 1 << 22 };

struct rt_gatherer {
    rt_device *device;
    cl_kernel kernel;
    cl_mem scene;
    rt_photon_search *search;
    rt_density_params estimate;
    size_t capacity; /* points a batch */
    cl_mem photons;  /* rt_photon, the map */
    cl_mem points;   /* rt_gather_point [capacity] */
    cl_mem discs;    /* rt_gather_disc [capacity] */
    cl_mem lists;    /* u32 [capacity][estimate.stride] */
    rt_gather_point *host_points; /* the same on the host */
    rt_gather_disc *host_discs;
    rt_u32 *host_lists;
};

static rt_status create_buffers(rt_gatherer *g, const rt_photon_map *map, rt_error *error)
{
    rt_device *device = g->device;
    size_t list_bytes = g->capacity * g->estimate.stride * sizeof *g->host_lists;
    cl_mem_flags in_place = device->info.is_cpu && map->count > 0 ? CL_MEM_USE_HOST_PTR : 0;
    rt_status status;

    g->host_points = malloc(g->capacity * sizeof *g->host_points);
    g->host_discs = malloc(g->capacity * sizeof *g->host_discs);
    g->host_lists = malloc(list_bytes ? list_bytes : 1);
    if (!g->host_points || !g->host_discs || !g->host_lists)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory to gather at %zu points", g->capacity);
    if ((status = rt_buffer_create(device, &g->photons, CL_MEM_READ_ONLY | in_place, map->count * sizeof *map->photons,
                                   map->photons, "the photon map", error)) != RT_OK ||
        (status = rt_buffer_create(device, &g->points, CL_MEM_READ_WRITE, g->capacity * sizeof *g->host_points, NULL,
                                   "gather points", error)) != RT_OK ||
        (status = rt_buffer_create(device, &g->discs, CL_MEM_READ_ONLY, g->capacity * sizeof *g->host_discs, NULL,
                                   "gather discs", error)) != RT_OK)
        return status;
    return rt_buffer_create(device, &g->lists, CL_MEM_READ_ONLY, list_bytes, NULL, "neighbour lists", error);
}

rt_status rt_gatherer_create(rt_gatherer **out, rt_device *device, cl_kernel kernel, cl_mem scene,
                             const rt_photon_map *map, const rt_gather_options *options, rt_error *error)
{
    float max_radius = options->max_radius > 0 ? options->max_radius : HUGE_VALF;
    rt_gatherer *g = calloc(1, sizeof *g);

    if (!g)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory to gather");
    g->device = device;
    g->kernel = kernel;
    g->scene = scene;
    rt_status status = rt_photon_search_create(&g->search, map, options->k, max_radius, device->threads, error);
    if (status == RT_OK) {
        size_t stride = rt_photon_search_stride(g->search);
        size_t most = ENTRIES_A_BATCH / (stride ? stride : 1);
        g->capacity = most < 1 ? 1 : most > POINTS_A_BATCH ? POINTS_A_BATCH : most;
        g->estimate = (rt_density_params){options->density, options->cone_k, (rt_u32)stride, 0};
        status = create_buffers(g, map, error);
    }
    if (status == RT_OK)
        *out = g;
    else
        rt_gatherer_destroy(g);
    return status;
}

void rt_gatherer_destroy(rt_gatherer *g)
{
    if (!g)
        return;
    rt_photon_search_destroy(g->search);
    rt_buffer_release(g->photons);
    rt_buffer_release(g->points);
    rt_buffer_release(g->discs);
    rt_buffer_release(g->lists);
    free(g->host_points);
    free(g->host_discs);
    free(g->host_lists);
    free(g);
}

size_t rt_gatherer_capacity(const rt_gatherer *g)
{
    return g->capacity;
}

cl_mem rt_gatherer_points(const rt_gatherer *g)
{
    return g->points;
}

/* Finds the photons of the points in the device's buffer and sends them there. */
static rt_status find(rt_gatherer *g, size_t count, uint64_t *asked, rt_error *error)
{
    rt_status status = rt_buffer_read(g->device, g->points, 0, count * sizeof *g->host_points, g->host_points, error);
    if (status == RT_OK)
        status = rt_photon_search_find(g->search, g->host_points, count, g->host_lists, g->host_discs, asked, error);
    if (status == RT_OK)
        status = rt_buffer_write(g->device, g->discs, 0, count * sizeof *g->host_discs, g->host_discs, error);
    if (status == RT_OK)
        status = rt_buffer_write(g->device, g->lists, 0, count * g->estimate.stride * sizeof *g->host_lists,
                                 g->host_lists, error);
    return status;
}

rt_status rt_gatherer_add(rt_gatherer *g, size_t count, cl_mem film, uint64_t *asked, rt_error *error)
{
    rt_params params;
    memset(&params, 0, sizeof params);
    params.item_count = (rt_u32)count;

    rt_arg args[] = {RT_ARG(params),   RT_ARG(g->scene), RT_ARG(g->estimate), RT_ARG(g->points),
                     RT_ARG(g->discs), RT_ARG(g->lists), RT_ARG(g->photons),  RT_ARG(film)};
    rt_status status = find(g, count, asked, error);
    if (status == RT_OK)
        status = rt_kernel_args(g->kernel, args, sizeof args / sizeof *args, error);
    if (status == RT_OK)
        status = rt_launch(g->device, g->kernel, count, error);
    return status == RT_OK ? rt_device_finish(g->device, error) : status;
}
