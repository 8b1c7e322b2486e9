/* filter.cl - samples of reconstruction filters, for their test. */
#include "camera/filter.h"
#include "sample/rng.h"

/* One row an item: the point in pixels from the pixel's corner, and its weight. */
kernel void sample(uint filter, float radius, uint seed, uint count, global float4 *out)
{
    const uint i = (uint)get_global_id(0);
    if (i >= count)
        return;
    const float4 u = convert_float4(pcg4d((uint4)(i, seed, 31u, 4u)) >> 8) * 0x1p-24f;
    float weight;
    const float2 place = sample_filter(filter, radius, u.xy, &weight);
    out[i] = (float4)(place, weight, 0.0f);
}
