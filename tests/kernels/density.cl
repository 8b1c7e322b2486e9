/* density.cl - evaluates density_kernel at given squared distances. */
#include "photon/density.h"

kernel void evaluate(uint count, uint density, float cone_k, float r2, global const float *d2,
                     global float *out)
{
    const uint i = (uint)get_global_id(0);
    if (i < count)
        out[i] = density_kernel(density, cone_k, d2[i], r2);
}
