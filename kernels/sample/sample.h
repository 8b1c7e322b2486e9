/*
 * sample.h - from the unit square to discs, directions and surfaces, each with its density.
 *
 * sample_X maps a point of [0,1)^2; X_pdf_w is its density in solid angle, X_pdf_a in area
 * (both per steradian or square metre). Directions are unit vectors.
 *
 * References:
 *   Urena, Fajardo, King: "An Area-Preserving Parametrization for Spherical Rectangles",
 *     EGSR 2013.
 *   Shirley, Wang, Zimmerman: "Monte Carlo Techniques for Direct Lighting Calculations",
 *     ACM TOG 15(1), 1996 (the cap of a sphere).
 *   Moshier: the Cephes library (minimax polynomials of sin, cos and atan).
 */
#ifndef RT_KERNELS_SAMPLE_SAMPLE_H
#define RT_KERNELS_SAMPLE_SAMPLE_H

#include "math/frame.h"
#include "math/width1.inc.h"
#include "sample/cosine.inc.h"
#include "sample/triangle.inc.h"

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

/* ---- Elementary functions ------------------------------------------------ */

/* atan(y / x) for x >= 0 and not both zero, absolute error below 2e-7. */
static inline float4 atan_ratio(float4 y, float4 x)
{
    /* Reduce to [0, 1] by atan(t) = pi/2 - atan(1/t), then to tan(pi/8) by a rotation of pi/4. */
    const float4 a = fabs(y);
    const int4 steep = a > x;
    const float4 low = select(a, x, steep);
    const float4 high = select(x, a, steep);
    const int4 middle = low > 0.414213562f * high;
    const float4 t = select(low, low - high, middle) / select(high, low + high, middle);
    const float4 t2 = t * t;
    const float4 tail = -1.38776856032e-1f + t2 * 8.05374449538e-2f;
    float4 angle = t + t * t2 * (-3.33329491539e-1f + t2 * (1.99777106478e-1f + t2 * tail));
    angle += select((float4)(0.0f), (float4)(0.785398163f), middle);
    angle = select(angle, 1.57079632679f - angle, steep);
    return copysign(angle, y);
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

/*
 * A rectangle as seen from a point: sides from x0 to x1 and y0 to y1, at distance z > 0, in a frame
 * along its edges. With p = (-y0, x1, y1, -x0), going round the sides, the inner angles are g[i] =
 * pi/2 + a[i] with a[i] = asin(n[i] n[i+1]), n[i] = p[i] / sqrt(p[i]^2 + z^2) (Urena et al.,
 * section 3), and the solid angle is a[0] + a[1] + a[2] + a[3]. In place of asin, which loses half
 * the digits near 1, here a[i] = atan(p[i] p[i+1] / (z sqrt(p[i]^2 + p[i+1]^2 + z^2))): equal, and
 * accurate to the last digits for points close to the rectangle's plane.
 */
struct seen_rectangle {
    float4 p;
    float z;
    float solid_angle; /* sr, absolute error below 1e-6 */
    float turn;        /* a[2] + a[3] */
};

/* The rectangle from x0 to x0 + width and y0 to y0 + height at distance z. */
static inline struct seen_rectangle see_rectangle(float x0, float y0, float z, float width,
                                                  float height)
{
    struct seen_rectangle seen;
    seen.p = (float4)(-y0, x0 + width, y0 + height, -x0);
    seen.z = z;
    const float4 p2 = seen.p * seen.p;
    const float4 a = atan_ratio(seen.p * seen.p.yzwx, z * sqrt(p2 + p2.yzwx + z * z));
    seen.turn = a.z + a.w;
    seen.solid_angle = a.x + a.y + seen.turn;
    return seen;
}

/* Lengths along the two edges, uniform in solid angle; density 1 / solid_angle. */
static inline float2 sample_seen_rectangle(const struct seen_rectangle *seen, float2 u)
{
    const float x0 = -seen->p.w, x1 = seen->p.y, y0 = -seen->p.x, y1 = seen->p.z;
    const float z2 = seen->z * seen->z;

    /*
     * Urena et al., equation 6 solved for xu, with cu = sin(au) taken off both parts of the
     * fraction.
     */
    const float2 arc = sin_cos(seen->turn - u.x * seen->solid_angle);
    const float4 edge = (float4)(y0 * y0, y1 * y1, 0.0f, 0.0f) + z2;
    const float b0 = -y0 / sqrt(edge.x), b1 = y1 / sqrt(edge.y);
    const float n = arc.y * b0 + b1;
    const float rest = n * n - arc.x * arc.x * z2 / edge.x;
    float xu = seen->z * arc.x / sqrt(rest > 1e-14f ? rest : 1e-14f);
    xu = clamp(n > 0.0f ? -xu : xu, x0, x1);

    /* Along y at xu, the sine of the elevation is uniform. */
    const float d2 = xu * xu + z2;
    const float h0 = y0 / sqrt(d2 + y0 * y0), h1 = y1 / sqrt(d2 + y1 * y1);
    const float h = h0 + u.y * (h1 - h0);
    const float cosine2 = 1.0f - h * h;
    const float yv = clamp(h * sqrt(d2 / (cosine2 > 1e-14f ? cosine2 : 1e-14f)), y0, y1);
    return (float2)(xu - x0, yv - y0);
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
