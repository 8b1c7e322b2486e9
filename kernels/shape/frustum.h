/*
 * frustum.h - what cylinder and cone share: in object space both are frustums about z, of radius 1
 * at z = 0 and radius `top` at z = 1, open or closed by caps.
 *
 * With w = 1 - (1 - top) z the radius at z, the side is x^2 + y^2 = w^2. The solid is where the
 * inside of that double cone meets the slab 0 <= z <= 1; both are intervals of the ray, so that no
 * ray passes between side and cap.
 */
#ifndef RT_KERNELS_SHAPE_FRUSTUM_H
#define RT_KERNELS_SHAPE_FRUSTUM_H

#include "sample/sample.h"
#include "shape/disc.h"
#include "shape/line.h"
#include "shape/object_point.h"

/* The parts of a frustum. */
#define FRUSTUM_SIDE 0u
#define FRUSTUM_BASE 1u /* the cap at z = 0 */
#define FRUSTUM_TOP 2u  /* the cap at z = 1 */

/* ---- Intersection ----------------------------------------------------------- */

/* Where the line is inside the slab; false when nowhere. */
static inline bool cross_slab(const struct line *line, float2 *inside)
{
    const float z = line->origin.z, dz = line->direction.z;
    *inside = (float2)(-INFINITY, INFINITY);
    if (dz == 0.0f)
        return z >= 0.0f && z <= 1.0f;
    const float to_base = -z / dz, to_top = (1.0f - z) / dz;
    *inside = dz > 0.0f ? (float2)(to_base, to_top) : (float2)(to_top, to_base);
    return true;
}

/*
 * Newton's method on (distance from the axis) - w, which is convex, removes from a root the error
 * of cancellation in the coefficients. Where two roots nearly coincide it is left as it is. Returns
 * whether it is on the side at all, and not on the other half of the double cone.
 */
static inline bool polish_root(const struct line *line, float top, float *root)
{
    const float slope = 1.0f - top;
    for (int i = 0;; i++) {
        const float3 p = line->origin + *root * line->direction;
        const float from_axis = length(p.xy), w = 1.0f - slope * p.z, off = from_axis - w;
        const float rate = dot(p.xy, line->direction.xy) / from_axis + slope * line->direction.z;
        if (i == 4 || w < 0.0f || !(fabs(off) > 1e-7f) || !(fabs(off) < 0.1f * fabs(rate)))
            return fabs(off) <= 1e-5f * (1.0f + fabs(*root));
        *root -= off / rate;
    }
}

/*
 * Where the line meets the double cone, in rising order, and *inside, where it is in the part of it
 * that the slab holds; false when it misses. The discriminant b^2 - a c of a s^2 + 2 b s + c is
 * |(x, y) dw - w (dx, dy)|^2 - (x dy - y dx)^2, by Lagrange's identity for one negative square. s
 * counts from where the line is nearest to the middle of the top: there the coefficients are small
 * where the cone is.
 */
static inline bool cross_side(const struct line *line, float top, float2 *roots, float2 *inside)
{
    const float3 from_top = line->origin - (float3)(0.0f, 0.0f, 1.0f);
    const float shift = -dot(from_top, line->direction);
    const float3 near = from_top + shift * line->direction;
    const float2 o = near.xy, d = line->direction.xy;
    const float w = top - (1.0f - top) * near.z, dw = (top - 1.0f) * line->direction.z;
    const float from_axis = length(o);
    const float a = dot(d, d) - dw * dw, b = dot(o, d) - w * dw,
                c = (from_axis - w) * (from_axis + w);
    const float outer = length(o * dw - w * d), inner = fabs(o.x * d.y - o.y * d.x);
    const float discriminant = (outer - inner) * (outer + inner);
    if (discriminant < 0.0f && a >= 0.0f)
        return false;
    const float q = -(b + copysign(sqrt(fmax(discriminant, 0.0f)), b));
    if (q == 0.0f) {
        /* Parallel to the axis of a cylinder: inside everywhere or nowhere. */
        *roots = *inside = (float2)(-INFINITY, INFINITY);
        return a == 0.0f && c <= 0.0f;
    }
    float lo = shift + fmin(c / q, q / a), hi = shift + fmax(c / q, q / a);
    const bool lo_is_hit = polish_root(line, top, &lo), hi_is_hit = polish_root(line, top, &hi);
    if (a > 0.0f && !lo_is_hit && !hi_is_hit)
        return false; /* spurious roots near an apex, made by rounding */
    *roots = (float2)(lo_is_hit ? lo : -INFINITY, hi_is_hit ? hi : INFINITY);
    if (a >= 0.0f)
        *inside = (float2)(lo, hi);
    else /* one root on each half of the double cone: the slab lies where w grows from 0 */
        *inside = dw > 0.0f ? (float2)(hi, INFINITY) : (float2)(-INFINITY, lo);
    return true;
}

