/*
 * vertex_batch.h - the vertices of eight paths that are shaded together: what their materials have
 * there, their surfaces in lanes, and what these scatter.
 *
 * Served are surfaces that reflect diffusely alone, SIMPLE, and MIXED ones, which reflect by
 * isotropic facets of GGX, too, or as a mirror beside their diffuse lobe, by ks or by a clear coat:
 * these lanes are shaded by bsdf/lobe_lanes.h.
 */
#ifndef RT_KERNELS_SURFACE_VERTEX_BATCH_H
#define RT_KERNELS_SURFACE_VERTEX_BATCH_H

#include "bsdf/lobe_lanes.h"
#include "material/material.h"
#include "math/width8.inc.h"
#include "sample/rng_lanes.h"
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

/* ---- Light and directions -------------------------------------------------------- */

/*
 * The light of samples, `radiance` from wi over the density 1 / inv_pdf, that vertices scatter to
 * paths of throughput `weight`, weighted by MIS against scattering, as vertex_direct; in the lanes
 * `alone` it counts fully. lobes: those of MIXED vertices, NULL where there are none.
 */
static inline struct vec3_x8 light_vertices(const struct surface_x8 *surface,
                                            const struct lobes_x8 *lobes, struct vec3_x8 weight,
                                            struct vec3_x8 albedo, struct vec3_x8 wi,
                                            struct vec3_x8 radiance, float8 inv_pdf, int8 alone)
{
    const float8 pdf_w = lambert_density_x8(surface->normal, surface->shading, wi);
    const float8 ratio = alone ? (float8)(0.0f) : pdf_w * inv_pdf;
    const float8 share = pdf_w * inv_pdf / power_heuristic_divisor_x8(ratio);
    const struct vec3_x8 lit = mul_x8(scale_x8(share, weight), mul_x8(albedo, radiance));
    if (!lobes)
        return lit;
    struct vec3_x8 scattered;
    light_lobes(&scattered, lobes, surface, wi, inv_pdf, alone);
    return select_x8(lanes_of(lobes->held), mul_x8(weight, mul_x8(scattered, radiance)), lit);
}

/* Where paths go on. */
struct scattered_x8 {
    struct vec3_x8 wi, beta; /* throughput */
    float8 pdf_w;            /* 0: as by a mirror */
    int8 leaves;             /* whether wi leaves the surface */
};

/*
 * Scatters paths of throughput beta, which survive with this probability, as vertex_scatter does;
 * lobes as above. out->beta comes in as beta times the albedo and goes out as that of the next
 * ray.
 */
static inline void scatter_vertices(struct scattered_x8 *out, const struct surface_x8 *surface,
                                    const struct lobes_x8 *lobes, struct vec3_x8 beta,
                                    float8 survival, const struct numbers_x8 *numbers)
{
    const struct vec2_x8 u = {numbers->row[4], numbers->row[5]};
    const struct vec3_x8 wi_local = sample_cosine_x8(u);
    const struct vec3_x8 wi = frame_to_world_x8(frame_about_x8(surface->shading), wi_local);
    out->beta = scale_x8(1.0f / survival, out->beta);
    out->wi = wi;
    out->pdf_w = cosine_pdf_w_x8(wi_local.z);
    out->leaves = wi_local.z > 0.0f && dot_x8(wi, surface->normal) > 0.0f;
    if (!lobes)
        return;
    const int8 held = lanes_of(lobes->held);
    const struct vec3_x8 three = {u.x, u.y, numbers->row[7]};
    struct weighed_x8 weighed;
    struct vec3_x8 scattered;
    sample_lobes(&scattered, &weighed, lobes, surface, wi, survival, three, numbers->row[6]);
    out->beta = select_x8(held, mul_x8(scale_x8(1.0f / survival, beta), weighed.weight), out->beta);
    out->wi = select_x8(held, scattered, wi);
    out->pdf_w = held ? weighed.pdf_w : out->pdf_w;
    out->leaves = out->leaves || held;
}

#endif
