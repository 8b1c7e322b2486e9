/* exr_read.c - decodes OpenEXR: attributes, scan lines, tiles, and the display window. */
#include "image/decode.h"
#include "image/exr.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/exr_core.h"

/* What the callbacks of a read context share. */
typedef struct source {
    rt_exr_message message; /* first, as rt_exr_on_error expects */
    const rt_bytes *file;
    uint64_t values; /* of all parts whose header is good, in the larger of their windows */
    uint32_t channels;
} source;

/* A part of a file being decoded. */
typedef struct reader {
    exr_context_t context;
    int part;
    const char *name;
    exr_attr_box2i_t window, display; /* of the pixels that it holds, and of the picture */
    const exr_attr_chlist_t *channels;
    const rt_image *first; /* the picture, whose size other parts must have; NULL for itself */
    rt_image *image;
    float *planes;   /* the values of a chunk, one channel after the other */
    uint64_t pixels; /* that they have room for */
    exr_result_t (*decompress)(exr_decode_pipeline_t *pipeline); /* what OpenEXRCore chose */
} reader;

static int64_t on_read(exr_const_context_t context, void *user, void *buffer, uint64_t size,
                       uint64_t offset, exr_stream_error_func_ptr_t fail)
{
    const rt_bytes *file = ((source *)user)->file;
    if (offset > file->size) {
        fail(context, EXR_ERR_READ_IO, "a read starts past the end of the file");
        return -1;
    }
    size_t count = file->size - (size_t)offset;
    if (count > size)
        count = (size_t)size;
    if (count > 0)
        memcpy(buffer, file->data + offset, count);
    return (int64_t)count;
}

static int64_t on_size(exr_const_context_t context, void *user)
{
    (void)context;
    return (int64_t)((source *)user)->file->size;
}

static rt_status fail_input(const reader *r, const char *what, rt_error *error)
{
    return rt_fail(error, RT_ERROR_INPUT, "cannot read %.350s: %s", r->name, what);
}

static int64_t width_of(const exr_attr_box2i_t *box)
{
    return (int64_t)box->max.x - box->min.x + 1;
}

static int64_t height_of(const exr_attr_box2i_t *box)
{
    return (int64_t)box->max.y - box->min.y + 1;
}

static uint64_t values_of(const reader *r, const exr_attr_box2i_t *box)
{
    return (uint64_t)(width_of(box) * height_of(box)) * (uint64_t)r->channels->num_channels;
}

/* Checks one of the windows, of which an image is made beside those of other parts. */
static rt_status check_window(const reader *r, const exr_attr_box2i_t *box, const char *name,
                              const source *s, rt_error *error)
{
    const int64_t width = width_of(box), height = height_of(box);
    char what[96];
    snprintf(what, sizeof what, "the %s window is empty or too large", name);
    if (width < 1 || height < 1 || width > RT_IMAGE_SIDE_MAX || height > RT_IMAGE_SIDE_MAX)
        return fail_input(r, what, error);
    const uint64_t values = values_of(r, box) + s->values;
    if (values > RT_IMAGE_VALUES_MAX)
        return fail_input(r, "it holds more than 2^30 values", error);
    if (rt_image_is_bomb(values, s->file->size))
        return fail_input(r, "it is too large for its length: more than 64 values a byte", error);
    return RT_OK;
}

/*
 * Whether OpenEXRCore puts pixels in wrong places: B44 leaves channels that are no half floats as
 * they are, and their lines are taken for those of unpacked chunks.
 */
static int scrambles(const reader *r)
{
    exr_compression_t codec = EXR_COMPRESSION_NONE;
    exr_get_compression(r->context, r->part, &codec);
    if (codec != EXR_COMPRESSION_B44 && codec != EXR_COMPRESSION_B44A)
        return 0;
    for (int i = 0; i < r->channels->num_channels; i++)
        if (r->channels->entries[i].pixel_type != EXR_PIXEL_HALF)
            return 1;
    return 0;
}

