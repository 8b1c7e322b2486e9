/*
 * rng_lanes.h - the random numbers of eight paths at once, one path per lane: those of rng.h, bit
 * for bit.
 *
 * A vertex takes eight numbers, each at the end of a chain of multiplications. Here the chains of
 * eight paths run side by side, and the numbers come as lanes, in which vertices are shaded.
 */
#ifndef RT_KERNELS_SAMPLE_RNG_LANES_H
#define RT_KERNELS_SAMPLE_RNG_LANES_H

#include "math/vec8.h"
#include "sample/rng.h"

/* Eight numbers of each path: lane i of row[d] is number d of path i. */
struct numbers_x8 {
    float8 row[8];
};

/* The four words of eight points, in rows. */
struct words_x8 {
    uint8 row[4];
};

/* Lane i of four rows, and of all eight. */
static inline float4 set_of_lane(const float8 rows[4], uint i)
{
    const float *const lane = (const float *)rows + i;
    return (float4)(lane[0], lane[8], lane[16], lane[24]);
}

static inline float8 pair_of_lane(const struct numbers_x8 *numbers, uint i)
{
    return (float8)(set_of_lane(numbers->row, i), set_of_lane(numbers->row + 4, i));
}

/* Turns points to rows of their words. */
static inline struct words_x8 words_of(const uint4 points[8])
{
    const uint8 a = (uint8)(points[0], points[4]), b = (uint8)(points[1], points[5]),
                c = (uint8)(points[2], points[6]), d = (uint8)(points[3], points[7]);
    const uint8 ab = (uint8)(a.s0, b.s0, a.s1, b.s1, a.s4, b.s4, a.s5, b.s5),
                ab_rest = (uint8)(a.s2, b.s2, a.s3, b.s3, a.s6, b.s6, a.s7, b.s7),
                cd = (uint8)(c.s0, d.s0, c.s1, d.s1, c.s4, d.s4, c.s5, d.s5),
                cd_rest = (uint8)(c.s2, d.s2, c.s3, d.s3, c.s6, d.s6, c.s7, d.s7);
    const struct words_x8 words = {{
        (uint8)(ab.s01, cd.s01, ab.s45, cd.s45),
        (uint8)(ab.s23, cd.s23, ab.s67, cd.s67),
        (uint8)(ab_rest.s01, cd_rest.s01, ab_rest.s45, cd_rest.s45),
        (uint8)(ab_rest.s23, cd_rest.s23, ab_rest.s67, cd_rest.s67),
    }};
    return words;
}

/* As pcg4d. */
static inline struct words_x8 pcg4d_x8(struct words_x8 v)
{
    uint8 *const x = v.row, *const y = v.row + 1, *const z = v.row + 2, *const w = v.row + 3;
    for (uint d = 0u; d < 4u; d++)
        v.row[d] = v.row[d] * 1664525u + 1013904223u;
    for (uint round = 0u; round < 2u; round++) {
        *x += *y * *w;
        *y += *z * *x;
        *z += *x * *y;
        *w += *y * *z;
        for (uint d = 0u; round == 0u && d < 4u; d++)
            v.row[d] ^= v.row[d] >> 16;
    }
    return v;
}

/* The words of a set of each sampler from which its numbers come. */
static inline struct words_x8 sobol_words(global const uint4 *sobol, const struct words_x8 *key,
                                          uint8 index, uint8 set)
{
    struct words_x8 seeds;
    for (uint d = 0u; d < 4u; d++)
        seeds.row[d] = mix_words(key->row[d] + set * 0x9e3779b9u);
    const uint8 shuffle = (seeds.row[0] ^ seeds.row[2]) * 0x9e3779b9u + seeds.row[3];
    uint shuffled[8];
    vstore8(scramble_reversed8(index, shuffle), 0, shuffled);
    uint4 points[8];
    for (uint i = 0u; i < 8u; i++)
        points[i] = sobol_point(sobol, shuffled[i]);
    struct words_x8 words = words_of(points);
    for (uint d = 0u; d < 4u; d++)
        words.row[d] = reverse_bits8(scramble_reversed8(words.row[d], seeds.row[d]));
    return words;
}

static inline struct words_x8 independent_words(const struct words_x8 *key, uint8 index, uint8 set)
{
    struct words_x8 words = *key;
    words.row[0] += index;
    words.row[1] += set;
    return pcg4d_x8(words);
}

/*
 * As sampler_set, for eight samplers of these keys and indices, each with a set of its own; sobol:
 * of all of them.
 */
INLINE_NEVER void sampler_sets(float8 numbers[4], global const uint4 *sobol,
                               const struct words_x8 *key, uint8 index, uint8 set)
{
    const struct words_x8 words =
        sobol ? sobol_words(sobol, key, index, set) : independent_words(key, index, set);
    for (uint d = 0u; d < 4u; d++)
        numbers[d] = unit_numbers(words.row[d]);
}

#endif
