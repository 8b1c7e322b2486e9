/* film.cl - the pixel of each work-item, and samples added to one, for their tests. */
#include "entry.h"
#include "camera/film.h"

kernel void pixels(const rt_params params, global uint *out)
{
    const uint i = item_number();
    if (i >= params.item_count)
        return;
    const uint2 at = pixel_of_item(&params, i);
    out[i] = at.y * params.width + at.x;
}

/* Adds `count` samples to one pixel, in order. */
kernel void add(global const float *red, uint count, global rt_film_pixel *film)
{
    if (item_number() != 0)
        return;
    rt_film_pixel pixel = film[0];
    for (uint i = 0; i < count; i++)
        film_add(&pixel, (float3)(red[i], 1.0f, 1.0f), 1.0f, 0.0f);
    film[0] = pixel;
}
