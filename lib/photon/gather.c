#include "photon/gather.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "photon/device_gather.h"
#include "photon/search.h"

/* Bound of a batch on the host: the entries of its neighbour lists. */
enum { ENTRIES_A_BATCH = 1 << 22 };

/* The gather on the host: neighbours found by FLANN, and sent to the device. */
typedef struct host_gather {
    rt_photon_search *search;
    rt_density_params estimate;
    cl_mem photons;               /* rt_photon, the list */
    cl_mem discs;                 /* rt_gather_disc [capacity] */
    cl_mem lists;                 /* u32 [capacity][estimate.stride] */
    rt_gather_point *host_points; /* the same on the host */
    rt_gather_disc *host_discs;
    rt_u32 *host_lists;
} host_gather;

struct rt_gatherer {
    rt_device *device;
    cl_kernel kernel;
    size_t capacity; /* points a batch */
    int on_device;
    host_gather host; /* one of the two is used */
    rt_device_gather on;
};

static rt_status create_buffers(rt_gatherer *g, const rt_photon_list *list, rt_error *error)
{
    rt_device *device = g->device;
    host_gather *h = &g->host;
    size_t list_bytes = g->capacity * h->estimate.stride * sizeof *h->host_lists;
    cl_mem_flags in_place = device->info.is_cpu && list->count > 0 ? CL_MEM_USE_HOST_PTR : 0;
    rt_status status;

    h->host_points = malloc(g->capacity * sizeof *h->host_points);
    h->host_discs = malloc(g->capacity * sizeof *h->host_discs);
    h->host_lists = malloc(list_bytes ? list_bytes : 1);
    if (!h->host_points || !h->host_discs || !h->host_lists)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory to gather at %zu points", g->capacity);
    status = rt_buffer_create(device, &h->photons, CL_MEM_READ_ONLY | in_place,
                              list->count * sizeof *list->photons, list->photons, "the photon map",
                              error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &h->discs, CL_MEM_READ_ONLY,
                                  g->capacity * sizeof *h->host_discs, NULL, "gather discs", error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &h->lists, CL_MEM_READ_ONLY, list_bytes, NULL,
                                  "neighbour lists", error);
    return status;
}

static rt_status prepare_host(rt_gatherer *g, const rt_photon_list *list,
                              const rt_density_params *estimate, float max_radius, rt_error *error)
{
    host_gather *h = &g->host;
    rt_status status = rt_photon_search_create(&h->search, list, estimate->k, max_radius,
                                               g->device->threads, error);
    if (status != RT_OK)
        return status;
    size_t stride = rt_photon_search_stride(h->search),
           most = ENTRIES_A_BATCH / (stride ? stride : 1);
    if (most < g->capacity)
        g->capacity = most < 1 ? 1 : most;
    h->estimate = *estimate;
    h->estimate.stride = (rt_u32)stride;
    return create_buffers(g, list, error);
}

rt_status rt_gatherer_create(rt_gatherer **out, rt_device *device, cl_kernel kernel,
                             const rt_photon_list *list, const rt_gather_options *options,
                             rt_error *error)
{
    float max_radius = options->max_radius > 0 ? options->max_radius : HUGE_VALF;
    rt_density_params estimate = {options->density,
                                  options->cone_k,
                                  0,
                                  options->k,
                                  max_radius * max_radius,
                                  0,
                                  0,
                                  list->emitted ? (float)(1.0 / (double)list->emitted) : 0,
                                  options->area,
                                  0,
                                  {0}};
    rt_gatherer *g = calloc(1, sizeof *g);

    if (!g)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory to gather");
    g->device = device;
    g->kernel = kernel;
    g->capacity = RT_GATHER_POINTS_MAX;
    g->on_device = options->on_device;
    rt_status status =
        g->on_device ? rt_device_gather_prepare(&g->on, device, list, &estimate, g->capacity, error)
                     : prepare_host(g, list, &estimate, max_radius, error);
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
    rt_photon_search_destroy(g->host.search);
    rt_buffer_release(g->host.photons);
    rt_buffer_release(g->host.discs);
    rt_buffer_release(g->host.lists);
    free(g->host.host_points);
    free(g->host.host_discs);
    free(g->host.host_lists);
    rt_device_gather_release(&g->on);
    free(g);
}

void rt_gatherer_limit_pixels(rt_gatherer *g, cl_mem squared, float factor)
{
    assert(g->on_device && factor > 0);
    g->on.own_limits = squared;
    g->on.estimate.own_limits = factor;
}

size_t rt_gatherer_capacity(const rt_gatherer *g)
{
    return g->capacity;
}

/* Finds the photons of the points in the device's buffer and sends them there. */
static rt_status find(rt_gatherer *g, cl_mem points, size_t first, size_t count, rt_error *error)
{
    host_gather *h = &g->host;
    rt_status status = rt_buffer_read(g->device, points, first * sizeof *h->host_points,
                                      count * sizeof *h->host_points, h->host_points, error);
    if (status == RT_OK)
        status = rt_photon_search_find(h->search, h->host_points, count, h->host_lists,
                                       h->host_discs, error);
    if (status == RT_OK)
        status = rt_buffer_write(g->device, h->discs, 0, count * sizeof *h->host_discs,
                                 h->host_discs, error);
    if (status == RT_OK)
        status = rt_buffer_write(g->device, h->lists, 0,
                                 count * h->estimate.stride * sizeof *h->host_lists, h->host_lists,
                                 error);
    return status;
}

static rt_status add_from_host(rt_gatherer *g, cl_mem points, size_t first, size_t count,
                               rt_gather_disc *discs, rt_error *error)
{
    host_gather *h = &g->host;
    rt_params params;
    memset(&params, 0, sizeof params);
    params.first_item = (rt_u32)first;
    params.item_count = (rt_u32)count;

    rt_arg args[] = {RT_ARG(params),   RT_ARG(h->estimate), RT_ARG(points),
                     RT_ARG(h->discs), RT_ARG(h->lists),    RT_ARG(h->photons)};
    rt_status status = find(g, points, first, count, error);
    if (status == RT_OK)
        status = rt_kernel_args(g->kernel, args, sizeof args / sizeof *args, error);
    if (status == RT_OK)
        status = rt_launch(g->device, g->kernel, count, error);
    if (status == RT_OK && discs)
        memcpy(discs, h->host_discs, count * sizeof *discs);
    return status == RT_OK ? rt_device_finish(g->device, error) : status;
}

rt_status rt_gatherer_add(rt_gatherer *g, cl_mem points, size_t first, size_t count,
                          rt_gather_disc *discs, rt_error *error)
{
    if (!g->on_device)
        return add_from_host(g, points, first, count, discs, error);
    rt_status status =
        rt_device_gather_launch(&g->on, g->device, g->kernel, points, first, count, error);
    if (status == RT_OK && discs)
        status = rt_buffer_read(g->device, g->on.discs, 0, count * sizeof *discs, discs, error);
    return status == RT_OK ? rt_device_finish(g->device, error) : status;
}
