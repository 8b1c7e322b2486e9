/*
 * gather_irradiance.cl - gathering of precomputed irradiance: each work-item finds, for a few
 * gather points, the nearest point at which the irradiance is known, and adds what Lambert's lobe
 * scatters of it.
 *
 *   L(x) = kd/pi E(nearest)      Christensen: "Faster Photon Map Global Illumination", Journal of
 *                                Graphics Tools 4(3), 1999
 */
#include "entry.h"
#include "surface/gather_point.h"
#include "photon/nearest.h"
#include "photon/sum.h"

/*
 * The arguments are those of gather_tree. The photons stand for points of known irradiance, W/m^2,
 * in place of flux. scratch, own_limits and header are not read. Points have Lambert's lobe.
 */
KERNEL gather_irradiance(const rt_params params, const rt_density_params estimate,
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
    for (uint i = begin; i < end; i++) {
        rt_gather_disc disc;
        disc.count = 0u;
        disc.squared_radius = 0.0f;
        disc.is_query = gathers_photons(points + i);
        disc.pixel = points[i].pixel;
        if (disc.is_query) {
            const struct photon_query query = query_of_point(points + i, header);
            const struct nearest_photon nearest =
                find_nearest(&tree, &query, estimate.squared_limit);
            if (nearest.squared < INFINITY) {
                global const rt_photon_block *block = tree.blocks + nearest.block;
                const uint lane = nearest.lane;
                disc.count = 1u;
                disc.squared_radius = nearest.squared;
                add_scattered(points + i, (float3)(block->flux[0][lane], block->flux[1][lane],
                                                   block->flux[2][lane]));
            }
        }
        discs[i] = disc;
    }
}