/* Checks what the header promises before anything is allocated for it. */
static rt_status check_header(reader *r, const source *s, exr_storage_t *storage, rt_error *error)
{
    if (exr_get_storage(r->context, r->part, storage) != EXR_ERR_SUCCESS ||
        exr_get_data_window(r->context, r->part, &r->window) != EXR_ERR_SUCCESS ||
        exr_get_display_window(r->context, r->part, &r->display) != EXR_ERR_SUCCESS ||
        exr_get_channels(r->context, r->part, &r->channels) != EXR_ERR_SUCCESS)
        return fail_input(r, "the header is incomplete", error);
    if (*storage != EXR_STORAGE_SCANLINE && *storage != EXR_STORAGE_TILED)
        return fail_input(
            r,
            "deep images are not supported: convert it, as by `oiiotool FILE --flatten "
            "-o NEW.exr`",
            error);

    const int64_t count = r->channels->num_channels;
    if (count < 1 || count > RT_IMAGE_CHANNELS_MAX - s->channels)
        return fail_input(r, "it has no channels or too many", error);
    for (int i = 0; i < count; i++)
        if (r->channels->entries[i].x_sampling != 1 || r->channels->entries[i].y_sampling != 1 ||
            strcmp(r->channels->entries[i].name.str, "RY") == 0)
            return fail_input(r,
                              "channels of luminance and chroma, or subsampled, are not supported: "
                              "write it as R, G and B",
                              error);
    if (scrambles(r))
        return fail_input(r,
                          "its compression, B44, is not read for channels that are no half floats: "
                          "convert it, as by `oiiotool FILE --compression zip -o NEW.exr`",
                          error);
    if (r->first &&
        (width_of(&r->display) != r->first->width || height_of(&r->display) != r->first->height))
        return fail_input(r, "a part is of another size", error);
    const rt_status status = check_window(r, &r->window, "data", s, error);
    return status == RT_OK ? check_window(r, &r->display, "display", s, error) : status;
}

/* An image of the size of a window, of all channels. */
static rt_status create_image(rt_image **out, const reader *r, const exr_attr_box2i_t *box,
                              const rt_bytes *file, rt_error *error)
{
    uint32_t count = (uint32_t)r->channels->num_channels;
    const char **names = malloc(count * sizeof *names);
    if (!names)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: %u channels", count);
    for (uint32_t i = 0; i < count; i++)
        names[i] = r->channels->entries[i].name.str;
    rt_error why;
    rt_status status = rt_image_create_in(out, file->memory, (uint32_t)width_of(box),
                                          (uint32_t)height_of(box), names, count, &why);
    free(names);
    /* What is a wrong argument to that call is a wrong file here. */
    if (status == RT_ERROR_USAGE)
        return fail_input(r, why.message, error);
    return status == RT_OK ? RT_OK : rt_fail(error, status, "%s", why.message);
}

/* Keeps the string attributes but those with which a file describes its own parts. */
static rt_status read_attributes(reader *r, rt_error *error)
{
    int32_t count = 0;
    if (exr_get_attribute_count(r->context, r->part, &count) != EXR_ERR_SUCCESS)
        return fail_input(r, "the header has no attributes", error);
    for (int32_t i = 0; i < count; i++) {
        const exr_attribute_t *attribute = NULL;
        if (exr_get_attribute_by_index(r->context, r->part, EXR_ATTR_LIST_FILE_ORDER, i,
                                       &attribute) != EXR_ERR_SUCCESS)
            return fail_input(r, "an attribute cannot be read", error);
        if (attribute->type != EXR_ATTR_STRING || !attribute->string->str ||
            strcmp(attribute->name, "type") == 0 || strcmp(attribute->name, "name") == 0)
            continue;
        rt_status status =
            rt_image_set_attribute(r->image, attribute->name, attribute->string->str, error);
        if (status != RT_OK)
            return status;
    }
    return RT_OK;
}

