/* ppm_write.c - encodes binary PPM. */
#include <stdio.h>
#include <stdlib.h>

#include "image/display.h"
#include "image/netpbm.h"

rt_status rt_ppm_encode(rt_bytes *out, const rt_image *image, const rt_image_options *options,
                        rt_error *error)
{
    uint8_t *rgb8 = NULL;
    rt_status status = rt_display_rgb8(&rgb8, image, options, error);
    if (status != RT_OK)
        return status;
    char header[64];
    int length = snprintf(header, sizeof header, "P6\n%u %u\n255\n", image->width, image->height);
    rt_bytes bytes = {0};
    status = rt_bytes_put(&bytes, 0, header, (size_t)length, error);
    if (status == RT_OK)
        status =
            rt_bytes_put(&bytes, bytes.size, rgb8, (size_t)image->width * image->height * 3, error);
    free(rgb8);
    if (status == RT_OK)
        *out = bytes;
    else
        rt_bytes_free(&bytes);
    return status;
}
