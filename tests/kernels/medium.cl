/* medium.cl - boundaries crossed and light absorbed, for their test. */
#include "entry.h"
#include "material/medium.h"

/*
 * Crosses boundaries in turn: in: material and 1 for entering; out: eta, exists, and the medium
 * after.
 */
kernel void cross_boundaries(global const rt_scene_header *header, uint count,
                             global const uint2 *in, global float4 *out)
{
    if (item_number() != 0)
        return;
    const struct scene scene = scene_open(header);
    uint4 media = RT_VACUUM;
    for (uint i = 0; i < count; i++) {
        const struct boundary boundary = media_cross(&scene, media, in[i].x, in[i].y != 0u);
        media = boundary.beyond;
        out[i] = (float4)(boundary.eta, boundary.exists ? 1.0f : 0.0f,
                          media.x == RT_NONE ? -1.0f : (float)media.x, 0.0f);
    }
}

/* What is left of light after each distance in material 0. */
kernel void transmit(global const rt_scene_header *header, uint count, global const float *distance,
                     global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    out[i] = (float4)(medium_transmittance(scene.materials, 0u, distance[i]), 0.0f);
}
