/*
 * nearest.h - the photon nearest to a point.
 */
#ifndef RT_KERNELS_PHOTON_NEAREST_H
#define RT_KERNELS_PHOTON_NEAREST_H

#include "photon/knn.h"

/* Photons of any kind, in blocks that come near, among which one must be accepted. */
#define NEAREST_CANDIDATES 16384u

/* A photon in the tree. */
struct nearest_photon {
    float squared; /* distance; INFINITY where there is none */
    uint block, lane;
};

/* Takes the nearest of a block's accepted photons where it is nearer than the one so far. */
INLINE_ALWAYS void take_nearer(struct nearest_photon *nearest, const struct photon_tree *tree,
                               const struct photon_query *query, float bound, uint block)
{
    global const rt_photon_block *photons = tree->blocks + block;
    const float8 squared = photon_distances(photons, query);
    const uint mask =
        lane_mask(squared < fmin(bound, nearest->squared) && photons_accepted(photons, query));
    if (!mask)
        return;
    const struct lane_array each = lane_array(squared);
    nearest->lane = nearest_lane(squared, mask);
    nearest->squared = lane_read(&each, nearest->lane);
    nearest->block = block;
}

/* Takes the nearest of the blocks that one comes to by always going to the nearest child. */
INLINE_ALWAYS void descend_to_nearest(struct nearest_photon *nearest,
                                      const struct photon_tree *tree,
                                      const struct photon_query *query, float bound)
{
    uint index = 0u;
    for (uint level = tree->shape.levels; level-- > 0u;) {
        const float8 squared =
            box_distances(tree->nodes + tree->shape.first_node[level] + index, query);
        index = 8u * index + nearest_lane(squared, lane_mask(squared < INFINITY));
    }
    take_nearer(nearest, tree, query, bound, index);
}

/* Takes all that are nearer than the one so far, in the order of the tree. */
INLINE_ALWAYS void take_all_nearer(struct nearest_photon *nearest, const struct photon_tree *tree,
                                   const struct photon_query *query)
{
    const struct photon_start root = start_at_root(tree);
    struct tree_traversal traversal;
    uint first, mask;
    traversal_start(&traversal, &root);
    while (traversal_next(&traversal, tree, query, nearest->squared, &first, &mask))
        for (; mask; mask &= mask - 1u)
            take_nearer(nearest, tree, query, nearest->squared, first + lane_first(mask));
}

/*
 * The same where nothing is known yet, nearest boxes first; it gives up where none is accepted
 * among the NEAREST_CANDIDATES or more that are met first.
 */
INLINE_NEVER void search_nearest(struct nearest_photon *nearest, const struct photon_tree *tree,
                                 const struct photon_query *query, float bound)
{
    struct near_stack stack;
    uint candidates = 0u;
    stack.entry[0] = (tree->shape.levels - 1u) << ENTRY_LEVEL_SHIFT;
    stack.squared[0] = 0.0f;
    stack.count = 1u;
    while (stack.count > 0u && (candidates < NEAREST_CANDIDATES || nearest->squared < INFINITY)) {
        stack.count--;
        const float limit = fmin(bound, nearest->squared);
        if (!(stack.squared[stack.count] < limit))
            continue;
        const uint entry = stack.entry[stack.count], level = entry >> ENTRY_LEVEL_SHIFT,
                   index = entry & ENTRY_INDEX;
        const float8 squared =
            box_distances(tree->nodes + tree->shape.first_node[level] + index, query);
        uint near = lane_mask(squared < limit);
        if (level > 0u) {
            push_children(&stack, level, index, squared, near);
            continue;
        }
        candidates += 8u * popcount(near);
        for (; near; near &= near - 1u)
            take_nearer(nearest, tree, query, bound, 8u * index + lane_first(near));
    }
}

/* The nearest accepted photon within a squared radius; of several that are, one of them. */
INLINE_ALWAYS struct nearest_photon find_nearest(const struct photon_tree *tree,
                                                 const struct photon_query *query, float bound)
{
    struct nearest_photon nearest;
    nearest.squared = INFINITY;
    nearest.block = nearest.lane = 0u;
    if (tree->shape.levels == 0u)
        return nearest;
    descend_to_nearest(&nearest, tree, query, bound);
    if (UNLIKELY(nearest.squared == INFINITY))
        search_nearest(&nearest, tree, query, bound);
    else
        take_all_nearer(&nearest, tree, query);
    return nearest;
}

#endif
