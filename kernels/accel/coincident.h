/*
 * coincident.h - the faces of other shapes that coincide with a surface: solids that touch share a
 * boundary, which light meets once.
 *
 * Two faces coincide where they are parallel and no farther apart than the bounds on their errors
 * add up to: nothing that float32 can tell apart lies between them. They are found by a probe along
 * the normal, from the surface's point to both sides, so that they do not depend on the direction
 * of the ray that came here, nor on the order in which the scene lists its shapes. The host marks
 * the shapes that another one may touch (RT_SHAPE_TOUCHES), and how far their faces may be off.
 */
#ifndef RT_KERNELS_ACCEL_COINCIDENT_H
#define RT_KERNELS_ACCEL_COINCIDENT_H

#include "accel/traverse.h"

#define COINCIDENT_MOST 8u    /* faces that are kept; of one shape at most two, one on each side */
#define COINCIDENT_SINE 1e-3f /* of the largest angle between parallel faces */

/* A face that the probe meets. */
struct face {
    struct hit hit; /* of the probe; without meaning for the surface itself */
    uint shape, prim, material;
    float offset;     /* from the surface, along its normal, m */
    bool is_opposite; /* its normal is opposite to the surface's */
};

/* The faces at a surface, in the order of their materials, then of their primitives. */
struct coincident {
    struct ray probe;
    float error; /* that of the surface */
    float lift;  /* as surface.error, so that a ray starts off all of them */
    uint count;
    struct face faces[COINCIDENT_MOST];
};

static inline bool comes_before(const struct face *a, const struct face *b)
{
    return a->material < b->material || (a->material == b->material && a->prim < b->prim);
}

/* Sorts a face in, unless its shape has one on that side already: edges belong to two triangles. */
static inline void insert_face(struct coincident *coincident, const struct face *face)
{
    for (uint i = 0u; i < coincident->count; i++)
        if (coincident->faces[i].shape == face->shape &&
            coincident->faces[i].is_opposite == face->is_opposite)
            return;
    if (coincident->count == COINCIDENT_MOST)
        return;
    uint at = coincident->count++;
    for (; at > 0u && comes_before(face, &coincident->faces[at - 1u]); at--)
        coincident->faces[at] = coincident->faces[at - 1u];
    coincident->faces[at] = *face;
}

/* Takes a hit of the probe if its face coincides with the surface. */
RARELY_CALLED void take_face(struct coincident *coincident, const struct scene *scene,
                             const struct hit *hit)
{
    const float3 normal = coincident->probe.direction;
    struct surface surface;
    surface_at(&surface, scene, &coincident->probe, hit);
    global const rt_shape *shape = scene->shapes + surface.shape;
    const struct texture_place place = texture_place_at(shape, &surface);
    if (has_cutouts(scene) && (shape->flags & RT_SHAPE_CUTOUT) &&
        passes_at(scene, &place, &coincident->probe, hit->slot))
        return;
    const float3 across = cross(surface.normal, normal);
    struct face face;
    face.offset = dot(surface.position - coincident->probe.origin, normal);
    if (dot(across, across) > COINCIDENT_SINE * COINCIDENT_SINE ||
        fabs(face.offset) > coincident->error + surface.error)
        return;
    face.hit = *hit;
    face.shape = surface.shape;
    face.prim = surface.prim;
    face.material = scene->shapes[surface.shape].material;
    face.is_opposite = dot(surface.normal, normal) < 0.0f;
    coincident->lift =
        fmax(coincident->lift, coincident->error + fabs(face.offset) + surface.error);
    insert_face(coincident, &face);
}

/* ---- The probe -------------------------------------------------------------- */

/* Takes the face in a lane of a block, hit with t, u and v. */
static inline void take_lane(struct coincident *coincident, const struct scene *scene,
                             struct hit hit, uint index, uint lane, uint instance)
{
    const uint own = scene->blocks[index].prim[lane] & RT_BLOCK_PRIM;
    hit.prim = instance == RT_NONE ? own : instance;
    hit.slot = index * RT_BVH_WIDTH + lane;
    take_face(coincident, scene, &hit);
}

/* Takes the faces of a leaf; instance: the primitive that it is part of, or RT_NONE. */
RARELY_CALLED void take_block(struct coincident *coincident, const struct scene *scene,
                              const struct ray *ray, const struct ray_frame *frame,
                              struct leaf leaf, uint instance)
{
    const uint index = leaf.child & RT_CHILD_INDEX;
    global const rt_tri_block *block = scene->blocks + index;
    struct hit hit;
#if RT_WIDTH > 1
    struct block_hits found;
    uint mask = intersect_block(block, frame, ray->t_min, ray->t_max, &found);
    if (!mask)
        return;
    const struct lane_hits hits = lane_hits(&found);
    for (; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        hit.t = lane_read(&hits.t, lane);
        hit.u = lane_read(&hits.u, lane);
        hit.v = lane_read(&hits.v, lane);
        take_lane(coincident, scene, hit, index, lane, instance);
    }
#else
    for (uint mask = leaf.lanes; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        if (intersect_lane(block, lane, frame, ray->t_min, ray->t_max, &hit))
            take_lane(coincident, scene, hit, index, lane, instance);
    }
#endif
}