/*
 * Decompresses a chunk, but not one that is stored as it is, because it would not be smaller:
 * OpenEXRCore 3.1 takes that for blocks of B44.
 */
static exr_result_t decompress(exr_decode_pipeline_t *pipeline)
{
    const reader *r = pipeline->decoding_user_data;
    return pipeline->unpacked_buffer == pipeline->packed_buffer ? EXR_ERR_SUCCESS
                                                                : r->decompress(pipeline);
}

/* Tells a pipeline where the values of a chunk go. */
static void lay_out(const reader *r, exr_decode_pipeline_t *pipeline, const exr_chunk_info_t *chunk)
{
    float *plane = r->planes;
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = channel->user_pixel_stride = sizeof(float);
        channel->user_line_stride = chunk->width * (int32_t)sizeof(float);
        channel->decode_to_ptr = (uint8_t *)plane;
        plane += (size_t)chunk->width * (size_t)chunk->height;
    }
}

/*
 * Copies the values of a chunk to the image, from this corner on. The library sorts channels by
 * name, so each is found by its name and never by its place.
 */
static exr_result_t place(const reader *r, const exr_decode_pipeline_t *pipeline,
                          const exr_chunk_info_t *chunk, float *corner)
{
    const size_t step = r->image->channel_count, line = r->image->width * step;
    const float *value = r->planes;
    for (int i = 0; i < pipeline->channel_count; i++) {
        const uint32_t index = rt_image_channel(r->image, pipeline->channels[i].channel_name);
        if (index == RT_IMAGE_NO_CHANNEL)
            return EXR_ERR_INVALID_ARGUMENT;
        for (size_t y = 0; y < (size_t)chunk->height; y++) {
            float *to = corner + y * line + index;
            for (size_t x = 0; x < (size_t)chunk->width; x++)
                to[x * step] = *value++;
        }
    }
    return EXR_ERR_SUCCESS;
}

/*
 * Decodes one chunk to the image, from pixel (x, y) on. OpenEXRCore 3.1 turns the order of four
 * half floats around where they are to be beside each other, so that it gets a plane for each.
 */
static exr_result_t read_chunk(reader *r, exr_decode_pipeline_t *pipeline,
                               const exr_chunk_info_t *chunk, uint32_t x, uint32_t y, int is_first)
{
    const rt_image *image = r->image;
    if (chunk->width < 0 || chunk->height < 0 || (uint32_t)chunk->width > image->width - x ||
        (uint32_t)chunk->height > image->height - y ||
        (uint64_t)chunk->width * (uint64_t)chunk->height > r->pixels)
        return EXR_ERR_BAD_CHUNK_LEADER;
    /* OpenEXRCore reads on behind pixels that are cut short, as nothing is left to decompress. */
    if (chunk->compression == EXR_COMPRESSION_NONE && chunk->packed_size != chunk->unpacked_size)
        return EXR_ERR_BAD_CHUNK_LEADER;
    exr_result_t code = is_first ? exr_decoding_initialize(r->context, r->part, chunk, pipeline)
                                 : exr_decoding_update(r->context, r->part, chunk, pipeline);
    if (code != EXR_ERR_SUCCESS)
        return code;
    if ((uint32_t)pipeline->channel_count > image->channel_count)
        return EXR_ERR_INVALID_ARGUMENT;
    lay_out(r, pipeline, chunk);
    if (is_first) {
        code = exr_decoding_choose_default_routines(r->context, r->part, pipeline);
        r->decompress = pipeline->decompress_fn;
        pipeline->decompress_fn = r->decompress ? decompress : NULL;
        pipeline->decoding_user_data = r;
    }
    if (code == EXR_ERR_SUCCESS)
        code = exr_decoding_run(r->context, r->part, pipeline);
    float *corner = image->data + ((size_t)y * image->width + x) * image->channel_count;
    return code == EXR_ERR_SUCCESS ? place(r, pipeline, chunk, corner) : code;
}

