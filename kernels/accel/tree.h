/*
 * tree.h - the leaves of the bounding volume hierarchy that are blocks of triangles, and the
 * traversal of the width: eight-wide nodes and all lanes of a block at once, or two-wide nodes and
 * lane by lane.
 */
#ifndef RT_KERNELS_ACCEL_TREE_H
#define RT_KERNELS_ACCEL_TREE_H

#include "accel/boxes.h"
#include "accel/cutout.h"
#include "accel/intersect.h"
#include "count.h"
#include "math/lanes.h"
#include "math/ray.h"
#include "scene.h"
#include "types.h"
#if RT_WIDTH > 1
#include "accel/wide_tree.h"
#else
#include "accel/pair_tree.h"
#endif

/* A block as a leaf with all of its lanes. */
static inline struct leaf whole_block(uint index)
{
    struct leaf leaf;
    leaf.child = index | RT_CHILD_LEAF;
#if RT_WIDTH == 1
    leaf.lanes = 0xffu;
#endif
    return leaf;
}

/*
 * How far blocks are tested when the nearest hit so far is at t: ties included, and a rounding
 * error beyond. take_block_hits compares exactly.
 */
INLINE_ALWAYS float block_reach(float t)
{
    return t + fabs(t) * 0x1p-22f;
}

#if RT_WIDTH > 1
/*
 * Takes the nearest of the block's hits in `mask` into *hit when it is nearer still and not before
 * t_min; placed: as passes_lane says. `cuts`, a constant at each call: whether there may be
 * cutouts; the code for them, though not run, takes 3 % of the time of path tracing.
 */
INLINE_ALWAYS void take_block_hits(struct hit *hit, const struct scene *scene,
                                   const struct ray *ray, const struct block_hits *found, uint mask,
                                   uint index, uint placed, const bool cuts)
{
    global const rt_tri_block *block = scene->blocks + index;
    const struct lane_hits hits = lane_hits(found);
    for (; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        const uint prim = block->prim[lane] & RT_BLOCK_PRIM;
        const uint slot = index * RT_BVH_WIDTH + lane;
        const float t = lane_read(&hits.t, lane);
        if (t >= ray->t_min && (t < hit->t || (t == hit->t && prim < hit->prim))) {
            const float u = lane_read(&hits.u, lane), v = lane_read(&hits.v, lane);
            if (cuts && (block->prim[lane] & RT_BLOCK_CUTOUT) &&
                passes_lane(scene->header, ray, slot, placed, u, v))
                continue;
            hit->t = t;
            hit->u = u;
            hit->v = v;
            hit->prim = prim;
            hit->slot = slot;
        }
    }
}

INLINE_ALWAYS void test_block(const struct scene *scene, const struct ray *ray,
                              const struct ray_frame *frame, struct leaf leaf, uint placed,
                              struct hit *hit, const bool cuts)
{
    const uint index = leaf.child & RT_CHILD_INDEX;
    struct block_hits found;
    const uint mask =
        intersect_block(scene->blocks + index, frame, ray->t_min, block_reach(hit->t), &found);
    if (mask)
        take_block_hits(hit, scene, ray, &found, mask, index, placed, cuts);
}

/* Whether one of the lanes in `mask`, some of which may be cutouts, does not let the ray pass. */
RARELY_CALLED bool cutouts_occlude(global const rt_scene_header *header, const struct ray *ray,
                                   const struct block_hits *found, uint mask, uint index,
                                   uint placed)
{
    global const rt_tri_block *block = scene_open(header).blocks + index;
    const struct lane_hits hits = lane_hits(found);
    for (; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        if (!(block->prim[lane] & RT_BLOCK_CUTOUT) ||
            !passes_lane(header, ray, index * RT_BVH_WIDTH + lane, placed, lane_read(&hits.u, lane),
                         lane_read(&hits.v, lane)))
            return true;
    }
    return false;
}

INLINE_ALWAYS bool block_occludes(const struct scene *scene, const struct ray *ray,
                                  const struct ray_frame *frame, struct leaf leaf, uint placed,
                                  const bool cuts)
{
    const uint index = leaf.child & RT_CHILD_INDEX;
    struct block_hits found;
    const uint mask = intersect_block(scene->blocks + index, frame, ray->t_min, ray->t_max, &found);
    if (!mask || !cuts)
        return mask != 0u;
    return cutouts_occlude(scene->header, ray, &found, mask, index, placed);
}
#else
/* The nearest of the leaf's hits, as take_block_hits has it. */
INLINE_ALWAYS void test_block(const struct scene *scene, const struct ray *ray,
                              const struct ray_frame *frame, struct leaf leaf, uint placed,
                              struct hit *hit, const bool cuts)
{
    const uint index = leaf.child & RT_CHILD_INDEX;
    global const rt_tri_block *block = scene->blocks + index;
    for (uint lanes = leaf.lanes; lanes; lanes &= lanes - 1u) {
        const uint lane = lane_first(lanes), prim = block->prim[lane] & RT_BLOCK_PRIM;
        struct hit found;
        if (!intersect_lane(block, lane, frame, ray->t_min, block_reach(hit->t), &found) ||
            !(found.t >= ray->t_min &&
              (found.t < hit->t || (found.t == hit->t && prim < hit->prim))))
            continue;
        found.prim = prim;
        found.slot = index * RT_BVH_WIDTH + lane;
        if (cuts && (block->prim[lane] & RT_BLOCK_CUTOUT) &&
            passes_lane(scene->header, ray, found.slot, placed, found.u, found.v))
            continue;
        *hit = found;
    }
}

INLINE_ALWAYS bool block_occludes(const struct scene *scene, const struct ray *ray,
                                  const struct ray_frame *frame, struct leaf leaf, uint placed,
                                  const bool cuts)
{
    const uint index = leaf.child & RT_CHILD_INDEX;
    global const rt_tri_block *block = scene->blocks + index;
    for (uint lanes = leaf.lanes; lanes; lanes &= lanes - 1u) {
        const uint lane = lane_first(lanes);
        struct hit found;
        if (intersect_lane(block, lane, frame, ray->t_min, ray->t_max, &found) &&
            !(cuts && (block->prim[lane] & RT_BLOCK_CUTOUT) &&
              passes_lane(scene->header, ray, index * RT_BVH_WIDTH + lane, placed, found.u,
                          found.v)))
            return true;
    }
    return false;
}
#endif

#endif
