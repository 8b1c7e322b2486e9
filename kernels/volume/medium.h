/*
 * medium.h - media that absorb and scatter: their coefficients and, of homogeneous ones, the
 * transmittance and distances sampled by it. Those whose density lies on a grid are in grid.h.
 *
 * Along a ray, the extinction sigma_t = sigma_a + sigma_s differs from channel to channel. A
 * distance is sampled by the transmittance of one channel, chosen in proportion to the path's
 * throughput, and weighted by the balance heuristic over the channels (Veach 1997, section
 * 9.2.2.1): divided by the mean of their densities.
 *
 * References:
 *   Veach: "Robust Monte Carlo Methods for Light Transport Simulation", PhD thesis, 1997.
 */
#ifndef RT_KERNELS_VOLUME_MEDIUM_H
#define RT_KERNELS_VOLUME_MEDIUM_H

#include "math/frame.h"
#include "scene.h"
#include "types.h"

/* What fills the space that a path runs in. */
struct medium {
    float3 scattering; /* sigma_s, 1/m */
    float3 extinction; /* sigma_t = sigma_a + sigma_s, 1/m */
    float g;           /* mean cosine of scattering */
    uint grid;         /* 1 + index of its density; 0: homogeneous, its density is 1 */
    uint albedo;       /* 1 + index of the grid of what part of sigma_s scatters; 0: all */
    bool is_coloured;  /* its density has three channels */
};

/* The medium of a list's first material; RT_NONE: that outside of all solids. */
static inline struct medium medium_of(const struct scene *scene, uint material)
{
    global const rt_medium_data *data =
        scene->media + (material == RT_NONE ? scene->header->material_count : material);
    struct medium medium;
    medium.scattering = row3(data->scattering);
    medium.extinction = row3(data->absorption) + medium.scattering;
    medium.g = data->g;
    medium.grid = data->grid;
    medium.albedo = data->albedo;
    medium.is_coloured = data->is_coloured != 0u;
    return medium;
}

static inline bool medium_scatters(const struct medium *medium)
{
    return largest3(medium->scattering) > 0.0f;
}

/* The Beer-Lambert law over a distance in metres, which may be infinite. */
static inline float3 transmittance(const struct medium *medium, float distance)
{
    return exp(-medium->extinction * fmin(distance, FLT_MAX));
}

/* The probabilities of the channels for a path of this throughput, one of them above 0. */
static inline float3 channel_pmf(float3 beta)
{
    return beta * (1.0f / (beta.x + beta.y + beta.z));
}

/* A distance by the transmittance of the channel that u.y chooses; infinite: none. */
static inline float sample_distance(const struct medium *medium, float3 pmf, float2 u)
{
    const float3 sigma = medium->extinction;
    const float chosen = u.y < pmf.x ? sigma.x : u.y < pmf.x + pmf.y ? sigma.y : sigma.z;
    return chosen > 0.0f ? -log(1.0f - u.x) / chosen : INFINITY;
}

/* The density of that distance, 1/m. */
static inline float distance_pdf(const struct medium *medium, float3 pmf, float distance)
{
    return dot(pmf, medium->extinction * transmittance(medium, distance));
}

/* The probability that the distance is greater. */
static inline float passing_probability(const struct medium *medium, float3 pmf, float distance)
{
    return dot(pmf, transmittance(medium, distance));
}

#endif