static exr_result_t read_scanlines(reader *r, exr_decode_pipeline_t *pipeline)
{
    int32_t lines = 0;
    exr_result_t code = exr_get_scanlines_per_chunk(r->context, r->part, &lines);
    if (code == EXR_ERR_SUCCESS && lines < 1)
        code = EXR_ERR_FILE_BAD_HEADER;
    for (uint32_t y = 0; code == EXR_ERR_SUCCESS && y < r->image->height; y += (uint32_t)lines) {
        exr_chunk_info_t chunk;
        code = exr_read_scanline_chunk_info(r->context, r->part, r->window.min.y + (int)y, &chunk);
        if (code == EXR_ERR_SUCCESS)
            code = read_chunk(r, pipeline, &chunk, 0, y, y == 0);
    }
    return code;
}

/* Level (0, 0) of a tiled file is the image at full resolution. */
static exr_result_t read_tiles(reader *r, exr_decode_pipeline_t *pipeline)
{
    int32_t tile_width = 0, tile_height = 0;
    exr_result_t code = exr_get_tile_sizes(r->context, r->part, 0, 0, &tile_width, &tile_height);
    if (code == EXR_ERR_SUCCESS && (tile_width < 1 || tile_height < 1))
        code = EXR_ERR_FILE_BAD_HEADER;
    int64_t width = r->image->width, height = r->image->height;
    for (int64_t y = 0; code == EXR_ERR_SUCCESS && y < height; y += tile_height)
        for (int64_t x = 0; code == EXR_ERR_SUCCESS && x < width; x += tile_width) {
            exr_chunk_info_t chunk;
            code = exr_read_tile_chunk_info(r->context, r->part, (int)(x / tile_width),
                                            (int)(y / tile_height), 0, 0, &chunk);
            if (code == EXR_ERR_SUCCESS)
                code = read_chunk(r, pipeline, &chunk, (uint32_t)x, (uint32_t)y, x == 0 && y == 0);
        }
    return code;
}

/* The most pixels that a chunk has. */
static uint64_t chunk_pixels(const reader *r, exr_storage_t storage)
{
    int32_t width = (int32_t)r->image->width, lines = 0;
    exr_result_t code = storage == EXR_STORAGE_TILED
                            ? exr_get_tile_sizes(r->context, r->part, 0, 0, &width, &lines)
                            : exr_get_scanlines_per_chunk(r->context, r->part, &lines);
    if (code != EXR_ERR_SUCCESS || width < 1 || lines < 1)
        return 0; /* refused soon */
    return (uint64_t)width * (uint64_t)lines;
}

/*
 * A failure to decode. What OpenEXRCore decodes depends on its version; of a codec that it does not
 * know it tells a wrong attribute.
 */
static rt_status fail_decoding(const reader *r, const source *s, exr_result_t code, rt_error *error)
{
    static const char *const names[] = {"none",  "RLE", "ZIPS", "ZIP",  "PIZ",
                                        "PXR24", "B44", "B44A", "DWAA", "DWAB"};
    const char *const reason = rt_exr_reason(&s->message, code);
    exr_compression_t codec = EXR_COMPRESSION_LAST_TYPE;
    char what[160];
    if (r->context)
        exr_get_compression(r->context, r->part, &codec);
    const int is_newer =
        (size_t)codec >= sizeof names / sizeof *names || strstr(reason, "'compression'");
    if (code != EXR_ERR_FEATURE_NOT_IMPLEMENTED && !is_newer)
        return fail_input(r, reason, error);
    snprintf(what, sizeof what,
             "its compression, %s, is not read: convert it, as by `oiiotool FILE --compression zip "
             "-o NEW.exr`",
             is_newer ? "a newer one" : names[codec]);
    return fail_input(r, what, error);
}

