/*
 * photon_gather.cl - the density sum: each work-item turns the photons around one gather point
 * into reflected radiance and adds the sample to its pixel.
 *
 *   L(x, wo) = sum over the photons p in the disc of fr(x, wo, w_p) flux_p K(|x - x_p|)
 *
 * with fr = kd/pi, of which the point's weight has kd; each flux_p carries the division by the number of
 * emitted paths. Photons are as dense as the geometric surface makes them, while reflection goes by the
 * shading normal: photon.shading is the ratio of the two cosines (Veach 1997, section 5.3).
 */
#include "density.h"
#include "film.h"
#include "scene.h"

/*
 * discs: [item_count]; lists: rows of estimate.stride photon indices, one a point, nearest first, which
 * also is the order of summing. No two points of a launch may be of the same pixel.
 */
kernel void photon_gather(const rt_params params, global const rt_scene_header *header,
                          const rt_density_params estimate, global const rt_gather_point *points,
                          global const rt_gather_disc *discs, global const uint *lists, global const rt_photon *photons,
                          global rt_film_pixel *film)
{
    const uint item = (uint)get_global_id(0);
    if (item >= params.item_count)
        return;
    global const rt_gather_point *point = points + item;
    global const uint *list = lists + (size_t)item * estimate.stride;
    const rt_gather_disc disc = discs[item];
    float3 radiance = row3(point->radiance);

    if (disc.count > 0u) {
        float3 flux_density = (float3)(0.0f);
        for (uint i = 0; i < disc.count; i++) {
            global const rt_photon *photon = photons + list[i];
            const float3 away = row3(photon->position) - row3(point->position);
            const float k = density_kernel(estimate.density, estimate.cone_k, dot(away, away), disc.squared_radius);
            flux_density += (k * photon->shading) * row3(photon->flux);
        }
        radiance += row3(point->weight) * flux_density / RT_PI;
    }
    rt_film_pixel pixel = film[point->pixel];
    film_add(&pixel, radiance, point->film_weight);
    film[point->pixel] = pixel;
}