/*
 * The nearest s at which the line meets the frustum, or infinity; *part is the part that it meets.
 */
static inline float intersect_frustum(global const rt_shape *shape, float top,
                                      const struct line *line, uint *part)
{
    float2 slab, side, roots;
    if (!cross_slab(line, &slab) || !cross_side(line, top, &roots, &side))
        return INFINITY;
    if (!(shape->flags & RT_SHAPE_CAPS)) {
        float root = roots.x;
        if (!(root >= slab.x && root <= slab.y && line_has(line, root)))
            root = roots.y;
        *part = FRUSTUM_SIDE | (root > side.x ? PART_EXITS : 0u);
        return root >= slab.x && root <= slab.y && line_has(line, root) ? root : INFINITY;
    }
    const bool upwards = line->direction.z > 0.0f;
    const float enter = fmax(slab.x, side.x), leave = fmin(slab.y, side.y);
    if (!(enter <= leave))
        return INFINITY;
    if (line_has(line, enter)) {
        *part = side.x >= slab.x ? FRUSTUM_SIDE : upwards ? FRUSTUM_BASE : FRUSTUM_TOP;
        return enter;
    }
    *part = (side.y <= slab.y ? FRUSTUM_SIDE : upwards ? FRUSTUM_TOP : FRUSTUM_BASE) | PART_EXITS;
    return line_has(line, leave) ? leave : INFINITY;
}

/* The same for a ray: its t. */
static inline float frustum_intersect(global const rt_shape *shape, float top,
                                      const struct ray *ray, uint *part)
{
    const struct line line = make_line(ray);
    const float s = intersect_frustum(shape, top, &line, part);
    return s < INFINITY ? line_t(&line, ray, s) : INFINITY;
}

/* ---- Surface ---------------------------------------------------------------- */

static inline struct object_point frustum_cap(float3 p, float radius, float z, float margin)
{
    struct object_point point;
    const float rim = fmax(radius - margin, 0.0f), from_axis = length(p.xy);
    point.position = (float3)(p.xy * (from_axis > rim ? rim / from_axis : 1.0f), z);
    point.normal = (float3)(0.0f, 0.0f, z > 0.0f ? 1.0f : -1.0f);
    point.error = gamma_bound(2.0f);
    return point;
}

/*
 * The point at p of a part. Where parts meet it is kept off the other part by its rounding error,
 * so that a ray that leaves the one starts inside the other.
 */
static inline struct object_point frustum_point(global const rt_shape *shape, float top,
                                                global const rt_transform_data *placement, float3 p,
                                                uint part)
{
    const float slope = 1.0f - top;
    const float margin =
        0x1p-20f + 2.0f * length(placement_error(placement, p, point_to_world(placement, p)));
    if (part == FRUSTUM_BASE)
        return frustum_cap(p, 1.0f, 0.0f, margin);
    if (part == FRUSTUM_TOP)
        return frustum_cap(p, top, 1.0f, margin);
    struct object_point point;
    const float from_axis = length(p.xy);
    const float2 outwards = from_axis > 0.0f ? p.xy / from_axis : (float2)(1.0f, 0.0f);
    const float z =
        shape->flags & RT_SHAPE_CAPS ? clamp(p.z, margin, 1.0f - margin) : clamp(p.z, 0.0f, 1.0f);
    point.position = (float3)(outwards * (1.0f - slope * z), z);
    point.normal = unit((float3)(outwards, slope));
    point.error = gamma_bound(16.0f);
    return point;
}

