/*
 * halvings.h - the density estimates of one point from discs of r^2, r^2/2, r^2/4 and so on, by the
 * same photons.
 *
 * The difference of two of them has as its expected value the difference of their biases, whatever
 * the light is; and as they share photons, less noise than two estimates apart. The variance of an
 * estimate is that of a compound Poisson process: the sum of the squares of what photons bring.
 *
 * Reference: Scott: "Multivariate Density Estimation", Wiley 1992, section 6.5: the choice of a
 *   bandwidth by estimates of bias and variance.
 */
#ifndef RT_KERNELS_PHOTON_HALVINGS_H
#define RT_KERNELS_PHOTON_HALVINGS_H

#include "photon/sum.h"

struct halving_sums {
    float light[RT_RADIUS_HALVINGS + 1u]; /* the estimate by each disc, the largest first */
    float squares[2]; /* of what each photon brings to the largest, and to number LARGER */
};

/* Adds the photons of a block that are in `lanes`; *bsdf: 0 where fr is constant. */
INLINE_NEVER void add_to_halvings(struct halving_sums *sums, global const rt_photon_block *block,
                                  const struct bsdf *bsdf, float3 weight,
                                  const rt_density_params *estimate, float8 d2, float r2,
                                  uint lanes)
{
    float light[8];
    for (uint rest = lanes; rest; rest &= rest - 1u) {
        const uint i = lane_first(rest);
        const float3 flux = (float3)(block->flux[0][i], block->flux[1][i], block->flux[2][i]);
        const float3 wi = (float3)(block->wi[0][i], block->wi[1][i], block->wi[2][i]);
        light[i] = mean3(weight * (bsdf ? fr_of_point(bsdf, wi) : (float3)(M_1_PI_F)) * flux);
    }
    for (uint l = 0u; l <= RT_RADIUS_HALVINGS; l++, r2 *= 0.5f) {
        const struct lane_array k =
            lane_array(density_kernel8(estimate->density, estimate->cone_k, d2, r2));
        for (uint rest = lanes; rest; rest &= rest - 1u) {
            const uint i = lane_first(rest);
            const float brought = lane_read(&k, i) * light[i];
            sums->light[l] += brought;
            if (l == 0u || l == RT_RADIUS_LARGER)
                sums->squares[l > 0u] += square(brought);
        }
    }
}

/* From the accepted photons strictly nearer than the radius, in the order of the tree. */
INLINE_NEVER struct halving_sums sums_of_halvings(const struct photon_tree *tree,
                                                  const struct photon_start *start,
                                                  const struct photon_query *query,
                                                  const rt_density_params *estimate, float r2)
{
    const struct bsdf bsdf = bsdf_of_point(query->point, query->header);
    const bool is_constant = point_is_constant(query->point);
    const float3 weight = row3(query->point->weight) * estimate->scale;
    struct halving_sums sums;
    struct tree_traversal traversal;
    uint first, mask;
    for (uint l = 0u; l <= RT_RADIUS_HALVINGS; l++)
        sums.light[l] = 0.0f;
    sums.squares[0] = sums.squares[1] = 0.0f;
    traversal_start(&traversal, start);
    while (traversal_next(&traversal, tree, query, r2, &first, &mask))
        for (; mask; mask &= mask - 1u) {
            global const rt_photon_block *block = tree->blocks + first + lane_first(mask);
            const float8 d2 = photon_distances(block, query);
            const uint lanes = lane_mask(d2 < r2 && photons_accepted(block, query));
            if (lanes)
                add_to_halvings(&sums, block, is_constant ? 0 : &bsdf, weight, estimate, d2, r2,
                                lanes);
        }
    return sums;
}

#endif
