/*
 * beam.h - the light that a medium scatters towards the eye along a ray, from volume photons.
 *
 * The beam radiance estimate (Jarosz, Zwicker, Jensen 2008, equation 16): photon p has a disc of
 * radius r_p that faces the ray; the ray gathers all photons whose discs it crosses, at t_p,
 *
 *   L = sigma_s sum over p of K(d_p, r_p) T(t_p) p(w_p, wo) flux_p
 *
 * with d_p the photon's distance from the ray, K the density kernel of discs, and flux_p in W m as
 * rt_photon says, over the number of emitted paths. The radius is a photon's own, so K integrates
 * to 1 for each, and the estimate errs by the blur over the discs alone.
 *
 * For comparison, the point estimate takes one point on the ray, sampled by the transmittance, and
 * the photons whose spheres hold it, each with flux_p / (4/3 pi r_p^3) (Jensen and Christensen
 * 1998).
 *
 * Photons count in the medium that they lie in alone: a disc that reaches through a boundary is not
 * cut, and darkens or brightens the medium within a radius of it.
 *
 * Where the density lies on a grid: grid_beam.h. Where the albedo does, or the density has three
 * channels, sigma_s is that at the photon.
 *
 * References:
 *   Jarosz, Zwicker, Jensen: "The Beam Radiance Estimate for Volumetric Photon Mapping",
 *     Eurographics 2008.
 *   Jensen, Christensen: "Efficient Simulation of Light Transport in Scenes with Participating
 *     Media using Photon Maps", SIGGRAPH 1998.
 */
#ifndef RT_KERNELS_PHOTON_BEAM_H
#define RT_KERNELS_PHOTON_BEAM_H

#include "photon/density.h"
#include "photon/sum.h"
#include "photon/tree.h"
#include "volume/march.h"
#include "volume/segment.h"

/* The volume photons of a scene, and how they are gathered. */
struct volume_map {
    struct photon_tree tree; /* of boxes around the photons' spheres */
    rt_volume_params params;
};

/* A part of a ray, or where it is a point: of length 0. */
struct beam {
    float3 origin, direction, inverse;
    float length;
    float medium;          /* as RT_VOLUME_MEDIUM */
    const struct run *run; /* the part of it that gathers, in a grid; NULL: all of it */
};

static inline struct beam make_beam(float3 origin, float3 direction, float length, uint material)
{
    struct beam beam;
    /* finite, so that no box is met by a product of 0 and infinity */
    const float3 size = fmax(fabs(direction), (float3)(1e-20f));
    beam.origin = origin;
    beam.direction = direction;
    beam.inverse = copysign(1.0f / size, direction);
    beam.length = length;
    beam.medium = (float)(material + 1u);
    beam.run = 0;
    return beam;
}

/* Narrows the intervals in which the beam is between the two sides of eight boxes. */
INLINE_ALWAYS void clip_beam8(float8 *from, float8 *to, global const rt_photon_node *node,
                              const uint axis, float origin, float inverse)
{
    const uint near = inverse < 0.0f ? axis + 3u : axis, far = inverse < 0.0f ? axis : axis + 3u;
    *from = fmax(*from, (vload8(0, node->bounds[near]) - origin) * inverse);
    *to = fmin(*to, (vload8(0, node->bounds[far]) - origin) * inverse);
}

/* A bit for each of the eight boxes that the beam meets. */
INLINE_ALWAYS uint boxes_met(global const rt_photon_node *node, const struct beam *beam)
{
    const bool in_run = KNOWS_GRIDS && beam->run;
    float8 from = (float8)(in_run ? beam->run->from : 0.0f);
    float8 to = (float8)(in_run ? fmin(beam->run->to, beam->length) : beam->length);
    clip_beam8(&from, &to, node, 0u, beam->origin.x, beam->inverse.x);
    clip_beam8(&from, &to, node, 1u, beam->origin.y, beam->inverse.y);
    clip_beam8(&from, &to, node, 2u, beam->origin.z, beam->inverse.z);
    return lane_mask(from <= to);
}

/* The phase function of eight photons that came from wi, towards -direction: see phase.h. */
INLINE_ALWAYS float8 phase8(float g, float3 direction, global const rt_photon_block *block)
{
    const float8 along = vload8(0, block->wi[0]) * direction.x +
                         vload8(0, block->wi[1]) * direction.y +
                         vload8(0, block->wi[2]) * direction.z;
    const float8 cosine = g < 0.0f ? -along : along;
    const float a = fabs(g);
    const float8 d = square(1.0f - a) + 2.0f * a * fmax(1.0f - cosine, (float8)(0.0f));
    return (1.0f - a * a) / (4.0f * RT_PI * d * sqrt(d));
}

/* Red, green and blue of eight photons. */
struct light8 {
    float8 red, green, blue;
};

/* Multiplies the flux of those of eight photons whose bits are set by what sigma_s has there. */
static inline void colour_photons8(struct light8 *flux, const struct scene *scene,
                                   const struct medium *medium, global const rt_photon_block *block,
                                   uint mask)
{
    float tint[3][8];
    for (uint lane = 0u; lane < 8u; lane++)
        tint[0][lane] = tint[1][lane] = tint[2][lane] = 0.0f;
    for (; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        const float3 p =
            (float3)(block->position[0][lane], block->position[1][lane], block->position[2][lane]);
        const float3 at = density_colour(scene, medium, p) * albedo_at(scene, medium, p);
        tint[0][lane] = at.x;
        tint[1][lane] = at.y;
        tint[2][lane] = at.z;
    }
    flux->red *= vload8(0, tint[0]);
    flux->green *= vload8(0, tint[1]);
    flux->blue *= vload8(0, tint[2]);
}

