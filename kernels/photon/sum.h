/*
 * sum.h - the density sum over a disc, by traversing the tree of photons.
 */
#ifndef RT_KERNELS_PHOTON_SUM_H
#define RT_KERNELS_PHOTON_SUM_H

#include "photon/density.h"
#include "surface/gather_point.h"
#include "photon/knn.h"

struct photon_sum {
    /* sum of flux K, of the emitted paths together, W/m^2, or of fr flux K: see gather_point.h */
    float3 scattered;
    float squared_radius;
    uint count; /* photons that count */
};

INLINE_ALWAYS float sum_lanes(float8 v)
{
    const float4 four = v.lo + v.hi;
    const float2 two = four.lo + four.hi;
    return two.x + two.y;
}

/* Adds fr flux K of the photons of a block that are in `lanes`. */
INLINE_ALWAYS float3 add_by_fr(float3 sum, const struct bsdf *bsdf,
                               global const rt_photon_block *block, float8 k, uint lanes)
{
    const struct lane_array weights = lane_array(k);
    for (; lanes; lanes &= lanes - 1u) {
        const uint i = lane_first(lanes);
        const float3 flux = (float3)(block->flux[0][i], block->flux[1][i], block->flux[2][i]);
        const float3 wi = (float3)(block->wi[0][i], block->wi[1][i], block->wi[2][i]);
        sum += lane_read(&weights, i) * fr_of_point(bsdf, wi) * flux;
    }
    return sum;
}

/* Sums over blocks of photons, of any kind and accepted. */
struct block_sums {
    float8 red, green, blue;
    float3 by_fr;
    uint candidates, count;
};

/* Adds the photons of a block that are strictly nearer than the radius. */
INLINE_ALWAYS void add_photons(struct block_sums *sums, global const rt_photon_block *block,
                               const struct photon_query *query, const rt_density_params *estimate,
                               const struct bsdf *bsdf, float r2)
{
    const float8 d2 = photon_distances(block, query);
    const int8 inside = d2 < r2;
    const int8 counted = inside && photons_accepted(block, query);
    const uint lanes = lane_mask(counted);
    sums->candidates += popcount(lane_mask(inside));
    if (!lanes)
        return;
    sums->count += popcount(lanes);
    const float8 k =
        counted ? density_kernel8(estimate->density, estimate->cone_k, d2, r2) : (float8)(0.0f);
    if (bsdf) {
        sums->by_fr = add_by_fr(sums->by_fr, bsdf, block, k, lanes);
        return;
    }
    sums->red = lane_mad(k, vload8(0, block->flux[0]), sums->red);
    sums->green = lane_mad(k, vload8(0, block->flux[1]), sums->green);
    sums->blue = lane_mad(k, vload8(0, block->flux[2]), sums->blue);
}

/*
 * Sums the accepted photons strictly nearer than the radius; returns how many there are of any
 * kind. The order of summing is that of the tree. list: of blocks that hold all of them, or none.
 * *bsdf: 0 where fr is constant.
 */
INLINE_ALWAYS uint sum_photons(struct photon_sum *sum, const struct photon_tree *tree,
                               const struct photon_start *start, const struct block_list *list,
                               const struct photon_query *query, const rt_density_params *estimate,
                               const struct bsdf *bsdf)
{
    const float r2 = sum->squared_radius;
    struct block_sums sums;
    struct tree_traversal traversal;
    uint first, mask;

    sums.red = sums.green = sums.blue = (float8)(0.0f);
    sums.by_fr = (float3)(0.0f);
    sums.candidates = sums.count = 0u;
    if (is_listed(list)) {
        for (uint i = 0u; i < list->count; i++)
            add_photons(&sums, tree->blocks + list->block[i], query, estimate, bsdf, r2);
    } else {
        traversal_start(&traversal, start);
        while (traversal_next(&traversal, tree, query, r2, &first, &mask))
            for (; mask; mask &= mask - 1u)
                add_photons(&sums, tree->blocks + first + lane_first(mask), query, estimate, bsdf,
                            r2);
    }
    sum->scattered =
        bsdf ? sums.by_fr
             : (float3)(sum_lanes(sums.red), sum_lanes(sums.green), sum_lanes(sums.blue));
    sum->count = sums.count;
    return sums.candidates;
}

/* By the point's fr, for each photon. */
INLINE_NEVER uint sum_by_fr(struct photon_sum *sum, const struct photon_tree *tree,
                            const struct photon_start *start, const struct block_list *list,
                            const struct photon_query *query, const rt_density_params *estimate)
{
    const struct bsdf bsdf = bsdf_of_point(query->point, query->header);
    return sum_photons(sum, tree, start, list, query, estimate, &bsdf);
}

/* By a constant fr. */
CALLED_ON_GPUS uint sum_flux(struct photon_sum *sum, const struct photon_tree *tree,
                             const struct photon_start *start, const struct block_list *list,
                             const struct photon_query *query, const rt_density_params *estimate)
{
    return sum_photons(sum, tree, start, list, query, estimate, 0);
}

