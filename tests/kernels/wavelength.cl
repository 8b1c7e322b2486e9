/* wavelength.cl - wavelengths drawn, and indices at wavelengths, for their test. */
#define RT_DISPERSION
#include "entry.h"
#include "surface/dispersion.h"

/* The weights of an even grid of `count` numbers, for a path of this throughput; w: wavelength. */
kernel void draw_wavelengths(uint count, float4 beta, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct wavelength drawn = sample_wavelength(beta.xyz, ((float)i + 0.5f) / (float)count);
    out[i] = (float4)(drawn.weight, drawn.length);
}

/* The index of material i at wavelength i. */
kernel void index_at(global const rt_scene_header *header, uint count, global const float *lengths,
                     global float *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    out[i] = ior_at(&scene, i, lengths[i]);
}
