/* filter.cl - samples of reconstruction filters and pixels of splats, for their test. */
#include "entry.h"
#include "camera/splat.h"
#include "sample/rng.h"

/* One row an item: the point in pixels from the pixel's corner, and its weight. */
kernel void sample(uint filter, float radius, uint seed, uint count, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const float4 u = convert_float4(pcg4d((uint4)(i, seed, 31u, 4u)) >> 8) * 0x1p-24f;
    float weight;
    const float2 place = sample_filter(filter, radius, u.xy, &weight);
    out[i] = (float4)(place, weight, 0.0f);
}

/*
 * The pixel of a point of the film for side x side pairs of numbers, evenly spread, and what it
 * gets, or 0; one an item.
 */
kernel void splat(global const rt_camera_data *camera, uint width, uint height, float x, float y,
                  uint side, global float2 *out)
{
    const uint i = item_number();
    if (i >= side * side)
        return;
    const float2 u = ((float2)(i % side, i / side) + 0.5f) / (float)side;
    uint pixel = 0u;
    const float value =
        splat_pixel(camera, (int2)((int)width, (int)height), (float2)(x, y), u, &pixel);
    out[i] = (float2)((float)pixel, value);
}