INLINE_ALWAYS uint sum_disc(struct photon_sum *sum, const struct photon_tree *tree,
                            const struct photon_start *start, const struct block_list *list,
                            const struct photon_query *query, const rt_density_params *estimate)
{
    return UNLIKELY(!point_is_constant(query->point))
               ? sum_by_fr(sum, tree, start, list, query, estimate)
               : sum_flux(sum, tree, start, list, query, estimate);
}

/* Where the traversals of a group of points begin, up to a squared radius. */
struct group_start {
    struct photon_start start;
    float squared_radius;
};

/* Before there is a guess: at the root. */
INLINE_ALWAYS struct group_start group_at_root(const struct photon_tree *tree)
{
    struct group_start group;
    group.start = start_at_root(tree);
    group.squared_radius = 0.0f;
    return group;
}

/* As disc_radius, beside the sum, which has a stack of its own. */
CALLED_ON_GPUS float find_radius(const struct photon_tree *tree, const struct photon_start *start,
                                 const struct photon_query *query,
                                 const rt_density_params *estimate, float guess,
                                 global float *scratch, struct block_list *list)
{
    return disc_radius(tree, start, query, estimate, guess, scratch, list);
}

/* The estimate at a point of a group from the k nearest; guess and scratch as for disc_radius. */
INLINE_NEVER struct photon_sum sum_nearest(const struct photon_tree *tree,
                                           const struct group_start *group,
                                           const struct photon_query *query,
                                           const rt_density_params *estimate, float guess,
                                           global float *scratch)
{
    const struct photon_start root = start_at_root(tree);
    const struct block_list none = no_blocks();
    struct block_list list = none;
    struct photon_sum sum;
    sum.squared_radius = find_radius(tree, guess <= group->squared_radius ? &group->start : &root,
                                     query, estimate, guess, scratch, &list);
    const uint candidates =
        sum_disc(&sum, tree, sum.squared_radius <= group->squared_radius ? &group->start : &root,
                 &list, query, estimate);
    if (candidates >= estimate->max_candidates &&
        tree->shape.photon_count > estimate->max_candidates) {
        sum.squared_radius =
            candidate_distance(tree, query, estimate->max_candidates, sum.squared_radius);
        sum_disc(&sum, tree, &root, &none, query, estimate);
    }
    return sum;
}

/*
 * The estimate from all within a limit on the radius; start: that of a group which the point is in.
 */
INLINE_NEVER struct photon_sum sum_within(const struct photon_tree *tree,
                                          const struct photon_start *start,
                                          const struct photon_query *query,
                                          const rt_density_params *estimate, float squared_limit)
{
    const struct block_list none = no_blocks();
    struct photon_sum sum;
    sum.squared_radius = tree->shape.levels > 0u ? squared_limit : 0.0f;
    sum_disc(&sum, tree, start, &none, query, estimate);
    return sum;
}

/* Whether photons are gathered at a point: it has weight, and its position is finite. */
static inline bool gathers_photons(global const rt_gather_point *point)
{
    return any(row3(point->weight) != 0.0f) && all(isfinite(row3(point->position)));
}

/*
 * The limit on the squared radius at a point when all photons within it count; own_limits: of each
 * pixel.
 */
static inline float point_limit(global const rt_gather_point *point,
                                const rt_density_params *estimate, global const float *own_limits)
{
    return estimate->own_limits > 0.0f ? estimate->own_limits * own_limits[point->pixel]
                                       : estimate->squared_limit;
}

/* Where the traversals of a group of points begin when all photons within the limit count. */
static inline struct photon_start start_of_points(const struct photon_tree *tree,
                                                  global const rt_gather_point *points, uint count,
                                                  const rt_density_params *estimate,
                                                  global const float *own_limits)
{
    float3 low = (float3)(INFINITY), high = -low;
    float limit = 0.0f;
    for (uint i = 0u; i < count; i++)
        if (gathers_photons(points + i)) {
            low = min(low, row3(points[i].position));
            high = max(high, row3(points[i].position));
            limit = max(limit, point_limit(points + i, estimate, own_limits));
        }
    return start_near(tree, low, high, limit);
}

/*
 * Where the traversals of a group of points begin while their guesses are not much above this one.
 */
static inline struct group_start start_of_group(const struct photon_tree *tree,
                                                global const rt_gather_point *points, uint count,
                                                float guess)
{
    float3 low = (float3)(INFINITY), high = -low;
    for (uint i = 0u; i < count; i++)
        if (gathers_photons(points + i)) {
            low = min(low, row3(points[i].position));
            high = max(high, row3(points[i].position));
        }
    struct group_start group;
    group.squared_radius = 2.0f * guess;
    group.start = start_near(tree, low, high, group.squared_radius);
    return group;
}

#endif
