/*
 * box.h - the box: in object space the cube from -1 to 1. Face 2 a is at -1 and face 2 a + 1 at 1
 * of axis a; the part of a hit is its face.
 *
 * The cube is where the three slabs between opposite faces meet. Each is an interval of the ray,
 * and so is their intersection: no ray passes between two faces (Kay and Kajiya, "Ray Tracing
 * Complex Scenes", SIGGRAPH 1986).
 */
#ifndef RT_KERNELS_SHAPE_BOX_H
#define RT_KERNELS_SHAPE_BOX_H

#include "shape/line.h"
#include "shape/object_point.h"
#include "types.h"

/* ---- Intersection ----------------------------------------------------------- */

/* The axis of the largest component. */
static inline uint largest_axis(float3 v)
{
    return v.x >= v.y ? (v.x >= v.z ? 0u : 2u) : (v.y >= v.z ? 1u : 2u);
}

/* A component of a vector by its axis. */
static inline float along_axis(float3 v, uint axis)
{
    return axis == 0u ? v.x : axis == 1u ? v.y : v.z;
}

/* The nearest s at which the line meets the cube, or infinity; *part is the face. */
static inline float intersect_cube(const struct line *line, uint *part)
{
    const float3 o = line->origin, d = line->direction, none = (float3)(INFINITY);
    const int3 is_parallel = d == 0.0f, is_between = fabs(o) <= 1.0f;
    const float3 a = (-1.0f - o) / d, b = (1.0f - o) / d;
    const float3 enter = select(fmin(a, b), select(none, -none, is_between), is_parallel);
    const float3 leave = select(fmax(a, b), select(-none, none, is_between), is_parallel);
    const uint first = largest_axis(enter), last = largest_axis(-leave);
    const float lo = along_axis(enter, first), hi = along_axis(leave, last);
    if (!(lo <= hi))
        return INFINITY;
    if (line_has(line, lo)) {
        *part = 2u * first + (along_axis(d, first) > 0.0f ? 0u : 1u);
        return lo;
    }
    *part = 2u * last + (along_axis(d, last) > 0.0f ? 1u : 0u);
    return line_has(line, hi) ? hi : INFINITY;
}

static inline float box_intersect(global const rt_shape *shape, const struct ray *ray, uint *part)
{
    (void)shape;
    const struct line line = make_line(ray);
    const float s = intersect_cube(&line, part);
    return s < INFINITY ? line_t(&line, ray, s) : INFINITY;
}

/* ---- Surface ---------------------------------------------------------------- */

/* A face: its normal, and the directions of u and v, of which it covers -1 to 1. */
struct box_face {
    float3 normal, u, v;
};

/*
 * u and v as plane_axes has them: seen from outside u runs to the right, and v upwards, or on the
 * faces at the bottom and at the top towards -z.
 */
static inline struct box_face box_face(uint face)
{
    const uint axis = face >> 1;
    const float side = face & 1u ? 1.0f : -1.0f;
    struct box_face out;
    out.normal = axis == 0u   ? (float3)(side, 0.0f, 0.0f)
                 : axis == 1u ? (float3)(0.0f, side, 0.0f)
                              : (float3)(0.0f, 0.0f, side);
    out.u = axis == 0u ? (float3)(0.0f, 0.0f, -side) : (float3)(side, 0.0f, 0.0f);
    out.v = axis == 1u ? (float3)(0.0f, 0.0f, -1.0f) : (float3)(0.0f, 1.0f, 0.0f);
    return out;
}

/*
 * The point of a face at p. It is kept off the edges by its rounding error, so that a ray that
 * enters through the face starts inside the other faces.
 */
static inline struct object_point box_point(global const rt_transform_data *placement, float3 p,
                                            uint index)
{
    const struct box_face face = box_face(index);
    const float margin =
        0x1p-20f + 2.0f * length(placement_error(placement, p, point_to_world(placement, p)));
    const float most = fmax(1.0f - margin, 0.0f);
    const float u = dot(p, face.u), v = dot(p, face.v);
    struct object_point point;
    point.position = face.normal + clamp(u, -most, most) * face.u + clamp(v, -most, most) * face.v;
    point.normal = face.normal;
    point.error = gamma_bound(2.0f);
    return point;
}

static inline struct object_point box_hit(global const rt_shape *shape,
                                          global const rt_transform_data *placement,
                                          const struct ray *ray, float3 p, uint part)
{
    (void)shape, (void)ray;
    return box_point(placement, p, part & PART_MASK);
}

/* The face with this normal. */
static inline struct box_face box_face_of(float3 n)
{
    const uint axis = largest_axis(fabs(n));
    return box_face(2u * axis + (along_axis(n, axis) > 0.0f ? 1u : 0u));
}

static inline float2 box_uv(global const rt_shape *shape, float3 p, float3 n)
{
    (void)shape;
    const struct box_face face = box_face_of(n);
    return clamp(0.5f + 0.5f * (float2)(dot(p, face.u), dot(p, face.v)), 0.0f, 1.0f);
}

static inline struct tangents box_tangents(global const rt_shape *shape, float3 p, float3 n)
{
    (void)shape, (void)p;
    const struct box_face face = box_face_of(n);
    struct tangents along;
    along.u = 2.0f * face.u;
    along.v = 2.0f * face.v;
    return along;
}

/* ---- Area sampling ---------------------------------------------------------- */

/* Areas in the world of the faces at one side of x, y and z. */
static inline float3 box_areas(global const rt_transform_data *placement)
{
    return 4.0f * (float3)(area_scale(placement, (float3)(1.0f, 0.0f, 0.0f)),
                           area_scale(placement, (float3)(0.0f, 1.0f, 0.0f)),
                           area_scale(placement, (float3)(0.0f, 0.0f, 1.0f)));
}

/* A point, uniform in area; u.x chooses the face and is used again. */
static inline struct object_point box_sample(global const rt_shape *shape,
                                             global const rt_transform_data *placement, float2 u)
{
    (void)shape;
    const float3 areas = box_areas(placement);
    float x = u.x * (areas.x + areas.y + areas.z);
    const uint axis = x < areas.x ? 0u : x < areas.x + areas.y ? 1u : 2u;
    x -= axis == 0u ? 0.0f : axis == 1u ? areas.x : areas.x + areas.y;
    x = 2.0f * x / along_axis(areas, axis); /* 0 to 1 on the one side, to 2 on the other */
    const uint side = x < 1.0f ? 0u : 1u;
    const struct box_face face = box_face(2u * axis + side);
    const float across = fmin(2.0f * (x - (float)side) - 1.0f, 1.0f);
    return box_point(placement, face.normal + across * face.u + (2.0f * u.y - 1.0f) * face.v,
                     2u * axis + side);
}

static inline float box_sample_pdf_a(global const rt_shape *shape,
                                     global const rt_transform_data *placement, float3 n,
                                     float scale)
{
    (void)shape, (void)n, (void)scale;
    const float3 areas = box_areas(placement);
    return 0.5f / (areas.x + areas.y + areas.z);
}

#endif
