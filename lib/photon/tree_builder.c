/* tree_builder.c - sorts photons on the device, fills blocks, and bounds nodes level by level. */
#include "photon/tree_builder.h"

#include <string.h>

rt_status rt_tree_builder_create(rt_tree_builder *out, rt_device *device, rt_error *error)
{
    static const char program[] = "photon_tree";
    memset(out, 0, sizeof *out);
    rt_status status = rt_photon_sorter_create(&out->sorter, device, error);
    if (status == RT_OK)
        status = rt_device_kernel(device, &out->fill, program, "fill_blocks", NULL, error);
    if (status == RT_OK)
        status = rt_device_kernel(device, &out->bound_blocks, program, "bound_blocks", NULL, error);
    if (status == RT_OK)
        status = rt_device_kernel(device, &out->bound_nodes, program, "bound_nodes", NULL, error);
    if (status != RT_OK)
        rt_tree_builder_release(out);
    return status;
}

void rt_tree_builder_release(rt_tree_builder *builder)
{
    rt_kernel_release(builder->fill);
    rt_kernel_release(builder->bound_blocks);
    rt_kernel_release(builder->bound_nodes);
    rt_photon_sorter_release(&builder->sorter);
    memset(builder, 0, sizeof *builder);
}

/* Fills the blocks, and bounds those of each node of the lowest level. */
static rt_status build_blocks(const rt_tree_builder *b, cl_mem photons, const rt_photon_tree *shape,
                              rt_u32 nodes_here, cl_mem nodes, cl_mem blocks, rt_error *error)
{
    rt_u32 count = shape->photon_count, block_count = shape->block_count;
    rt_arg fill[] = {RT_ARG(count), RT_ARG(block_count), RT_ARG(b->sorter.items), RT_ARG(photons),
                     RT_ARG(blocks)};
    rt_arg bound[] = {RT_ARG(count), RT_ARG(nodes_here), RT_ARG(blocks), RT_ARG(nodes)};
    rt_status status = rt_run(b->sorter.device, b->fill, fill, 5, (size_t)block_count * 8, error);
    return status == RT_OK
               ? rt_run(b->sorter.device, b->bound_blocks, bound, 4, (size_t)nodes_here * 8, error)
               : status;
}

rt_status rt_tree_builder_run(rt_tree_builder *b, cl_mem photons, const rt_photon_tree *shape,
                              size_t node_count, cl_mem nodes, cl_mem blocks, rt_error *error)
{
    if (shape->photon_count == 0)
        return RT_OK;
    rt_status status = rt_photon_sorter_run(&b->sorter, photons, shape->photon_count, error);
    rt_u32 below = 0, children = 0;
    for (rt_u32 level = 0; level < shape->levels && status == RT_OK; level++) {
        rt_u32 first = shape->first_node[level];
        rt_u32 end = level + 1 < shape->levels ? shape->first_node[level + 1] : (rt_u32)node_count;
        rt_u32 here = end - first;
        rt_arg args[] = {RT_ARG(below), RT_ARG(children), RT_ARG(first), RT_ARG(here),
                         RT_ARG(nodes)};
        status = level == 0
                     ? build_blocks(b, photons, shape, here, nodes, blocks, error)
                     : rt_run(b->sorter.device, b->bound_nodes, args, 5, (size_t)here * 8, error);
        below = first;
        children = here;
    }
    return status;
}

void rt_tree_place_release(rt_tree_place *place, rt_device *device)
{
    rt_buffer_release(device, place->nodes);
    rt_buffer_release(device, place->blocks);
    rt_buffer_release(device, place->scratch);
    rt_buffer_release(device, place->discs);
    place->nodes = place->blocks = place->scratch = place->discs = NULL;
}
