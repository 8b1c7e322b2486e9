/* gather.c - the gatherer, which dispatches to one of the two searches. */
#include "photon/gather.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "photon/gather_neighbours.h"
#include "photon/gather_tree.h"
#include "render/prepare.h"

struct rt_gatherer {
    rt_device *device;
    cl_kernel kernel;
    rt_photon_search search;
    size_t capacity;                /* points a batch */
    rt_neighbour_gather neighbours; /* one of the two is used */
    rt_tree_gather tree;
};

enum { POINTS_MAX_CPU = 1 << 16, POINTS_MAX_GPU = 1 << 18 };

rt_photon_search rt_photon_search_of(const rt_render_options *options)
{
    const rt_render_options *o = options;
    if (o->k == RT_K_ALL || o->caustic_k == RT_K_ALL)
        return RT_SEARCH_TREE;
    const int on_host = o->gather == RT_GATHER_FLANN || o->area == RT_AREA_HULL;
    return on_host ? RT_SEARCH_NEIGHBOURS : RT_SEARCH_TREE;
}

size_t rt_gather_points_max(const rt_device *device)
{
    return device->info.is_cpu ? POINTS_MAX_CPU : POINTS_MAX_GPU;
}

const char *rt_gather_kernel_name(rt_photon_search search, int is_plain)
{
    switch (search) {
    case RT_SEARCH_NEIGHBOURS:
        return "gather_neighbours";
    case RT_SEARCH_TREE:
        return is_plain ? "gather_tree_plain" : "gather_tree";
    case RT_SEARCH_IRRADIANCE:
        return "gather_irradiance";
    }
    return NULL;
}

rt_status rt_gather_kernel_prepare(cl_kernel *out, rt_device *device, rt_photon_search search,
                                   int is_plain, cl_mem any, rt_stage_progress *progress,
                                   rt_error *error)
{
    const char *name = rt_gather_kernel_name(search, is_plain);
    rt_params params;
    rt_density_params estimate;
    rt_photon_tree tree;
    memset(&params, 0, sizeof params);
    memset(&estimate, 0, sizeof estimate);
    memset(&tree, 0, sizeof tree);
    rt_arg list_args[] = {RT_ARG(params), RT_ARG(estimate), RT_ARG(any), RT_ARG(any),
                          RT_ARG(any),    RT_ARG(any),      RT_ARG(any)};
    rt_arg tree_args[] = {RT_ARG(params), RT_ARG(estimate), RT_ARG(any), RT_ARG(any), RT_ARG(tree),
                          RT_ARG(any),    RT_ARG(any),      RT_ARG(any), RT_ARG(any), RT_ARG(any)};
    if (search != RT_SEARCH_NEIGHBOURS)
        return rt_kernel_prepare(device, out, name, name, tree_args, 10, progress, error);
    return rt_kernel_prepare(device, out, name, name, list_args, 7, progress, error);
}

rt_status rt_gatherer_create(rt_gatherer **out, rt_device *device, cl_kernel kernel,
                             const rt_photon_list *list, const rt_gather_options *options,
                             rt_tree_place *place, rt_error *error)
{
    float max_radius = options->max_radius > 0 ? options->max_radius : HUGE_VALF;
    rt_density_params estimate;
    rt_gatherer *g = calloc(1, sizeof *g);
    rt_status status;

    if (!g)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory to gather");
    memset(&estimate, 0, sizeof estimate);
    estimate.density = options->density;
    estimate.cone_k = options->cone_k;
    estimate.k = options->k;
    estimate.squared_limit = max_radius * max_radius;
    estimate.scale = list->emitted ? (float)(1.0 / (double)list->emitted) : 0;
    estimate.area = options->area;
    g->device = device;
    g->kernel = kernel;
    g->search = options->search;
    g->capacity = rt_gather_points_max(device);
    if (g->search != RT_SEARCH_NEIGHBOURS) {
        status = rt_tree_gather_prepare(&g->tree, device, list, &estimate, place, &g->capacity,
                                        options->hooks, error);
    } else {
        status = rt_neighbour_gather_prepare(&g->neighbours, device, list, &estimate, max_radius,
                                             options->skip_empty, g->capacity, error);
        g->capacity = g->neighbours.capacity;
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
    rt_device_settle(g->device);
    rt_neighbour_gather_release(&g->neighbours, g->device);
    rt_tree_gather_release(&g->tree, g->device);
    free(g);
}

void rt_gatherer_limit_pixels(rt_gatherer *g, cl_mem squared, float factor)
{
    assert(g->search == RT_SEARCH_TREE && factor > 0);
    g->tree.own_limits = squared;
    g->tree.estimate.own_limits = factor;
}

void rt_gatherer_set_scene(rt_gatherer *g, cl_mem scene)
{
    g->tree.scene = g->neighbours.scene = scene;
}

void rt_gatherer_scale(rt_gatherer *g, float factor)
{
    assert(g->search == RT_SEARCH_TREE && g->tree.estimate.k == 0);
    g->tree.estimate.own_limits *= factor;
    g->tree.estimate.squared_limit *= factor;
}

void rt_gatherer_set_density(rt_gatherer *g, rt_density density, float cone_k)
{
    rt_density_params *estimate =
        g->search != RT_SEARCH_NEIGHBOURS ? &g->tree.estimate : &g->neighbours.estimate;
    estimate->density = density;
    estimate->cone_k = cone_k;
}

size_t rt_gatherer_capacity(const rt_gatherer *g)
{
    return g->capacity;
}

cl_mem rt_gatherer_discs(const rt_gatherer *g)
{
    return g->search == RT_SEARCH_TREE ? g->tree.discs : NULL;
}

rt_status rt_gatherer_add(rt_gatherer *g, cl_mem points, size_t first, size_t count,
                          rt_gather_disc *discs, rt_error *error)
{
    rt_device *device = g->device;
    rt_status status;
    if (g->search != RT_SEARCH_NEIGHBOURS) {
        status = rt_tree_gather_launch(&g->tree, device, g->kernel, points, first, count, error);
        if (status == RT_OK && discs)
            status = rt_buffer_read(device, g->tree.discs, 0, count * sizeof *discs, discs, error);
    } else {
        status = rt_neighbour_gather_launch(&g->neighbours, device, g->kernel, points, first, count,
                                            discs, error);
    }
    return status == RT_OK ? rt_device_finish(device, error) : status;
}

rt_status rt_gatherer_add_again(rt_gatherer *g, cl_mem points, size_t first, size_t count,
                                rt_error *error)
{
    if (g->search != RT_SEARCH_NEIGHBOURS)
        return rt_gatherer_add(g, points, first, count, NULL, error);
    rt_status status =
        rt_neighbour_gather_sum(&g->neighbours, g->device, g->kernel, points, first, count, error);
    return status == RT_OK ? rt_device_finish(g->device, error) : status;
}

rt_status rt_gatherer_count_sectors(rt_gatherer *g, cl_kernel kernel, cl_mem points, size_t count,
                                    cl_mem tests, rt_error *error)
{
    assert(g->search == RT_SEARCH_TREE && g->tree.own_limits);
    rt_status status =
        rt_tree_gather_sectors(&g->tree, g->device, kernel, points, count, tests, error);
    return status == RT_OK ? rt_device_finish(g->device, error) : status;
}
