/*
 * sectors.h - the photons in the sectors of a disc, and the tests of whether they are even.
 *
 * The disc is cut into RT_RADIUS_SECTORS parts of equal area: two rings, an inner one out to the
 * radius over the root of 2, each of four quadrants about the normal. Where light is even, as many
 * photons fall into each, and the estimate has no bias. Two tests of that:
 *
 *   cppm   Pearson's chi-square of the counts c_i of n sectors,
 *            X^2 = sum of (c_i - C)^2 / C,  C = mean of c_i,
 *          chi-square of n - 1 degrees of freedom where photons are even and independent.
 *   ftest  analysis of variance of the light y_ij that pass j brings to sector i of n, in m passes:
 *            F = (m sum over i of (y_i - y)^2 / (n - 1))
 *                / (sum over i, j of (y_ij - y_i)^2 / (n (m - 1))),
 *          with means y_i over passes and y over all: of n - 1 and n (m - 1) degrees of freedom
 *          where the light is even. Photons of a path may depend on each other, and photons of one
 *          pass too, as stratified ones do; passes are independent.
 *
 * References:
 *   Lin, Li, Zeng, Zhang, Jia, Wang, Manocha: "CPPM: Chi-squared Progressive Photon Mapping", ACM
 *     Transactions on Graphics 39(6), 2020.
 *   Lin, Hu, Jia, Li: "Hypothesis Testing for Progressive Kernel Estimation and VCM Framework",
 *     arXiv 2504.04411, 2025: the F-test.
 */
#ifndef RT_KERNELS_PHOTON_SECTORS_H
#define RT_KERNELS_PHOTON_SECTORS_H

#include "photon/sum.h"

/* What one pass brings to the sectors of a disc. */
struct sector_sums {
    uint count[RT_RADIUS_SECTORS];
    float light[RT_RADIUS_SECTORS];
};

/* The sector of a photon at this offset from the middle; the frame has the normal. */
static inline uint sector_of(struct frame frame, float3 offset, float d2, float r2)
{
    const uint quadrant = (dot(offset, frame.s) < 0.0f) + 2u * (dot(offset, frame.t) < 0.0f);
    return quadrant + (d2 < 0.5f * r2 ? 0u : 4u);
}

/* Adds the photons of a block that are in `lanes`. */
INLINE_NEVER void add_to_sectors(struct sector_sums *sums, global const rt_photon_block *block,
                                 const struct photon_query *query, const struct bsdf *bsdf,
                                 float r2, uint lanes)
{
    const struct frame frame = frame_about(query->normal);
    for (; lanes; lanes &= lanes - 1u) {
        const uint i = lane_first(lanes);
        const float3 at =
            (float3)(block->position[0][i], block->position[1][i], block->position[2][i]);
        const float3 flux = (float3)(block->flux[0][i], block->flux[1][i], block->flux[2][i]);
        const float3 wi = (float3)(block->wi[0][i], block->wi[1][i], block->wi[2][i]);
        const float3 offset = at - query->position;
        const uint sector = sector_of(frame, offset, dot(offset, offset), r2);
        sums->count[sector]++;
        sums->light[sector] += mean3(fr_of_point(bsdf, wi) * flux);
    }
}

/* The accepted photons strictly nearer than the radius, in the order of the tree. */
INLINE_NEVER struct sector_sums sectors_within(const struct photon_tree *tree,
                                               const struct photon_start *start,
                                               const struct photon_query *query, float r2)
{
    const struct bsdf bsdf = bsdf_of_point(query->point, query->header);
    struct sector_sums sums;
    struct tree_traversal traversal;
    uint first, mask;
    for (uint i = 0u; i < RT_RADIUS_SECTORS; i++) {
        sums.count[i] = 0u;
        sums.light[i] = 0.0f;
    }
    traversal_start(&traversal, start);
    while (traversal_next(&traversal, tree, query, r2, &first, &mask))
        for (; mask; mask &= mask - 1u) {
            global const rt_photon_block *block = tree->blocks + first + lane_first(mask);
            const int8 inside = photon_distances(block, query) < r2;
            const uint lanes = lane_mask(inside && photons_accepted(block, query));
            if (lanes)
                add_to_sectors(&sums, block, query, &bsdf, r2, lanes);
        }
    return sums;
}

/* Pearson's chi-square of the counts; 0 without photons. */
static inline float chi_square_of(global const rt_radius_test *test)
{
    float sum = 0.0f, squares = 0.0f;
    for (uint i = 0u; i < RT_RADIUS_SECTORS; i++)
        sum += (float)test->count[i];
    const float mean = sum / RT_RADIUS_SECTORS;
    for (uint i = 0u; i < RT_RADIUS_SECTORS; i++)
        squares += square((float)test->count[i] - mean);
    return sum > 0.0f ? squares / mean : 0.0f;
}

/* F of the light in the sectors; 0 before the second pass, and without light. */
static inline float f_of(global const rt_radius_test *test)
{
    const float n = RT_RADIUS_SECTORS, m = (float)test->passes;
    float mean = 0.0f, between = 0.0f, within = 0.0f;
    for (uint i = 0u; i < RT_RADIUS_SECTORS; i++)
        mean += test->light[i] / (n * m);
    for (uint i = 0u; i < RT_RADIUS_SECTORS; i++) {
        const float own = test->light[i] / m;
        between += square(own - mean);
        within += test->square[i] - m * square(own);
    }
    between *= m / (n - 1.0f);
    within /= n * (m - 1.0f);
    return test->passes > 1u && within > 0.0f ? between / within : 0.0f;
}

#endif
