/*
 * lanes3.h - points and directions in eight lanes, one vector for each coordinate, and their way
 * from memory and back.
 */
#ifndef RT_KERNELS_MATH_LANES3_H
#define RT_KERNELS_MATH_LANES3_H

#include "math/lanes.h"

struct lanes3 {
    float8 x, y, z;
};

/* ---- Arithmetic ------------------------------------------------------------ */

static inline struct lanes3 add8(struct lanes3 a, struct lanes3 b)
{
    const struct lanes3 sum = {a.x + b.x, a.y + b.y, a.z + b.z};
    return sum;
}

static inline struct lanes3 sub8(struct lanes3 a, struct lanes3 b)
{
    const struct lanes3 difference = {a.x - b.x, a.y - b.y, a.z - b.z};
    return difference;
}

/* Coordinate by coordinate. */
static inline struct lanes3 mul8(struct lanes3 a, struct lanes3 b)
{
    const struct lanes3 product = {a.x * b.x, a.y * b.y, a.z * b.z};
    return product;
}

static inline struct lanes3 scale8(float8 s, struct lanes3 a)
{
    const struct lanes3 scaled = {s * a.x, s * a.y, s * a.z};
    return scaled;
}

/* a + s b */
static inline struct lanes3 along8(struct lanes3 a, float8 s, struct lanes3 b)
{
    const struct lanes3 sum = {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
    return sum;
}

static inline struct lanes3 fabs8(struct lanes3 a)
{
    const struct lanes3 size = {fabs(a.x), fabs(a.y), fabs(a.z)};
    return size;
}

static inline struct lanes3 cross8(struct lanes3 a, struct lanes3 b)
{
    const struct lanes3 product = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                                   a.x * b.y - a.y * b.x};
    return product;
}

static inline float8 dot8(struct lanes3 a, struct lanes3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline float8 length8(struct lanes3 a)
{
    return sqrt(dot8(a, a));
}

/* b in the lanes where `first` is false. */
static inline struct lanes3 select8(int8 first, struct lanes3 a, struct lanes3 b)
{
    const struct lanes3 chosen = {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
    return chosen;
}

static inline float8 largest8(struct lanes3 a)
{
    return lane_max(lane_max(a.x, a.y), a.z);
}

/* ---- Memory ---------------------------------------------------------------- */

/* Lane i from array[i]; access: the way on to a member, such as .depth or ->flags. */
#define LANES_OF(type, array, access)                                                              \
    ((type)((array)[0] access, (array)[1] access, (array)[2] access, (array)[3] access,            \
            (array)[4] access, (array)[5] access, (array)[6] access, (array)[7] access))

/* An initialiser of lanes3 from members that are float3, and from those that are float[3]. */
#define LANES3_OF(array, access)                                                                   \
    {                                                                                              \
        LANES_OF(float8, array, access.x), LANES_OF(float8, array, access.y),                      \
            LANES_OF(float8, array, access.z)                                                      \
    }
#define LANES3_OF_ROW(array, access)                                                               \
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

/* Lane i from the three floats `step` apart from from[i][offset] on. */
static inline struct lanes3 lanes3_gather(global const float *const from[8], uint offset, uint step)
{
    const struct lanes3 loaded = {lanes_gather(from, offset), lanes_gather(from, offset + step),
                                  lanes_gather(from, offset + 2u * step)};
    return loaded;
}

/* Turns the lanes to rows: rows[i] is lane i. */
static inline void lanes3_rows(struct lanes3 a, float3 rows[8])
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
