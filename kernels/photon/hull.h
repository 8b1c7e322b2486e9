/*
 * hull.h - photon density by the convex hull of the photons, in the tangent plane of a point.
 *
 * A disc that reaches over the edge of a surface covers area where no photon can lie, and half of
 * the light or more is lost there (boundary bias). The hull of the photons stays on the surface.
 * For n uniform points in a convex region of area a, the expected area of the hull is a (1 -
 * E[v]/(n + 1)), with v the corners of the hull of n + 1 points (Efron 1965). So (n - v) points
 * over the hull's area estimate the density almost without bias. The corners define the hull and
 * are excluded, as the k-th photon is from a disc.
 *
 * That is the density where the photons are, and not that of the point where it lies in the dark
 * outside of them. Their distances tell. Of photons that are even up to the point, inside of a
 * surface, at its edge or in a corner of any angle, a part d^2 / r^2 or more of the n within r lies
 * within d, so that
 *
 *   S = sum of -ln(d_i^2 / r^2)
 *
 * follows the gamma distribution of shape n, or is larger. In the dark the photons lie near the
 * rim, and S is small. (n/S is the estimate of half the dimension in Levina, Bickel 2004.) The cube
 * root of S/n is nearly normal, with mean 1 - 1/(9 n) and deviation 1/(3 sqrt n) (Wilson, Hilferty
 * 1931). From HULL_DARK deviations below the mean on, kernel epanechnikov over the disc is taken in
 * place of the hull, and both from one deviation less. More than HULL_SURE photons are no surer
 * than so many: the deviation of more would take a gradient of the light for darkness. The nearest
 * half of the photons within the next one, and the nearest quarter, are asked as well, for where a
 * few others lie far behind those that are near.
 *
 * References:
 *   Efron: "The convex hull of a random set of points", Biometrika 52, 1965.
 *   Levina, Bickel: "Maximum Likelihood Estimation of Intrinsic Dimension", NIPS 2004.
 *   Wilson, Hilferty: "The distribution of chi-square", Proceedings of the National Academy of
 *     Sciences 17, 1931.
 */
#ifndef RT_KERNELS_PHOTON_HULL_H
#define RT_KERNELS_PHOTON_HULL_H

#include "math/frame.h"
#include "photon/density.h"
#include "surface/gather_point.h"
#include "types.h"

#define HULL_SURE 50.0f
#define HULL_DARK 3.5f
#define HULL_SCALES 3u

/* The place of a photon in the tangent plane, relative to the gather point. */
static inline float2 in_plane(global const rt_photon *photon, float3 origin,
                              const struct frame *frame)
{
    const float3 away = row3(photon->position) - origin;
    return (float2)(dot(away, frame->s), dot(away, frame->t));
}

static inline float cross2(float2 a, float2 b)
{
    return a.x * b.y - a.y * b.x;
}

/*
 * Whether `candidate` rather than `best` is the next corner after `at`: farther to the right or, on
 * the same line, farther away.
 */
static inline bool is_next_corner(float2 at, float2 candidate, float2 best)
{
    const float2 to_candidate = candidate - at, to_best = best - at;
    const float turn = cross2(to_best, to_candidate);
    return turn < 0.0f || (turn == 0.0f && dot(to_candidate, to_candidate) > dot(to_best, to_best));
}

/*
 * The sum of the photons inside the hull over its area, by gift wrapping (Jarvis, "On the
 * identification of the convex hull of a finite set of points in the plane", Information Processing
 * Letters 2, 1973). all: the sum of `count` photons, three or more.
 */
static inline float3 sum_inside_hull(float3 origin, const struct bsdf *bsdf,
                                     global const rt_photon *photons, global const uint *list,
                                     uint count, float3 all)
{
    const struct frame frame = frame_about(bsdf->normal);
    float3 inside = all;
    float twice_area = 0.0f;
    uint lowest = 0u;
    float2 low = in_plane(photons + list[0], origin, &frame);
    for (uint i = 1u; i < count; i++) {
        const float2 place = in_plane(photons + list[i], origin, &frame);
        if (place.y < low.y || (place.y == low.y && place.x < low.x)) {
            lowest = i;
            low = place;
        }
    }
    uint corner = lowest;
    float2 at = low;
    for (uint corners = 0u; corners < count; corners++) {
        uint next = corner == 0u ? 1u : 0u;
        float2 best = in_plane(photons + list[next], origin, &frame);
        for (uint i = 0u; i < count; i++) {
            const float2 place = in_plane(photons + list[i], origin, &frame);
            if (i != corner && is_next_corner(at, place, best)) {
                next = i;
                best = place;
            }
        }
        inside -= photons[list[corner]].shading * photon_term(bsdf, photons + list[corner]);
        twice_area += cross2(at, best);
        corner = next;
        at = best;
        if (corner == lowest)
            break;
    }
    return twice_area > 0.0f ? max(inside, 0.0f) * (2.0f / twice_area) : (float3)(0.0f);
}

static inline float squared_distance(global const rt_photon *photon, float3 origin)
{
    const float3 away = row3(photon->position) - origin;
    return dot(away, away);
}

/* How much the hull counts beside the disc, by the n nearest photons, those within a radius. */
static inline float weight_within(float r2, float3 origin, global const rt_photon *photons,
                                  global const uint *list, uint n)
{
    const float sure = fmin((float)n, HULL_SURE);
    float s = 0.0f;
    for (uint i = 0u; i < n; i++)
        s -= log(fmax(squared_distance(photons + list[i], origin) / r2, FLT_MIN));
    const float below = 3.0f * sqrt(sure) * (1.0f - 1.0f / (9.0f * sure) - cbrt(s / (float)n));
    return clamp(HULL_DARK - below, 0.0f, 1.0f);
}

/* The least of all scales; two photons have no hull. */
static inline float hull_weight(float3 origin, global const rt_photon *photons,
                                global const uint *list, rt_gather_disc disc)
{
    float weight = disc.count < 3u ? 0.0f : 1.0f, r2 = disc.squared_radius;
    uint n = disc.count;
    for (uint scale = 0u; scale < HULL_SCALES && n >= 3u; scale++) {
        weight = fmin(weight, weight_within(r2, origin, photons, list, n));
        n /= 2u;
        r2 = squared_distance(photons + list[n], origin);
    }
    return weight;
}

/*
 * The density sum of photons, nearest first, by their hull, by the disc, or by both. In the dark
 * kernel epanechnikov lets through least: it is 0 at the rim, where the photons lie.
 */
static inline float3 hull_sum(float3 origin, const struct bsdf *bsdf,
                              global const rt_photon *photons, global const uint *list,
                              rt_gather_disc disc)
{
    const float weight = hull_weight(origin, photons, list, disc);
    float3 all = (float3)(0.0f), over_disc = (float3)(0.0f);
    for (uint i = 0u; i < disc.count; i++) {
        global const rt_photon *photon = photons + list[i];
        const float3 term = photon->shading * photon_term(bsdf, photon);
        all += term;
        over_disc += density_kernel(RT_DENSITY_EPANECHNIKOV, 1.0f, squared_distance(photon, origin),
                                    disc.squared_radius) *
                     term;
    }
    return weight > 0.0f ? weight * sum_inside_hull(origin, bsdf, photons, list, disc.count, all) +
                               (1.0f - weight) * over_disc
                         : over_disc;
}

#endif
