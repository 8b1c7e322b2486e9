/*
 * film.h - which pixel a work-item has, and how samples are summed in it.
 */
#ifndef RT_KERNELS_CAMERA_FILM_H
#define RT_KERNELS_CAMERA_FILM_H

#include "camera/film_sum.h"
#include "math/frame.h"
#include "types.h"

#define RT_TILE 8u

/*
 * The pixel of an item: films are traversed in tiles of 8 x 8, row by row of tiles, and row by row
 * within a tile, so that neighbours in a work-group see the same part of the scene. Tiles at the
 * right and bottom edges are cut off by the film.
 */
static inline uint2 pixel_of_item(const rt_params *params, uint item)
{
    const uint band_items = params->width * RT_TILE;
    const uint top = item / band_items * RT_TILE;
    const uint tile_height = min(RT_TILE, params->height - top);
    const uint in_band = item % band_items;
    const uint left = in_band / (RT_TILE * tile_height) * RT_TILE;
    const uint tile_width = min(RT_TILE, params->width - left);
    const uint in_tile = in_band - left * tile_height;
    return (uint2)(left + in_tile % tile_width, top + in_tile / tile_width);
}

/*
 * The samples of a sequence of this pixel where pixels have `length` on average. rates: of each
 * pixel, in 1 / RT_RATE_UNIT; not read without params->pilot.
 */
static inline uint samples_at(const rt_params *params, global const uint *rates, uint index,
                              uint length)
{
    const uint pilot = params->pilot;
    if (pilot == 0u || length <= pilot)
        return length;
    const ulong more = (ulong)(length - pilot) * rates[index];
    return pilot + (uint)((more + RT_RATE_UNIT / 2u) / RT_RATE_UNIT);
}

/*
 * Adds a sample, of weight 1 or -1, and the throughput that max_depth cut off from it. A sample
 * that is not finite is left out and counted as rejected.
 */
static inline void film_add(rt_film_pixel *pixel, float3 radiance, float weight, float cut_off)
{
    if (!all(isfinite(radiance))) {
        film_reject(pixel, 1u);
        return;
    }
    const film_sums sums = film_sums_of(pixel);
    film_add_bits(sums, 0, as_uint(weight * radiance.x));
    film_add_bits(sums, 1, as_uint(weight * radiance.y));
    film_add_bits(sums, 2, as_uint(weight * radiance.z));
    pixel->weight += weight < 0.0f ? -1 : 1;
    pixel->cut_off =
        film_add_saturated(pixel->cut_off, convert_uint_sat_rte(cut_off / RT_FILM_CUT_OFF));
    pixel->count++;
}

/* The plane of the film that a launch adds to. */
static inline global rt_film_pixel *film_plane(global rt_film_pixel *film, const rt_params *params)
{
    return film + (size_t)params->plane * params->width * params->height;
}

#endif
