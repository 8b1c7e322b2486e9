/*
 * torus.h - the torus: in object space about z, of major radius 1 and minor radius m = p[0] < 1.
 *
 * Rays are intersected without the quartic, whose coefficients lose a thin tube. The function along
 * the line is the signed square h = (r - 1)^2 + z^2 - m^2, with r the distance from the axis. With
 * the closest approach k to the axis at s0 and a = dx^2 + dy^2, r^2 = a (s - s0)^2 + k^2 and h'' =
 * 2 - 2 a k^2 / r^3. So h is concave where r^3 < a k^2, an interval about s0, and convex on both
 * sides of it: three spans with at most two roots each. On each, the signs at the ends, or else at
 * the extremum, tell the roots apart, and Newton's method held between bounds finds them.
 */
#ifndef RT_KERNELS_SHAPE_TORUS_H
#define RT_KERNELS_SHAPE_TORUS_H

#include "shape/line.h"
#include "shape/object_point.h"

/* ---- Intersection ----------------------------------------------------------- */

/* the line is cut to the torus' bounds, enlarged by this, where h is well above 0 */
#define TORUS_ROOM 1.01f

/* h or, on a concave span, -h at s. */
struct torus_point {
    float s, h, slope;
};

static inline struct torus_point torus_at(const struct line *line, float minor, float sign, float s)
{
    const float3 p = line->origin + s * line->direction;
    const float from_axis = length(p.xy), x = from_axis - 1.0f;
    const float rate = from_axis > 0.0f ? dot(p.xy, line->direction.xy) / from_axis : 0.0f;
    struct torus_point point;
    point.s = s;
    point.h = sign * (x * x + (p.z - minor) * (p.z + minor));
    point.slope = sign * 2.0f * (x * rate + p.z * line->direction.z);
    return point;
}

/* Cuts [lo, hi] to where the line is within the torus' bounds; false when it is nowhere. */
static inline bool torus_bounds(const struct line *line, float minor, float *lo, float *hi)
{
    const float reach = TORUS_ROOM * (1.0f + minor), height = TORUS_ROOM * minor;
    const float along = dot(line->origin, line->direction);
    const float3 nearest = line->origin - along * line->direction;
    const float square_half = reach * reach - dot(nearest, nearest);
    if (square_half < 0.0f)
        return false;
    *lo = fmax(line->lo, -along - sqrt(square_half));
    *hi = fmin(line->hi, -along + sqrt(square_half));
    const float z = line->origin.z, dz = line->direction.z;
    if (dz == 0.0f)
        return fabs(z) <= height && *lo <= *hi;
    const float below = (-height - z) / dz, above = (height - z) / dz;
    *lo = fmax(*lo, fmin(below, above));
    *hi = fmin(*hi, fmax(below, above));
    return *lo <= *hi;
}

/*
 * The span of s on which h is concave; empty, with its ends alike, where it is convex throughout.
 */
static inline float2 torus_concave(const struct line *line)
{
    const float2 o = line->origin.xy, d = line->direction.xy;
    const float a = dot(d, d), across = o.x * d.y - o.y * d.x;
    if (a < 1e-12f)
        return (float2)(-INFINITY);
    const float middle = -dot(o, d) / a, k2 = across * across / a;
    const float root = cbrt(a * k2), excess = root * root - k2;
    const float half_width = sqrt(fmax(excess / a, 0.0f));
    return (float2)(middle - half_width, middle + half_width);
}

/*
 * Finds a point between a and b at which a convex h is negative; it is not at a, where it slopes
 * down, nor at b, where it slopes up. The tangents at a and b bound h from below: where they meet
 * above 0 there is none.
 */
static inline bool torus_dip(const struct line *line, float minor, float sign, struct torus_point a,
                             struct torus_point b, struct torus_point *dip)
{
    for (int i = 0; i < 32; i++) {
        const float width = b.s - a.s, bend = b.slope - a.slope;
        const float meet = (b.slope * width - (b.h - a.h)) / bend; /* from a */
        if (!(bend > 0.0f) || a.h + a.slope * meet > 0.0f)
            return false;
        float s = i % 3 == 2 ? a.s + 0.5f * width : a.s - a.slope * width / bend;
        if (!(s > a.s && s < b.s)) {
            s = a.s + 0.5f * width;
            if (!(s > a.s && s < b.s))
                return false;
        }
        *dip = torus_at(line, minor, sign, s);
        if (dip->h < 0.0f)
            return true;
        if (dip->slope < 0.0f)
            a = *dip;
        else
            b = *dip;
    }
    return false;
}

/* The root of a convex h between a point `out`, where h >= 0, and a point `in`, where h < 0. */
static inline float torus_root(const struct line *line, float minor, float sign,
                               struct torus_point out, struct torus_point in)
{
    /* from here Newton's method comes nearer without passing the root */
    struct torus_point at = out;
    for (int i = 0; i < 40; i++) {
        const float lo = fmin(out.s, in.s), hi = fmax(out.s, in.s);
        const float step = at.h / at.slope;
        float s = at.s - step;
        if (fabs(step) <= 0x1p-24f + 0x1p-23f * fabs(s))
            return clamp(s, lo, hi);
        if (!(s > lo && s < hi)) {
            s = 0.5f * (lo + hi);
            if (!(s > lo && s < hi))
                break;
        }
        at = torus_at(line, minor, sign, s);
        if (at.h < 0.0f)
            in = at;
        else
            out = at;
    }
    return at.s;
}

