/*
 * bump.h - shading normals that textures tilt: bump maps, which hold heights, and normal maps,
 * which hold normals.
 *
 * A normal map has its normal as 2 rgb - 1 in the frame of the shading normal n: x along dp/du,
 * made perpendicular to n, y perpendicular to both and on the side of dp/dv, z along n. That is
 * tangent space as OpenGL and glTF have it, with v upwards in the image. Where the texture is
 * rotated, so are its normals: x is along the picture's s then.
 *
 * References:
 *   Mikkelsen: "Bump Mapping Unparametrized Surfaces on the GPU", JGT 15(1), 2010 (the surface
 *     gradient).
 *   Mikkelsen: "Simulation of Wrinkled Surfaces Revisited", master's thesis, University of
 *     Copenhagen, 2008 (tangent space).
 */
#ifndef RT_KERNELS_MATERIAL_BUMP_H
#define RT_KERNELS_MATERIAL_BUMP_H

#include "material/medium.h"
#include "material/texture.h"
#include "math/lanes.h"
#include "scene.h"
#include "shape/shapes.h"

#define RT_LEAST_TILT 0.02f /* the least cosine between a tilted normal and the geometric one */

/* A unit normal, or where it turns away from the geometric one, the nearest that does not. */
static inline float3 kept_outside(float3 tilted, float3 normal)
{
    const float cosine = dot(tilted, normal);
    return cosine >= RT_LEAST_TILT ? tilted : unit(tilted + (RT_LEAST_TILT - cosine) * normal);
}

/*
 * The shading normal n, tilted by a height of these slopes by u and v: n less the gradient of the
 * height along the surface. It stays on the side of the geometric normal.
 */
static inline float3 tilted_normal(float3 n, float3 normal, const struct tangents *along,
                                   float2 slope)
{
    const float area = dot(n, cross(along->u, along->v));
    if (area == 0.0f)
        return n;
    const float3 gradient = (slope.x * cross(along->v, n) + slope.y * cross(n, along->u)) / area;
    return kept_outside(unit(n - gradient), normal);
}

/* The axes x and y of tangent space about the shading normal n; returns whether there are any. */
static inline bool tangent_axes(float3 n, const struct tangents *along, float3 *x_axis,
                                float3 *y_axis)
{
    const float3 x = along->u - dot(n, along->u) * n;
    if (dot(x, x) == 0.0f)
        return false;
    *x_axis = unit(x);
    *y_axis = cross(n, *x_axis);
    *y_axis *= dot(*y_axis, along->v) < 0.0f ? -1.0f : 1.0f;
    return true;
}

/* The shading normal n, replaced by this one in tangent space; where there is none it stays. */
static inline float3 normal_in_frame(float3 n, float3 normal, const struct tangents *along,
                                     float3 mapped)
{
    float3 x, y;
    if (!tangent_axes(n, along, &x, &y) || dot(mapped, mapped) == 0.0f)
        return n;
    return kept_outside(unit(mapped.x * x + mapped.y * y + mapped.z * n), normal);
}

/* The derivatives of the position by an attribute of the mesh; RT_NONE: by the weights. */
RARELY_CALLED struct tangents attribute_tangents(global const rt_scene_header *header,
                                                 global const rt_shape *shape, uint slot,
                                                 uint triangle, uint number)
{
    const struct scene scene = scene_open(header);
    struct tangents along = block_edges(&scene, slot);
    if (number != RT_NONE) {
        const float2 at = mesh_attribute(&scene, shape, triangle, (float2)(0.0f, 0.0f), number).xy;
        along = edges_by(
            along, mesh_attribute(&scene, shape, triangle, (float2)(1.0f, 0.0f), number).xy - at,
            mesh_attribute(&scene, shape, triangle, (float2)(0.0f, 1.0f), number).xy - at);
    }
    return block_tangents_placed(&scene, shape, along);
}

/* The shading normal of the material's normal map, with its bumps. */
static inline float3 bumped_normal(const struct scene *scene,
                                   global const rt_material_data *material,
                                   const struct surface *surface)
{
    if (material->bump_texture == RT_NONE && material->normal_texture == RT_NONE)
        return surface->shading;
    const struct texture_place place = surface_place(scene, surface);
    struct tangents along = tangents_at(scene, surface);
    float3 n = surface->shading;
    if (material->normal_texture != RT_NONE) {
        global const rt_texture_data *texture = scene->textures + material->normal_texture;
        const float3 mapped = 2.0f * texture_value(scene, texture, &place) - 1.0f;
        const float2 scale = vload2(0, material->normal_scale);
        const float2 tilt = texture_direction(texture, scale * mapped.xy);
        struct tangents own = along;
        const uint number =
            UNLIKELY(texture_has_attributes(texture)) ? texture_coordinates(texture) : RT_NONE;
        if (number != RT_NONE)
            own = attribute_tangents(scene->header, place.shape, surface->slot, place.triangle,
                                     number);
        n = normal_in_frame(n, surface->normal, &own, (float3)(tilt, mapped.z));
    }
    if (material->bump_texture == RT_NONE)
        return n;
    global const rt_texture_data *heights = scene->textures + material->bump_texture;
    float2 slope;
    if (UNLIKELY(texture_has_attributes(heights))) {
        slope = texture_slope_by_weights(scene->header, heights, place.shape, place.triangle,
                                         place.weights);
        along =
            attribute_tangents(scene->header, place.shape, surface->slot, place.triangle, RT_NONE);
    } else {
        slope = texture_slope(scene, heights, &place);
    }
    return tilted_normal(n, surface->normal, &along, material->bump_scale * slope);
}

#endif
