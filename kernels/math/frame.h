/* frame.h - orthonormal frames, and the small vector functions that kernels share. */
#ifndef RT_KERNELS_MATH_FRAME_H
#define RT_KERNELS_MATH_FRAME_H

#define RT_PI 3.14159265358979f

/* The three floats that open a 16-byte row of a shared struct, read as one vector. */
static inline float3 row3(global const float *row)
{
    return ((global const float4 *)row)->xyz;
}

static inline float3 unit(float3 v)
{
    return v * (1.0f / sqrt(dot(v, v)));
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

/* World coordinates to local ones. */
static inline float3 frame_to_local(struct frame frame, float3 v)
{
    return (float3)(dot(v, frame.s), dot(v, frame.t), dot(v, frame.n));
}

#endif
