/*
 * triangle.h - the triangles of meshes and the parallelograms, which are kept eight to a block:
 * their surface, what meshes keep at their vertices, and points on emissive ones.
 *
 * They are in world space; where their shape has a transform, it is an instance (instance.h), and
 * they are in the mesh's object space. accel/intersect.h intersects them.
 */
#ifndef RT_KERNELS_SHAPE_TRIANGLE_H
#define RT_KERNELS_SHAPE_TRIANGLE_H

#include "math/ray.h"
#include "scene.h"
#include "shape/placement.h"
#include "shape/surface.h"
#include "types.h"
#include "math/width1.inc.h"
#include "shape/flat.inc.h"

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

/* Numbers of the vertices of a triangle, from this entry of colours on, mixed by the weights. */
static inline float3 mixed_colour(const struct scene *scene, global const rt_shape *shape,
                                  uint triangle, float2 weights, uint first)
{
    global const uint *corner = mesh_corners(scene, shape, triangle);
    global const float4 *colours = scene->colours + first;
    const float u = weights.x, v = weights.y;
    return ((1.0f - u - v) * colours[corner[0]] + u * colours[corner[1]] + v * colours[corner[2]])
        .xyz;
}

/*
 * The attribute of this number at a point of a triangle; 1 on a shape without it, which the host
 * refuses.
 */
static inline float3 mesh_attribute(const struct scene *scene, global const rt_shape *shape,
                                    uint triangle, float2 weights, uint number)
{
    if (!(shape->flags & RT_SHAPE_ATTRIBUTES))
        return (float3)(1.0f);
    const uint first = scene->indices[shape->first_index - 1u - number];
    if (first == RT_NONE)
        return (float3)(1.0f);
    if (first & RT_ATTRIBUTE_OF_TRIANGLES)
        return scene->colours[(first & ~RT_ATTRIBUTE_OF_TRIANGLES) + triangle].xyz;
    return mixed_colour(scene, shape, triangle, weights, first);
}

/*
 * The colour of the mesh's vertices at the surface, which multiplies kd; white where there is none.
 */
static inline float3 vertex_colour(const struct scene *scene, const struct surface *surface)
{
    global const rt_shape *shape = scene->shapes + surface->shape;
    if (!(shape->flags & RT_SHAPE_COLOUR))
        return (float3)(1.0f);
    return mixed_colour(scene, shape, surface->triangle, surface->weights, shape->first_colour);
}

/* Texture coordinates where the mesh has them, else the weights. */
static inline float2 mesh_uv(const struct scene *scene, global const rt_shape *shape, uint triangle,
                             float2 weights)
{
    if (!(shape->flags & RT_SHAPE_UV))
        return weights;
    const float u = weights.x, v = weights.y;
    global const uint *corner = mesh_corners(scene, shape, triangle);
    global const float2 *uvs = scene->uvs + shape->first_uv;
    return (1.0f - u - v) * uvs[corner[0]] + u * uvs[corner[1]] + v * uvs[corner[2]];
}

static inline void mesh_parameters(struct surface *surface, const struct scene *scene,
                                   global const rt_shape *shape)
{
    const float2 uv = mesh_uv(scene, shape, surface->triangle, surface->weights);
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
    if (shape->transform != RT_NONE)
        mixed = normal_to_world(scene->transforms + shape->transform, mixed);
    surface->shading =
        mixed * (rsqrt(dot(mixed, mixed)) * (dot(mixed, surface->normal) < 0.0f ? -1.0f : 1.0f));
}

/* The triangle of the mesh in this slot, which is one of the shape. */
static inline uint triangle_of_slot(const struct scene *scene, global const rt_shape *shape,
                                    uint slot)
{
    const uint prim = scene->blocks[slot >> 3].prim[slot & 7u] & RT_BLOCK_PRIM;
    return shape->transform != RT_NONE ? prim : prim - shape->first_prim;
}

