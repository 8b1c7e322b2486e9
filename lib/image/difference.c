/*
 * difference.c - rt_comparison_write_difference: the signed difference of two pictures, as numbers
 * or as colours.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/compare.h"
#include "image/image_file.h"
#include "image/srgb.h"

#define QUANTILE 0.95
#define BINS 65536u /* one for each upper half of a float: steps of a 128th */

/* The difference in the channel that differs most; NaN where one is not finite. */
static double largest(const float d[3])
{
    double found = 0.0;
    for (int c = 0; c < 3; c++) {
        if (!isfinite(d[c]))
            return NAN;
        if (fabs(d[c]) > fabs(found))
            found = d[c];
    }
    return found;
}

rt_status rt_typical_difference(double *out, const float *difference, size_t pixel_count,
                                rt_error *error)
{
    size_t *counts = calloc(BINS, sizeof *counts), below = 0, finite = 0;
    if (!counts)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: a histogram");
    /* The bits of positive floats are in the order of their values. */
    for (size_t i = 0; i < pixel_count; i++) {
        float size = (float)fabs(largest(difference + 3 * i));
        uint32_t bits;
        memcpy(&bits, &size, sizeof bits);
        if (isnan(size))
            continue;
        counts[bits >> 16]++;
        finite++;
    }
    uint32_t bin = 0;
    while (bin < BINS - 1 && (double)(below += counts[bin]) < QUANTILE * (double)finite)
        bin++;
    /* The upper end of the bin; where most pixels are equal, of the largest difference. */
    if (bin == 0)
        for (uint32_t i = 0; i < BINS; i++)
            bin = counts[i] ? i : bin;
    uint32_t bits = bin ? (bin << 16) + 0xffffu : 0;
    float value;
    memcpy(&value, &bits, sizeof value);
    *out = value;
    free(counts);
    return RT_OK;
}

/*
 * From white to red for a positive difference and to blue for a negative one, even steps of it in
 * even sRGB steps.
 */
static void colour_of(float rgb[3], double difference, double scale)
{
    double share = difference == 0.0 ? 0.0 : fmin(fabs(difference) / scale, 1.0);
    float faded = (float)rt_srgb_decode(1.0 - share);
    rgb[0] = difference > 0.0 ? 1.0f : faded;
    rgb[1] = faded;
    rgb[2] = difference < 0.0 ? 1.0f : faded;
    if (isnan(difference))
        rgb[0] = rgb[1] = rgb[2] = 0.0f;
}

rt_status rt_comparison_write_difference(const rt_comparison *comparison, const char *path,
                                         double scale, rt_error *error)
{
    if (rt_is_missing(comparison, "comparison", error))
        return RT_ERROR_USAGE;
    const rt_comparison_info *info = &comparison->info;
    rt_image_format format;
    rt_image *image = NULL;
    if (!isfinite(scale) || scale < 0.0)
        return rt_fail_field(error, RT_ERROR_USAGE, "scale",
                             "a difference of %g cannot be the full scale", scale);
    rt_status status = rt_image_format_of(&format, path, error);
    if (status == RT_OK)
        status =
            rt_image_from_rgb(&image, comparison->difference, info->width, info->height, error);
    if (status != RT_OK)
        return status;
    size_t pixel_count = (size_t)info->width * info->height;
    if (format == RT_IMAGE_PNG || format == RT_IMAGE_PPM)
        for (size_t i = 0; i < pixel_count; i++)
            colour_of(image->data + 3 * i, largest(comparison->difference + 3 * i),
                      scale > 0.0 ? scale : info->typical);
    status = rt_image_write(image, path, NULL, error);
    rt_image_destroy(image);
    return status;
}
