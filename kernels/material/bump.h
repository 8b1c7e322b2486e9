/*
 * bump.h - bump mapping: shading normals perturbed by a height.
 *
 * References:
 *   Mikkelsen: "Bump Mapping Unparametrized Surfaces on the GPU", JGT 15(1), 2010 (the surface
 *     gradient).
 */
#ifndef RT_KERNELS_MATERIAL_BUMP_H
#define RT_KERNELS_MATERIAL_BUMP_H

#include "material/texture.h"
#include "scene.h"
#include "shape/shapes.h"

#define RT_LEAST_TILT 0.02f /* the least cosine between a tilted normal and the geometric one */

/*
 * The shading normal n, tilted by a height of these slopes by u and v: n less the gradient of the
 * height along the surface. It stays on the side of the geometric normal.
 */
static inline float3 tilted_normal(const struct surface *surface, const struct tangents *along,
                                   float2 slope)
{
    const float3 n = surface->shading;
    const float area = dot(n, cross(along->u, along->v));
    if (area == 0.0f)
        return n;
    const float3 gradient = (slope.x * cross(along->v, n) + slope.y * cross(n, along->u)) / area;
    const float3 tilted = unit(n - gradient);
    const float cosine = dot(tilted, surface->normal);
    return cosine >= RT_LEAST_TILT ? tilted
                                   : unit(tilted + (RT_LEAST_TILT - cosine) * surface->normal);
}

/* The shading normal, with the material's bumps. */
static inline float3 bumped_normal(const struct scene *scene,
                                   global const rt_material_data *material,
                                   const struct surface *surface)
{
    if (material->bump_texture == RT_NONE)
        return surface->shading;
    const struct tangents along = tangents_at(scene, surface);
    const float2 slope = texture_slope(scene->textures + material->bump_texture, scene->texels,
                                       surface->u, surface->v);
    return tilted_normal(surface, &along, material->bump_scale * slope);
}

#endif