static inline void triangle_surface(struct surface *surface, const struct scene *scene,
                                    const struct hit *hit)
{
    global const rt_tri_block *block = scene->blocks + (hit->slot >> 3);
    global const rt_shape *shape = scene->shapes + surface->shape;
    const uint lane = hit->slot & 7u;
    const float3 v0 = block_vertex(block->v0, lane);
    const float3 e1 = block_vertex(block->v1, lane) - v0;
    const float3 e2 = block_vertex(block->v2, lane) - v0;
    const bool is_placed = shape->transform != RT_NONE;

    surface->weights = (float2)(hit->u, hit->v);
    surface->triangle =
        is_placed ? block->prim[lane] & RT_BLOCK_PRIM : surface->prim - shape->first_prim;
    struct flat_surface flat = flat_surface_at(v0, e1, e2, hit->u, hit->v);
    if (shape->flags & RT_SHAPE_MIRRORED)
        flat.normal = -flat.normal;
    if (is_placed) {
        place_surface(surface, scene->transforms + shape->transform, flat.position, flat.normal,
                      flat.error);
    } else {
        surface->position = flat.position;
        surface->normal = flat.normal;
        surface->error = flat.error;
    }
    mesh_parameters(surface, scene, shape);
    mesh_shading(surface, scene, shape);
}

/* The edges from the first corner in this slot. */
static inline struct tangents block_edges(const struct scene *scene, uint slot)
{
    global const rt_tri_block *block = scene->blocks + (slot >> 3);
    const uint lane = slot & 7u;
    const float3 v0 = block_vertex(block->v0, lane);
    struct tangents edges;
    edges.u = block_vertex(block->v1, lane) - v0;
    edges.v = block_vertex(block->v2, lane) - v0;
    return edges;
}

/* The derivatives by coordinates that grow by a and b along the edges; zero where degenerate. */
static inline struct tangents edges_by(struct tangents edges, float2 a, float2 b)
{
    const float det = a.x * b.y - a.y * b.x;
    const float scale = det != 0.0f ? 1.0f / det : 0.0f;
    struct tangents along;
    along.u = scale * (b.y * edges.u - a.y * edges.v);
    along.v = scale * (a.x * edges.v - b.x * edges.u);
    return along;
}

/* In the world. */
static inline struct tangents block_tangents_placed(const struct scene *scene,
                                                    global const rt_shape *shape,
                                                    struct tangents along)
{
    if (shape->transform != RT_NONE) {
        global const rt_transform_data *placement = scene->transforms + shape->transform;
        along.u = map_vector(placement->to_world, along.u);
        along.v = map_vector(placement->to_world, along.v);
    }
    return along;
}

/*
 * From the edges of the triangle or parallelogram; zero where its texture coordinates are
 * degenerate.
 */
static inline struct tangents block_tangents(const struct scene *scene,
                                             global const rt_shape *shape,
                                             const struct surface *surface)
{
    struct tangents along = block_edges(scene, surface->slot);
    if (shape->flags & RT_SHAPE_UV) {
        global const uint *corner = mesh_corners(scene, shape, surface->triangle);
        global const float2 *uvs = scene->uvs + shape->first_uv;
        along = edges_by(along, uvs[corner[1]] - uvs[corner[0]], uvs[corner[2]] - uvs[corner[0]]);
    }
    return block_tangents_placed(scene, shape, along);
}

/* ---- Area sampling ---------------------------------------------------------- */

static inline struct flat_light flat_light_of(global const rt_light_data *light)
{
    struct flat_light flat;
    flat.corner = row3(light->a);
    flat.edge1 = row3(light->b);
    flat.edge2 = row3(light->c);
    flat.width = light->width;
    flat.height = light->height;
    return flat;
}

/* The point of an emissive quad or triangle at these lengths along its edges. */
static inline void flat_point(struct surface *at, global const rt_light_data *light, float2 lengths)
{
    const struct flat_light flat = flat_light_of(light);
    at->position = flat_light_point(&flat, lengths);
    at->normal = row3(light->normal);
    at->error = flat_light_error(&flat);
}

/*
 * Sets u and v of such a point from its lengths along the edges, which need not be at right angles.
 */
static inline void locate_flat_point(const struct scene *scene, global const rt_light_data *light,
                                     struct surface *at)
{
    global const rt_shape *shape = scene->shapes + scene->prim_shape[light->prim];
    const float3 away = at->position - row3(light->a);
    const float b = dot(away, row3(light->b)), c = dot(away, row3(light->c)),
                bc = dot(row3(light->b), row3(light->c));
    at->weights =
        (float2)((b - bc * c) / light->width, (c - bc * b) / light->height) / (1.0f - bc * bc);
    at->triangle = light->prim - shape->first_prim;
    mesh_parameters(at, scene, shape);
}

#endif
