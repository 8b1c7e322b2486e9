/*
 * hull.h - photon density by the convex hull of the photons, in the tangent plane of a point.
 *
 * A disc that reaches over the edge of a surface covers area where no photon can lie, and half of
 * the light or more is lost there (boundary bias). The hull of the photons stays on the surface.
 * For n uniform points in a convex region of area a, the expected area of the hull is a (1 -
 * E[v]/(n + 1)), with v the corners of the hull of n + 1 points (Efron, "The convex hull of a
 * random set of points", Biometrika 52, 1965). So (n - v) points over the hull's area estimate the
 * density almost without bias. The corners define the hull and are excluded, as the k-th photon is
 * from a disc.
 */
#ifndef RT_KERNELS_PHOTON_HULL_H
#define RT_KERNELS_PHOTON_HULL_H

#include "math/frame.h"
#include "photon/gather_point.h"
#include "types.h"

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
 * Letters 2, 1973).
 */
static inline float3 hull_sum(float3 origin, const struct bsdf *bsdf,
                              global const rt_photon *photons, global const uint *list, uint count)
{
    const struct frame frame = frame_about(bsdf->normal);
    float3 inside = (float3)(0.0f);
    if (count <= 3u)
        return inside; /* all are corners */
    float twice_area = 0.0f;
    uint lowest = 0u;
    float2 low = in_plane(photons + list[0], origin, &frame);
    for (uint i = 0u; i < count; i++) {
        const float2 place = in_plane(photons + list[i], origin, &frame);
        inside += photons[list[i]].shading * photon_term(bsdf, photons + list[i]);
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

#endif
