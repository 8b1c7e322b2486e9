/*
 * knn.h - the disc around a point whose photons count, by the rules of the host's search (search.h): it ends at
 * the k-th accepted photon, at the limit on the radius, or at the (16 k)-th photon of any kind, and the photons
 * strictly nearer count.
 *
 * The k-th distance is found in two steps. Photons near each other in the tree's order are near in space, so
 * those around the nearest block give an upper bound on it. All that are nearer than the bound are then
 * collected, by distance alone, and the k-th smallest selected. No lists are kept: knowing the radius, the sum
 * walks the tree again.
 */
#ifndef RT_KNN_H
#define RT_KNN_H

#include "photon_tree.h"

/* Distances found so far: no more than `capacity`, of which the k smallest matter. */
struct distances {
    global float *squared;
    uint count, capacity; /* a multiple of 8, at least k + 16 */
    uint k;
    float bound; /* what is not below it does not matter */
};

/*
 * The k-th smallest of the distances, k <= count. Floats that are not negative are in the order of their
 * bits, which a bisection walks; it ends when exactly k are not above the middle.
 */
INLINE_ALWAYS float select_distance(const struct distances *d)
{
    const uint rows = (d->count + 7u) / 8u;
    global const float *values = d->squared;
    uint low = 0u, high = as_uint(d->bound); /* the answer is in [low, high] */

    while (low < high) {
        const uint middle = low + (high - low) / 2u;
        const float8 at = (float8)(as_float(middle));
        int8 counts = (int8)(0);
        for (uint i = 0; i < rows; i++)
            counts -= vload8(i, values) <= at;
        const int4 four = counts.lo + counts.hi;
        const int2 two = four.lo + four.hi;
        const uint below = (uint)(two.x + two.y);
        if (below == d->k) {
            float8 largest = (float8)(0.0f);
            for (uint i = 0; i < rows; i++) {
                const float8 value = vload8(i, values);
                largest = lane_max(largest, value <= at ? value : (float8)(0.0f));
            }
            const float4 largest4 = fmax(largest.lo, largest.hi);
            return fmax(fmax(largest4.x, largest4.y), fmax(largest4.z, largest4.w));
        }
        if (below > d->k)
            high = middle;
        else
            low = middle + 1u;
    }
    return as_float(low);
}

/* Fills the last row up with what cannot be selected. */
INLINE_ALWAYS void pad_distances(struct distances *d)
{
    for (uint i = d->count; i & 7u; i++)
        d->squared[i] = INFINITY;
}

/* Keeps the k smallest; the largest of them is the new bound. */
INLINE_ALWAYS void shrink_distances(struct distances *d)
{
    uint kept = 0u;
    pad_distances(d);
    d->bound = select_distance(d);
    for (uint i = 0u; i < d->count; i++)
        if (d->squared[i] < d->bound)
            d->squared[kept++] = d->squared[i];
    while (kept < d->k) /* with all that are equal to it */
        d->squared[kept++] = d->bound;
    d->count = kept;
}

/* Takes the accepted photons of a block that are below the bound. */
INLINE_ALWAYS void take_distances(struct distances *d, const struct photon_tree *tree,
                                  const struct photon_query *query, uint block)
{
    global const rt_photon_block *photons = tree->blocks + block;
    const float8 squared = photon_distances(photons, query);
    uint mask = lane_mask(squared < d->bound && photons_accepted(photons, query));
    float each[8];
    if (!mask)
        return;
    if (mask == 255u) {
        vstore8(squared, 0, d->squared + d->count);
        d->count += 8u;
    } else {
        vstore8(squared, 0, each);
        for (; mask; mask &= mask - 1u)
            d->squared[d->count++] = each[lane_first(mask)];
    }
    if (d->count + 8u > d->capacity)
        shrink_distances(d);
}

/*
 * Takes the photons around the nearest block, more and more of them until k are accepted, `look` are looked at
 * or there are no more. True when k were accepted.
 */
INLINE_ALWAYS bool take_around(struct distances *d, const struct photon_tree *tree, const struct photon_query *query,
                               uint look)
{
    const uint blocks = tree->shape.block_count, centre = nearest_block(tree, query);
    uint begin = centre, end = centre; /* taken so far */
    for (uint reach = d->k / 8u + 1u;; reach *= 2u) {
        const uint left = centre - min(centre, reach / 2u), right = min(blocks, centre + reach - reach / 2u);
        for (uint i = left; i < begin; i++)
            take_distances(d, tree, query, i);
        for (uint i = end; i < right; i++)
            take_distances(d, tree, query, i);
        begin = min(begin, left);
        end = max(end, right);
        if (d->count >= d->k)
            return true;
        if (end - begin == blocks || 8u * (end - begin) > look)
            return false;
    }
}

/* The squared distance of the (look)-th photon of any kind, or the bound when fewer are nearer than that. */
INLINE_ALWAYS float look_distance(const struct photon_tree *tree, const struct photon_query *query, uint look,
                                  float bound)
{
    if (count_photons(tree, query, bound, look) < look)
        return bound;
    /* The largest number that fewer than `look` are nearer than. */
    uint low = 0u, high = as_uint(bound);
    while (high - low > 1u) {
        const uint middle = low + (high - low) / 2u;
        if (count_photons(tree, query, as_float(middle), look) < look)
            low = middle;
        else
            high = middle;
    }
    return as_float(low);
}

/*
 * The squared radius of the disc around a point; 0 when no photon counts. scratch: [estimate->stride]. The rule
 * of the (look)-th photon is left to the caller where k photons were accepted before it: only the sum shows.
 */
INLINE_ALWAYS float disc_radius(const struct photon_tree *tree, const struct photon_query *query,
                                const rt_density_params *estimate, global float *scratch)
{
    const float limit = estimate->squared_limit;
    struct distances d;
    if (estimate->k == 0u || tree->shape.levels == 0u)
        return tree->shape.levels == 0u ? 0.0f : limit;
    d.squared = scratch;
    d.count = 0u;
    d.capacity = estimate->stride;
    d.k = estimate->k;
    d.bound = limit;

    if (take_around(&d, tree, query, estimate->look)) {
        pad_distances(&d);
        d.bound = select_distance(&d);
    } else if (tree->shape.photon_count > estimate->look) {
        d.bound = look_distance(tree, query, estimate->look, limit);
    } else if (limit == INFINITY) {
        /* No limit, and the map has too few: the farthest stands for the k-th. */
        float farthest = 0.0f;
        for (uint i = 0u; i < d.count; i++)
            farthest = fmax(farthest, d.squared[i]);
        return farthest;
    } else
        return limit;

    struct photon_walk walk;
    uint first, mask;
    d.count = 0u;
    walk_start(&walk, tree);
    while (walk_next(&walk, tree, query, d.bound, &first, &mask))
        for (; mask; mask &= mask - 1u)
            take_distances(&d, tree, query, first + lane_first(mask));
    if (d.count < d.k)
        return d.bound;
    pad_distances(&d);
    return select_distance(&d);
}

#endif