static inline struct object_point frustum_hit(global const rt_shape *shape, float top,
                                              global const rt_transform_data *placement,
                                              const struct ray *ray, float3 p, uint part)
{
    struct object_point point = frustum_point(shape, top, placement, p, part & PART_MASK);
    point.normal = facing_normal(point.normal, ray->direction, part & PART_EXITS);
    return point;
}

static inline float2 frustum_uv(float top, float3 p, float3 n)
{
    if (fabs(n.z) > 0.999f)
        return (float2)(turns_on_disc(p, n.z),
                        fmin(length(p.xy) / (n.z < 0.0f ? 1.0f : top), 1.0f));
    return (float2)(turns(p.y, p.x), clamp(p.z, 0.0f, 1.0f));
}

static inline struct tangents frustum_tangents(float top, float3 p, float3 n)
{
    const float from_axis = length(p.xy);
    const float2 outwards = from_axis > 0.0f ? p.xy / from_axis : (float2)(1.0f, 0.0f);
    const bool is_cap = fabs(n.z) > 0.999f;
    struct tangents along;
    /* see turns_on_disc */
    along.u = (is_cap && n.z > 0.0f ? -2.0f : 2.0f) * RT_PI * (float3)(-p.y, p.x, 0.0f);
    along.v = is_cap ? (float3)((n.z < 0.0f ? 1.0f : top) * outwards, 0.0f)
                     : (float3)((top - 1.0f) * outwards, 1.0f);
    return along;
}

/* ---- Area sampling ---------------------------------------------------------- */

/*
 * Areas in the world of the side, estimated by its area scale in two directions, and of the caps at
 * z = 0 and z = 1, which are 0 when open. A part is chosen in proportion to them.
 */
static inline float3 frustum_areas(global const rt_shape *shape, float top,
                                   global const rt_transform_data *placement)
{
    const float slope = 1.0f - top;
    const float side = 0.5f * (area_scale(placement, (float3)(1.0f, 0.0f, slope)) +
                               area_scale(placement, (float3)(0.0f, 1.0f, slope)));
    const float cap =
        shape->flags & RT_SHAPE_CAPS ? area_scale(placement, (float3)(0.0f, 0.0f, 1.0f)) : 0.0f;
    return RT_PI * (float3)((1.0f + top) * side, cap, cap * top * top);
}

/* A point of the side or a cap; u.x chooses which and is used again. */
static inline struct object_point frustum_sample(global const rt_shape *shape, float top,
                                                 global const rt_transform_data *placement,
                                                 float2 u)
{
    const float3 areas = frustum_areas(shape, top, placement);
    const float all = areas.x + areas.y + areas.z;
    const float turn = 2.0f * RT_PI * u.y;
    float x = u.x * all;
    if (x < areas.x || all == areas.x) {
        /* Radii in proportion to themselves, from 1 down to top. */
        const float radius = sqrt(mix(1.0f, square(top), fmin(x / areas.x, 1.0f)));
        const float z = top < 1.0f ? (1.0f - radius) / (1.0f - top) : x / areas.x;
        return frustum_point(shape, top, placement,
                             (float3)(radius * cos(turn), radius * sin(turn), z), FRUSTUM_SIDE);
    }
    x -= areas.x;
    const bool base = x < areas.y || areas.z == 0.0f;
    x = base ? x / areas.y : (x - areas.y) / areas.z;
    const float radius = sqrt(fmin(x, 1.0f)) * (base ? 1.0f : top);
    return frustum_point(shape, top, placement,
                         (float3)(radius * cos(turn), radius * sin(turn), base ? 0.0f : 1.0f),
                         base ? FRUSTUM_BASE : FRUSTUM_TOP);
}

static inline float frustum_sample_pdf_a(global const rt_shape *shape, float top,
                                         global const rt_transform_data *placement, float3 n,
                                         float scale)
{
    const float3 areas = frustum_areas(shape, top, placement);
    const float all = areas.x + areas.y + areas.z;
    if (n.z < -0.9f)
        return areas.y / (all * RT_PI * scale);
    if (n.z > 0.9f) /* the side's normal rises by 45 degrees at most */
        return areas.z / (all * RT_PI * square(top) * scale);
    return areas.x / (all * RT_PI * (1.0f + top) * sqrt(1.0f + square(1.0f - top)) * scale);
}

#endif