/* The first root on a span between points a and b, on which sign h is convex; infinity for none. */
static inline float torus_first(const struct line *line, float minor, float sign,
                                struct torus_point a, struct torus_point b)
{
    a.h *= sign, a.slope *= sign;
    b.h *= sign, b.slope *= sign;
    if (a.h < 0.0f)
        return b.h < 0.0f ? INFINITY : torus_root(line, minor, sign, b, a);
    struct torus_point in = b;
    if (!(b.h < 0.0f) &&
        !(a.slope < 0.0f && b.slope > 0.0f && torus_dip(line, minor, sign, a, b, &in)))
        return INFINITY;
    return torus_root(line, minor, sign, a, in);
}

/* The nearest s at which the line meets the torus, or infinity. */
static inline float intersect_torus(float minor, const struct line *line, uint *part)
{
    float lo, hi;
    if (!torus_bounds(line, minor, &lo, &hi))
        return INFINITY;
    const float2 concave = torus_concave(line);
    struct torus_point a = torus_at(line, minor, 1.0f, lo);
    for (int span = 0; span < 3; span++) {
        const float end = span == 0 ? fmin(concave.x, hi) : span == 1 ? fmin(concave.y, hi) : hi;
        if (!(end > a.s))
            continue;
        const struct torus_point b = torus_at(line, minor, 1.0f, end);
        const float s = torus_first(line, minor, span == 1 ? -1.0f : 1.0f, a, b);
        if (s < INFINITY) {
            *part = a.h < 0.0f ? PART_EXITS : 0u;
            return s;
        }
        a = b;
    }
    return INFINITY;
}

static inline float torus_intersect(global const rt_shape *shape, const struct ray *ray, uint *part)
{
    const struct line line = make_line(ray);
    const float s = intersect_torus(shape->p[0], &line, part);
    return s < INFINITY ? line_t(&line, ray, s) : INFINITY;
}

/* ---- Surface ---------------------------------------------------------------- */

static inline struct object_point torus_point(global const rt_shape *shape, float3 p)
{
    struct object_point point;
    const float minor = shape->p[0];
    const float from_axis = length(p.xy);
    const float2 outwards = from_axis > 0.0f ? p.xy / from_axis : (float2)(1.0f, 0.0f);
    const float2 tube = (float2)(from_axis - 1.0f, p.z); /* from the middle of the tube */
    const float distance = length(tube);
    const float2 n = distance > 0.0f ? tube / distance : (float2)(1.0f, 0.0f);
    point.position = (float3)(outwards * (1.0f + minor * n.x), minor * n.y);
    point.normal = (float3)(outwards * n.x, n.y);
    point.error = gamma_bound(16.0f);
    return point;
}

static inline struct object_point torus_hit(global const rt_shape *shape,
                                            global const rt_transform_data *placement,
                                            const struct ray *ray, float3 p, uint part)
{
    (void)placement;
    struct object_point point = torus_point(shape, p);
    point.normal = facing_normal(point.normal, ray->direction, part & PART_EXITS);
    return point;
}

static inline float2 torus_uv(global const rt_shape *shape, float3 p, float3 n)
{
    (void)shape, (void)n;
    return (float2)(turns(p.y, p.x), turns(p.z, length(p.xy) - 1.0f));
}

static inline struct tangents torus_tangents(global const rt_shape *shape, float3 p, float3 n)
{
    (void)shape, (void)n;
    const float from_axis = length(p.xy);
    const float2 outwards = from_axis > 0.0f ? p.xy / from_axis : (float2)(1.0f, 0.0f);
    struct tangents along;
    along.u = 2.0f * RT_PI * (float3)(-p.y, p.x, 0.0f);
    along.v = 2.0f * RT_PI * (float3)(-p.z * outwards, from_axis - 1.0f);
    return along;
}

/* ---- Area sampling ---------------------------------------------------------- */

/*
 * The angle around the tube at u of the cumulative distribution of 1 + m cos(angle): Kepler's
 * equation angle + m sin(angle) = 2 pi u, by Newton's method kept between bounds.
 */
static inline float tube_angle(float m, float u)
{
    const float mean = 2.0f * RT_PI * u;
    float lo = 0.0f, hi = 2.0f * RT_PI, angle = mean;
    for (int i = 0; i < 24; i++) {
        const float excess = angle + m * sin(angle) - mean;
        if (excess > 0.0f)
            hi = angle;
        else
            lo = angle;
        const float next = angle - excess / (1.0f + m * cos(angle));
        if (fabs(next - angle) < 1e-6f)
            break;
        angle = next > lo && next < hi ? next : 0.5f * (lo + hi);
    }
    return angle;
}

static inline struct object_point torus_sample(global const rt_shape *shape,
                                               global const rt_transform_data *placement, float2 u)
{
    (void)placement;
    const float turn = 2.0f * RT_PI * u.y;
    const float angle = tube_angle(shape->p[0], u.x), radius = 1.0f + shape->p[0] * cos(angle);
    return torus_point(shape,
                       (float3)(radius * cos(turn), radius * sin(turn), shape->p[0] * sin(angle)));
}

static inline float torus_sample_pdf_a(global const rt_shape *shape,
                                       global const rt_transform_data *placement, float3 n,
                                       float scale)
{
    (void)placement, (void)n;
    return 1.0f / (4.0f * square(RT_PI) * shape->p[0] * scale);
}

#endif
