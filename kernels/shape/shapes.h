/*
 * shapes.h - the list of shapes, and the functions that dispatch on the kind of a shape.
 *
 * Both compilers read the list. From it come the kinds below; for the device the switches of this
 * file, which call the functions of the shapes' own headers; for the host the table of classes in
 * lib/shape/classes.c. To add a shape, add a row, include its header below, and write
 * lib/shape/NAME.c and its block in dsl/shapes.c.
 */
#ifndef RT_KERNELS_SHAPE_SHAPES_H
#define RT_KERNELS_SHAPE_SHAPES_H

/*
 * X(KIND, name, number). rt_shape.kind holds the number; it must not change, because files of
 * photon maps hold a hash of it.
 *
 * Shapes of triangles or parallelograms, kept in blocks (rt_tri_block). Hits on blocks need no
 * switch: triangle.h serves them all. accel/ intersects them, those of an instance in its own tree.
 */
#define RT_BLOCK_SHAPES(X) X(TRIANGLES, triangles, 0) X(QUAD, quad, 1) X(INSTANCE, instance, 9)

/*
 * Shapes in world space. name.h has
 *   float name_intersect(shape, ray, uint *part)   the nearest t in [t_min, t_max], or infinity;
 *                                                  *part: see object_point.h
 *   void name_surface(surface, scene, shape, ray, hit)
 *   struct tangents name_tangents(scene, shape, surface)
 */
#define RT_WORLD_SHAPES(X) X(SPHERE, sphere, 2) X(PLANE, plane, 3)

/*
 * Shapes in object space, where they are as simple as their headers say; their transform places
 * them. It maps normals by the transpose of its inverse, so that what is outside stays outside even
 * when it mirrors. With ray, point p, unit normal n and u in [0,1)^2 in object space, name.h has
 *   float name_intersect(shape, ray, uint *part)
 *   struct object_point name_hit(shape, placement, ray, p, part)
 *   float2 name_uv(shape, p, n)                            u and v
 *   struct tangents name_tangents(shape, p, n)
 *   struct object_point name_sample(shape, placement, u)
 *   float name_sample_pdf_a(shape, placement, n, scale)   density of name_sample over the area in
 *                                                           the world; scale: see area_scale
 */
#define RT_PLACED_SHAPES(X)                                                                        \
    X(ELLIPSOID, ellipsoid, 4)                                                                     \
    X(DISC, disc, 5)                                                                               \
    X(CYLINDER, cylinder, 6)                                                                       \
    X(CONE, cone, 7)                                                                               \
    X(TORUS, torus, 8)                                                                             \
    X(BOX, box, 10)

#define RT_SHAPES(X) RT_BLOCK_SHAPES(X) RT_WORLD_SHAPES(X) RT_PLACED_SHAPES(X)

#define RT_SHAPE_KIND(KIND, name, number) RT_SHAPE_##KIND = number,
typedef enum rt_shape_kind { RT_SHAPES(RT_SHAPE_KIND) } rt_shape_kind;
#undef RT_SHAPE_KIND

#ifdef __OPENCL_VERSION__

#include "math/lanes.h"
#include "math/ray.h"
#include "scene.h"
#include "shape/box.h"
#include "shape/cone.h"
#include "shape/cylinder.h"
#include "shape/disc.h"
#include "shape/ellipsoid.h"
#include "shape/object_point.h"
#include "shape/placement.h"
#include "shape/plane.h"
#include "shape/quad.h"
#include "shape/sphere.h"
#include "shape/surface.h"
#include "shape/torus.h"
#include "shape/triangle.h"
#include "types.h"

/* ---- Intersection ----------------------------------------------------------- */

/* The nearest t in [t_min, t_max] at which the ray meets a shape in object space, or infinity. */
INLINE_NEVER float intersect_placed(const struct scene *scene, global const rt_shape *shape,
                                    const struct ray *ray, uint *part)
{
    const struct ray object_ray = ray_to_object(scene->transforms + shape->transform, ray);
    switch (shape->kind) {
#define CASE(KIND, name, number)                                                                   \
    case RT_SHAPE_##KIND:                                                                          \
        return name##_intersect(shape, &object_ray, part);
        RT_PLACED_SHAPES(CASE)
#undef CASE
    }
    return INFINITY;
}

