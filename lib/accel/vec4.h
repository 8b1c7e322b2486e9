/*
 * vec4.h - four floats in a register, as far as the tree builder needs them.
 *
 * GCC's and clang's vector extension; the fourth lane carries whatever lies behind three floats
 * in memory and is ignored.
 */
#ifndef RT_LIB_ACCEL_VEC4_H
#define RT_LIB_ACCEL_VEC4_H

#include <math.h>
#include <stdint.h>
#include <string.h>

typedef float vec4 __attribute__((vector_size(16)));
typedef int32_t ivec4 __attribute__((vector_size(16)));

static inline vec4 vec4_load(const float *p)
{
    vec4 v;
    memcpy(&v, p, sizeof v);
    return v;
}

static inline vec4 vec4_set(float x, float y, float z)
{
    return (vec4){x, y, z, 0.0f};
}

static inline vec4 vec4_all(float x)
{
    return (vec4){x, x, x, x};
}

#if defined(__SSE__)
static inline vec4 vec4_min(vec4 a, vec4 b)
{
    return __builtin_ia32_minps(a, b);
}
static inline vec4 vec4_max(vec4 a, vec4 b)
{
    return __builtin_ia32_maxps(a, b);
}
#else
static inline vec4 vec4_min(vec4 a, vec4 b)
{
    const ivec4 less = a < b;
    return (vec4)((less & (ivec4)a) | (~less & (ivec4)b));
}
static inline vec4 vec4_max(vec4 a, vec4 b)
{
    const ivec4 more = a > b;
    return (vec4)((more & (ivec4)a) | (~more & (ivec4)b));
}
#endif

/* A box; empty when lo > hi. */
typedef struct box4 {
    vec4 lo, hi;
} box4;

static inline box4 box4_empty(void)
{
    return (box4){vec4_all(INFINITY), vec4_all(-INFINITY)};
}

static inline box4 box4_join(box4 a, box4 b)
{
    return (box4){vec4_min(a.lo, b.lo), vec4_max(a.hi, b.hi)};
}

/* Half the surface of a box that is not empty. */
static inline float box4_area(box4 b)
{
    const vec4 d = b.hi - b.lo;
    return d[0] * (d[1] + d[2]) + d[1] * d[2];
}

#endif
