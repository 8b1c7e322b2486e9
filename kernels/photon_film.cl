/*
 * photon_film.cl - adds gather points to the film, each as one sample of its pixel; adds the film
 * of a pass to that of the render and to its moments; and counts queries.
 */
#include "entry.h"
#include "camera/film.h"
#include "math/frame.h"

/*
 * The radiance of a gather point; NaN where its position is not finite, as no photons were gathered
 * there.
 */
static float3 radiance_of(global const rt_gather_point *point)
{
    return all(isfinite(row3(point->position))) ? row3(point->radiance) : (float3)(NAN);
}

/*
 * points: [item_count][params.split], a row for each sample, no two of the same pixel; caustics:
 * [params.final_gather][stride], points whose radiance belongs to the same sample.
 */
KERNEL photon_film(const rt_params params, global const rt_gather_point *points,
                   global const rt_gather_point *caustics, uint stride, global rt_film_pixel *film)
{
    const uint item = item_number();
    if (item >= params.item_count)
        return;
    points += item * params.split;
    caustics += item * params.split;
    const uint index = points->pixel;
    float3 radiance = radiance_of(points);
    float cut_off = points->cut_off;
    for (uint i = 0u; i < params.final_gather; i++)
        radiance += radiance_of(caustics + i * stride);
    for (uint k = 1u; k < params.split; k++) {
        radiance += radiance_of(points + k);
        cut_off += points[k].cut_off;
        for (uint i = 0u; i < params.final_gather; i++)
            radiance += radiance_of(caustics + i * stride + k);
    }
    global rt_film_pixel *const plane = film_plane(film, &params);
    rt_film_pixel pixel = plane[index];
    film_add(&pixel, radiance, points->film_weight, cut_off);
    plane[index] = pixel;
}

/*
 * Adds the film of a whole pass to a plane of the render's, so that this never holds a part of one,
 * and clears it for the next pass.
 */
KERNEL photon_join(uint pixels, uint plane, global rt_film_pixel *pass, global rt_film_pixel *film)
{
    const rt_film_pixel none = {{0, 0, 0}, {0, 0, 0}, 0u, 0, 0u, 0u};
    const uint item = item_number();
    if (item >= pixels)
        return;
    global rt_film_pixel *out = film + (size_t)plane * pixels + item;
    const rt_film_pixel more = pass[item];
    rt_film_pixel pixel = *out;
    film_join(&pixel, &more);
    *out = pixel;
    pass[item] = none;
}

/* The mean of a channel of a pass; what its sums hold is as film_add_bits has it. */
static float mean_of_pass(const rt_film_pixel *pixel, int channel, float divisor)
{
    /* The unit of the higher bin, 2^(32 (b + 1) - 149), is made of its bits. */
    const float unit = as_float((32u * film_bin(pixel->bins, channel) + 10u) << 23);
    return (convert_float(pixel->high[channel]) + convert_float(pixel->low[channel]) * 0x1p-32f) *
           unit / divisor;
}

static float3 means_of_pass(const rt_film_pixel *pixel)
{
    const float weight = (float)pixel->weight, count = (float)pixel->count;
    const float divisor = fabs(weight) >= 0.25f * count ? weight : count;
    return (float3)(mean_of_pass(pixel, 0, divisor), mean_of_pass(pixel, 1, divisor),
                    mean_of_pass(pixel, 2, divisor));
}

/* Adds a difference to a plane of moments; returns its square. */
static float add_difference_of(global rt_film_pixel *moment, float3 difference)
{
    rt_film_pixel sum = *moment;
    film_add(&sum, difference, 1.0f, 0.0f);
    *moment = sum;
    return dot(difference, difference);
}

/*
 * Adds the difference that larger discs make to a plane of moments; returns its square. Clears the
 * film of the larger discs.
 */
static float add_difference(global rt_film_pixel *moment, global rt_film_pixel *larger,
                            float3 value, uint count)
{
    const rt_film_pixel none = {{0, 0, 0}, {0, 0, 0}, 0u, 0, 0u, 0u};
    const rt_film_pixel pixel = *larger;
    *larger = none;
    return pixel.count == count ? add_difference_of(moment, means_of_pass(&pixel) - value) : 0.0f;
}

/*
 * Adds the film of a pass to the moments of passes (film/bias.h): the differences that discs of
 * twice and of four times the area make, and the squares of all. twice and four_times: the films of
 * these discs, empty where the pass is not measured, and from here on; moments: [3][pixels]
 */
KERNEL add_moments(uint pixels, global const rt_film_pixel *pass, global rt_film_pixel *twice,
                   global rt_film_pixel *four_times, global rt_film_pixel *moments)
{
    const uint item = item_number();
    if (item >= pixels || pass[item].count == 0u)
        return;
    const rt_film_pixel whole = pass[item];
    const float3 value = means_of_pass(&whole);
    moments += item;
    const float first = add_difference(moments, twice + item, value, whole.count),
                other = add_difference(moments + pixels, four_times + item, value, whole.count);
    rt_film_pixel squares = moments[2u * (size_t)pixels];
    film_add(&squares, (float3)(dot(value, value), first, other), 1.0f, 0.0f);
    moments[2u * (size_t)pixels] = squares;
}

/*
 * The same of an iteration of mode vcm, whose film is that of merging with whole discs. parts:
 * [pixels][2][3], what half and a quarter of them find more. The differences are those that half
 * and whole discs make to a quarter.
 */
KERNEL add_merge_moments(uint pixels, global const rt_film_pixel *pass, global const float *parts,
                         global rt_film_pixel *moments)
{
    const uint item = item_number();
    if (item >= pixels || pass[item].count == 0u)
        return;
    const rt_film_pixel whole = pass[item];
    const float3 value = means_of_pass(&whole);
    const float3 two = vload3(2u * (size_t)item, parts),
                 one = vload3(2u * (size_t)item + 1u, parts);
    float first = 0.0f, other = 0.0f;
    moments += item;
    if (all(isfinite(one + two))) {
        first = add_difference_of(moments, two - one);
        other = add_difference_of(moments + pixels, -one);
    }
    rt_film_pixel squares = moments[2u * (size_t)pixels];
    film_add(&squares, (float3)(dot(value, value), first, other), 1.0f, 0.0f);
    moments[2u * (size_t)pixels] = squares;
}

/*
 * Each work-item counts, of a run of discs, the queries, and those that found no photon: neither
 * here nor, with_others, in the other disc of the point. counts: two a run
 */
KERNEL count_queries(uint count, uint with_others, global const rt_gather_disc *discs,
                     global const rt_gather_disc *others, global uint *counts)
{
    const uint run = item_number();
    const uint begin = run * RT_SUM_RUN;
    if (begin >= count)
        return;
    const uint end = min(begin + RT_SUM_RUN, count);
    uint queries = 0u, empty = 0u;
    for (uint i = begin; i < end; i++) {
        const bool found = discs[i].count > 0u || (with_others && others[i].count > 0u);
        queries += discs[i].is_query;
        empty += discs[i].is_query && !found;
    }
    counts[2u * run] = queries;
    counts[2u * run + 1u] = empty;
}