/*
 * The nearest t in [t_min, t_max] at which the ray meets a shape that is not kept in blocks, or
 * infinity; *part is the part of the shape that it meets.
 */
INLINE_NEVER float intersect_shape(const struct scene *scene, global const rt_shape *shape,
                                   const struct ray *ray, uint *part)
{
    *part = 0u;
    switch (shape->kind) {
#define CASE(KIND, name, number)                                                                   \
    case RT_SHAPE_##KIND:                                                                          \
        return name##_intersect(shape, ray, part);
        RT_WORLD_SHAPES(CASE)
#undef CASE
    }
    return intersect_placed(scene, shape, ray, part);
}

/* ---- Surface ---------------------------------------------------------------- */

static inline float2 placed_uv(global const rt_shape *shape, float3 p, float3 n)
{
    switch (shape->kind) {
#define CASE(KIND, name, number)                                                                   \
    case RT_SHAPE_##KIND:                                                                          \
        return name##_uv(shape, p, n);
        RT_PLACED_SHAPES(CASE)
#undef CASE
    }
    return (float2)(0.0f);
}

/* Sets u and v by the point p and the normal n in object space. */
static inline void locate_placed(struct surface *surface, global const rt_shape *shape, float3 p,
                                 float3 n)
{
    const float2 uv = placed_uv(shape, p, n);
    surface->u = uv.x;
    surface->v = uv.y;
}

static inline void placed_surface(struct surface *surface, const struct scene *scene,
                                  global const rt_shape *shape, const struct ray *ray,
                                  const struct hit *hit)
{
    global const rt_transform_data *placement = scene->transforms + shape->transform;
    const struct ray object_ray = ray_to_object(placement, ray);
    const float3 p = object_ray.origin + hit->t * object_ray.direction;
    struct object_point point;
    switch (shape->kind) {
#define CASE(KIND, name, number)                                                                   \
    case RT_SHAPE_##KIND:                                                                          \
        point = name##_hit(shape, placement, &object_ray, p, (uint)hit->u);                        \
        break;
        RT_PLACED_SHAPES(CASE)
#undef CASE
    }
    place_point(surface, placement, &point);
    if (is_located(shape))
        locate_placed(surface, shape, p, point.normal);
}

/*
 * Makes *surface that of a hit of closest_hit, found with this ray; u and v: see is_located. It is
 * made where it is used: a copy would read by whole vectors what was just written number by number,
 * which processors wait for.
 */
static inline void surface_at(struct surface *surface, const struct scene *scene,
                              const struct ray *ray, const struct hit *hit)
{
    surface->prim = hit->prim;
    surface->shape = scene->prim_shape[hit->prim];
    surface->slot = hit->slot;
    surface->weights = (float2)(0.0f);
    surface->triangle = 0u;
    surface->u = surface->v = 0.0f;
    global const rt_shape *shape = scene->shapes + surface->shape;
    if (!(hit->slot & RT_SLOT_ANALYTIC)) {
        triangle_surface(surface, scene, hit);
        return;
    }
    switch (shape->kind) {
#define CASE(KIND, name, number)                                                                   \
    case RT_SHAPE_##KIND:                                                                          \
        name##_surface(surface, scene, shape, ray, hit);                                           \
        return;
        RT_WORLD_SHAPES(CASE)
#undef CASE
    }
    placed_surface(surface, scene, shape, ray, hit);
}

/* Whether it is made of triangles or parallelograms in blocks. */
static inline bool shape_has_blocks(global const rt_shape *shape)
{
    switch (shape->kind) {
#define CASE(KIND, name, number) case RT_SHAPE_##KIND:
        RT_BLOCK_SHAPES(CASE)
        return true;
#undef CASE
    }
    return false;
}

