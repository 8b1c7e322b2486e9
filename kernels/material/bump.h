/*
 * bump.h - how surfaces run along u and v, and normals tilted by a height.
 *
 * References:
 *   Mikkelsen: "Bump Mapping Unparametrized Surfaces on the GPU", JGT 15(1), 2010 (the surface
 *     gradient).
 */
#ifndef RT_KERNELS_MATERIAL_BUMP_H
#define RT_KERNELS_MATERIAL_BUMP_H

#include "shape/mesh.h"
#include "shape/placement.h"
#include "scene.h"
#include "shape/surface.h"
#include "material/texture.h"

#define RT_LEAST_TILT 0.02f /* the least cosine between a tilted normal and the geometric one */

/* Derivatives of the position by u and v, metres. */
struct tangents {
    float3 u, v;
};

/* Of a triangle or parallelogram, by its edges; zero where texture coordinates do not span it. */
static inline struct tangents block_tangents(const struct scene *scene,
                                             global const rt_shape *shape,
                                             const struct surface *surface)
{
    global const rt_tri_block *block = scene->blocks + (surface->slot >> 3);
    const uint lane = surface->slot & 7u;
    const float3 v0 = block_vertex(block->v0, lane);
    struct tangents along;
    along.u = block_vertex(block->v1, lane) - v0;
    along.v = block_vertex(block->v2, lane) - v0;
    if (shape->flags & RT_SHAPE_UV) {
        global const uint *corner = mesh_corners(scene, shape, surface->triangle);
        global const float2 *uvs = scene->uvs + shape->first_uv;
        const float2 a = uvs[corner[1]] - uvs[corner[0]], b = uvs[corner[2]] - uvs[corner[0]];
        const float det = a.x * b.y - a.y * b.x;
        const float scale = det != 0.0f ? 1.0f / det : 0.0f;
        const float3 e1 = along.u, e2 = along.v;
        along.u = scale * (b.y * e1 - a.y * e2);
        along.v = scale * (a.x * e2 - b.x * e1);
    }
    if (shape->kind == RT_SHAPE_INSTANCE) {
        global const rt_transform_data *placement = scene->transforms + shape->transform;
        along.u = map_vector(placement->to_world, along.u);
        along.v = map_vector(placement->to_world, along.v);
    }
    return along;
}

/* Of the unit sphere at p, by longitude from +x towards -z and latitude from the south pole. */
static inline struct tangents unit_sphere_tangents(float3 p)
{
    const float r = length(p.xz);
    const float inverse = r > 0.0f ? 1.0f / r : 0.0f;
    struct tangents along;
    along.u = 2.0f * RT_PI * (float3)(p.z, 0.0f, -p.x);
    along.v = RT_PI * (float3)(-p.y * p.x * inverse, r, -p.y * p.z * inverse);
    return along;
}

/* Of a shape of revolution about z, at p of unit normal n, both in its own space. */
static inline struct tangents round_tangents(global const rt_shape *shape, float3 p, float3 n)
{
    const float from_axis = length(p.xy);
    const float2 outwards = from_axis > 0.0f ? p.xy / from_axis : (float2)(1.0f, 0.0f);
    const float top = shape->kind == RT_SHAPE_CONE ? shape->p[0] : 1.0f;
    const bool is_cap =
        fabs(n.z) > 0.999f && shape->kind != RT_SHAPE_DISC && shape->kind != RT_SHAPE_TORUS;
    /* see turns_on_disc */
    const bool is_mirrored = shape->kind == RT_SHAPE_DISC || (is_cap && n.z > 0.0f);
    struct tangents along;
    along.u = (is_mirrored ? -2.0f : 2.0f) * RT_PI * (float3)(-p.y, p.x, 0.0f);
    if (shape->kind == RT_SHAPE_DISC)
        along.v = (float3)((1.0f - shape->p[0]) * outwards, 0.0f);
    else if (shape->kind == RT_SHAPE_TORUS)
        along.v = 2.0f * RT_PI * (float3)(-p.z * outwards, from_axis - 1.0f);
    else if (is_cap)
        along.v = (float3)((n.z < 0.0f ? 1.0f : top) * outwards, 0.0f);
    else
        along.v = (float3)((top - 1.0f) * outwards, 1.0f);
    return along;
}

static inline struct tangents plane_tangents(const struct scene *scene,
                                             global const rt_shape *shape)
{
    struct tangents along;
    if (shape->transform == RT_NONE) {
        plane_axes(vload3(0, shape->p + 4), &along.u, &along.v);
    } else {
        global const rt_transform_data *placement = scene->transforms + shape->transform;
        along.u = map_vector(placement->to_world, (float3)(1.0f, 0.0f, 0.0f));
        along.v = map_vector(placement->to_world, (float3)(0.0f, 1.0f, 0.0f));
    }
    return along;
}

/* A sphere keeps its place in the world, and has a transform only for its poles. */
static inline struct tangents sphere_tangents(const struct scene *scene,
                                              global const rt_shape *shape, float3 n)
{
    const float radius = shape->p[3];
    struct tangents along;
    if (shape->transform == RT_NONE) {
        along = unit_sphere_tangents(n);
        along.u *= radius;
        along.v *= radius;
    } else {
        global const rt_transform_data *placement = scene->transforms + shape->transform;
        const float3 p = unit(map_vector(placement->to_object, n));
        const float scale = radius / length(map_vector(placement->to_world, p));
        along = unit_sphere_tangents(p);
        along.u = scale * map_vector(placement->to_world, along.u);
        along.v = scale * map_vector(placement->to_world, along.v);
    }
    return along;
}

static inline struct tangents tangents_at(const struct scene *scene, const struct surface *surface)
{
    global const rt_shape *shape = scene->shapes + surface->shape;
    if (!(surface->slot & RT_SLOT_ANALYTIC))
        return block_tangents(scene, shape, surface);
    if (shape->kind == RT_SHAPE_PLANE)
        return plane_tangents(scene, shape);
    if (shape->kind == RT_SHAPE_SPHERE)
        return sphere_tangents(scene, shape, surface->normal);
    global const rt_transform_data *placement = scene->transforms + shape->transform;
    const float3 p = point_to_object(placement, surface->position);
    struct tangents along =
        shape->kind == RT_SHAPE_ELLIPSOID
            ? unit_sphere_tangents(unit(p))
            : round_tangents(shape, p, unit(normal_to_object(placement, surface->normal)));
    along.u = map_vector(placement->to_world, along.u);
    along.v = map_vector(placement->to_world, along.v);
    return along;
}

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
