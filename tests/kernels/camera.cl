/* camera.cl - camera rays for given film and lens points, for their test. */
#include "entry.h"
#include "camera/camera.h"

/* in: film x, y, lens x, y; out: two rows a ray, origin and direction. */
kernel void rays(global const rt_scene_header *header, uint count, global const float4 *in,
                 global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct ray ray = camera_ray(&header->camera, in[i].xy, in[i].zw);
    out[2u * i] = (float4)(ray.origin, ray.t_min);
    out[2u * i + 1u] = (float4)(ray.direction, ray.t_max);
}
