/*
 * knn.cl - the photons that the gather on the device counts at each point, in no particular order,
 * by their places in the order of the tree.
 */
#include "entry.h"
#include "photon/sum.h"

/* Lists the photons of the disc that sum found; returns the disc. */
static rt_gather_disc list_photons(const struct photon_tree *tree, const struct photon_start *start,
                                   const struct photon_query *query, const struct photon_sum *sum,
                                   uint slots, global uint *list)
{
    rt_gather_disc disc;
    disc.count = 0u;
    disc.squared_radius = sum->squared_radius;
    disc.is_query = sum->count;
    struct tree_traversal traversal;
    uint first, mask;
    traversal_start(&traversal, start);
    while (traversal_next(&traversal, tree, query, sum->squared_radius, &first, &mask))
        for (; mask; mask &= mask - 1u) {
            const uint index = first + lane_first(mask);
            global const rt_photon_block *block = tree->blocks + index;
            uint lanes = lane_mask(photon_distances(block, query) < sum->squared_radius &&
                                   photons_accepted(block, query));
            for (; lanes; lanes &= lanes - 1u) {
                if (disc.count < slots)
                    list[disc.count] = 8u * index + lane_first(lanes);
                disc.count++;
            }
        }
    return disc;
}

/*
 * lists: [item_count][params.slots]; the arguments before them are those of gather_tree, in its
 * order.
 */
kernel void neighbours(const rt_params params, const rt_density_params estimate,
                       global const rt_gather_point *points, global rt_gather_disc *discs,
                       const rt_photon_tree shape, global const rt_photon_node *nodes,
                       global const rt_photon_block *blocks, global float *scratch,
                       global const float *own_limits, global uint *lists)
{
    const uint item = item_number();
    if (item >= params.item_count)
        return;
    struct photon_tree tree;
    tree.shape = shape;
    tree.nodes = nodes;
    tree.blocks = blocks;
    const struct photon_query query = query_of_point(points + item, 0);
    global float *own = scratch + (size_t)item * estimate.stride;
    struct photon_start start = start_at_root(&tree);
    struct photon_sum sum;
    /* By turns as one of a group of up to four points. */
    const uint first = item - item % 4u, count = min(1u + item % 4u, params.item_count - first);
    if (estimate.k == 0u) {
        start = start_of_points(&tree, points + first, count, &estimate, own_limits);
        sum = sum_within(&tree, &start, &query, &estimate,
                         point_limit(points + item, &estimate, own_limits));
    } else {
        /* By turns without a guess, with a good one, one much too large and one too small. */
        struct group_start group = group_at_root(&tree);
        sum = sum_nearest(&tree, &group, &query, &estimate, 0.0f, own);
        if (item % 4u) {
            const float guess = sum.squared_radius * (item % 4u == 1u   ? 1.3f
                                                      : item % 4u == 2u ? 30.0f
                                                                        : 0.5f);
            if (tree.shape.levels > 0u && guess < INFINITY)
                group = start_of_group(&tree, points + first, count, guess);
            sum = sum_nearest(&tree, &group, &query, &estimate, guess, own);
        }
    }

    rt_gather_disc disc = list_photons(&tree, &start, &query, &sum, params.slots,
                                       lists + (size_t)item * params.slots);
    disc.pixel = points[item].pixel;
    discs[item] = disc;
}