/* ---- Bump frame ------------------------------------------------------------- */

static inline struct tangents placed_tangents(const struct scene *scene,
                                              global const rt_shape *shape,
                                              const struct surface *surface)
{
    global const rt_transform_data *placement = scene->transforms + shape->transform;
    const float3 p = point_to_object(placement, surface->position);
    const float3 n = unit(normal_to_object(placement, surface->normal));
    struct tangents along;
    switch (shape->kind) {
#define CASE(KIND, name, number)                                                                   \
    case RT_SHAPE_##KIND:                                                                          \
        along = name##_tangents(shape, p, n);                                                      \
        break;
        RT_PLACED_SHAPES(CASE)
#undef CASE
    }
    along.u = map_vector(placement->to_world, along.u);
    along.v = map_vector(placement->to_world, along.v);
    return along;
}

/* The derivatives of a surface's position by its u and v. */
static inline struct tangents tangents_at(const struct scene *scene, const struct surface *surface)
{
    global const rt_shape *shape = scene->shapes + surface->shape;
    if (!(surface->slot & RT_SLOT_ANALYTIC))
        return block_tangents(scene, shape, surface);
    switch (shape->kind) {
#define CASE(KIND, name, number)                                                                   \
    case RT_SHAPE_##KIND:                                                                          \
        return name##_tangents(scene, shape, surface);
        RT_WORLD_SHAPES(CASE)
#undef CASE
    }
    return placed_tangents(scene, shape, surface);
}

/* ---- Area sampling ---------------------------------------------------------- */

/*
 * A placed shape is sampled uniformly in object space, or uniformly over each of its parts. The
 * placement, with cofactors C, scales the area of a surface element of unit normal n by |C n|, so
 * the density over area in the world is that in object space over |C n|.
 */

/* The density over the world's area at a point with this normal in object space, of any length. */
static inline float placed_pdf_a(const struct scene *scene, global const rt_shape *shape,
                                 float3 normal)
{
    global const rt_transform_data *placement = scene->transforms + shape->transform;
    const float3 n = unit(normal);
    const float scale = area_scale(placement, n);
    switch (shape->kind) {
#define CASE(KIND, name, number)                                                                   \
    case RT_SHAPE_##KIND:                                                                          \
        return name##_sample_pdf_a(shape, placement, n, scale);
        RT_PLACED_SHAPES(CASE)
#undef CASE
    }
    return 0.0f;
}

/*
 * A point of a placed shape (shape: its index), for u in [0,1)^2. Fills *at as surface_at does for
 * a hit there, and returns pdf_a, its density over the shape's area in the world, 1/m^2.
 */
static inline float shape_point(const struct scene *scene, uint shape_index, float2 u,
                                struct surface *at)
{
    global const rt_shape *shape = scene->shapes + shape_index;
    global const rt_transform_data *placement = scene->transforms + shape->transform;
    struct object_point point;
    switch (shape->kind) {
#define CASE(KIND, name, number)                                                                   \
    case RT_SHAPE_##KIND:                                                                          \
        point = name##_sample(shape, placement, u);                                                \
        break;
        RT_PLACED_SHAPES(CASE)
#undef CASE
    }
    at->shape = shape_index;
    at->prim = shape->first_prim;
    at->triangle = 0u;
    at->weights = (float2)(0.0f);
    at->slot = shape_index | RT_SLOT_ANALYTIC;
    place_point(at, placement, &point);
    at->u = at->v = 0.0f;
    if (is_located(shape))
        locate_placed(at, shape, point.position, point.normal);
    return placed_pdf_a(scene, shape, point.normal);
}

/* The density, 1/m^2, with which shape_point makes a point that surface_at or shape_point gave. */
static inline float shape_pdf_a(const struct scene *scene, const struct surface *at)
{
    global const rt_shape *shape = scene->shapes + at->shape;
    return placed_pdf_a(scene, shape,
                        normal_to_object(scene->transforms + shape->transform, at->normal));
}

#endif
#endif
