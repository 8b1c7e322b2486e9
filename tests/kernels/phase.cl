/* phase.cl - directions sampled by the phase function, for their test. */
#include "entry.h"
#include "sample/rng.h"
#include "volume/phase.h"

/* out: the cosine of the angle, the azimuth in turns, and the density. */
kernel void scatter(uint seed, uint count, float g, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const float3 direction = unit((float3)(0.3f, -0.5f, 0.8f));
    const struct frame frame = frame_about(direction);
    const float2 u = convert_float2(pcg4d((uint4)(i, seed, 17u, 5u)).xy >> 8) * 0x1p-24f;
    const float3 wi = phase_sample(g, direction, u);
    out[i] =
        (float4)(dot(wi, direction), atan2(dot(wi, frame.t), dot(wi, frame.s)) / (2.0f * RT_PI),
                 phase_pdf_w(g, direction, wi), dot(wi, wi));
}
