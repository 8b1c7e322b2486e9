/*
 * knn.h - the disc around a point whose photons count, by the rules of
 * lib/photon/neighbour_search.h: it ends at the k-th accepted photon, at the limit on the radius,
 * or at the (16 k)-th photon of any kind, and the photons strictly nearer count.
 *
 * The k-th distance is found by a traversal that goes to the nearest child first and collects
 * distances alone. Whenever its buffer is full, the k smallest are selected, and the largest of
 * them bounds the traversal from then on. Photons are not listed, as most that are found first are
 * too far; the sum, which knows the radius, goes to the blocks of photons that a search by a good
 * guess has noted, or else traverses again.
 */
#ifndef RT_KERNELS_PHOTON_KNN_H
#define RT_KERNELS_PHOTON_KNN_H

#include "photon/tree.h"

/* Distances found so far: no more than `capacity`, of which the k smallest matter. */
struct distances {
    global float *squared;
    uint count, capacity; /* a multiple of 8, at least k + 16 */
    uint k;
    float bound; /* distances not below it are ignored */
};

/*
 * Blocks with photons of any kind nearer than a radius, in the order of the tree. capacity: of the
 * memory; when count is above it, there are more, and the list is of no use.
 */
struct block_list {
    global uint *block;
    uint count, capacity;
};

INLINE_ALWAYS struct block_list no_blocks(void)
{
    struct block_list list;
    list.block = 0;
    list.count = 1u;
    list.capacity = 0u;
    return list;
}

INLINE_ALWAYS bool is_listed(const struct block_list *list)
{
    return list->count <= list->capacity;
}

INLINE_ALWAYS uint sum_lanes_int(int8 v)
{
    const int4 four = v.lo + v.hi;
    const int2 two = four.lo + four.hi;
    return (uint)(two.x + two.y);
}

INLINE_ALWAYS float largest_lane(float8 v)
{
    const float4 four = fmax(v.lo, v.hi);
    const float2 two = fmax(four.lo, four.hi);
    return fmax(two.x, two.y);
}

/* How many of the distances are not above a value, and the largest of these. */
INLINE_ALWAYS uint count_up_to(const struct distances *d, float value, float *largest)
{
    global const float *values = d->squared;
    const uint rows = (d->count + 7u) / 8u;
    int8 counts = (int8)(0);
    float8 top = (float8)(0.0f);
    for (uint i = 0u; i < rows; i++) {
        const float8 row = vload8(i, values);
        const int8 below = row <= value;
        counts -= below;
        top = lane_max(top, as_float8(as_int8(row) & below));
    }
    *largest = largest_lane(top);
    return sum_lanes_int(counts);
}

/*
 * The k-th smallest of the distances, k <= count, all of them below the bound. Squared distances on
 * a surface are about uniform, so every other step tries the interpolated place of the k-th; the
 * steps between bisect the bit patterns, which have the order of the floats. It ends when exactly k
 * are not above the value tried.
 */
INLINE_ALWAYS float select_distance(const struct distances *d)
{
    float largest;
    uint low = 0u, low_count = 0u; /* fewer than k are not above low - 1 */
    count_up_to(d, FLT_MAX, &largest);
    uint high = as_uint(largest), high_count = d->count; /* at least k are not above high */

    for (uint step = 0u; low < high; step++) {
        uint middle = low + (high - low) / 2u;
        if (!(step & 1u)) {
            const float from = as_float(low), span = as_float(high) - from;
            const float part = ((float)(d->k - low_count) - 0.5f) / (float)(high_count - low_count);
            middle = clamp(as_uint(from + part * span), low, high - 1u);
        }
        const uint count = count_up_to(d, as_float(middle), &largest);
        if (count == d->k)
            return largest;
        if (count > d->k) {
            high = as_uint(largest);
            high_count = count;
        } else {
            low = middle + 1u;
            low_count = count;
        }
    }
    return as_float(low);
}

