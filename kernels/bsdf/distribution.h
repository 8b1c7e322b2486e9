/*
 * distribution.h - the distribution of the microfacets of a boundary: GGX alike in all directions
 * (microfacet.h), or by the flags of its material anisotropic, of Beckmann, or both.
 *
 * Anisotropic facets have alpha along the tangent and alpha_v across it: they are those of alpha 1,
 * stretched. With s(w) = |(alpha w.x, alpha_v w.y)|, p2 = (h.x / alpha)^2 + (h.y / alpha_v)^2:
 *
 *   GGX        D(h) = 1 / (pi alpha alpha_v (p2 + h.z^2)^2)
 *              Lambda(w) = (sqrt(1 + s^2 / w.z^2) - 1) / 2
 *   Beckmann   D(h) = exp(-p2 / h.z^2) / (pi alpha alpha_v h.z^4)
 *              Lambda(w) = (erf(a) - 1) / 2 + exp(-a^2) / (2 a sqrt(pi)),  a = |w.z| / s
 *
 * Visible normals of Beckmann's distribution are sampled by their slopes. With alpha 1 and w in the
 * plane of x and z, that along x has a density in proportion to (w.z - x w.x) exp(-x^2), and that
 * along y to exp(-y^2).
 *
 * References:
 *   Heitz: "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2),
 *     2014, section 5 and appendix A.
 *   Heitz, d'Eon: "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible
 *     Normals", EGSR 2014.
 *   Dupuy, Benyoub: "Sampling Visible GGX Normals with Spherical Caps", HPG 2023.
 */
#ifndef RT_KERNELS_BSDF_DISTRIBUTION_H
#define RT_KERNELS_BSDF_DISTRIBUTION_H

#include "bsdf/lobe.h"
#include "bsdf/microfacet.h"

#define RT_ROOT_PI 1.77245385f

/* Whether the facets are others than those of microfacet.h. */
static inline bool has_other_facets(const struct specular *specular)
{
    return has_flag(specular->material, RT_MATERIAL_BECKMANN | RT_MATERIAL_ANISOTROPIC);
}

static inline bool is_beckmann(const struct specular *specular)
{
    return has_flag(specular->material, RT_MATERIAL_BECKMANN);
}

/* alpha along the tangent and across it. */
static inline float2 both_alphas(const struct specular *specular)
{
    const float alpha = specular->alpha;
    return (float2)(alpha, is_anisotropic(specular->material) ? specular->alpha_v : alpha);
}

/* ---- Others than isotropic GGX --------------------------------------------------- */

/* These are out of line, and take values: what a pointer leads to would have to be in memory. */

RARELY_CALLED float other_density(float2 alpha, bool is_beckmann, float3 h)
{
    const float2 p = h.xy / alpha;
    const float area = RT_PI * alpha.x * alpha.y, z2 = h.z * h.z, p2 = dot(p, p);
    if (!is_beckmann)
        return 1.0f / (area * square(p2 + z2));
    /* So near to the horizon the exponential is 0, up to alpha 1. */
    return z2 > 1e-6f ? exp(-p2 / z2) / (area * z2 * z2) : 0.0f;
}

/* That of ggx_facing. */
RARELY_CALLED float other_facing(float2 alpha, bool is_beckmann, float3 w)
{
    const float z = fabs(w.z), s = length(alpha * w.xy);
    if (!is_beckmann)
        return 0.5f * (z + sqrt(z * z + s * s));
    const float a = z / s;
    return s > 0.0f ? 0.5f * (z * (1.0f + erf(a)) + s * exp(-a * a) / RT_ROOT_PI) : z;
}

/* That of ggx_hidden. */
RARELY_CALLED float other_hidden(float2 alpha, bool is_beckmann, float3 w)
{
    const float z = fabs(w.z), s = length(alpha * w.xy);
    if (!is_beckmann)
        return 0.5f * s * s / (z + sqrt(z * z + s * s));
    const float a = z / s;
    return s > 0.0f ? fmax(0.5f * (s * exp(-a * a) / RT_ROOT_PI - z * erfc(a)), 0.0f) : 0.0f;
}

