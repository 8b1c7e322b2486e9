/*
 * lanes.h - helpers for eight lanes held in a vector of eight.
 *
 * Comparisons of vectors give 0 or -1 a lane; lane_mask packs them into a bit a lane, by one
 * instruction where the target has it.
 */
#ifndef RT_LANES_H
#define RT_LANES_H

static inline float8 lane_min(float8 a, float8 b)
{
    return a < b ? a : b;
}

static inline float8 lane_max(float8 a, float8 b)
{
    return a > b ? a : b;
}

/* Bit i is set where lane i of a comparison is true. */
static inline uint lane_mask(int8 truth)
{
#if defined(__AVX512VL__) && defined(__AVX512DQ__)
    return (uint)(uchar)__builtin_ia32_cvtd2mask256(truth);
#elif defined(__AVX__)
    return (uint)__builtin_ia32_movmskps256(as_float8(truth));
#else
    const int8 bits = truth & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    const int4 four = bits.lo | bits.hi;
    const int2 two = four.lo | four.hi;
    return (uint)(two.lo | two.hi);
#endif
}

/* The lowest set bit's index; mask is not 0. */
static inline uint lane_first(uint mask)
{
    return 31u - clz(mask & (0u - mask));
}

#endif
