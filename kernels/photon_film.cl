/* photon_film.cl - adds gather points to the film, each as one sample of its pixel. */
#include "entry.h"
#include "camera/film.h"
#include "math/frame.h"

/*
 * The radiance of a gather point; NaN where its position is not finite, as no photons were gathered
 * there.
 */
static float3 radiance_of(global const rt_gather_point *point)
{
    return all(isfinite(row3(point->position))) ? row3(point->radiance) : (float3)(NAN);
}

/*
 * points: [item_count], no two of the same pixel; caustics: [params.final_gather][stride], points
 * whose radiance belongs to the same sample.
 */
KERNEL photon_film(const rt_params params, global const rt_gather_point *points,
                   global const rt_gather_point *caustics, uint stride, global rt_film_pixel *film)
{
    const uint item = (uint)get_global_id(0);
    if (item >= params.item_count)
        return;
    const uint index = points[item].pixel;
    float3 radiance = radiance_of(points + item);
    for (uint i = 0u; i < params.final_gather; i++)
        radiance += radiance_of(caustics + i * stride + item);
    global rt_film_pixel *const plane = film_plane(film, &params);
    rt_film_pixel pixel = plane[index];
    film_add(&pixel, radiance, points[item].film_weight, points[item].cut_off);
    plane[index] = pixel;
}
