/*
 * vertex_batch.h - the vertices of eight paths that are shaded together: what their materials have
 * there, and their surfaces in lanes.
 */
#ifndef RT_KERNELS_SURFACE_VERTEX_BATCH_H
#define RT_KERNELS_SURFACE_VERTEX_BATCH_H

#include "bsdf/lobe_lanes.h"
#include "material/material.h"
#include "math/width8.inc.h"
#include "shape/flat.inc.h"

/* The vertices of a batch that are collected before they are shaded together. */
struct vertex_batch {
    float3 albedo[8];              /* kd */
    global const float *corner[8]; /* flat surface: the first vertex in its block */
    struct surface surfaces[8];    /* the others */
    uint taken;                    /* a bit for each path whose vertex is collected, */
    uint curved;                   /* those that have their surface in `surfaces` */
    struct mixed_materials mixed;  /* of those that are not diffuse alone */
};

/* Whether a ray meets the back of a flat surface. */
static inline bool meets_flat_back(global const float *corner, float3 direction)
{
    const uint row = RT_BVH_WIDTH, vertex = 3u * RT_BVH_WIDTH;
    float3 at[3];
    for (uint i = 0u; i < 3u; i++, corner += vertex)
        at[i] = (float3)(corner[0], corner[row], corner[2u * row]);
    return dot(cross(at[1] - at[0], at[2] - at[0]), direction) > 0.0f;
}

/* Collects what a vertex has beside kd, unless it is a mirror alone at this point. */
static inline bool collect_mixed(struct vertex_batch *batch, uint lane,
                                 global const rt_material_data *material, float3 kd, float3 ks,
                                 float alpha)
{
    if (alpha < RT_SMOOTH_ALPHA && !(largest3(kd) > 0.0f))
        return false;
    batch->albedo[lane] = kd;
    batch->taken |= 1u << lane;
    batch->mixed.material[lane] = material;
    batch->mixed.ks[lane] = ks;
    batch->mixed.alpha[lane] = alpha;
    batch->mixed.held |= 1u << lane;
    return true;
}

/*
 * Collects what a ray meets of a shape that lanes shade; is_mixed: where they know more than its
 * diffuse lobe. Returns whether it did.
 */
static inline bool collect_surface(struct vertex_batch *batch, uint lane, const struct scene *scene,
                                   global const rt_shape *shape, const struct ray *ray,
                                   const struct hit *hit, const bool is_mixed)
{
    global const rt_material_data *material = scene->materials + shape->material;
    const bool is_backed = (shape->flags & RT_SHAPE_BACKED) != 0u;
    if (shape->flags & RT_SHAPE_FLAT) {
        global const float *corner = scene->blocks[hit->slot >> 3].v0[0] + (hit->slot & 7u);
        if (is_backed && meets_flat_back(corner, ray->direction))
            return false;
        batch->corner[lane] = corner;
        if (UNLIKELY(is_mixed)) {
            const bool is_coat = is_coated(material);
            return collect_mixed(batch, lane, material, row3(material->kd),
                                 is_coat ? (float3)(material->coat) : row3(material->ks),
                                 is_coat ? material->coat_roughness : material->roughness);
        }
        batch->albedo[lane] = row3(material->kd);
    } else {
        struct surface *surface = &batch->surfaces[lane];
        surface_at(surface, scene, ray, hit);
        if (is_backed && dot(surface->normal, ray->direction) > 0.0f)
            return false;
        struct bsdf_params inputs;
        evaluate_material(&inputs, scene, material, surface);
        surface->shading = inputs.shading;
        batch->curved |= 1u << lane;
        if (UNLIKELY(is_mixed)) {
            const bool is_coat = is_coated(material);
            return collect_mixed(batch, lane, material, inputs.kd,
                                 is_coat ? (float3)(inputs.coat) : inputs.ks,
                                 is_coat ? inputs.coat_roughness : inputs.roughness);
        }
        batch->albedo[lane] = inputs.kd;
    }
    batch->taken |= 1u << lane;
    return true;
}

/* The surfaces of flat triangles and parallelograms. */
static inline struct surface_x8 flat_surfaces(const struct vertex_batch *batch,
                                              const struct hit *hits)
{
    const uint row = RT_BVH_WIDTH, vertex = 3u * RT_BVH_WIDTH;
    const float8 u = LANES_OF(float8, hits, .u), v = LANES_OF(float8, hits, .v);
    const struct vec3_x8 v0 = vec3_x8_gather(batch->corner, 0u, row);
    const struct vec3_x8 e1 = sub_x8(vec3_x8_gather(batch->corner, vertex, row), v0);
    const struct vec3_x8 e2 = sub_x8(vec3_x8_gather(batch->corner, 2u * vertex, row), v0);
    const struct flat_surface_x8 flat = flat_surface_at_x8(v0, e1, e2, u, v);
    const struct surface_x8 surface = {flat.position, flat.normal, flat.normal, flat.error};
    return surface;
}

/* Copies the lanes of surfaces that were evaluated one by one. */
static inline void take_curved(struct surface_x8 *surface, const struct vertex_batch *batch)
{
    const struct vec3_x8 position = VEC3_X8_OF(batch->surfaces, .position);
    const struct vec3_x8 normal = VEC3_X8_OF(batch->surfaces, .normal);
    const struct vec3_x8 shading = VEC3_X8_OF(batch->surfaces, .shading);
    const int8 curved = lanes_of(batch->curved);
    surface->position = select_x8(curved, position, surface->position);
    surface->normal = select_x8(curved, normal, surface->normal);
    surface->shading = select_x8(curved, shading, surface->shading);
    surface->error = curved ? LANES_OF(float8, batch->surfaces, .error) : surface->error;
}

/* The surfaces that rays of these directions meet, their normals on the side of the rays. */
static inline struct surface_x8 surfaces_of(struct vertex_batch *batch, struct vec3_x8 direction,
                                            const struct hit *hits)
{
    struct surface_x8 surface;
    const uint flat = batch->taken & ~batch->curved;
    if (flat) {
        for (uint i = 0u; i < 8u; i++)
            batch->corner[i] = batch->corner[lane_or_first(flat, i)];
        surface = flat_surfaces(batch, hits);
    }
    if (batch->curved)
        take_curved(&surface, batch);
    const float8 side = dot_x8(direction, surface.normal) > 0.0f ? (float8)(-1.0f) : (float8)(1.0f);
    surface.normal = scale_x8(side, surface.normal);
    surface.shading = scale_x8(side, surface.shading);
    return surface;
}

#endif
