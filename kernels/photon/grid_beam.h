/*
 * grid_beam.h - the light that a medium scatters towards the eye along a ray, as beam.h, where its
 * density lies on a grid.
 *
 * sigma_s is that at the photon: the tree has its flux times the density there. T(t_p) comes from a
 * march through the cells (volume/march.h): photons come in the order of the tree, so the ray is
 * cut into runs, each of which gathers those whose t_p it has.
 *
 * The point of the point estimate is one of the collisions with the majorant mu. By ratio tracking
 * (volume/grid.h), the sum of w / mu at all of them, w from before each, estimates the integral of
 * T along the ray without bias, and with a factor at each that of T times this factor. One is
 * picked in proportion to its part (Chao 1982), and weighted by the inverse.
 *
 * References:
 *   Chao: "A General Purpose Unequal Probability Sampling Plan", Biometrika 69(3), 1982.
 */
#ifndef RT_KERNELS_PHOTON_GRID_BEAM_H
#define RT_KERNELS_PHOTON_GRID_BEAM_H

#include "photon/beam.h"

/*
 * As sum_beam, of a beam in a grid; *passes is the transmittance to its end. Of a density of three
 * channels, both are those of this channel.
 */
INLINE_NEVER float3 sum_channel_beam(const struct volume_map *map, const struct scene *scene,
                                     const struct medium *medium, struct beam beam, uint channel,
                                     float3 *passes)
{
    struct march march;
    struct run run;
    float3 sum = (float3)(0.0f);
    bool more = true;
    march_begin(&march, scene, medium, beam.origin, beam.direction, beam.length, channel);
    run_begin(&run);
    beam.run = &run;
    *passes = (float3)(1.0f);
    while (more && largest3(*passes) > 0.0f) {
        more = next_run(&run, &march);
        sum += sum_beam(map, scene, medium, &beam);
        *passes = exp(-medium->extinction * run.depth);
    }
    return sum;
}

/* The same of all channels. */
static inline float3 sum_marched_beam(const struct volume_map *map, const struct scene *scene,
                                      const struct medium *medium, struct beam beam, float3 *passes)
{
    float3 sum = sum_channel_beam(map, scene, medium, beam, 0u, passes), of_channel;
    if (!is_coloured(medium))
        return sum;
    sum.y = sum_channel_beam(map, scene, medium, beam, 1u, &of_channel).y;
    passes->y = of_channel.y;
    sum.z = sum_channel_beam(map, scene, medium, beam, 2u, &of_channel).z;
    passes->z = of_channel.z;
    return sum;
}

/* A point on a ray through a grid: that of a collision, null ones included. */
struct tracked_point {
    float distance; /* m */
    float3 weight;  /* an estimate of the transmittance over the density of such points, m */
};

/* Picks one in proportion to its part of what ratio tracking sums up; false where there is none. */
static inline bool track_point(struct tracked_point *point, const struct scene *scene,
                               const struct medium *medium, const struct segment *segment,
                               const struct stream *stream)
{
    struct walk walk;
    float3 w = (float3)(1.0f);
    float total = 0.0f, picked = 0.0f;
    walk.stream = *stream;
    if (!walk_begin(&walk, scene, medium, segment->origin, segment->direction, segment->length))
        return false;
    while (next_collision(&walk)) {
        const float3 found = w * (1.0f / (walk.density * walk.majorant));
        const float part = dot(segment->pmf, found);
        total += part;
        if (stream_next(&walk.stream).x * total < part) {
            picked = part;
            point->distance = walked(&walk);
            point->weight = found;
        }
        float3 colour;
        const float density = density_here(&walk, medium, &colour);
        w *= 1.0f - real_collision(&walk, medium, density, colour);
        if (largest3(w) >= RT_TRACKING_ROULETTE)
            continue;
        if (!(largest3(w) > 0.0f) || walk.decision < 0.5f)
            break;
        w *= 2.0f;
    }
    if (picked > 0.0f)
        point->weight *= total * (1.0f / picked);
    return picked > 0.0f;
}

/*
 * As volume_radiance, of a medium whose density lies on a grid; *passes is the transmittance of the
 * segment.
 */
static inline float3 grid_radiance(const struct volume_map *map, const struct scene *scene,
                                   const struct medium *medium, uint material,
                                   const struct segment *segment, const struct stream *stream,
                                   float3 *passes)
{
    const float3 scale = medium->scattering * map->params.scale;
    if (map->params.estimate != RT_VOLUME_POINT)
        return scale * sum_marched_beam(map, scene, medium,
                                        make_beam(segment->origin, segment->direction,
                                                  segment->length, material),
                                        passes);
    struct tracked_point point;
    *passes =
        marched_transmittance(scene, medium, segment->origin, segment->direction, segment->length);
    if (!track_point(&point, scene, medium, segment, stream))
        return (float3)(0.0f);
    const struct beam beam = make_beam(segment->origin + point.distance * segment->direction,
                                       segment->direction, 0.0f, material);
    return scale * point.weight * sum_beam(map, scene, medium, &beam);
}

#endif
