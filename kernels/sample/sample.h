/*
 * sample.h - from the unit square to discs, directions and surfaces, each with its density.
 *
 * sample_X maps a point of [0,1)^2; X_pdf_w is its density in solid angle, X_pdf_a in area
 * (both per steradian or square metre). Directions are unit vectors.
 *
 * References:
 *   Shirley, Wang, Zimmerman: "Monte Carlo Techniques for Direct Lighting Calculations",
 *     ACM TOG 15(1), 1996 (the cap of a sphere).
 *   Moshier: the Cephes library (minimax polynomials of sin and cos).
 */
#ifndef RT_KERNELS_SAMPLE_SAMPLE_H
#define RT_KERNELS_SAMPLE_SAMPLE_H

#include "math/frame.h"
#include "math/width1.inc.h"
#include "sample/cosine.inc.h"
#include "sample/triangle.inc.h"

#define RT_FAR_RECTANGLE 1.5f /* distance / diagonal beyond which a rectangle is sampled by area */
/* sr; there the rounding of the solid angle is below 1e-4 of it */
#define RT_SMALL_SOLID_ANGLE 1e-2f

/* The angles at the four corners of a rectangle at once. */
#define ANGLES float4
#define ANGLE_TESTS int4
#define ANGLE(name) name
#include "sample/angle.inc.h"
#include "sample/rectangle.inc.h"

/* The largest number below 1, to which rescaled samples are bounded. */
#define RT_BELOW_ONE 0x1.fffffep-1f

/*
 * The i with cdf[i] <= u < cdf[i + 1] of a cumulative distribution, or other ascending numbers,
 * over `count` cells; *rest is u's place between the two.
 */
static inline uint find_interval(global const float *cdf, uint count, float u, float *rest)
{
    uint first = 0u;
    while (count > 1u) {
        const uint half_count = count >> 1;
        first += u < cdf[first + half_count] ? 0u : half_count;
        count -= half_count;
    }
    *rest = clamp((u - cdf[first]) / (cdf[first + 1u] - cdf[first]), 0.0f, 1.0f);
    return first;
}

/* ---- Disc, hemisphere, sphere, triangle ---------------------------------- */

static inline float disc_pdf_a(void)
{
    return 1.0f / RT_PI;
}

static inline float3 sample_sphere(float2 u)
{
    const float z = 1.0f - 2.0f * u.x;
    const float r2 = 4.0f * u.x * (1.0f - u.x);
    const float2 arc = sin_cos(2.0f * RT_PI * u.y);
    return (float3)(sqrt(r2) * arc.yx, z);
}

static inline float sphere_pdf_w(void)
{
    return 1.0f / (4.0f * RT_PI);
}

static inline float triangle_pdf_a(float3 e1, float3 e2)
{
    const float3 n = cross(e1, e2);
    return 2.0f / sqrt(dot(n, n));
}

/*
 * The regular polygon in the unit circle, one corner `turn` turns from +x, evenly: u.x chooses the
 * triangle between the centre and an edge, and with u.y the point in it.
 */
static inline float2 sample_polygon(uint corners, float turn, float2 u)
{
    const float place = u.x * (float)corners;
    const float edge = floor(place);
    const float a = turn + edge / (float)corners, b = turn + (edge + 1.0f) / (float)corners;
    const float2 weight = sample_triangle((float2)(place - edge, u.y));
    return weight.x * sin_cos(2.0f * RT_PI * (a - floor(a))).yx +
           weight.y * sin_cos(2.0f * RT_PI * (b - floor(b))).yx;
}

/* ---- The line ------------------------------------------------------------- */

/* In [-1, 1], by the density 1 - |x|, each coordinate on its own. */
static inline float2 sample_tent(float2 u)
{
    return select(1.0f - sqrt(2.0f - 2.0f * u), sqrt(2.0f * u) - 1.0f, u < 0.5f);
}

/* ---- Rectangle by solid angle -------------------------------------------- */

/* The rectangle from x0 to x0 + width and y0 to y0 + height at distance z. */
static inline struct seen_rectangle see_rectangle(float x0, float y0, float z, float width,
                                                  float height)
{
    const float4 p = (float4)(-y0, x0 + width, y0 + height, -x0);
    const float4 a = corner_angles(p, p.yzwx, (float4)(z));
    struct seen_rectangle seen = {x0, p.y, y0, p.z, z};
    seen.turn = a.z + a.w;
    seen.solid_angle = a.x + a.y + seen.turn;
    return seen;
}

static inline float seen_rectangle_pdf_w(const struct seen_rectangle *seen)
{
    return 1.0f / seen->solid_angle;
}

/* ---- Visible cap of a sphere --------------------------------------------- */

/*
 * 1 - cos of the cone's half-angle under which a sphere of radius r is seen from distance d > r.
 * As sin^2 / (1 + cos), it keeps its digits for far, small spheres.
 */
static inline float cap_height(float r, float d2)
{
    const float sine2 = r * r / d2;
    const float cosine2 = 1.0f - sine2;
    return sine2 / (1.0f + sqrt(cosine2 > 0.0f ? cosine2 : 0.0f));
}

/*
 * The point of the unit sphere about the origin, seen by a viewer on +z, uniform in solid angle of
 * the cone.
 */
static inline float3 sample_cap(float r, float d2, float2 u)
{
    /* Angle at the viewer: cos = 1 - h. */
    const float far2 = d2 / (r * r);
    const float h = u.x * cap_height(r, d2);
    const float sine2 = h * (2.0f - h);
    /*
     * Distance to the nearer point where that direction meets the sphere, and what it is off the
     * axis.
     */
    const float inside2 = 1.0f - far2 * sine2;
    const float t =
        (far2 - 1.0f) / (sqrt(far2) * (1.0f - h) + sqrt(inside2 > 0.0f ? inside2 : 0.0f));
    const float off2 = t * t * sine2;
    const float2 arc = sin_cos(2.0f * RT_PI * u.y);
    return (float3)(sqrt(off2) * arc.yx, sqrt(off2 < 1.0f ? 1.0f - off2 : 0.0f));
}

static inline float cap_pdf_w(float r, float d2)
{
    return 1.0f / (2.0f * RT_PI * cap_height(r, d2));
}

#endif
