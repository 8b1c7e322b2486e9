/* vcm_film.cl - what light paths add to the film of a pass, and pixels without camera paths. */
#include "entry.h"
#include "camera/film.h"

/*
 * Adds the list of each pixel to the sums of its samples, which are exact: the order of the list
 * does not matter. The lists are empty then. Splats are no samples, and the number of those does
 * not grow.
 */
KERNEL vcm_splat(uint pixels, global const rt_splat *splats, global uint *heads,
                 global rt_film_pixel *film)
{
    const uint item = item_number();
    if (item >= pixels || heads[item] == 0u)
        return;
    rt_film_pixel pixel = film[item];
    const film_sums sums = film_sums_of(&pixel);
    for (uint next = heads[item]; next > 0u; next = splats[next - 1u].next) {
        const float3 radiance = vload3(0, splats[next - 1u].radiance);
        if (!all(isfinite(radiance))) {
            film_reject(&pixel, 1u);
            continue;
        }
        film_add_bits(sums, 0, as_uint(radiance.x));
        film_add_bits(sums, 1, as_uint(radiance.y));
        film_add_bits(sums, 2, as_uint(radiance.z));
    }
    film[item] = pixel;
    heads[item] = 0u;
}

/* The samples of an iteration in which camera paths find no light: black, and of weight 1. */
KERNEL vcm_black(uint pixels, global rt_film_pixel *film)
{
    const uint item = item_number();
    if (item >= pixels)
        return;
    rt_film_pixel pixel = film[item];
    film_add(&pixel, (float3)(0.0f), 1.0f, 0.0f);
    film[item] = pixel;
}
