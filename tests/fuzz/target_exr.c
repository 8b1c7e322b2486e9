/* target_exr.c - OpenEXR files. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz/image.h"
#include "fuzz/targets.h"
#include "image/decode.h"
#include "image/exr.h"
#include "lib/image/exr_sample.h"

/*
 * Memory for OpenEXRCore with another content each time, so that a value that comes from memory
 * which was never written is not the same when a file is read again.
 */
static void *allocate(size_t size)
{
    static uint8_t content;
    void *memory = malloc(size);
    if (memory)
        memset(memory, content += 0x35, size);
    return memory;
}

static void begin(void)
{
    exr_set_default_memory_routines(allocate, free);
}

/* The whole image, all channels and attributes, encoded and decoded again. */
static void check_layers(const uint8_t *data, size_t size)
{
    rt_image *image = fuzz_image_decode(rt_exr_decode, data, size);
    rt_bytes file = {0};
    rt_error error;
    if ((uint64_t)image->width * image->height * image->channel_count < 65536) {
        FUZZ_EXPECT(rt_exr_encode(&file, image, &error) == RT_OK);
        rt_image *again = fuzz_image_decode(rt_exr_decode, file.data, file.size);
        FUZZ_EXPECT(again && again->channel_count == image->channel_count);
        FUZZ_EXPECT(again->width == image->width && again->height == image->height);
        for (size_t i = 0; i < (size_t)image->width * image->height; i++)
            for (uint32_t c = 0; c < image->channel_count; c++) {
                uint32_t other = rt_image_channel(again, image->names[c]);
                FUZZ_EXPECT(other != RT_IMAGE_NO_CHANNEL);
                FUZZ_EXPECT(memcmp(&image->data[i * image->channel_count + c],
                                   &again->data[i * image->channel_count + other],
                                   sizeof(float)) == 0);
            }
        for (size_t i = 0; i < image->attribute_count; i++) {
            const char *value = rt_image_attribute_value(again, image->attributes[i].name);
            FUZZ_EXPECT(value && strcmp(value, image->attributes[i].value) == 0);
        }
        rt_image_destroy(again);
    }
    rt_bytes_free(&file);
    rt_image_destroy(image);
}

/* The values of each layer, and of none; then the file of the picture itself in each format. */
static void check_rgb(const uint8_t *data, size_t size)
{
    static const char *const files[] = {"out.exr", "out.png", "out.ppm", "out.pfm", "out.xyz"};
    rt_image *image = fuzz_image_decode(rt_exr_decode, data, size);
    size_t pixels = (size_t)image->width * image->height;
    float *rgb = pixels < 65536 ? malloc(3 * pixels * sizeof *rgb) : NULL;
    rt_error error;
    for (uint32_t i = 0; rgb && i < image->channel_count && i < 16; i++) {
        char layer[RT_IMAGE_NAME_SIZE];
        strcpy(layer, image->names[i]);
        char *dot = strrchr(layer, '.');
        if (dot)
            *dot = '\0';
        rt_status status = rt_image_get_rgb(rgb, image, i ? layer : "unknown.layer", &error);
        FUZZ_EXPECT(status == RT_OK || status == RT_ERROR_INPUT);
        FUZZ_EXPECT(i == 0 || (status == RT_OK) == rt_image_has_layer(image, layer));
    }
    for (size_t i = 0; rgb && i < sizeof files / sizeof *files; i++) {
        rt_image *again = NULL;
        if (rt_image_write(image, files[i], NULL, &error) != RT_OK)
            fuzz_expect_line(error.message);
        else
            FUZZ_EXPECT(rt_image_read(&again, files[i], &error) == RT_OK);
        rt_image_destroy(again);
    }
    free(rgb);
    rt_image_destroy(image);
}

static int run(const uint8_t *data, size_t size)
{
    if (!fuzz_image_run(rt_exr_decode, NULL, data, size))
        return 0;
    check_layers(data, size);
    if (size % 8 == 0)
        check_rgb(data, size);
    return 1;
}

/* ---- Seeds --------------------------------------------------------------------------------- */