/* Pads the last row with values that are never selected. */
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
    for (uint i = 0u; i < d->count; i += 8u) {
        const float8 values = vload8(0, d->squared + i);
        const uint mask = lane_mask(values < d->bound);
        lane_store(values, mask, d->squared + kept);
        kept += popcount(mask);
    }
    while (kept < d->k) /* with all that are equal to it */
        d->squared[kept++] = d->bound;
    d->count = kept;
}

/* Takes the lanes in `mask`. */
INLINE_ALWAYS void take_lanes(struct distances *d, float8 squared, uint mask)
{
    lane_store(squared, mask, d->squared + d->count);
    d->count += popcount(mask);
    if (d->count + 8u > d->capacity)
        shrink_distances(d);
}

/* Takes the accepted photons of a block that are below the bound. */
INLINE_ALWAYS void take_distances(struct distances *d, const struct photon_tree *tree,
                                  const struct photon_query *query, uint block)
{
    global const rt_photon_block *photons = tree->blocks + block;
    const float8 squared = photon_distances(photons, query);
    const uint mask = lane_mask(squared < d->bound && photons_accepted(photons, query));
    if (mask)
        take_lanes(d, squared, mask);
}

/* The same, and notes the block if photons of any kind are below the bound. */
INLINE_ALWAYS void take_and_note(struct distances *d, struct block_list *list,
                                 const struct photon_tree *tree, const struct photon_query *query,
                                 uint block)
{
    global const rt_photon_block *photons = tree->blocks + block;
    const float8 squared = photon_distances(photons, query);
    const int8 below = squared < d->bound;
    if (!lane_mask(below))
        return;
    if (list->count < list->capacity)
        list->block[list->count] = block;
    list->count++;
    const uint mask = lane_mask(below && photons_accepted(photons, query));
    if (mask)
        take_lanes(d, squared, mask);
}

/* The smallest lane of a vector whose lanes in `mask` alone count; mask is not 0. */
INLINE_ALWAYS uint nearest_lane(float8 squared, uint mask)
{
    const struct lane_array each = lane_array(squared);
    uint nearest = lane_first(mask);
    for (mask &= mask - 1u; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        nearest = lane_read(&each, lane) < lane_read(&each, nearest) ? lane : nearest;
    }
    return nearest;
}

/* Nodes still to be visited, and how near they come. */
struct near_stack {
    uint entry[RT_PHOTON_STACK];
    float squared[RT_PHOTON_STACK];
    uint count;
};

/* Pushes the children of a node that are in `mask`, the nearest last. */
INLINE_ALWAYS void push_children(struct near_stack *stack, uint level, uint index, float8 squared,
                                 uint mask)
{
    const uint count = popcount(mask);
    const struct lane_array each = lane_array(squared);
    for (uint at = stack->count + count; mask;) {
        const uint lane = nearest_lane(squared, mask);
        at--;
        stack->entry[at] = ((level - 1u) << ENTRY_LEVEL_SHIFT) | (8u * index + lane);
        stack->squared[at] = lane_read(&each, lane);
        mask &= ~(1u << lane);
    }
    stack->count += count;
}

/*
 * Takes all accepted photons below the bound, nearest nodes first; those of `enough` photons of any
 * kind at most. False when it stopped there, with fewer than k accepted.
 */
INLINE_ALWAYS bool take_nearest(struct distances *d, const struct photon_tree *tree,
                                const struct photon_query *query, uint enough)
{
    struct near_stack stack;
    uint candidates = 0u;
    stack.entry[0] = (tree->shape.levels - 1u) << ENTRY_LEVEL_SHIFT;
    stack.squared[0] = 0.0f;
    stack.count = 1u;
    while (stack.count > 0u) {
        stack.count--;
        if (!(stack.squared[stack.count] < d->bound))
            continue;
        const uint entry = stack.entry[stack.count], level = entry >> ENTRY_LEVEL_SHIFT,
                   index = entry & ENTRY_INDEX;
        const float8 squared =
            box_distances(tree->nodes + tree->shape.first_node[level] + index, query);
        uint near = lane_mask(squared < d->bound);
        if (level > 0u) {
            push_children(&stack, level, index, squared, near);
            continue;
        }
        for (; near; near &= near - 1u)
            take_distances(d, tree, query, 8u * index + lane_first(near));
        candidates += 64u;
        if (candidates >= enough && d->count < d->k)
            return false;
    }
    return true;
}

