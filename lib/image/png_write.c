/* png_write.c - encodes PNG by libpng. */
#include "image/png.h"

#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>

#include "image/display.h"

/* What the callbacks of libpng share. */
typedef struct sink {
    rt_bytes bytes;
    rt_error error;
} sink;

static void on_error(png_structp png, png_const_charp message)
{
    sink *s = png_get_error_ptr(png);
    if (s->error.status == RT_OK)
        rt_fail(&s->error, RT_ERROR_OUTPUT, "cannot encode PNG: %s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void on_write(png_structp png, png_bytep data, size_t count)
{
    sink *s = png_get_io_ptr(png);
    if (rt_bytes_put(&s->bytes, s->bytes.size, data, count, &s->error) != RT_OK)
        png_error(png, s->error.message);
}

static void on_flush(png_structp png)
{
    (void)png;
}

/*
 * Runs libpng, which leaves by longjmp when it fails. Everything that must be freed belongs to the
 * caller, and no local variable changes after setjmp, so nothing leaks or is lost.
 */
static int encode(png_structp png, png_infop info, const uint8_t *rgb8, uint32_t width,
                  uint32_t height)
{
    if (setjmp(png_jmpbuf(png)))
        return 0;
    png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    for (uint32_t y = 0; y < height; y++)
        png_write_row(png, rgb8 + (size_t)y * width * 3);
    png_write_end(png, info);
    return 1;
}

rt_status rt_png_encode(rt_bytes *out, const rt_image *image, const rt_image_options *options,
                        rt_error *error)
{
    uint8_t *rgb8 = NULL;
    rt_status status = rt_display_rgb8(&rgb8, image, options, error);
    if (status != RT_OK)
        return status;

    sink s = {{0}, {0}};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &s, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        status = rt_fail(error, RT_ERROR_MEMORY, "out of memory: a PNG encoder");
    } else {
        png_set_write_fn(png, &s, on_write, on_flush);
        if (!encode(png, info, rgb8, image->width, image->height))
            status = rt_fail(error, s.error.status, "%s", s.error.message);
    }
    png_destroy_write_struct(&png, &info);
    free(rgb8);
    if (status == RT_OK)
        *out = s.bytes;
    else
        rt_bytes_free(&s.bytes);
    return status;
}
