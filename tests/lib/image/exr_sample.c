/* exr_sample.c - writes OpenEXR files by OpenEXRCore. */
#include "exr_sample.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define CHECK(call) assert_int_equal(call, EXR_ERR_SUCCESS)

const char *const exr_sample_names[EXR_SAMPLE_CHANNELS] = {"R", "G", "B", "A", "Z", "u"};

static int channels_of(const exr_sample *sample)
{
    return sample->channels ? sample->channels : 3;
}

float exr_sample_value(int x, int y, int c)
{
    return (float)(1 + c + 6 * (x % 16) + 96 * (y % 16));
}

static int64_t on_write(exr_const_context_t context, void *user, const void *buffer, uint64_t size,
                        uint64_t offset, exr_stream_error_func_ptr_t fail)
{
    (void)context;
    (void)fail;
    return rt_bytes_put(user, offset, buffer, (size_t)size, NULL) == RT_OK ? (int64_t)size : -1;
}

static void add_part(exr_context_t context, const exr_sample *sample, const char *name)
{
    exr_attr_box2i_t window;
    exr_attr_v2f_t centre;
    int part;
    window.min.x = sample->x;
    window.min.y = sample->y;
    window.max.x = sample->x + sample->width - 1;
    window.max.y = sample->y + sample->height - 1;
    centre.x = centre.y = 0.0f;
    CHECK(exr_add_part(context, name, sample->storage, &part));
    CHECK(exr_initialize_required_attr(context, part, &window, &window, 1.0f, &centre, 1.0f,
                                       EXR_LINEORDER_INCREASING_Y, sample->compression));
    const int is_depth = name && strcmp(name, "depth") == 0;
    for (int c = is_depth ? 4 : 0; c < (is_depth ? 5 : channels_of(sample)); c++) {
        int sampling = c == 2 && sample->sampling ? sample->sampling : 1;
        CHECK(exr_add_channel(context, part, exr_sample_names[c], sample->type,
                              EXR_PERCEPTUALLY_LINEAR, sampling, sampling));
    }
    if (sample->storage == EXR_STORAGE_TILED)
        CHECK(exr_set_tile_descriptor(context, part, (uint32_t)sample->tile, (uint32_t)sample->tile,
                                      EXR_TILE_ONE_LEVEL, EXR_TILE_ROUND_DOWN));
}

typedef struct compressor {
    exr_result_t (*run)(exr_encode_pipeline_t *pipeline);
} compressor;

/* Stores what is not smaller compressed as it is, as OpenEXR does, and OpenEXRCore does not. */
static exr_result_t compress(exr_encode_pipeline_t *pipeline)
{
    const compressor *chosen = pipeline->encoding_user_data;
    const exr_result_t code = chosen->run(pipeline);
    if (code == EXR_ERR_SUCCESS && pipeline->compressed_bytes >= pipeline->packed_bytes) {
        memcpy(pipeline->compressed_buffer, pipeline->packed_buffer, pipeline->packed_bytes);
        pipeline->compressed_bytes = pipeline->packed_bytes;
    }
    return code;
}

/* Encodes the chunk whose first pixel is (x, y) of the data window of a part. */
static void write_chunk(exr_context_t context, int part, const exr_sample *sample,
                        const exr_chunk_info_t *chunk, int x, int y)
{
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    size_t pixel_count = (size_t)chunk->width * (size_t)chunk->height;
    const size_t count = (size_t)channels_of(sample) * pixel_count;
    float *planes = malloc(count * sizeof *planes);
    uint32_t *whole = malloc(count * sizeof *whole);
    assert_true(planes && whole);
    CHECK(exr_encoding_initialize(context, part, chunk, &pipeline));
    for (int i = 0; i < pipeline.channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline.channels[i];
        int c = 0;
        while (strcmp(exr_sample_names[c], channel->channel_name) != 0)
            c++;
        size_t at = (size_t)i * pixel_count;
        for (size_t p = 0; p < pixel_count; p++) {
            int column = (int)(p % (size_t)chunk->width), row = (int)(p / (size_t)chunk->width);
            planes[at + p] = (float)(part + 1) * exr_sample_value(x + column, y + row, c);
            whole[at + p] = (uint32_t)planes[at + p];
        }
        int is_whole = sample->type == EXR_PIXEL_UINT;
        channel->user_data_type = is_whole ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = 4;
        channel->user_pixel_stride = 4;
        channel->user_line_stride = 4 * chunk->width;
        channel->encode_from_ptr =
            is_whole ? (const uint8_t *)(whole + at) : (const uint8_t *)(planes + at);
    }
    CHECK(exr_encoding_choose_default_routines(context, part, &pipeline));
    compressor chosen = {pipeline.compress_fn};
    if (chosen.run) {
        pipeline.encoding_user_data = &chosen;
        pipeline.compress_fn = compress;
    }
    CHECK(exr_encoding_run(context, part, &pipeline));
    CHECK(exr_encoding_destroy(context, &pipeline));
    free(whole);
    free(planes);
}

static void write_scanlines(exr_context_t context, int part, const exr_sample *sample)
{
    int lines;
    exr_chunk_info_t chunk;
    CHECK(exr_get_scanlines_per_chunk(context, part, &lines));
    for (int y = 0; y < sample->height; y += lines) {
        CHECK(exr_write_scanline_chunk_info(context, part, sample->y + y, &chunk));
        write_chunk(context, part, sample, &chunk, 0, y);
    }
}

static void write_tiles(exr_context_t context, int part, const exr_sample *sample)
{
    exr_chunk_info_t chunk;
    for (int j = 0; j * sample->tile < sample->height; j++)
        for (int i = 0; i * sample->tile < sample->width; i++) {
            CHECK(exr_write_tile_chunk_info(context, part, i, j, 0, 0, &chunk));
            write_chunk(context, part, sample, &chunk, i * sample->tile, j * sample->tile);
        }
}

rt_bytes exr_sample_parts(const exr_sample *sample, const char *const *names, int count)
{
    rt_bytes bytes = {0};
    exr_context_t context = NULL;
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.user_data = &bytes;
    start.write_fn = on_write;
    CHECK(exr_start_write(&context, "(sample)", EXR_WRITE_FILE_DIRECTLY, &start));
    for (int part = 0; part < count; part++)
        add_part(context, sample, names[part]);
    CHECK(exr_write_header(context));
    for (int part = 0; part < count; part++)
        if (!sample->sampling && sample->storage == EXR_STORAGE_SCANLINE)
            write_scanlines(context, part, sample);
        else if (sample->storage == EXR_STORAGE_TILED)
            write_tiles(context, part, sample);
    CHECK(exr_finish(&context));
    return bytes;
}

rt_bytes exr_sample_file(const exr_sample *sample)
{
    return exr_sample_parts(sample, &(const char *){NULL}, 1);
}
