/*
 * mesh.h - surfaces of triangles and parallelograms, and what meshes keep at their vertices.
 */
#ifndef RT_KERNELS_SHAPE_MESH_H
#define RT_KERNELS_SHAPE_MESH_H

#include "shape/placement.h"
#include "math/ray.h"
#include "scene.h"
#include "shape/surface.h"
#include "types.h"

static inline float3 block_vertex(global const float rows[3][RT_BVH_WIDTH], uint lane)
{
    return (float3)(rows[0][lane], rows[1][lane], rows[2][lane]);
}

/* The three corners of a triangle, as vertices of its mesh; only of meshes with vertex data. */
static inline global const uint *mesh_corners(const struct scene *scene,
                                              global const rt_shape *shape, uint triangle)
{
    return scene->indices + shape->first_index + 3u * triangle;
}

/*
 * The colour of the mesh's vertices at the surface, which multiplies kd; white where there is none.
 */
static inline float3 vertex_colour(const struct scene *scene, const struct surface *surface)
{
    global const rt_shape *shape = scene->shapes + surface->shape;
    if (!(shape->flags & RT_SHAPE_COLOUR))
        return (float3)(1.0f);
    global const uint *corner = mesh_corners(scene, shape, surface->triangle);
    global const float4 *colours = scene->colours + shape->first_colour;
    const float u = surface->weights.x, v = surface->weights.y;
    return ((1.0f - u - v) * colours[corner[0]] + u * colours[corner[1]] + v * colours[corner[2]])
        .xyz;
}

/* Texture coordinates where the mesh has them, else the weights. */
static inline void mesh_parameters(struct surface *surface, const struct scene *scene,
                                   global const rt_shape *shape)
{
    const float u = surface->weights.x, v = surface->weights.y;
    float2 uv = surface->weights;
    if (shape->flags & RT_SHAPE_UV) {
        global const uint *corner = mesh_corners(scene, shape, surface->triangle);
        global const float2 *uvs = scene->uvs + shape->first_uv;
        uv = (1.0f - u - v) * uvs[corner[0]] + u * uvs[corner[1]] + v * uvs[corner[2]];
    }
    surface->u = uv.x;
    surface->v = uv.y;
}

/*
 * The interpolated normal, turned to the side of the geometric one, which it equals where vertices
 * have none.
 */
static inline void mesh_shading(struct surface *surface, const struct scene *scene,
                                global const rt_shape *shape)
{
    surface->shading = surface->normal;
    if (!(shape->flags & RT_SHAPE_SMOOTH))
        return;
    global const uint *corner = mesh_corners(scene, shape, surface->triangle);
    global const float4 *normals = scene->normals + shape->first_normal;
    const float u = surface->weights.x, v = surface->weights.y;
    float3 mixed = (1.0f - u - v) * normals[corner[0]].xyz + u * normals[corner[1]].xyz +
                   v * normals[corner[2]].xyz;
    if (!(dot(mixed, mixed) > 1e-12f))
        return;
    if (shape->kind == RT_SHAPE_INSTANCE)
        mixed = normal_to_world(scene->transforms + shape->transform, mixed);
    surface->shading =
        mixed * (rsqrt(dot(mixed, mixed)) * (dot(mixed, surface->normal) < 0.0f ? -1.0f : 1.0f));
}

/*
 * Position from the barycentric mix. To the bound on its error comes the error with which a ray
 * that leaves at a grazing angle sees the triangle's own plane: a few roundings of its size,
 * magnified where the triangle is a sliver.
 */
static inline void triangle_surface(struct surface *surface, const struct scene *scene,
                                    const struct hit *hit)
{
    global const rt_tri_block *block = scene->blocks + (hit->slot >> 3);
    global const rt_shape *shape = scene->shapes + surface->shape;
    const uint lane = hit->slot & 7u;
    const float3 v0 = block_vertex(block->v0, lane);
    const float3 e1 = block_vertex(block->v1, lane) - v0;
    const float3 e2 = block_vertex(block->v2, lane) - v0;
    const bool is_instance = shape->kind == RT_SHAPE_INSTANCE;

    surface->weights = (float2)(hit->u, hit->v);
    surface->triangle =
        is_instance ? block->prim[lane] & RT_BLOCK_PRIM : surface->prim - shape->first_prim;
    const float3 position = v0 + (hit->u * e1 + hit->v * e2);
    const float3 across = cross(e1, e2);
    const float twice_area = length(across);
    const float3 normal = across / (shape->flags & RT_SHAPE_MIRRORED ? -twice_area : twice_area);

    const float3 reach = fabs(v0) + fabs(e1) + fabs(e2);
    const float size = length(e1) + length(e2);
    const float sliver = fmin(size * size / twice_area, 64.0f);
    const float error =
        gamma_bound(4.0f) * dot(reach, fabs(normal)) + gamma_bound(2.0f) * size * sliver;
    if (is_instance) {
        place_surface(surface, scene->transforms + shape->transform, position, normal, error);
    } else {
        surface->position = position;
        surface->normal = normal;
        surface->error = error;
    }
    mesh_parameters(surface, scene, shape);
    mesh_shading(surface, scene, shape);
}

#endif
