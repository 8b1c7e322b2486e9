/* rng.cl - sets of samplers, for their test. */
#include "entry.h"
#include "sample/rng.h"

kernel void sets(const rt_params params, global const rt_scene_header *header, uint stream,
                 uint set, uint count, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    const struct sampler sampler = sampler_start(&scene, &params, stream, params.first_sample + i);
    out[i] = sampler_set(&sampler, set);
}

/* Two sets an item, `set` and the next: of sample i of stream 7, or of sample 7 of stream i. */
kernel void pairs(const rt_params params, global const rt_scene_header *header, uint along,
                  uint set, uint count, global float8 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    const struct sampler sampler = sampler_start(&scene, &params, along ? 7u : i, along ? i : 7u);
    out[i] = sampler_pair(&sampler, set);
}
