/*
 * film_sum.h - exact sums of a film's pixels: the same bits in whatever order samples are added and
 * in how many parts, on one device or on many. Host and device read this file.
 *
 * What lies in [-1, 1], as albedo and normals do, is summed in fixed point. Else:
 *
 * The bits of a float are divided at fixed places into bins of 32: bin b counts units of
 * 2^(32 b - 149), so that the 24 bits of a float lie in one bin or in two neighbours. A channel
 * keeps two bins as whole numbers, the higher one being the highest of any value so far. What lies
 * in bins below both is left out, of every value alike, whether it comes before the highest or
 * after. That is less than 2^-32 of the largest value each time. A sum of 2^31 values cannot
 * overflow.
 *
 * References:
 *   Demmel, Nguyen: "Parallel Reproducible Summation", IEEE Transactions on Computers 64(7), 2015:
 *     bins at fixed places, of which the highest few are kept.
 */
#ifndef RT_KERNELS_CAMERA_FILM_SUM_H
#define RT_KERNELS_CAMERA_FILM_SUM_H

#include "types.h"

/* Adding to a pixel must be inlined: called, it would take the pixel out of a GPU's registers. */
#if defined(__clang__)
#define FILM_INLINE static inline __attribute__((always_inline))
#else
#define FILM_INLINE static inline
#endif

#define RT_FILM_BIN_BITS 32u /* of a bin */
#define RT_FILM_BIN_LAST 7u  /* the highest that is a lower bin */

/* The channels of a pixel. */
typedef struct film_sums {
    rt_i64 *high, *low; /* of each channel */
    rt_u32 *bins;       /* the lower bin of channel c, in bits 4 c to 4 c + 3 */
} film_sums;

static inline film_sums film_sums_of(rt_film_pixel *pixel)
{
    const film_sums sums = {pixel->high, pixel->low, &pixel->bins};
    return sums;
}

static inline film_sums film_sums_of_hits(rt_first_hits *hits)
{
    const film_sums sums = {hits->high, hits->low, &hits->bins};
    return sums;
}

/* The lower bin of a channel; the higher one follows. */
static inline rt_u32 film_bin(rt_u32 bins, int channel)
{
    return bins >> 4 * channel & 15u;
}

/* Moves a channel up until its lower bin is at least this one. */
static inline void film_raise(film_sums sums, int channel, rt_u32 bin)
{
    const rt_u32 now = film_bin(*sums.bins, channel);
    if (bin <= now)
        return;
    sums.low[channel] = bin == now + 1u ? sums.high[channel] : 0;
    sums.high[channel] = 0;
    *sums.bins += (bin - now) << 4 * channel;
}

/* Adds the value of a finite float, given by its bits, to a channel. */
FILM_INLINE void film_add_bits(film_sums sums, int channel, rt_u32 bits)
{
    const rt_u32 exponent = bits >> 23 & 255u, place = exponent - (exponent > 0u);
    const rt_u32 bin = place / RT_FILM_BIN_BITS;
    const rt_u64 digits = (rt_u64)((bits & 0x7fffffu) | (rt_u32)(exponent > 0u) << 23)
                          << place % RT_FILM_BIN_BITS;
    const rt_i64 sign = (bits >> 31) ? -1 : 1;
    const rt_i64 upper = sign * (rt_i64)(digits >> RT_FILM_BIN_BITS);
    const rt_i64 lower = sign * (rt_i64)(digits & 0xffffffffu);

    if (bin != film_bin(*sums.bins, channel) && digits != 0u)
        film_raise(sums, channel, upper != 0 ? bin : bin - (bin > 0u));
    const rt_u32 now = film_bin(*sums.bins, channel);
    /* One addition to each place: a choice of places would keep the pixel in a GPU's memory. */
    sums.high[channel] += bin == now ? upper : bin == now + 1u ? lower : 0;
    sums.low[channel] += bin == now ? lower : bin + 1u == now ? upper : 0;
}

/* a + b, wrapped around: sums that came from a file may do so. */
static inline rt_i64 film_wrapped(rt_i64 a, rt_i64 b)
{
    return (rt_i64)((rt_u64)a + (rt_u64)b);
}

/* Adds a channel of other sums, which are raised to the same bin. */
static inline void film_join_channel(film_sums sums, film_sums more, int channel)
{
    film_raise(sums, channel, film_bin(*more.bins, channel));
    film_raise(more, channel, film_bin(*sums.bins, channel));
    sums.high[channel] = film_wrapped(sums.high[channel], more.high[channel]);
    sums.low[channel] = film_wrapped(sums.low[channel], more.low[channel]);
}

/* a + b, or the largest number. */
static inline rt_u32 film_add_saturated(rt_u32 a, rt_u32 b)
{
    return a + b < a ? 0xffffffffu : a + b;
}

/* Adds n to the samples that were left out. */
static inline void film_reject(rt_film_pixel *pixel, rt_u32 n)
{
    const rt_u32 most = 0xffffffffu >> RT_FILM_REJECTED, before = pixel->bins >> RT_FILM_REJECTED;
    const rt_u32 added = n < most - before ? n : most - before;
    pixel->bins += added << RT_FILM_REJECTED;
}

/* Adds all samples of another pixel. */
static inline void film_join(rt_film_pixel *pixel, const rt_film_pixel *other)
{
    rt_film_pixel more = *other;
    for (int c = 0; c < 3; c++)
        film_join_channel(film_sums_of(pixel), film_sums_of(&more), c);
    film_reject(pixel, more.bins >> RT_FILM_REJECTED);
    pixel->weight = (rt_i32)((rt_u32)pixel->weight + (rt_u32)more.weight);
    pixel->count += more.count;
    pixel->cut_off = film_add_saturated(pixel->cut_off, more.cut_off);
}

/* Keeps shape and material of a hit, unless there are those of a lower one. */
static inline void first_hits_keep(rt_first_hits *hits, rt_i64 first, rt_u32 shape, rt_u32 material)
{
    if (first == 0 || (hits->first != 0 && hits->first <= first))
        return;
    hits->first = first;
    hits->shape = shape;
    hits->material = material;
}

/* Adds all samples of the layers of another pixel. */
static inline void first_hits_join(rt_first_hits *hits, const rt_first_hits *other)
{
    rt_first_hits more = *other;
    for (int c = 0; c < 3; c++) {
        hits->albedo[c] = film_wrapped(hits->albedo[c], more.albedo[c]);
        hits->normal[c] = film_wrapped(hits->normal[c], more.normal[c]);
    }
    for (int c = 0; c < RT_HIT_CHANNELS; c++)
        film_join_channel(film_sums_of_hits(hits), film_sums_of_hits(&more), c);
    hits->rejected = film_add_saturated(hits->rejected, more.rejected);
    hits->count += more.count;
    hits->weight = (rt_i32)((rt_u32)hits->weight + (rt_u32)more.weight);
    hits->hits += more.hits;
    hits->hit_weight = (rt_i32)((rt_u32)hits->hit_weight + (rt_u32)more.hit_weight);
    first_hits_keep(hits, more.first, more.shape, more.material);
}

#endif
