/* exr_write.c - encodes OpenEXR by scan lines. */
#include "image/exr.h"

#include <string.h>

#include "image/exr_core.h"

#define SHORT_NAME_MAX 31u /* longest name in a file without the long-names flag */
#define ZIP_LEVEL 4        /* stated, so that the bytes do not depend on a process-wide default */

/* What the callbacks of a write context share. */
typedef struct sink {
    rt_exr_message message; /* first, as rt_exr_on_error expects */
    rt_bytes bytes;
    int lacks_memory;
} sink;

/*
 * OpenEXRCore holds its lock meanwhile. `fail` would come to rt_exr_on_error, which asks for the
 * user data, and with that for the lock: so what failed is noted here.
 */
static int64_t on_write(exr_const_context_t context, void *user, const void *buffer, uint64_t size,
                        uint64_t offset, exr_stream_error_func_ptr_t fail)
{
    sink *s = user;
    (void)context;
    (void)fail;
    if (size <= SIZE_MAX && rt_bytes_put(&s->bytes, offset, buffer, (size_t)size, NULL) == RT_OK)
        return (int64_t)size;
    s->lacks_memory = 1;
    return -1;
}

static int needs_long_names(const rt_image *image)
{
    for (uint32_t i = 0; i < image->channel_count; i++)
        if (strlen(image->names[i]) > SHORT_NAME_MAX)
            return 1;
    for (size_t i = 0; i < image->attribute_count; i++)
        if (strlen(image->attributes[i].name) > SHORT_NAME_MAX)
            return 1;
    return 0;
}

static exr_result_t write_header(exr_context_t context, const rt_image *image)
{
    int part = 0;
    exr_result_t code = exr_set_longname_support(context, needs_long_names(image));
    if (code == EXR_ERR_SUCCESS)
        code = exr_add_part(context, NULL, EXR_STORAGE_SCANLINE, &part);
    if (code == EXR_ERR_SUCCESS)
        code = exr_initialize_required_attr_simple(context, part, (int32_t)image->width,
                                                   (int32_t)image->height, EXR_COMPRESSION_ZIP);
    for (uint32_t i = 0; code == EXR_ERR_SUCCESS && i < image->channel_count; i++)
        code = exr_add_channel(context, part, image->names[i], EXR_PIXEL_FLOAT,
                               EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    for (size_t i = 0; code == EXR_ERR_SUCCESS && i < image->attribute_count; i++)
        code = exr_attr_set_string(context, part, image->attributes[i].name,
                                   image->attributes[i].value);
    return code == EXR_ERR_SUCCESS ? exr_write_header(context) : code;
}

/*
 * Points every channel of the pipeline to row y of the image. The library sorts channels by
 * name, so each is found by its name and never by its place.
 */
static exr_result_t bind_channels(exr_encode_pipeline_t *pipeline, const rt_image *image,
                                  uint32_t y)
{
    const float *row = image->data + (size_t)y * image->width * image->channel_count;
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        const uint32_t index = rt_image_channel(image, channel->channel_name);
        if (index == RT_IMAGE_NO_CHANNEL)
            return EXR_ERR_INVALID_ARGUMENT;
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_pixel_stride = (int32_t)(image->channel_count * sizeof(float));
        channel->user_line_stride = (int32_t)(image->width * image->channel_count * sizeof(float));
        channel->encode_from_ptr = (const uint8_t *)(row + index);
    }
    return EXR_ERR_SUCCESS;
}

typedef struct compressor {
    exr_result_t (*run)(exr_encode_pipeline_t *pipeline);
} compressor;

/*
 * The compression that OpenEXRCore chose, and with one of its faults corrected: where the result is
 * exactly as long as the pixels, the pixels are stored instead, because to a reader equal lengths
 * mean that a chunk is not compressed.
 */
static exr_result_t compress(exr_encode_pipeline_t *pipeline)
{
    const compressor *chosen = pipeline->encoding_user_data;
    exr_result_t code = chosen->run(pipeline);
    if (code == EXR_ERR_SUCCESS && pipeline->compressed_bytes == pipeline->packed_bytes)
        memcpy(pipeline->compressed_buffer, pipeline->packed_buffer, pipeline->packed_bytes);
    return code;
}

static exr_result_t write_chunk(exr_context_t context, exr_encode_pipeline_t *pipeline,
                                const rt_image *image, uint32_t y, compressor *chosen)
{
    exr_chunk_info_t chunk;
    exr_result_t code = exr_write_scanline_chunk_info(context, 0, (int)y, &chunk);
    if (code == EXR_ERR_SUCCESS)
        code = y == 0 ? exr_encoding_initialize(context, 0, &chunk, pipeline)
                      : exr_encoding_update(context, 0, &chunk, pipeline);
    if (code == EXR_ERR_SUCCESS)
        code = bind_channels(pipeline, image, y);
    if (code == EXR_ERR_SUCCESS && y == 0) {
        code = exr_encoding_choose_default_routines(context, 0, pipeline);
        chosen->run = pipeline->compress_fn;
        pipeline->compress_fn = chosen->run ? compress : NULL;
    }
    pipeline->encoding_user_data = chosen;
    return code == EXR_ERR_SUCCESS ? exr_encoding_run(context, 0, pipeline) : code;
}

static exr_result_t write_pixels(exr_context_t context, const rt_image *image)
{
    int32_t lines = 0;
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    compressor chosen = {NULL};
    exr_result_t code = exr_get_scanlines_per_chunk(context, 0, &lines);
    for (uint32_t y = 0; code == EXR_ERR_SUCCESS && y < image->height; y += (uint32_t)lines)
        code = write_chunk(context, &pipeline, image, y, &chosen);
    exr_encoding_destroy(context, &pipeline);
    return code;
}

rt_status rt_exr_encode(rt_bytes *out, const rt_image *image, rt_error *error)
{
    sink s = {{{0}}, {0}, 0};
    exr_context_t context = NULL;
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.error_handler_fn = rt_exr_on_error;
    start.user_data = &s;
    start.write_fn = on_write;
    start.zip_level = ZIP_LEVEL;

    exr_result_t code = exr_start_write(&context, "(memory)", EXR_WRITE_FILE_DIRECTLY, &start);
    if (code == EXR_ERR_SUCCESS)
        code = write_header(context, image);
    if (code == EXR_ERR_SUCCESS)
        code = write_pixels(context, image);
    /* Finishing writes the table of chunk offsets, so it can fail like any write. */
    exr_result_t finish_code = context ? exr_finish(&context) : EXR_ERR_SUCCESS;
    if (code == EXR_ERR_SUCCESS)
        code = finish_code;

    if (code == EXR_ERR_SUCCESS) {
        *out = s.bytes;
        return RT_OK;
    }
    rt_bytes_free(&s.bytes);
    if (s.lacks_memory)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for an EXR file");
    return rt_fail(error, code == EXR_ERR_OUT_OF_MEMORY ? RT_ERROR_MEMORY : RT_ERROR_OUTPUT,
                   "cannot encode EXR: %s", rt_exr_reason(&s.message, code));
}
