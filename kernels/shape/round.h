/*
 * round.h - rays against cylinders and cones, in their own space.
 *
 * With w = 1 - (1 - top) z the radius at z, the side is x^2 + y^2 = w^2. The solid is where the
 * inside of that double cone meets the slab 0 <= z <= 1; both are intervals of the ray, so that no
 * ray passes between side and cap.
 */
#ifndef RT_KERNELS_SHAPE_ROUND_H
#define RT_KERNELS_SHAPE_ROUND_H

#include "shape/canonical.h"
#include "shape/line.h"

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
 * Newton's method on (distance from the axis) - w, which is convex, takes out of a root what
 * cancelled in the coefficients. Where two roots all but meet it is left as it is. Returns whether
 * it is on the side at all, and not on the other half of the double cone.
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
        /* Along the axis of a cylinder: inside for good or never. */
        *roots = *inside = (float2)(-INFINITY, INFINITY);
        return a == 0.0f && c <= 0.0f;
    }
    float lo = shift + fmin(c / q, q / a), hi = shift + fmax(c / q, q / a);
    const bool lo_is_met = polish_root(line, top, &lo), hi_is_met = polish_root(line, top, &hi);
    if (a > 0.0f && !lo_is_met && !hi_is_met)
        return false; /* roots that rounding made of a miss near an apex */
    *roots = (float2)(lo_is_met ? lo : -INFINITY, hi_is_met ? hi : INFINITY);
    if (a >= 0.0f)
        *inside = (float2)(lo, hi);
    else /* one root on each half of the double cone: the slab lies where w grows from 0 */
        *inside = dw > 0.0f ? (float2)(hi, INFINITY) : (float2)(-INFINITY, lo);
    return true;
}

/*
 * The nearest meeting of the line with a cylinder or cone, or infinity; *part is the part that is
 * met.
 */
static inline float intersect_round(global const rt_shape *shape, const struct line *line,
                                    uint *part)
{
    float2 slab, side, roots;
    if (!cross_slab(line, &slab) || !cross_side(line, round_top(shape), &roots, &side))
        return INFINITY;
    if (!(shape->flags & RT_SHAPE_CAPS)) {
        float root = roots.x;
        if (!(root >= slab.x && root <= slab.y && line_has(line, root)))
            root = roots.y;
        *part = ROUND_SIDE | (root > side.x ? PART_LEAVES : 0u);
        return root >= slab.x && root <= slab.y && line_has(line, root) ? root : INFINITY;
    }
    const bool upwards = line->direction.z > 0.0f;
    const float enter = fmax(slab.x, side.x), leave = fmin(slab.y, side.y);
    if (!(enter <= leave))
        return INFINITY;
    if (line_has(line, enter)) {
        *part = side.x >= slab.x ? ROUND_SIDE : upwards ? ROUND_BASE : ROUND_TOP;
        return enter;
    }
    *part = (side.y <= slab.y ? ROUND_SIDE : upwards ? ROUND_TOP : ROUND_BASE) | PART_LEAVES;
    return line_has(line, leave) ? leave : INFINITY;
}

#endif
