/* gather_tree.c - uploads the tree of photons, and launches the kernel that traverses it. */
#include "photon/gather_tree.h"

#include <string.h>

#include "base/error.h"
#include "base/progress.h"
#include "photon/neighbour_search.h"

/*
 * Scratch memory of all work-items together, in floats; points that one takes on a CPU, where few
 * run at once; and the shortest batch, where there is little memory.
 */
enum {
    SCRATCH_MAX_CPU = 1 << 24,
    SCRATCH_MAX_GPU = 1 << 26,
    POINTS_AN_ITEM_CPU = 16,
    LEAST_BATCH = 64
};

/*
 * Room for the distances of one search, and as much for the list of its blocks: twice k, so that
 * the selection of the k smallest is rare, and whole rows of eight.
 */
static size_t scratch_of(rt_u32 k)
{
    return k == 0 ? 0 : 2 * (((size_t)2 * k + 64) / 8 * 8);
}

static size_t items_of(const rt_tree_gather *g, size_t capacity)
{
    return (capacity + g->estimate.points_an_item - 1) / g->estimate.points_an_item;
}

static const char tree[] = "the photon tree", distance_list[] = "the buffer of distances",
                  disc_list[] = "the buffer of gather discs";

static rt_status create_buffers(rt_tree_gather *g, rt_device *device, size_t capacity,
                                rt_error *error)
{
    /* A CPU device works on the host's memory; another gets its copy. */
    cl_mem_flags flags = CL_MEM_READ_ONLY | (device->info.is_cpu ? CL_MEM_USE_HOST_PTR : 0);
    size_t nodes = g->tree.node_count * sizeof *g->tree.nodes;
    size_t blocks = g->tree.shape.block_count * sizeof *g->tree.blocks;
    rt_status status = rt_buffer_create(device, &g->nodes, nodes ? flags : CL_MEM_READ_ONLY, nodes,
                                        nodes ? g->tree.nodes : NULL, tree, error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &g->blocks, blocks ? flags : CL_MEM_READ_ONLY, blocks,
                                  blocks ? g->tree.blocks : NULL, tree, error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &g->scratch, CL_MEM_READ_WRITE,
                                  items_of(g, capacity) * g->estimate.stride * sizeof(float), NULL,
                                  distance_list, error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &g->discs, CL_MEM_READ_WRITE,
                                  capacity * sizeof(rt_gather_disc), NULL, disc_list, error);
    return status;
}

/* The same in the memory of a place. */
static rt_status reserve_buffers(rt_tree_gather *g, rt_device *device, size_t capacity,
                                 rt_error *error)
{
    rt_tree_place *place = g->place;
    rt_status status = rt_buffer_reserve(device, &place->nodes,
                                         g->tree.node_count * sizeof *g->tree.nodes, tree, error);
    if (status == RT_OK)
        status = rt_buffer_reserve(device, &place->blocks,
                                   g->tree.shape.block_count * sizeof *g->tree.blocks, tree, error);
    if (status == RT_OK)
        status = rt_buffer_reserve(device, &place->scratch,
                                   items_of(g, capacity) * g->estimate.stride * sizeof(float),
                                   distance_list, error);
    if (status == RT_OK)
        status = rt_buffer_reserve(device, &place->discs, capacity * sizeof(rt_gather_disc),
                                   disc_list, error);
    g->nodes = place->nodes;
    g->blocks = place->blocks;
    g->scratch = place->scratch;
    g->discs = place->discs;
    return status;
}

static void release_buffers(rt_tree_gather *g, rt_device *device)
{
    if (!g->place) {
        rt_buffer_release(device, g->nodes);
        rt_buffer_release(device, g->blocks);
        rt_buffer_release(device, g->scratch);
        rt_buffer_release(device, g->discs);
    }
    g->nodes = g->blocks = g->scratch = g->discs = NULL;
}

/* Makes the buffers for fewer points at a time where there is not enough memory. */
static rt_status create_for(rt_tree_gather *g, rt_device *device, size_t *capacity, rt_error *error)
{
    rt_status status = g->place ? reserve_buffers(g, device, *capacity, error)
                                : create_buffers(g, device, *capacity, error);
    while (status == RT_ERROR_MEMORY && *capacity > LEAST_BATCH) {
        release_buffers(g, device);
        *capacity /= 2;
        status = g->place ? reserve_buffers(g, device, *capacity, error)
                          : create_buffers(g, device, *capacity, error);
    }
    return status;
}

/* Builds the tree on the host, where the list lies. */
static rt_status build_on_host(rt_tree_gather *g, rt_device *device, const rt_photon_list *list,
                               size_t *capacity, rt_error *error)
{
    rt_status status = rt_photon_tree_build(&g->tree, list, device->threads, device->memory, error);
    if (status == RT_OK)
        status = create_for(g, device, capacity, error);
    if (status == RT_OK && !device->info.is_cpu) {
        rt_photon_tree shape = g->tree.shape;
        rt_photon_tree_free(&g->tree);
        g->tree.shape = shape;
    }
    return status;
}

