/* jpeg_sample.c - JPEG files of all kinds, by libjpeg's encoder. */
#include "jpeg_sample.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>
#include <jpeglib.h>

int jpeg_sample_channels(jpeg_colours colours)
{
    switch (colours) {
    case JPEG_GREY:
        return 1;
    case JPEG_PAIR:
        return 2;
    case JPEG_CMYK:
    case JPEG_YCCK:
        return 4;
    case JPEG_YCBCR:
    case JPEG_420:
    case JPEG_RGB:
        break;
    }
    return 3;
}

uint8_t jpeg_sample_code(uint32_t x, uint32_t y, int channel)
{
    const uint32_t parts[4] = {40 + 2 * x + y, 200 - x - 2 * y, 90 + x + y, 60 + y};
    return (uint8_t)(parts[channel] % 256);
}

static void choose(struct jpeg_compress_struct *jpeg, const jpeg_sample *sample)
{
    static const J_COLOR_SPACE in[] = {JCS_GRAYSCALE, JCS_RGB,  JCS_RGB,    JCS_RGB,
                                       JCS_CMYK,      JCS_CMYK, JCS_UNKNOWN};
    static const J_COLOR_SPACE file[] = {JCS_GRAYSCALE, JCS_YCbCr, JCS_YCbCr,  JCS_RGB,
                                         JCS_CMYK,      JCS_YCCK,  JCS_UNKNOWN};
    jpeg->image_width = sample->width;
    jpeg->image_height = sample->height;
    jpeg->input_components = jpeg_sample_channels(sample->colours);
    jpeg->in_color_space = in[sample->colours];
    jpeg_set_defaults(jpeg);
    jpeg_set_colorspace(jpeg, file[sample->colours]);
    jpeg_set_quality(jpeg, 100, TRUE);
    jpeg->comp_info[0].h_samp_factor = sample->colours == JPEG_420 ? 2 : 1;
    jpeg->comp_info[0].v_samp_factor = sample->colours == JPEG_420 ? 2 : 1;
    jpeg->arith_code = sample->is_arithmetic ? TRUE : FALSE;
    jpeg->restart_interval = (unsigned)sample->restart;
    if (sample->is_progressive)
        jpeg_simple_progression(jpeg);
}

rt_bytes jpeg_sample_file(const jpeg_sample *sample)
{
    static const jpeg_scan_info apart[3] = {
        {1, {0}, 0, 63, 0, 0}, {1, {1}, 0, 63, 0, 0}, {1, {2}, 0, 63, 0, 0}};
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    const int channels = jpeg_sample_channels(sample->colours);
    unsigned char *made = NULL;
    unsigned long size = 0;
    uint8_t *row = malloc((size_t)sample->width * (size_t)channels);
    rt_bytes file = {0};
    assert_non_null(row);
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &made, &size);
    choose(&jpeg, sample);
    if (sample->is_apart) {
        jpeg.scan_info = apart;
        jpeg.num_scans = channels;
    }
    jpeg_start_compress(&jpeg, TRUE);
    for (uint32_t y = 0; y < sample->height; y++) {
        for (uint32_t x = 0; x < sample->width; x++)
            for (int c = 0; c < channels; c++)
                row[x * (uint32_t)channels + (uint32_t)c] = jpeg_sample_code(x, y, c);
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    assert_int_equal(rt_bytes_put(&file, 0, made, size, NULL), RT_OK);
    free(made);
    free(row);
    return file;
}
