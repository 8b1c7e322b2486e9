/* rng.cl - sets of samplers, for their test. */
#include "entry.h"
#include "sample/rng_lanes.h"

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

/*
 * Eight samplers an item, of streams, samples and sets of their own: their sets in lanes, then one
 * by one.
 */
kernel void lanes(const rt_params params, global const rt_scene_header *header, uint count,
                  global float4 *out)
{
    const uint item = item_number();
    if (item >= count)
        return;
    const struct scene scene = scene_open(header);
    struct sampler samplers[8];
    uint4 keys[8];
    for (uint i = 0u; i < 8u; i++) {
        samplers[i] = sampler_start(&scene, &params, 8u * item + i, 0u);
        samplers[i] = sampler_of_sample(&samplers[i], 5u * i + (item << i));
        keys[i] = samplers[i].key;
    }
    const uint8 set = (uint8)(0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u) * (item + 1u);
    const struct words_x8 key = words_of(keys);
    float8 rows[4];
    sampler_sets(rows, samplers[0].sobol, &key, LANES_OF(uint8, samplers, .index), set);
    for (uint i = 0u; i < 8u; i++) {
        out[16u * item + i] = set_of_lane(rows, i);
        out[16u * item + 8u + i] = sampler_set(&samplers[i], i * (item + 1u));
    }
}