/*
 * The squared distance of the (max_candidates)-th photon of any kind, or the bound when fewer are
 * nearer than that.
 */
INLINE_ALWAYS float candidate_distance(const struct photon_tree *tree,
                                       const struct photon_query *query, uint max_candidates,
                                       float bound)
{
    if (count_photons(tree, query, bound, max_candidates) < max_candidates)
        return bound;
    /* The largest number that fewer than `max_candidates` are nearer than. */
    uint low = 0u, high = as_uint(bound);
    while (high - low > 1u) {
        const uint middle = low + (high - low) / 2u;
        if (count_photons(tree, query, as_float(middle), max_candidates) < max_candidates)
            low = middle;
        else
            high = middle;
    }
    return as_float(low);
}

/*
 * Takes all accepted photons nearer than a guess, in no particular order; true when they are k or
 * more. start: where a traversal up to the guess begins; list: of the blocks. The traversal needs
 * no order and seldom a selection, so a good guess makes the search twice as fast.
 */
INLINE_ALWAYS bool take_within(struct distances *d, struct block_list *list,
                               const struct photon_tree *tree, const struct photon_start *start,
                               const struct photon_query *query, float guess)
{
    struct tree_traversal traversal;
    uint first, mask;
    d->count = 0u;
    d->bound = guess;
    list->count = 0u;
    traversal_start(&traversal, start);
    while (traversal_next(&traversal, tree, query, d->bound, &first, &mask))
        for (; mask; mask &= mask - 1u)
            take_and_note(d, list, tree, query, first + lane_first(mask));
    return d->count >= d->k;
}

/*
 * Takes the k nearest accepted photons below the limit, or as many as the rules allow; the bound is
 * the squared radius when there are fewer.
 */
INLINE_ALWAYS void take_all(struct distances *d, const struct photon_tree *tree,
                            const struct photon_query *query, const rt_density_params *estimate)
{
    const bool larger = tree->shape.photon_count > estimate->max_candidates;
    d->count = 0u;
    d->bound = estimate->squared_limit;
    if (take_nearest(d, tree, query, larger ? 2u * estimate->max_candidates : 0xffffffffu))
        return;
    /*
     * Few photons are accepted. The others may be far away, but the whole map must not be searched
     * for them.
     */
    d->count = 0u;
    d->bound = candidate_distance(tree, query, estimate->max_candidates, estimate->squared_limit);
    take_nearest(d, tree, query, 0xffffffffu);
}

/*
 * The squared radius of the disc around a point; 0 when no photon counts. guess: an estimate, such
 * as that of a nearby point, or 0; it changes the time taken, not the result. start: where a
 * traversal up to the guess begins. scratch: [estimate->stride]. Where k photons are accepted, the
 * caller applies the limit of max_candidates: only the summation counts the candidates. list: of
 * the blocks within the disc, if they were found by the guess.
 */
INLINE_ALWAYS float disc_radius(const struct photon_tree *tree, const struct photon_start *start,
                                const struct photon_query *query, const rt_density_params *estimate,
                                float guess, global float *scratch, struct block_list *list)
{
    struct distances d;
    if (tree->shape.levels == 0u)
        return 0.0f;
    d.squared = scratch;
    d.capacity = estimate->stride / 2u;
    d.k = estimate->k;
    list->block = (global uint *)(scratch + d.capacity);
    list->capacity = d.capacity;
    if (!(guess > 0.0f && guess < estimate->squared_limit &&
          take_within(&d, list, tree, start, query, guess))) {
        *list = no_blocks();
        take_all(&d, tree, query, estimate);
    }
    if (d.count >= d.k) {
        pad_distances(&d);
        return select_distance(&d);
    }
    if (d.bound < INFINITY)
        return d.bound;
    /* No limit, and fewer than k in the map: the farthest photon gives the radius. */
    float farthest = 0.0f;
    for (uint i = 0u; i < d.count; i++)
        farthest = fmax(farthest, d.squared[i]);
    return farthest;
}

#endif
