/*
 * gather_neighbours.c - makes neighbour lists on the host, and launches the kernel that sums them.
 */
#include "photon/gather_neighbours.h"

#include <string.h>

#include "base/memory.h"

/*
 * Bounds of a batch: the entries of its neighbour lists, and its length where there is little
 * memory.
 */
enum { ENTRIES_A_BATCH = 1 << 22, LEAST_BATCH = 64 };

static rt_status create_buffers(rt_neighbour_gather *g, rt_device *device,
                                const rt_photon_list *list, rt_error *error)
{
    static const char what[] = "a batch of gather points";
    size_t list_bytes = g->capacity * g->estimate.stride * sizeof *g->host_lists;
    cl_mem_flags in_place = device->info.is_cpu && list->count > 0 ? CL_MEM_USE_HOST_PTR : 0;
    rt_status status;

    rt_memory *memory = device->memory;
    g->host_points = rt_memory_alloc(memory, g->capacity, sizeof *g->host_points, what, error);
    if (g->host_points)
        g->host_discs = rt_memory_alloc(memory, g->capacity, sizeof *g->host_discs, what, error);
    if (g->host_discs)
        g->host_lists = rt_memory_alloc(memory, list_bytes, 1, what, error);
    if (!g->host_lists)
        return RT_ERROR_MEMORY;
    status = rt_buffer_create(device, &g->photons, CL_MEM_READ_ONLY | in_place,
                              list->count * sizeof *list->photons, list->photons, "the photon map",
                              error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &g->discs, CL_MEM_READ_ONLY,
                                  g->capacity * sizeof *g->host_discs, NULL,
                                  "the buffer of gather discs", error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &g->lists, CL_MEM_READ_ONLY, list_bytes, NULL,
                                  "the buffer of neighbour lists", error);
    return status;
}

static void release_buffers(rt_neighbour_gather *g, rt_device *device)
{
    rt_buffer_release(device, g->photons);
    rt_buffer_release(device, g->discs);
    rt_buffer_release(device, g->lists);
    g->photons = g->discs = g->lists = NULL;
    rt_memory_free(g->host_points);
    rt_memory_free(g->host_discs);
    rt_memory_free(g->host_lists);
    g->host_points = NULL;
    g->host_discs = NULL;
    g->host_lists = NULL;
}

rt_status rt_neighbour_gather_prepare(rt_neighbour_gather *g, rt_device *device,
                                      const rt_photon_list *list, const rt_density_params *estimate,
                                      float max_radius, int skip_empty, size_t capacity,
                                      rt_error *error)
{
    memset(g, 0, sizeof *g);
    rt_status status =
        rt_neighbour_search_create(&g->search, list, estimate->k, max_radius, skip_empty,
                                   device->threads, device->memory, error);
    if (status != RT_OK)
        return status;
    size_t stride = rt_neighbour_search_stride(g->search);
    size_t most = ENTRIES_A_BATCH / (stride ? stride : 1);
    g->capacity = most < 1 ? 1 : most < capacity ? most : capacity;
    g->estimate = *estimate;
    g->estimate.stride = (rt_u32)stride;
    status = create_buffers(g, device, list, error);
    while (status == RT_ERROR_MEMORY && g->capacity > LEAST_BATCH) {
        release_buffers(g, device);
        g->capacity /= 2;
        status = create_buffers(g, device, list, error);
    }
    return status;
}

void rt_neighbour_gather_release(rt_neighbour_gather *g, rt_device *device)
{
    rt_neighbour_search_destroy(g->search);
    release_buffers(g, device);
    memset(g, 0, sizeof *g);
}

/* Finds the photons of the points in the device's buffer and sends them there. */
static rt_status find(rt_neighbour_gather *g, rt_device *device, cl_mem points, size_t first,
                      size_t count, rt_error *error)
{
    rt_status status = rt_buffer_read(device, points, first * sizeof *g->host_points,
                                      count * sizeof *g->host_points, g->host_points, error);
    if (status == RT_OK)
        status = rt_neighbour_search_find(g->search, g->host_points, count, g->host_lists,
                                          g->host_discs, error);
    if (status == RT_OK)
        status = rt_buffer_write(device, g->discs, 0, count * sizeof *g->host_discs, g->host_discs,
                                 error);
    if (status == RT_OK)
        status =
            rt_buffer_write(device, g->lists, 0, count * g->estimate.stride * sizeof *g->host_lists,
                            g->host_lists, error);
    return status;
}

rt_status rt_neighbour_gather_sum(const rt_neighbour_gather *g, rt_device *device, cl_kernel kernel,
                                  cl_mem points, size_t first, size_t count, rt_error *error)
{
    rt_params params;
    memset(&params, 0, sizeof params);
    params.first_item = (rt_u32)first;
    params.item_count = (rt_u32)count;
    cl_mem scene = g->scene ? g->scene : g->photons; /* which is not read as one */

    rt_arg args[] = {RT_ARG(params),   RT_ARG(g->estimate), RT_ARG(points), RT_ARG(g->discs),
                     RT_ARG(g->lists), RT_ARG(g->photons),  RT_ARG(scene)};
    rt_status status = rt_kernel_args(kernel, args, sizeof args / sizeof *args, error);
    return status == RT_OK ? rt_launch(device, kernel, count, error) : status;
}

rt_status rt_neighbour_gather_launch(rt_neighbour_gather *g, rt_device *device, cl_kernel kernel,
                                     cl_mem points, size_t first, size_t count,
                                     rt_gather_disc *discs, rt_error *error)
{
    rt_status status = find(g, device, points, first, count, error);
    if (status == RT_OK)
        status = rt_neighbour_gather_sum(g, device, kernel, points, first, count, error);
    if (status == RT_OK && discs)
        memcpy(discs, g->host_discs, count * sizeof *discs);
    return status;
}
