/*
 * leave.cl - traces rays that leave the surfaces hit by others, for the test of self-intersection.
 */
#include "entry.h"
#include "accel/traverse.h"

/*
 * Follows each ray to its nearest hit, leaves that surface towards away[i].xyz and writes how far
 * the next hit is: infinity for none, -1 where the first ray missed.
 */
kernel void leave(global const rt_scene_header *header, global const rt_ray *rays,
                  global const float4 *away, uint count, global float *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    const struct ray first = make_ray(vload3(0, rays[i].origin), vload3(0, rays[i].direction),
                                      rays[i].t_min, rays[i].t_max);
    struct hit hit;
    if (!closest_hit(&scene, &first, &hit)) {
        out[i] = -1.0f;
        return;
    }
    struct surface surface;
    surface_at(&surface, &scene, &first, &hit);
    const float3 w = away[i].xyz;
    const struct ray second = make_ray(leave_surface(&surface, w), w, 0.0f, INFINITY);
    out[i] = closest_hit(&scene, &second, &hit) ? hit.t : INFINITY;
}
