/*
 * frame.h - orthonormal frames, and small vector arithmetic that the kernels share.
 *
 * References:
 *   Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin: "Building an Orthonormal
 *     Basis, Revisited", JCGT 6(1), 2017.
 */
#ifndef RT_KERNELS_MATH_FRAME_H
#define RT_KERNELS_MATH_FRAME_H

#define RT_PI 3.14159265358979f

/* A right-handed orthonormal frame about the unit vector n. */
struct frame {
    float3 s, t, n;
};

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

/* Duff et al., listing 3: no branch and no singular direction. */
static inline struct frame frame_about(float3 n)
{
    const float sign = n.z < 0.0f ? -1.0f : 1.0f;
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    struct frame frame;
    frame.s = (float3)(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    frame.t = (float3)(b, sign + n.y * n.y * a, -n.y);
    frame.n = n;
    return frame;
}

/* Local coordinates (s, t, n) to world. */
static inline float3 frame_to_world(struct frame frame, float3 v)
{
    return v.x * frame.s + v.y * frame.t + v.z * frame.n;
}

/* World coordinates to local ones. */
static inline float3 frame_to_local(struct frame frame, float3 v)
{
    return (float3)(dot(v, frame.s), dot(v, frame.t), dot(v, frame.n));
}

#endif