/*
 * Adds the photons of a block: those that the beam crosses the discs of, attenuated over the
 * distance from its origin; or where it is a point, those whose spheres hold it.
 */
INLINE_ALWAYS void add_photons8(struct light8 *sum, const struct volume_map *map,
                                const struct scene *scene, const struct medium *medium,
                                const struct beam *beam, global const rt_photon_block *block)
{
    const float8 x = vload8(0, block->position[0]) - beam->origin.x,
                 y = vload8(0, block->position[1]) - beam->origin.y,
                 z = vload8(0, block->position[2]) - beam->origin.z;
    const float8 radius = vload8(0, block->normal[RT_VOLUME_RADIUS]), r2 = radius * radius;
    const bool is_point = map->params.estimate == RT_VOLUME_POINT;
    const float8 t = is_point
                         ? (float8)(0.0f)
                         : x * beam->direction.x + y * beam->direction.y + z * beam->direction.z;
    const float8 dx = x - t * beam->direction.x, dy = y - t * beam->direction.y,
                 dz = z - t * beam->direction.z;
    const float8 d2 = dx * dx + dy * dy + dz * dz;
    int8 counts = d2 < r2 && t >= 0.0f && t <= beam->length &&
                  vload8(0, block->normal[RT_VOLUME_MEDIUM]) == beam->medium;
    if (KNOWS_GRIDS && beam->run)
        counts = counts && t >= beam->run->from && t < beam->run->to;
    if (lane_mask(counts) == 0u)
        return;
    const float8 density =
        is_point
            ? 3.0f / (4.0f * RT_PI * r2 * radius)
            : density_profile8(map->params.density, map->params.cone_k, d2 / r2) / (RT_PI * r2);
    const float8 weight = density * phase8(medium->g, beam->direction, block);
    const float3 sigma = medium->extinction;
    const float8 zero = (float8)(0.0f);
    const float8 depth = KNOWS_GRIDS && beam->run ? run_depth8(beam->run, t, lane_mask(counts)) : t;
    struct light8 flux;
    flux.red = vload8(0, block->flux[0]);
    flux.green = vload8(0, block->flux[1]);
    flux.blue = vload8(0, block->flux[2]);
    if (has_albedo(medium) || is_coloured(medium))
        colour_photons8(&flux, scene, medium, block, lane_mask(counts));
    sum->red += select(zero, weight * exp(-sigma.x * depth) * flux.red, counts);
    sum->green += select(zero, weight * exp(-sigma.y * depth) * flux.green, counts);
    sum->blue += select(zero, weight * exp(-sigma.z * depth) * flux.blue, counts);
}

/* The sum over all photons that the beam meets. The order of summing is that of the tree. */
INLINE_NEVER float3 sum_beam(const struct volume_map *map, const struct scene *scene,
                             const struct medium *medium, const struct beam *beam)
{
    const struct photon_tree *tree = &map->tree;
    uint stack[RT_PHOTON_STACK];
    uint entries = 0u;
    struct light8 sum;
    sum.red = sum.green = sum.blue = (float8)(0.0f);
    if (tree->shape.levels > 0u)
        stack[entries++] = (tree->shape.levels - 1u) << ENTRY_LEVEL_SHIFT;
    while (entries > 0u) {
        const uint entry = stack[--entries];
        const uint level = entry >> ENTRY_LEVEL_SHIFT, index = entry & ENTRY_INDEX;
        uint met = boxes_met(tree->nodes + tree->shape.first_node[level] + index, beam);
        for (; met; met &= met - 1u) {
            const uint child = 8u * index + lane_first(met);
            if (level == 0u)
                add_photons8(&sum, map, scene, medium, beam, tree->blocks + child);
            else
                stack[entries++] = ((level - 1u) << ENTRY_LEVEL_SHIFT) | child;
        }
    }
    return (float3)(sum_lanes(sum.red), sum_lanes(sum.green), sum_lanes(sum.blue));
}

/*
 * The radiance that volume photons send along a segment in the medium of this material to its
 * origin. u: numbers of the point, where that is sampled.
 */
static inline float3 volume_radiance(const struct volume_map *map, const struct scene *scene,
                                     const struct medium *medium, uint material,
                                     const struct segment *segment, float2 u)
{
    const float3 scale = medium->scattering * map->params.scale;
    if (map->params.estimate != RT_VOLUME_POINT) {
        const struct beam beam =
            make_beam(segment->origin, segment->direction, segment->length, material);
        return scale * sum_beam(map, scene, medium, &beam);
    }
    const float distance = sample_distance(medium, segment->pmf, u);
    if (!(distance < segment->length))
        return (float3)(0.0f);
    const struct beam point = make_beam(segment->origin + distance * segment->direction,
                                        segment->direction, 0.0f, material);
    return scale * transmittance(medium, distance) *
           (1.0f / distance_pdf(medium, segment->pmf, distance)) *
           sum_beam(map, scene, medium, &point);
}

#endif
