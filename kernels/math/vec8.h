/*
 * vec8.h - points and directions of eight paths, one lane a path and one vector a coordinate, and
 * how they are gathered from memory and turned back to rows.
 */
#ifndef RT_KERNELS_MATH_VEC8_H
#define RT_KERNELS_MATH_VEC8_H

#include "math/lanes.h"

struct vec2_x8 {
    float8 x, y;
};

struct vec3_x8 {
    float8 x, y, z;
};

/* ---- Arithmetic ------------------------------------------------------------ */

static inline struct vec2_x8 vec2_x8(float8 x, float8 y)
{
    const struct vec2_x8 v = {x, y};
    return v;
}

static inline struct vec3_x8 vec3_x8(float8 x, float8 y, float8 z)
{
    const struct vec3_x8 v = {x, y, z};
    return v;
}

static inline struct vec3_x8 add_x8(struct vec3_x8 a, struct vec3_x8 b)
{
    const struct vec3_x8 sum = {a.x + b.x, a.y + b.y, a.z + b.z};
    return sum;
}

static inline struct vec3_x8 sub_x8(struct vec3_x8 a, struct vec3_x8 b)
{
    const struct vec3_x8 difference = {a.x - b.x, a.y - b.y, a.z - b.z};
    return difference;
}

/* Coordinate by coordinate. */
static inline struct vec3_x8 mul_x8(struct vec3_x8 a, struct vec3_x8 b)
{
    const struct vec3_x8 product = {a.x * b.x, a.y * b.y, a.z * b.z};
    return product;
}

static inline struct vec3_x8 scale_x8(float8 s, struct vec3_x8 a)
{
    const struct vec3_x8 scaled = {s * a.x, s * a.y, s * a.z};
    return scaled;
}

/* a + s b */
static inline struct vec3_x8 along_x8(struct vec3_x8 a, float8 s, struct vec3_x8 b)
{
    const struct vec3_x8 sum = {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
    return sum;
}

static inline struct vec3_x8 abs_x8(struct vec3_x8 a)
{
    const struct vec3_x8 size = {fabs(a.x), fabs(a.y), fabs(a.z)};
    return size;
}

static inline struct vec3_x8 cross_x8(struct vec3_x8 a, struct vec3_x8 b)
{
    const struct vec3_x8 product = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                                    a.x * b.y - a.y * b.x};
    return product;
}

static inline float8 dot_x8(struct vec3_x8 a, struct vec3_x8 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline float8 length_x8(struct vec3_x8 a)
{
    return sqrt(dot_x8(a, a));
}

/* The same where the squares of coordinates may be more or less than a float holds. */
static inline float8 safe_length_x8(struct vec3_x8 a)
{
    const float8 largest = lane_max(lane_max(fabs(a.x), fabs(a.y)), fabs(a.z));
    /* A power of two, by which what is in the range stays the same to the bit. */
    const float8 unit = as_float8(max(as_int8(largest) & 0x7f800000, 0x00800000));
    return unit * length_x8(scale_x8(1.0f / unit, a));
}

/* b in the lanes where `first` is false. */
static inline struct vec3_x8 select_x8(int8 first, struct vec3_x8 a, struct vec3_x8 b)
{
    const struct vec3_x8 chosen = {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
    return chosen;
}

static inline float8 largest_x8(struct vec3_x8 a)
{
    return lane_max(lane_max(a.x, a.y), a.z);
}

/* ---- Memory ---------------------------------------------------------------- */

/* Lane i from array[i]; access: how to reach a member of it, such as .depth or ->flags. */
#define LANES_OF(type, array, access)                                                              \
    ((type)((array)[0] access, (array)[1] access, (array)[2] access, (array)[3] access,            \
            (array)[4] access, (array)[5] access, (array)[6] access, (array)[7] access))

/* An initialiser of vec3_x8 from members that are float3, and from those that are float[3]. */
#define VEC3_X8_OF(array, access)                                                                  \
    {                                                                                              \
        LANES_OF(float8, array, access.x), LANES_OF(float8, array, access.y),                      \
            LANES_OF(float8, array, access.z)                                                      \
    }
#define VEC3_X8_OF_ROW(array, access)                                                              \
    {                                                                                              \
        LANES_OF(float8, array, access[0]), LANES_OF(float8, array, access[1]),                    \
            LANES_OF(float8, array, access[2])                                                     \
    }

/* Lane i from from[i][offset]. */
static inline float8 lanes_gather(global const float *const from[8], uint offset)
{
    return (float8)(from[0][offset], from[1][offset], from[2][offset], from[3][offset],
                    from[4][offset], from[5][offset], from[6][offset], from[7][offset]);
}

/* Lane i from from[i] at an offset of its own. */
static inline float8 lanes_gather_at(global const float *const from[8], uint8 offset)
{
    return (float8)(from[0][offset.s0], from[1][offset.s1], from[2][offset.s2], from[3][offset.s3],
                    from[4][offset.s4], from[5][offset.s5], from[6][offset.s6], from[7][offset.s7]);
}

/* Lane i from the three floats `step` apart from from[i][offset] on. */
static inline struct vec3_x8 vec3_x8_gather(global const float *const from[8], uint offset,
                                            uint step)
{
    const struct vec3_x8 loaded = {lanes_gather(from, offset), lanes_gather(from, offset + step),
                                   lanes_gather(from, offset + 2u * step)};
    return loaded;
}

/* Turns the lanes to rows: rows[i] is lane i. */
static inline void vec3_x8_rows(struct vec3_x8 a, float3 rows[8])
{
    const float8 even = (float8)(a.x.s0, a.y.s0, a.x.s1, a.y.s1, a.x.s4, a.y.s4, a.x.s5, a.y.s5);
    const float8 odd = (float8)(a.x.s2, a.y.s2, a.x.s3, a.y.s3, a.x.s6, a.y.s6, a.x.s7, a.y.s7);
    rows[0] = (float3)(even.s01, a.z.s0);
    rows[1] = (float3)(even.s23, a.z.s1);
    rows[2] = (float3)(odd.s01, a.z.s2);
    rows[3] = (float3)(odd.s23, a.z.s3);
    rows[4] = (float3)(even.s45, a.z.s4);
    rows[5] = (float3)(even.s67, a.z.s5);
    rows[6] = (float3)(odd.s45, a.z.s6);
    rows[7] = (float3)(odd.s67, a.z.s7);
}

#endif
