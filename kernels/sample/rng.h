/*
 * rng.h - the random numbers of a path: counter-based, so that any sample can be made alone.
 *
 * A sampler serves one sample of one stream (a pixel, or all photon paths together) in sets of four
 * numbers. A set is a pure function of (seed, replicate, stream, sample, set): the sampler has no
 * state, and unused dimensions cost nothing. Assignment of dimensions:
 *
 *   set                  .x .y                    .z                  .w
 *   SET_START     eye    point in the pixel       point on the lens (z, w)
 *                 light  point on the light       choice of light     -
 *   SET_EMISSION  light  direction                side of the light   bounding sphere
 *   set_light(v)         point on the light       choice of light     -
 *   set_scatter(v)       direction                event or roulette   side of a rough boundary
 *
 * v counts the vertices of the path from 0, the first surface met. Two-dimensional decisions
 * sit in x and y, which form a (0,2)-sequence in base 2 together.
 *
 * Sobol: padded four-dimensional Owen-scrambled points. For each set, the sample's index is
 * shuffled by a nested uniform scramble, and each coordinate scrambled again (Burley 2020),
 * both by the hash of Laine and Karras with the constants of Vegdahl, which acts on numbers
 * with their bits reversed. The index is reversed once a path; the table `sobol` of the scene
 * is addressed by bytes of the reversed index and holds reversed coordinates, so that a set
 * costs one reversal, at the end. The two sets of a vertex are made at once, in eight lanes.
 *
 * References:
 *   Burley: "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020.
 *   Laine, Karras: "Stratified Sampling for Stochastic Transparency", EGSR 2011.
 *   Vegdahl: "Building a Better LK Hash", 2021.
 *   Jarzynski, Olano: "Hash Functions for GPU Rendering", JCGT 9(3), 2020 (pcg4d).
 *   Wellons: "Prospecting for Hash Functions", 2018 (the constants of mix_words are later finds).
 */
#ifndef RT_KERNELS_SAMPLE_RNG_H
#define RT_KERNELS_SAMPLE_RNG_H

#include "scene.h"
#include "types.h"

#define RT_STREAM_PHOTONS 0xffffffffu /* the stream of all photon paths; a path is its sample */
#define RT_STREAM_CAUSTIC 0xfffffffeu /* that of the paths which fill a caustic map */

enum { SET_START = 0, SET_EMISSION = 1 };

struct sampler {
    global const uint4 *sobol; /* NULL: independent numbers */
    uint4 key;                 /* of the stream, from which the seeds of its sets are made */
    uint index;                /* sample, with its bits reversed for Sobol */
};

static inline uint set_light(uint vertex)
{
    return 2u + 2u * vertex;
}

static inline uint set_scatter(uint vertex)
{
    return 3u + 2u * vertex;
}

static inline uint reverse_bits(uint x)
{
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x >> 8) & 0x00ff00ffu);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

static inline uint8 reverse_bits8(uint8 x)
{
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x >> 8) & 0x00ff00ffu);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

/* Jarzynski and Olano: four words in, four words out, all bits mixed. */
static inline uint4 pcg4d(uint4 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

/* Vegdahl: a nested uniform scramble of numbers whose bits are reversed. */
static inline uint scramble_reversed(uint x, uint seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

static inline uint8 scramble_reversed8(uint8 x, uint8 seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

/* Wellons: each word mixed on its own. */
static inline uint8 mix_words(uint8 x)
{
    x = (x ^ (x >> 16)) * 0x21f0aaadu;
    x = (x ^ (x >> 15)) * 0xd35a2d97u;
    return x ^ (x >> 15);
}

static inline struct sampler sampler_start(const struct scene *scene, const rt_params *params,
                                           uint stream, uint sample)
{
    const bool independent = params->sampler == RT_SAMPLER_INDEPENDENT;
    struct sampler sampler;
    sampler.sobol = independent ? 0 : scene->sobol;
    sampler.key = pcg4d((uint4)(stream, params->seed, params->replicate, 0u));
    sampler.index = independent ? sample : reverse_bits(sample);
    return sampler;
}

/*
 * The Sobol point of the set with these seeds, with the bits of its coordinates reversed, not yet
 * scrambled.
 */
static inline uint4 sobol_point(const struct sampler *sampler, uint4 seeds)
{
    const uint i = scramble_reversed(sampler->index, (seeds.x ^ seeds.z) * 0x9e3779b9u + seeds.w);
    return sampler->sobol[i & 255u] ^ sampler->sobol[256u + ((i >> 8) & 255u)] ^
           sampler->sobol[512u + ((i >> 16) & 255u)] ^ sampler->sobol[768u + (i >> 24)];
}

/* Eight numbers in [0, 1): those of set `set` and of the set after it. */
static inline float8 sampler_pair(const struct sampler *sampler, uint set)
{
    uint8 bits;
    if (sampler->sobol) {
        const uint8 seeds = mix_words(
            (uint8)(sampler->key + set * 0x9e3779b9u, sampler->key + (set + 1u) * 0x9e3779b9u));
        bits = (uint8)(sobol_point(sampler, seeds.lo), sobol_point(sampler, seeds.hi));
        bits = reverse_bits8(scramble_reversed8(bits, seeds));
    } else {
        const uint4 step = (uint4)(sampler->index, set, 0u, 0u);
        bits = (uint8)(pcg4d(sampler->key + step),
                       pcg4d(sampler->key + step + (uint4)(0u, 1u, 0u, 0u)));
    }
    /* The upper 24 bits are exact in float32 and stay below 1. */
    return convert_float8(bits >> 8) * 0x1p-24f;
}

static inline float4 sampler_set(const struct sampler *sampler, uint set)
{
    return sampler_pair(sampler, set).lo;
}

#endif