/* Builds it on the device, where the list lies; where there is no room for that, on the host. */
static rt_status build_on_device(rt_tree_gather *g, rt_device *device, const rt_photon_list *list,
                                 rt_tree_place *place, size_t *capacity, const rt_hooks *hooks,
                                 rt_error *error)
{
    const size_t asked = *capacity;
    g->place = place;
    rt_status status =
        rt_photon_tree_lay_out(&g->tree.shape, &g->tree.node_count, list->count, error);
    if (status == RT_OK)
        status = create_for(g, device, capacity, error);
    if (status == RT_OK)
        status = rt_tree_builder_run(place->builder, list->buffer, &g->tree.shape,
                                     g->tree.node_count, g->nodes, g->blocks, error);
    if (status != RT_ERROR_MEMORY)
        return status;
    rt_log(hooks, "the tree of photons is built on the host: the device has no room to build it");
    rt_photon_list host = {.memory = list->memory};
    rt_device_settle(device);
    release_buffers(g, device);
    rt_tree_place_release(place, device);
    g->place = NULL;
    *capacity = asked;
    status = rt_photon_list_read(&host, list, error);
    if (status == RT_OK)
        status = build_on_host(g, device, &host, capacity, error);
    rt_photon_list_clear(&host);
    return status;
}

rt_status rt_tree_gather_prepare(rt_tree_gather *g, rt_device *device, const rt_photon_list *list,
                                 const rt_density_params *estimate, rt_tree_place *place,
                                 size_t *capacity, const rt_hooks *hooks, rt_error *error)
{
    size_t stride = scratch_of(estimate->k),
           most = device->info.is_cpu ? SCRATCH_MAX_CPU : SCRATCH_MAX_GPU,
           least = (*capacity * stride + most - 1) / most;
    size_t usual = device->info.is_cpu ? POINTS_AN_ITEM_CPU : 1;
    memset(g, 0, sizeof *g);
    g->estimate = *estimate;
    g->estimate.stride = (rt_u32)stride;
    g->estimate.max_candidates = RT_CANDIDATES_MAX * estimate->k;
    g->estimate.points_an_item = (rt_u32)(least > usual ? least : usual);
    return list->buffer ? build_on_device(g, device, list, place, capacity, hooks, error)
                        : build_on_host(g, device, list, capacity, error);
}

void rt_tree_gather_release(rt_tree_gather *g, rt_device *device)
{
    release_buffers(g, device);
    rt_photon_tree_free(&g->tree);
    memset(g, 0, sizeof *g);
}

rt_status rt_tree_gather_launch(const rt_tree_gather *g, rt_device *device, cl_kernel kernel,
                                cl_mem points, size_t first, size_t count, rt_error *error)
{
    size_t each = g->estimate.points_an_item;
    rt_params params;
    memset(&params, 0, sizeof params);
    params.first_item = (rt_u32)first;
    params.item_count = (rt_u32)count;
    cl_mem own_limits = g->own_limits ? g->own_limits : g->scratch; /* which is not read */
    cl_mem scene = g->scene ? g->scene : g->scratch;
    rt_arg args[] = {RT_ARG(params),    RT_ARG(g->estimate),   RT_ARG(points),
                     RT_ARG(g->discs),  RT_ARG(g->tree.shape), RT_ARG(g->nodes),
                     RT_ARG(g->blocks), RT_ARG(g->scratch),    RT_ARG(own_limits),
                     RT_ARG(scene)};
    rt_status status = rt_kernel_args(kernel, args, sizeof args / sizeof *args, error);
    return status == RT_OK ? rt_launch(device, kernel, (count + each - 1) / each, error) : status;
}

rt_status rt_tree_gather_sectors(const rt_tree_gather *g, rt_device *device, cl_kernel kernel,
                                 cl_mem points, size_t count, cl_mem tests, rt_error *error)
{
    size_t each = g->estimate.points_an_item;
    rt_params params;
    memset(&params, 0, sizeof params);
    params.item_count = (rt_u32)count;
    cl_mem scene = g->scene ? g->scene : g->scratch;
    rt_arg args[] = {RT_ARG(params),        RT_ARG(g->estimate), RT_ARG(points),
                     RT_ARG(g->tree.shape), RT_ARG(g->nodes),    RT_ARG(g->blocks),
                     RT_ARG(g->own_limits), RT_ARG(tests),       RT_ARG(scene)};
    rt_status status = rt_kernel_args(kernel, args, sizeof args / sizeof *args, error);
    return status == RT_OK ? rt_launch(device, kernel, (count + each - 1) / each, error) : status;
}
