/*
 * gather_neighbours.cl - the neighbour-list gather: each work-item adds to the radiance of a gather
 * point what the point's lobe scatters of the photons that the host found around it.
 */
#include "entry.h"
#include "photon/density.h"
#include "surface/gather_point.h"
#include "photon/hull.h"

/* The sum over a disc, each photon weighted by the density kernel. */
static inline float3 disc_sum(const rt_density_params *estimate, float3 position,
                              const struct bsdf *bsdf, global const rt_photon *photons,
                              global const uint *list, rt_gather_disc disc)
{
    float3 sum = (float3)(0.0f);
    for (uint i = 0; i < disc.count; i++) {
        global const rt_photon *photon = photons + list[i];
        const float3 away = row3(photon->position) - position;
        const float k = density_kernel(estimate->density, estimate->cone_k, dot(away, away),
                                       disc.squared_radius);
        sum += (k * photon->shading) * photon_term(bsdf, photon);
    }
    return sum;
}

/*
 * points: those from params.first_item on; lists: rows of estimate.stride photon
 * indices, one a point, nearest first, which also is the order of summing. header: of the scene,
 * not read where no point has a rough lobe.
 */
KERNEL gather_neighbours(const rt_params params, const rt_density_params estimate,
                         global rt_gather_point *points, global const rt_gather_disc *discs,
                         global const uint *lists, global const rt_photon *photons,
                         global const rt_scene_header *header)
{
    const uint item = item_number();
    if (item >= params.item_count || discs[item].count == 0u)
        return;
    global const uint *list = lists + (size_t)item * estimate.stride;
    const rt_gather_disc disc = discs[item];
    points += params.first_item + item;
    const float3 position = row3(points->position);
    const struct bsdf bsdf = bsdf_of_point(points, header);
    float3 sum;

    if (estimate.area == RT_AREA_HULL)
        sum = hull_sum(position, &bsdf, photons, list, disc);
    else
        sum = disc_sum(&estimate, position, &bsdf, photons, list, disc);
    add_scattered(points, estimate.scale * sum);
}
