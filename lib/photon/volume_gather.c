/* volume_gather.c - uploads the tree of volume photons. */
#include "photon/volume_gather.h"

#include <string.h>

static rt_status upload(rt_volume_gather *g, rt_device *device, rt_error *error)
{
    static const char what[] = "the tree of volume photons";
    /* A CPU device works on the host's memory; another gets its copy. */
    const size_t nodes = g->tree.node_count * sizeof *g->tree.nodes,
                 blocks = g->tree.shape.block_count * sizeof *g->tree.blocks;
    const cl_mem_flags flags =
        CL_MEM_READ_ONLY | (device->info.is_cpu && nodes > 0 ? CL_MEM_USE_HOST_PTR : 0);
    rt_status status = rt_buffer_create(device, &g->nodes, flags, nodes,
                                        nodes ? g->tree.nodes : NULL, what, error);
    return status == RT_OK ? rt_buffer_create(device, &g->blocks, flags, blocks,
                                              blocks ? g->tree.blocks : NULL, what, error)
                           : status;
}

rt_status rt_volume_gather_create(rt_volume_gather *out, rt_device *device,
                                  const rt_photon_list *list, const rt_volume_options *options,
                                  rt_error *error)
{
    const rt_volume_radii radii = {options->k, options->max_radius, options->factor};
    rt_volume_gather g = {.params = {.density = options->density,
                                     .cone_k = options->cone_k,
                                     .scale = list->emitted ? 1.0f / (float)list->emitted : 0,
                                     .estimate = options->estimate}};
    rt_status status =
        rt_volume_tree_build(&g.tree, list, &radii, device->threads, device->memory, error);
    if (status == RT_OK)
        status = upload(&g, device, error);
    if (status == RT_OK && !device->info.is_cpu) {
        const rt_photon_tree shape = g.tree.shape;
        rt_photon_tree_free(&g.tree);
        g.tree.shape = shape;
    }
    if (status == RT_OK)
        *out = g;
    else
        rt_volume_gather_release(&g, device);
    return status;
}

void rt_volume_gather_release(rt_volume_gather *gather, rt_device *device)
{
    if (gather->nodes)
        rt_device_settle(device); /* it may work on the tree in place */
    rt_buffer_release(device, gather->nodes);
    rt_buffer_release(device, gather->blocks);
    rt_photon_tree_free(&gather->tree);
    memset(gather, 0, sizeof *gather);
}
