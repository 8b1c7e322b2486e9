/*
 * film.h - which pixel a work-item has, and how samples are summed in it.
 */
#ifndef RT_KERNELS_CAMERA_FILM_H
#define RT_KERNELS_CAMERA_FILM_H

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
 * Adds a sample, of weight 1 or -1, and the throughput that max_depth cut off from it. Rounding
 * errors are compensated (Kahan, "Further remarks on reducing truncation errors", CACM 8(1), 1965),
 * and samples are added in their order, so the film does not depend on how they are divided into
 * launches. A sample that is not finite is left out and counted as rejected.
 */
static inline void film_add(rt_film_pixel *pixel, float3 radiance, float weight, float cut_off)
{
#pragma OPENCL FP_CONTRACT OFF
    const bool is_finite = all(isfinite(radiance));
    pixel->rejected += is_finite ? 0u : 1u;
    if (!is_finite)
        return;
    const float value[3] = {weight * radiance.x, weight * radiance.y, weight * radiance.z};
    for (int i = 0; i < 3; i++) {
        const float term = value[i] - pixel->lost[i];
        const float sum = pixel->sum[i] + term;
        pixel->lost[i] = (sum - pixel->sum[i]) - term;
        pixel->sum[i] = sum;
    }
    pixel->weight += weight;
    pixel->cut_off += cut_off;
    pixel->count++;
}

#endif
