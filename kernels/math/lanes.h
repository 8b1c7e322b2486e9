/*
 * lanes.h - helpers for eight lanes held in a vector of eight.
 *
 * Comparing vectors gives 0 or -1 per lane; lane_mask packs these into one bit per lane, by one
 * instruction where the target has it.
 */
#ifndef RT_KERNELS_MATH_LANES_H
#define RT_KERNELS_MATH_LANES_H

/*
 * INLINE_ALWAYS is for inner loops. INLINE_NEVER is for functions with a traversal stack, and for
 * large ones of several callers. Once such a stack is inlined into a kernel, a runtime that runs a
 * work-group as a loop gives each work-item one of its own, and together they no longer fit the
 * first-level cache. On a GPU a call costs little beside what is called, though arguments passed by
 * pointer leave the registers; without calls the code of a kernel is several times as long and
 * takes five times as long to compile, and work-items that diverge do not meet again at the
 * traversal: paths are followed at a fifth of the speed (both on an NVIDIA H100).
 */
#if defined(__clang__)
#define INLINE_ALWAYS static inline __attribute__((always_inline))
#define UNLIKELY(condition) __builtin_expect(!!(condition), 0) /* favours the other branch */
#else
#define INLINE_ALWAYS static inline
#define UNLIKELY(condition) (condition)
#endif
#if defined(__clang__)
#define INLINE_NEVER static __attribute__((noinline))
#else
#define INLINE_NEVER static inline
#endif

/* Asks the caches of a CPU for what lies at an address of global memory, and waits for nothing. */
#if defined(__clang__) && (defined(__x86_64__) || defined(__aarch64__))
#define PREFETCH(address) __builtin_prefetch((const void *)(size_t)(address))
#else
#define PREFETCH(address) ((void)(address))
#endif

/*
 * What few rays need: inlined, it would crowd the registers of the others. Its arguments are
 * numbers, addresses of global memory and copies, which leave no register for it.
 */
#define RARELY_CALLED INLINE_NEVER

/*
 * What takes much code and few ask for, by pointers: on a CPU these lead to memory that is written
 * anyway; on a GPU, at width 1, what they lead to would leave the registers.
 */
#if RT_WIDTH > 1
#define CALLED_ON_CPUS INLINE_NEVER
#else
#define CALLED_ON_CPUS static inline
#endif

/*
 * What has much memory of its own, and stands beside a traversal in its caller. The memory of a
 * work-item of a GPU is that of the deepest chain of calls, which this is not in, out of line.
 */
#if RT_WIDTH > 1
#define CALLED_ON_GPUS static inline
#else
#define CALLED_ON_GPUS INLINE_NEVER
#endif

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

/* The same of a number. */
static inline float mad_once(float a, float b, float c)
{
#if defined(__FMA__) || defined(FP_FAST_FMAF)
    return fma(a, b, c);
#else
    return a * b + c;
#endif
}

/* Bit i is set where lane i of a comparison is true. */
static inline uint lane_mask(int8 comparison)
{
#if defined(__AVX512VL__) && defined(__AVX512DQ__)
    return (uint)(uchar)__builtin_ia32_cvtd2mask256(comparison);
#elif defined(__AVX__)
    return (uint)__builtin_ia32_movmskps256(as_float8(comparison));
#else
    const int8 bits = comparison & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
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

/* The lowest set bit's index; mask is not 0. */
static inline uint lane_first(uint mask)
{
#if defined(__clang__)
    return (uint)__builtin_ctz(mask);
#else
    return 31u - clz(mask & (0u - mask));
#endif
}

/*
 * Lanes to be read by an index that is known only at run time: through memory at width 8; at width
 * 1 from registers, as private memory is slow on a GPU.
 */
struct lane_array {
#if RT_WIDTH > 1
    float lane[8];
#else
    float8 lanes;
#endif
};

INLINE_ALWAYS struct lane_array lane_array(float8 v)
{
    struct lane_array array;
#if RT_WIDTH > 1
    vstore8(v, 0, array.lane);
#else
    array.lanes = v;
#endif
    return array;
}

INLINE_ALWAYS float lane_read(const struct lane_array *array, uint lane)
{
#if RT_WIDTH > 1
    return array->lane[lane];
#else
    const float4 four = lane & 4u ? array->lanes.hi : array->lanes.lo;
    const float2 two = lane & 2u ? four.hi : four.lo;
    return lane & 1u ? two.y : two.x;
#endif
}

/*
 * Stores the lanes whose bits are set in `mask` one after the other; up to eight numbers from `to`
 * on may be written; those after the stored lanes are undefined.
 */
static inline void lane_store(float8 v, uint mask, global float *to)
{
#if defined(__AVX512VL__) && defined(__AVX512F__)
    vstore8(__builtin_ia32_compresssf256_mask(v, v, (uchar)mask), 0, to);
#else
    const struct lane_array array = lane_array(v);
    for (; mask; mask &= mask - 1u)
        *to++ = lane_read(&array, lane_first(mask));
#endif
}

/* The highest set bit's index; mask is not 0. */
static inline uint lane_last(uint mask)
{
    return 31u - clz(mask);
}

#endif