/* Copies the pixels of the image that lie in the display window to where they are there. */
static void copy_overlap(rt_image *to, const reader *r)
{
    const exr_attr_box2i_t *from = &r->window, *display = &r->display;
    const int32_t x0 = from->min.x > display->min.x ? from->min.x : display->min.x,
                  x1 = from->max.x < display->max.x ? from->max.x : display->max.x,
                  y0 = from->min.y > display->min.y ? from->min.y : display->min.y,
                  y1 = from->max.y < display->max.y ? from->max.y : display->max.y;
    const size_t channels = to->channel_count;
    for (int64_t y = y0; y <= y1; y++)
        memcpy(to->data + ((size_t)(y - display->min.y) * to->width +
                           (size_t)((int64_t)x0 - display->min.x)) *
                              channels,
               r->image->data + ((size_t)(y - from->min.y) * r->image->width +
                                 (size_t)((int64_t)x0 - from->min.x)) *
                                    channels,
               (size_t)((int64_t)x1 - x0 + 1) * channels * sizeof(float));
}

static int overlaps(const exr_attr_box2i_t *a, const exr_attr_box2i_t *b)
{
    return a->min.x <= b->max.x && a->max.x >= b->min.x && a->min.y <= b->max.y &&
           a->max.y >= b->min.y;
}

/*
 * The picture is the display window: zero where the file holds no pixels, and without those beyond
 * it (overscan). Where that shows none of the pixels, the data window is the picture.
 */
static rt_status place_in_display(reader *r, const rt_bytes *file, rt_error *error)
{
    const exr_attr_box2i_t *from = &r->window, *display = &r->display;
    rt_image *placed = NULL;
    if (memcmp(from, display, sizeof *from) == 0 || !overlaps(from, display))
        return RT_OK;
    const rt_status status = create_image(&placed, r, display, file, error);
    if (status != RT_OK)
        return status;
    copy_overlap(placed, r);
    rt_image_move_attributes(placed, r->image);
    rt_image_destroy(r->image);
    r->image = placed;
    return RT_OK;
}

static const char decoding[] = "the decoding of an image";

/* Decodes all chunks, each with room for its values three times: packed, unpacked, in planes. */
static rt_status decode_pixels(reader *r, exr_storage_t storage, rt_memory *memory,
                               exr_result_t *code, rt_error *error)
{
    r->pixels = chunk_pixels(r, storage);
    const uint64_t bytes = r->pixels * r->image->channel_count * sizeof *r->planes;
    rt_status status = rt_memory_take(memory, 3 * bytes, decoding, error);
    if (status != RT_OK)
        return status;
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    r->planes = malloc(bytes ? (size_t)bytes : 1);
    if (!r->planes)
        status = rt_fail(error, RT_ERROR_MEMORY, "out of memory for %s", decoding);
    else if (storage == EXR_STORAGE_TILED)
        *code = read_tiles(r, &pipeline);
    else
        *code = read_scanlines(r, &pipeline);
    exr_decoding_destroy(r->context, &pipeline);
    free(r->planes);
    rt_memory_give(memory, 3 * bytes, decoding);
    return status;
}

static rt_status read_image(reader *r, source *s, rt_error *error)
{
    exr_storage_t storage;
    rt_status status = check_header(r, s, &storage, error);
    if (status != RT_OK)
        return status;
    const uint64_t held = values_of(r, &r->window), shown = values_of(r, &r->display);
    s->values += held > shown ? held : shown;
    s->channels += (uint32_t)r->channels->num_channels;
    status = create_image(&r->image, r, &r->window, s->file, error);
    if (status == RT_OK)
        status = read_attributes(r, error);
    if (status != RT_OK)
        return status;
    exr_result_t code;
    status = decode_pixels(r, storage, s->file->memory, &code, error);
    if (status != RT_OK)
        return status;
    return code == EXR_ERR_SUCCESS ? place_in_display(r, s->file, error)
                                   : fail_decoding(r, s, code, error);
}

