/* target_qoi.c - QOI files. */
#include <string.h>

#include "fuzz/image.h"
#include "fuzz/targets.h"
#include "image/decode.h"

static int run(const uint8_t *data, size_t size)
{
    return fuzz_image_run(rt_qoi_decode, NULL, data, size);
}

/* A header, chunks, and the mark of the end. */
static void add(fuzz_inputs *seeds, uint8_t width, uint8_t channels, const void *chunks,
                size_t size)
{
    uint8_t file[64] = {'q', 'o', 'i', 'f', [7] = width, [11] = 2, [12] = channels};
    memcpy(file + 14, chunks, size);
    file[14 + size + 7] = 1;
    fuzz_add(seeds, file, 14 + size + 8);
}

static void seed(fuzz_inputs *seeds)
{
    add(seeds, 3, 3, "\376abc\146\240\210\311\25", 9); /* a colour, small and larger steps, a run */
    add(seeds, 2, 4, "\377abcd\100\300\25", 8);        /* one with alpha, and one seen before */
    add(seeds, 62, 3, "\375\375", 2);
}

static void words(fuzz_inputs *out)
{
    fuzz_add(out, "qoif", 4);
    fuzz_add(out, "\0\0\0\0\0\0\0\1", 8);
}

const fuzz_target fuzz_target_qoi = {
    .name = "qoi",
    .sources = "lib/image/qoi_*",
    .run = run,
    .seed = seed,
    .words = words,
    .size_max = 4096,
    .tries = 20000,
};
