/* density.cl - evaluates density_kernel at given squared distances. */
#include "entry.h"
#include "photon/density.h"

kernel void evaluate(uint count, uint density, float cone_k, float r2, global const float *d2,
                     global float *out)
{
    const uint i = item_number();
    if (i < count)
        out[i] = density_kernel(density, cone_k, d2[i], r2);
}