static int has_channel(const exr_attr_chlist_t *channels, const char *name)
{
    for (int i = 0; i < channels->num_channels; i++)
        if (strcmp(channels->entries[i].name.str, name) == 0)
            return 1;
    return 0;
}

/* The part that is the picture: of those that are read, the first with R, G and B, or the first. */
static int picture_of(const reader *r, const source *s, int count)
{
    int first = 0;
    for (int part = count - 1, has_colours = 0; part >= 0; part--) {
        reader one = {.context = r->context, .part = part, .name = r->name};
        exr_storage_t storage;
        if (check_header(&one, s, &storage, NULL) != RT_OK)
            continue;
        const int colours = has_channel(one.channels, "R") && has_channel(one.channels, "G") &&
                            has_channel(one.channels, "B");
        first = colours || !has_colours ? part : first;
        has_colours |= colours;
    }
    return first;
}

/*
 * Reads the picture, and puts the channels of other parts beside its own, as layers by the names of
 * the parts. What of them is not read, as deep ones, leaves the picture as it is.
 */
static rt_status read_parts(reader *r, source *s, rt_error *error)
{
    rt_image *more[RT_IMAGE_CHANNELS_MAX];
    const char *layers[RT_IMAGE_CHANNELS_MAX] = {NULL};
    uint32_t read = 0;
    int count = 1;
    exr_get_count(r->context, &count);
    r->part = picture_of(r, s, count);
    rt_status status = read_image(r, s, error);
    for (int i = 0; i < count && status == RT_OK; i++) {
        if (i == r->part)
            continue;
        reader part = {.context = r->context, .part = i, .name = r->name, .first = r->image};
        exr_get_name(r->context, i, layers + read);
        status = read_image(&part, s, error);
        if (status == RT_OK)
            more[read++] = part.image;
        else
            rt_image_destroy(part.image);
        status = status == RT_ERROR_INPUT ? RT_OK : status;
    }
    if (status == RT_OK && read > 0)
        status = rt_image_add(&r->image, more, layers, read, s->file->memory, error);
    while (read > 0)
        rt_image_destroy(more[--read]);
    return status;
}

/*
 * Decodes a scan-line or tiled file: every channel, converted to float, over the display window, at
 * full resolution, of the first part with R, G and B, else the first, and its string attributes.
 * Channels of other parts are added by rt_image_add as the layers that the parts are named by; such
 * a part that is not read, as a deep one, one of another size or one with which the parts are too
 * large, is left out. A data window that is smaller leaves zeros around it, one that is larger is
 * cut off, one that lies outside of the display window is the picture. Fails with RT_ERROR_INPUT
 * for deep or subsampled files, for damaged ones, and for those that hold more than 2^28 values in
 * less than a byte for each 64; `name` stands for the file in messages. The caller destroys *out.
 */
rt_status rt_exr_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error)
{
    source s = {.file = file};
    reader r = {0};
    r.name = name;
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.error_handler_fn = rt_exr_on_error;
    start.user_data = &s;
    start.read_fn = on_read;
    start.size_fn = on_size;
    start.max_image_width = start.max_image_height = RT_IMAGE_SIDE_MAX;
    start.max_tile_width = start.max_tile_height = RT_IMAGE_SIDE_MAX;
    start.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;

    rt_status status;
    exr_result_t code = exr_start_read(&r.context, "(memory)", &start);
    if (code == EXR_ERR_SUCCESS)
        status = read_parts(&r, &s, error);
    else
        status = fail_input(&r, rt_exr_reason(&s.message, code), error);
    if (r.context)
        exr_finish(&r.context);
    if (status == RT_OK)
        *out = r.image;
    else
        rt_image_destroy(r.image);
    return status;
}
