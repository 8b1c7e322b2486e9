/*
 * gather_tree.cl - the tree gather: each work-item finds the photons around a few gather points in
 * the tree of photons, and adds to their radiance what the points' lobes scatter of them.
 */
#include "entry.h"
#include "photon/sum.h"
#include "surface/gather_point.h"

/*
 * points: those from params.first_item on; scratch: [items][estimate.stride]; discs: what was found
 * at each point, without the lists; own_limits: of each pixel, not read where estimate.own_limits
 * is 0; header: of the scene, not read where no lobe reads the material.
 */
KERNEL ENTRY(gather_tree)(const rt_params params, const rt_density_params estimate,
                          global rt_gather_point *points, global rt_gather_disc *discs,
                          const rt_photon_tree shape, global const rt_photon_node *nodes,
                          global const rt_photon_block *blocks, global float *scratch,
                          global const float *own_limits, global const rt_scene_header *header)
{
    const uint item = item_number();
    const uint begin = item * estimate.points_an_item,
               end = min(begin + estimate.points_an_item, params.item_count);
    struct photon_tree tree;
    points += params.first_item;
    tree.shape = shape;
    tree.nodes = nodes;
    tree.blocks = blocks;
    /* from the point before, with some to spare: k photons lie inside more often than not */
    float guess = 0.0f;
    struct photon_start start;
    struct group_start group = group_at_root(&tree);
    if (estimate.k == 0u && begin < end)
        start = start_of_points(&tree, points + begin, end - begin, &estimate, own_limits);

    for (uint i = begin; i < end; i++) {
        const struct photon_query query = query_of_point(points + i, header);
        rt_gather_disc disc;
        disc.count = 0u;
        disc.squared_radius = 0.0f;
        disc.is_query = gathers_photons(points + i);
        disc.pixel = points[i].pixel;
        if (disc.is_query) {
            if (estimate.k > 0u && guess > group.squared_radius && guess < estimate.squared_limit)
                group = start_of_group(&tree, points + i, end - i, guess);
            const struct photon_sum sum =
                estimate.k == 0u ? sum_within(&tree, &start, &query, &estimate,
                                              point_limit(points + i, &estimate, own_limits))
                                 : sum_nearest(&tree, &group, &query, &estimate, guess,
                                               scratch + (size_t)item * estimate.stride);
            guess = 1.3f * sum.squared_radius;
            disc.count = sum.count;
            disc.squared_radius = sum.squared_radius;
            if (sum.count > 0u)
                add_scattered(points + i, estimate.scale * sum.scattered);
        }
        discs[i] = disc;
    }
}
