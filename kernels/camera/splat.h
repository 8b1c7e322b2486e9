/*
 * splat.h - the pixel that gets the light of a path that arrives at a point of the film: the
 * adjoint of filter importance sampling.
 *
 * A pixel with its centre at c takes samples of density p(x - c), which is |f| over its integral,
 * with the weight sign(f): see filter.h. Light that arrives at x is worth as much to each pixel:
 * p(x - c) sign f(x - c). One pixel is chosen with a probability proportional to p, and gets the
 * sum of p over all that could have been, with the sign. Filters are products of one function of
 * each coordinate, so that column and row are chosen by themselves; the Gaussian ends at a circle,
 * beyond which the pixel gets nothing.
 *
 * Samples are placed beyond the edge of the film, and so is light counted there. A film of all
 * directions goes on at its other edge, and beyond a pole on the opposite meridian.
 */
#ifndef RT_KERNELS_CAMERA_SPLAT_H
#define RT_KERNELS_CAMERA_SPLAT_H

#include "camera/filter.h"

/* How a filter that is not the box is stretched, and where it ends, pixels. */
static inline float filter_stretch(uint filter, float radius, float *reach)
{
    const float own = filter == RT_FILTER_TENT       ? RT_TENT_RADIUS
                      : filter == RT_FILTER_GAUSSIAN ? RT_GAUSSIAN_RADIUS
                                                     : RT_MITCHELL_RADIUS;
    *reach = radius > 0.0f ? radius : own;
    return *reach / own;
}

/* Mitchell's filter in one dimension (equation 8, B = C = 1/3), over its magnitude's integral. */
static inline float mitchell_density(float x)
{
    const float a = fabs(x);
    const float near = (16.0f + a * a * (21.0f * a - 36.0f)) * (1.0f / 18.0f);
    const float far = (32.0f + a * (-60.0f + a * (36.0f - 7.0f * a))) * (1.0f / 18.0f);
    return (a < 1.0f ? near : a < 2.0f ? far : 0.0f) * (1.0f / RT_MITCHELL_SIZE);
}

/* The density of samples along a coordinate, in pixels, with the sign of the filter there. */
static inline float filter_density(uint filter, float stretch, float x)
{
    const float own = x / stretch;
    float density = 0.0f;
    switch ((rt_filter)filter) {
    case RT_FILTER_BOX:
        break; /* has no use for it */
    case RT_FILTER_TENT:
        density = fmax(1.0f - fabs(own), 0.0f);
        break;
    case RT_FILTER_GAUSSIAN:
        density = exp(-0.5f * square(own / RT_GAUSSIAN_DEVIATION)) /
                  (RT_GAUSSIAN_DEVIATION * sqrt(2.0f * RT_PI * RT_GAUSSIAN_CUT));
        break;
    case RT_FILTER_MITCHELL:
        density = mitchell_density(own);
        break;
    }
    return density / stretch;
}

/* Chooses one of the pixels first to last of a row or column; 0: none. See above for the rest. */
static inline float choose_pixel(uint filter, float stretch, float x, int first, int last, float u,
                                 int *pixel)
{
    float sum = 0.0f, passed = 0.0f, density = 0.0f;
    for (int i = first; i <= last; i++)
        sum += fabs(filter_density(filter, stretch, x - (float)i - 0.5f));
    for (int i = first; i <= last && !(passed > u * sum); i++) {
        density = filter_density(filter, stretch, x - (float)i - 0.5f);
        passed += fabs(density);
        *pixel = i;
    }
    return density < 0.0f ? -sum : sum;
}

/*
 * The pixel of a point of a film of size pixels, by two numbers in [0,1), and what it gets of light
 * that arrives there; 0: nothing.
 */
static inline float splat_pixel(global const rt_camera_data *camera, int2 size, float2 raster,
                                float2 u, uint *pixel)
{
    const bool around = camera->kind == RT_CAMERA_KIND_ENVIRONMENT;
    const uint filter = camera->filter;
    float reach;
    if (filter == RT_FILTER_BOX) {
        const int2 at = min(convert_int2(raster), size - 1);
        *pixel = (uint)(at.y * size.x + at.x);
        return all(raster >= 0.0f) && all(raster < convert_float2(size)) ? 1.0f : 0.0f;
    }
    const float stretch = filter_stretch(filter, camera->filter_radius, &reach);
    if (!(all(raster > -reach) && all(raster < convert_float2(size) + reach)))
        return 0.0f;

    /* The row, which beyond a pole is one of the opposite meridian. */
    int2 first = convert_int2(ceil(raster - 0.5f - reach));
    int2 last = convert_int2(floor(raster - 0.5f + reach));
    int2 at = (int2)(0);
    int row = 0, column = 0;
    if (!around) {
        first = max(first, 0);
        last = min(last, size - 1);
    }
    float value = choose_pixel(filter, stretch, raster.y, first.y, last.y, u.y, &row);
    float x = raster.x;
    at.y = around ? (row % (2 * size.y) + 2 * size.y) % (2 * size.y) : row;
    if (at.y >= size.y) {
        at.y = 2 * size.y - 1 - at.y;
        x += 0.5f * (float)size.x;
        first.x = (int)ceil(x - 0.5f - reach);
        last.x = (int)floor(x - 0.5f + reach);
    }

    /* The column, and nothing beyond the Gaussian's circle. */
    value *= choose_pixel(filter, stretch, x, first.x, last.x, u.x, &column);
    at.x = around ? (column % size.x + size.x) % size.x : column;
    *pixel = (uint)(at.y * size.x + at.x);
    const float2 off = (float2)(x - (float)column, raster.y - (float)row) - 0.5f;
    return filter == RT_FILTER_GAUSSIAN && dot(off, off) >= square(reach) ? 0.0f : value;
}

/*
 * What the film's weights take away from light that is added without samples: the integral of |f|
 * over that of f, for samples that all have the weight 1.
 */
static inline float splat_scale(uint filter)
{
    return filter == RT_FILTER_MITCHELL ? square(RT_MITCHELL_SIZE) : 1.0f;
}

#endif