RARELY_CALLED void take_instance(struct coincident *coincident, const struct scene *scene,
                                 global const rt_shape *shape)
{
    const struct ray ray = ray_to_object(scene->transforms + shape->transform, &coincident->probe);
    if (!can_follow(&ray))
        return;
    const struct ray_frame frame = make_ray_frame(&ray);
    if (scene->header->accel != RT_ACCEL_BVH) {
        for (uint i = 0u; i < shape->block_count; i++)
            take_block(coincident, scene, &ray, &frame, whole_block(shape->first_block + i),
                       shape->first_prim);
        return;
    }
    const struct ray_slabs slabs = make_ray_slabs(&ray);
    struct any_stack stack;
    uint count = start_any_at(&stack, shape->root);
    struct leaf leaf;
    while (next_leaf_any(scene, &slabs, &ray, &stack, &count, &leaf))
        take_block(coincident, scene, &ray, &frame, leaf, shape->first_prim);
}

/* Takes the face of a shape that is not kept in blocks; `own`: that of the surface. */
static inline void take_shape(struct coincident *coincident, const struct scene *scene, uint index,
                              uint own)
{
    global const rt_shape *shape = scene->shapes + index;
    if (shape->kind == RT_SHAPE_INSTANCE) {
        take_instance(coincident, scene, shape);
        return;
    }
    uint part;
    if (index == own)
        return;
    const float t = intersect_shape(scene, shape, &coincident->probe, &part);
    if (!(t < INFINITY))
        return;
    const struct hit hit = shape_hit(shape, index, t, part);
    take_face(coincident, scene, &hit);
}

/* Takes all that the probe meets, but for planes. */
static inline void probe_shapes(struct coincident *coincident, const struct scene *scene, uint own)
{
    const struct ray probe = coincident->probe;
    const struct ray_frame frame = make_ray_frame(&probe);
    if (scene->header->accel != RT_ACCEL_BVH) {
        for (uint i = 0u; i < scene->header->block_count; i++)
            take_block(coincident, scene, &probe, &frame, whole_block(i), RT_NONE);
        for (uint i = 0u; i < scene->header->analytic_count; i++)
            take_shape(coincident, scene, scene->analytic[i], own);
        return;
    }
    const struct ray_slabs slabs = make_ray_slabs(&probe);
    struct any_stack stack;
    uint count = start_any_at(&stack, 0u);
    struct leaf leaf;
    while (next_leaf_any(scene, &slabs, &probe, &stack, &count, &leaf)) {
        if (leaf.child & RT_CHILD_ANALYTIC)
            take_shape(coincident, scene, scene->analytic[leaf.child & RT_CHILD_INDEX], own);
        else
            take_block(coincident, scene, &probe, &frame, leaf, RT_NONE);
    }
}

/* Finds the faces at a surface of which shape, prim, position, normal and error are set. */
RARELY_CALLED void find_coincident(struct coincident *coincident, const struct scene *scene,
                                   const struct surface *surface)
{
    global const rt_shape *shape = scene->shapes + surface->shape;
    const float reach = surface->error + shape->reach;
    coincident->probe = make_ray(surface->position, surface->normal, -reach, reach);
    coincident->error = coincident->lift = surface->error;
    coincident->count = 1u;
    coincident->faces[0].shape = surface->shape;
    coincident->faces[0].prim = surface->prim;
    coincident->faces[0].material = shape->material;
    coincident->faces[0].offset = 0.0f;
    coincident->faces[0].is_opposite = false;
    if (!(shape->flags & RT_SHAPE_TOUCHES))
        return;
    for (uint i = 0u; i < scene->header->plane_count; i++)
        take_shape(coincident, scene, scene->planes[i], surface->shape);
    probe_shapes(coincident, scene, surface->shape);
}

/* The error that makes a ray that leaves the surface start off all faces there. */
RARELY_CALLED float coincident_lift(const struct scene *scene, const struct surface *surface)
{
    struct coincident coincident;
    find_coincident(&coincident, scene, surface);
    return coincident.lift;
}

/* The same for a point of a primitive of which position, normal and error are set. */
static inline float lift_off_coincident(const struct scene *scene, const struct surface *at,
                                        uint prim)
{
    const uint shape = scene->prim_shape[prim];
    if (!(scene->shapes[shape].flags & RT_SHAPE_TOUCHES))
        return at->error;
    struct surface surface;
    surface.position = at->position;
    surface.normal = at->normal;
    surface.error = at->error;
    surface.shape = shape;
    surface.prim = prim;
    return coincident_lift(scene, &surface);
}

#endif