static void add_sample(fuzz_inputs *seeds, const exr_sample *sample)
{
    rt_bytes file = exr_sample_file(sample);
    fuzz_add(seeds, file.data, file.size);
    rt_bytes_free(&file);
}

/* A file of our own writer, with layers and attributes. */
static void add_layers(fuzz_inputs *seeds)
{
    static const char *const names[] = {"R", "G", "B", "depth.Z", "albedo.R", "photon.count"};
    rt_image *image = NULL;
    rt_bytes file = {0};
    FUZZ_EXPECT(rt_image_create(&image, 3, 2, names, 6, NULL) == RT_OK);
    for (size_t i = 0; i < 36; i++)
        image->data[i] = i == 12 ? NAN : i == 18 ? INFINITY : (float)i;
    FUZZ_EXPECT(rt_image_set_attribute(image, "mode", "photon", NULL) == RT_OK);
    FUZZ_EXPECT(rt_image_set_attribute(image, "a name of more than thirty-one bytes", "", NULL) ==
                RT_OK);
    FUZZ_EXPECT(rt_exr_encode(&file, image, NULL) == RT_OK);
    fuzz_add(seeds, file.data, file.size);
    rt_bytes_free(&file);
    rt_image_destroy(image);
}

/* A file of two parts, and one whose display window begins beside its data window. */
static void add_windows(fuzz_inputs *seeds)
{
    static const char *const names[] = {"left", "right"};
    static const char key[] = "displayWindow\0box2i";
    const exr_sample sample = {
        EXR_STORAGE_SCANLINE, EXR_PIXEL_HALF, EXR_COMPRESSION_RLE, -2, 3, 5, 4, 0, 0, 0};
    rt_bytes file = exr_sample_parts(&sample, names, 2);
    fuzz_add(seeds, file.data, file.size);
    rt_bytes_free(&file);
    file = exr_sample_file(&sample);
    size_t at = 0;
    while (memcmp(file.data + at, key, sizeof key) != 0)
        at++;
    memset(file.data + at + sizeof key + 4, 0, 4); /* its first column */
    fuzz_add(seeds, file.data, file.size);
    rt_bytes_free(&file);
}

static void seed(fuzz_inputs *seeds)
{
    static const exr_pixel_type_t types[] = {EXR_PIXEL_HALF, EXR_PIXEL_FLOAT, EXR_PIXEL_UINT};
    add_layers(seeds);
    add_windows(seeds);
    for (int i = 0; i <= EXR_COMPRESSION_B44A; i++) {
        exr_sample lines = {
            EXR_STORAGE_SCANLINE, types[i % 3], (exr_compression_t)i, -2, 3, 5, 4, 0, 0, 4};
        exr_sample tiles = {
            EXR_STORAGE_TILED, types[i % 2], (exr_compression_t)i, 0, 0, 5, 4, 3, 0, 3};
        add_sample(seeds, &lines);
        add_sample(seeds, &tiles);
    }
    exr_sample deep = {
        EXR_STORAGE_DEEP_SCANLINE, EXR_PIXEL_FLOAT, EXR_COMPRESSION_ZIPS, 0, 0, 2, 2, 0, 0, 0};
    exr_sample coarse = {
        EXR_STORAGE_SCANLINE, EXR_PIXEL_HALF, EXR_COMPRESSION_NONE, 0, 0, 4, 4, 0, 2, 0};
    add_sample(seeds, &deep);
    add_sample(seeds, &coarse);
}

/* ---- Mutation ------------------------------------------------------------------------------ */

enum { attributes_max = 64, chunks_max = 256, tiled = 0x200 };

/* Where the parts of a file of one part stand. */
typedef struct layout {
    size_t attributes[attributes_max]; /* each: name, 0, type, 0, u32 size, value */
    size_t attribute_count;
    size_t table; /* u64 offset of each chunk; 0: the header is damaged */
    size_t chunk_count;
    int is_tiled;
} layout;

/* The place behind the zero that ends a name; 0 where there is none. */
static size_t skip_name(const uint8_t *data, size_t size, size_t at)
{
    const uint8_t *end = memchr(data + at, 0, size - at);
    return end ? (size_t)(end - data) + 1 : 0;
}

