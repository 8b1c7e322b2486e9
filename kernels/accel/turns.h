/*
 * turns.h - the nearest hits of several rays, whose traversals take turns.
 *
 * What a traversal visits next depends on what its last test has hit, which a processor guesses
 * badly, and a wrong guess throws away what it has begun since. Here a turn of a ray first takes
 * what its turn before has found, which is there by then, and tests one more node or leaf, for
 * whose result nobody waits: meanwhile the other rays have their turns. Hits are those of
 * closest_hit, bit for bit, for they do not depend on the order in which a tree is visited.
 *
 * Only kernels of width 8 include this file: a GPU hides the same waits by its other work-items.
 */
#ifndef RT_KERNELS_ACCEL_TURNS_H
#define RT_KERNELS_ACCEL_TURNS_H

#include "accel/traverse.h"

/* A ray's traversal between two turns. */
struct turn {
    struct ray_slabs slabs;
    struct ray_frame frame;
    struct hit nearest;
    uint count;              /* of the stack */
    uint child;              /* what was tested last, */
    uint mask;               /* the lanes that were hit, */
    struct lane_array entry; /* of a node: where the ray enters them, */
    struct block_hits found; /* of a block: where it meets them */
    struct stack stack;
};

/* Begins at the root, as if nothing had been hit by then but *hit. */
INLINE_ALWAYS void turn_begin(struct turn *turn, const struct ray *ray, const struct hit *hit)
{
    turn->slabs = make_ray_slabs(ray);
    turn->frame = make_ray_frame(ray);
    turn->nearest = *hit;
    turn->count = start_at(&turn->stack, 0u);
    turn->mask = 0u;
}

/* Takes what the last test has found, and goes on to the next child; false when there is none. */
INLINE_ALWAYS bool turn_next(struct turn *turn, const struct scene *scene, const struct ray *ray,
                             const bool cuts)
{
    if (turn->mask) {
        const uint index = turn->child & RT_CHILD_INDEX;
        if (!(turn->child & RT_CHILD_LEAF)) {
            turn->child = push_farther(&turn->stack, &turn->count, scene->nodes + index, turn->mask,
                                       &turn->entry);
            return true;
        }
        take_block_hits(&turn->nearest, scene, ray, &turn->found, turn->mask, index, RT_NONE, cuts);
    }
    return pop_nearer(&turn->stack, &turn->count, turn->nearest.t, &turn->child);
}

/* Tests the child, and keeps what is found for the next turn. */
INLINE_ALWAYS void turn_test(struct turn *turn, const struct scene *scene, const struct ray *ray,
                             const bool cuts)
{
    const uint index = turn->child & RT_CHILD_INDEX;
    const float t = turn->nearest.t;
    if (!(turn->child & RT_CHILD_LEAF)) {
        float8 entry;
        turn->mask = intersect_boxes(scene->nodes + index, &turn->slabs, ray->t_min, t, &entry);
        turn->entry = lane_array(entry);
    } else if (UNLIKELY(turn->child & RT_CHILD_ANALYTIC)) {
        test_shape(scene, ray, scene->analytic[index], &turn->nearest, cuts);
        turn->mask = 0u;
    } else {
        turn->mask = intersect_block(scene->blocks + index, &turn->frame, ray->t_min,
                                     block_reach(t), &turn->found);
    }
}

/*
 * Traverses the tree for the rays whose bits are set in `wanted`, which can be followed; *hits is
 * what they have hit so far.
 */
INLINE_ALWAYS void take_turns(const struct scene *scene, const struct ray rays[RT_TRACE_RAYS],
                              uint wanted, struct hit hits[RT_TRACE_RAYS], const bool cuts)
{
    struct turn turns[RT_TRACE_RAYS];
    for (uint left = wanted; left; left &= left - 1u) {
        const uint i = lane_first(left);
        turn_begin(&turns[i], &rays[i], &hits[i]);
    }
    for (uint active = wanted; active;)
        for (uint left = active; left; left &= left - 1u) {
            const uint i = lane_first(left);
            if (turn_next(&turns[i], scene, &rays[i], cuts)) {
                turn_test(&turns[i], scene, &rays[i], cuts);
            } else {
                hits[i] = turns[i].nearest;
                active ^= 1u << i;
            }
        }
}

INLINE_ALWAYS uint find_closest_hits(const struct scene *scene,
                                     const struct ray rays[RT_TRACE_RAYS], uint wanted,
                                     struct hit hits[RT_TRACE_RAYS], const bool cuts)
{
    const bool has_tree = scene->header->accel == RT_ACCEL_BVH;
    for (uint left = wanted; left; left &= left - 1u) {
        const uint i = lane_first(left);
        begin_at_planes(scene, &rays[i], &hits[i], cuts);
        if (!has_tree)
            test_all(scene, &rays[i], &hits[i], cuts);
    }
    if (has_tree)
        take_turns(scene, rays, wanted, hits, cuts);
    uint found = 0u;
    for (uint left = wanted; left; left &= left - 1u) {
        const uint i = lane_first(left);
        found |= hits[i].prim != RT_NONE ? 1u << i : 0u;
    }
    return found;
}

RARELY_CALLED uint closest_hits_with_cutouts(const struct scene *scene,
                                             const struct ray rays[RT_TRACE_RAYS], uint wanted,
                                             struct hit hits[RT_TRACE_RAYS])
{
    return find_closest_hits(scene, rays, wanted, hits, true);
}

/* As closest_hit for each of those rays; returns the bits of those that hit. */
INLINE_NEVER uint closest_hits(const struct scene *scene, const struct ray rays[RT_TRACE_RAYS],
                               uint wanted, struct hit hits[RT_TRACE_RAYS])
{
    return UNLIKELY(has_cutouts(scene)) ? closest_hits_with_cutouts(scene, rays, wanted, hits)
                                        : find_closest_hits(scene, rays, wanted, hits, false);
}

#endif
