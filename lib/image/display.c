/*
 * References:
 * E. Reinhard, M. Stark, P. Shirley, J. Ferwerda, "Photographic Tone Reproduction for Digital
 *   Images", SIGGRAPH 2002, equation 3.
 * K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016, a rational fit of the ACES reference
 *   rendering and output device transforms.
 */
#include "image/display.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "image/srgb.h"

static double sanitise(double value)
{
    if (!(value > 0.0))
        return 0.0;
    return value < FLT_MAX ? value : FLT_MAX;
}

/* Scales the colour so that its luminance L becomes L / (1 + L); the hue stays. */
static void reinhard(double rgb[3])
{
    double luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    for (int c = 0; c < 3; c++)
        rgb[c] /= 1.0 + luminance;
}

static void aces(double rgb[3])
{
    for (int c = 0; c < 3; c++) {
        double x = rgb[c];
        rgb[c] = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    }
}

static rt_status check_options(const rt_image_options *options, rt_error *error)
{
    if (!isfinite(options->exposure))
        return rt_fail_field(error, RT_ERROR_USAGE, "exposure",
                             "the exposure is not a finite number");
    if (options->tonemap != RT_TONEMAP_NONE && options->tonemap != RT_TONEMAP_REINHARD &&
        options->tonemap != RT_TONEMAP_ACES)
        return rt_fail_field(error, RT_ERROR_USAGE, "tonemap", "%d is no tone map",
                             (int)options->tonemap);
    return RT_OK;
}

rt_status rt_display_rgb8(uint8_t **out, const rt_image *image, const rt_image_options *options,
                          rt_error *error)
{
    uint32_t channels[3];
    rt_status status = check_options(options, error);
    if (status == RT_OK)
        status = rt_image_rgb_channels(channels, image, error);
    if (status != RT_OK)
        return status;
    size_t pixel_count = (size_t)image->width * image->height;
    uint8_t *rgb8 = pixel_count <= SIZE_MAX / 3 ? malloc(3 * pixel_count) : NULL;
    if (!rgb8)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: a picture of %ux%u pixels",
                       image->width, image->height);

    double scale = exp2(options->exposure);
    for (size_t i = 0; i < pixel_count; i++) {
        const float *pixel = image->data + i * image->channel_count;
        double rgb[3];
        for (int c = 0; c < 3; c++)
            rgb[c] = sanitise(scale * pixel[channels[c]]);
        if (options->tonemap == RT_TONEMAP_REINHARD)
            reinhard(rgb);
        else if (options->tonemap == RT_TONEMAP_ACES)
            aces(rgb);
        for (int c = 0; c < 3; c++)
            rgb8[3 * i + c] = rt_srgb_quantise(rgb[c]);
    }
    *out = rgb8;
    return RT_OK;
}
