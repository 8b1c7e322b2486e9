/* target_jpeg.c - JPEG files. */
#include <string.h>

#include "fuzz/image.h"
#include "fuzz/targets.h"
#include "image/decode.h"
#include "lib/image/jpeg_sample.h"

static int run(const uint8_t *data, size_t size)
{
    return fuzz_image_run(rt_jpeg_decode, NULL, data, size);
}

static void seed(fuzz_inputs *seeds)
{
    static const jpeg_sample samples[] = {
        {.colours = JPEG_GREY, .width = 9, .height = 4},
        {.colours = JPEG_GREY, .width = 9, .height = 4, .is_progressive = 1},
        {.colours = JPEG_YCBCR, .width = 17, .height = 9, .restart = 1},
        {.colours = JPEG_YCBCR, .width = 5, .height = 9, .is_apart = 1},
        {.colours = JPEG_420, .width = 17, .height = 17},
        {.colours = JPEG_420, .width = 17, .height = 17, .is_progressive = 1, .restart = 2},
        {.colours = JPEG_RGB, .width = 8, .height = 3},
        {.colours = JPEG_YCCK, .width = 8, .height = 8},
        {.colours = JPEG_YCBCR, .width = 8, .height = 8, .is_arithmetic = 1}};
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        rt_bytes file = jpeg_sample_file(&samples[i]);
        fuzz_add(seeds, file.data, file.size);
        rt_bytes_free(&file);
    }
}

/* Markers, and what the two application segments that are read begin with. */
static void words(fuzz_inputs *words)
{
    static const uint8_t markers[] = {0xc0, 0xc1, 0xc2, 0xc4, 0xc9, 0xca, 0xcc, 0xd0, 0xd7,
                                      0xd8, 0xd9, 0xda, 0xdb, 0xdd, 0xe0, 0xee, 0xfe};
    for (size_t i = 0; i < sizeof markers; i++)
        fuzz_add(words, (uint8_t[2]){0xff, markers[i]}, 2);
    fuzz_add(words, "JFIF\0\1\2", 7);
    fuzz_add(words, "Adobe\0d\0\0\0\0\1", 12);
}

/* ---- Mutation ------------------------------------------------------------------------------ */

enum { marker_size = 2, length_size = 2 };

/* Finds a random segment that fits in the file; 0 where there is none. */
static size_t choose_segment(const uint8_t *data, size_t size, fuzz_random *random)
{
    size_t chosen = 0;
    uint32_t seen = 0;
    for (size_t at = marker_size; at + marker_size + length_size <= size;) {
        const size_t length = (size_t)(data[at + 2] << 8 | data[at + 3]);
        const int is_segment = data[at] == 0xff && data[at + 1] >= 0xc0 &&
                               (data[at + 1] & 0xf8) != 0xd0 && length >= length_size &&
                               length <= size - at - marker_size;
        if (is_segment && fuzz_random_below(random, ++seen) == 0)
            chosen = at;
        at += is_segment ? marker_size + length : 1;
    }
    return chosen;
}

/* Changes the content of a segment, or doubles the whole; its length fits. */
static size_t mutate_segment(uint8_t *data, size_t size, size_t room, size_t at, int is_doubled)
{
    uint8_t segment[4096];
    const size_t head = marker_size + length_size;
    const size_t whole = marker_size + (size_t)(data[at + 2] << 8 | data[at + 3]);
    if (whole > sizeof segment / 2)
        return size;
    memcpy(segment, data + at, whole);
    if (is_doubled)
        return fuzz_splice(data, size, room, at, 0, segment, whole);
    const size_t used = fuzz_mutate_bytes(segment + head, whole - head, sizeof segment / 2);
    segment[2] = (uint8_t)((used + length_size) >> 8);
    segment[3] = (uint8_t)(used + length_size);
    return fuzz_splice(data, size, room, at, whole, segment, head + used);
}

static size_t mutate(uint8_t *data, size_t size, size_t room, uint32_t seed)
{
    fuzz_random random = fuzz_random_begin(seed);
    const size_t at = choose_segment(data, size, &random);
    if (at && fuzz_random_below(&random, 2))
        return mutate_segment(data, size, room, at, fuzz_random_below(&random, 8) == 0);
    return fuzz_mutate_bytes(data, size, room);
}

const fuzz_target fuzz_target_jpeg = {
    .name = "jpeg",
    .sources = "lib/image/jpeg_*",
    .run = run,
    .seed = seed,
    .words = words,
    .mutate = mutate,
    .size_max = 4096,
    .tries = 20000,
};