/* Where the value of an attribute begins, and its size; 0 where it is damaged. */
static size_t find_value(const uint8_t *data, size_t size, size_t at, size_t *length)
{
    size_t type = skip_name(data, size, at), after = type ? skip_name(data, size, type) : 0;
    if (!after || after + 4 > size)
        return 0;
    *length = (size_t)fuzz_get(data + after, 4);
    return *length <= size - after - 4 ? after + 4 : 0;
}

static layout find_layout(const uint8_t *data, size_t size)
{
    layout l = {.is_tiled = size > 8 && (fuzz_get(data + 4, 4) & tiled)};
    size_t at = 8, length;
    while (at < size && data[at] && l.attribute_count < attributes_max) {
        size_t value = find_value(data, size, at, &length);
        if (!value)
            return l;
        l.attributes[l.attribute_count++] = at;
        at = value + length;
    }
    if (size < 17 || at >= size - 8 || data[at])
        return l;
    uint64_t first = fuzz_get(data + at + 1, 8);
    if (first <= at + 1 || first > size || (first - at - 1) % 8)
        return l;
    l.table = at + 1;
    l.chunk_count = (size_t)(first - l.table) / 8;
    return l;
}

/* Replaces bytes of the header or of a chunk; the offsets of the chunks behind them fit again. */
static size_t replace(uint8_t *data, size_t size, size_t room, const layout *l, size_t at,
                      size_t gone, const uint8_t *with, size_t with_size)
{
    size_t changed = fuzz_splice(data, size, room, at, gone, with, with_size);
    if (changed == size && gone != with_size)
        return size;
    size_t table = l->table > at ? l->table + with_size - gone : l->table;
    for (size_t i = 0; i < l->chunk_count; i++) {
        uint64_t offset = fuzz_get(data + table + 8 * i, 8);
        if (offset > at)
            fuzz_set(data + table + 8 * i, offset + with_size - gone, 8);
    }
    return changed;
}

/* Changes `length` bytes at `at`; their number stands in the 4 bytes before. */
static size_t mutate_sized(uint8_t *data, size_t size, size_t room, const layout *l, size_t at,
                           size_t length)
{
    uint8_t content[1024];
    if (length > sizeof content)
        return size;
    memcpy(content, data + at, length);
    size_t now = fuzz_mutate_bytes(content, length, sizeof content);
    if (size - length + now > room)
        return size;
    fuzz_set(data + at - 4, now, 4);
    return replace(data, size, room, l, at, length, content, now);
}

static size_t mutate(uint8_t *data, size_t size, size_t room, uint32_t seed)
{
    fuzz_random random = fuzz_random_begin(seed);
    layout l = find_layout(data, size);
    size_t length;
    if (!l.table || !l.attribute_count || !l.chunk_count || !fuzz_random_below(&random, 4))
        return fuzz_mutate_bytes(data, size, room);
    if (fuzz_random_below(&random, 2)) {
        size_t at = l.attributes[fuzz_random_below(&random, (uint32_t)l.attribute_count)];
        size_t value = find_value(data, size, at, &length);
        return mutate_sized(data, size, room, &l, value, length);
    }
    size_t i = fuzz_random_below(&random, (uint32_t)l.chunk_count);
    uint64_t offset = fuzz_get(data + l.table + 8 * i, 8);
    size_t leader = l.is_tiled ? 20 : 8;
    if (offset < l.table || offset > size || size - offset < leader)
        return fuzz_mutate_bytes(data, size, room);
    length = (size_t)fuzz_get(data + offset + leader - 4, 4);
    if (length > size - offset - leader)
        return fuzz_mutate_bytes(data, size, room);
    return mutate_sized(data, size, room, &l, (size_t)offset + leader, length);
}

const fuzz_target fuzz_target_exr = {
    .name = "exr",
    .sources = "lib/image/exr_* lib/image/image.c lib/image/image_rgb* lib/image/image_file*",
    .run = run,
    .seed = seed,
    .begin = begin,
    .mutate = mutate,
    .size_max = 4096,
    .tries = 15000,
};
