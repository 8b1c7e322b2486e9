/*
 * gather_neighbours.cl - the neighbour-list gather: each work-item adds to the radiance of a gather
 * point what the point's lobe scatters of the photons that the host found around it.
 */
#include "photon/density.h"
#include "entry.h"
#include "photon/hull.h"
#include "photon/reflect.h"

static inline float3 disc_density(const rt_density_params *estimate, float3 position,
                                  global const rt_photon *photons, global const uint *list,
                                  rt_gather_disc disc)
{
    float3 flux_density = (float3)(0.0f);
    for (uint i = 0; i < disc.count; i++) {
        global const rt_photon *photon = photons + list[i];
        const float3 away = row3(photon->position) - position;
        const float k = density_kernel(estimate->density, estimate->cone_k, dot(away, away),
                                       disc.squared_radius);
        flux_density += (k * photon->shading) * row3(photon->flux);
    }
    return flux_density;
}

/*
 * points: those from params.first_item on; lists: rows of estimate.stride photon
 * indices, one a point, nearest first, which also is the order of summing.
 */
KERNEL gather_neighbours(const rt_params params, const rt_density_params estimate,
                         global rt_gather_point *points, global const rt_gather_disc *discs,
                         global const uint *lists, global const rt_photon *photons)
{
    const uint item = (uint)get_global_id(0);
    if (item >= params.item_count || discs[item].count == 0u)
        return;
    global const uint *list = lists + (size_t)item * estimate.stride;
    const rt_gather_disc disc = discs[item];
    points += params.first_item + item;
    const float3 position = row3(points->position);
    float3 flux_density;

    if (estimate.area == RT_AREA_HULL)
        flux_density = hull_density(points, photons, list, disc.count);
    else
        flux_density = disc_density(&estimate, position, photons, list, disc);
    add_reflected(points, estimate.scale * flux_density);
}
