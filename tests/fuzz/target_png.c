/* target_png.c - PNG files. */
#include <string.h>

#include "base/crc32.h"
#include "fuzz/image.h"
#include "fuzz/targets.h"
#include "image/decode.h"
#include "image/png.h"

static rt_status encode(rt_bytes *out, const rt_image *image, rt_error *error)
{
    const rt_image_options options = {0};
    return rt_png_encode(out, image, &options, error);
}

static int run(const uint8_t *data, size_t size)
{
    return fuzz_image_run(rt_png_decode, encode, data, size);
}

/* ---- Chunks -------------------------------------------------------------------------------- */

enum { magic_size = 8, chunk_frame = 12, header_size = 13 };

static const uint8_t magic[magic_size] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

static void put_chunk(rt_bytes *out, const char *type, const void *data, size_t size)
{
    size_t start = out->size + 4;
    fuzz_put_number(out, size, 4, 1);
    fuzz_put(out, type, 4);
    fuzz_put(out, data, size);
    fuzz_put_number(out, rt_crc32(out->data + start, size + 4), 4, 1);
}

/* The checksum of zlib (RFC 1950). */
static uint32_t adler32(const uint8_t *data, size_t size)
{
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < size; i++) {
        a = (a + data[i]) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

/* Bytes as zlib has them, in one block that is stored and not compressed; at most 65535. */
static rt_bytes store(const uint8_t *data, size_t size)
{
    rt_bytes out = {0};
    fuzz_put_number(&out, 0x7801, 2, 1);
    fuzz_put_number(&out, 1, 1, 0);
    fuzz_put_number(&out, size, 2, 0);
    fuzz_put_number(&out, ~size, 2, 0);
    fuzz_put(&out, data, size);
    fuzz_put_number(&out, adler32(data, size), 4, 1);
    return out;
}

enum { store_before = 7, store_after = 4 };

/* ---- Seeds --------------------------------------------------------------------------------- */

/* A picture of 5 x 4 pixels; its rows, filter bytes too, take at most 256 bytes. */
static void add(fuzz_inputs *seeds, int depth, int type, int is_interlaced)
{
    uint8_t header[header_size] = {0, 0, 0, 5, 0, 0, 0, 4, 0, 0, 0, 0, 0}, rows[256];
    static const uint8_t palette[12] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 9, 9, 9};
    static const int channels[7] = {1, 0, 3, 1, 2, 0, 4};
    size_t row = 1 + (size_t)(5 * channels[type] * depth + 7) / 8;
    rt_bytes file = {0};
    header[8] = (uint8_t)depth;
    header[9] = (uint8_t)type;
    header[12] = (uint8_t)is_interlaced;
    for (size_t i = 0; i < sizeof rows; i++)
        rows[i] = is_interlaced ? 0 : (uint8_t)(i % row ? i * 37 % 251 : i / row % 5);
    if (type == 3)
        for (size_t i = 0; i < sizeof rows; i++)
            rows[i] = i % row && !is_interlaced ? (uint8_t)(i & 3) : 0;
    rt_bytes data = store(rows, is_interlaced ? sizeof rows : 4 * row);
    fuzz_put(&file, magic, magic_size);
    put_chunk(&file, "IHDR", header, sizeof header);
    if (type == 3)
        put_chunk(&file, "PLTE", palette, sizeof palette);
    if (type == 2)
        put_chunk(&file, "gAMA", "\0\0\261\217", 4);
    if (type == 0)
        put_chunk(&file, "tEXt", "Title\0a", 7);
    put_chunk(&file, "IDAT", data.data, data.size);
    put_chunk(&file, "IEND", "", 0);
    fuzz_add(seeds, file.data, file.size);
    rt_bytes_free(&data);
    rt_bytes_free(&file);
}

static void seed(fuzz_inputs *seeds)
{
    static const struct {
        int depth, type;
    } kinds[] = {{1, 0}, {2, 0}, {4, 0}, {8, 0}, {16, 0}, {8, 2}, {16, 2}, {1, 3},
                 {2, 3}, {4, 3}, {8, 3}, {8, 4}, {16, 4}, {8, 6}, {16, 6}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        for (int is_interlaced = 0; is_interlaced < 2; is_interlaced++)
            add(seeds, kinds[i].depth, kinds[i].type, is_interlaced);
}

/* ---- Mutation ------------------------------------------------------------------------------ */

static uint32_t big(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Finds the start of a random chunk that fits in the file; 0 where there is none. */
static size_t choose_chunk(const uint8_t *data, size_t size, fuzz_random *random)
{
    size_t chosen = 0;
    uint32_t seen = 0;
    for (size_t at = magic_size; at + chunk_frame <= size;) {
        size_t length = big(data + at);
        if (length > size - at - chunk_frame)
            break;
        if (fuzz_random_below(random, ++seen) == 0)
            chosen = at;
        at += chunk_frame + length;
    }
    return chosen;
}

/* Changes the content of one chunk; of stored pixels what is stored. The checksums fit. */
static size_t mutate_chunk(uint8_t *data, size_t size, size_t room, size_t at)
{
    uint8_t content[4096];
    size_t length = big(data + at), used = length;
    int is_stored = memcmp(data + at + 4, "IDAT", 4) == 0 && length >= store_before + store_after &&
                    data[at + 10] == 1;
    if (length > sizeof content / 2)
        return size;
    if (is_stored)
        used -= store_before + store_after;
    memcpy(content, data + at + 8 + (is_stored ? store_before : 0), used);
    used = fuzz_mutate_bytes(content, used, sizeof content / 2);
    rt_bytes chunk = {0}, stored = is_stored ? store(content, used) : (rt_bytes){0};
    put_chunk(&chunk, (const char *)data + at + 4, is_stored ? stored.data : content,
              is_stored ? stored.size : used);
    size = fuzz_splice(data, size, room, at, chunk_frame + length, chunk.data, chunk.size);
    rt_bytes_free(&stored);
    rt_bytes_free(&chunk);
    return size;
}

/* Writes the checksum of every chunk anew. */
static void repair(uint8_t *data, size_t size)
{
    for (size_t at = magic_size; at + chunk_frame <= size;) {
        size_t length = big(data + at);
        if (length > size - at - chunk_frame)
            break;
        uint32_t sum = rt_crc32(data + at + 4, length + 4);
        for (int i = 0; i < 4; i++)
            data[at + 8 + length + (size_t)i] = (uint8_t)(sum >> (24 - 8 * i));
        at += chunk_frame + length;
    }
}

static size_t mutate(uint8_t *data, size_t size, size_t room, uint32_t seed)
{
    fuzz_random random = fuzz_random_begin(seed);
    size_t at = choose_chunk(data, size, &random);
    if (at && fuzz_random_below(&random, 4))
        return mutate_chunk(data, size, room, at);
    size = fuzz_mutate_bytes(data, size, room);
    if (fuzz_random_below(&random, 4))
        repair(data, size);
    return size;
}

const fuzz_target fuzz_target_png = {
    .name = "png",
    .sources = "lib/image/png_*",
    .run = run,
    .seed = seed,
    .mutate = mutate,
    .size_max = 4096,
    .tries = 20000,
};
