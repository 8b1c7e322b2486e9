/*
 * film_sum.h - exact sums of a film's pixels: the same bits in whatever order samples are added and
 * in how many parts, on one device or on many. Host and device read this file.
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

#define RT_FILM_BIN_BITS 32u /* of a bin */
#define RT_FILM_BIN_LAST 7u  /* the highest that is a lower bin */

/* The lower bin of a channel; the higher one follows. */
static inline rt_u32 film_bin(const rt_film_pixel *pixel, int channel)
{
    return pixel->bins >> 4 * channel & 15u;
}

/* Moves a channel up until its lower bin is at least this one. */
static inline void film_raise(rt_film_pixel *pixel, int channel, rt_u32 bin)
{
    const rt_u32 now = film_bin(pixel, channel);
    if (bin <= now)
        return;
    pixel->low[channel] = bin == now + 1u ? pixel->high[channel] : 0;
    pixel->high[channel] = 0;
    pixel->bins += (bin - now) << 4 * channel;
}

/* Adds the value of a finite float, given by its bits, to a channel. */
static inline void film_add_bits(rt_film_pixel *pixel, int channel, rt_u32 bits)
{
    const rt_u32 exponent = bits >> 23 & 255u, place = exponent - (exponent > 0u);
    const rt_u32 bin = place / RT_FILM_BIN_BITS;
    const rt_u64 digits = (rt_u64)((bits & 0x7fffffu) | (rt_u32)(exponent > 0u) << 23)
                          << place % RT_FILM_BIN_BITS;
    const rt_i64 sign = (bits >> 31) ? -1 : 1;
    const rt_i64 upper = sign * (rt_i64)(digits >> RT_FILM_BIN_BITS);
    const rt_i64 lower = sign * (rt_i64)(digits & 0xffffffffu);

    if (bin != film_bin(pixel, channel) && digits != 0u)
        film_raise(pixel, channel, upper != 0 ? bin : bin - (bin > 0u));
    const rt_u32 now = film_bin(pixel, channel);
    if (bin == now) {
        pixel->high[channel] += upper;
        pixel->low[channel] += lower;
    } else if (bin == now + 1u) {
        pixel->high[channel] += lower;
    } else if (bin + 1u == now) {
        pixel->low[channel] += upper;
    }
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

/* Adds all samples of another pixel. Sums that came from a file may wrap around. */
static inline void film_join(rt_film_pixel *pixel, const rt_film_pixel *other)
{
    rt_film_pixel more = *other;
    for (int c = 0; c < 3; c++) {
        film_raise(pixel, c, film_bin(&more, c));
        film_raise(&more, c, film_bin(pixel, c));
        pixel->high[c] = (rt_i64)((rt_u64)pixel->high[c] + (rt_u64)more.high[c]);
        pixel->low[c] = (rt_i64)((rt_u64)pixel->low[c] + (rt_u64)more.low[c]);
    }
    film_reject(pixel, more.bins >> RT_FILM_REJECTED);
    pixel->weight = (rt_i32)((rt_u32)pixel->weight + (rt_u32)more.weight);
    pixel->count += more.count;
    pixel->cut_off = film_add_saturated(pixel->cut_off, more.cut_off);
}

#endif
