/* frame.h - orthonormal frames, and the small vector functions that kernels share. */
#ifndef RT_KERNELS_MATH_FRAME_H
#define RT_KERNELS_MATH_FRAME_H

#define RT_PI 3.14159265358979f

/*
 * Three floats of a shared struct, read without the number after them: as a float, an index would
 * be denormal, and arithmetic of four lanes with a denormal number takes a hundred cycles on many
 * CPUs, whether or not the lane is used.
 */
static inline float3 row3(global const float *row)
{
    return vload3(0, row);
}

static inline float square(float x)
{
    return x * x;
}

static inline float mean3(float3 v)
{
    return (v.x + v.y + v.z) * (1.0f / 3.0f);
}

static inline float largest3(float3 v)
{
    const float a = v.x > v.y ? v.x : v.y;
    return a > v.z ? a : v.z;
}

#include "math/width1.inc.h"
#include "math/frame.inc.h"

#endif
