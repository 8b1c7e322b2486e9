/*
 * instance.h - a mesh with its own tree, placed by a transform. Its hits are hits on blocks, whose
 * surface is in shape/triangle.h.
 */
#ifndef RT_KERNELS_ACCEL_INSTANCE_H
#define RT_KERNELS_ACCEL_INSTANCE_H

#include "accel/tree.h"
#include "shape/placement.h"

/*
 * Tests the triangles of an instance, through the tree of its mesh, with the ray in object
 * space. That tree has a stack of its own, so each of the two levels may be as deep as the builder
 * allows.
 */
INLINE_ALWAYS void test_instance_of(const struct scene *scene, const struct ray *ray,
                                    global const rt_shape *shape, struct hit *hit, const bool cuts)
{
    const struct ray object_ray = ray_to_object(scene->transforms + shape->transform, ray);
    if (!can_follow(&object_ray))
        return;
    const struct ray_frame frame = make_ray_frame(&object_ray);
    /*
     * Within the mesh, prim is the triangle. Of two equally near hits the lower primitive wins, so
     * this one counts if the instance is the lower.
     */
    struct hit nearest = *hit;
    nearest.prim = shape->first_prim < hit->prim ? RT_NONE : 0u;
    nearest.slot = RT_NONE;
    if (scene->header->accel == RT_ACCEL_BVH) {
        const struct ray_slabs slabs = make_ray_slabs(&object_ray);
        struct stack stack;
        uint count = start_at(&stack, shape->root);
        struct leaf leaf;
        while (next_leaf(scene, &slabs, object_ray.t_min, nearest.t, &stack, &count, &leaf))
            test_block(scene, &object_ray, &frame, leaf, shape->first_prim, &nearest, cuts);
    } else {
        for (uint i = 0; i < shape->block_count; i++)
            test_block(scene, &object_ray, &frame, whole_block(shape->first_block + i),
                       shape->first_prim, &nearest, cuts);
    }
    if (nearest.slot == RT_NONE)
        return;
    *hit = nearest;
    hit->prim = shape->first_prim;
}

/* Whether the ray meets the instance. */
INLINE_ALWAYS bool instance_occludes_of(const struct scene *scene, const struct ray *ray,
                                        global const rt_shape *shape, const bool cuts)
{
    const struct ray object_ray = ray_to_object(scene->transforms + shape->transform, ray);
    if (!can_follow(&object_ray))
        return false;
    const struct ray_frame frame = make_ray_frame(&object_ray);
    if (scene->header->accel == RT_ACCEL_BVH) {
        const struct ray_slabs slabs = make_ray_slabs(&object_ray);
        struct any_stack stack;
        uint count = start_any_at(&stack, shape->root);
        struct leaf leaf;
        while (next_leaf_any(scene, &slabs, &object_ray, &stack, &count, &leaf))
            if (block_occludes(scene, &object_ray, &frame, leaf, shape->first_prim, cuts))
                return true;
        return false;
    }
    for (uint i = 0; i < shape->block_count; i++)
        if (block_occludes(scene, &object_ray, &frame, whole_block(shape->first_block + i),
                           shape->first_prim, cuts))
            return true;
    return false;
}

/* The same out of line, without and with cutouts. */
INLINE_NEVER void test_instance(const struct scene *scene, const struct ray *ray,
                                global const rt_shape *shape, struct hit *hit)
{
    test_instance_of(scene, ray, shape, hit, false);
}

INLINE_NEVER void test_instance_with_cutouts(const struct scene *scene, const struct ray *ray,
                                             global const rt_shape *shape, struct hit *hit)
{
    test_instance_of(scene, ray, shape, hit, true);
}

INLINE_NEVER bool instance_occludes(const struct scene *scene, const struct ray *ray,
                                    global const rt_shape *shape)
{
    return instance_occludes_of(scene, ray, shape, false);
}

INLINE_NEVER bool instance_occludes_with_cutouts(const struct scene *scene, const struct ray *ray,
                                                 global const rt_shape *shape)
{
    return instance_occludes_of(scene, ray, shape, true);
}

#endif