/* The integral of (z - t r) exp(-t^2) over t up to x. */
static inline float slope_integral(float r, float z, float x)
{
    return 0.5f * (z * RT_ROOT_PI * erfc(-x) + r * exp(-x * x));
}

#define RT_STEEPEST_SLOPE 6.0f /* of alpha 1; beyond lie 2e-17 of Beckmann's facets */

/*
 * The slope below which the part u of the visible ones lies, for a w of the coordinates r along it
 * and z upwards: by Newton's method, kept between bounds that close in.
 */
static inline float sample_slope(float r, float z, float u)
{
    float low = -RT_STEEPEST_SLOPE;
    float high = z < r * RT_STEEPEST_SLOPE ? z / r : RT_STEEPEST_SLOPE;
    const float below = u * slope_integral(r, z, high);
    float x = 0.5f * fmax(low + high, -1.0f);
    for (uint i = 0u; i < 32u; i++) {
        const float over = slope_integral(r, z, x) - below;
        if (over > 0.0f)
            high = x;
        else
            low = x;
        const float step = over / ((z - x * r) * exp(-x * x));
        if (fabs(step) < 1e-6f)
            break;
        x = x - step > low && x - step < high ? x - step : 0.5f * (low + high);
    }
    return x;
}

static inline float3 sample_beckmann(float2 alpha, float3 wo, float2 u)
{
    const float3 seen = unit((float3)(alpha * wo.xy, wo.z));
    const float r = length(seen.xy);
    const float2 along = r > 0.0f ? seen.xy / r : (float2)(1.0f, 0.0f);
    const float x = sample_slope(r, seen.z, u.x), y = sample_slope(0.0f, 1.0f, u.y);
    const float2 slope = x * along + y * (float2)(-along.y, along.x);
    return unit((float3)(-alpha * slope, 1.0f));
}

RARELY_CALLED float3 sample_other(float2 alpha, bool is_beckmann, float3 wo, float2 u)
{
    return is_beckmann ? sample_beckmann(alpha, wo, u) : sample_visible_normal(alpha, wo, u);
}

/* G2 / G1, by the flag of the material. */
static inline float facet_unshadowed(const struct specular *specular, float facing, float hidden,
                                     float3 wo, float3 wi)
{
    if (has_flag(specular->material, RT_MATERIAL_SEPARABLE))
        return unshadowed_alone(hidden, wi);
    return unshadowed(facing, hidden, wo, wi);
}

/* About the normal, with the tangent of anisotropic facets where it has a direction. */
static inline struct frame tangent_frame(const struct specular *specular)
{
    const float3 n = specular->normal;
    const float3 s = specular->tangent - dot(specular->tangent, n) * n;
    struct frame frame = frame_about(n);
    if (is_anisotropic(specular->material) && dot(s, s) > 1e-12f) {
        frame.s = unit(s);
        frame.t = cross(n, frame.s);
    }
    return frame;
}

/* ---- Any ------------------------------------------------------------------------- */

/* Density of normals: the integral of D(h) h.z over the hemisphere is 1. */
static inline float facet_density(const struct specular *specular, float3 h)
{
    return has_other_facets(specular)
               ? other_density(both_alphas(specular), is_beckmann(specular), h)
               : ggx_density(specular->alpha, h);
}

/* |w.z| (1 + Lambda(w)), and |w.z| Lambda(w). */
static inline float facing_area(const struct specular *specular, float3 w)
{
    return has_other_facets(specular)
               ? other_facing(both_alphas(specular), is_beckmann(specular), w)
               : ggx_facing(specular->alpha, w);
}

static inline float hidden_area(const struct specular *specular, float3 w)
{
    return has_other_facets(specular)
               ? other_hidden(both_alphas(specular), is_beckmann(specular), w)
               : ggx_hidden(specular->alpha, w);
}

/* A normal among those that wo sees. */
static inline float3 sample_facet(const struct specular *specular, float3 wo, float2 u)
{
    return has_other_facets(specular)
               ? sample_other(both_alphas(specular), is_beckmann(specular), wo, u)
               : sample_visible_normal((float2)(specular->alpha), wo, u);
}

/* The frame of the facets. */
static inline struct frame facet_frame(const struct specular *specular)
{
    return has_other_facets(specular) ? tangent_frame(specular) : frame_about(specular->normal);
}

#endif
