/*
 * lanes.h - helpers for eight lanes held in a vector of eight.
 *
 * Comparisons of vectors give 0 or -1 a lane; lane_mask packs them into a bit a lane, by one
 * instruction where the target has it.
 */
#ifndef RT_KERNELS_MATH_LANES_H
#define RT_KERNELS_MATH_LANES_H

static inline float8 lane_min(float8 a, float8 b)
{
    return a < b ? a : b;
}

static inline float8 lane_max(float8 a, float8 b)
{
    return a > b ? a : b;
}

/* a b + c, rounded once where the target does that in one instruction, else twice. */
static inline float8 lane_mad(float8 a, float8 b, float8 c)
{
#if defined(__FMA__) || defined(FP_FAST_FMAF)
    return fma(a, b, c);
#else
    return a * b + c;
#endif
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

/* The comparison that is true in the lanes whose bits are set in `mask`. */
static inline int8 lanes_of(uint mask)
{
    return ((int8)((int)mask) & (int8)(1, 2, 4, 8, 16, 32, 64, 128)) != 0;
}

/*
 * The lanes whose bits are set in `mask`, moved together to the front; what follows them is
 * arbitrary.
 */
static inline float8 lane_compress(float8 v, uint mask)
{
#if defined(__AVX512VL__) && defined(__AVX512F__)
    return __builtin_ia32_compresssf256_mask(v, v, (uchar)mask);
#else
    float from[8], to[8];
    uint count = 0u;
    vstore8(v, 0, from);
    vstore8(v, 0, to);
    for (uint lane = 0u; lane < 8u; lane++) {
        to[count & 7u] = from[lane];
        count += mask >> lane & 1u;
    }
    return vload8(0, to);
#endif
}

/* The lowest set bit's index; mask is not 0. */
static inline uint lane_first(uint mask)
{
#if defined(__clang__)
    return (uint)__builtin_ctz(mask);
#else
    return 31u - clz(mask & (0u - mask));
#endif
}

/* The highest set bit's index; mask is not 0. */
static inline uint lane_last(uint mask)
{
    return 31u - clz(mask);
}

/*
 * Inner loops are to be inlined wherever they are used. A function with a stack of its own is to be
 * called: inlined into a kernel, a runtime that runs a work-group as a loop gives each work-item an
 * array of its own, and the stacks no longer fit the nearest cache.
 */
#if defined(__clang__)
#define INLINE_ALWAYS static inline __attribute__((always_inline))
#define INLINE_NEVER static __attribute__((noinline))
#define SELDOM(truth) __builtin_expect(!!(truth), 0) /* registers go to the other way first */
#else
#define INLINE_ALWAYS static inline
#define INLINE_NEVER static
#define SELDOM(truth) (truth)
#endif

#endif
